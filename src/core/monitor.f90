!> Messages of a long calculation to the program around it.
module ehlwave_monitor
   implicit none (type, external)
   private
   public :: monitor_t

   integer, parameter, public :: go_on = 0     !! the calculation goes on
   integer, parameter, public :: stop_now = 1  !! it stops where it is, to be continued another time
   integer, parameter, public :: give_up = 2   !! it has had its time and ends as it is

   type, abstract :: monitor_t
      integer :: request = go_on               !! action that `step_done` requests
   contains
      procedure(step_done), deferred :: step_done
   end type monitor_t

   abstract interface
      !> Called after each time step or steady solution of a case; must return quickly.
      subroutine step_done(self, stage, done, total)
         import :: monitor_t
         implicit none (type, external)
         class(monitor_t), intent(inout) :: self
         character(len=*), intent(in) :: stage   !! stage of the computation, for a log line
         integer, intent(in) :: done, total      !! units finished, units in this stage
      end subroutine step_done
   end interface

end module ehlwave_monitor
