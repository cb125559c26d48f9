!> Errors that a user can mend: bad input, unreadable or unwritable files.
!>
!> A procedure that can fail has `type(error_t), allocatable :: error` as its last argument. `allocated(error)` after
!> the call means that its other results must not be used. `intent(out)` clears earlier errors. `intent(inout)` is for a
!> chain of calls that is checked once, at its end: a procedure that tests for an error first keeps the error of an
!> earlier step and does nothing; others are called without an earlier error.
!>
!> Numerical outcomes (stalled, diverged, ...) are data, not errors: see `ehlwave_status`.
module ehlwave_errors
   implicit none (type, external)
   private
   public :: error_t, raise

   type :: error_t
      character(len=:), allocatable :: message   !! names the key or file and the change needed
   end type error_t

contains

   !> Set `error` with a message.
   pure subroutine raise(error, message)
      type(error_t), allocatable, intent(out) :: error
      character(len=*), intent(in) :: message   !! problem and the change needed

      allocate (error)
      error%message = message
   end subroutine raise

end module ehlwave_errors
