!> The time steps of a plan: how long they are and how many.
module ehlwave_march_plan
   use ehlwave_accuracy_model, only: expected_long_step_error
   use ehlwave_case_definition, only: case_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_formula, only: expected_film
   use ehlwave_grid_choice, only: formula_ratio
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t, run_march
   use ehlwave_resolution, only: fewest_points_per_wave
   use ehlwave_scheme_choice, only: longest_step, takes_long_steps
   use ehlwave_surface_plan, only: surface_times
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: plan_march

   integer, parameter :: most_steps = 1000000
   real(dp), parameter :: share_of_steps = 0.2_dp    !! share of the accuracy, for steps longer than hX
   real(dp), parameter :: load_time = 1              !! T more that the film takes to follow a load step at T = 0
   real(dp), parameter :: outlet_end = 1             !! X of the outlet end of the Hertzian contact

contains

   !> Steps until the slower of the surface pattern (speed S) and of the pattern in the lubricant (speed 1) has
   !> passed the outlet end, `settling_periods` more (measured: long waves, lambda = 2 a, are 2 per cent off in the
   !> first period and below 0.1 per cent in the second), then one period. A measured surface is followed until its
   !> trailing end is at the contact centre. Two surfaces with waves are measured until they repeat together, or for a
   !> beat. Where the layer of oil changes, they are measured once the change has passed and the inlet has followed, and
   !> after a load step somewhat later. An `end_time` overrides all; if it comes before patterns and change have passed
   !> plus one period, no amplitude is measured. Fails where a change of the layer comes after the end.
   subroutine plan_march(case, plan, error)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(inout) :: plan
      type(error_t), allocatable, intent(inout) :: error
      real(dp) :: passed, settled, total

      plan%kind = run_march
      if (case%time_step_over_cell <= 0) then
         plan%cells_per_step = chosen_step(case, plan)
      else if (case%time_step_over_cell >= 1) then
         plan%cells_per_step = nint(case%time_step_over_cell)
      else
         plan%steps_per_cell = nint(1/case%time_step_over_cell)
      end if
      plan%dt = plan%hx*plan%cells_per_step/plan%steps_per_cell
      if (plan%surfaces%is_measured()) then
         call surface_times(plan%surfaces, settled, total)
         if (case%end_time > 0) total = case%end_time
         settled = min(settled, total)
      else if (plan%surfaces%moves()) then
         passed = plan%surfaces%passing_time(outlet_end)
         call plan%effects%delay(case, plan%bare_plan_t, outlet_end, passed, plan%rest)
         settled = max(passed, plan%rest)
         if (abs(case%load_factor - 1) > 0) settled = settled + load_time
         settled = settled + case%settling_periods*plan%surfaces%longest_period()
         total = settled + plan%surfaces%window()
         if (case%end_time > 0) then
            total = case%end_time
            plan%measures = total - plan%surfaces%window() > passed - 0.5_dp*plan%dt
            settled = max(0.0_dp, total - plan%surfaces%window())
         end if
      else
         settled = case%end_time
         total = case%end_time
      end if
      call plan%effects%check_run(case, plan%kind, total, error)
      if (allocated(error)) return
      if (total/plan%dt > most_steps) then
         call raise(error, 'the case needs '//to_text(total/plan%dt, 3)//' time steps, more than '// &
                    to_text(most_steps)//': with slip_parameter near 0 the pattern hardly moves; use 0 for a '// &
                    'stationary pattern, or set &dynamics end_time')
         return
      end if
      plan%steps = ceiling(total/plan%dt - 1e-9_dp)
      plan%first_sample = ceiling(settled/plan%dt - 1e-9_dp)
   end subroutine plan_march

   !> dT/hX on cells that are given, or that measured heights have chosen: the ratio of least work where it resolves the
   !> shortest wave and its error is a small share of the accuracy.
   integer function chosen_step(case, plan)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      real(dp) :: ratio, steps   ! steps: per wave

      chosen_step = plan%cells_per_step
      if (chosen_step > 1 .or. .not. takes_long_steps(case)) return
      steps = plan%surfaces%shortest_period()/(longest_step*plan%hx)
      if (steps < fewest_points_per_wave) return
      ratio = 1
      if (case%has_ratio()) ratio = formula_ratio(case, plan%conditions, plan%surfaces%moves())
      if (expected_long_step_error(plan%conditions, ratio, plan%hx*sqrt(plan%thinning%steepness), longest_step, steps, &
                                   plan%is_fitted)*plan%surfaces%share_in_film(expected_film(plan%conditions)) &
          <= share_of_steps*case%accuracy) chosen_step = longest_step
   end function chosen_step

end module ehlwave_march_plan
