!> A case with a moving pattern, marched from rest, and the results of any march of it.
module ehlwave_march_case
   use ehlwave_amplitude, only: fitted_mean, sampled_amplitude
   use ehlwave_case_account, only: add_warning, end_early, keep_history, worse
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_effects_result, only: effects_result_t
   use ehlwave_energy, only: energy_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_kinds, only: dp, no_value, pi
   use ehlwave_march_keeper, only: march_keeper_t
   use ehlwave_march_result, only: march_result_t
   use ehlwave_march_settings, only: march_settings_t
   use ehlwave_monitor, only: go_on, monitor_t
   use ehlwave_overtones, only: overtone_error, resolved_periods
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_rescue, only: rescue_t
   use ehlwave_settling, only: settling_error, unrest_text, wave_parts
   use ehlwave_solve_report, only: solve_limits_t
   use ehlwave_status, only: status_converged, status_interrupted, status_name
   use ehlwave_surface_plan, only: surface_positions
   use ehlwave_surface_result, only: surface_result_t
   use ehlwave_surfaces, only: surfaces_t
   use ehlwave_text, only: to_text
   use ehlwave_time_march, only: march_t, steps_per_stretch
   implicit none (type, external)
   private
   public :: march_settings, run_moving, step_limits, step_tolerance, take_last_period

   !> Newton's method with the patches of elliptical contacts ends closely below a tolerance: the whole of it would
   !> leave up to seven times as much of Ad/Ai.
   real(dp), parameter :: newton_share = 0.3_dp
   !> Share of the tolerance, in line contacts. On fine grids waves change so little in a step that the extrapolated
   !> guess is within the tolerance, and the remaining errors add up: 0.4 per cent of Ad/Ai = 1.013 on 432 cells, 3.4
   !> per cent of Ad/Ai = 0.0425 on 768.
   real(dp), parameter :: guess_share = 0.01_dp
   real(dp), parameter :: usual_amplitude = 0.2_dp     !! Ai over the film for which step_tolerance is meant

