!> The result of the linear response of a case.
module ehlwave_harmonic_result
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_mean_film, only: mean_change_t
   use ehlwave_two_wave_result, only: two_wave_result_t
   implicit none (type, external)
   private

   !> All numbers are NaN without a response; those at mesh size 0 and `error` also without a second grid.
   type, public :: harmonic_result_t
      real(dp) :: ratio = no_value           !! |H(0,0)| over Ai on the grid of the case: Ad/Ai for small waves
      real(dp) :: phase = no_value           !! radian by which the film at the centre follows the pattern there
      real(dp) :: real_part = no_value       !! complex transfer function from the pattern to H(0,0)
      real(dp) :: imaginary_part = no_value
      real(dp) :: approach_ratio = no_value  !! amplitude of the mutual approach over Ai
      real(dp) :: extrapolated = no_value    !! ratio extrapolated to mesh size 0
      complex(dp) :: pressure = (no_value, no_value)   !! transfer function from the pattern to P(0,0)
      complex(dp) :: film_limit = (no_value, no_value), &   !! transfer functions at mesh size 0
                     pressure_limit = (no_value, no_value)
      real(dp) :: error = no_value           !! estimated discretisation error of `ratio` and bound for `extrapolated`,
                                             !! relative
      character(len=12) :: error_basis = ''  !! basis of the error: 'coarse_grid' or 'model'
      integer :: linear_steps = 0            !! GMRES steps on the grid of the case
      real(dp) :: work_units = no_value      !! work of the response on the grid of the case, without the steady state
      real(dp) :: counted_work_units = no_value   !! the same, counted
      real(dp) :: mean_rise = no_value       !! change of the mean of H(0,0) over Ai, second order, for the Ai of the
                                             !! case
      real(dp) :: smallest_film = no_value   !! smallest H with waves of that Ai, to second order; none where they would
                                             !! touch
      logical, allocatable :: surfaces_touch !! mean film and rise do not exceed the amplitude somewhere; unallocated:
                                             !! not known
      real(dp) :: smallest_film_x = no_value, smallest_film_y = no_value   !! where it is
      type(two_wave_result_t) :: waves       !! waves of the film under slip
      complex(dp), allocatable :: p(:, :), h(:, :)   !! amplitudes of P and H over Ai, if asked for
   contains
      procedure :: take
      procedure :: take_mean
      procedure :: extrapolate
   end type harmonic_result_t

   real(dp), parameter :: error_ratio = 4   !! ratio of errors of a second-order scheme on two grids, mesh sizes 2 to 1

contains

   !> Take the transfer functions of film, pressure and approach on the grid of the case.
   pure subroutine take(self, film, pressure, approach)
      class(harmonic_result_t), intent(inout) :: self
      complex(dp), intent(in) :: film, pressure, approach
      self%ratio = abs(film)
      self%phase = atan2(aimag(film), real(film, dp))
      self%real_part = real(film, dp)
      self%imaginary_part = aimag(film)
      self%pressure = pressure
      self%approach_ratio = abs(approach)
   end subroutine take

   !> Take the change of the mean by waves of an amplitude Ai, in units of c.
   pure subroutine take_mean(self, change, amplitude)
      class(harmonic_result_t), intent(inout) :: self
      type(mean_change_t), intent(in) :: change
      real(dp), intent(in) :: amplitude
      self%mean_rise = change%film/amplitude
      self%surfaces_touch = .not. change%smallest_film > 0
      if (.not. self%surfaces_touch) self%smallest_film = change%smallest_film
      self%smallest_film_x = change%smallest_at(1)
      self%smallest_film_y = change%smallest_at(2)
   end subroutine take_mean

   !> Richardson extrapolation of the complex transfer functions from the grid of the case and a grid with twice the
   !> mesh size: T + (T - T_coarse)/3.
   pure subroutine extrapolate(self, coarse_film, coarse_pressure)
      class(harmonic_result_t), intent(inout) :: self
      complex(dp), intent(in) :: coarse_film, coarse_pressure
      complex(dp) :: correction, film
      film = cmplx(self%real_part, self%imaginary_part, dp)
      if (.not. ieee_is_finite(abs(coarse_film))) return
      correction = (film - coarse_film)/(error_ratio - 1)
      self%film_limit = film + correction
      self%pressure_limit = self%pressure + (self%pressure - coarse_pressure)/(error_ratio - 1)
      self%extrapolated = abs(self%film_limit)
   end subroutine extrapolate

end module ehlwave_harmonic_result
