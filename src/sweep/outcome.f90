!> The message to rank 0 about a case that was worked on.
module ehlwave_outcome
   use ehlwave_kinds, only: dp
   use ehlwave_status, only: status_pending
   implicit none (type, external)
   private

   integer, parameter, public :: message_length = 1024   !! longest message told to rank 0: it can name files

   type, public :: outcome_t
      integer :: case = 0                     !! its number
      integer :: status = status_pending      !! pending: not run, or not stored
      real(dp) :: seconds = 0
      character(len=message_length) :: message = ''
      logical :: is_store_broken = .false.    !! the message says why
      logical :: is_input_changed = .false.   !! a file cannot be read any more as rank 0 did; the message says which
   end type outcome_t

end module ehlwave_outcome
