!> One physical effect in the result of a case: its steady state, its numbers, and its errors.
!>
!> An effect overrides the procedures that concern it; the procedures here do nothing.
module ehlwave_effect_result
   use ehlwave_bare_result, only: bare_result_t
   use ehlwave_case_definition, only: case_t
   use ehlwave_energy, only: energy_t
   use ehlwave_error_parts, only: error_parts_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_grid, only: grid_t
   use ehlwave_hdf5_file, only: hdf5_file_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_march_settings, only: march_settings_t
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_rescue, only: rescue_t
   use ehlwave_solve_report, only: solve_limits_t
   implicit none (type, external)
   private

   ! Places of quantities and report lines.
   integer, parameter, public :: after_film = 1, after_friction = 2, after_waves = 3

   type, abstract, public :: effect_result_t
   contains
      procedure, nopass :: place
      procedure :: solve
      procedure :: take
      procedure :: describe_state
      procedure :: warning
      procedure :: film_error
      procedure :: steepening
      procedure :: edge_error
      procedure :: lacks_oil_outside
      procedure :: add_own_errors
      procedure :: add_errors
      procedure :: advice
      procedure, nopass :: set_march
      procedure :: take_fields
      procedure :: write_fields
      procedure :: add_quantities
      procedure :: print
   end type effect_result_t

contains

   !> Place of the quantities and of the report lines.
   pure integer function place()
      place = after_film
   end function place

   !> Bring the effect into the steady state of smooth surfaces that all levels have without it.
   subroutine solve(self, case, plan, multigrid, rescue, limits, coarse_tolerance, energy)
      class(effect_result_t), intent(inout) :: self
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(full_multigrid_t), intent(inout) :: multigrid
      type(rescue_t), intent(inout) :: rescue
      type(solve_limits_t), intent(in) :: limits     !! for the finest level
      real(dp), intent(in) :: coarse_tolerance       !! for the others
      type(energy_t), intent(inout) :: energy        !! energy equation of a steady state with temperatures
   end subroutine solve

   !> Take the numbers of the converged steady state.
   subroutine take(self, plan, levels, work)
      class(effect_result_t), intent(inout) :: self
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(in) :: levels(:)         !! coarsest first
      real(dp), intent(in) :: work                   !! operations so far
   end subroutine take

   !> Append to the name of the steady state in messages, as " with heat", and the reason why it was not found.
   subroutine describe_state(self, name, failure)
      class(effect_result_t), intent(in) :: self
      character(len=:), allocatable, intent(inout) :: name, failure
   end subroutine describe_state

   !> Warning of effects that the model leaves out and that matter here; '': none.
   function warning(self, case, plan, grid) result(text)
      class(effect_result_t), intent(in) :: self
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(grid_t), intent(in) :: grid
      character(len=:), allocatable :: text
      text = ''
   end function warning

   !> Relative error of the film by the solution of the effect.
   real(dp) function film_error(self) result(error)
      class(effect_result_t), intent(in) :: self
      error = 0
   end function film_error

   !> Increase of the inlet's steepness by the effect, over 1.
   real(dp) function steepening(self, film)
      class(effect_result_t), intent(in) :: self
      real(dp), intent(in) :: film                   !! H(0,0)
      steepening = 0
   end function steepening

   !> Relative error of the film by a domain that is too short for the effect.
   real(dp) function edge_error(self) result(error)
      class(effect_result_t), intent(in) :: self
      error = 0
   end function edge_error

   !> Whether the inlet edge has less oil than gap.
   logical function lacks_oil_outside(self, grid)
      class(effect_result_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      lacks_oil_outside = .false.
   end function lacks_oil_outside

   !> Add the errors by the solution of the effect to the errors of film and friction, and widen the errors of its own
   !> results.
   subroutine add_own_errors(self, result)
      class(effect_result_t), intent(inout) :: self
      class(bare_result_t), intent(inout) :: result
   end subroutine add_own_errors

   !> Put the part of the effect into the errors of film and Ad/Ai.
   subroutine add_errors(self, k, case, plan, film, ratio)
      class(effect_result_t), intent(in) :: self
      integer, intent(in) :: k                       !! number of the effect
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(error_parts_t), intent(inout) :: film, ratio
   end subroutine add_errors

   !> Advice where the effect makes most of the film error; '': none.
   function advice(self, plan, film_error) result(text)
      class(effect_result_t), intent(in) :: self
      type(case_plan_t), intent(in) :: plan
      real(dp), intent(in) :: film_error             !! relative, all parts
      character(len=:), allocatable :: text
      text = ''
   end function advice

   !> Give a march the changes of the effect in time.
   subroutine set_march(case, settings)
      type(case_t), intent(in) :: case
      type(march_settings_t), intent(inout) :: settings
   end subroutine set_march

   !> Take the fields of the last solution.
   subroutine take_fields(self, plan, level, energy)
      class(effect_result_t), intent(inout) :: self
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(in) :: level
      type(energy_t), intent(in) :: energy
   end subroutine take_fields

   !> Write the fields.
   subroutine write_fields(self, file)
      class(effect_result_t), intent(in) :: self
      type(hdf5_file_t), intent(inout) :: file
   end subroutine write_fields

   !> Add the quantities of the result; those that a case lacks do not exist.
   subroutine add_quantities(self, list, case, plan)
      class(effect_result_t), intent(in) :: self
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
   end subroutine add_quantities

   !> Print the lines of the report.
   subroutine print(self, unit, plan)
      class(effect_result_t), intent(in) :: self
      integer, intent(in) :: unit
      type(case_plan_t), intent(in) :: plan
   end subroutine print

end module ehlwave_effect_result
