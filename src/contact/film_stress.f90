!> The stress across the film of a generalised Newtonian oil: its mean from the sliding speed, and the flow.
!>
!> With the moments a_k = 1/2 integral zeta^k s dzeta and e_k = integral zeta^k ds/d(|sigma|^2) dzeta everything is
!> algebra:
!>
!>     rate  1/2 integral s sigma dzeta      = a_0 sigma_m + a_1 Sigma
!>     flow  1/2 integral zeta s sigma dzeta = a_1 sigma_m + a_2 Sigma
!>     T_k = a_k I + e_k mm + e_(k+1) (mS + Sm) + e_(k+2) SS     (dyads of m = sigma_m and S = Sigma)
!>
!> with T_0, T_1 the derivatives of the rate by sigma_m and Sigma, T_1, T_2 those of the flow: theory eq. (S11).
!>
!> Where the oil is warm, s is multiplied by its fluidity at each place across the film over that for which B is; where
!> its stress is limited, by the factor of the limit (`ehlwave_shear_limit`).
module ehlwave_film_stress
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_gauss_legendre, only: gauss_rule_t
   use ehlwave_kinds, only: dp
   use ehlwave_shear_limit, only: shear_limit_t
   implicit none (type, external)
   private

   integer, parameter, public :: block_size = 64     !! places solved at once
   integer, parameter :: most_steps = 60             ! of Newton; 15 were the most met for |B| to 1e6, |Sigma| to 60
   ! of the last step, which is still made: it leaves an error of its square, times the stress where that is small
   real(dp), parameter :: newton_tolerance = 1e-6_dp
   ! |Sigma| up to which a few points across the film make a first guess
   real(dp), parameter :: small_variation = 2.5_dp
   ! Rules of Gauss for that: the positive nodes, and half their weights
   real(dp), parameter :: node_of_two(1) = 1/sqrt(3.0_dp), half_weight_of_two(1) = 0.5_dp
   real(dp), parameter :: nodes_of_four(2) = sqrt([3 - sqrt(4.8_dp), 3 + sqrt(4.8_dp)]/7), &
                          half_weights_of_four(2) = (18 + [1, -1]*sqrt(30.0_dp))/72

   !> Places 1..n of a block. The last index is the component along X or Y.
   type, public :: film_stress_t
      integer :: n = 0
      integer :: points = 0                          !! across the film at which the oil was asked, over all places and
                                                     !! steps
      real(dp) :: sigma(block_size, 2)               !! Sigma, half the change of the stress across the film
      real(dp) :: b(block_size)                      !! B, dimensionless shear rate along X
      real(dp) :: mean(block_size, 2)                !! sigma_m
      real(dp) :: flow(block_size, 2)                !! 1/2 integral zeta s sigma dzeta
      real(dp) :: flow_by_b(block_size, 2)           !! its derivative by B, sigma_m following
      real(dp) :: flow_by_sigma(block_size, 2, 2)    !! by Sigma, sigma_m following
      real(dp), allocatable :: fluidity(:, :)        !! (block_size, points of the rule or more) of an oil that is warm
      real(dp), allocatable :: moments(:, :)         !! (block_size, 0:2) of it, where they are all that counts
      type(shear_limit_t), allocatable :: limit      !! of the stress, if there is one,
      real(dp) :: inverse_square(block_size)         !! 1/sigma_L^2,
      real(dp) :: by_sigma2(block_size)              !! its derivative by |Sigma|^2,
      real(dp) :: flow_by_limit(block_size, 2)       !! and the derivative of the flow by it
   contains
      procedure :: solve
   end type film_stress_t

   !> Moments at the places of a block.
   type :: moments_t
      real(dp) :: a(block_size, 0:2), e(block_size, 0:4)
      real(dp) :: by_limit(block_size, 0:2)   !! of a by 1/sigma_L^2
   end type moments_t

