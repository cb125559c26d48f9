!> The stress across the film of a generalised Newtonian oil: its mean from the sliding speed, and the flow.
!>
!> With the moments a_k = 1/2 integral zeta^k s dzeta and e_k = integral zeta^k ds/d(|sigma|^2) dzeta everything is algebra:
!>
!>     rate  1/2 integral s sigma dzeta      = a_0 sigma_m + a_1 Sigma
!>     flow  1/2 integral zeta s sigma dzeta = a_1 sigma_m + a_2 Sigma
!>     T_k = a_k I + e_k mm + e_(k+1) (mS + Sm) + e_(k+2) SS     (dyads of m = sigma_m and S = Sigma)
!>
!> with T_0, T_1 the derivatives of the rate by sigma_m and Sigma, T_1, T_2 those of the flow.
module ehlwave_film_stress
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_gauss_legendre, only: gauss_rule_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   integer, parameter, public :: block_size = 64     !! places solved at once
   integer, parameter :: most_steps = 60             ! of Newton; 15 were the most met for |B| to 1e6, |Sigma| to 60
   real(dp), parameter :: newton_tolerance = 1e-8_dp ! of the last step, which is still made: an error of its square

   !> Places 1..n of a block. Set n, sigma and b, then `solve`.
   type, public :: film_stress_t
      integer :: n = 0
      real(dp) :: sigma(2, block_size)               !! Sigma, half the change of the stress across the film
      real(dp) :: b(block_size)                      !! B, dimensionless shear rate along X
      real(dp) :: mean(2, block_size)                !! sigma_m
      real(dp) :: flow(2, block_size)                !! 1/2 integral zeta s sigma dzeta
      real(dp) :: flow_by_b(2, block_size)           !! its derivative by B, sigma_m following
      real(dp) :: flow_by_sigma(2, 2, block_size)    !! by Sigma, sigma_m following; symmetric
   contains
      procedure :: solve
   end type film_stress_t

   !> Moments at the places of a block.
   type :: moments_t
      real(dp) :: a(block_size, 0:2), e(block_size, 0:4)
   end type moments_t

