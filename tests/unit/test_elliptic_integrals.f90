!> Elliptic integrals against quadrature of their definitions, and the ellipticity of eq. (1).
program test_elliptic_integrals
   use ehlwave_elliptic_integrals, only: complete_elliptic, ellipticity, ellipticity_integrals, &
      ellipticity_integrals_t, radius_ratio
   use ehlwave_kinds, only: dp, pi
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: rounding = 1e-14_dp
   type(test_t) :: test

   call compare_with_quadrature()
   call check_limits()
   call check_ellipticity()
   call test%finish()

contains

   !> The trapezoidal rule converges geometrically for these periodic integrands.
   subroutine compare_with_quadrature()
      integer, parameter :: points = 20000
      real(dp), parameter :: m(5) = [0.1_dp, 0.5_dp, 0.9_dp, 0.99_dp, 0.9995_dp]
      real(dp) :: angle, b, d, e, k, sum_k, sum_e
      integer :: i, n

      do n = 1, size(m)
         sum_k = 0
         sum_e = 0
         do i = 0, points - 1
            angle = 2*pi*i/points
            sum_k = sum_k + 1/sqrt(1 - m(n)*sin(angle)**2)
            sum_e = sum_e + sqrt(1 - m(n)*sin(angle)**2)
         end do
         call complete_elliptic(m(n), k, e, b, d)
         call test%check_close(k, sum_k*pi/(2*points), 'K against quadrature', relative=1e-12_dp)
         call test%check_close(e, sum_e*pi/(2*points), 'E against quadrature', relative=1e-12_dp)
         call test%check_close(b, (e - (1 - m(n))*k)/m(n), '(E - kappa^2 K)/m', relative=1e-13_dp)
         call test%check_close(d, (k - e)/m(n), '(K - E)/m', relative=1e-13_dp)
      end do
      call complete_elliptic(0.5_dp, k, e, b, d)      ! Abramowitz and Stegun, table 17.1
      call test%check_close(k, 1.854074677301372_dp, 'K(0.5)', relative=rounding)
      call test%check_close(e, 1.350643881047675_dp, 'E(0.5)', relative=rounding)
   end subroutine compare_with_quadrature

   subroutine check_limits()
      type(ellipticity_integrals_t) :: at_one, near_one
      real(dp), parameter :: small = 1e-9_dp

      at_one = ellipticity_integrals(1.0_dp)
      call test%check_close([at_one%k, at_one%e, at_one%b_over_m, at_one%d_over_m], &
                            [pi/2, pi/2, pi/4, pi/4], 'limits at kappa = 1', relative=rounding)
      ! with m = 1 - kappa^2: pi/4 (1 + m/8) and pi/4 (1 + 3 m/8), no cancellation
      near_one = ellipticity_integrals(1 - small)
      call test%check_close(near_one%b_over_m, pi/4*(1 + small/4), 'next to kappa = 1', relative=rounding)
      call test%check_close(near_one%d_over_m, pi/4*(1 + 3*small/4), 'next to kappa = 1', relative=rounding)
   end subroutine check_limits

   subroutine check_ellipticity()
      real(dp), parameter :: d(6) = [0.005_dp, 0.04_dp, 0.12_dp, 0.35_dp, 0.9_dp, 0.999999_dp]
      integer :: i

      call test%check_close(ellipticity(1.0_dp), 1.0_dp, 'kappa(D = 1)', relative=rounding)
      call test%check_close([ellipticity(0.35_dp), ellipticity(0.12_dp), ellipticity(0.04_dp)], &
                            [0.49834356_dp, 0.24942794_dp, 0.12588195_dp], 'kappa of the reference table', relative=3e-8_dp)
      do i = 1, size(d)
         call test%check_close(radius_ratio(ellipticity(d(i))), d(i), 'D(kappa(D))', relative=1e-13_dp)
      end do
      ! 1 - kappa -> (2/3)(1 - D)
      call test%check_close(1 - ellipticity(0.999999_dp), 2e-6_dp/3, 'next to the circular contact', relative=1e-5_dp)
   end subroutine check_ellipticity

end program test_elliptic_integrals
