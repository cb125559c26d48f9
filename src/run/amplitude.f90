!> Amplitude of the film oscillation at the contact centre.
module ehlwave_amplitude
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_kinds, only: dp, no_value, pi
   use ehlwave_small_solve, only: solve_small
   implicit none (type, external)
   private
   public :: fit_misfit, fitted_harmonic, fitted_harmonics, fitted_mean, sampled_amplitude

   real(dp), parameter :: singular = 1e-12_dp   !! smallest pivot of the fit, per sample

contains

   !> Half the difference between the largest and the smallest sample, theory eq. (14).
   pure real(dp) function sampled_amplitude(film)
      real(dp), intent(in) :: film(:)   !! H(0,0) at the sampled times, at least one period
      sampled_amplitude = 0.5_dp*(maxval(film) - minval(film))
   end function sampled_amplitude

   !> Least squares fit of mean + c cos(omega T) + s sin(omega T); returns c + i s, for the real part of (c + i s)
   !> exp(-i omega T) and has the amplitude of the wave as its modulus. NaN where the samples do not determine these
   !> three numbers: fewer than three of them, or all at two phases of the wave only (two time steps per period).
   pure complex(dp) function fitted_harmonic(time, film, period)
      real(dp), intent(in) :: time(:)   !! T of the samples
      real(dp), intent(in) :: film(:)   !! H(0,0) at these times
      real(dp), intent(in) :: period    !! forcing period in T
      real(dp) :: c(3)
      c = coefficients(time, film, [period])
      fitted_harmonic = cmplx(c(2), c(3), dp)
   end function fitted_harmonic

   !> Fit of waves of several periods at once: each part belongs to its own wave, as far as the samples resolve them.
   pure function fitted_harmonics(time, film, periods) result(parts)
      real(dp), intent(in) :: time(:), film(:), periods(:)
      complex(dp) :: parts(size(periods))
      real(dp) :: c(1 + 2*size(periods))
      c = coefficients(time, film, periods)
      parts = cmplx(c(2::2), c(3::2), dp)
   end function fitted_harmonics

   !> Mean of an oscillation whose samples need not fill whole periods, from the same fit. Without a fit it is the
   !> mean of the samples, whose error is up to the amplitude over their number for each missing part of a period.
   pure real(dp) function fitted_mean(time, film, periods)
      real(dp), intent(in) :: time(:)   !! T of the samples
      real(dp), intent(in) :: film(:)   !! H(0,0) at these times
      real(dp), intent(in) :: periods(:)   !! in T, of all waves
      real(dp) :: c(1 + 2*size(periods))
      c = coefficients(time, film, periods)
      fitted_mean = sum(film)/size(film)
      if (ieee_is_finite(c(1))) fitted_mean = film(1) + c(1)
   end function fitted_mean

   !> The rest that the same fit leaves, rms over the samples; NaN where there is none.
   pure real(dp) function fit_misfit(time, film, periods)
      real(dp), intent(in) :: time(:), film(:), periods(:)
      real(dp) :: left(size(film)), c(1 + 2*size(periods))
      integer :: n
      c = coefficients(time, film, periods)
      left = film - film(1) - c(1)
      do n = 1, size(periods)
         left = left - c(2*n)*cos(2*pi*time/periods(n)) - c(2*n + 1)*sin(2*pi*time/periods(n))
      end do
      fit_misfit = norm2(left)/sqrt(real(size(film), dp))
   end function fit_misfit

   !> Mean less the first sample, c and s of the fit for each period; NaN where there is none.
   pure function coefficients(time, film, periods) result(c)
      real(dp), intent(in) :: time(:), film(:), periods(:)
      real(dp) :: c(1 + 2*size(periods))
      real(dp) :: basis(size(time), size(c)), normal(size(c), size(c)), right(size(c)), solution(size(c))
      logical :: is_solved
      integer :: n

      c = no_value
      if (size(time) < size(c)) return
      basis(:, 1) = 1
      do n = 1, size(periods)
         basis(:, 2*n) = cos(2*pi*time/periods(n))
         basis(:, 2*n + 1) = sin(2*pi*time/periods(n))
      end do
      normal = matmul(transpose(basis), basis)
      right = matmul(transpose(basis), film - film(1))
      call solve_small(normal, right, singular*size(time), solution, is_solved)
      if (is_solved) c = solution
   end function coefficients

end module ehlwave_amplitude
