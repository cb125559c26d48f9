!> The plan of one case, its physical effects included.
module ehlwave_planned_case
   use ehlwave_bare_plan, only: bare_plan_t, run_harmonic, run_march, run_smooth, run_standing
   use ehlwave_effects_plan, only: effects_plan_t
   implicit none (type, external)
   private
   public :: run_harmonic, run_march, run_smooth, run_standing

   type, extends(bare_plan_t), public :: case_plan_t
      type(effects_plan_t) :: effects
   end type case_plan_t

end module ehlwave_planned_case
