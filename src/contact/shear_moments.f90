!> Moments, across the film, of how an oil shears under a stress that varies linearly from surface to surface.
!>
!> sigma(zeta) = sigma_m + zeta Sigma, -1 <= zeta <= 1, in units of tau0. With the factor s of the flow law
!>
!>     a_k = 1/2 integral zeta^k s dzeta,   e_k = integral zeta^k ds/d(|sigma|^2) dzeta
!>
!>     T_k = a_k I + e_k mm + e_(k+1) (mS + Sm) + e_(k+2) SS     (dyads of m = sigma_m and S = Sigma)
!>
!> are all that the rate, the flow and their derivatives take: theory eq. (S11), `ehlwave_film_stress`. Where the oil is
!> warm, s is multiplied by its fluidity at each place across the film over that for which the stress is found; where
!> its stress is limited, by the factor of the limit (`ehlwave_shear_limit`).
module ehlwave_shear_moments
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_gauss_legendre, only: gauss_rule_t
   use ehlwave_kinds, only: dp
   use ehlwave_shear_limit, only: shear_limit_t
   implicit none (type, external)
   private
   public :: dyads, integrate, integrate_by

   integer, parameter, public :: block_size = 64     !! places solved at once

   !> Places 1..n of a block and the stress there. The last index of two is the component along X or Y.
   type, public :: film_block_t
      integer :: n = 0
      integer :: points = 0                          !! across the film at which the oil was asked, over all places and
                                                     !! steps
      real(dp) :: sigma(block_size, 2)               !! Sigma, half the change of the stress across the film
      real(dp) :: b(block_size)                      !! B, dimensionless shear rate along X
      real(dp) :: mean(block_size, 2)                !! sigma_m
      real(dp), allocatable :: fluidity(:, :)        !! (block_size, points of the rule or more) of an oil that is warm
      real(dp), allocatable :: moments(:, :)         !! (block_size, 0:2) of it, where they are all that counts
      type(shear_limit_t), allocatable :: limit      !! limit of the stress, if any,
      real(dp) :: inverse_square(block_size)         !! 1/sigma_L^2,
      real(dp) :: by_sigma2(block_size)              !! derivative by |Sigma|^2
   end type film_block_t

   !> Moments at the places of a block.
   type, public :: moments_t
      real(dp) :: a(block_size, 0:2), e(block_size, 0:4)
      real(dp) :: by_limit(block_size, 0:2)   !! derivative of a by 1/sigma_L^2
   end type moments_t

contains

   !> Moments at sigma_m by a rule for the whole film, whose nodes ascend from -1 to 1.
   pure subroutine integrate_by(self, law, rule, moments)
      class(film_block_t), intent(inout) :: self
      class(flow_law_t), intent(in) :: law
      type(gauss_rule_t), intent(in) :: rule
      type(moments_t), intent(out) :: moments
      call integrate(self, law, rule%node(rule%n/2 + 1:), 0.5_dp*rule%weight(rule%n/2 + 1:), moments)
   end subroutine integrate_by

   !> Moments a_0..a_2 and e_0..e_4 at sigma_m by quadrature over pairs of points, zeta and -zeta; with a limit also the
   !> derivatives of a by it. Places beyond n are left alone.
   pure subroutine integrate(self, law, node, half_weight, moments)
      class(film_block_t), intent(inout) :: self
      class(flow_law_t), intent(in) :: law
      real(dp), intent(in) :: node(:)          !! the positive points
      real(dp), intent(in) :: half_weight(:)   !! half the weight of each
      type(moments_t), intent(out) :: moments  !! moments at places 1..n
      real(dp), dimension(2*block_size) :: s, slope, stress2   ! values at zeta, then at -zeta
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
               stress2(i) = abs(mean2(i) + z*both(i) + z**2*sigma2(i))   ! only rounding makes it negative
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

   !> s and its slope times the factor of the limit, and the terms of the pair of points in the derivatives of the
   !> moments by 1/sigma_L^2.
   pure subroutine apply_limit(self, pair, z, w, stress2, s, slope, moments)
      class(film_block_t), intent(in) :: self
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

   !> T_k: components xx, xy and yy, of the places 1..n.
   pure subroutine dyads(self, moments, k, t)
      class(film_block_t), intent(in) :: self
      type(moments_t), intent(in) :: moments
      integer, intent(in) :: k                         !! 0, 1 or 2
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

end module ehlwave_shear_moments
