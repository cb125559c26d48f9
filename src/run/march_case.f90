!> A case with a moving pattern, marched from rest, and what is taken from any march of it.
module ehlwave_march_case
   use ehlwave_amplitude, only: fitted_harmonic, fitted_mean, sampled_amplitude
   use ehlwave_case_account, only: end_early, keep_history, worse
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_kinds, only: dp, pi
   use ehlwave_march_keeper, only: march_keeper_t
   use ehlwave_march_settings, only: march_settings_t
   use ehlwave_monitor, only: go_on, monitor_t
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_rescue, only: rescue_t
   use ehlwave_solve_report, only: solve_limits_t
   use ehlwave_status, only: status_converged, status_interrupted, status_name
   use ehlwave_surface_plan, only: surface_positions
   use ehlwave_text, only: to_text
   use ehlwave_time_march, only: march_result_t, march_t, steps_per_stretch
   implicit none (type, external)
   private
   public :: march_settings, run_moving, step_limits, step_tolerance, take_last_period

   real(dp), parameter :: settling_share = 0.5_dp      !! of the change from period to period that is still to come
   !> Newton's method with the patches of elliptical contacts ends closely below a tolerance: the whole of it would
   !> leave up to seven times as much of Ad/Ai.
   real(dp), parameter :: newton_share = 0.3_dp
   !> Of the tolerance, in line contacts. On fine grids waves change so little in a step that the extrapolated guess is
   !> within the tolerance, and what it leaves adds up: 0.4 per cent of Ad/Ai = 1.013 on 432 cells, 3.4 per cent of
   !> Ad/Ai = 0.0425 on 768.
   real(dp), parameter :: guess_share = 0.01_dp
   real(dp), parameter :: usual_amplitude = 0.2_dp     !! Ai over the film for which step_tolerance is meant

