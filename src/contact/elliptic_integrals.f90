!> Complete elliptic integrals, and the ellipticity of a Hertzian contact.
module ehlwave_elliptic_integrals
   use ehlwave_kinds, only: dp, pi
   implicit none (type, external)
   private
   public :: complete_elliptic, ellipticity_integrals, line_integrals, radius_ratio, ellipticity

   integer, parameter :: max_iterations = 60

   !> K, E and the combinations of them that appear in the Hertz relations, theory eq. (1) to (6).
   !> The quotients have removable singularities at kappa = 1, so they are summed, never divided out.
   type, public :: ellipticity_integrals_t
      real(dp) :: kappa       !! ellipticity a/b, 0 < kappa <= 1; 0: line contact
      real(dp) :: k, e        !! complete elliptic integrals of parameter m = 1 - kappa^2
      real(dp) :: b_over_m    !! (E - kappa^2 K)/m,  pi/4 at kappa = 1
      real(dp) :: d_over_m    !! (K - E)/m,          pi/4 at kappa = 1
   end type ellipticity_integrals_t

contains

   !> K, E, (E - (1-m) K)/m and (K - E)/m for parameter 0 <= m < 1, by the arithmetic-geometric mean.
   !>
   !> With c_0^2 = m, c_(n+1) = (a_n - b_n)/2:  K = pi/(2 a_inf),  K - E = K * sum_n 2^(n-1) c_n^2
   !> (Abramowitz and Stegun 17.6). The sum divided by m is taken with c_n^2/m, so nothing cancels.
   pure subroutine complete_elliptic(m, k, e, b_over_m, d_over_m)
      real(dp), intent(in) :: m                          !! parameter, square of the modulus
      real(dp), intent(out) :: k, e, b_over_m, d_over_m
      real(dp) :: a, b, c2_over_m, total, power, next
      integer :: n

      a = 1
      b = sqrt(1 - m)
      total = 0.5_dp                                     ! n = 0: 2^(-1) c_0^2 / m
      power = 1
      ! c_1 = (1 - b)/2 = m / (2 (1 + b)), so c_1^2 / m = m / (4 (1 + b)^2)
      c2_over_m = m/(4*(1 + b)**2)
      do n = 1, max_iterations
         total = total + power*c2_over_m
         power = 2*power
         next = 0.5_dp*(a + b)
         b = sqrt(a*b)
         a = next
         if (abs(a - b) <= 4*epsilon(1.0_dp)*a) exit
         ! c_(n+1) = c_n^2 / (4 a_(n+1))
         c2_over_m = m*(c2_over_m/(4*0.5_dp*(a + b)))**2
      end do
      k = pi/(2*a)
      d_over_m = k*total
      e = k - m*d_over_m
      b_over_m = k - d_over_m
   end subroutine complete_elliptic

   !> All integrals at an ellipticity 0 < kappa <= 1.
   pure function ellipticity_integrals(kappa) result(self)
      real(dp), intent(in) :: kappa
      type(ellipticity_integrals_t) :: self
      self%kappa = kappa
      call complete_elliptic(1 - kappa**2, self%k, self%e, self%b_over_m, self%d_over_m)
   end function ellipticity_integrals

   !> Their values for a line contact, kappa = 0, where K is infinite: E = 1 and, since its lengths c and film H
   !> are scaled without K, K = 1.
   pure function line_integrals() result(self)
      type(ellipticity_integrals_t) :: self
      self = ellipticity_integrals_t(kappa=0.0_dp, k=1.0_dp, e=1.0_dp, b_over_m=1.0_dp, d_over_m=huge(1.0_dp))
   end function line_integrals

   !> D = Rx/Ry = kappa^2 (K - E)/(E - kappa^2 K), theory eq. (1).
   pure function radius_ratio(kappa) result(d)
      real(dp), intent(in) :: kappa
      real(dp) :: d
      type(ellipticity_integrals_t) :: s
      s = ellipticity_integrals(kappa)
      d = kappa**2*s%d_over_m/s%b_over_m
   end function radius_ratio

   !> Ellipticity kappa = a/b of a contact with D = Rx/Ry, 0 < D <= 1: solves eq. (1) by bisection
   !> in log kappa, to rounding. D grows monotonically with kappa and D >= kappa^2 (equal at 1).
   pure function ellipticity(d) result(kappa)
      real(dp), intent(in) :: d
      real(dp) :: kappa
      real(dp) :: low, high
      integer :: i

      if (d >= 1) then
         kappa = 1
         return
      end if
      low = 0.25_dp*d
      high = 1
      do i = 1, 200
         kappa = sqrt(low*high)
         if (kappa <= low .or. kappa >= high) exit
         if (radius_ratio(kappa) > d) then
            high = kappa
         else
            low = kappa
         end if
      end do
   end function ellipticity

end module ehlwave_elliptic_integrals
