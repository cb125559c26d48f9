!> Quantities of the input and the plan of a case, see `ehlwave_quantities`.
module ehlwave_input_quantities
   use ehlwave_case_account, only: blank_result
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_key, only: key_long_name, number_kind, truth_kind, whole_kind
   use ehlwave_case_keys, only: case_key_list
   use ehlwave_case_result, only: case_result_t
   use ehlwave_case_text, only: input_identity, input_text
   use ehlwave_conditions, only: conditions_t
   use ehlwave_effects_keys, only: effect_count
   use ehlwave_effects_plan, only: error_help, error_name
   use ehlwave_error_account, only: validity_text
   use ehlwave_formula, only: moes_film_formula
   use ehlwave_identity_index, only: identity_length
   use ehlwave_key_list, only: find_key, key_list_t
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_work_unit, only: work_unit_operations
   implicit none (type, external)
   private
   public :: add_case, add_formulas, add_key, add_lengths, add_plan

contains

   !> Quantities of the input.
   subroutine add_case(list, case, keys, plan, identity)
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      type(key_list_t), intent(in) :: keys      !! keys of the case
      type(case_plan_t), intent(in) :: plan
      character(len=*), intent(in), optional :: identity   !! identity of the case, if at hand
      character(len=19), parameter :: of_waves(3) = [character(len=19) :: 'orientation', 'wavelength_x_over_a', &
                                                     'wavelength_y_over_a']
      character(len=identity_length) :: own
      integer :: i, n

      if (present(identity)) then
         own = identity
      else
         own = input_identity(input_text(keys))
      end if
      associate (c => plan%conditions)
         call list%add('case_id', 'identity of the effective input', own)
         call list%add('load_parameter_m', 'Moes load parameter M', c%m)
         call list%add('lubricant_parameter_l', 'Moes lubricant parameter L', c%l)
         call list%add('radius_ratio_d', 'D = Rx/Ry', c%d)
         call add_key(list, keys, 'slip_parameter')
         call list%add('kappa', 'ellipticity a/b', c%elliptic%kappa)
         call list%add('gamma', 'pressure factor of the ellipticity', c%gamma)
         call list%add('alphabar', 'alpha ph', c%alphabar)
         call list%add('lambdabar', 'dimensionless speed parameter', c%lambdabar)
      end associate
      call add_key(list, keys, 'orientation')
      call add_key(list, keys, 'response')
      do i = 1, size(plan%files)
         associate (file => plan%files(i))
            call list%add(trim(file%name)//'_file', file%long_name, file%path, exists=file%path /= '')
            call list%add(trim(file%name)//'_digest', 'digest of the numbers in '//trim(file%name)//'_file', &
                          file%digest, exists=file%path /= '')
         end associate
      end do
      call add_key(list, keys, 'wavelength_x_over_a')
      call add_key(list, keys, 'wavelength_y_over_a')
      do n = 1, size(of_waves)
         call add_key(list, keys, trim(of_waves(n))//'_2', case%is_pair())
      end do
      call list%add('deformation', 'fft or mlmi on the finest grid', trim(plan%deformation))
      call list%add('expected_error', 'relative error expected by the plan', plan%expected_error)
      call add_key(list, keys, 'edges')
      call add_key(list, keys, 'method')
      call add_key(list, keys, 'tolerance')
      call list%add('scheme', 'differences of the Reynolds equation, averaged or fitted to steep inlets', &
                    trim(merge('fitted  ', 'averaged', plan%is_fitted)))
      call list%add('domain_error', 'relative error expected by the edges of the domain, besides expected_error', &
         plan%domain_error)
      call list%add('expected_mesh_error', 'part of it by the mesh', plan%expected%mesh)
      do i = 1, effect_count
         if (error_name(i) /= '') call list%add('expected_'//error_name(i)//'_error', 'part of it by '//error_help(i), &
                                                plan%expected%by_effect(i))
      end do
      call list%add('expected_time_error', 'part of it by steps longer than hX', plan%expected%time)
      call list%add('expected_algebraic_error', 'part of it by the tolerances', plan%expected%algebraic)
      call list%add('expected_amplitude_error', 'expected difference from small waves, besides expected_error', &
                    plan%expected%amplitude)
      call list%add('domain_x_min', 'X of the inlet boundary in use', plan%x_min)
      call list%add('domain_x_max', 'X of the outlet boundary in use', plan%x_max)
      call list%add('domain_y_max', 'Y of the side boundary in use', plan%y_max)
      call list%add('expected_work_units', 'work expected by the plan, counted in plain FFT convolutions of the grid', &
                    plan%expected_work_units)
      call list%add('cells_x', 'cells along X', plan%cells_x)
      call list%add('cells_y', 'cells along Y, whole domain', plan%cells_y)
      call list%add('inlet_resolution', 'hX over the length of the inlet pressure sweep', plan%resolution%inlet)
      call plan%effects%add_quantities(list)
      call list%add('inlet_gap_over_film', 'gap at x_min over the film of the formula', plan%resolution%inlet_gap)
      call list%add('points_per_wave_x', 'mesh sizes per wave along X', plan%resolution%points_x)
      call list%add('points_per_wave_y', 'mesh sizes per wave along Y', plan%resolution%points_y)
   end subroutine add_case

   !> Quantities of the plan, known before the case has run.
   subroutine add_plan(list, case, plan)
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(key_list_t) :: keys
      character(len=8), parameter :: kinds(4) = [character(len=8) :: 'smooth', 'standing', 'march', 'harmonic']

      keys = case_key_list(case)
      call add_case(list, case, keys, plan)
      call list%add('run', 'computation: smooth, standing, march, harmonic or periodic', &
                    trim(merge('periodic', kinds(plan%kind), plan%is_periodic)))
      call list%add('time_steps', 'time steps to be done', plan%steps)
      call list%add('time_step', 'dT', plan%dt)
      call list%add('steady_states', 'steady states to be solved', 1 + plan%phases)
      call list%add('is_half_domain', '1 when only Y >= 0 is computed', plan%is_half)
      call list%add('is_resolved', '1 when the grid resolves the case', plan%resolution%is_resolved)
      call list%add('message', 'why the grid does not resolve the case', plan%resolution%reason)
      call list%add('validity', 'range of validity: edges, linear range', validity_text(case, plan))
      call add_key(list, keys, 'accuracy')
      call list%add('expected_seconds', 'time expected by the plan', plan%expected_seconds(), unit='s')
      call list%add('expected_memory_mib', 'peak memory expected by the plan', plan%expected_memory_mib(), unit='MiB')
      call list%add('expected_total_work_units', 'the same with error estimates', plan%work_with_estimates)
      call list%add('largest_work_units', 'work at which the case ends, in plain FFT convolutions of the grid', &
                    plan%largest_work_in_all/work_unit_operations(plan%cells_x, plan%cells_y), &
                    exists=plan%has_work_cap())
      call add_key(list, keys, 'step_tolerance')
      associate (c => plan%conditions)
         call list%add('central_film_formula', 'central film by theory eq. (H1), of a line contact (H2), '// &
            '(h/Rx)(2U)^(-1/2)', moes_film_formula(c))
         call add_lengths(list, c)
         call list%add('moes_film_factor', 'film (h/Rx)(2U)^(-1/2) for H = 1', c%moes_film_factor)
      end associate
      call add_formulas(list, blank_result(case, plan))
   end subroutine add_plan

   !> Hertz's lengths a, b and c of a contact with dimensions, named as in the Python package.
   subroutine add_lengths(list, conditions)
      type(quantity_list_t), intent(inout) :: list
      type(conditions_t), intent(in) :: conditions
      associate (c => conditions)
         call list%add('semi_axis_a_m', 'Hertz semi-axis in x', c%a_m, unit='m', exists=c%has_dimensions)
         call list%add('semi_axis_b_m', 'Hertz semi-axis in y', c%b_m, unit='m', &
                       exists=c%has_dimensions .and. .not. c%is_line())
         call list%add('hertz_approach_c_m', 'Hertz approach', c%c_m, unit='m', exists=c%has_dimensions)
      end associate
   end subroutine add_lengths

   !> The formula of Ad/Ai and its arguments.
   subroutine add_formulas(list, result)
      type(quantity_list_t), intent(inout) :: list
      type(case_result_t), intent(in) :: result
      call list%add('v', 'V of theory eq. (17)', result%v)
      call list%add('v2', 'V2 of theory eq. (16)', result%v2)
      call list%add('f_r', 'f(r) of theory eq. (15)', result%f_r)
      call list%add('formula_ratio', 'Ad/Ai by theory eq. (18)', result%formula_ratio)
   end subroutine add_formulas

   !> A key of the case with the value in use.
   subroutine add_key(list, keys, name, exists)
      type(quantity_list_t), intent(inout) :: list
      type(key_list_t), intent(in) :: keys      !! keys of the case
      character(len=*), intent(in) :: name
      logical, intent(in), optional :: exists
      integer :: k

      k = find_key(keys%keys, name)
      associate (key => keys%keys(k), value => keys%values(k))
         select case (key%kind)
         case (number_kind); call list%add(name, key_long_name(key), value%number, unit=trim(key%unit), exists=exists)
         case (whole_kind); call list%add(name, key_long_name(key), nint(value%number), exists=exists)
         case (truth_kind); call list%add(name, key_long_name(key), value%number > 0, exists=exists)
         case default; call list%add(name, key_long_name(key), value%word, exists=exists)
         end select
      end associate
   end subroutine add_key

end module ehlwave_input_quantities
