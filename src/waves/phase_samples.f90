!> Something periodic by its values at equidistant phases.
module ehlwave_phase_samples
   use ehlwave_kinds, only: dp, pi
   implicit none (type, external)
   private
   public :: new_phase_samples

   !> Phases phi(k) = 2 pi (k - 1)/n, k = 1..n, n odd: they determine a mean and (n - 1)/2 harmonics,
   !>
   !>     u(phi) = Re sum over m >= 0 of u_m exp(-i m phi).
   type, public :: phase_samples_t
      integer :: n = 1
      integer :: harmonics = 0
      complex(dp), allocatable :: factor(:, :)   !! (n, 0:harmonics) exp(-i m phi(k))
   contains
      procedure :: delayed
      procedure :: harmonic
      procedure :: value
   end type phase_samples_t

contains

   !> Samples of a mean and so many harmonics.
   pure function new_phase_samples(harmonics) result(self)
      integer, intent(in) :: harmonics
      type(phase_samples_t) :: self
      integer :: k, m
      self%harmonics = harmonics
      self%n = 2*harmonics + 1
      allocate (self%factor(self%n, 0:harmonics))
      do m = 0, harmonics
         self%factor(:, m) = [(exp(cmplx(0, -2*pi*m*(k - 1)/self%n, dp)), k=1, self%n)]
      end do
   end function new_phase_samples

   !> Weights of the samples in the values at the phases phi(k) - delay, by trigonometric interpolation.
   pure function delayed(self, delay) result(weight)
      class(phase_samples_t), intent(in) :: self
      real(dp), intent(in) :: delay              !! radian
      real(dp) :: weight(self%n, self%n)         !! (k, of sample j)
      real(dp) :: distance
      integer :: j, k, m
      do j = 1, self%n
         do k = 1, self%n
            distance = 2*pi*(k - j)/self%n - delay
            weight(k, j) = (1 + 2*sum([(cos(m*distance), m=1, self%harmonics)]))/self%n
         end do
      end do
   end function delayed

   !> Amplitude u_m of what has these samples.
   pure complex(dp) function harmonic(self, m, samples)
      class(phase_samples_t), intent(in) :: self
      integer, intent(in) :: m                   !! 0: the mean
      real(dp), intent(in) :: samples(:)         !! (n)
      harmonic = merge(1, 2, m == 0)*sum(conjg(self%factor(:, m))*samples)/self%n
   end function harmonic

   !> Value at any phase.
   pure real(dp) function value(self, samples, phase)
      class(phase_samples_t), intent(in) :: self
      real(dp), intent(in) :: samples(:)         !! (n)
      real(dp), intent(in) :: phase              !! radian
      integer :: m
      value = 0
      do m = 0, self%harmonics
         value = value + real(self%harmonic(m, samples)*exp(cmplx(0, -m*phase, dp)), dp)
      end do
   end function value

end module ehlwave_phase_samples
