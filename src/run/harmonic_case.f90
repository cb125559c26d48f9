!> The linear response of a case: no time steps.
module ehlwave_harmonic_case
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_accuracy_model, only: grids_margin, spike_factor
   use ehlwave_case_account, only: add_warning
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_effect_keys, only: by_second_order
   use ehlwave_error_estimate, only: formal_order, likely_order
   use ehlwave_film_errors, only: limit_spread
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_harmonic_result, only: harmonic_result_t
   use ehlwave_kinds, only: dp
   use ehlwave_mean_film, only: find_mean_change, mean_change_t
   use ehlwave_pair_responses, only: take_pair_responses
   use ehlwave_planned_case, only: case_plan_t, run_harmonic
   use ehlwave_sensitivity_case, only: find_response_sensitivities
   use ehlwave_shared_steady, only: shared_steady_t
   use ehlwave_status, only: status_converged, status_name
   use ehlwave_text, only: to_text
   use ehlwave_two_wave_result, only: new_two_wave_result
   use ehlwave_waviness, only: waviness_t
   use ehlwave_work_unit, only: work_unit_operations, work_unit_seconds
   implicit none (type, external)
   private
   public :: run_responses

   !> Points on a wave, above the fewest, that show the second order with two grids. With 4, errors with 12 to 18 points
   !> were 1.1 to 1.7 times the estimate.
   real(dp), parameter :: enough_points = 12

   !> Least share of the film error, where P exceeds the Hertz pressure. Two of 511 random responses exceeded the
   !> two-grid estimate by 2.2 and 2.6 times, the film error by 2.7 and 3.5 times: contacts with P = 1.31 and 1.02.
   real(dp), parameter :: film_share = 1.5_dp

