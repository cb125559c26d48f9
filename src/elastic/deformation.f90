!> One interface for every way to compute the elastic deformation.
module ehlwave_deformation
   use ehlwave_assertions, only: assert, checks
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   type, abstract, public :: deformation_t
      real(dp) :: work = 0   !! operations done on this grid so far, see `ehlwave_work_unit`: its own, and what its
                             !! users add
      real(dp) :: convolution = 0   !! operations of one deformation in the precision of linear systems: the own unit
   contains
      procedure(init_deformation), deferred :: init
      procedure(apply_deformation), deferred :: apply
      procedure :: apply_single
      procedure :: deform
      procedure :: vary_along
   end type deformation_t

   abstract interface
      !> Make work space and coefficients for a grid.
      subroutine init_deformation(self, grid, kappa, k)
         import :: deformation_t, dp, grid_t
         implicit none (type, external)
         class(deformation_t), intent(inout) :: self
         type(grid_t), intent(in) :: grid
         real(dp), intent(in) :: kappa   !! ellipticity a/b
         real(dp), intent(in) :: k       !! complete elliptic integral of the first kind
      end subroutine init_deformation

      !> Deformation D = sum over cells of influence times P, theory eq. (9), at all nodes.
      subroutine apply_deformation(self, p, d)
         import :: deformation_t, dp
         implicit none (type, external)
         class(deformation_t), intent(inout) :: self
         real(dp), intent(in), contiguous :: p(0:, 0:)    !! pressure at the nodes, (0:nx, 0:ny), zero on the outer
                                                          !! boundary
         real(dp), intent(out), contiguous :: d(0:, 0:)   !! deformation, (0:nx, 0:ny)
      end subroutine apply_deformation
   end interface

contains

   !> Deformation for a change that need not be exact: in single precision where available.
   subroutine apply_single(self, p, d)
      class(deformation_t), intent(inout) :: self
      real(dp), intent(in), contiguous :: p(0:, 0:)
      real(dp), intent(out), contiguous :: d(0:, 0:)
      call self%apply(p, d)
   end subroutine apply_single

   !> Let pressures from now on vary along a line contact as exp(i k Y); 0: they do not vary. Only lines take it.
   subroutine vary_along(self, wave_number)
      class(deformation_t), intent(inout) :: self
      real(dp), intent(in) :: wave_number   !! k, 1/a
      if (checks) call assert(.not. wave_number > 0 .and. self%work >= 0, 'vary_along: of a line contact')
   end subroutine vary_along

   !> Either method.
   subroutine deform(self, p, d, in_single)
      class(deformation_t), intent(inout) :: self
      real(dp), intent(in), contiguous :: p(0:, 0:)
      real(dp), intent(out), contiguous :: d(0:, 0:)
      logical, intent(in) :: in_single
      if (in_single) then
         call self%apply_single(p, d)
      else
         call self%apply(p, d)
      end if
   end subroutine deform

end module ehlwave_deformation
