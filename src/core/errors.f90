!> Errors that a user can mend: bad input, unreadable or unwritable files.
!>
!> A procedure that can meet one has `type(error_t), allocatable :: error` as its last argument; `allocated(error)`
!> after the call means that nothing else it returns may be used. With `intent(out)` it forgets what was there. With
!> `intent(inout)` it takes part in a chain of calls that is looked at once, at its end: if it tests for an error first,
!> it keeps the one of an earlier step and does nothing; if it does not, it is called without one.
!>
!> Numerical outcomes (stalled, diverged, ...) are data, not errors: see `ehlwave_status`.
module ehlwave_errors
   implicit none (type, external)
   private
   public :: error_t, raise

   type :: error_t
      character(len=:), allocatable :: message   !! names the key or file and says what to change
   end type error_t

contains

   !> Set `error` with a message.
   pure subroutine raise(error, message)
      type(error_t), allocatable, intent(out) :: error
      character(len=*), intent(in) :: message   !! what is wrong and what to change

      allocate (error)
      error%message = message
   end subroutine raise

end module ehlwave_errors
