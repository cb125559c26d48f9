!> The list of effects in the result of a case. A new effect is a component and a line of `effect`.
module ehlwave_effects_result
   use ehlwave_bare_result, only: bare_result_t
   use ehlwave_case_definition, only: case_t
   use ehlwave_effect_result, only: effect_result_t
   use ehlwave_effects_keys, only: effect_count
   use ehlwave_energy, only: energy_t
   use ehlwave_error_parts, only: error_parts_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_grid, only: grid_t
   use ehlwave_hdf5_file, only: hdf5_file_t
   use ehlwave_heat_result, only: heat_result_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_march_settings, only: march_settings_t
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_rescue, only: rescue_t
   use ehlwave_second_surface_result, only: second_surface_result_t
   use ehlwave_solve_report, only: solve_limits_t
   use ehlwave_starvation_result, only: starvation_result_t
   use ehlwave_touching_result, only: touching_result_t
   implicit none (type, external)
   private

   type, public :: effects_result_t
      type(heat_result_t) :: heat
      type(touching_result_t) :: touching
      type(second_surface_result_t) :: second
      type(starvation_result_t) :: starvation
   contains
      procedure :: effect
      procedure :: solve
      procedure :: describe_state
      procedure :: film_error
      procedure :: steepening
      procedure :: add_own_errors
      procedure :: take
      procedure :: warning
      procedure :: edge_error
      procedure :: lacks_oil_outside
      procedure :: add_errors
      procedure :: advice
      procedure :: set_march
      procedure :: take_fields
      procedure :: write_fields
      procedure :: add_quantities
      procedure :: print
   end type effects_result_t

