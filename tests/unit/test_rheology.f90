!> Density and viscosity laws: values, derivatives against finite differences, no overflow.
program test_rheology
   use ehlwave_kinds, only: dp
   use ehlwave_rheology, only: density_constant, density_dowson_higginson, new_rheology, rheology_t, viscosity_barus, &
      viscosity_constant, viscosity_roelands
   use ehlwave_mcewen_law, only: mcewen_law_t
   use ehlwave_tait_density, only: tait_density_t
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: alphabar = 20, z = 0.68_dp, ph = 0.9e9_dp
   type(test_t) :: test

   call check_values()
   call check_derivatives()
   call check_special()
   call check_extremes()
   call test%finish()

contains

   subroutine at(rheology, p, rho, drho, fluidity, dln_eta)
      type(rheology_t), intent(in) :: rheology
      real(dp), intent(in) :: p
      real(dp), intent(out) :: rho, drho, fluidity, dln_eta
      real(dp) :: values(1, 4)
      call rheology%evaluate(1, [p], values(:, 1), values(:, 2), values(:, 3), values(:, 4))
      rho = values(1, 1)
      drho = values(1, 2)
      fluidity = values(1, 3)
      dln_eta = values(1, 4)
   end subroutine at

   subroutine check_values()
      type(rheology_t) :: rheology
      real(dp), parameter :: p = 0.7_dp, p0 = 1.96e8_dp, alpha = alphabar/ph
      real(dp) :: rho, drho, fluidity, dln_eta

      rheology = new_rheology(viscosity_roelands, density_dowson_higginson, alphabar, z, ph)
      call at(rheology, p, rho, drho, fluidity, dln_eta)
      call test%check_close(rho, (5.9e8_dp + 1.34_dp*ph*p)/(5.9e8_dp + ph*p), 'Dowson-Higginson', relative=1e-14_dp)
      call test%check_close(rheology%density(p), rho, 'density alone', relative=1e-15_dp)
      call test%check_close(1/fluidity, exp(alpha*p0/z*((1 + ph*p/p0)**z - 1)), 'Roelands', relative=1e-12_dp)
      call at(rheology, 0.0_dp, rho, drho, fluidity, dln_eta)
      call test%check_close([rho, fluidity, dln_eta], [1.0_dp, 1.0_dp, alphabar], 'ambient pressure', relative=1e-15_dp)

      rheology = new_rheology(viscosity_barus, density_constant, alphabar, z, ph)
      call at(rheology, p, rho, drho, fluidity, dln_eta)
      call test%check_close([rho, fluidity, dln_eta], [1.0_dp, exp(-alphabar*p), alphabar], 'Barus', relative=1e-13_dp)
      call test%check_close(rheology%density(p), 1.0_dp, 'incompressible', relative=1e-15_dp)

      rheology = new_rheology(viscosity_constant, density_constant, alphabar, z, ph)
      call at(rheology, p, rho, drho, fluidity, dln_eta)
      call test%check_close([rho, drho, fluidity, dln_eta], [1.0_dp, 0.0_dp, 1.0_dp, 0.0_dp], 'isoviscous', absolute=0.0_dp)
      rheology = new_rheology(viscosity_roelands, density_constant, 0.0_dp, z, 0.0_dp)
      call at(rheology, p, rho, drho, fluidity, dln_eta)
      call test%check_close([fluidity, dln_eta], [1.0_dp, 0.0_dp], 'alphabar = 0 is isoviscous', absolute=0.0_dp)
   end subroutine check_values

   subroutine check_derivatives()
      integer, parameter :: laws(3) = [viscosity_roelands, viscosity_barus, viscosity_constant]
      real(dp), parameter :: step = 1e-5_dp, pressure(3) = [0.01_dp, 0.5_dp, 1.1_dp]
      type(rheology_t) :: rheology
      real(dp) :: down(4), here(4), up(4)
      integer :: i, n

      do n = 1, size(laws)
         rheology = new_rheology(laws(n), density_dowson_higginson, alphabar, z, ph)
         do i = 1, size(pressure)
            call at(rheology, pressure(i) - step, down(1), down(2), down(3), down(4))
            call at(rheology, pressure(i), here(1), here(2), here(3), here(4))
            call at(rheology, pressure(i) + step, up(1), up(2), up(3), up(4))
            call test%check_close(here(2), (up(1) - down(1))/(2*step), 'd rho/dP', relative=1e-7_dp)
            call test%check_close(here(4), -log(up(3)/down(3))/(2*step), 'd ln(eta)/dP', relative=1e-7_dp, absolute=1e-12_dp)
         end do
      end do
   end subroutine check_derivatives

   !> A law of its own with Tait's density: the same laws in units of ph, at this Hertz pressure and another.
   subroutine check_special()
      type(mcewen_law_t), parameter :: mcewen = mcewen_law_t(alpha0_per_pa=2e-8_dp, exponent=9.0_dp)
      type(tait_density_t), parameter :: tait = tait_density_t(modulus_pa=1.2e9_dp, modulus_rate=11.0_dp)
      real(dp), parameter :: p = 0.7_dp, pressures(2) = [ph, 0.5_dp*ph]
      type(rheology_t) :: rheology
      real(dp) :: rho, drho, fluidity, dln_eta, x
      integer :: k

      rheology = new_rheology(viscosity_roelands, density_dowson_higginson, alphabar, z, ph)
      call rheology%use_viscosity(mcewen)
      call rheology%use_density(tait)
      do k = 1, size(pressures)
         if (k == 2) rheology = rheology%at_pressure(0.5_dp*alphabar, pressures(k))
         call at(rheology, p, rho, drho, fluidity, dln_eta)
         x = 1 + 2e-8_dp*pressures(k)*p/9
         call test%check_close([1/fluidity, dln_eta], [x**9, 2e-8_dp*pressures(k)/x], 'McEwen', relative=1e-12_dp)
         x = 1 + 12*pressures(k)*p/1.2e9_dp
         call test%check_close(1/rho, 1 - log(x)/12, 'Tait', relative=1e-13_dp)
         call test%check_close(drho, rho**2*pressures(k)/(1.2e9_dp*x), 'its derivative', relative=1e-13_dp)
         call test%check_close(rheology%density(p), rho, 'density alone', relative=1e-15_dp)
      end do
   end subroutine check_special

   !> No overflow at any pressure that an iterate can have; the builds with traps would stop here.
   subroutine check_extremes()
      type(rheology_t) :: rheology
      real(dp) :: rho, drho, fluidity, dln_eta
      integer, parameter :: laws(2) = [viscosity_roelands, viscosity_barus]
      integer :: n

      do n = 1, size(laws)
         rheology = new_rheology(laws(n), density_dowson_higginson, 60.0_dp, z, 3e9_dp)
         call at(rheology, 1000.0_dp, rho, drho, fluidity, dln_eta)
         call test%check(fluidity > 0, 'fluidity stays above 0')
         call test%check_close(rho, 1.34_dp, 'density limit', relative=1e-3_dp)
      end do
   end subroutine check_extremes

end program test_rheology
