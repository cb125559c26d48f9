!> The message to rank 0 about a case that was worked on.
module ehlwave_outcome
   use ehlwave_kinds, only: dp
   use ehlwave_status, only: status_pending
   implicit none (type, external)
   private

   integer, parameter, public :: message_length = 1024   !! longest message to rank 0: it can name files

   type, public :: outcome_t
      integer :: case = 0                     !! its number
      integer :: status = status_pending      !! pending: not run, or not stored
      real(dp) :: seconds = 0
      character(len=message_length) :: message = ''
      logical :: is_store_broken = .false.    !! failed; the message has the reason
      logical :: is_input_changed = .false.   !! a file differs from rank 0's copy; the message names it
   end type outcome_t

end module ehlwave_outcome
