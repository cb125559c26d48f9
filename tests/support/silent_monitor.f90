!> A monitor that ignores everything.
module silent_monitor
   use ehlwave_monitor, only: monitor_t
   implicit none (type, external)
   private
   public :: silent_monitor_t

   type, extends(monitor_t) :: silent_monitor_t
   contains
      procedure :: step_done => ignore_step
   end type silent_monitor_t

contains

   subroutine ignore_step(self, stage, done, total)
      class(silent_monitor_t), intent(inout) :: self
      character(len=*), intent(in) :: stage
      integer, intent(in) :: done, total
      if (.false.) then   ! silence unused-argument warnings
         associate (a => self, b => stage, c => done, d => total)
         end associate
      end if
   end subroutine ignore_step

end module silent_monitor
