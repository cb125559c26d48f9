!> Plan and result of a case as JSON for programs and for the store: a new result of a case is added here.
module ehlwave_case_json
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: case_plan_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_case_text, only: case_identity
   use ehlwave_error_estimate, only: basis_name
   use ehlwave_json, only: json_t
   use ehlwave_kinds, only: dp
   use ehlwave_status, only: status_name
   implicit none (type, external)
   private
   public :: plan_json, result_json

contains

   !> The plan as one JSON object.
   function plan_json(case, plan) result(json)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(json_t) :: json
      character(len=14), parameter :: kinds(4) = [character(len=14) :: 'smooth', 'standing', 'march', 'harmonic']

      call json%add('case_id', case_identity(case))
      call add_case(json, case, plan)
      call json%add('run', trim(kinds(plan%kind)))
      call json%add('time_steps', plan%steps)
      call json%add('time_step', plan%dt)
      call json%add('steady_states', 1 + plan%phases)
      call json%add('is_half_domain', plan%is_half)
      call json%add('is_resolved', plan%resolution%is_resolved)
      call json%add('message', plan%resolution%reason)
      call json%add('accuracy', case%accuracy)
      call json%add('expected_seconds', plan%expected_seconds())
      call json%add('step_tolerance', case%step_tolerance)
      call json%add('tolerance', case%tolerance)
   end function plan_json

   !> The result as one JSON object.
   function result_json(case, plan, result) result(json)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result
      type(json_t) :: json

      call json%add('status', status_name(result%status))
      call json%add('message', result%message)
      call json%add('case_id', case_identity(case))
      call add_case(json, case, plan)
      call json%add('is_resolved', result%is_resolved)
      call json%add('central_film', result%central_film)
      call json%add('minimum_film', result%minimum_film)
      call json%add('central_film_moes', result%central_film_moes)
      call json%add('max_pressure', result%max_pressure)
      if (plan%conditions%has_dimensions) then
         call json%add('central_film_um', result%central_film*plan%conditions%c_m*1e6_dp)
         call json%add('minimum_film_um', result%minimum_film*plan%conditions%c_m*1e6_dp)
      end if
      call json%add('load_error', result%load_error)
      call json%add('residual', result%residual)
      call json%add('amplitude_ratio', result%amplitude_ratio)
      call json%add('amplitude_ratio_fit', result%amplitude_ratio_fit)
      call json%add('phase_fit', result%phase_fit)
      call json%add('mean_film', result%mean_film)
      call json%add('central_film_error', result%central_film_error)
      call json%add('minimum_film_error', result%minimum_film_error)
      call json%add('film_order', result%film_order)
      call json%add('amplitude_ratio_error', result%amplitude_ratio_error)
      call json%add('amplitude_error_basis', trim(basis_name(result%amplitude_error_basis)))
      call json%add('harmonic_ratio', result%harmonic%ratio)
      call json%add('harmonic_phase', result%harmonic%phase)
      call json%add('harmonic_real', result%harmonic%real_part)
      call json%add('harmonic_imaginary', result%harmonic%imaginary_part)
      call json%add('harmonic_approach', result%harmonic%approach_ratio)
      call json%add('harmonic_extrapolated', result%harmonic%extrapolated)
      call json%add('harmonic_error', result%harmonic%error)
      call json%add('harmonic_linear_steps', result%harmonic%linear_steps)
      call json%add('harmonic_work_units', result%harmonic%work_units)
      call json%add('v', result%v)
      call json%add('v2', result%v2)
      call json%add('f_r', result%f_r)
      call json%add('formula_ratio', result%formula_ratio)
      call json%add('time_steps', result%time_steps)
      call json%add('nonlinear_steps', result%nonlinear_steps)
      call json%add('linear_steps', result%linear_steps)
      call json%add('rung', trim(result%rung))
      call json%add('rescued_solutions', result%rescued_solutions)
      call json%add('seconds', result%seconds)
      call json%add('work_units', result%work_units)
      call json%add('peak_memory_mib', result%peak_memory_mib)
      if (allocated(result%residual_history)) call json%add_list('residual_history', result%residual_history)
   end function result_json

   !> What the case is.
   subroutine add_case(json, case, plan)
      type(json_t), intent(inout) :: json
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      call json%add('load_parameter_m', plan%conditions%m)
      call json%add('lubricant_parameter_l', plan%conditions%l)
      call json%add('radius_ratio_d', plan%conditions%d)
      call json%add('slip_parameter', case%slip_parameter)
      call json%add('kappa', plan%conditions%elliptic%kappa)
      call json%add('gamma', plan%conditions%gamma)
      call json%add('alphabar', plan%conditions%alphabar)
      call json%add('lambdabar', plan%conditions%lambdabar)
      call json%add('orientation', trim(case%orientation))
      call json%add('response', trim(case%response))
      if (allocated(plan%waviness%surface)) call json%add('surface_file', trim(case%surface_file))
      call json%add('wavelength_x_over_a', case%wavelength_x_over_a)
      call json%add('wavelength_y_over_a', case%wavelength_y_over_a)
      call json%add('deformation', trim(plan%deformation))
      call json%add('expected_error', plan%expected_error)
      call json%add('expected_work_units', plan%expected_work_units)
      call json%add('cells_x', plan%cells_x)
      call json%add('cells_y', plan%cells_y)
      call json%add('inlet_resolution', plan%resolution%inlet)
      call json%add('inlet_gap_over_film', plan%resolution%inlet_gap)
      call json%add('points_per_wave_x', plan%resolution%points_x)
      call json%add('points_per_wave_y', plan%resolution%points_y)
   end subroutine add_case

end module ehlwave_case_json
