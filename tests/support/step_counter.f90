!> A monitor that stops a march.
module step_counter
   use ehlwave_monitor, only: give_up, monitor_t, stop_now
   implicit none (type, external)
   private

   !> Counts the time steps of a march and stops the case at a given step, or ends it after some.
   type, extends(monitor_t), public :: counter_t
      character(len=24) :: stage = 'time step'      !! stage whose steps count,
      integer :: total = 0                          !! of marches with so many steps; 0: of all
      integer :: steps = 0, stop_at = huge(1), end_after = huge(1)
      integer :: first = 0                          !! number of the first step that was done
   contains
      procedure :: step_done => count_step
   end type counter_t

contains

   subroutine count_step(self, stage, done, total)
      class(counter_t), intent(inout) :: self
      character(len=*), intent(in) :: stage
      integer, intent(in) :: done, total
      if (stage /= self%stage .or. all(self%total /= [0, total])) return
      if (self%steps == 0) self%first = done
      self%steps = self%steps + 1
      if (self%steps >= self%end_after) self%request = give_up
      if (done >= self%stop_at .and. done < total) self%request = stop_now
   end subroutine count_step

end module step_counter