contains

   !> Newton for sigma_m; the flow is corrected to second order by the last step.
   pure subroutine solve(self, law, rule, is_slight, sigma, b)
      class(film_stress_t), intent(inout) :: self
      class(flow_law_t), intent(in) :: law
      type(gauss_rule_t), intent(in) :: rule
      logical, intent(in) :: is_slight      !! whether stresses are so small that B itself is a good first guess of them
      real(dp), intent(in) :: sigma(:, :)   !! Sigma, (places, 2), at most block_size of them
      real(dp), intent(in) :: b(:)          !! B, (places)
      type(moments_t) :: moments
      real(dp) :: change(block_size, 2), t0(block_size, 3)
      real(dp), dimension(block_size) :: length2, range2, stress2
      integer :: i, step

      self%n = size(b)
      self%sigma(:self%n, :) = sigma
      self%b(:self%n) = b
      self%points = 0
      if (allocated(self%moments)) then
         call solve_newtonian(self)
         return
      end if
      self%mean(:self%n, 1) = b
      self%mean(:self%n, 2) = 0
      if (allocated(self%fluidity) .or. allocated(self%limit)) then
         if (.not. all(abs(b) <= 0)) call start_weighted(self, law, rule)
      else if (.not. (is_slight .or. all(abs(b) <= 0))) then
         call start(self, law, rule)
      end if
      do step = 1, most_steps
         call integrate_by(self, law, rule, moments)
         call newton_step(self, moments, change, t0)
         do i = 1, self%n
            stress2(i) = self%mean(i, 1)**2 + self%mean(i, 2)**2
            range2(i) = 1
            if (law%is_power) range2(i) = max(1.0_dp, stress2(i))
            stress2(i) = stress2(i) + self%sigma(i, 1)**2 + self%sigma(i, 2)**2
            length2(i) = change(i, 1)**2 + change(i, 2)**2
         end do
         associate (n => self%n)
            if (all(length2(:n)*min(1.0_dp, sqrt(stress2(:n))) <= newton_tolerance**2*range2(:n)) &
                .and. is_exact(self, moments)) exit
         end associate
         do i = 1, self%n
            self%mean(i, :) = self%mean(i, :) + min(1.0_dp, sqrt(range2(i)/max(length2(i), tiny(length2))))*change(i, :)
         end do
      end do
      call finish(self, moments, change, t0)
   end subroutine solve

   !> The same of a Newtonian oil that is warm, whose rate is linear in the stress: T_k = a_k I.
   pure subroutine solve_newtonian(self)
      class(film_stress_t), intent(inout) :: self
      real(dp) :: share, slope
      integer :: i

      self%points = self%n
      associate (a => self%moments, s => self%sigma)
         do i = 1, self%n
            share = a(i, 1)/a(i, 0)
            slope = a(i, 2) - a(i, 1)*share
            self%mean(i, 1) = self%b(i)/a(i, 0) - share*s(i, 1)
            self%mean(i, 2) = -share*s(i, 2)
            self%flow(i, 1) = share*self%b(i) + slope*s(i, 1)
            self%flow(i, 2) = slope*s(i, 2)
            self%flow_by_b(i, 1) = share
            self%flow_by_b(i, 2) = 0
            self%flow_by_sigma(i, 1, 1) = slope
            self%flow_by_sigma(i, 2, 1) = 0
            self%flow_by_sigma(i, 1, 2) = 0
            self%flow_by_sigma(i, 2, 2) = slope
         end do
      end associate
   end subroutine solve_newtonian

   !> Whether the rate is B where the stress is limited: there it hardly depends on it.
   pure logical function is_exact(self, moments)
      type(film_stress_t), intent(in) :: self
      type(moments_t), intent(in) :: moments
      integer :: i
      is_exact = .true.
      if (.not. allocated(self%limit)) return
      associate (m => self%mean, s => self%sigma, a => moments%a, b => self%b)
         do i = 1, self%n
            is_exact = is_exact .and. abs(b(i) - a(i, 0)*m(i, 1) - a(i, 1)*s(i, 1)) <= &
                       newton_tolerance*max(abs(b(i)), a(i, 0)*abs(m(i, 1)), abs(a(i, 1)*s(i, 1)))
         end do
      end associate
   end function is_exact

   !> First sigma_m of an oil that is warm or whose stress is limited: that of B over the mean fluidity, and then what
   !> the limit leaves of it, by Newton for ln(rate) against y = -ln(1 - sigma/sigma_L).
   pure subroutine start_weighted(self, law, rule)
      type(film_stress_t), intent(inout) :: self
      class(flow_law_t), intent(in) :: law
      type(gauss_rule_t), intent(in) :: rule
      integer, parameter :: steps = 8
      real(dp), dimension(block_size) :: largest, rate, s, slope, stress, y
      real(dp) :: share, w, w_slope
      integer :: i, step

      associate (n => self%n)
         rate(:n) = max(abs(self%b(:n)), tiny(rate))
         if (allocated(self%fluidity)) rate(:n) = rate(:n)/(0.5_dp*matmul(self%fluidity(:n, :rule%n), rule%weight))
         call law%first_stress(n, rate, stress)
         if (allocated(self%limit)) then
            do i = 1, n
               largest(i) = 1/sqrt(self%inverse_square(i))
               y(i) = min(stress(i)/largest(i), 0.5_dp)
            end do
            do step = 1, steps
               do i = 1, n
                  stress(i) = largest(i)*(1 - exp(-y(i)))
               end do
               call law%shear_factor(n, stress(:n)**2, s, slope)
               do i = 1, n
                  share = 1 - exp(-y(i))
                  call self%limit%factor(share**2, w, w_slope)
                  y(i) = max(0.5_dp*y(i), y(i) - log(s(i)*w*stress(i)/rate(i))/(exp(-y(i))* &
                     (1/share + 2*slope(i)/s(i)*share*largest(i)**2 + 2*share*w_slope/w)))
               end do
            end do
         end if
         self%mean(:n, 1) = sign(stress(:n), self%b(:n))
      end associate
   end subroutine start_weighted

   !> First sigma_m: that of B alone, then across sliding what leaves no rate there, -a_1 Sigma_y/a_0, and along it the
   !> stress for B over what the rate is too large by, both as if s kept its shape: exact for Ree-Eyring without
   !> gradient across sliding. Where Sigma is small fewer points across the film tell the rate: an error of the fourth
   !> or eighth order.
   pure subroutine start(self, law, rule)
      type(film_stress_t), intent(inout) :: self
      class(flow_law_t), intent(in) :: law
      type(gauss_rule_t), intent(in) :: rule
      type(moments_t) :: moments
      real(dp) :: across, found, rate(block_size), stress(block_size)
      integer :: i

      associate (n => self%n, m => self%mean, s => self%sigma, a => moments%a, e => moments%e)
         rate(:n) = max(abs(self%b(:n)), tiny(rate))
         call law%first_stress(n, rate, stress)
         m(:n, 1) = sign(stress(:n), self%b(:n))
         if (rule%n == 2) return                    ! no variation to speak of
         if (rule%n == 4) then
            call integrate(self, law, node_of_two, half_weight_of_two, moments)
         else if (maxval(s(:n, 1)**2 + s(:n, 2)**2) <= small_variation**2) then
            call integrate(self, law, nodes_of_four, half_weights_of_four, moments)
         else
            call integrate_by(self, law, rule, moments)
         end if
         do i = 1, n
            across = -s(i, 2)*a(i, 1)/a(i, 0)
            found = a(i, 0)*m(i, 1) + a(i, 1)*s(i, 1) + 0.5_dp*across**2*(e(i, 0)*m(i, 1) + e(i, 1)*s(i, 1)) &
                    + across*s(i, 2)*(e(i, 1)*m(i, 1) + e(i, 2)*s(i, 1))
            m(i, 2) = across
            rate(i) = max(rate(i)*self%b(i)/found, tiny(rate))
         end do
         call law%first_stress(n, rate, stress)
         m(:n, 1) = sign(stress(:n), self%b(:n))
      end associate
   end subroutine start

   !> T_0^(-1) (B e_x - rate).
   pure subroutine newton_step(self, moments, change, t)
      type(film_stress_t), intent(in) :: self
      type(moments_t), intent(in) :: moments
      real(dp), intent(out) :: change(block_size, 2)   !! of sigma_m
      real(dp), intent(out) :: t(block_size, 3)        !! T_0
      real(dp) :: inverse, left_x, left_y
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
            t(i, 2) = e(i, k)*m(i, 1)*m(i, 2) + e(i, k + 1)*(m(i, 1)*s(i, 2) + m(i, 2)*s(i, 1)) &
               + e(i, k + 2)*s(i, 1)*s(i, 2)
            t(i, 3) = a(i, k) + e(i, k)*m(i, 2)**2 + 2*e(i, k + 1)*m(i, 2)*s(i, 2) + e(i, k + 2)*s(i, 2)**2
         end do
      end associate
   end subroutine dyads

   !> Flow and its derivatives from the moments at the last sigma_m and the last step.
   pure subroutine finish(self, moments, change, t0)
      type(film_stress_t), intent(inout) :: self
      type(moments_t), intent(in) :: moments
      real(dp), intent(in) :: change(block_size, 2), t0(block_size, 3)
      real(dp), dimension(block_size, 3) :: t1, t2
      real(dp) :: inverse, xx, xy, yx, yy
      integer :: i

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
            if (allocated(self%limit)) call limit_flow(self, moments, i, [xx, xy], [yx, yy])
            self%mean(i, 1) = m(i, 1) + change(i, 1)
            self%mean(i, 2) = m(i, 2) + change(i, 2)
         end do
      end associate

   end subroutine finish

   !> Derivative of the flow of a place by 1/sigma_L^2, sigma_m following: that at fixed stress less T_1 T_0^(-1) times
   !> that of the rate.
   pure subroutine limit_flow(self, moments, i, first, second)
      type(film_stress_t), intent(inout) :: self
      type(moments_t), intent(in) :: moments
      integer, intent(in) :: i
      real(dp), intent(in) :: first(2), second(2)   !! rows of T_0^(-1) T_1
      real(dp) :: rate(2)
      integer :: j
      associate (c => moments%by_limit, m => self%mean, s => self%sigma)
         rate = c(i, 0)*m(i, :) + c(i, 1)*s(i, :)
         self%flow_by_limit(i, :) = c(i, 1)*m(i, :) + c(i, 2)*s(i, :) - first*rate(1) - second*rate(2)
         do j = 1, 2
            self%flow_by_sigma(i, :, j) = self%flow_by_sigma(i, :, j) &
               + 2*self%by_sigma2(i)*s(i, j)*self%flow_by_limit(i, :)
         end do
      end associate
   end subroutine limit_flow

   !> Moments by a rule, whose nodes ascend from -1 to 1.
   pure subroutine integrate_by(self, law, rule, moments)
      type(film_stress_t), intent(inout) :: self
      class(flow_law_t), intent(in) :: law
      type(gauss_rule_t), intent(in) :: rule
      type(moments_t), intent(out) :: moments
      call integrate(self, law, rule%node(rule%n/2 + 1:), 0.5_dp*rule%weight(rule%n/2 + 1:), moments)
   end subroutine integrate_by

   !> Moments a_0..a_2 and e_0..e_4 by quadrature over pairs of points, zeta and -zeta.
   pure subroutine integrate(self, law, node, half_weight, moments)
      type(film_stress_t), intent(inout) :: self
      class(flow_law_t), intent(in) :: law
      real(dp), intent(in) :: node(:)          !! the positive ones
      real(dp), intent(in) :: half_weight(:)   !! half the weight of each
      type(moments_t), intent(out) :: moments
      real(dp), dimension(2*block_size) :: s, slope, stress2   ! those of zeta, then those of -zeta
      real(dp), dimension(block_size) :: mean2, both, sigma2
      real(dp) :: by_even, by_odd, even, odd, w, z, z2
      integer :: i, k

      associate (n => self%n, m => self%mean, sigma => self%sigma, a => moments%a, e => moments%e)
         self%points = self%points + 2*n*size(node)
         a(:n, :) = 0
         e(:n, :) = 0
         if (allocated(self%limit)) moments%by_limit(:n, :) = 0
         do i = 1, n
            mean2(i) = m(i, 1)**2 + m(i, 2)**2
            both(i) = 2*(m(i, 1)*sigma(i, 1) + m(i, 2)*sigma(i, 2))
            sigma2(i) = sigma(i, 1)**2 + sigma(i, 2)**2
         end do
         do k = 1, size(node)
            z = node(k)
            do i = 1, n
               stress2(i) = abs(mean2(i) + z*both(i) + z**2*sigma2(i))   ! of rounding alone below 0
               stress2(n + i) = abs(mean2(i) - z*both(i) + z**2*sigma2(i))
            end do
            call law%shear_factor(2*n, stress2, s, slope)
            w = half_weight(k)
            z2 = z**2
            if (allocated(self%limit)) call apply_limit(self, [size(node), k], z, w, stress2, s, slope, moments)
            if (allocated(self%fluidity)) then
               do i = 1, n
                  s(i) = self%fluidity(i, size(node) + k)*s(i)
                  slope(i) = self%fluidity(i, size(node) + k)*slope(i)
                  s(n + i) = self%fluidity(i, size(node) + 1 - k)*s(n + i)
                  slope(n + i) = self%fluidity(i, size(node) + 1 - k)*slope(n + i)
               end do
            end if
            do i = 1, n
               even = w*(s(i) + s(n + i))
               odd = (w*z)*(s(i) - s(n + i))
               by_even = (2*w)*(slope(i) + slope(n + i))
               by_odd = (2*w*z)*(slope(i) - slope(n + i))
               a(i, 0) = a(i, 0) + even
               a(i, 1) = a(i, 1) + odd
               a(i, 2) = a(i, 2) + z2*even
               e(i, 0) = e(i, 0) + by_even
               e(i, 1) = e(i, 1) + by_odd
               e(i, 2) = e(i, 2) + z2*by_even
               e(i, 3) = e(i, 3) + z2*by_odd
               e(i, 4) = e(i, 4) + z2**2*by_even
            end do
         end do
      end associate

   end subroutine integrate

   !> s and its slope times the factor of the limit, and what the pair of points adds to the derivatives of the moments
   !> by 1/sigma_L^2.
   pure subroutine apply_limit(self, pair, z, w, stress2, s, slope, moments)
      type(film_stress_t), intent(in) :: self
      integer, intent(in) :: pair(2)                    !! number of pairs, and which
      real(dp), intent(in) :: z, w                      !! its positive node and half its weight
      real(dp), intent(in) :: stress2(:)                !! at it and at its negative
      real(dp), intent(inout) :: s(:), slope(:)
      type(moments_t), intent(inout) :: moments
      real(dp) :: by_inverse(2*block_size), factor, factor_slope
      integer :: i, l

      associate (n => self%n)
         do i = 1, 2*n
            associate (inverse => self%inverse_square(modulo(i - 1, n) + 1))
               call self%limit%factor(stress2(i)*inverse, factor, factor_slope)
               slope(i) = factor*slope(i) + s(i)*factor_slope*inverse
               by_inverse(i) = s(i)*factor_slope*stress2(i)
               s(i) = factor*s(i)
            end associate
         end do
         do i = 1, n
            if (allocated(self%fluidity)) then
               by_inverse(i) = self%fluidity(i, pair(1) + pair(2))*by_inverse(i)
               by_inverse(n + i) = self%fluidity(i, pair(1) + 1 - pair(2))*by_inverse(n + i)
            end if
            do l = 0, 2
               moments%by_limit(i, l) = moments%by_limit(i, l) + w*(z**l*by_inverse(i) + (-z)**l*by_inverse(n + i))
            end do
         end do
      end associate
   end subroutine apply_limit

end module ehlwave_film_stress
