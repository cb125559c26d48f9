!> A Newton step for residuals that grow exponentially with the pressure, as the viscosity does.
module ehlwave_bent_step
   use ehlwave_equations, only: equations_t
   use ehlwave_kinds, only: dp
   use ehlwave_reynolds_links, only: intake
   use ehlwave_threads, only: is_shared
   implicit none (type, external)
   private
   public :: bend

contains

   !> Bend a pressure change at nodes whose residual is an exponential of their own pressure.
   !>
   !> Where a node takes in oil from neighbours at higher pressure, R behaves like A exp(-s P) - c and
   !> Newton's method gains a single factor e per step. In u = exp(-s P) it is linear: with Newton's change d
   !>
   !>     P <- P - ln(1 - s d)/s,     s = phi d ln(eta)/dP,
   !>
   !> phi: share of that exponential in the diagonal of the Jacobian. The difference from P + d is of second
   !> order, so the final convergence stays quadratic.
   subroutine bend(equations, step, dp_)
      type(equations_t), intent(in) :: equations   !! evaluated where the step begins
      real(dp), intent(in) :: step              !! step length
      real(dp), intent(inout) :: dp_(0:, 0:)    !! Newton's change, then the change to make
      real(dp) :: gain, s
      integer :: i, j

      associate (mesh => equations%mesh, flow => equations%flow)
         !$omp parallel do private(gain, i, s) schedule(static) if (is_shared(size(dp_)))
         do j = mesh%grid%first_row, mesh%grid%last_row
            do i = 1, mesh%grid%nx - 1
               dp_(i, j) = step*dp_(i, j)
               s = -flow%eps_p(i, j)/flow%eps(i, j)
               if (s*abs(dp_(i, j)) < 0.05_dp .or. equations%is_cavitated(i, j)) cycle
               gain = intake(mesh, flow, i, j)
               if (gain <= 0) cycle
               s = s*gain/(gain + 1/equations%scale(i, j))
               if (s*abs(dp_(i, j)) > 1e-3_dp) dp_(i, j) = -log(max(1 - s*dp_(i, j), 0.1_dp))/s
            end do
         end do
         do i = 1, equations%edges%count()
            associate (p => dp_(equations%edges%i(i), equations%edges%j(i)))
               p = step*p
            end associate
         end do
      end associate
   end subroutine bend

end module ehlwave_bent_step
