!> Runs a planned case.
module ehlwave_case_runner
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_amplitude, only: fitted_harmonic, sampled_amplitude
   use ehlwave_case_account, only: add_warning, blank_result, end_early, take_report
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_lubricant, only: extrapolation_text
   use ehlwave_case_result, only: case_result_t
   use ehlwave_clock, only: peak_memory_mib, wall_seconds
   use ehlwave_film_errors, only: estimate_film_errors
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_given, only: given_t
   use ehlwave_harmonic_case, only: run_responses
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp, pi
   use ehlwave_march_case, only: run_moving
   use ehlwave_march_keeper, only: march_keeper_t
   use ehlwave_march_recording, only: march_recording_t
   use ehlwave_monitor, only: go_on, monitor_t
   use ehlwave_plan_effort, only: most_work
   use ehlwave_planned_case, only: case_plan_t, run_march, run_standing
   use ehlwave_resolution, only: add_reason, closing_reason, touching_reason
   use ehlwave_periodic_case, only: find_periodic_state
   use ehlwave_periodic_sensitivity, only: find_periodic_sensitivities
   use ehlwave_rescue, only: rescue_t, rung_name
   use ehlwave_roughness, only: roughness_t
   use ehlwave_sensitivity_case, only: find_smooth_sensitivities
   use ehlwave_shared_steady, only: limits_of, shared_steady_t
   use ehlwave_shear_stress, only: mean_shear_stress
   use ehlwave_state, only: state_t
   use ehlwave_status, only: is_success, status_converged, status_unresolved
   use ehlwave_surface_result, only: surface_result_t
   use ehlwave_text, only: to_text
   use ehlwave_work_unit, only: work_unit_operations, work_unit_seconds
   implicit none (type, external)
   private
   public :: run_case

