!> Heat that the oil carries through a film: a part of the balance.
module ehlwave_carried_heat
   use ehlwave_energy, only: energy_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_layer_flux, only: layer_shares
   implicit none (type, external)
   private
   public :: carried_heat

contains

   !> Heat that the oil carries off from each node, through its sides and across all levels, in the unit of heat flows
   !> into the surfaces. Oil that a node gains or loses by itself, the first node by its first-order difference, takes
   !> the rise of the node.
   pure function carried_heat(energy, grid, kappa) result(heat)
      type(energy_t), intent(in) :: energy
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa
      real(dp) :: heat(0:grid%nx, 0:grid%ny)
      real(dp), dimension(0:energy%levels%n) :: north, share
      real(dp), dimension(0:grid%nx - 1) :: east, oil
      integer :: back, front, i, j

      share = layer_shares(energy%levels)
      heat = 0
      associate (theta => energy%rise, x => energy%flux%x, y => energy%flux%y)
         do j = grid%first_row, grid%last_row
            do i = 0, grid%nx - 1
               oil(i) = dot_product(share, x(:, i, j))
               east(i) = dot_product(share*x(:, i, j), &
                  merge(1.5_dp*theta(:, i, j) - 0.5_dp*theta(:, max(i - 1, 0), j), theta(:, i + 1, j), x(:, i, j) > 0))
            end do
            heat(1:grid%nx - 1, j) = (east(1:) - east(:grid%nx - 2))/grid%hx
            heat(1, j) = heat(1, j) - (oil(1) - oil(0))/grid%hx*dot_product(share, theta(:, 1, j))
         end do
         if (.not. grid%is_line) then
            do j = 0, grid%ny - 1
               do i = 1, grid%nx - 1
                  back = min(j + 2, grid%ny)
                  front = j - 1
                  if (front < 0) front = merge(1, 0, grid%is_half)
                  north = y(:, i, j)*merge(1.5_dp*theta(:, i, j) - 0.5_dp*theta(:, i, front), &
                                           1.5_dp*theta(:, i, j + 1) - 0.5_dp*theta(:, i, back), y(:, i, j) > 0)
                  heat(i, j) = heat(i, j) + kappa/grid%hy*dot_product(share, north)
                  heat(i, j + 1) = heat(i, j + 1) - kappa/grid%hy*dot_product(share, north)
                  if (j == 0 .and. grid%is_half) heat(i, j) = heat(i, j) + kappa/grid%hy*dot_product(share, north)
               end do
            end do
         end if
      end associate
      heat = energy%scales%convection*heat
   end function carried_heat

end module ehlwave_carried_heat
