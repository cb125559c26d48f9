!> Laws of an oil as functions of P: every law of the list, at two Hertz pressures, on arrays longer than a block, no overflow.
program test_rheology
   use ehlwave_case_key, only: words_of
   use ehlwave_kinds, only: dp
   use ehlwave_number_table, only: number_table_t
   use ehlwave_oil, only: barus, density_laws, dowson_higginson, incompressible, isoviscous, mcewen, oil_t, roelands, tait, &
      viscosity_laws
   use ehlwave_rheology, only: rheology_t
   use sample_contact, only: rheology_of
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: alphabar = 20, z = 0.68_dp, ph = 0.9e9_dp
   type(test_t) :: test

   call check_values()
   call check_all_laws()
   call check_pressures()
   call check_blocks()
   call check_extremes()
   call test%finish()

contains

   !> An oil with alphabar = 20 at ph, and parameters for every law.
   function oil_of(viscosity_law, density_law) result(oil)
      character(len=*), intent(in) :: viscosity_law, density_law
      type(oil_t) :: oil
      oil%viscosity_law = viscosity_law
      oil%density_law = density_law
      oil%pressure_viscosity_per_pa = alphabar/ph
      oil%mcewen%alpha0_per_pa = 2e-8_dp
      oil%mcewen%exponent = 9
      oil%yasutomi%c1 = 15.9_dp
      oil%yasutomi%c2_k = 14.2_dp
      oil%yasutomi%above_glass_k = 105
      oil%yasutomi%a1_k = 188
      oil%yasutomi%a2_per_pa = 0.72e-9_dp
      oil%yasutomi%b1_per_pa = 8.2e-9_dp
      oil%yasutomi%b2 = -0.58_dp
      oil%doolittle%factor = 4.71_dp
      oil%doolittle%occupied_fraction = 0.6568_dp
      oil%tait%modulus_pa = 1.2e9_dp
      oil%tait%modulus_rate = 11
      oil%measured = number_table_t('', [character(len=64) :: 'pressure_pa', 'viscosity_pa_s'], [2, 3, 4, 5], &
                                    reshape([0.0_dp, 2e8_dp, 5e8_dp, 9e8_dp, 0.05_dp, 0.9_dp, 70.0_dp, 1e4_dp], [4, 2]))
   end function oil_of

   !> rho, drho, fluidity, dln_eta at P.
   function at(rheology, p) result(values)
      type(rheology_t), intent(in) :: rheology
      real(dp), intent(in) :: p
      real(dp) :: values(4), one(1, 4)
      call rheology%evaluate(1, [p], one(:, 1), one(:, 2), one(:, 3), one(:, 4))
      values = one(1, :)
   end function at

   subroutine check_values()
      real(dp), parameter :: p = 0.7_dp, p0 = 1.96e8_dp, alpha = alphabar/ph
      real(dp) :: values(4)

      values = at(rheology_of(oil_of(roelands, dowson_higginson), ph), p)
      call test%check_close(values(1), (5.9e8_dp + 1.34_dp*ph*p)/(5.9e8_dp + ph*p), 'Dowson-Higginson', relative=1e-14_dp)
      call test%check_close(1/values(3), exp(alpha*p0/z*((1 + ph*p/p0)**z - 1)), 'Roelands', relative=1e-12_dp)
      values = at(rheology_of(oil_of(roelands, dowson_higginson), ph), 0.0_dp)
      call test%check_close([values(1), values(3:)], [1.0_dp, 1.0_dp, alphabar], 'ambient pressure', relative=1e-15_dp)
      values = at(rheology_of(oil_of(barus, incompressible), ph), p)
      call test%check_close([values(1), values(3:)], [1.0_dp, exp(-alphabar*p), alphabar], 'Barus', relative=1e-13_dp)
      values = at(rheology_of(oil_of(isoviscous, incompressible), ph), p)
      call test%check_close(values, [1.0_dp, 0.0_dp, 1.0_dp, 0.0_dp], 'isoviscous', absolute=0.0_dp)
      values = at(rheology_of(oil_of(roelands, dowson_higginson), 0.0_dp), p)
      call test%check_close(values, [1.0_dp, 0.0_dp, 1.0_dp, 0.0_dp], 'constant where pascals are unknown', absolute=0.0_dp)
   end subroutine check_values

   !> Every name of the list makes a law, with the right derivatives.
   subroutine check_all_laws()
      integer :: k
      associate (laws => words_of(viscosity_laws))
         do k = 1, size(laws)
            call check_derivatives(trim(laws(k)), rheology_of(oil_of(laws(k), dowson_higginson), ph))
         end do
         call test%check(size(laws) >= 7, 'all viscosity laws')
      end associate
      associate (laws => words_of(density_laws))
         do k = 1, size(laws)
            call check_derivatives(trim(laws(k)), rheology_of(oil_of(roelands, laws(k)), ph))
         end do
         call test%check(size(laws) >= 3, 'all density laws')
      end associate
   end subroutine check_all_laws

   subroutine check_derivatives(name, rheology)
      character(len=*), intent(in) :: name
      type(rheology_t), intent(in) :: rheology
      real(dp), parameter :: step = 1e-5_dp, pressure(3) = [0.01_dp, 0.5_dp, 1.1_dp]
      real(dp) :: down(4), here(4), up(4)
      integer :: i
      do i = 1, size(pressure)
         down = at(rheology, pressure(i) - step)
         here = at(rheology, pressure(i))
         up = at(rheology, pressure(i) + step)
         call test%check_close(here(2), (up(1) - down(1))/(2*step), name//', d rho/dP', relative=1e-7_dp, absolute=1e-12_dp)
         call test%check_close(here(4), -log(up(3)/down(3))/(2*step), name//', d ln(eta)/dP', relative=1e-7_dp, &
                               absolute=1e-12_dp)
      end do
      call test%check_close(rheology%thickening(), -log(at_third(rheology, step))/step, name//', at P = 0', relative=1e-3_dp, &
                            absolute=1e-12_dp)
   end subroutine check_derivatives

   real(dp) function at_third(rheology, p)
      type(rheology_t), intent(in) :: rheology
      real(dp), intent(in) :: p
      real(dp) :: values(4)
      values = at(rheology, p)
      at_third = values(3)
   end function at_third

   !> The laws in units of ph, at this Hertz pressure and another.
   subroutine check_pressures()
      real(dp), parameter :: p = 0.7_dp, pressures(2) = [ph, 0.5_dp*ph]
      type(rheology_t) :: rheology
      real(dp) :: values(4), x
      integer :: k

      rheology = rheology_of(oil_of(mcewen, tait), ph)
      do k = 1, size(pressures)
         if (k == 2) rheology = rheology%at_pressure(pressures(k))
         values = at(rheology, p)
         x = 1 + 2e-8_dp*pressures(k)*p/9
         call test%check_close([1/values(3), values(4)], [x**9, 2e-8_dp*pressures(k)/x], 'McEwen', relative=1e-12_dp)
         x = 1 + 12*pressures(k)*p/1.2e9_dp
         call test%check_close(1/values(1), 1 - log(x)/12, 'Tait', relative=1e-13_dp)
         call test%check_close(values(2), values(1)**2*pressures(k)/(1.2e9_dp*x), 'its derivative', relative=1e-13_dp)
      end do
   end subroutine check_pressures

   !> Arrays are evaluated block by block: the same bits as single values, also for density alone.
   subroutine check_blocks()
      integer, parameter :: n = 700
      type(rheology_t) :: rheology
      real(dp), dimension(n) :: dln_eta, drho, fluidity, p, rho
      real(dp) :: alone(n, 2), values(4)
      integer :: i

      rheology = rheology_of(oil_of(roelands, dowson_higginson), ph)
      p = [(1.2_dp*i/n, i=1, n)]
      call rheology%evaluate(n, p, rho, drho, fluidity, dln_eta)
      do i = 1, n
         values = at(rheology, p(i))
         call test%check_close([rho(i), drho(i), fluidity(i), dln_eta(i)], values, 'blocks', relative=1e-13_dp)
      end do
      alone = rheology%density(spread(p, 2, 2))
      call test%check_close(alone(:, 2), rho, 'density alone', relative=0.0_dp)
   end subroutine check_blocks

   !> No overflow at any pressure that an iterate can have; the builds with traps would stop here.
   subroutine check_extremes()
      real(dp) :: values(4)
      values = at(rheology_of(oil_of(roelands, dowson_higginson), 3e9_dp), 1000.0_dp)
      call test%check(values(3) > 0, 'fluidity stays above 0')
      call test%check_close(values(1), 1.34_dp, 'density limit', relative=1e-3_dp)
      values = at(rheology_of(oil_of(barus, dowson_higginson), 3e9_dp), 1000.0_dp)
      call test%check(values(3) > 0, 'fluidity stays above 0')
   end subroutine check_extremes

end program test_rheology
