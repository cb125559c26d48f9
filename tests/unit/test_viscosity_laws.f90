!> Viscosity laws: values, derivatives, film-forming coefficients, limits.
program test_viscosity_laws
   use ehlwave_barus_law, only: barus_law_t
   use ehlwave_doolittle_law, only: doolittle_law_t
   use ehlwave_isoviscous_law, only: isoviscous_law_t
   use ehlwave_kinds, only: dp
   use ehlwave_mcewen_law, only: mcewen_law_t
   use ehlwave_roelands_law, only: roelands_law_t
   use ehlwave_tait_density, only: tait_density_t
   use ehlwave_viscosity_law, only: asymptotic_coefficient, film_forming_coefficient, largest_exponent, &
      viscosity_law_t
   use ehlwave_yasutomi_law, only: yasutomi_law_t
   use testing, only: test_t
   implicit none (type, external)

   type(tait_density_t), parameter :: tait = tait_density_t(modulus_pa=1.2e9_dp, modulus_rate=11.74_dp, &
      expansion_per_k=7.3e-4_dp, softening_per_k=5.5e-3_dp)
   type(doolittle_law_t), parameter :: doolittle = doolittle_law_t(factor=4.71_dp, occupied_fraction=0.6568_dp, &
      occupied_rate_per_k=-9e-4_dp, tait=tait)
   type(mcewen_law_t), parameter :: mcewen = mcewen_law_t(alpha0_per_pa=2e-8_dp, exponent=9.0_dp, beta_per_k=0.04_dp)
   type(yasutomi_law_t), parameter :: yasutomi = yasutomi_law_t(c1=15.9_dp, c2_k=14.2_dp, above_glass_k=105.0_dp, a1_k=188.0_dp, &
                                                                a2_per_pa=0.72e-9_dp, b1_per_pa=8.2e-9_dp, b2=-0.58_dp)
   type(barus_law_t), parameter :: barus = barus_law_t(alpha_per_pa=2.2e-8_dp, beta_per_k=0.04_dp)
   type(roelands_law_t), parameter :: roelands = roelands_law_t(alpha_per_pa=2.2e-8_dp, beta_per_k=0.04_dp, &
                                                                temperature_k=313.15_dp)
   type(test_t) :: test

   call check_coefficients()
   call check_values()
   call check_law('Doolittle', doolittle)
   call check_law('McEwen', mcewen)
   call check_law('Roelands', roelands)
   call check_law('Barus', barus)
   call check_law('improved Yasutomi', yasutomi)
   call test%finish()

