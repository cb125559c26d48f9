!> Heat of the film and of both bodies, in the plan of a case.
module ehlwave_heat_plan
   use ehlwave_bare_plan, only: bare_plan_t
   use ehlwave_case_definition, only: case_t
   use ehlwave_effect_plan, only: effect_plan_t
   use ehlwave_errors, only: error_t
   use ehlwave_heat_check_plan, only: check_heat, heat_of_oil
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   real(dp), parameter :: cost = 4       !! cost of a solution with heat, relative to isothermal; measured: 1.3 to 5
   real(dp), parameter :: bytes_level = 175   !! memory of a level across the film per cell; measured: within a tenth

   type, extends(effect_plan_t), public :: heat_plan_t
      logical :: is_given = .false.
   contains
      procedure, nopass :: complete => heat_of_oil
      procedure, nopass :: check_data => check_heat
      procedure :: make
      procedure :: multiply_cost
   end type heat_plan_t

contains

   subroutine make(self, case, plan, error)
      class(heat_plan_t), intent(inout) :: self
      type(case_t), intent(in) :: case
      class(bare_plan_t), intent(inout) :: plan
      type(error_t), allocatable, intent(inout) :: error
      self%is_given = case%effects%heat%is_given()
      if (.not. self%is_given) return
      plan%levels = case%effects%heat%data%levels + 1
      plan%bytes_of_effects = plan%bytes_of_effects + bytes_level*plan%levels
   end subroutine make

   subroutine multiply_cost(self, steady, step)
      class(heat_plan_t), intent(in) :: self
      real(dp), intent(inout) :: steady, step
      if (.not. self%is_given) return
      steady = cost*steady
      step = cost*step
   end subroutine multiply_cost

end module ehlwave_heat_plan
