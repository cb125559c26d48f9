!> The linear response of a case: no time steps.
module ehlwave_harmonic_case
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_case_account, only: add_warning
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_effect_keys, only: by_second_order
   use ehlwave_error_factors, only: of_response => response
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_harmonic_result, only: harmonic_result_t
   use ehlwave_kinds, only: dp
   use ehlwave_mean_film, only: find_mean_change, mean_change_t
   use ehlwave_mesh_errors, only: kind_of, mesh_error, mesh_error_t
   use ehlwave_planned_case, only: case_plan_t, run_harmonic
   use ehlwave_sensitivity_case, only: find_response_sensitivities
   use ehlwave_shared_steady, only: shared_steady_t
   use ehlwave_status, only: status_converged, status_name
   use ehlwave_surface_result, only: surface_result_t
   use ehlwave_text, only: to_text
   use ehlwave_two_wave_result, only: new_two_wave_result
   use ehlwave_waviness, only: waviness_t
   use ehlwave_work_unit, only: work_unit_operations, work_unit_seconds
   implicit none (type, external)
   private
   public :: run_responses

contains

   !> Responses to the waves of each rough surface, and their interaction.
   subroutine run_responses(case, plan, steady, result)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(shared_steady_t), intent(inout) :: steady
      type(case_result_t), intent(inout), target :: result
      type(harmonic_response_t) :: responses(size(plan%surfaces%list))
      type(mean_change_t) :: means(size(plan%surfaces%list))
      type(harmonic_result_t) :: harmonic
      type(surface_result_t), pointer :: surface
      real(dp) :: work_before
      integer :: n

      call steady%linearise(case, plan)
      do n = 1, size(responses)
         harmonic = harmonic_result_t()
         call run_response(case, plan, n, steady, result, harmonic, responses(n), means(n))
         surface => result%surface(n)
         surface%harmonic = harmonic
         if (result%status /= status_converged) return
      end do
      if (size(responses) == 1) return
      work_before = steady%multigrid%work()
      call result%effects%second%take_responses(plan%surfaces, result%central_film, steady%response%tangent, &
         steady%multigrid%levels, responses, means)
      result%work = result%work + steady%multigrid%work() - work_before
      call add_warning(result, result%effects%second%touching_text())
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
      real(dp) :: finish, room, start, work_before
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
      call estimate_error(plan, result, harmonic, [response%film], abs(response%approach))
      if (.not. steady%has_coarse) return
      call steady%respond_coarsely(waves, case%natural_frequency, plan%steps_per_cell, coarse)
      if (coarse%status /= status_converged) return
      call harmonic%extrapolate(coarse%film, coarse%pressure)
      call estimate_error(plan, result, harmonic, [response%film, coarse%film], abs(response%approach))
   end subroutine run_response

   !> Relative error of the response by the mesh. The motion of the bodies is as uncertain as the film: it matters for
   !> waves that the contact flattens, and near resonance. Without a coarser grid two waves that nearly cancel have the
   !> error of their sum.
   subroutine estimate_error(plan, result, harmonic, films, approach)
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result
      type(harmonic_result_t), intent(inout) :: harmonic
      complex(dp), intent(in) :: films(:)          !! H(0,0) over Ai on the grid of the case, and on the coarser grid
      real(dp), intent(in) :: approach             !! amplitude of Delta over Ai
      type(mesh_error_t) :: error
      real(dp) :: both, expected

      expected = plan%expected_ratio_mesh_error(result%central_film) + sum(plan%expected%by_effect)
      associate (fit => harmonic%waves%centre%fit)
         both = abs(fit%attenuated) + abs(fit%complementary)
      end associate
      if (size(films) == 1 .and. ieee_is_finite(both)) expected = expected*max(1.0_dp, both/harmonic%ratio)
      error = mesh_error(of_response, kind_of(plan%is_fitted, plan%conditions%is_line()), films, expected, &
                         order_of_response(plan, result))
      harmonic%error = max(error%relative, result%central_film_error*approach/harmonic%ratio) &
                       + result%effects%film_error()
      harmonic%error_basis = error%basis
   end subroutine estimate_error

   !> Order of a response in the mesh size. Where the stress is at its limit all around the centre, the small remaining
   !> part of the rate moves the oil there, and the order is low.
   pure real(dp) function order_of_response(plan, result) result(order)
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result
      real(dp), parameter :: saturated = 2, order_at_limit = 0.5_dp   ! tangent factor at the centre from which on
      order = 2
      if (plan%rheology%is_limited() .and. any(result%shear%tangent_factor > saturated)) order = order_at_limit
   end function order_of_response

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
