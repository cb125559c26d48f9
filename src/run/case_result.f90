!> The result of one case, the numbers of its physical effects included.
module ehlwave_case_result
   use ehlwave_bare_result, only: bare_result_t, oil_sensitivity_t, rung_length
   use ehlwave_effects_result, only: effects_result_t
   implicit none (type, external)
   private
   public :: oil_sensitivity_t, rung_length

   type, extends(bare_result_t), public :: case_result_t
      type(effects_result_t) :: effects
   end type case_result_t

end module ehlwave_case_result
