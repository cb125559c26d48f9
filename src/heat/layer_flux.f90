!> Flow of the oil through the faces between nodes, layer by layer across the film.
!>
!> A layer lies about each level, half as thick at the surfaces. The flows of the layers of a face add up to the flow of
!> the Reynolds equation, so that oil is conserved; their shares follow the velocities at both nodes.
module ehlwave_layer_flux
   use ehlwave_film_levels, only: film_levels_t
   use ehlwave_film_shear, only: film_shear_t
   use ehlwave_flow, only: flow_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: find_layer_fluxes, layer_shares

   !> Per unit of zeta, (0:levels, 0:nx, 0:ny): from node (i, j) to (i + 1, j) and to (i, j + 1).
   type, public :: layer_flux_t
      real(dp), allocatable :: x(:, :, :), y(:, :, :)
   end type layer_flux_t

contains

   !> Thickness of the layers.
   pure function layer_shares(levels) result(share)
      type(film_levels_t), intent(in) :: levels
      real(dp) :: share(0:levels%n)
      share = levels%d
      share(0) = 0.5_dp*levels%d
      share(levels%n) = 0.5_dp*levels%d
   end function layer_shares

   !> Flow through faces by theory eq. (D2) and (S4): rho H upstream, second order, less rho Qhat.
   pure subroutine find_layer_fluxes(self, grid, kappa, levels, shear, flow)
      class(layer_flux_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa
      type(film_levels_t), intent(in) :: levels
      type(film_shear_t), intent(in) :: shear
      type(flow_t), intent(in) :: flow         !! with fluxes through faces, at the state
      real(dp) :: share(0:levels%n), total
      integer :: i, j

      if (.not. allocated(self%x)) allocate (self%x, self%y, mold=shear%u)
      share = layer_shares(levels)
      self%x = 0
      self%y = 0
      do j = 0, grid%ny
         do i = 0, grid%nx - 1
            total = flow%f(i, j)
            if (i > 0) total = 1.5_dp*flow%f(i, j) - 0.5_dp*flow%f(i - 1, j)
            total = total - flow%along_x%flux(i, j)/(2*grid%hx)
            self%x(:, i, j) = 0.5_dp*(shear%u(:, i, j) + shear%u(:, i + 1, j))
            self%x(:, i, j) = self%x(:, i, j) + (total - dot_product(share, self%x(:, i, j)))
         end do
      end do
      do j = 0, grid%ny - 1
         do i = 1, grid%nx - 1
            total = -kappa*flow%along_y%flux(i, j)/(2*grid%hy)
            self%y(:, i, j) = 0.5_dp*(shear%v(:, i, j) + shear%v(:, i, j + 1))
            self%y(:, i, j) = self%y(:, i, j) + (total - dot_product(share, self%y(:, i, j)))
         end do
      end do
   end subroutine find_layer_fluxes

end module ehlwave_layer_flux
