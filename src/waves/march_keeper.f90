!> The interface of a keeper of marches: it stores the state of a march, so that another run of the program goes on with
!> it. The march is independent of the place of storage.
module ehlwave_march_keeper
   use ehlwave_kinds, only: dp
   use ehlwave_time_march, only: march_t
   implicit none (type, external)
   private

   type, abstract, public :: march_keeper_t
      real(dp) :: seconds_before = 0             !! wall time of the case in earlier runs
   contains
      procedure(load_march), deferred :: load
      procedure(keep_march), deferred :: keep
      procedure(save_march), deferred :: save
   end type march_keeper_t

   abstract interface
      !> Take up a march that has just begun where an earlier run left it; without an earlier run it stays unchanged.
      subroutine load_march(self, march)
         import :: march_keeper_t, march_t
         implicit none (type, external)
         class(march_keeper_t), intent(inout) :: self
         type(march_t), intent(inout) :: march
      end subroutine load_march

      !> Remember a march that has come to the end of a stretch.
      subroutine keep_march(self, march)
         import :: march_keeper_t, march_t
         implicit none (type, external)
         class(march_keeper_t), intent(inout) :: self
         type(march_t), intent(in) :: march
      end subroutine keep_march

      !> The case is stopped: the last remembered state must outlive this run.
      subroutine save_march(self)
         import :: march_keeper_t
         implicit none (type, external)
         class(march_keeper_t), intent(inout) :: self
      end subroutine save_march
   end interface

end module ehlwave_march_keeper
