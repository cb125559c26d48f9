!> The periodic state of a case with moving waves, in place of a march from rest.
module ehlwave_periodic_case
   use ehlwave_case_account, only: worse
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: case_plan_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_kinds, only: dp
   use ehlwave_march_case, only: march_settings, step_limits, take_last_period
   use ehlwave_monitor, only: go_on, monitor_t
   use ehlwave_periodic_state, only: periodic_state_t
   use ehlwave_rescue, only: rescue_t
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: find_periodic_state

contains

   !> Seek it, and take its film as that of a march. Where it is not found the result says so, and is otherwise as it was but for the
   !> effort.
   subroutine find_periodic_state(case, plan, multigrid, rescue, monitor, result, is_found)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(full_multigrid_t), intent(inout) :: multigrid  !! with a converged steady state
      type(rescue_t), intent(in) :: rescue                !! as that left it
      class(monitor_t), intent(inout) :: monitor
      type(case_result_t), intent(inout) :: result
      logical, intent(out) :: is_found
      type(periodic_state_t) :: periodic
      real(dp) :: work_before

      work_before = multigrid%work()
      call periodic%find(multigrid, march_settings(case, plan, result%central_film), rescue, &
                         step_limits(case, plan, result%central_film), monitor)
      result%work = result%work + multigrid%work() - work_before
      result%nonlinear_steps = result%nonlinear_steps + periodic%nonlinear_steps
      result%linear_steps = result%linear_steps + periodic%linear_steps
      is_found = periodic%is_found
      if (is_found) then
         associate (march => periodic%march%result, first => periodic%first_sample)
            call take_last_period(case, plan, march, first, 0.0_dp, result)
            result%route = 'waves'
            result%time = march%time(first:march%steps)
            result%film_history = march%central_film(first:march%steps)
            result%approach_history = march%approach(first:march%steps)
            result%time_steps = march%steps
            result%settling = periodic%change/result%amplitude_ratio_fit
            result%residual = worse(result%residual, periodic%report%residual)
            result%load_error = worse(result%load_error, periodic%report%load_error)
         end associate
         return
      end if
      if (monitor%request /= go_on) return
      if (len(result%warning) > 0) result%warning = result%warning//'; '
      result%warning = result%warning//'the periodic state was not found (change in a period '//to_text(periodic%change, 3)// &
                       ' Ai): marched in its place'
   end subroutine find_periodic_state

end module ehlwave_periodic_case
