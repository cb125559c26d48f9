!> The result of one case, the numbers of its physical effects included.
module ehlwave_case_result
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_bare_result, only: bare_result_t, gradient_t, gradients, of_central_film, of_friction, of_minimum_film, &
      of_marched_phase, of_marched_ratio, of_mean_film, of_phase, of_ratio, of_rolling_coefficient, &
      of_rolling_force, of_share, of_speed, oil_sensitivity_t, rung_length
   use ehlwave_effects_result, only: effects_result_t
   use ehlwave_kinds, only: dp
   use ehlwave_surface_result, only: surface_result_t
   implicit none (type, external)
   private
   public :: gradient_t, gradients, of_central_film, of_friction, of_marched_phase, of_marched_ratio, of_mean_film, &
      of_minimum_film, of_phase, of_ratio, &
      of_rolling_coefficient, of_rolling_force, of_share, of_speed, oil_sensitivity_t, rung_length

   type, extends(bare_result_t), public :: case_result_t
      type(effects_result_t) :: effects
   contains
      procedure :: surface
      procedure :: ratios
      procedure :: response_error
   end type case_result_t

contains

   !> Results of surface n, 1 or 2.
   function surface(self, n)
      class(case_result_t), intent(in), target :: self
      integer, intent(in) :: n
      type(surface_result_t), pointer :: surface
      surface => self%surface_result_t
      if (n == 2) surface => self%effects%second%surface
   end function surface

   !> Ad/Ai of the surfaces by harmonic fit.
   pure function ratios(self, surfaces)
      class(case_result_t), intent(in) :: self
      integer, intent(in) :: surfaces                !! 1, or 2 for both
      real(dp) :: ratios(surfaces)
      ratios = self%effects%second%surface%amplitude_ratio_fit
      ratios(1) = self%amplitude_ratio_fit
   end function ratios

   !> Relative error of the linear response by the mesh, the larger error of two surfaces.
   pure real(dp) function response_error(self)
      class(case_result_t), intent(in) :: self
      real(dp) :: errors(2)
      errors = [self%harmonic%error, self%effects%second%surface%harmonic%error]
      response_error = errors(1)
      if (ieee_is_finite(errors(2))) response_error = maxval(errors)
   end function response_error

end module ehlwave_case_result