contains

   !> Effect number k, in the order of `effects_keys`.
   function effect(self, k) result(one)
      class(effects_result_t), target :: self
      integer, intent(in) :: k
      class(effect_result_t), pointer :: one
      select case (k)
      case (1); one => self%heat
      case (2); one => self%touching
      case (3); one => self%second
      case default; one => self%starvation
      end select
   end function effect

   !> Bring the effects into the steady state of smooth surfaces, one after another.
   subroutine solve(self, case, plan, multigrid, rescue, limits, coarse_tolerance, energy)
      class(effects_result_t), intent(inout), target :: self
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(full_multigrid_t), intent(inout) :: multigrid
      type(rescue_t), intent(inout) :: rescue
      type(solve_limits_t), intent(in) :: limits     !! for the finest level
      real(dp), intent(in) :: coarse_tolerance       !! for the others
      type(energy_t), intent(inout) :: energy        !! energy equation of a steady state with temperatures
      class(effect_result_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         call one%solve(case, plan, multigrid, rescue, limits, coarse_tolerance, energy)
      end do
   end subroutine solve

   !> Take the numbers of the converged steady state.
   subroutine take(self, plan, levels, work)
      class(effects_result_t), intent(inout), target :: self
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(in) :: levels(:)         !! coarsest first
      real(dp), intent(in) :: work                   !! operations so far
      class(effect_result_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         call one%take(plan, levels, work)
      end do
   end subroutine take

   !> Warnings of effects that the model leaves out and that matter here.
   function warning(self, case, plan, grid) result(text)
      class(effects_result_t), intent(in), target :: self
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(grid_t), intent(in) :: grid
      character(len=:), allocatable :: text
      class(effect_result_t), pointer :: one
      integer :: k
      text = ''
      do k = 1, effect_count
         one => self%effect(k)
         if (text /= '' .and. one%warning(case, plan, grid) /= '') text = text//'; '
         text = text//one%warning(case, plan, grid)
      end do
   end function warning

   !> Relative error of the film by a domain that is too short for the effects.
   real(dp) function edge_error(self)
      class(effects_result_t), intent(in), target :: self
      class(effect_result_t), pointer :: one
      integer :: k
      edge_error = 0
      do k = 1, effect_count
         one => self%effect(k)
         edge_error = edge_error + one%edge_error()
      end do
   end function edge_error

   !> Whether the inlet edge has less oil than gap.
   logical function lacks_oil_outside(self, grid)
      class(effects_result_t), intent(in), target :: self
      type(grid_t), intent(in) :: grid
      class(effect_result_t), pointer :: one
      integer :: k
      lacks_oil_outside = .false.
      do k = 1, effect_count
         one => self%effect(k)
         lacks_oil_outside = lacks_oil_outside .or. one%lacks_oil_outside(grid)
      end do
   end function lacks_oil_outside

   !> Put the parts of the effects into the errors of film and Ad/Ai.
   subroutine add_errors(self, case, plan, film, ratio)
      class(effects_result_t), intent(in), target :: self
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(error_parts_t), intent(inout) :: film, ratio
      class(effect_result_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         call one%add_errors(k, case, plan, film, ratio)
      end do
   end subroutine add_errors

   !> Advice where an effect makes most of the film error; '': none.
   function advice(self, plan, film_error) result(text)
      class(effects_result_t), intent(in), target :: self
      type(case_plan_t), intent(in) :: plan
      real(dp), intent(in) :: film_error             !! relative, all parts
      character(len=:), allocatable :: text
      class(effect_result_t), pointer :: one
      integer :: k
      text = ''
      do k = 1, effect_count
         one => self%effect(k)
         if (text == '') text = one%advice(plan, film_error)
      end do
   end function advice

   !> Give a march the changes of the effects in time.
   subroutine set_march(self, case, settings)
      class(effects_result_t), intent(in), target :: self
      type(case_t), intent(in) :: case
      type(march_settings_t), intent(inout) :: settings
      class(effect_result_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         call one%set_march(case, settings)
      end do
   end subroutine set_march

   !> Take the fields of the last solution.
   subroutine take_fields(self, plan, level, energy)
      class(effects_result_t), intent(inout), target :: self
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(in) :: level
      type(energy_t), intent(in) :: energy
      class(effect_result_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         call one%take_fields(plan, level, energy)
      end do
   end subroutine take_fields

   !> Write the fields.
   subroutine write_fields(self, file)
      class(effects_result_t), intent(in), target :: self
      type(hdf5_file_t), intent(inout) :: file
      class(effect_result_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         call one%write_fields(file)
      end do
   end subroutine write_fields

   !> Add the quantities of the result.
   subroutine add_quantities(self, place, list, case, plan)
      class(effects_result_t), intent(in), target :: self
      integer, intent(in) :: place                   !! where they are, see `effect_result`
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      class(effect_result_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         if (one%place() == place) call one%add_quantities(list, case, plan)
      end do
   end subroutine add_quantities

   !> Print the lines of the report.
   subroutine print(self, place, unit, plan)
      class(effects_result_t), intent(in), target :: self
      integer, intent(in) :: place                   !! where they are, see `effect_result`
      integer, intent(in) :: unit
      type(case_plan_t), intent(in) :: plan
      class(effect_result_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         if (one%place() == place) call one%print(unit, plan)
      end do
   end subroutine print

   !> Name of the steady state in messages, and reasons why it was not found.
   subroutine describe_state(self, name, failure)
      class(effects_result_t), intent(in), target :: self
      character(len=:), allocatable, intent(inout) :: name, failure
      class(effect_result_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         call one%describe_state(name, failure)
      end do
   end subroutine describe_state

   !> Relative error of the film by the solution of the effects.
   real(dp) function film_error(self)
      class(effects_result_t), intent(in), target :: self
      class(effect_result_t), pointer :: one
      integer :: k
      film_error = 0
      do k = 1, effect_count
         one => self%effect(k)
         film_error = film_error + one%film_error()
      end do
   end function film_error

   !> Increase of the inlet's steepness by the effects, over 1.
   real(dp) function steepening(self, film)
      class(effects_result_t), intent(in), target :: self
      real(dp), intent(in) :: film                   !! H(0,0)
      class(effect_result_t), pointer :: one
      integer :: k
      steepening = 0
      do k = 1, effect_count
         one => self%effect(k)
         steepening = steepening + one%steepening(film)
      end do
   end function steepening

   !> Add the errors by the solution of the effects to the errors of film and friction, and widen their own errors.
   subroutine add_own_errors(self, result)
      class(effects_result_t), intent(inout), target :: self
      class(bare_result_t), intent(inout) :: result
      class(effect_result_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         call one%add_own_errors(result)
      end do
   end subroutine add_own_errors

end module ehlwave_effects_result
