!> Amplitude of the film oscillation at the contact centre.
module ehlwave_amplitude
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_kinds, only: dp, no_value, pi
   implicit none (type, external)
   private
   public :: sampled_amplitude, fitted_harmonic, fitted_mean

   real(dp), parameter :: singular = 1e-12_dp   !! smallest pivot of the fit, per sample

contains

   !> Half the difference between the largest and the smallest sample, theory eq. (14).
   pure real(dp) function sampled_amplitude(film)
      real(dp), intent(in) :: film(:)   !! H(0,0) at the sampled times, at least one period
      sampled_amplitude = 0.5_dp*(maxval(film) - minval(film))
   end function sampled_amplitude

   !> Least squares fit of a mean and harmonics (`harmonics_of`), of which the first is c cos(omega T) + s sin(omega T); returns c + i s,
   !> which stands for the real part of (c + i s) exp(-i omega T) and has the amplitude of the wave as its modulus. NaN where the samples
   !> do not determine mean, c and s: fewer than three of them, or all at two phases of the wave only (two time steps per period).
   pure complex(dp) function fitted_harmonic(time, film, period)
      real(dp), intent(in) :: time(:)   !! T of the samples
      real(dp), intent(in) :: film(:)   !! H(0,0) at these times
      real(dp), intent(in) :: period    !! forcing period in T
      real(dp) :: c(1 + 2*harmonics_of(size(time)))
      c = coefficients(time, film, period)
      fitted_harmonic = cmplx(c(2), c(3), dp)
   end function fitted_harmonic

   !> Mean of an oscillation whose samples need not fill whole periods: that of the same fit. Where there is none, the mean of
   !> the samples, which is off by up to the amplitude over their number for each part of a period that is missing.
   pure real(dp) function fitted_mean(time, film, period)
      real(dp), intent(in) :: time(:)   !! T of the samples
      real(dp), intent(in) :: film(:)   !! H(0,0) at these times
      real(dp), intent(in) :: period    !! forcing period in T
      real(dp) :: c(1 + 2*harmonics_of(size(time)))
      c = coefficients(time, film, period)
      fitted_mean = sum(film)/size(film)
      if (ieee_is_finite(c(1))) fitted_mean = film(1) + c(1)
   end function fitted_mean

   !> Harmonics to fit to so many samples: one leaves the higher ones in the mean and in itself where the samples do not fill whole
   !> periods (those of one period and one step more, of waves of 20 % of the film, 128 cells: 2e-3 of Ad/Ai).
   pure integer function harmonics_of(samples)
      integer, intent(in) :: samples
      harmonics_of = max(1, min(3, (samples - 1)/4))
   end function harmonics_of

   !> Mean less the first sample, and cosine and sine of each harmonic; NaN where there is no fit.
   pure function coefficients(time, film, period) result(c)
      real(dp), intent(in) :: time(:), film(:), period
      real(dp) :: c(1 + 2*harmonics_of(size(time)))
      real(dp) :: basis(size(time), size(c)), normal(size(c), size(c)), right(size(c)), factor
      integer :: i, j, n

      c = no_value
      n = size(c)
      if (size(time) < 3) return
      basis(:, 1) = 1
      do i = 1, n/2
         basis(:, 2*i) = cos(2*pi*i*time/period)
         basis(:, 2*i + 1) = sin(2*pi*i*time/period)
      end do
      normal = matmul(transpose(basis), basis)
      right = matmul(transpose(basis), film - film(1))
      do i = 1, n                       ! elimination; the matrix is symmetric positive definite
         if (.not. normal(i, i) > singular*size(time)) return
         do j = i + 1, n
            factor = normal(j, i)/normal(i, i)
            normal(j, :) = normal(j, :) - factor*normal(i, :)
            right(j) = right(j) - factor*right(i)
         end do
      end do
      do i = n, 1, -1
         right(i) = (right(i) - dot_product(normal(i, i + 1:), right(i + 1:)))/normal(i, i)
      end do
      c = right
   end function coefficients

end module ehlwave_amplitude