contains

   !> Against closed forms: Barus' and McEwen's laws.
   subroutine check_coefficients()
      real(dp), parameter :: a = mcewen%alpha0_per_pa, q = mcewen%exponent
      real(dp) :: last, star
      call test%check_close(asymptotic_coefficient(barus), 2.2e-8_dp, 'alpha* of Barus', relative=1e-10_dp)
      call test%check_close(film_forming_coefficient(barus), 2.2e-8_dp, 'film-forming alpha of Barus', relative=1e-10_dp)
      call test%check_close(film_forming_coefficient(barus_law_t()), 0.0_dp, 'of a constant viscosity', absolute=0.0_dp)
      star = a*(q - 1)/q
      last = 3/star
      call test%check_close(asymptotic_coefficient(mcewen), star, 'alpha* of McEwen', relative=1e-10_dp)
      call test%check_close(film_forming_coefficient(mcewen), (1 - exp(-3.0_dp))*star/(1 - (1 + a*last/q)**(1 - q)), &
                            'film-forming alpha of McEwen', relative=1e-10_dp)
   end subroutine check_coefficients

   !> At 0.5 GPa and T0, by the formulas as printed; Roelands' law 30 K above, too.
   subroutine check_values()
      real(dp), parameter :: p = 0.5e9_dp, p0 = 1.96e8_dp, alpha = roelands%alpha_per_pa, z = 0.68_dp
      real(dp) :: ambient, f, glass, s0, volume
      type(isoviscous_law_t) :: isoviscous

      volume = 1 - log(1 + 12.74_dp*p/1.2e9_dp)/12.74_dp
      call test%check_close(exponent_of(doolittle, p, 0.0_dp), &
                            4.71_dp*0.6568_dp*(1/(volume - 0.6568_dp) - 1/(1 - 0.6568_dp)), 'Doolittle', relative=1e-13_dp)
      call test%check_close(exp(exponent_of(mcewen, p, 0.0_dp)), (1 + 2e-8_dp*p/9)**9, 'McEwen', relative=1e-12_dp)
      glass = 188*log(1 + 0.72e-9_dp*p)
      f = (1 + 8.2e-9_dp*p)**(-0.58_dp)
      ambient = 105/(14.2_dp + 105)
      call test%check_close(exponent_of(yasutomi, p, 0.0_dp)/log(10.0_dp), &
                            15.9_dp*(ambient - (105 - glass)*f/(14.2_dp + (105 - glass)*f)), 'improved Yasutomi', &
                            relative=1e-12_dp)
      call test%check_close(exponent_of(roelands, p, 0.0_dp), alpha*p0/z*((1 + p/p0)**z - 1), 'Roelands', relative=1e-13_dp)
      s0 = 0.04_dp*(313.15_dp - 138)*z/(alpha*p0)
      call test%check_close(exponent_of(roelands, p, 30.0_dp), &
                            alpha*p0/z*((1 + p/p0)**z*((343.15_dp - 138)/(313.15_dp - 138))**(-s0) - 1), 'Roelands, warm', &
                            relative=1e-12_dp)
      call test%check_close(exponent_of(isoviscous, p, 30.0_dp), 0.0_dp, 'isoviscous', absolute=0.0_dp)
   end subroutine check_values

   real(dp) function exponent_of(law, p_pa, rise_k)
      class(viscosity_law_t), intent(in) :: law
      real(dp), intent(in) :: p_pa, rise_k
      real(dp), dimension(1) :: exponent, slope_per_k, slope_per_pa
      call law%evaluate(1, [p_pa], [rise_k], exponent, slope_per_pa, slope_per_k)
      exponent_of = exponent(1)
   end function exponent_of

   !> Derivatives, ambient value, coefficient, and no overflow at any pressure that an iterate can have.
   subroutine check_law(name, law)
      character(len=*), intent(in) :: name
      class(viscosity_law_t), intent(in) :: law
      real(dp), parameter :: p(3) = [1e6_dp, 0.4e9_dp, 0.8e9_dp], rise(3) = [-10.0_dp, 0.0_dp, 30.0_dp], zero(3) = 0
      real(dp), parameter :: step = 1e3_dp, step_k = 1e-4_dp
      real(dp) :: alpha
      real(dp), dimension(3) :: by_k, down, exponent, slope, unused, up

      call law%evaluate(3, p - step, rise, down, unused, by_k)
      call law%evaluate(3, p + step, rise, up, unused, by_k)
      call law%evaluate(3, p, rise, exponent, slope, by_k)
      call test%check_close(slope, (up - down)/(2*step), name//': d ln(eta)/dp', relative=1e-7_dp)
      call law%evaluate(3, p, rise - step_k, down, unused, slope)
      call law%evaluate(3, p, rise + step_k, up, unused, slope)
      call test%check_close(by_k, (up - down)/(2*step_k), name//': d ln(eta)/dT', relative=1e-7_dp)
      call test%check(all(by_k < 0), name//': falls with temperature')
      call law%evaluate(1, [0.0_dp], zero, exponent, slope, by_k)
      call test%check_close(exponent(1), 0.0_dp, name//': ambient pressure', absolute=1e-13_dp)
      alpha = law%coefficient()
      call test%check(alpha > 0.5_dp*slope(1) .and. alpha < 1.5_dp*slope(1), name//': alpha near the initial slope')
      call law%evaluate(3, [1e10_dp, 1e12_dp, 1e15_dp], zero, exponent, slope, by_k)
      call test%check(all(exponent > 0 .and. exponent <= largest_exponent), name//': bounded')
      call test%check(all(slope < huge(slope) .and. abs(by_k) < huge(by_k)), name//': slopes are finite')
   end subroutine check_law

end program test_viscosity_laws
