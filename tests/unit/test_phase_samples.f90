!> Values of something periodic between its samples, and its harmonics.
program test_phase_samples
   use ehlwave_kinds, only: dp, pi
   use ehlwave_phase_samples, only: new_phase_samples, phase_samples_t
   use testing, only: test_t
   implicit none (type, external)

   complex(dp), parameter :: amplitude(0:2) = [(1.5_dp, 0.0_dp), (0.3_dp, -0.2_dp), (-0.1_dp, 0.05_dp)]
   real(dp), parameter :: delay = 0.37_dp
   type(test_t) :: test
   type(phase_samples_t) :: phases
   real(dp) :: samples(5), before(5)
   integer :: k, m

   phases = new_phase_samples(2)
   call test%check(phases%n == 5, 'samples of a mean and two harmonics')
   samples = [(wave_at(2*pi*(k - 1)/5), k=1, 5)]
   before = matmul(phases%delayed(delay), samples)
   call test%check_close(before, [(wave_at(2*pi*(k - 1)/5 - delay), k=1, 5)], 'an earlier time', absolute=1e-14_dp)
   do m = 0, 2
      call test%check_close(abs(phases%harmonic(m, samples) - amplitude(m)), 0.0_dp, 'a harmonic', absolute=1e-14_dp)
   end do
   call test%check_close(phases%value(samples, 1.1_dp), wave_at(1.1_dp), 'between the samples', absolute=1e-14_dp)
   call test%finish()

contains

   pure real(dp) function wave_at(phase)
      real(dp), intent(in) :: phase
      integer :: n
      wave_at = real(sum([(amplitude(n)*exp(cmplx(0, -n*phase, dp)), n=0, 2)]), dp)
   end function wave_at

end program test_phase_samples
