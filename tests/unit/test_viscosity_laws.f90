!> Barus' law, as an example of a law and because its coefficients are known.
module barus_example
   use ehlwave_kinds, only: dp
   use ehlwave_viscosity_law, only: largest_exponent, viscosity_law_t
   implicit none (type, external)
   private

   !> eta = eta0 exp(alpha p), for which both coefficients are alpha; 0 is isoviscous.
   type, extends(viscosity_law_t), public :: barus_t
      real(dp) :: alpha_per_pa = 0
   contains
      procedure :: evaluate
   end type barus_t

contains

   pure subroutine evaluate(self, n, p_pa, exponent, slope_per_pa)
      class(barus_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: p_pa(n)
      real(dp), intent(out) :: exponent(n), slope_per_pa(n)
      exponent = min(self%alpha_per_pa*p_pa, largest_exponent)
      slope_per_pa = self%alpha_per_pa
   end subroutine evaluate

end module barus_example

!> Viscosity laws with parameters of their own: values, derivatives, film-forming coefficients, limits.
program test_viscosity_laws
   use barus_example, only: barus_t
   use ehlwave_doolittle_law, only: doolittle_law_t
   use ehlwave_kinds, only: dp
   use ehlwave_mcewen_law, only: mcewen_law_t
   use ehlwave_tait_density, only: tait_density_t
   use ehlwave_viscosity_law, only: asymptotic_coefficient, film_forming_coefficient, largest_exponent, &
      viscosity_law_t
   use ehlwave_yasutomi_law, only: yasutomi_law_t
   use testing, only: test_t
   implicit none (type, external)

   type(tait_density_t), parameter :: tait = tait_density_t(modulus_pa=1.2e9_dp, modulus_rate=11.74_dp)
   type(doolittle_law_t), parameter :: doolittle = doolittle_law_t(factor=4.71_dp, occupied_fraction=0.6568_dp, tait=tait)
   type(mcewen_law_t), parameter :: mcewen = mcewen_law_t(alpha0_per_pa=2e-8_dp, exponent=9.0_dp)
   type(yasutomi_law_t), parameter :: yasutomi = yasutomi_law_t(c1=15.9_dp, c2_k=14.2_dp, above_glass_k=105.0_dp, a1_k=188.0_dp, &
                                                                a2_per_pa=0.72e-9_dp, b1_per_pa=8.2e-9_dp, b2=-0.58_dp)
   type(test_t) :: test

   call check_coefficients()
   call check_values()
   call check_law('Doolittle', doolittle)
   call check_law('McEwen', mcewen)
   call check_law('improved Yasutomi', yasutomi)
   call check_tait()
   call test%finish()

contains

   !> Against closed forms: Barus' and McEwen's laws.
   subroutine check_coefficients()
      real(dp), parameter :: a = mcewen%alpha0_per_pa, q = mcewen%exponent
      real(dp) :: last, star
      call test%check_close(asymptotic_coefficient(barus_t(2.2e-8_dp)), 2.2e-8_dp, 'alpha* of Barus', relative=1e-10_dp)
      call test%check_close(film_forming_coefficient(barus_t(2.2e-8_dp)), 2.2e-8_dp, 'film-forming alpha of Barus', &
                            relative=1e-10_dp)
      call test%check_close(film_forming_coefficient(barus_t(0.0_dp)), 0.0_dp, 'of a constant viscosity', absolute=0.0_dp)
      star = a*(q - 1)/q
      last = 3/star
      call test%check_close(asymptotic_coefficient(mcewen), star, 'alpha* of McEwen', relative=1e-10_dp)
      call test%check_close(film_forming_coefficient(mcewen), (1 - exp(-3.0_dp))*star/(1 - (1 + a*last/q)**(1 - q)), &
                            'film-forming alpha of McEwen', relative=1e-10_dp)
   end subroutine check_coefficients

   !> At 0.5 GPa, by the formulas as printed.
   subroutine check_values()
      real(dp), parameter :: p = 0.5e9_dp
      real(dp) :: exponent(1), f, ambient, glass, slope(1), volume
      volume = 1 - log(1 + 12.74_dp*p/1.2e9_dp)/12.74_dp
      call doolittle%evaluate(1, [p], exponent, slope)
      call test%check_close(exponent(1), 4.71_dp*0.6568_dp*(1/(volume - 0.6568_dp) - 1/(1 - 0.6568_dp)), 'Doolittle', &
                            relative=1e-13_dp)
      call test%check_close(tait%density(p), 1/volume, 'Tait', relative=1e-14_dp)
      call mcewen%evaluate(1, [p], exponent, slope)
      call test%check_close(exp(exponent(1)), (1 + 2e-8_dp*p/9)**9, 'McEwen', relative=1e-12_dp)
      call yasutomi%evaluate(1, [p], exponent, slope)
      glass = 188*log(1 + 0.72e-9_dp*p)
      f = (1 + 8.2e-9_dp*p)**(-0.58_dp)
      ambient = 105/(14.2_dp + 105)
      call test%check_close(exponent(1)/log(10.0_dp), 15.9_dp*(ambient - (105 - glass)*f/(14.2_dp + (105 - glass)*f)), &
                            'improved Yasutomi', relative=1e-12_dp)
   end subroutine check_values

   !> Derivative, ambient value, coefficient, and no overflow at any pressure that an iterate can have.
   subroutine check_law(name, law)
      character(len=*), intent(in) :: name
      class(viscosity_law_t), intent(in) :: law
      real(dp), parameter :: p(3) = [1e6_dp, 0.4e9_dp, 1.3e9_dp], step = 1e3_dp
      real(dp) :: alpha, exponent(3), slope(3), down(3), up(3), unused(3)

      call law%evaluate(3, p - step, down, unused)
      call law%evaluate(3, p + step, up, unused)
      call law%evaluate(3, p, exponent, slope)
      call test%check_close(slope, (up - down)/(2*step), name//': d ln(eta)/dp', relative=1e-7_dp)
      call law%evaluate(1, [0.0_dp], exponent, slope)
      call test%check_close(exponent(1), 0.0_dp, name//': ambient pressure', absolute=1e-13_dp)
      alpha = film_forming_coefficient(law)
      call test%check(alpha > 0.5_dp*slope(1) .and. alpha < 1.5_dp*slope(1), name//': film-forming alpha near the initial slope')
      call law%evaluate(3, [1e10_dp, 1e12_dp, 1e15_dp], exponent, slope)
      call test%check(all(exponent > 0 .and. exponent <= largest_exponent), name//': bounded')
      call test%check(all(abs(slope) < 1), name//': slope bounded')
   end subroutine check_law

   subroutine check_tait()
      real(dp), parameter :: p = 0.7e9_dp, step = 1e3_dp
      call test%check_close(tait%volume_slope_per_pa(p), (tait%volume(p + step) - tait%volume(p - step))/(2*step), 'dV/dp', &
                            relative=1e-8_dp)
      call test%check_close(tait%volume_slope_per_pa(0.0_dp), -1/1.2e9_dp, 'bulk modulus at ambient pressure', relative=1e-14_dp)
      call test%check(tait%volume(1e15_dp) > 0, 'volume above 0')
   end subroutine check_tait

end program test_viscosity_laws
