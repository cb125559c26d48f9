!> Makes the plan of a case, before it runs.
module ehlwave_case_plan
   use ehlwave_accuracy_model, only: fitted_share
   use ehlwave_case_completion, only: case_conditions
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_files, only: case_files, note_digest
   use ehlwave_case_keys, only: case_key_list
   use ehlwave_case_lubricant, only: case_lubricant
   use ehlwave_domain_choice, only: chosen_scale, expected_domain_errors, scale_domain
   use ehlwave_errors, only: error_t, raise
   use ehlwave_grid_choice, only: choose_grid
   use ehlwave_key_list, only: key_list_t
   use ehlwave_kinds, only: dp
   use ehlwave_march_plan, only: plan_march
   use ehlwave_plan_effort, only: cap_work, expect
   use ehlwave_planned_case, only: case_plan_t, run_harmonic, run_march, run_standing
   use ehlwave_resolution, only: judge_resolution
   use ehlwave_scheme_choice, only: is_fitted, least_work_step
   use ehlwave_surface_plan, only: plan_surfaces
   use ehlwave_text, only: to_text
   use ehlwave_thinning, only: new_thinning
   implicit none (type, external)
   private
   public :: make_plan

   integer, parameter :: steps_per_time_step = 40    !! nonlinear steps that a time step may take on average

