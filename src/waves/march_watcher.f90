!> The interface of a watcher of marches: it sees each solution on the way.
module ehlwave_march_watcher
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   type, abstract, public :: march_watcher_t
   contains
      procedure(see_step), deferred :: see
   end type march_watcher_t

   abstract interface
      !> A solution: `level` holds it until the next step begins.
      subroutine see_step(self, level, step, time)
         import :: dp, level_t, march_watcher_t
         implicit none (type, external)
         class(march_watcher_t), intent(inout) :: self
         type(level_t), intent(in) :: level
         integer, intent(in) :: step       !! 0: the start of the march
         real(dp), intent(in) :: time      !! T
      end subroutine see_step
   end interface

end module ehlwave_march_watcher
