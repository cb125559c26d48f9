!> What a sweep asks of every case, and what rank 0 is told of it.
module ehlwave_case_terms
   use ehlwave_kinds, only: dp
   use ehlwave_status, only: status_pending
   implicit none (type, external)
   private

   integer, parameter, public :: message_length = 256   !! longest message told to rank 0

   type, public :: case_limits_t
      real(dp) :: largest_case_seconds = 0    !! a case that takes longer is given up; 0: no limit
      real(dp) :: checkpoint_seconds = 600    !! between two checkpoints of a march
   end type case_limits_t

   type, public :: outcome_t
      integer :: status = status_pending      !! pending: not run, or not stored
      real(dp) :: seconds = 0
      character(len=message_length) :: message = ''
      logical :: is_store_broken = .false.    !! the message says why
   end type outcome_t

end module ehlwave_case_terms
