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

   real(dp), parameter :: nothing = 1e-100_dp        ! gives a direction to Sigma = 0

   !> Places 1..n of a block. Set n, sigma and b, then `solve`. The last index is the component along X or Y.
   type, public :: film_stress_t
      integer :: n = 0
      real(dp) :: sigma(block_size, 2)               !! Sigma, half the change of the stress across the film
      real(dp) :: b(block_size)                      !! B, dimensionless shear rate along X
      real(dp) :: mean(block_size, 2)                !! sigma_m
      real(dp) :: flow(block_size, 2)                !! 1/2 integral zeta s sigma dzeta
      real(dp) :: flow_by_b(block_size, 2)           !! its derivative by B, sigma_m following
      real(dp) :: flow_by_sigma(block_size, 2, 2)    !! by Sigma, sigma_m following; symmetric
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
      real(dp), dimension(block_size) :: length, size_m, step_x, step_y
      real(dp) :: share
      integer :: i, step

      call start(self, law, rule)
      do step = 1, most_steps
         call integrate(self, law, rule, moments)
         call newton_step(self, moments, step_x, step_y)
         do i = 1, self%n
            size_m(i) = sqrt(self%mean(i, 1)**2 + self%mean(i, 2)**2)
            length(i) = sqrt(step_x(i)**2 + step_y(i)**2)
         end do
         if (all(length(:self%n) <= newton_tolerance*max(1.0_dp, size_m(:self%n)))) exit
         do i = 1, self%n
            share = min(1.0_dp, law%largest_step(size_m(i))/max(length(i), tiny(share)))
            self%mean(i, 1) = self%mean(i, 1) + share*step_x(i)
            self%mean(i, 2) = self%mean(i, 2) + share*step_y(i)
         end do
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
      real(dp), dimension(block_size) :: across, along, rate, stress, unit_x, unit_y
      real(dp) :: length2
      integer :: i

      self%mean(:self%n, :) = 0
      if (maxval(abs(self%b(:self%n))) <= 0) return
      call integrate(self, law, rule, moments)
      do i = 1, self%n
         unit_x(i) = self%sigma(i, 1) + nothing
         length2 = unit_x(i)**2 + self%sigma(i, 2)**2
         unit_x(i) = unit_x(i)/sqrt(length2)
         unit_y(i) = self%sigma(i, 2)/sqrt(length2)
         along(i) = self%b(i)*unit_x(i)/(moments%a(i, 0) + length2*moments%e(i, 2))
         across(i) = -self%b(i)*unit_y(i)/moments%a(i, 0)
         rate(i) = max(sqrt(along(i)**2 + across(i)**2), tiny(length2))
      end do
      call law%first_stress(self%n, rate, stress)
      do i = 1, self%n
         self%mean(i, 1) = stress(i)/rate(i)*(along(i)*unit_x(i) - across(i)*unit_y(i))
         self%mean(i, 2) = stress(i)/rate(i)*(along(i)*unit_y(i) + across(i)*unit_x(i))
      end do
   end subroutine start

   !> T_0^(-1) (B e_x - rate).
   pure subroutine newton_step(self, moments, step_x, step_y)
      type(film_stress_t), intent(in) :: self
      type(moments_t), intent(in) :: moments
      real(dp), intent(out) :: step_x(block_size), step_y(block_size)
      real(dp) :: determinant, left_x, left_y, xx, xy, yy
      integer :: i

      associate (m => self%mean, s => self%sigma, a => moments%a, e => moments%e)
         do i = 1, self%n
            xx = a(i, 0) + e(i, 0)*m(i, 1)**2 + 2*e(i, 1)*m(i, 1)*s(i, 1) + e(i, 2)*s(i, 1)**2
            xy = e(i, 0)*m(i, 1)*m(i, 2) + e(i, 1)*(m(i, 1)*s(i, 2) + m(i, 2)*s(i, 1)) + e(i, 2)*s(i, 1)*s(i, 2)
            yy = a(i, 0) + e(i, 0)*m(i, 2)**2 + 2*e(i, 1)*m(i, 2)*s(i, 2) + e(i, 2)*s(i, 2)**2
            left_x = self%b(i) - a(i, 0)*m(i, 1) - a(i, 1)*s(i, 1)
            left_y = -a(i, 0)*m(i, 2) - a(i, 1)*s(i, 2)
            determinant = xx*yy - xy**2
            step_x(i) = (yy*left_x - xy*left_y)/determinant
            step_y(i) = (xx*left_y - xy*left_x)/determinant
         end do
      end associate
   end subroutine newton_step

   !> Flow and its derivatives from the moments at the last sigma_m and the last step.
   pure subroutine finish(self, moments, step_x, step_y)
      type(film_stress_t), intent(inout) :: self
      type(moments_t), intent(in) :: moments
      real(dp), intent(in) :: step_x(block_size), step_y(block_size)
      real(dp) :: determinant, t(3, 0:2), xx, xy, yx, yy
      integer :: i, k

      associate (m => self%mean, s => self%sigma, a => moments%a, e => moments%e)
         do i = 1, self%n
            do k = 0, 2
               t(1, k) = a(i, k) + e(i, k)*m(i, 1)**2 + 2*e(i, k + 1)*m(i, 1)*s(i, 1) + e(i, k + 2)*s(i, 1)**2
               t(2, k) = e(i, k)*m(i, 1)*m(i, 2) + e(i, k + 1)*(m(i, 1)*s(i, 2) + m(i, 2)*s(i, 1)) + e(i, k + 2)*s(i, 1)*s(i, 2)
               t(3, k) = a(i, k) + e(i, k)*m(i, 2)**2 + 2*e(i, k + 1)*m(i, 2)*s(i, 2) + e(i, k + 2)*s(i, 2)**2
            end do
            determinant = t(1, 0)*t(3, 0) - t(2, 0)**2
            xx = (t(3, 0)*t(1, 1) - t(2, 0)*t(2, 1))/determinant      ! T_0^(-1) T_1
            yx = (t(1, 0)*t(2, 1) - t(2, 0)*t(1, 1))/determinant
            xy = (t(3, 0)*t(2, 1) - t(2, 0)*t(3, 1))/determinant
            yy = (t(1, 0)*t(3, 1) - t(2, 0)*t(2, 1))/determinant
            self%flow_by_b(i, 1) = xx
            self%flow_by_b(i, 2) = xy
            self%flow_by_sigma(i, 1, 1) = t(1, 2) - t(1, 1)*xx - t(2, 1)*yx
            self%flow_by_sigma(i, 2, 1) = t(2, 2) - t(2, 1)*xx - t(3, 1)*yx
            self%flow_by_sigma(i, 1, 2) = self%flow_by_sigma(i, 2, 1)
            self%flow_by_sigma(i, 2, 2) = t(3, 2) - t(2, 1)*xy - t(3, 1)*yy
            self%flow(i, 1) = a(i, 1)*m(i, 1) + a(i, 2)*s(i, 1) + step_x(i)*t(1, 1) + step_y(i)*t(2, 1)
            self%flow(i, 2) = a(i, 1)*m(i, 2) + a(i, 2)*s(i, 2) + step_x(i)*t(2, 1) + step_y(i)*t(3, 1)
            self%mean(i, 1) = m(i, 1) + step_x(i)
            self%mean(i, 2) = m(i, 2) + step_y(i)
         end do
      end associate
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

      moments%a(:self%n, :) = 0
      moments%e(:self%n, :) = 0
      do k = 1, rule%n
         z = rule%node(k)
         do i = 1, self%n
            stress2(i) = (self%mean(i, 1) + z*self%sigma(i, 1))**2 + (self%mean(i, 2) + z*self%sigma(i, 2))**2
         end do
         call law%shear_factor(self%n, stress2, s, slope)
         w = 0.5_dp*rule%weight(k)
         do i = 1, self%n
            e = 2*w*slope(i)
            moments%a(i, 0) = moments%a(i, 0) + w*s(i)
            moments%a(i, 1) = moments%a(i, 1) + (w*z)*s(i)
            moments%a(i, 2) = moments%a(i, 2) + (w*z*z)*s(i)
            moments%e(i, 0) = moments%e(i, 0) + e
            moments%e(i, 1) = moments%e(i, 1) + z*e
            moments%e(i, 2) = moments%e(i, 2) + z*z*e
            moments%e(i, 3) = moments%e(i, 3) + z**3*e
            moments%e(i, 4) = moments%e(i, 4) + z**4*e
         end do
      end do
   end subroutine integrate

end module ehlwave_film_stress