contains

   !> The pattern that is marched, and its steps.
   pure function march_settings(case, plan, central_film) result(settings)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      real(dp), intent(in) :: central_film      !! smooth H(0,0)
      type(march_settings_t) :: settings
      settings = march_settings_t(surfaces=plan%surfaces, film=central_film, steps=plan%steps, &
                                  cells_per_step=plan%cells_per_step, steps_per_cell=plan%steps_per_cell, &
                                  natural_frequency=case%natural_frequency, force=case%load_factor, &
                                  oil_factor=case%oil_change_factor, oil_change_start=case%oil_change_start, &
                                  oil_change_length=case%oil_change_length)
   end function march_settings

   !> Tolerance and limits of a time step.
   pure function step_limits(case, plan, central_film) result(limits)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      real(dp), intent(in) :: central_film      !! smooth H(0,0)
      type(solve_limits_t) :: limits
      limits = solve_limits_t(tolerance=step_tolerance(case, plan, central_film), largest_steps=case%largest_steps)
      if (any(case%method == ['fas  ', 'petsc'])) return
      if (plan%conditions%is_line()) then
         limits%guess_share = guess_share
      else
         limits%tolerance = newton_share*limits%tolerance
      end if
   end function step_limits

   !> Tolerance of time steps, relative to the film; for small waves it has to follow their amplitude.
   pure real(dp) function step_tolerance(case, plan, central_film)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      real(dp), intent(in) :: central_film      !! smooth H(0,0)
      step_tolerance = case%step_tolerance
      if (.not. plan%surfaces%is_rough()) return
      associate (main => plan%surfaces%list(plan%surfaces%main))
         step_tolerance = step_tolerance*min(1.0_dp, main%equivalent_amplitude(central_film)/usual_amplitude)
      end associate
   end function step_tolerance

   !> Moving pattern: march in time, then measure over the last period.
   subroutine run_moving(case, plan, multigrid, rescue, monitor, result, keeper)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(full_multigrid_t), intent(inout) :: multigrid
      type(rescue_t), intent(inout) :: rescue
      class(monitor_t), intent(inout) :: monitor
      type(case_result_t), intent(inout) :: result
      class(march_keeper_t), intent(inout), optional :: keeper
      type(march_t) :: march
      type(march_result_t) :: history
      integer :: finest
      logical :: keeps

      finest = size(multigrid%levels)
      call march%begin(multigrid%levels, march_settings(case, plan, result%central_film), rescue)
      associate (level => multigrid%levels(finest))
         if (case%fields_every > 0) call result%history%begin(level, case%fields_every, plan%steps)
         call result%history%see(level, 0, 0.0_dp)
      end associate
      keeps = present(keeper) .and. case%fields_every == 0   ! fields of steps before are not kept
      if (keeps) call keeper%load(march)
      if (march%result%steps > 0) call march%restore(multigrid%levels(finest))
      do while (march%result%steps < plan%steps)
         call march%advance(multigrid, step_limits(case, plan, result%central_film), monitor, result%history)
         if (march%result%status /= status_converged) exit
         if (keeps .and. modulo(march%result%steps, steps_per_stretch) == 0) call keeper%keep(march)
         if (monitor%request /= go_on) exit
      end do
      call result%history%finish()
      history = march%result
      result%work = result%work + history%work
      rescue = march%rescue
      result%status = history%status
      if (history%status == status_converged .and. history%steps < plan%steps) &
         call end_early(monitor%request, 'time step '//to_text(history%steps)//' of '//to_text(plan%steps), result)
      if (result%status == status_interrupted .and. keeps) call keeper%save()
      result%time_steps = history%steps
      result%residual = worse(worse(result%residual, history%worst_residual), multigrid%levels(finest)%report%residual)
      result%load_error = worse(worse(result%load_error, history%worst_load_error), &
         multigrid%levels(finest)%report%load_error)
      result%nonlinear_steps = result%nonlinear_steps + history%nonlinear_steps
      result%linear_steps = result%linear_steps + history%linear_steps
      result%time = history%time(:history%steps)
      result%film_history = history%central_film(:history%steps)
      result%approach_history = history%approach(:history%steps)
      if (result%status /= status_converged) then
         call keep_history(multigrid%levels(finest)%report, result)
         if (history%status /= status_converged) result%message = 'time step '//to_text(history%steps + 1)//' of '// &
            to_text(plan%steps)//' '//status_name(history%status)//', residual '// &
            to_text(multigrid%levels(finest)%report%residual, 3)//', load error '// &
            to_text(multigrid%levels(finest)%report%load_error, 3)
      else if (plan%surfaces%is_measured()) then
         result%surface_position = surface_positions(plan%surfaces, plan%conditions%a_m, result%time)
         if (plan%first_sample < history%steps) &
            result%mean_film = sum(result%film_history(plan%first_sample + 1:))/(history%steps - plan%first_sample + 1)
      else if (plan%surfaces%moves() .and. plan%measures) then
         result%route = 'rest'
         call take_last_period(plan, history, plan%first_sample, plan%surfaces%list(plan%surfaces%main)%start, result)
         result%settling = change_in_a_period(case, plan, history, &
            result%amplitude_ratio_fit*march%settings%amplitude())
      end if
   end subroutine run_moving

   !> Relative error of the amplitude in the last period, by what it has changed since the period before; 0 where there
   !> is none. Measured from rest after `settling_periods` = 1: 0.02 to 0.8 of the change is still to come, most where
   !> it is small. With fewer, all of the change is counted: the period before has what came in before the waves, and
   !> the equation of motion goes on to swing (M = 47, Omega = 3.5: 5 per cent off with none).
   real(dp) function change_in_a_period(case, plan, history, amplitude) result(change)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(march_result_t), intent(in) :: history
      real(dp), intent(in) :: amplitude          !! of the film, in the last period
      integer :: first, last

      change = 0
      last = plan%first_sample
      first = last - nint(plan%surfaces%period()/plan%dt)
      if (first < 0) return
      associate (time => history%time(first:last), film => history%central_film(first:last))
         change = abs(abs(fitted_harmonic(time, film, plan%surfaces%period()))/amplitude - 1)
      end associate
      if (case%settling_periods >= 1 .and. .not. case%end_time > 0) change = settling_share*change
   end function change_in_a_period

   !> Amplitude, phase and mean of the film from step `first` on, a period before the last.
   subroutine take_last_period(plan, history, first, crest, result)
      type(case_plan_t), intent(in) :: plan
      type(march_result_t), intent(in) :: history
      integer, intent(in) :: first
      real(dp), intent(in) :: crest                   !! X where the pattern had one at T = 0
      type(case_result_t), intent(inout) :: result    !! with the smooth film
      complex(dp) :: fit
      real(dp) :: amplitude

      amplitude = plan%surfaces%list(plan%surfaces%main)%amplitude(result%central_film)
      associate (film => history%central_film(first:history%steps), time => history%time(first:history%steps), &
                 waves => plan%surfaces%list(plan%surfaces%main))
         result%amplitude_ratio = sampled_amplitude(film)/amplitude
         fit = fitted_harmonic(time, film, waves%period())/amplitude
         result%amplitude_ratio_fit = abs(fit)
         ! the pattern at the centre is cos(kx (-crest - S T)): the real part of exp(-i (kx crest + w T)) for S > 0
         fit = fit*exp(cmplx(0, 2*pi*crest/waves%wavelength_x, dp))
         result%phase_fit = atan2(aimag(fit), real(fit, dp))
         result%mean_film = fitted_mean(time(2:), film(2:), waves%period())
      end associate
   end subroutine take_last_period

end module ehlwave_march_case
