!> The list of effects in the result of a case. A new effect is a component and a line of `effect`.
module ehlwave_effects_result
   use ehlwave_case_definition, only: case_t
   use ehlwave_effect_result, only: effect_result_t
   use ehlwave_effects_keys, only: effect_count
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
   use ehlwave_starvation_result, only: starvation_result_t
   implicit none (type, external)
   private

   type, public :: effects_result_t
      type(starvation_result_t) :: starvation
   contains
      procedure :: effect
      procedure :: solve
      procedure :: take
      procedure :: warning
      procedure :: error_factor
      procedure :: edge_error
      procedure :: lacks_oil_outside
      procedure :: widen_errors
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
      case default; one => self%starvation
      end select
   end function effect

   !> Bring the effects into the steady state of smooth surfaces, one after another.
   subroutine solve(self, plan, multigrid, rescue, limits, coarse_tolerance)
      class(effects_result_t), intent(inout), target :: self
      type(case_plan_t), intent(in) :: plan
      type(full_multigrid_t), intent(inout) :: multigrid
      type(rescue_t), intent(inout) :: rescue
      type(solve_limits_t), intent(in) :: limits     !! for the finest level
      real(dp), intent(in) :: coarse_tolerance       !! for the others
      class(effect_result_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         call one%solve(plan, multigrid, rescue, limits, coarse_tolerance)
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
   function warning(self, grid) result(text)
      class(effects_result_t), intent(in), target :: self
      type(grid_t), intent(in) :: grid
      character(len=:), allocatable :: text
      class(effect_result_t), pointer :: one
      integer :: k
      text = ''
      do k = 1, effect_count
         one => self%effect(k)
         if (text /= '' .and. one%warning(grid) /= '') text = text//'; '
         text = text//one%warning(grid)
      end do
   end function warning

   !> Factor of the film error that grids or models show.
   real(dp) function error_factor(self)
      class(effects_result_t), intent(in), target :: self
      class(effect_result_t), pointer :: one
      integer :: k
      error_factor = 1
      do k = 1, effect_count
         one => self%effect(k)
         error_factor = error_factor*one%error_factor()
      end do
   end function error_factor

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

   !> Widen the errors of the own numbers, once that of the film is known.
   subroutine widen_errors(self, grid, film_error)
      class(effects_result_t), intent(inout), target :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: film_error             !! relative
      class(effect_result_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         call one%widen_errors(grid, film_error)
      end do
   end subroutine widen_errors

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

   !> Give a march what the effects change in time.
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
   subroutine take_fields(self, plan, level)
      class(effects_result_t), intent(inout), target :: self
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(in) :: level
      class(effect_result_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         call one%take_fields(plan, level)
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
   subroutine add_quantities(self, list, plan)
      class(effects_result_t), intent(in), target :: self
      type(quantity_list_t), intent(inout) :: list
      type(case_plan_t), intent(in) :: plan
      class(effect_result_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         call one%add_quantities(list, plan)
      end do
   end subroutine add_quantities

   !> Print the lines of the report.
   subroutine print(self, unit)
      class(effects_result_t), intent(in), target :: self
      integer, intent(in) :: unit
      class(effect_result_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         call one%print(unit)
      end do
   end subroutine print

end module ehlwave_effects_result
