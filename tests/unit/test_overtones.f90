!> Overtones of the waves of two surfaces: resolved by a record, or an error.
program test_overtones
   use ehlwave_amplitude, only: fitted_harmonics
   use ehlwave_kinds, only: dp, pi
   use ehlwave_overtones, only: overtone_error, resolved_periods
   use ehlwave_surfaces, only: surfaces_t
   use ehlwave_waviness, only: new_waviness
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: step = 1/64.0_dp
   type(test_t) :: test

   call check_resolved()
   call check_multiples()
   call test%finish()

contains

   !> Two surfaces in pure rolling, with periods of their wavelengths.
   function pair(first, second) result(surfaces)
      real(dp), intent(in) :: first, second      !! wavelengths
      type(surfaces_t) :: surfaces
      surfaces%list = [new_waviness(first, 0.0_dp, .false., -2.5_dp, 1.0_dp, 0.2_dp), &
                       new_waviness(second, 0.0_dp, .false., -2.5_dp, 1.0_dp, 0.2_dp)]
   end function pair

   !> Periods of 1 and 0.6: overtones at 2, 3 and the mixed waves do not enter the waves of a record of 3 T, whose
   !> samples do not fill it.
   subroutine check_resolved()
      type(surfaces_t) :: surfaces
      complex(dp), allocatable :: parts(:)
      real(dp), allocatable :: film(:), periods(:), time(:)
      integer :: k

      surfaces = pair(1.0_dp, 0.6_dp)
      time = [(0.3_dp + 0.0151_dp*k, k=1, 190)]
      film = 0.1_dp + 0.02_dp*cos(2*pi*time) + 0.003_dp*cos(2*pi*time/0.6_dp + 1) + 0.004_dp*cos(4*pi*time + 0.3_dp) &
             + 0.001_dp*sin(2*pi*time*(1/0.6_dp - 1)) + 5e-4_dp*sin(2*pi*time*(1/0.6_dp + 1))
      periods = resolved_periods(surfaces, 0.0151_dp)
      call test%check_close(periods(:2), [1.0_dp, 0.6_dp], 'own waves first', relative=1e-12_dp)
      parts = fitted_harmonics(time, film, periods)
      call test%check_close(abs(parts(:2)), [0.02_dp, 0.003_dp], 'without overtones', relative=1e-9_dp)
      parts = fitted_harmonics(time, film, periods(:2))
      call test%check(abs(abs(parts(2))/0.003_dp - 1) > 0.01_dp, 'a fit of two waves has a part of the overtones')
      call test%check_close(overtone_error(surfaces, 2, [0.2_dp, 0.01_dp], step), 0.0_dp, 'no low overtone has their period', &
                            absolute=0.01_dp)
   end subroutine check_resolved

   !> A multiple: the error grows with the square of the larger height, and none is left of a single surface.
   subroutine check_multiples()
      type(surfaces_t) :: single, surfaces
      real(dp) :: large, small

      surfaces = pair(1.0_dp, 0.5_dp)
      large = overtone_error(surfaces, 2, [0.2_dp, 0.02_dp], step)
      small = overtone_error(surfaces, 2, [0.1_dp, 0.02_dp], step)
      call test%check_close(large/small, 4.0_dp, 'second order', relative=0.05_dp)
      call test%check(large > 0.3_dp, 'an overtone of the size of the wave')
      call test%check(overtone_error(surfaces, 1, [0.2_dp, 0.02_dp], step) < 0.01_dp, 'the longer waves lose little')
      call test%check(overtone_error(pair(1.0_dp, 1/3.0_dp), 2, [0.2_dp, 0.02_dp], step) < 0.3_dp*large, 'third order')
      single%list = surfaces%list(:1)
      call test%check_close(overtone_error(single, 1, [0.2_dp], step), 0.0_dp, 'a single surface', absolute=0.0_dp)
      call test%check_close(resolved_periods(single, step), [1.0_dp], 'one period', relative=0.0_dp)
   end subroutine check_multiples

end program test_overtones