contains

   !> Responses to the waves of each rough surface, and their interaction.
   subroutine run_responses(case, plan, steady, result)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(shared_steady_t), intent(inout) :: steady
      type(case_result_t), intent(inout) :: result
      type(harmonic_response_t) :: responses(size(plan%surfaces%list))
      type(mean_change_t) :: means(size(plan%surfaces%list))
      type(harmonic_result_t) :: harmonic
      real(dp) :: work_before
      integer :: n

      call steady%linearise(case, plan)
      do n = 1, size(responses)
         harmonic = harmonic_result_t()
         call run_response(case, plan, n, steady, result, harmonic, responses(n), means(n))
         if (n == 1) result%harmonic = harmonic
         if (n == 2) result%pair%harmonic = harmonic
         if (result%status /= status_converged) return
      end do
      if (size(responses) == 1) return
      work_before = steady%multigrid%work()
      call take_pair_responses(result%pair, plan%surfaces, result%central_film, steady, responses, means)
      result%work = result%work + steady%multigrid%work() - work_before
      if (.not. allocated(result%pair%surfaces_touch)) return
      if (result%pair%surfaces_touch) call add_warning(result, 'the waves of both surfaces together would touch, '// &
         'to second order: there is no smallest_film_both')
   end subroutine run_responses

   !> Response to waves about the linearised steady state of a case and, for the error estimate, on the grid with twice
   !> the mesh size. If the coarse grid fails, the result has no estimate.
   subroutine run_response(case, plan, surface, steady, result, harmonic, response, mean)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      integer, intent(in) :: surface                   !! in the list of `plan%surfaces`
      type(shared_steady_t), intent(inout) :: steady
      type(case_result_t), intent(inout) :: result
      type(harmonic_result_t), intent(inout) :: harmonic
      type(harmonic_response_t), intent(out) :: response
      type(mean_change_t), intent(out) :: mean
      type(harmonic_response_t) :: coarse
      type(waviness_t) :: waves
      real(dp) :: by_effects, finish, room, start, work_before
      integer :: n

      n = size(steady%multigrid%levels)
      waves = plan%surfaces%list(surface)
      work_before = steady%multigrid%work()
      call cpu_time(start)             ! steadier than the wall clock on a busy machine
      call steady%response%respond(steady%multigrid%levels, waves, case%natural_frequency, plan%steps_per_cell, &
                                   response)
      call cpu_time(finish)
      harmonic%work_units = (finish - start)/work_unit_seconds(plan%cells_x, plan%cells_y)
      harmonic%counted_work_units = (steady%multigrid%work() - work_before)/ &
                                    work_unit_operations(plan%cells_x, plan%cells_y)
      harmonic%linear_steps = response%linear_steps
      result%status = response%status
      if (response%status /= status_converged) then
         result%message = 'linear response '//status_name(response%status)//' after '// &
            to_text(response%linear_steps)//' GMRES steps, residual reduced to '//to_text(response%reduction, 3)
         return
      end if
      call harmonic%take(response%film, response%pressure, response%approach)
      if (case%mean_rise .and. .not. case%effects%refuse(by_second_order)) then
         room = -steady%multigrid%work()
         call steady%make_room(keeps_response=case%sensitivities .or. plan%kind /= run_harmonic .or. &
                               size(plan%surfaces%list) > 1)
         work_before = work_before + room + steady%multigrid%work()   ! work of linearised parts, which does not count
                                                                      ! here
         call find_mean(waves, steady, response, result, harmonic, mean)
      end if
      result%work = result%work + steady%multigrid%work() - work_before
      if (case%sensitivities .and. surface == 1) &
         call find_response_sensitivities(case, plan, steady, response, result)
      associate (level => steady%multigrid%levels(n))
         if (waves%moves()) harmonic%waves = new_two_wave_result(level%problem, level%state, waves, response%h)
      end associate
      if (case%fields) then
         harmonic%p = response%p
         harmonic%h = response%h
      end if
      by_effects = result%effects%film_error()
      ! unless a coarser grid shows more
      harmonic%error = max(error_by_model(plan, result, harmonic), &
                           plan%light_ratio_error(result%central_film, .false.)) + by_effects
      harmonic%error_basis = 'model'
      if (.not. steady%has_coarse) return
      call steady%coarse_response%respond(steady%multigrid%levels(:n - 1), waves, case%natural_frequency, &
                                          plan%steps_per_cell, coarse)
      if (coarse%status /= status_converged) return
      call harmonic%extrapolate(coarse%film, coarse%pressure, order_of_response(plan, result))
      ! the pressure spike of a light contact grows with the grid, which makes estimates of waves less reliable than of
      ! the film; the wave of the oil under slip starts there
      if (result%max_pressure > 1) harmonic%error = max(harmonic%error, film_share*result%central_film_error)
      ! the motion of the bodies is as uncertain as the film; it matters for waves that the contact flattens, and near
      ! resonance, where the bodies move more than the waves
      if (harmonic%ratio > 0) harmonic%error = max(harmonic%error, &
         film_share*result%central_film_error*abs(response%approach)/harmonic%ratio)
      if (waves%moves() .and. abs(plan%conditions%slip_parameter - 1) > 0) &
         harmonic%error = harmonic%error*spike_factor(result%max_pressure)
      harmonic%error = max(grids_margin*max(harmonic%error, plan%least_ratio_error(result%central_film_error)), &
                           plan%light_ratio_error(result%central_film, .true.)) + by_effects
      harmonic%error_basis = 'coarse_grid'
   end subroutine run_response

   !> Order to expect of a response. Where the stress is at its limit all around the centre, the small remaining part of
   !> the rate moves the oil there: M = 63, L = 14, D = 0.084, S = 0.68, transverse 2.8 a, gave 1.010, 1.028, 1.002,
   !> 0.981 on 32 to 256 cells. In light contacts the order appears late, as for the largest pressure: M = 18, D = 0.2,
   !> H = 0.8, longitudinal 1.8 a, gave 0.699, 0.648, 0.611, 0.595 on 32 to 256 cells.
   pure real(dp) function order_of_response(plan, result) result(order)
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result
      real(dp), parameter :: saturated = 2, order_at_limit = 0.5_dp   ! tangent factor at the centre from which on
      real(dp), parameter :: light_film = 0.3_dp, least_light = 1.5_dp   ! H(0,0) from which on, and that order at least
      order = likely_order(result%film_order, plan%resolution, plan%steepness, enough_points)
      order = min(order, max(least_light, formal_order - max(0.0_dp, result%central_film - light_film)))
      if (plan%rheology%is_limited() .and. any(result%shear%tangent_factor > saturated)) &
         order = order_at_limit
   end function order_of_response

   !> Relative error of the response by the mesh, where no coarser grid shows it. Two waves that nearly cancel have the
   !> error of their sum: waves of 0.27 and 0.24 of Ai left 0.046, 22 per cent off with 10 points per wave.
   pure real(dp) function error_by_model(plan, result, harmonic) result(error)
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result
      type(harmonic_result_t), intent(in) :: harmonic
      real(dp), parameter :: phase_factor = 1.5_dp   !! factor on the error of each wave, over the square of the points
                                                     !! on it
      real(dp) :: both

      error = limit_spread(plan, result)*plan%model_ratio_error(result%max_pressure, result%central_film_error)
      if (.not. plan%resolution%points_x > 0) return
      associate (fit => harmonic%waves%centre%fit)
         both = abs(fit%attenuated) + abs(fit%complementary)
      end associate
      if (.not. ieee_is_finite(both)) return       ! it moves with neither surface, or is outside the contact
      if (both > harmonic%ratio) error = max(error, both/harmonic%ratio* &
         (plan%model_margin(result%max_pressure)*plan%expected%mesh + phase_factor/plan%resolution%points_x**2))
   end function error_by_model

   !> The change of the mean by waves of this amplitude, and whether they touch.
   subroutine find_mean(waves, steady, response, result, harmonic, change)
      type(waviness_t), intent(in) :: waves
      type(shared_steady_t), intent(inout) :: steady
      type(harmonic_response_t), intent(in) :: response
      type(case_result_t), intent(inout) :: result
      type(harmonic_result_t), intent(inout) :: harmonic
      type(mean_change_t), intent(out) :: change

      associate (problem => steady%multigrid%levels(size(steady%multigrid%levels))%problem)
         ! Waves along a line: only the mean along it is defined, and only for a flow that is linear in the gradient
         if (problem%grid%is_line .and. waves%wavelength_y > 0 .and. .not. &
             (waves%is_oblique .and. problem%rheology%is_newtonian())) return
      end associate
      associate (amplitude => waves%amplitude(result%central_film))
         call find_mean_change(steady%response%tangent, steady%multigrid%levels, response, waves, amplitude, change)
         if (change%status /= status_converged) then
            call add_warning(result, 'the change of the mean film by waves is not found (its linear system '// &
               status_name(change%status)//'): contact between waves is not excluded')
            return
         end if
         call harmonic%take_mean(change, amplitude)
         if (harmonic%surfaces_touch) call add_warning(result, 'waves of '// &
            to_text(100*waves%amplitude_over_film, 3)// &
            ' % of the film would touch the other surface at X = '//to_text(change%smallest_at(1), 3)//', Y = '// &
            to_text(change%smallest_at(2), 3)//', to second order: there is no smallest film')
      end associate
   end subroutine find_mean

end module ehlwave_harmonic_case
