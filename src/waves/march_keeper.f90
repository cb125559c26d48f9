!> The interface of a keeper of marches: it stores the state of a march, so that another run of the program goes on with
!> it. The march is independent of the place of storage.
module ehlwave_march_keeper
   use ehlwave_byte_stream, only: bytes_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   !> A march that can be kept.
   type, abstract, public :: kept_march_t
   contains
      procedure(pass_march), deferred :: pass
   end type kept_march_t

   type, abstract, public :: march_keeper_t
      real(dp) :: seconds_before = 0             !! wall time of the case in earlier runs
   contains
      procedure(load_march), deferred :: load
      procedure(load_march), deferred :: keep
      procedure(save_march), deferred :: save
   end type march_keeper_t

   abstract interface
      !> Pass all values that the next steps depend on to the bytes, or take them from the bytes of an equal shape.
      subroutine pass_march(self, bytes)
         import :: bytes_t, kept_march_t
         implicit none (type, external)
         class(kept_march_t), intent(inout) :: self
         type(bytes_t), intent(inout) :: bytes
      end subroutine pass_march

      !> `load`: take up a march that has just begun where an earlier run left it; without an earlier run it stays
      !> unchanged. `keep`: remember a march, which stays unchanged.
      subroutine load_march(self, march)
         import :: kept_march_t, march_keeper_t
         implicit none (type, external)
         class(march_keeper_t), intent(inout) :: self
         class(kept_march_t), intent(inout) :: march
      end subroutine load_march

      !> The case is stopped: the last remembered state must outlive this run.
      subroutine save_march(self)
         import :: march_keeper_t
         implicit none (type, external)
         class(march_keeper_t), intent(inout) :: self
      end subroutine save_march
   end interface

end module ehlwave_march_keeper