contains

   !> Run a case as planned. `result%status` reports every outcome. With `shared`, its steady state is used if it
   !> belongs to the case, and kept for the next.
   subroutine run_case(case, plan, monitor, result, shared, keeper)
      type(case_t), intent(in) :: case              !! completed input
      type(case_plan_t), intent(in) :: plan
      class(monitor_t), intent(inout) :: monitor
      type(case_result_t), intent(out) :: result
      type(shared_steady_t), intent(inout), optional :: shared
      class(march_keeper_t), intent(inout), optional :: keeper   !! lets a march go on where it was stopped
      class(shared_steady_t), allocatable :: own

      if (present(shared)) then
         call run_about(case, plan, monitor, shared, result, keeper)
      else
         allocate (own)
         call run_about(case, plan, monitor, own, result, keeper)
      end if
   end subroutine run_case

   subroutine run_about(case, plan, monitor, steady, result, keeper)
      type(case_t), intent(in) :: case              !! completed input
      type(case_plan_t), intent(in) :: plan
      class(monitor_t), intent(inout) :: monitor
      type(shared_steady_t), intent(inout) :: steady
      type(case_result_t), intent(out) :: result
      class(march_keeper_t), intent(inout), optional :: keeper
      type(march_recording_t) :: recording
      type(rescue_t) :: rescue
      logical :: is_found
      character(len=:), allocatable :: failure, name, unresolved
      real(dp) :: besides, highest, start

      start = wall_seconds()
      result = blank_result(case, plan)
      call steady%prepare(case, plan)
      rescue = steady%rescue
      result%work = steady%work
      associate (level => steady%multigrid%levels(size(steady%multigrid%levels)))
         name = 'steady state of smooth surfaces'
         failure = ''
         call steady%effects%describe_state(name, failure)
         call take_report(level%report, name, result)
         result%message = result%message//failure
         call monitor%step_done('steady state', 1, 1)
         result%effects = steady%effects
         if (result%status == status_converged) then
            call take_smooth_film(case, plan, level, result)
            call result%effects%take(plan, steady%multigrid%levels, result%work)
            result%rolling = steady%rolling
            call estimate_film_errors(plan, steady%multigrid%hierarchy_t, case%tolerance, result)
            call result%effects%add_own_errors(result%bare_result_t)
            call add_warning(result, result%effects%warning(case, plan, level%problem%grid))
            if (case%sensitivities) call find_smooth_sensitivities(case, plan, steady, result)
            if (plan%responds) call run_responses(case, plan, steady, result)
         end if
         besides = steady%work_so_far() - result%work
         rescue%work_left = min(rescue%work_left, plan%largest_work - steady%work_so_far())
         if (result%status == status_converged) then
            select case (plan%kind)
            case (run_march)
               is_found = .false.
               if (plan%is_periodic) &
                  call find_periodic_state(case, plan, steady%multigrid, rescue, monitor, recording, result, is_found)
               if (is_found .and. case%sensitivities) then
                  besides = besides - steady%multigrid%work()
                  call find_periodic_sensitivities(case, plan, steady, recording, result)
                  besides = besides + steady%multigrid%work()
               end if
               if (.not. is_found) &
                  call run_moving(case, plan, steady%multigrid, rescue, monitor, steady%energy, result, keeper)
            case (run_standing)
               call run_standing_pattern(case, plan, steady%multigrid, rescue, monitor, result)
            end select
         end if
         call compare_with_small_waves(case, result)
         highest = rescue%highest
         if (ieee_is_finite(result%max_pressure)) highest = max(highest, result%max_pressure)
         call add_warning(result, extrapolation_text(case, plan%rheology, highest))
         if (case%fields) then
            allocate (result%x, source=level%problem%grid%x)
            allocate (result%y, source=level%problem%grid%y)
            allocate (result%p, source=level%state%p)
            allocate (result%h, source=level%state%h)
            if (is_success(result%status)) call result%effects%take_fields(plan, level, steady%energy)
            if (is_success(result%status)) &
               call mean_shear_stress(level%problem, level%state, result%shear_stress_pa)
         end if
      end associate

      unresolved = plan%resolution%reason
      call add_reason(unresolved, closing_reason(result%minimum_film, result%central_film))
      if (plan%surfaces%is_rough()) &
         call add_reason(unresolved, touching_reason(rescue%thinnest, result%central_film))
      result%is_resolved = len(unresolved) == 0
      result%rung = rung_name(rescue%rung)
      result%rescued_solutions = rescue%rescued
      if (.not. is_success(result%status)) result%message = result%message//spent_text(plan, rescue)
      if (.not. result%is_resolved) then
         if (.not. is_success(result%status)) result%message = result%message//'; not resolved: '
         if (is_success(result%status)) result%status = status_unresolved
         result%message = result%message//unresolved
      end if
      result%seconds = wall_seconds() - start
      if (present(keeper)) result%seconds = result%seconds + keeper%seconds_before
      result%work_units = result%seconds/work_unit_seconds(plan%cells_x, plan%cells_y)
      result%counted_work_units = result%work/work_unit_operations(plan%cells_x, plan%cells_y)
      result%own_convolution = convolution_of(steady)
      result%own_units = result%work/result%own_convolution
      result%all_work = result%work + besides
      result%total_work_units = result%all_work/work_unit_operations(plan%cells_x, plan%cells_y)
      result%peak_memory_mib = peak_memory_mib()
   end subroutine run_about

   !> Operations of one deformation on the finest grid.
   pure real(dp) function convolution_of(steady)
      type(shared_steady_t), intent(in) :: steady
      associate (levels => steady%multigrid%levels)
         convolution_of = levels(size(levels))%problem%deformation%convolution
      end associate
   end function convolution_of

   !> The caps that a case has used up; '' where none.
   function spent_text(plan, rescue) result(text)
      type(case_plan_t), intent(in) :: plan
      type(rescue_t), intent(in) :: rescue
      character(len=:), allocatable :: text
      text = ''
      if (rescue%steps_left <= 0) then
         text = '; the cap of '//to_text(plan%largest_total_steps)//' steps (&solver largest_total_steps) is used up'
      else if (rescue%work_left <= 0) then
         text = '; the cap of '//to_text(plan%largest_work/work_unit_operations(plan%cells_x, plan%cells_y), 3)// &
                ' work units, which keeps a case within '//to_text(most_work, 3)// &
                ' times its plan, is used up: &solver largest_total_steps sets another'
      end if
   end function spent_text

   !> Warn where waves in time and small waves, both computed, differ in response.
   subroutine compare_with_small_waves(case, result)
      type(case_t), intent(in) :: case
      type(case_result_t), intent(inout), target :: result
      type(roughness_t) :: waves(2)
      type(surface_result_t), pointer :: surface
      integer :: n
      if (case%effects%changing() /= '') return     ! the response is that before
      waves = case%surfaces()
      do n = 1, size(waves)
         surface => result%surface(n)
         call compare(trim(merge('waves             ', 'waves on surface 2', n == 1))//' of ', &
                      waves(n)%amplitude_over_film, surface%amplitude_ratio_fit, surface%harmonic%ratio)
      end do

   contains

      subroutine compare(waves, amplitude, ratio, small)
         character(len=*), intent(in) :: waves
         real(dp), intent(in) :: amplitude, ratio, small
         real(dp), parameter :: largest_difference = 0.05_dp
         if (.not. (ieee_is_finite(ratio) .and. ieee_is_finite(small))) return
         if (abs(ratio/small - 1) <= largest_difference) return
         call add_warning(result, waves//to_text(100*amplitude, 3)//' % of the film respond unlike small waves: '// &
            'Ad/Ai = '//to_text(ratio, 3)//' against '//to_text(small, 3)//' of the linear response'// &
            trim(merge(', whose temperatures stay', repeat(' ', 25), case%effects%heat%data%follows_waves())))
      end subroutine compare

   end subroutine compare_with_small_waves

   !> Film, pressure and friction of the smooth contact.
   subroutine take_smooth_film(case, plan, level, result)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(in) :: level
      type(case_result_t), intent(inout) :: result
      real(dp), allocatable :: stress(:, :)   ! tau/ph
      result%central_film = level%problem%grid%value_at_centre(level%state%h)
      result%minimum_film = minval(level%state%h)
      result%central_film_moes = result%central_film*plan%conditions%moes_film_factor
      result%max_pressure = maxval(level%state%p)
      call result%shear%take(level%problem, level%state, stress)
      result%warning = result%shear%warning(case%oil%shear_limit_over_pressure > 0, case%effects%are_warm())
   end subroutine take_smooth_film

   !> Stationary pattern: a steady state for each phase, no time stepping.
   subroutine run_standing_pattern(case, plan, multigrid, rescue, monitor, result)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(full_multigrid_t), intent(inout) :: multigrid
      type(rescue_t), intent(inout) :: rescue
      class(monitor_t), intent(inout) :: monitor
      type(case_result_t), intent(inout) :: result
      type(state_t) :: smooth
      type(given_t) :: given_smooth
      real(dp) :: amplitude, film(plan%phases), turn(plan%phases), work_before
      integer :: finest, n

      finest = size(multigrid%levels)
      smooth = multigrid%levels(finest)%state
      given_smooth = multigrid%levels(finest)%given
      amplitude = plan%surfaces%list(plan%surfaces%main)%amplitude(result%central_film)
      do n = 1, plan%phases
         turn(n) = real(n - 1, dp)/plan%phases
         associate (grid => multigrid%levels(finest)%problem%grid, given => multigrid%levels(finest)%given)
            call given%set_rough(plan%surfaces%rough_fixed(grid%x, grid%y, 2*pi*turn(n), result%central_film))
         end associate
         multigrid%levels(finest)%state = smooth
         work_before = multigrid%work()
         call rescue%solve_step(multigrid, smooth, given_smooth, limits_of(case))
         result%work = result%work + multigrid%work() - work_before
         call take_report(multigrid%levels(finest)%report, &
                          'steady state '//to_text(n)//' of '//to_text(plan%phases)//' of the pattern', result)
         if (result%status /= status_converged) return
         film(n) = multigrid%levels(finest)%problem%grid%value_at_centre(multigrid%levels(finest)%state%h)
         call monitor%step_done('steady pattern', n, plan%phases)
         if (monitor%request /= go_on .and. n < plan%phases) then
            call end_early(monitor%request, 'steady state '//to_text(n)//' of '//to_text(plan%phases), result)
            return
         end if
      end do
      result%time = turn
      result%film_history = film
      result%amplitude_ratio = sampled_amplitude(film)/amplitude
      result%amplitude_ratio_fit = result%amplitude_ratio
      if (plan%phases > 2) result%amplitude_ratio_fit = abs(fitted_harmonic(turn, film, 1.0_dp))/amplitude
      result%mean_film = sum(film)/plan%phases
   end subroutine run_standing_pattern

end module ehlwave_case_runner
