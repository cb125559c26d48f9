!> Runs one planned case.
module ehlwave_case_runner
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use ehlwave_amplitude, only: fitted_harmonic, sampled_amplitude
   use ehlwave_case_input, only: case_t
   use ehlwave_case_plan, only: case_plan_t, run_march, run_standing
   use ehlwave_case_result, only: case_result_t
   use ehlwave_clock, only: peak_memory_mib, wall_seconds
   use ehlwave_formula, only: amplitude_formula, anisotropy_factor, wave_parameter_v, wave_parameter_v2
   use ehlwave_full_multigrid, only: level_t
   use ehlwave_harmonic_case, only: run_response
   use ehlwave_harmonic_result, only: no_harmonic_result
   use ehlwave_kinds, only: dp, pi
   use ehlwave_level_solver, only: solve_limits_t, solve_report_t
   use ehlwave_monitor, only: monitor_t
   use ehlwave_shared_steady, only: shared_steady_t
   use ehlwave_state, only: state_t
   use ehlwave_status, only: is_success, status_converged, status_name, status_unresolved
   use ehlwave_text, only: to_text
   use ehlwave_time_march, only: march, march_result_t, march_settings_t
   use ehlwave_work_unit, only: work_unit_seconds
   implicit none (type, external)
   private
   public :: run_case

   real(dp), parameter :: usual_amplitude = 0.2_dp     !! Ai over the film for which step_tolerance is meant

