!> The periodic state of a case with moving waves, in place of a march from rest.
module ehlwave_periodic_case
   use ehlwave_amplitude, only: fitted_harmonic, fitted_mean, sampled_amplitude
   use ehlwave_case_account, only: worse
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: case_plan_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_kinds, only: dp
   use ehlwave_monitor, only: go_on, monitor_t
   use ehlwave_periodic_state, only: periodic_state_t
   use ehlwave_rescue, only: rescue_t
   use ehlwave_solve_report, only: solve_limits_t
   use ehlwave_text, only: to_text
   use ehlwave_time_march, only: march_settings_t
   implicit none (type, external)
   private
   public :: find_periodic_state

contains

   !> Seek it, and take its film as that of a march. Where it is not found the result says so, and is otherwise as it was but for the
   !> effort.
   subroutine find_periodic_state(case, plan, multigrid, rescue, limits, monitor, result, is_found)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(full_multigrid_t), intent(inout) :: multigrid  !! with a converged steady state
      type(rescue_t), intent(in) :: rescue                !! as that left it
      type(solve_limits_t), intent(in) :: limits          !! of a time step
      class(monitor_t), intent(inout) :: monitor
      type(case_result_t), intent(inout) :: result
      logical, intent(out) :: is_found
      type(march_settings_t) :: settings
      type(periodic_state_t) :: periodic
      real(dp) :: work_before

      settings = march_settings_t(waviness=plan%waviness, amplitude=case%amplitude_over_film*result%central_film, &
                                  steps=plan%steps, cells_per_step=plan%cells_per_step, steps_per_cell=plan%steps_per_cell, &
                                  natural_frequency=case%natural_frequency)
      work_before = multigrid%work()
      call periodic%find(multigrid, settings, rescue, limits, monitor)
      result%work = result%work + multigrid%work() - work_before
      result%nonlinear_steps = result%nonlinear_steps + periodic%nonlinear_steps
      result%linear_steps = result%linear_steps + periodic%linear_steps
      is_found = periodic%is_found
      if (is_found) then
         call take_period(plan, settings%amplitude, periodic, result)
         return
      end if
      if (monitor%request /= go_on) return
      if (len(result%warning) > 0) result%warning = result%warning//'; '
      result%warning = result%warning//'the periodic state was not found (change in a period '//to_text(periodic%change, 3)// &
                       ' Ai): marched in its place'
   end subroutine find_periodic_state

   !> Amplitude, phase and mean over the last period, and its film.
   subroutine take_period(plan, amplitude, periodic, result)
      type(case_plan_t), intent(in) :: plan
      real(dp), intent(in) :: amplitude                   !! Ai in units of c
      type(periodic_state_t), intent(in) :: periodic
      type(case_result_t), intent(inout) :: result
      complex(dp) :: wave

      associate (march => periodic%march%result, first => periodic%first_sample, last => periodic%march%result%steps, &
                 period => plan%waviness%period())
         result%time = march%time(first:last)
         result%film_history = march%central_film(first:last)
         result%approach_history = march%approach(first:last)
         result%time_steps = last
         wave = fitted_harmonic(result%time, result%film_history, period)/amplitude
         result%amplitude_ratio = sampled_amplitude(result%film_history)/amplitude
         result%amplitude_ratio_fit = abs(wave)
         result%phase_fit = atan2(aimag(wave), real(wave, dp))
         result%mean_film = fitted_mean(result%time, result%film_history, period)
         result%settling = periodic%change/result%amplitude_ratio_fit
         result%residual = worse(result%residual, periodic%report%residual)
         result%load_error = worse(result%load_error, periodic%report%load_error)
         result%route = 'waves'
      end associate
   end subroutine take_period

end module ehlwave_periodic_case
