!> The result of one case, the numbers of its physical effects included.
module ehlwave_case_result
   use ehlwave_bare_result, only: bare_result_t, gradient_t, gradients, of_central_film, of_friction, of_minimum_film, &
      of_phase, of_ratio, of_rolling_coefficient, of_rolling_force, of_share, of_speed, oil_sensitivity_t, rung_length
   use ehlwave_effects_result, only: effects_result_t
   implicit none (type, external)
   private
   public :: gradient_t, gradients, of_central_film, of_friction, of_minimum_film, of_phase, of_ratio, &
      of_rolling_coefficient, of_rolling_force, of_share, of_speed, oil_sensitivity_t, rung_length

   type, extends(bare_result_t), public :: case_result_t
      type(effects_result_t) :: effects
   end type case_result_t

end module ehlwave_case_result
