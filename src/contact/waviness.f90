!> A rough surface that moves: harmonic waviness, or measured heights.
module ehlwave_waviness
   use ehlwave_kinds, only: dp, pi
   use ehlwave_surface, only: surface_t
   implicit none (type, external)
   private
   public :: new_waviness, no_waviness, surface_waviness

   !> Waviness in dimensionless coordinates, theory eq. (12) and (13). With a measured surface the wavelengths are its
   !> RMS averages, which decide the resolution.
   type, public :: waviness_t
      logical :: is_present = .false.
      real(dp) :: wavelength_x = 0   !! lambda_x/a; 0: no variation along X
      real(dp) :: wavelength_y = 0   !! lambda_y/b; 0: no variation along Y
      logical :: is_oblique = .false. !! cos(kx X + ky Y) in place of cos(kx X) cos(ky Y)
      real(dp) :: start = -2.5_dp    !! Xs: position of the front at T = 0
      real(dp) :: slip = 1           !! speed in units of the mean speed: S = u1/ubar of the first surface, 2 - S of the
                                     !! second
      real(dp) :: amplitude_over_film = 0   !! amplitude of waves: Ai over the smooth H(0,0)
      real(dp) :: amplitude_over_c = 0      !! Ai in units of c in its place, if above 0
      type(surface_t), allocatable :: surface   !! the measured surface, if any
   contains
      procedure :: moves
      procedure :: is_longitudinal
      procedure :: is_symmetric
      procedure :: period
      procedure :: frequency
      procedure :: shape_at
      procedure :: shape_fixed
      procedure :: amplitude_at
      procedure :: amplitude
      procedure :: equivalent_amplitude
   end type waviness_t

   real(dp), parameter :: front_decay = 10   !! exponent of the smooth front, eq. (13)