contains

   !> Run a case as planned. Whatever happens inside is told by `result%status`. With `shared`, its steady state is
   !> used if it is that of the case, and left there for the next.
   subroutine run_case(case, plan, monitor, result, shared)
      type(case_t), intent(in) :: case              !! completed input
      type(case_plan_t), intent(in) :: plan
      class(monitor_t), intent(inout) :: monitor
      type(case_result_t), intent(out) :: result
      type(shared_steady_t), intent(inout), target, optional :: shared
      type(shared_steady_t), allocatable, target :: own

      if (present(shared)) then
         call run_about(case, plan, monitor, shared, result)
      else
         allocate (own)
         call run_about(case, plan, monitor, own, result)
      end if
   end subroutine run_case

   subroutine run_about(case, plan, monitor, steady, result)
      type(case_t), intent(in) :: case              !! completed input
      type(case_plan_t), intent(in) :: plan
      class(monitor_t), intent(inout) :: monitor
      type(shared_steady_t), intent(inout), target :: steady
      type(case_result_t), intent(out) :: result
      type(solve_limits_t) :: limits
      real(dp) :: start

      start = wall_seconds()
      result%message = ''
      result%is_resolved = plan%resolution%is_resolved
      result%amplitude_ratio = ieee_value(1.0_dp, ieee_quiet_nan)   ! until measured
      result%amplitude_ratio_fit = result%amplitude_ratio
      result%phase_fit = result%amplitude_ratio
      result%mean_film = result%amplitude_ratio
      result%harmonic = no_harmonic_result()
      result%central_film = result%amplitude_ratio
      result%minimum_film = result%amplitude_ratio
      result%central_film_moes = result%amplitude_ratio
      result%max_pressure = result%amplitude_ratio
      if (plan%waviness%is_present) then
         result%v = wave_parameter_v(plan%conditions, case%wavelength_over_a)
         result%v2 = wave_parameter_v2(plan%conditions, case%wavelength_over_a)
         result%f_r = anisotropy_factor(case%wavelength_x_over_a, case%wavelength_y_over_a)
         result%formula_ratio = amplitude_formula(result%f_r*result%v)
      end if

      limits = solve_limits_t(tolerance=case%tolerance, largest_steps=case%largest_steps)
      call steady%prepare(case, plan)
      associate (level => steady%multigrid%levels(size(steady%multigrid%levels)))
         call take_report(level%report, 'steady state of smooth surfaces', result)
         call monitor%step_done('steady state', 1, 1)
         if (result%status == status_converged) then
            call take_smooth_film(plan, level, result)
            if (plan%responds) call run_response(case, plan, steady, result)
         end if
         if (result%status == status_converged) then
            select case (plan%kind)
            case (run_march)
               call run_moving(case, plan, level, monitor, result)
            case (run_standing)
               call run_standing_pattern(case, plan, level, limits, monitor, result)
            end select
         end if
         if (case%fields) then
            allocate (result%x, source=level%problem%grid%x)
            allocate (result%y, source=level%problem%grid%y)
            allocate (result%p, source=level%state%p)
            allocate (result%h, source=level%state%h)
         end if
      end associate

      if (result%status == status_converged .and. .not. result%is_resolved) then
         result%status = status_unresolved
         result%message = plan%resolution%reason
      end if
      result%seconds = wall_seconds() - start
      result%work_units = result%seconds/work_unit_seconds(plan%cells_x, plan%cells_y)
      result%peak_memory_mib = peak_memory_mib()
   end subroutine run_about

   !> Film and pressure of the smooth contact.
   subroutine take_smooth_film(plan, level, result)
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(in) :: level
      type(case_result_t), intent(inout) :: result
      result%central_film = level%problem%grid%value_at_centre(level%state%h)
      result%minimum_film = minval(level%state%h)
      result%central_film_moes = result%central_film*plan%conditions%moes_film_factor
      result%max_pressure = maxval(level%state%p)
   end subroutine take_smooth_film

   !> Add one solution to the account of the case.
   subroutine take_report(report, what, result)
      type(solve_report_t), intent(in) :: report
      character(len=*), intent(in) :: what
      type(case_result_t), intent(inout) :: result
      result%status = report%status
      result%residual = max(result%residual, report%residual)
      result%load_error = max(result%load_error, report%load_error)
      result%nonlinear_steps = result%nonlinear_steps + report%nonlinear_steps
      result%linear_steps = result%linear_steps + report%linear_steps
      if (.not. is_success(report%status)) result%message = what//' '//status_name(report%status)//' after '// &
         to_text(report%nonlinear_steps)//' steps, residual '//to_text(report%residual, 3)// &
         ', load error '//to_text(report%load_error, 3)
   end subroutine take_report

   !> Moving pattern: march in time, then measure over the last period.
   subroutine run_moving(case, plan, level, monitor, result)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(inout) :: level
      class(monitor_t), intent(inout) :: monitor
      type(case_result_t), intent(inout) :: result
      type(march_settings_t) :: settings
      type(march_result_t) :: history
      type(solve_limits_t) :: limits
      complex(dp) :: fit
      real(dp) :: amplitude

      amplitude = case%amplitude_over_film*result%central_film
      settings = march_settings_t(waviness=plan%waviness, amplitude=amplitude, steps=plan%steps, &
                                  cells_per_step=plan%cells_per_step, steps_per_cell=plan%steps_per_cell, &
                                  natural_frequency=case%natural_frequency, force=case%load_factor)
      ! the tolerance is relative to the film; for small waves it has to follow their amplitude
      limits = solve_limits_t(tolerance=case%step_tolerance*min(1.0_dp, case%amplitude_over_film/usual_amplitude), &
                              largest_steps=case%largest_steps)
      call march(level, settings, limits, monitor, history)
      result%status = history%status
      result%time_steps = history%steps
      result%residual = max(result%residual, history%worst_residual)
      result%load_error = max(result%load_error, history%worst_load_error)
      result%nonlinear_steps = result%nonlinear_steps + history%nonlinear_steps
      result%linear_steps = result%linear_steps + history%linear_steps
      result%time = history%time(:history%steps)
      result%film_history = history%central_film(:history%steps)
      result%approach_history = history%approach(:history%steps)
      if (history%status /= status_converged) then
         result%message = 'time step '//to_text(history%steps + 1)//' of '//to_text(plan%steps)//' '// &
                          status_name(history%status)//', residual '//to_text(level%report%residual, 3)// &
                          ', load error '//to_text(level%report%load_error, 3)
      else if (plan%waviness%moves()) then
         associate (film => history%central_film(plan%first_sample:), time => history%time(plan%first_sample:))
            result%amplitude_ratio = sampled_amplitude(film)/amplitude
            fit = fitted_harmonic(time, film, plan%waviness%period())/amplitude
            result%amplitude_ratio_fit = abs(fit)
            ! the pattern at the centre is cos(kx (-Xs - S T)): the real part of exp(-i (kx Xs + w T)) for S > 0
            fit = fit*exp(cmplx(0, 2*pi*plan%waviness%start/plan%waviness%wavelength_x, dp))
            result%phase_fit = atan2(aimag(fit), real(fit, dp))
            result%mean_film = sum(film(2:))/(size(film) - 1)
         end associate
      end if
   end subroutine run_moving

   !> Pattern that stands still: one steady state for each phase, no time stepping.
   subroutine run_standing_pattern(case, plan, level, limits, monitor, result)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(inout) :: level
      type(solve_limits_t), intent(in) :: limits
      class(monitor_t), intent(inout) :: monitor
      type(case_result_t), intent(inout) :: result
      type(state_t) :: smooth
      real(dp) :: amplitude, film(plan%phases), turn(plan%phases)
      integer :: n

      smooth = level%state
      amplitude = case%amplitude_over_film*result%central_film
      do n = 1, plan%phases
         turn(n) = real(n - 1, dp)/plan%phases
         call level%problem%set_rough(amplitude*plan%waviness%shape_fixed(level%problem%grid%x, level%problem%grid%y, &
                                                                          2*pi*turn(n)))
         level%state = smooth
         call level%solver%forget()
         call level%solver%solve(level%problem, level%state, limits, level%report)
         call take_report(level%report, 'steady state '//to_text(n)//' of '//to_text(plan%phases)//' of the pattern', result)
         if (result%status /= status_converged) return
         film(n) = level%problem%grid%value_at_centre(level%state%h)
         call monitor%step_done('steady pattern', n, plan%phases)
      end do
      result%time = turn
      result%film_history = film
      result%amplitude_ratio = sampled_amplitude(film)/amplitude
      result%amplitude_ratio_fit = result%amplitude_ratio
      if (plan%phases > 2) result%amplitude_ratio_fit = abs(fitted_harmonic(turn, film, 1.0_dp))/amplitude
      result%mean_film = sum(film)/plan%phases
   end subroutine run_standing_pattern

end module ehlwave_case_runner
