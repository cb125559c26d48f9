!> Amplitude from samples and from the harmonic fit, and its unsettled part.
program test_amplitude
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use ehlwave_amplitude, only: fit_misfit, fitted_harmonic, fitted_harmonics, fitted_mean, sampled_amplitude
   use ehlwave_kinds, only: dp, pi
   use ehlwave_settling, only: left_to_come
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_harmonic()
   call check_higher_harmonics()
   call check_two_waves()
   call check_few_samples()
   call check_settling()
   call test%finish()

contains

   !> Exact for a harmonic whatever the phase, with samples that do not fill whole periods.
   subroutine check_harmonic()
      real(dp), parameter :: period = 0.73_dp, amplitude = 2e-4_dp
      real(dp) :: film(12), phase, time(12)
      integer :: i, n

      do n = 0, 6
         phase = n
         time = [(3.5_dp + 0.0625_dp*i, i=1, 12)]
         film = 0.14_dp + amplitude*cos(2*pi*time/period + phase)
         call test%check_close(abs(fitted_harmonic(time, film, period)), amplitude, 'harmonic', relative=1e-10_dp)
         call test%check_close(abs(fitted_harmonic(time, film, period) - amplitude*exp(cmplx(0, -phase, dp))), 0.0_dp, &
                               'with its phase', absolute=1e-10_dp*amplitude)
         call test%check_close(fitted_mean(time, film, [period]), 0.14_dp, 'its mean', absolute=1e-10_dp*amplitude)
      end do
      call test%check_close(sampled_amplitude([1.0_dp, 3.0_dp, 2.0_dp, 0.5_dp]), 1.25_dp, 'half the range', relative=1e-15_dp)
      call test%check(sampled_amplitude(film) < amplitude, 'samples miss the crest')
   end subroutine check_harmonic

   !> Over a whole period other harmonics do not enter the fit.
   subroutine check_higher_harmonics()
      real(dp) :: film(16), time(16)
      integer :: i
      time = [(i/16.0_dp, i=1, 16)]
      film = 1 + 0.3_dp*cos(2*pi*time) + 0.1_dp*sin(4*pi*time) + 0.05_dp*cos(6*pi*time)
      call test%check_close(abs(fitted_harmonic(time, film, 1.0_dp)), 0.3_dp, 'orthogonal', relative=1e-13_dp)
   end subroutine check_higher_harmonics

   !> Two waves at once, over no whole number of their periods: each with its amplitude and phase, as a single wave.
   subroutine check_two_waves()
      real(dp) :: film(40), time(40)
      real(dp), parameter :: periods(2) = [0.73_dp, 1.1_dp]
      complex(dp), parameter :: waves(2) = [(2e-4_dp, -1e-4_dp), (5e-5_dp, 3e-4_dp)]
      integer :: i
      time = [(3.5_dp + 0.0625_dp*i, i=1, 40)]
      film = 0.14_dp + real(waves(1)*exp(cmplx(0, -2*pi*time/periods(1), dp)) &
                            + waves(2)*exp(cmplx(0, -2*pi*time/periods(2), dp)), dp)
      call test%check_close(abs(fitted_harmonics(time, film, periods) - waves), [0.0_dp, 0.0_dp], 'each wave', absolute=1e-14_dp)
      call test%check_close(fitted_mean(time, film, periods), 0.14_dp, 'their mean', absolute=1e-14_dp)
      call test%check(ieee_is_nan(abs(sum(fitted_harmonics(time, film, [0.73_dp, 0.73_dp])))), 'one period is no two waves')
      call test%check(abs(fitted_harmonic(time, film, 0.73_dp) - waves(1)) > 1e-6_dp, 'a fit of one mistakes the other for it')
   end subroutine check_two_waves

   subroutine check_few_samples()
      real(dp), parameter :: crest_and_trough(5) = [3.5_dp, 3.75_dp, 4.0_dp, 4.25_dp, 4.5_dp]
      call test%check(ieee_is_nan(abs(fitted_harmonic([0.0_dp, 0.5_dp], [1.0_dp, 2.0_dp], 1.0_dp))), 'too few samples')
      call test%check(ieee_is_nan(abs(fitted_harmonic(crest_and_trough, [1.0_dp, 2.0_dp, 1.0_dp, 2.0_dp, 1.0_dp], 0.5_dp))), &
                      'two phases do not tell the amplitude')
      call test%check_close(fitted_mean(crest_and_trough(2:), [2.0_dp, 1.0_dp, 2.0_dp, 1.0_dp], [0.5_dp]), 1.5_dp, &
                            'but their mean', relative=1e-15_dp)
      call test%check_close(abs(fitted_harmonic([0.0_dp, 0.25_dp, 0.5_dp, 0.75_dp], [5.0_dp, 5.0_dp, 5.0_dp, 5.0_dp], 1.0_dp)), &
                            0.0_dp, 'a constant film', absolute=1e-15_dp)
   end subroutine check_few_samples

   !> Error of a settling wave, or of a swinging contact, is at most the estimate, whatever the phase. The estimate
   !> vanishes for a settled wave; it is the full amplitude where a drift of the mean hides the wave.
   subroutine check_settling()
      real(dp), parameter :: quiet(3) = 0, sizes(3) = [0.3_dp, 0.8_dp, 0.93_dp]   ! tolerances of ratios
      complex(dp), parameter :: wave = (0.6_dp, -0.3_dp)
      complex(dp) :: parts(3), ratio
      real(dp) :: error, film(32), time(32)
      integer :: i, j, k

      do k = 0, 11
         do j = 1, 11
            ratio = sizes(1 + modulo(j, 3))*exp(cmplx(0, 0.5_dp*j, dp))
            parts = wave + 0.2_dp*exp(cmplx(0, 0.5_dp*k, dp))*[ratio**0, ratio, ratio**2]
            error = abs(abs(parts(3))/abs(wave) - 1)
            call test%check(left_to_come(parts, quiet, quiet) > error, 'a geometric series')
         end do
      end do
      call test%check_close(left_to_come([wave, wave, wave], quiet + 1, quiet + 0.1_dp), 0.0_dp, 'settled', absolute=0.0_dp)
      call test%check(left_to_come([wave, wave, wave], [0.0_dp, 0.0_dp, 3.0_dp], quiet) > 1, 'a mean that drifts')
      call test%check(left_to_come([wave, wave, wave], quiet, [0.3_dp, 0.3_dp, 0.2_dp]) > 0.2_dp, 'a swing that the fit leaves')
      call test%check(left_to_come([wave], quiet(:1), quiet(:1)) > 1, 'one period tells nothing')
      time = [(i/16.0_dp, i=1, 32)]
      film = 1 + 0.3_dp*cos(2*pi*time) + 0.1_dp*sin(4*pi*time)
      call test%check_close(fit_misfit(time, film, [1.0_dp]), 0.1_dp/sqrt(2.0_dp), 'rms of the other harmonic', relative=1e-12_dp)
      call test%check_close(fit_misfit(time, film, [1.0_dp, 0.5_dp]), 0.0_dp, 'nothing left', absolute=1e-14_dp)
   end subroutine check_settling

end program test_amplitude