contains

   !> A smooth surface.
   pure function no_waviness() result(self)
      type(waviness_t) :: self
      self%is_present = .false.
   end function no_waviness

   !> A pattern with wavelengths in units of a and b; at least one is positive.
   pure function new_waviness(wavelength_x, wavelength_y, is_oblique, start, slip, amplitude_over_film) result(self)
      real(dp), intent(in) :: wavelength_x, wavelength_y   !! lambda_x/a, lambda_y/b; 0: infinite
      logical, intent(in) :: is_oblique                    !! one plane wave in place of a product
      real(dp), intent(in) :: start                        !! Xs
      real(dp), intent(in) :: slip                         !! S
      real(dp), intent(in), optional :: amplitude_over_film   !! Ai over the smooth H(0,0)
      type(waviness_t) :: self
      self%is_present = .true.
      if (present(amplitude_over_film)) self%amplitude_over_film = amplitude_over_film
      self%wavelength_x = wavelength_x
      self%wavelength_y = wavelength_y
      self%is_oblique = is_oblique .and. wavelength_x > 0 .and. wavelength_y > 0
      self%start = start
      self%slip = slip
   end function new_waviness

   !> A measured surface, its leading end at X = start at T = 0.
   pure function surface_waviness(surface, start, slip) result(self)
      type(surface_t), intent(in) :: surface
      real(dp), intent(in) :: start                        !! Xs
      real(dp), intent(in) :: slip                         !! S
      type(waviness_t) :: self
      self%is_present = .true.
      self%wavelength_x = surface%wavelength_x
      self%wavelength_y = surface%wavelength_y
      self%start = start
      self%slip = slip
      self%surface = surface
   end function surface_waviness

   !> The factor of the shape, in units of c: Ai of waves, 1 of heights, which are in units of c as they are.
   pure real(dp) function amplitude(self, film)
      class(waviness_t), intent(in) :: self
      real(dp), intent(in) :: film                         !! smooth H(0,0)
      amplitude = 1
      if (allocated(self%surface)) return
      amplitude = self%amplitude_over_film*film
      if (self%amplitude_over_c > 0) amplitude = self%amplitude_over_c
   end function amplitude

   !> Amplitude of waves with the same Rq, over the film.
   pure real(dp) function equivalent_amplitude(self, film)
      class(waviness_t), intent(in) :: self
      real(dp), intent(in) :: film                         !! smooth H(0,0)
      equivalent_amplitude = self%amplitude_over_film
      if (self%amplitude_over_c > 0) equivalent_amplitude = self%amplitude_over_c/film
      if (allocated(self%surface)) equivalent_amplitude = sqrt(2.0_dp)*self%surface%rq/film
   end function equivalent_amplitude

   !> Whether the gap changes in time: the pattern varies along X and its surface moves.
   pure logical function moves(self)
      class(waviness_t), intent(in) :: self
      moves = self%is_present .and. self%wavelength_x > 0 .and. abs(self%slip) > 0
   end function moves

   !> Whether the pattern varies along Y only.
   pure logical function is_longitudinal(self)
      class(waviness_t), intent(in) :: self
      is_longitudinal = self%wavelength_y > 0 .and. .not. self%wavelength_x > 0
   end function is_longitudinal

   !> Whether the pattern is even in Y.
   pure logical function is_symmetric(self)
      class(waviness_t), intent(in) :: self
      is_symmetric = .not. (self%is_present .and. self%is_oblique)
      if (allocated(self%surface)) is_symmetric = self%surface%is_even()
   end function is_symmetric

   !> Angular frequency w = kx S of a pattern, in units of 1/T; 0 where it does not move.
   elemental real(dp) function frequency(self)
      class(waviness_t), intent(in) :: self
      frequency = 0
      if (self%moves()) frequency = 2*pi*self%slip/self%wavelength_x
   end function frequency

   !> Time after which a moving pattern repeats, in T.
   pure real(dp) function period(self)
      class(waviness_t), intent(in) :: self
      period = self%wavelength_x/abs(self%slip)
   end function period

   !> Pattern of unit amplitude with its smooth front at time T, theory eq. (12) and (13):
   !>
   !>     10^(-10 max(0, Xhat/lambda)^2) cos(2 pi Xhat/lambda_x) cos(2 pi Y/lambda_y),  Xhat = X - Xs - S T
   !>
   !> Contribution of a measured surface to the gap in units of c: a peak reduces it.
   pure function shape_at(self, x, y, t) result(shape)
      class(waviness_t), intent(in) :: self
      real(dp), intent(in) :: x(:), y(:)           !! node coordinates X, Y
      real(dp), intent(in) :: t                    !! T
      real(dp) :: shape(size(x), size(y))
      real(dp) :: ahead, front(size(x)), x_hat(size(x))
      integer :: i

      if (.not. self%is_present) then
         shape = 0
         return
      else if (allocated(self%surface)) then
         shape = -self%surface%height_at(x, y, self%start + self%slip*t)
         return
      end if
      x_hat = x - self%start - self%slip*t
      do i = 1, size(x)
         ahead = 0
         if (self%wavelength_x > 0) ahead = max(0.0_dp, x_hat(i)/self%wavelength_x)
         front(i) = 0
         if (front_decay*ahead**2 < 300) front(i) = 10**(-front_decay*ahead**2)
      end do
      shape = plane_pattern(self, x_hat, y, 0.0_dp)*spread(front, 2, size(y))
   end function shape_at

   !> Stationary pattern of unit amplitude, a crest of the given phase at the origin: the argument of the cosine
   !> along X (along Y, if the pattern varies only there) is shifted by `phase`.
   pure function shape_fixed(self, x, y, phase) result(shape)
      class(waviness_t), intent(in) :: self
      real(dp), intent(in) :: x(:), y(:)           !! node coordinates X, Y
      real(dp), intent(in) :: phase                !! radian
      real(dp) :: shape(size(x), size(y))
      if (self%is_present) then
         shape = plane_pattern(self, x, y, phase)
      else
         shape = 0
      end if
   end function shape_fixed

   !> Complex amplitude of the moving pattern: shape_fixed is its real part times exp(i phase), the pattern at time T
   !> its real part times exp(-i w T), w = 2 pi S/lambda_x. Real where the pattern does not vary along X.
   pure function amplitude_at(self, x, y) result(amplitude)
      class(waviness_t), intent(in) :: self
      real(dp), intent(in) :: x(:), y(:)           !! node coordinates X, Y
      complex(dp) :: amplitude(size(x), size(y))
      amplitude = self%shape_fixed(x, y, 0.0_dp)
      if (self%wavelength_x > 0) amplitude = amplitude + cmplx(0, self%shape_fixed(x, y, -0.5_dp*pi), dp)
   end function amplitude_at

   pure function plane_pattern(self, x, y, phase) result(shape)
      type(waviness_t), intent(in) :: self
      real(dp), intent(in) :: x(:), y(:), phase
      real(dp) :: shape(size(x), size(y))
      real(dp) :: kx, ky, along(size(x)), across(size(y))
      integer :: j

      kx = 0
      ky = 0
      if (self%wavelength_x > 0) kx = 2*pi/self%wavelength_x
      if (self%wavelength_y > 0) ky = 2*pi/self%wavelength_y
      if (self%is_oblique) then
         do j = 1, size(y)
            shape(:, j) = cos(kx*x + ky*y(j) + phase)
         end do
      else
         along = cos(kx*x + phase)
         across = cos(ky*y)
         do j = 1, size(y)
            shape(:, j) = along*across(j)
         end do
      end if
   end function plane_pattern

end module ehlwave_waviness