contains

   !> Plan of a completed case. Fails when the case cannot be run. A coarser or finer plan of a planned case keeps the
   !> domain.
   subroutine make_plan(case, plan, error, domain_scale, keys)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(out) :: plan
      type(error_t), allocatable, intent(inout) :: error
      real(dp), intent(in), optional :: domain_scale   !! size of the domain over the keys' domain; absent: chosen
      type(key_list_t), intent(in), optional :: keys   !! keys of the case, if at hand
      type(case_t) :: copy
      real(dp) :: errors(2)

      copy = case
      call case_conditions(copy, plan%conditions, error)
      if (allocated(error)) return
      plan%rheology = case_lubricant(copy, plan%conditions)
      if (present(keys)) then
         plan%files = case_files(keys)
      else
         plan%files = case_files(case_key_list(case))
      end if
      associate (measured => copy%oil%measured)
         if (allocated(measured%path)) call note_digest(plan%files, measured%path, measured%digest())
      end associate
      copy = case
      if (present(domain_scale)) then
         plan%domain_scale = domain_scale
      else
         plan%domain_scale = chosen_scale(case, plan%conditions, plan%rheology)
      end if
      call scale_domain(copy, plan%domain_scale)
      plan%x_min = copy%x_min
      plan%x_max = copy%x_max
      plan%y_max = copy%y_max
      errors = expected_domain_errors(case, plan%conditions, plan%rheology, plan%domain_scale)
      plan%film_domain_error = errors(1)
      plan%domain_error = errors(2)
      if (case%edges == 'flooded') copy%accuracy = case%accuracy - min(0.5_dp*case%accuracy, plan%domain_error)
      call plan%effects%make(case, plan%bare_plan_t, error)
      if (allocated(error)) return
      plan%thinning = new_thinning(plan%rheology, plan%conditions, case%oil%flow_exponent())
      plan%is_fitted = is_fitted(case)
      plan%steepness = plan%thinning%steepness*merge(fitted_share, 1.0_dp, plan%is_fitted)
      call plan_surfaces(case, plan%conditions, plan%surfaces, plan%files, error)
      if (allocated(error)) return
      plan%is_half = (case%domain == 'auto' .or. plan%conditions%is_line()) .and. plan%surfaces%is_symmetric() &
                     .and. plan%effects%are_even()
      if (case%marches() .and. case%cells_x == 0 .and. case%has_ratio()) &
         plan%cells_per_step = least_work_step(copy, plan%conditions, plan%is_fitted)
      call choose_grid(copy, plan%conditions, plan%surfaces, plan%is_fitted, plan%steepness, plan%effects, &
                       plan%cells_per_step, plan%cells_x, plan%cells_y, plan%grid_reason)
      plan%hx = (plan%x_max - plan%x_min)/plan%cells_x
      if (.not. plan%conditions%is_line()) plan%hy = 2*plan%y_max/plan%cells_y
      plan%deformation = merge('mlmi', 'fft ', case%deformation == 'mlmi')   ! 'auto': the FFT, measured

      plan%is_by_multigrid = case%method == 'fas'
      plan%is_periodic = plan%surfaces%moves() .and. case%response == 'periodic'
      plan%responds = case%responds()
      if (plan%responds .and. case%response == 'harmonic') then
         plan%kind = run_harmonic
         if (case%time_step_over_cell > 0) plan%steps_per_cell = nint(1/min(1.0_dp, case%time_step_over_cell))
      else if (case%marches()) then
         call plan_march(case, plan, error)
      else if (plan%surfaces%is_rough()) then
         plan%kind = run_standing
         plan%phases = merge(8, 2, any(plan%surfaces%list%wavelength_x > 0))
      end if
      if (plan%kind /= run_march) call plan%effects%check_run(case, plan%kind, 0.0_dp, error)
      if (.not. allocated(error) .and. plan%is_periodic) call check_repetition(plan, error)
      if (allocated(error)) return
      if (case%fields_every > 0 .and. (plan%kind /= run_march .or. plan%is_periodic)) then
         call raise(error, '&output fields_every = '//to_text(case%fields_every)// &
            ': this case takes no time steps whose '// &
                    "fields could be kept: remove it, or give waves or a surface that move, with response = "// &
                    "'transient' or 'both'")
         return
      end if
      if (case%fields_every > 0) plan%field_sets = plan%steps/case%fields_every + 1
      plan%resolution = judge_resolution(plan%conditions, plan%surfaces, plan%x_min, plan%y_max, plan%hx, plan%hy, &
         plan%dt, plan%is_fitted)
      call plan%effects%judge(plan%bare_plan_t)
      call expect(case, plan)
      if (case%accuracy > 0) call check_accuracy(case, plan, error)
      plan%cost = real(plan%cells_x, dp)*plan%cells_y*(15 + 6*plan%phases + 4*plan%steps + merge(8, 0, plan%responds))
      if (plan%is_half) plan%cost = 0.5_dp*plan%cost
      call cap_work(case, plan)
      plan%largest_total_steps = case%largest_total_steps
      ! a steady state takes 5 to 20 steps, a time step 2 to 5: room for the rescue ladder
      if (plan%largest_total_steps == 0) &
         plan%largest_total_steps = case%largest_steps*(10 + 5*plan%phases) + steps_per_time_step*plan%steps
   end subroutine make_plan

   !> Refuse a periodic state of waves that never repeat together.
   subroutine check_repetition(plan, error)
      type(case_plan_t), intent(in) :: plan
      type(error_t), allocatable, intent(inout) :: error
      if (plan%surfaces%repeat_period() > 0) return
      call raise(error, "&waviness response = 'periodic': the waves of "// &
         'the two surfaces pass in periods of '//to_text(plan%surfaces%list(1)%period(), 6)//' and '// &
         to_text(plan%surfaces%list(2)%period(), 6)//', which are in no ratio of whole numbers up to 12: take '// &
         "other wavelengths or slip, or response = 'transient' or 'harmonic'")
   end subroutine check_repetition

   !> Refuse keys that contradict the requested accuracy. A limit by `largest_cells` alone is no contradiction: the
   !> plan reports the accuracy it reaches.
   subroutine check_accuracy(case, plan, error)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(error_t), allocatable, intent(inout) :: error
      if (plan%kind == run_march .and. case%step_tolerance > case%accuracy) then
         call raise(error, '&solver step_tolerance = '//to_text(case%step_tolerance, 3)//' contradicts accuracy = '// &
                    to_text(case%accuracy, 3)//': leave it out, or give at most a tenth of the accuracy')
      else if (case%tolerance > case%accuracy) then
         call raise(error, '&solver tolerance = '//to_text(case%tolerance, 3)//' contradicts accuracy = '// &
                    to_text(case%accuracy, 3)//': leave it out, or give at most a tenth of the accuracy')
      else if (plan%expected_error > case%accuracy .and. case%time_step_over_cell > 1) then
         call raise(error, '&solver time_step_over_cell = '//to_text(case%time_step_over_cell, 3)// &
            ' contradicts accuracy = '// &
                    to_text(case%accuracy, 3)//': the expected error is '//to_text(plan%expected_error, 2)// &
                    '; leave it out (steps of dT = hX add no error of their own)')
      else if (plan%expected_error > case%accuracy .and. max(case%cells_x, case%cells_y) > 0) then
         call raise(error, '&grid cells_x = '//to_text(plan%cells_x)//', cells_y = '//to_text(plan%cells_y)// &
                    ' contradict accuracy = '//to_text(case%accuracy, 3)//': the expected error is '// &
                    to_text(plan%expected_error, 2)//'; leave the cells out, or ask for less')
      end if
   end subroutine check_accuracy

end module ehlwave_case_plan
