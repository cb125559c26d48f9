!> Derivatives of the friction coefficient by the pressure and the film at the nodes.
module ehlwave_friction_slope
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_shear_stress, only: least_pressure, node_gradient, stress_at
   use ehlwave_state, only: state_t
   implicit none (type, external)
   private
   public :: friction_slope

   real(dp), parameter :: step = 1e-5_dp   !! of a difference quotient, over H or over the largest value of a field;
                                           !! P times the thickening

contains

   !> Stresses depend on P, H and the pressure gradients at their own node: a centred difference with all nodes moved
   !> serves all of them.
   subroutine friction_slope(problem, state, by_p, by_h)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      real(dp), intent(inout), dimension(0:, 0:) :: by_p, by_h   !! (0:nx, 0:ny)
      real(dp), allocatable, dimension(:, :) :: by_gx, by_gy, gx, gy, zero
      integer :: j

      associate (grid => problem%grid, kappa => problem%conditions%elliptic%kappa)
         call grid%new_field(zero)
         allocate (by_gx, by_gy, gx, gy, source=zero)
         call node_gradient(grid, kappa, state%p, gx, gy)
         call difference(zero + step/max(1.0_dp, problem%rheology%thickening()), zero, zero, zero, by_p)
         call difference(zero, step*state%h, zero, zero, by_h)
         if (problem%rheology%is_newtonian()) return
         call difference(zero, zero, zero + step*maxval(abs(gx)), zero, by_gx)
         if (maxval(abs(gy)) > 0) call difference(zero, zero, zero, zero + step*maxval(abs(gy)), by_gy)
         do j = 0, grid%ny
            by_gx(:, j) = by_gx(:, j)/(2*grid%hx)
            by_p(2:, j) = by_p(2:, j) + by_gx(1:grid%nx - 1, j)
            by_p(:grid%nx - 2, j) = by_p(:grid%nx - 2, j) - by_gx(1:grid%nx - 1, j)
            if (j < grid%first_row .or. j > grid%last_row .or. grid%is_line) cycle
            by_gy(:, j) = kappa*by_gy(:, j)/(2*grid%hy)
            by_p(:, grid%above(j)) = by_p(:, grid%above(j)) + by_gy(:, j)
            by_p(:, grid%below(j)) = by_p(:, grid%below(j)) - by_gy(:, j)
         end do
      end associate

   contains

      !> Derivative along steps of P, H, dP/dX and kappa dP/dY, of which one is not zero.
      subroutine difference(dp_, dh, dgx, dgy, slope)
         real(dp), intent(in), dimension(0:, 0:) :: dp_, dh, dgx, dgy
         real(dp), intent(inout) :: slope(0:, 0:)
         real(dp), allocatable :: stress(:, :, :)
         type(state_t) :: moved
         integer :: j, k
         integer, parameter :: signs(2) = [1, -1]

         allocate (stress(0:problem%grid%nx, 0:problem%grid%ny, 2))
         do k = 1, 2
            moved = state
            moved%p = state%p + signs(k)*dp_
            moved%h = state%h + signs(k)*dh
            call stress_at(problem, moved, gx + signs(k)*dgx, gy + signs(k)*dgy, stress(:, :, k))
         end do
         do j = 0, problem%grid%ny
            slope(:, j) = load_factor*problem%grid%hx*problem%grid%hy*problem%grid%weight(j)* &
                          (stress(:, j, 1) - stress(:, j, 2))/(2*(dp_(:, j) + dh(:, j) + dgx(:, j) + dgy(:, j)))
         end do
         where (.not. state%p > least_pressure) slope = 0
      end subroutine difference

   end subroutine friction_slope

end module ehlwave_friction_slope
