!> Amplitude formula, theory eq. (15) to (18), and the film thickness formula.
program test_formula
   use ehlwave_conditions, only: conditions_from_moes, conditions_t
   use ehlwave_errors, only: error_t
   use ehlwave_formula, only: amplitude_formula, anisotropy_factor, moes_film_formula, wave_parameter_v, wave_parameter_v2
   use ehlwave_kinds, only: dp, pi
   use sample_contact, only: make_conditions
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_anisotropy()
   call check_wave_parameters()
   call check_amplitude()
   call check_film()
   call check_line()
   call test%finish()

contains

   subroutine check_anisotropy()
      call test%check_close(anisotropy_factor(1.0_dp, 0.0_dp), 1.0_dp, 'transverse', relative=0.0_dp)
      call test%check_close(anisotropy_factor(1.0_dp, 1.0_dp), 1.0_dp, 'isotropic', relative=0.0_dp)
      call test%check_close(anisotropy_factor(0.0_dp, 1.0_dp), exp(1.0_dp), 'longitudinal', relative=1e-15_dp)
      call test%check_close(anisotropy_factor(2.0_dp, 1.0_dp), exp(0.5_dp), 'r = 2', relative=1e-15_dp)
      call test%check_close(anisotropy_factor(1.0_dp, 2.0_dp), 1.0_dp, 'r = 1/2', relative=0.0_dp)
      call test%check_close(anisotropy_factor(1e9_dp, 1.0_dp), exp(1.0_dp), 'r to infinity', relative=1e-8_dp)
   end subroutine check_anisotropy

   !> Both expressions of eq. (17), and the values of the reference table.
   subroutine check_wave_parameters()
      real(dp), parameter :: m(4) = [100.0_dp, 200.0_dp, 500.0_dp, 1000.0_dp], d(4) = [1.0_dp, 0.35_dp, 0.12_dp, 0.04_dp]
      real(dp), parameter :: table_v(4) = [0.720189_dp, 0.63002771_dp, 0.65993521_dp, 0.64482253_dp]
      real(dp), parameter :: table_v2(4) = [0.720189_dp, 1.0185011_dp, 1.6103916_dp, 2.2774376_dp]
      real(dp), parameter :: wave = 0.25_dp
      type(conditions_t) :: c
      integer :: i

      do i = 1, size(m)
         c = make_conditions(m(i), d(i))
         call test%check_close(wave_parameter_v(c, wave), wave*sqrt(2*pi**3/3)*c%alphabar**1.5_dp/c%l**2, &
                               'V from alphabar and L', relative=1e-13_dp)
         call test%check_close(wave_parameter_v(c, wave), table_v(i), 'V of the reference table', relative=1e-7_dp)
         call test%check_close(wave_parameter_v2(c, wave), table_v2(i), 'V2 of the reference table', relative=1e-7_dp)
      end do
   end subroutine check_wave_parameters

   subroutine check_amplitude()
      call test%check_close(amplitude_formula(0.0_dp), 1.0_dp, 'f V = 0', relative=0.0_dp)
      call test%check_close(amplitude_formula(2.0_dp), 1/1.36_dp, 'f V = 2', relative=1e-15_dp)
      ! the published table of the experiment
      call test%check_close([amplitude_formula(1.42_dp), amplitude_formula(1.02_dp), amplitude_formula(0.72_dp)], &
                            [0.80_dp, 0.86_dp, 0.90_dp], 'experiment', absolute=0.006_dp)
   end subroutine check_amplitude

   !> Line contacts: V of both forms; the asymptotes of the film formula and a value computed independently.
   subroutine check_line()
      type(conditions_t) :: c
      c = make_conditions(100.0_dp, 0.0_dp)
      call test%check_close(wave_parameter_v(c, 0.25_dp), (2*pi)**0.75_dp*0.25_dp*c%alphabar**1.5_dp/c%l**2, &
                            'V of a line from alphabar and L', relative=1e-13_dp)
      call test%check_close(wave_parameter_v(c, 0.25_dp), 0.25_dp*100**0.75_dp/sqrt(12.05_dp), 'V of a line', relative=1e-13_dp)
      call test%check_close(moes_film_formula(line(1e-3_dp, 0.0_dp)), 3e3_dp, 'rigid, isoviscous', relative=1e-2_dp)
      call test%check_close(moes_film_formula(line(1e6_dp, 0.0_dp)), 2.621_dp*1e6_dp**(-0.2_dp), 'elastic, isoviscous', &
                            relative=1e-2_dp)
      call test%check_close(moes_film_formula(line(1e4_dp, 100.0_dp)), 1.311_dp*1e4_dp**(-0.125_dp)*100**0.75_dp, &
                            'elastic, piezoviscous', relative=2e-2_dp)
      call test%check_close(moes_film_formula(line(100.0_dp, 11.0_dp)), 4.56485_dp, 'M = 100, L = 11', relative=1e-5_dp)
   end subroutine check_line

   function line(m, l) result(c)
      real(dp), intent(in) :: m, l
      type(conditions_t) :: c
      type(error_t), allocatable :: error
      call conditions_from_moes(m, l, 0.0_dp, 2.2e-8_dp, c, error)
      ! alpha ph may be beyond the model; M, L and D are set all the same
   end function line

   subroutine check_film()
      type(conditions_t) :: c
      type(error_t), allocatable :: error
      ! converged solutions lie 9 to 18 per cent below the formula
      call test%check_close(moes_film_formula(make_conditions(100.0_dp, 1.0_dp))*0.865_dp, 4.197_dp, 'circular', relative=0.06_dp)
      call test%check_close(moes_film_formula(make_conditions(1000.0_dp, 0.04_dp))*0.865_dp, 4.857_dp, 'slender', &
                            relative=0.06_dp)
      ! rigid isoviscous asymptote, without piezoviscosity and at light load
      call conditions_from_moes(0.01_dp, 0.0_dp, 1.0_dp, 2.2e-8_dp, c, error)
      call test%check(moes_film_formula(c) > 1.79_dp .and. moes_film_formula(c) < 145/1.796_dp**(15/7.0_dp)/0.01_dp**2 + 2, &
                      'light load')
   end subroutine check_film

end program test_formula