contains

   !> Newton for sigma_m, from the closed form along Sigma (exact for Ree-Eyring without gradient across sliding, and without
   !> gradient at all); the flow is corrected to second order by the last step.
   pure subroutine solve(self, law, rule)
      class(film_stress_t), intent(inout) :: self
      class(flow_law_t), intent(in) :: law
      type(gauss_rule_t), intent(in) :: rule
      type(moments_t) :: moments
      real(dp), dimension(block_size) :: step_x, step_y
      real(dp) :: length, rate(2), share, size_m
      logical :: has_converged
      integer :: i, step

      call start(self, law, rule)
      do step = 1, most_steps
         call integrate(self, law, rule, moments)
         has_converged = .true.
         do i = 1, self%n
            associate (m => self%mean(:, i), t0 => tensor(moments, 0, self%mean(:, i), self%sigma(:, i), i))
               rate = moments%a(i, 0)*m + moments%a(i, 1)*self%sigma(:, i)
               call solve_symmetric(t0, self%b(i) - rate(1), -rate(2), step_x(i), step_y(i))
               size_m = sqrt(m(1)**2 + m(2)**2)
            end associate
            length = sqrt(step_x(i)**2 + step_y(i)**2)
            has_converged = has_converged .and. length <= newton_tolerance*max(1.0_dp, size_m)
            share = min(1.0_dp, law%largest_step(size_m)/max(length, tiny(length)))
            step_x(i) = share*step_x(i)
            step_y(i) = share*step_y(i)
         end do
         if (has_converged) exit
         self%mean(1, :self%n) = self%mean(1, :self%n) + step_x(:self%n)
         self%mean(2, :self%n) = self%mean(2, :self%n) + step_y(:self%n)
      end do
      call finish(self, moments, step_x, step_y)
   end subroutine solve

   !> First sigma_m: B resolved along and across Sigma, each part over the slope of the rate there at sigma_m = 0, and the
   !> law's own stress for what results.
   pure subroutine start(self, law, rule)
      type(film_stress_t), intent(inout) :: self
      class(flow_law_t), intent(in) :: law
      type(gauss_rule_t), intent(in) :: rule
      type(moments_t) :: moments
      real(dp) :: across, along, length, rate, unit(2)
      integer :: i

      self%mean(:, :self%n) = 0
      if (maxval(abs(self%b(:self%n))) <= 0) return
      call integrate(self, law, rule, moments)
      do i = 1, self%n
         length = sqrt(self%sigma(1, i)**2 + self%sigma(2, i)**2)
         unit = [1, 0]
         if (length > 0) unit = self%sigma(:, i)/length
         along = self%b(i)*unit(1)/(moments%a(i, 0) + length**2*moments%e(i, 2))
         across = -self%b(i)*unit(2)/moments%a(i, 0)
         rate = max(sqrt(along**2 + across**2), tiny(rate))
         self%mean(:, i) = law%stress_at(rate)/rate*[along*unit(1) - across*unit(2), along*unit(2) + across*unit(1)]
      end do
   end subroutine start

   !> Flow and its derivatives from the moments at the last sigma_m and the last step.
   pure subroutine finish(self, moments, step_x, step_y)
      type(film_stress_t), intent(inout) :: self
      type(moments_t), intent(in) :: moments
      real(dp), intent(in) :: step_x(block_size), step_y(block_size)
      real(dp) :: column(2, 2), t0(3), t1(3), t2(3)
      integer :: i

      do i = 1, self%n
         t0 = tensor(moments, 0, self%mean(:, i), self%sigma(:, i), i)
         t1 = tensor(moments, 1, self%mean(:, i), self%sigma(:, i), i)
         t2 = tensor(moments, 2, self%mean(:, i), self%sigma(:, i), i)
         call solve_symmetric(t0, t1(1), t1(2), column(1, 1), column(2, 1))   ! T_0^(-1) T_1
         call solve_symmetric(t0, t1(2), t1(3), column(1, 2), column(2, 2))
         self%flow(:, i) = moments%a(i, 1)*self%mean(:, i) + moments%a(i, 2)*self%sigma(:, i) &
                           + step_x(i)*t1(1:2) + step_y(i)*t1(2:3)
         self%mean(:, i) = self%mean(:, i) + [step_x(i), step_y(i)]
         self%flow_by_b(:, i) = column(1, :)
         self%flow_by_sigma(1, 1, i) = t2(1) - t1(1)*column(1, 1) - t1(2)*column(2, 1)
         self%flow_by_sigma(2, 1, i) = t2(2) - t1(2)*column(1, 1) - t1(3)*column(2, 1)
         self%flow_by_sigma(1, 2, i) = self%flow_by_sigma(2, 1, i)
         self%flow_by_sigma(2, 2, i) = t2(3) - t1(2)*column(1, 2) - t1(3)*column(2, 2)
      end do
   end subroutine finish

   !> Moments a_0..a_2 and e_0..e_4 by Gauss quadrature.
   pure subroutine integrate(self, law, rule, moments)
      type(film_stress_t), intent(in) :: self
      class(flow_law_t), intent(in) :: law
      type(gauss_rule_t), intent(in) :: rule
      type(moments_t), intent(out) :: moments
      real(dp), dimension(block_size) :: s, slope, stress2
      real(dp) :: e, w, z
      integer :: i, k

      moments%a = 0
      moments%e = 0
      do k = 1, rule%n
         z = rule%node(k)
         do i = 1, self%n
            stress2(i) = (self%mean(1, i) + z*self%sigma(1, i))**2 + (self%mean(2, i) + z*self%sigma(2, i))**2
         end do
         call law%shear_factor(self%n, stress2, s, slope)
         w = 0.5_dp*rule%weight(k)
         do i = 1, self%n
            e = 2*w*slope(i)
            moments%a(i, 0) = moments%a(i, 0) + w*s(i)
            moments%a(i, 1) = moments%a(i, 1) + w*z*s(i)
            moments%a(i, 2) = moments%a(i, 2) + w*z*z*s(i)
            moments%e(i, 0) = moments%e(i, 0) + e
            moments%e(i, 1) = moments%e(i, 1) + z*e
            moments%e(i, 2) = moments%e(i, 2) + z*z*e
            moments%e(i, 3) = moments%e(i, 3) + z**3*e
            moments%e(i, 4) = moments%e(i, 4) + z**4*e
         end do
      end do
   end subroutine integrate

   !> T_k of place i: components xx, xy, yy.
   pure function tensor(moments, k, m, s, i) result(t)
      type(moments_t), intent(in) :: moments
      integer, intent(in) :: k, i
      real(dp), intent(in) :: m(2), s(2)   !! sigma_m, Sigma
      real(dp) :: t(3)
      associate (e0 => moments%e(i, k), e1 => moments%e(i, k + 1), e2 => moments%e(i, k + 2), a => moments%a(i, k))
         t(1) = a + e0*m(1)**2 + 2*e1*m(1)*s(1) + e2*s(1)**2
         t(2) = e0*m(1)*m(2) + e1*(m(1)*s(2) + m(2)*s(1)) + e2*s(1)*s(2)
         t(3) = a + e0*m(2)**2 + 2*e1*m(2)*s(2) + e2*s(2)**2
      end associate
   end function tensor

   !> Solve a symmetric 2 by 2 system with components xx, xy, yy.
   pure subroutine solve_symmetric(t, right_x, right_y, x, y)
      real(dp), intent(in) :: t(3), right_x, right_y
      real(dp), intent(out) :: x, y
      real(dp) :: determinant
      determinant = t(1)*t(3) - t(2)**2
      x = (t(3)*right_x - t(2)*right_y)/determinant
      y = (t(1)*right_y - t(2)*right_x)/determinant
   end subroutine solve_symmetric

end module ehlwave_film_stress
