!> Preconditions of procedures, checked in debug builds.
module ehlwave_assertions
   implicit none (type, external)
   private
   public :: assert

   !> Whether this build checks them. `if (checks) call assert(...)` leaves nothing of it in a release build.
#ifdef EHLWAVE_CHECKS
   logical, parameter, public :: checks = .true.
#else
   logical, parameter, public :: checks = .false.
#endif

contains

   !> End the program where a caller has made a mistake: bad input is an `error_t` long before.
   pure subroutine assert(holds, what)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: what   !! procedure and precondition
      if (.not. holds) error stop 'ehlwave: a precondition does not hold: '//what
   end subroutine assert

end module ehlwave_assertions
