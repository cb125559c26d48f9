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
   real(dp), parameter :: newton_tolerance = 1e-7_dp ! of the last step, which is still made: an error of its square
   real(dp), parameter :: small_variation = 1.75_dp  ! |Sigma| up to which two points across the film make a first guess
   real(dp), parameter :: two_points(2) = [-1, 1]/sqrt(3.0_dp), both_equal(2) = 1   ! of Gauss, and their weights

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

   !> Newton for sigma_m; the flow is corrected to second order by the last step.
   pure subroutine solve(self, law, rule)
      class(film_stress_t), intent(inout) :: self
      class(flow_law_t), intent(in) :: law
      type(gauss_rule_t), intent(in) :: rule
      type(moments_t) :: moments
      real(dp) :: change(block_size, 2)
      real(dp), dimension(block_size) :: length, range
      integer :: i, step

      call start(self, law, rule)
      do step = 1, most_steps
         call integrate(self, law, rule%node, rule%weight, moments)
         call newton_step(self, moments, change)
         do i = 1, self%n
            range(i) = 1
            if (law%is_power) range(i) = max(1.0_dp, sqrt(self%mean(i, 1)**2 + self%mean(i, 2)**2))
            length(i) = sqrt(change(i, 1)**2 + change(i, 2)**2)
         end do
         if (all(length(:self%n) <= newton_tolerance*range(:self%n))) exit
         do i = 1, self%n
            self%mean(i, :) = self%mean(i, :) + min(1.0_dp, range(i)/max(length(i), tiny(length)))*change(i, :)
         end do
      end do
      call finish(self, moments, change)
   end subroutine solve

   !> First sigma_m: that of B alone, then the stress for B over what the rate there is too large by, exact for Ree-Eyring
   !> without gradient across sliding, and a step of Newton across, where it lies within Sigma. Two points across the film tell
   !> the rate where Sigma is small: an error of fourth order.
   pure subroutine start(self, law, rule)
      type(film_stress_t), intent(inout) :: self
      class(flow_law_t), intent(in) :: law
      type(gauss_rule_t), intent(in) :: rule
      type(moments_t) :: moments
      real(dp) :: change(block_size, 2), rate(block_size), stress(block_size)
      integer :: i

      associate (n => self%n, m => self%mean, s => self%sigma, a => moments%a)
         m(:n, :) = 0
         if (maxval(abs(self%b(:n))) <= 0) return
         rate(:n) = max(abs(self%b(:n)), tiny(rate))
         call law%first_stress(n, rate, stress)
         m(:n, 1) = sign(stress(:n), self%b(:n))
         if (maxval(s(:n, 1)**2 + s(:n, 2)**2) <= small_variation**2) then
            call integrate(self, law, two_points, both_equal, moments)
         else
            call integrate(self, law, rule%node, rule%weight, moments)
         end if
         call newton_step(self, moments, change)
         do i = 1, n
            rate(i) = max(rate(i)*self%b(i)/(a(i, 0)*m(i, 1) + a(i, 1)*s(i, 1)), tiny(rate))
         end do
         call law%first_stress(n, rate, stress)
         m(:n, 1) = sign(stress(:n), self%b(:n))
         m(:n, 2) = max(-abs(s(:n, 2)), min(abs(s(:n, 2)), change(:n, 2)))
      end associate
   end subroutine start

   !> T_0^(-1) (B e_x - rate).
   pure subroutine newton_step(self, moments, change)
      type(film_stress_t), intent(in) :: self
      type(moments_t), intent(in) :: moments
      real(dp), intent(out) :: change(block_size, 2)   !! of sigma_m
      real(dp) :: inverse, left_x, left_y, t(block_size, 3)
      integer :: i

      call dyads(self, moments, 0, t)
      associate (m => self%mean, s => self%sigma, a => moments%a)
         do i = 1, self%n
            left_x = self%b(i) - a(i, 0)*m(i, 1) - a(i, 1)*s(i, 1)
            left_y = -a(i, 0)*m(i, 2) - a(i, 1)*s(i, 2)
            inverse = 1/(t(i, 1)*t(i, 3) - t(i, 2)**2)
            change(i, 1) = (t(i, 3)*left_x - t(i, 2)*left_y)*inverse
            change(i, 2) = (t(i, 1)*left_y - t(i, 2)*left_x)*inverse
         end do
      end associate
   end subroutine newton_step

   !> T_k: components xx, xy and yy.
   pure subroutine dyads(self, moments, k, t)
      type(film_stress_t), intent(in) :: self
      type(moments_t), intent(in) :: moments
      integer, intent(in) :: k
      real(dp), intent(out) :: t(block_size, 3)
      integer :: i

      associate (m => self%mean, s => self%sigma, a => moments%a, e => moments%e)
         do i = 1, self%n
            t(i, 1) = a(i, k) + e(i, k)*m(i, 1)**2 + 2*e(i, k + 1)*m(i, 1)*s(i, 1) + e(i, k + 2)*s(i, 1)**2
            t(i, 2) = e(i, k)*m(i, 1)*m(i, 2) + e(i, k + 1)*(m(i, 1)*s(i, 2) + m(i, 2)*s(i, 1)) + e(i, k + 2)*s(i, 1)*s(i, 2)
            t(i, 3) = a(i, k) + e(i, k)*m(i, 2)**2 + 2*e(i, k + 1)*m(i, 2)*s(i, 2) + e(i, k + 2)*s(i, 2)**2
         end do
      end associate
   end subroutine dyads

   !> Flow and its derivatives from the moments at the last sigma_m and the last step.
   pure subroutine finish(self, moments, change)
      type(film_stress_t), intent(inout) :: self
      type(moments_t), intent(in) :: moments
      real(dp), intent(in) :: change(block_size, 2)
      real(dp), dimension(block_size, 3) :: t0, t1, t2
      real(dp) :: inverse, xx, xy, yx, yy
      integer :: i

      call dyads(self, moments, 0, t0)
      call dyads(self, moments, 1, t1)
      call dyads(self, moments, 2, t2)
      associate (m => self%mean, s => self%sigma, a => moments%a)
         do i = 1, self%n
            inverse = 1/(t0(i, 1)*t0(i, 3) - t0(i, 2)**2)
            xx = (t0(i, 3)*t1(i, 1) - t0(i, 2)*t1(i, 2))*inverse      ! T_0^(-1) T_1
            yx = (t0(i, 1)*t1(i, 2) - t0(i, 2)*t1(i, 1))*inverse
            xy = (t0(i, 3)*t1(i, 2) - t0(i, 2)*t1(i, 3))*inverse
            yy = (t0(i, 1)*t1(i, 3) - t0(i, 2)*t1(i, 2))*inverse
            self%flow_by_b(i, 1) = xx
            self%flow_by_b(i, 2) = xy
            self%flow_by_sigma(i, 1, 1) = t2(i, 1) - t1(i, 1)*xx - t1(i, 2)*yx
            self%flow_by_sigma(i, 2, 1) = t2(i, 2) - t1(i, 2)*xx - t1(i, 3)*yx
            self%flow_by_sigma(i, 1, 2) = self%flow_by_sigma(i, 2, 1)
            self%flow_by_sigma(i, 2, 2) = t2(i, 3) - t1(i, 2)*xy - t1(i, 3)*yy
            self%flow(i, 1) = a(i, 1)*m(i, 1) + a(i, 2)*s(i, 1) + change(i, 1)*t1(i, 1) + change(i, 2)*t1(i, 2)
            self%flow(i, 2) = a(i, 1)*m(i, 2) + a(i, 2)*s(i, 2) + change(i, 1)*t1(i, 2) + change(i, 2)*t1(i, 3)
            self%mean(i, 1) = m(i, 1) + change(i, 1)
            self%mean(i, 2) = m(i, 2) + change(i, 2)
         end do
      end associate
   end subroutine finish

   !> Moments a_0..a_2 and e_0..e_4 by quadrature.
   pure subroutine integrate(self, law, node, weight, moments)
      type(film_stress_t), intent(in) :: self
      class(flow_law_t), intent(in) :: law
      real(dp), intent(in) :: node(:), weight(:)
      type(moments_t), intent(out) :: moments
      real(dp), dimension(block_size) :: s, slope, stress2
      real(dp) :: e, w, z
      integer :: i, k

      moments%a(:self%n, :) = 0
      moments%e(:self%n, :) = 0
      do k = 1, size(node)
         z = node(k)
         do i = 1, self%n
            stress2(i) = (self%mean(i, 1) + z*self%sigma(i, 1))**2 + (self%mean(i, 2) + z*self%sigma(i, 2))**2
         end do
         call law%shear_factor(self%n, stress2, s, slope)
         w = 0.5_dp*weight(k)
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