contains

   !> The pattern that is marched, and its steps.
   function march_settings(case, plan, central_film) result(settings)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      real(dp), intent(in) :: central_film      !! smooth H(0,0)
      type(march_settings_t) :: settings
      type(effects_result_t) :: effects
      settings = march_settings_t(surfaces=plan%surfaces, film=central_film, steps=plan%steps, &
                                  cells_per_step=plan%cells_per_step, steps_per_cell=plan%steps_per_cell, &
                                  natural_frequency=case%natural_frequency, force=case%load_factor)
      call effects%set_march(case, settings)
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
      integer :: n
      step_tolerance = case%step_tolerance
      if (.not. plan%surfaces%is_rough()) return
      associate (list => plan%surfaces%list)
         step_tolerance = step_tolerance*min(1.0_dp, minval([(list(n)%equivalent_amplitude(central_film), &
                                                              n=1, size(list))])/usual_amplitude)
      end associate
   end function step_tolerance

   !> Moving pattern: march in time, then measure over the last period.
   subroutine run_moving(case, plan, multigrid, rescue, monitor, energy, result, keeper)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(full_multigrid_t), intent(inout) :: multigrid
      type(rescue_t), intent(inout) :: rescue
      class(monitor_t), intent(inout) :: monitor
      type(energy_t), intent(inout) :: energy  !! energy equation of the steady state; of the last time step, if marched
      type(case_result_t), intent(inout), target :: result
      class(march_keeper_t), intent(inout), optional :: keeper
      type(march_t) :: march
      type(march_result_t) :: history
      character(len=:), allocatable :: changing
      type(surface_result_t), pointer :: surface
      integer :: finest, n
      logical :: keeps

      finest = size(multigrid%levels)
      if (case%effects%heat%data%follows_waves()) then
         call march%begin(multigrid%levels, march_settings(case, plan, result%central_film), rescue, energy)
      else
         call march%begin(multigrid%levels, march_settings(case, plan, result%central_film), rescue)
      end if
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
      if (allocated(march%energy)) energy = march%energy
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
         associate (list => plan%surfaces%list, a_m => plan%conditions%a_m)
            do n = 1, size(list)
               surface => result%surface(n)
               if (allocated(list(n)%surface)) surface%surface_position = surface_positions(list(n), a_m, result%time)
            end do
         end associate
         if (plan%first_sample < history%steps) &
            result%mean_film = sum(result%film_history(plan%first_sample + 1:))/(history%steps - plan%first_sample + 1)
      else if (plan%surfaces%moves() .and. plan%measures) then
         result%route = 'rest'
         call take_last_period(plan, history, plan%first_sample, plan%surfaces%list(plan%surfaces%main)%start, result)
         result%settling = settling_error(case, plan, history, result)
         call add_warning(result, unrest_text(case, plan, result%settling))
      else if (plan%surfaces%moves()) then
         changing = case%effects%changing()
         if (changing /= '') changing = ' and the change of '//changing
         call add_warning(result, 'no Ad/Ai: &dynamics end_time comes before the waves'//changing// &
            ' have passed and one period more')
      else if (plan%surfaces%is_rough()) then
         call add_warning(result, 'no Ad/Ai of the march: the pattern stands still, and a march follows its film '// &
            'without measuring it; remove &dynamics end_time')
      end if
   end subroutine run_moving

   !> Amplitudes, phases and mean of the film from step `first` on, over the repeating part before the last.
   subroutine take_last_period(plan, history, first, crest, result)
      type(case_plan_t), intent(in) :: plan
      type(march_result_t), intent(in) :: history
      integer, intent(in) :: first
      real(dp), intent(in) :: crest                   !! X where the patterns had a crest at T = 0
      type(case_result_t), intent(inout), target :: result    !! with the smooth film
      complex(dp) :: parts(size(plan%surfaces%list))
      real(dp), dimension(size(plan%surfaces%list)) :: heights, ratios   ! heights over the film
      type(surface_result_t), pointer :: surface
      integer :: n

      associate (film => history%central_film(first:history%steps), time => history%time(first:history%steps), &
                 surfaces => plan%surfaces, list => plan%surfaces%list)
         if (size(list) == 1) result%amplitude_ratio = sampled_amplitude(film)/list(1)%amplitude(result%central_film)
         parts = wave_parts(surfaces, result%central_film, time, film)
         heights = abs(parts)/result%central_film
         do n = 1, size(list)
            parts(n) = parts(n)/list(n)%amplitude(result%central_film)
         end do
         ratios = abs(parts)
         ! the pattern at the centre is cos(kx (-crest - S T)): the real part of exp(-i (kx crest + w T)) for S > 0
         parts = parts*exp(cmplx(0, 2*pi*crest/list%wavelength_x, dp))
         do n = 1, size(list)
            surface => result%surface(n)
            surface%amplitude_ratio_fit = ratios(n)
            surface%phase_fit = atan2(aimag(parts(n)), real(parts(n), dp))
         end do
         result%mean_film = fitted_mean(time(2:), film(2:), resolved_periods(surfaces, time(2) - time(1)))
         call judge_overtones(surfaces, heights, time(2) - time(1), result)
         if (.not. (surfaces%are_apart() .or. surfaces%are_one())) call add_warning(result, 'the waves of both '// &
            'surfaces pass the centre with one frequency, so that the film cannot separate them: no Ad/Ai')
      end associate
   end subroutine take_last_period

   !> Error of the waves of two surfaces by overtones, and no Ad/Ai where it may be an overtone.
   subroutine judge_overtones(surfaces, heights, time_step, result)
      type(surfaces_t), intent(in) :: surfaces
      real(dp), intent(in) :: heights(:)              !! heights of the waves in the film, over the film
      real(dp), intent(in) :: time_step
      type(case_result_t), intent(inout), target :: result
      real(dp), parameter :: largest = 0.5_dp         ! error from which on nothing is known of the wave
      real(dp) :: error
      type(surface_result_t), pointer :: surface
      integer :: n

      do n = 1, size(heights)
         error = overtone_error(surfaces, n, heights, time_step)
         result%overtone_error = max(result%overtone_error, error)
         if (.not. error > largest) cycle
         call add_warning(result, 'no Ad/Ai of surface '//to_text(n)//': overtones of the larger waves may have '// &
            'its frequency and height; take another wavelength, smaller waves on the other surface, or '// &
            "response = 'harmonic'")
         surface => result%surface(n)
         surface%amplitude_ratio_fit = no_value
      end do
   end subroutine judge_overtones

end module ehlwave_march_case
