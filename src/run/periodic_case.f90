!> The periodic state of a case with moving waves, in place of a march from rest.
module ehlwave_periodic_case
   use ehlwave_case_account, only: add_warning, worse
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_kinds, only: dp
   use ehlwave_march_case, only: march_settings, step_limits, step_tolerance, take_last_period
   use ehlwave_march_recording, only: march_recording_t
   use ehlwave_march_result, only: march_result_t
   use ehlwave_march_settings, only: march_settings_t
   use ehlwave_monitor, only: go_on, monitor_t
   use ehlwave_periodic_state, only: periodic_state_t
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_rescue, only: rescue_t
   use ehlwave_solve_report, only: solve_limits_t
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: find_periodic_state

   !> Change of a film that repeats, over A, for a tolerance of time steps: a step leaves less than its tolerance.
   real(dp), parameter :: changes_per_tolerance = 5
   real(dp), parameter :: search_share = 0.5_dp   !! share of the work left, for the search: the march may have to
                                                  !! follow

contains

   !> Search for it, and use its film as a march's. If the search fails the result reports this, and only its effort
   !> changes. For sensitivities the march goes on for the steps of a march from rest.
   subroutine find_periodic_state(case, plan, multigrid, rescue, monitor, recording, result, is_found)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(full_multigrid_t), intent(inout) :: multigrid  !! with a converged steady state
      type(rescue_t), intent(inout) :: rescue             !! as that left it; on return less the work of the search,
                                                          !! with its pressures
      class(monitor_t), intent(inout) :: monitor
      type(march_recording_t), intent(inout) :: recording  !! of that march, for sensitivities
      type(case_result_t), intent(inout) :: result
      logical, intent(out) :: is_found
      type(periodic_state_t) :: periodic
      type(march_result_t) :: as_marched
      type(march_settings_t) :: settings
      type(rescue_t) :: search
      type(solve_limits_t) :: limits
      real(dp) :: change, work_before
      integer :: k

      work_before = multigrid%work()
      search = rescue
      if (plan%has_work_cap()) search%work_left = search_share*rescue%work_left
      settings = march_settings(case, plan, result%central_film)
      limits = step_limits(case, plan, result%central_film)
      change = changes_per_tolerance*step_tolerance(case, plan, result%central_film)
      if (case%sensitivities) then
         associate (grid => multigrid%levels(size(multigrid%levels))%problem%grid)
            call recording%begin(grid%nx, grid%ny, plan%steps, settings%repeat_time(grid)/plan%dt)
         end associate
         call periodic%find(multigrid, settings, search, limits, change, monitor, recording)
      else
         call periodic%find(multigrid, settings, search, limits, change, monitor)
      end if
      result%work = result%work + multigrid%work() - work_before
      rescue%work_left = rescue%work_left - (multigrid%work() - work_before)
      result%nonlinear_steps = result%nonlinear_steps + periodic%nonlinear_steps
      result%linear_steps = result%linear_steps + periodic%linear_steps
      is_found = periodic%is_found
      if (is_found) then
         rescue%highest = max(rescue%highest, periodic%march%rescue%highest)
         ! The amplitude is a fit to samples of one period and depends on their start, as the film of large waves has
         ! higher harmonics: the start is as in the march from rest. The pattern is at X = 0 at T = 0, the pattern of
         ! the march at its start.
         associate (main => plan%surfaces%list(plan%surfaces%main), dt => plan%dt)
            as_marched = periodic%at_times([(k*dt + main%start/main%slip, k=plan%first_sample, plan%steps)])
         end associate
         call take_last_period(plan, as_marched, 0, 0.0_dp, result)
         result%route = 'waves'
         result%time = as_marched%time
         result%film_history = as_marched%central_film
         result%approach_history = as_marched%approach
         result%time_steps = periodic%march%result%steps
         result%settling = periodic%change/result%amplitude_ratio_fit
         result%residual = worse(result%residual, periodic%report%residual)
         result%load_error = worse(result%load_error, periodic%report%load_error)
         return
      end if
      if (monitor%request /= go_on) return
      call add_warning(result, 'the periodic state was not found (change in a period '//to_text(periodic%change, 3)// &
                       ' Ai): marched in its place')
   end subroutine find_periodic_state

end module ehlwave_periodic_case
