!> The table of quantities: input, plan and result of a case. JSON, stores and HDF5 files follow from it, so a new
!> quantity is one entry here and the code that computes it.
!>
!> An entry has a name, a long name and the value. It has a unit where the number is not dimensionless, and `exists`
!> where only some cases have it. `add_key` takes the description of a quantity that is also a key from its table.
!> The file is long because it is one table.
module ehlwave_quantities
   use ehlwave_case_account, only: blank_result
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_key, only: key_long_name, number_kind, truth_kind, whole_kind
   use ehlwave_case_keys, only: case_key_list
   use ehlwave_case_result, only: case_result_t, oil_sensitivity_t
   use ehlwave_case_text, only: case_identity
   use ehlwave_key_list, only: find_key, key_list_t
   use ehlwave_error_account, only: validity_text
   use ehlwave_error_parts, only: error_parts_t
   use ehlwave_formula, only: moes_film_formula
   use ehlwave_harmonic_result, only: harmonic_result_t
   use ehlwave_heat_result, only: heat_result_t
   use ehlwave_kinds, only: dp
   use ehlwave_pair_result, only: pair_result_t
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_starved_result, only: starved_result_t
   use ehlwave_status, only: status_name
   use ehlwave_work_unit, only: work_unit_operations
   implicit none (type, external)
   private
   public :: add_case, add_key, add_plan, add_result

   real(dp), parameter :: um_per_m = 1e6_dp

contains

   !> Quantities of the input.
   subroutine add_case(list, case, plan)
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(key_list_t) :: keys
      integer :: i

      keys = case_key_list(case)
      associate (c => plan%conditions)
         call list%add('case_id', 'identity of the effective input', case_identity(case))
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
      call add_key(list, keys, 'orientation_2', case%is_pair())
      call add_key(list, keys, 'wavelength_x_over_a_2', case%is_pair())
      call add_key(list, keys, 'wavelength_y_over_a_2', case%is_pair())
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
      call list%add('expected_meniscus_error', 'part of it by the meniscus of a contact with too little oil', &
                    plan%expected%meniscus)
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
      call list%add('meniscus_resolution', &
                    'hX over the expected distance of the meniscus from the contact, 0: flooded', &
                    plan%resolution%meniscus)
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
      call add_case(list, case, plan)
      call list%add('run', 'what is computed: smooth, standing, march, harmonic or periodic', &
                    trim(merge('periodic', kinds(plan%kind), plan%is_periodic)))
      call list%add('time_steps', 'time steps to be done', plan%steps)
      call list%add('time_step', 'dT', plan%dt)
      call list%add('steady_states', 'steady states to be solved', 1 + plan%phases)
      call list%add('is_half_domain', '1 when only Y >= 0 is computed', plan%is_half)
      call list%add('is_resolved', '1 when the grid resolves the case', plan%resolution%is_resolved)
      call list%add('message', 'why the grid does not resolve the case', plan%resolution%reason)
      call list%add('validity', 'what the result will hold for: edges, linear range', validity_text(case, plan))
      call add_key(list, keys, 'accuracy')
      call list%add('expected_seconds', 'time expected by the plan', plan%expected_seconds(), unit='s')
      call list%add('expected_memory_mib', 'peak memory expected by the plan', plan%expected_memory_mib(), unit='MiB')
      call list%add('expected_total_work_units', 'the same with error estimates', plan%work_with_estimates)
      call list%add('largest_work_units', 'work at which the case ends, in plain FFT convolutions of the grid', &
                    plan%largest_work/work_unit_operations(plan%cells_x, plan%cells_y), exists=plan%has_work_cap())
      call add_key(list, keys, 'step_tolerance')
      associate (c => plan%conditions)
         call list%add('central_film_formula', 'central film by theory eq. (H1), of a line contact (H2), '// &
            '(h/Rx)(2U)^(-1/2)', moes_film_formula(c))
         call list%add('semi_axis_a_m', 'Hertz semi-axis along rolling', c%a_m, unit='m', exists=c%has_dimensions)
         call list%add('semi_axis_b_m', 'Hertz semi-axis across rolling', c%b_m, unit='m', &
                       exists=c%has_dimensions .and. .not. c%is_line())
         call list%add('hertz_approach_c_m', 'Hertz approach, the unit of H', c%c_m, unit='m', exists=c%has_dimensions)
         call list%add('moes_film_factor', 'film (h/Rx)(2U)^(-1/2) for H = 1', c%moes_film_factor)
      end associate
      call add_formulas(list, blank_result(case, plan))
   end subroutine add_plan

   !> The formula of Ad/Ai and what it is a function of.
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
      type(key_list_t), intent(in) :: keys      !! of the case
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

   !> Quantities of the input and of the result.
   subroutine add_result(list, case, plan, result)
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result

      call list%add('status', 'outcome', status_name(result%status))
      call list%add('message', 'why a case did not converge or is not resolved', result%message)
      call add_case(list, case, plan)
      call list%add('is_resolved', '1 when the grid resolves the case', result%is_resolved)
      call add_smooth_film(list, plan, result)
      call add_starvation(list, plan%inlet%is_short(), result%starved)
      call add_shear(list, case, plan, result)
      call list%add('load_error', 'largest load error of the solutions', result%load_error)
      call list%add('residual', 'largest mass residual of the solutions', result%residual)
      call list%add('amplitude_ratio', 'Ad/Ai from the samples', result%amplitude_ratio)
      call list%add('amplitude_ratio_fit', 'Ad/Ai from a harmonic fit', result%amplitude_ratio_fit)
      call list%add('phase_fit', 'phase of the harmonic fit against the pattern at the centre', result%phase_fit, &
         unit='rad')
      call list%add('mean_film', 'mean of H(0,0) over what is measured: a period, all phases, or a surface', &
         result%mean_film)
      call list%add('march_from', "what the march that Ad/Ai is from started in: 'rest' or 'waves'", trim(result%route))
      call list%add('central_film_error', 'estimated relative error of central_film', result%central_film_error)
      call list%add('minimum_film_error', 'estimated relative error of minimum_film', result%minimum_film_error)
      call list%add('minimum_film_error_domain', 'part of it by the edges of the domain', &
                    result%minimum_film_domain_error)
      call list%add('friction_error', 'estimated relative error of friction_coefficient', result%friction_error)
      call list%add('friction_error_domain', 'part of it by the oil outside the domain, out to radius_x_m from the '// &
                    'centre and at least twice the domain', result%friction_domain_error)
      call list%add('film_error_basis', 'what the errors of film and friction are from', trim(result%film_error_basis))
      call list%add('film_order', 'observed order of central_film on three levels', result%film_order)
      call list%add('amplitude_ratio_error', 'estimated relative error of Ad/Ai', result%amplitude_ratio_error)
      call list%add('amplitude_error_basis', 'what amplitude_ratio_error is from', &
                    trim(result%amplitude_error_basis))
      call add_parts(list, 'film', 'H(0,0)', result%film_errors)
      call add_parts(list, 'ratio', 'Ad/Ai', result%ratio_errors)
      call list%add('error_estimate', 'sum of the parts of the error of Ad/Ai, of two surfaces of the worse one, '// &
                    'of smooth contacts of H(0,0): what accuracy is about', result%error_estimate)
      call list%add('refinements', 'runs on finer grids than the first, for an accuracy', result%refinements)
      call list%add('validity', 'what the result holds for: edges, linear range, warnings', &
                    validity_text(case, plan, result%warning))
      call add_response(list, result%harmonic, '', .true.)
      call add_pair(list, case%is_pair(), result%pair)
      call add_sensitivities(list, case, result%by_oil)
      call add_formulas(list, result)
      call add_effort(list, result)
   end subroutine add_result

   !> The parts of an error.
   subroutine add_parts(list, of, what, parts)
      type(quantity_list_t), intent(inout) :: list
      character(len=*), intent(in) :: of, what
      type(error_parts_t), intent(in) :: parts
      call list%add(of//'_error_mesh', 'relative error of '//what//' by the mesh', parts%mesh)
      call list%add(of//'_error_meniscus', 'the same by the meniscus of a contact with too little oil', parts%meniscus)
      call list%add(of//'_error_domain', 'the same by the edges of the domain', parts%domain)
      call list%add(of//'_error_time', 'the same by steps longer than hX', parts%time)
      call list%add(of//'_error_amplitude', 'the same by the size of the waves, which respond unlike small ones', &
         parts%amplitude)
      call list%add(of//'_error_settling', 'the same by what still changes from period to period', parts%settling)
      call list%add(of//'_error_algebraic', 'the same by the tolerances', parts%algebraic)
   end subroutine add_parts

   subroutine add_smooth_film(list, plan, result)
      type(quantity_list_t), intent(inout) :: list
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result

      call list%add('central_film', 'smooth central film thickness H(0,0)', result%central_film)
      call list%add('minimum_film', 'smallest film thickness H of the smooth contact', result%minimum_film)
      call list%add('central_film_moes', 'H(0,0) in the Moes scale', result%central_film_moes)
      call list%add('max_pressure', 'largest P of the smooth contact', result%max_pressure)
      associate (c => plan%conditions)
         call list%add('central_film_um', 'smooth central film thickness h(0,0)', result%central_film*c%c_m*um_per_m, &
                       unit='um', exists=c%has_dimensions)
         call list%add('minimum_film_um', 'smallest film thickness h of the smooth contact', &
                       result%minimum_film*c%c_m*um_per_m, unit='um', exists=c%has_dimensions)
         call list%add('length_a_m', 'Hertz semi-axis in x', c%a_m, unit='m', exists=c%has_dimensions)
         call list%add('length_b_m', 'Hertz semi-axis in y', c%b_m, unit='m', &
                       exists=c%has_dimensions .and. .not. c%is_line())
         call list%add('length_c_m', 'Hertz approach', c%c_m, unit='m', exists=c%has_dimensions)
         call list%add('hertz_pressure_pa', 'largest Hertz pressure', c%hertz_pressure_pa, unit='Pa', &
            exists=c%has_dimensions)
      end associate
   end subroutine add_smooth_film

   subroutine add_starvation(list, is_short, starved)
      type(quantity_list_t), intent(inout) :: list
      logical, intent(in) :: is_short
      type(starved_result_t), intent(in) :: starved

      call list%add('film_over_flooded', 'R, central_film over flooded_central_film', starved%film_over_flooded, &
                    exists=is_short)
      call list%add('film_over_flooded_error', 'estimated relative error of film_over_flooded by the mesh', &
                    starved%film_over_flooded_error, exists=is_short)
      call list%add('flooded_central_film', 'H(0,0) of the flooded contact with the same domain and edges', &
                    starved%flooded_film, exists=is_short)
      call list%add('oil_offered', 'r at Y = 0, oil offered over what the flooded contact passes', &
                    starved%oil_over_flooded, exists=is_short)
      call list%add('mass_balance_error', 'oil lost or gained over oil that enters', starved%passage%balance_error, &
                    exists=is_short)
      call list%add('side_flow', 'share of the oil that leaves over the sides', starved%passage%side_flow, &
                    exists=is_short)
      call list%add('meniscus_x', 'X at Y = 0 from which on the gap is full', starved%passage%meniscus_x, &
                    exists=is_short)
      call list%add('starved_over_flooded_work', 'counted work of the starved solve over that of the flooded one', &
                    starved%solve_over_flooded, exists=is_short)
   end subroutine add_starvation

   subroutine add_shear(list, case, plan, result)
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result

      associate (r => result%shear, c => plan%conditions)
         call list%add('friction_coefficient', 'friction of the smooth contact over the load, within the domain, '// &
                       'mean of both surfaces', r%friction_coefficient)
         call list%add('largest_b', 'largest |B|, shear rate times viscosity over the stress of the flow law', &
            r%largest_b)
         call list%add('tangent_factor_x', 'flow along X under a small gradient over the Newtonian one, at the '// &
            'centre', r%tangent_factor(1))
         call list%add('tangent_factor_y', 'flow along Y under a small gradient over the Newtonian one, at the '// &
            'centre', r%tangent_factor(2))
         call list%add('share_beyond_limit', 'share of the load borne where the shear stress is above its limit', &
                       r%share_beyond_limit)
         call list%add('inlet_temperature_rise_k', 'estimated temperature rise of the oil in the inlet', &
            r%inlet_rise_k, unit='K', exists=c%has_dimensions)
         call list%add('contact_temperature_rise_k', 'estimated mean temperature rise of the oil in the contact', &
                       r%contact_rise_k, unit='K', exists=c%has_dimensions)
      end associate
      call add_heat(list, case, plan, result%heat)
      call list%add('warning', 'what the model leaves out and matters here', result%warning)
   end subroutine add_shear

   !> Temperatures and heat, where they are found.
   subroutine add_heat(list, case, plan, heat)
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(heat_result_t), intent(in) :: heat
      character(len=3) :: watt
      character(len=1) :: wall
      logical :: is_warm
      integer :: i

      is_warm = case%heat%is_given()
      watt = merge('W/m', 'W  ', plan%conditions%is_line())
      call list%add('isothermal_friction_coefficient', 'friction_coefficient without heat', heat%isothermal_friction, &
         exists=is_warm)
      call list%add('isothermal_central_film', 'central_film without heat', heat%isothermal_film, exists=is_warm)
      call list%add('largest_rise_mid_film_k', 'largest rise of the temperature half-way across the film', &
         heat%largest_mid_k, unit='K', exists=is_warm)
      call list%add('central_rise_mid_film_k', 'the same at the contact centre', heat%centre_mid_k, unit='K', &
         exists=is_warm)
      call list%add('largest_rise_mean_k', 'largest rise of the mean temperature across the film', &
         heat%largest_mean_k, unit='K', exists=is_warm)
      do i = 1, 2
         wall = merge('1', '2', i == 1)
         call list%add('largest_rise_wall_'//wall//'_k', 'largest rise of the temperature of surface '//wall, &
            heat%largest_wall_k(i), unit='K', exists=is_warm)
         call list%add('central_rise_wall_'//wall//'_k', 'the same at the contact centre', heat%centre_wall_k(i), &
            unit='K', exists=is_warm)
         call list%add('heat_into_body_'//wall, 'heat that flows into body '//wall//' under pressure', &
            heat%into_body_w(i), unit=trim(watt), exists=is_warm)
      end do
      call list%add('heat_of_shear', 'power dissipated by shear', heat%sheared_w, unit=trim(watt), exists=is_warm)
      call list%add('heat_of_compression', 'heat of compression less that of expansion', heat%compressed_w, &
         unit=trim(watt), exists=is_warm)
      call list%add('heat_carried_by_oil', 'heat that the oil carries out of the film under pressure', heat%carried_w, &
         unit=trim(watt), exists=is_warm)
      call list%add('heat_levels_error', 'error of film and friction by the levels across the film, part of theirs', &
         heat%levels_error, exists=is_warm)
      call list%add('heat_balance_error', 'heat that is missing over the largest part', heat%balance_error, &
         exists=is_warm)
      call list%add('frozen_heat_error', 'estimated error of Ad/Ai over Ai by temperatures that stay as waves '// &
         'pass; part of no other error', heat%frozen_error, exists=is_warm .and. case%is_wavy())
      call list%add('wave_temperatures', "temperatures as waves pass: 'frozen', those of the smooth contact; "// &
         "'carried', in marches those of the oil in time", trim(merge(case%heat%wave_temperatures, &
         repeat(' ', len(case%heat%wave_temperatures)), is_warm .and. case%is_wavy())), &
         exists=is_warm .and. case%is_wavy())
   end subroutine add_heat

   !> Quantities of two rough surfaces besides those of the first.
   subroutine add_pair(list, is_pair, pair)
      type(quantity_list_t), intent(inout) :: list
      logical, intent(in) :: is_pair
      type(pair_result_t), intent(in) :: pair

      call list%add('amplitude_ratio_fit_2', 'Ad/Ai of the waves of surface 2 from a harmonic fit', pair%ratio_fit, &
         exists=is_pair)
      call list%add('phase_fit_2', 'phase of their harmonic fit against their pattern at the centre', pair%phase_fit, &
         unit='rad', exists=is_pair)
      call add_response(list, pair%harmonic, '_2', is_pair)
      call list%add('film_rms_both', 'rms of H(0,0) by the waves of both surfaces over central_film, phases free '// &
         'even where the waves have one frequency, linear responses', pair%film_rms, exists=is_pair)
      call list%add('mean_film_rise_both', 'mean film with the waves of both surfaces less smooth film over Ai of '// &
         'the first, second order, linear responses', pair%mean_rise, exists=is_pair)
      call list%add('mean_film_rise_cross', 'part of mean_film_rise_both that neither surface has alone', &
         pair%cross_rise, exists=is_pair)
      call list%add('smallest_film_both', 'smallest film with the waves of both surfaces anywhere at any time, '// &
         'phases free even where the waves have one frequency, second order', pair%smallest_film, exists=is_pair)
      call list%add_truth('surfaces_touch_both', '1 when both waves together would touch, second order; -1: not '// &
         'known', pair%surfaces_touch, exists=is_pair)
   end subroutine add_pair

   !> The linear response to the waves of a surface.
   subroutine add_response(list, harmonic, number, exists)
      type(quantity_list_t), intent(inout) :: list
      type(harmonic_result_t), intent(in) :: harmonic
      character(len=*), intent(in) :: number         !! that names end in: '' of the first surface, '_2'
      logical, intent(in) :: exists
      character(len=:), allocatable :: of

      of = ''
      if (number /= '') of = ', surface 2'
      call put('harmonic_ratio', 'Ad/Ai of small waves, linear response', harmonic%ratio)
      call put('harmonic_phase', 'phase of the linear response of H(0,0)', harmonic%phase, unit='rad')
      call put_complex('harmonic', 'transfer function pattern to H(0,0)', &
                       cmplx(harmonic%real_part, harmonic%imaginary_part, dp))
      call put_complex('harmonic_pressure', 'transfer function pattern (in c) to P(0,0)', harmonic%pressure)
      call put('harmonic_approach', 'amplitude of the approach over Ai', harmonic%approach_ratio)
      call put('harmonic_extrapolated', 'harmonic_ratio at mesh size 0', harmonic%extrapolated)
      call put_complex('harmonic_extrapolated', 'transfer function pattern to H(0,0) at mesh size 0', &
         harmonic%film_limit)
      call put_complex('harmonic_pressure_extrapolated', &
         'transfer function pattern (in c) to P(0,0) at mesh size 0', harmonic%pressure_limit)
      call put('harmonic_error', 'estimated relative error of harmonic_ratio', harmonic%error)
      call put('harmonic_error_basis', 'what harmonic_error is from', trim(harmonic%error_basis))
      call put('mean_film_rise', 'mean film less smooth film over Ai, second order, linear response', &
         harmonic%mean_rise)
      call put('smallest_film', 'smallest film with waves of Ai anywhere at any time, second order', &
                    harmonic%smallest_film)
      call put('smallest_film_x', 'X of the smallest film with waves, or of where they would touch', &
         harmonic%smallest_film_x)
      call put('smallest_film_y', 'Y of the smallest film with waves, or of where they would touch', &
         harmonic%smallest_film_y)
      call list%add_truth('surfaces_touch'//number, '1 when waves of Ai would touch the other surface, second '// &
         'order: there is no smallest_film; -1: not known'//of, harmonic%surfaces_touch, exists=exists)
      call add_waves()
      call put('harmonic_linear_steps', 'GMRES steps of the linear response', harmonic%linear_steps)
      call put('harmonic_work_units', 'processor time of the linear response in plain FFT convolutions of the '// &
         'grid', harmonic%work_units)
      call put('harmonic_counted_work_units', 'the same counted', harmonic%counted_work_units)

   contains

      subroutine put(name, long_name, value, unit)
         character(len=*), intent(in) :: name, long_name
         class(*), intent(in) :: value
         character(len=*), intent(in), optional :: unit
         call list%add(name//number, long_name//of, value, unit=unit, exists=exists)
      end subroutine put

      subroutine put_complex(name, long_name, value, unit)
         character(len=*), intent(in) :: name, long_name
         complex(dp), intent(in) :: value
         character(len=*), intent(in), optional :: unit
         call put(name//'_real', long_name//', real part', real(value, dp), unit)
         call put(name//'_imaginary', long_name//', imaginary part', aimag(value), unit)
      end subroutine put_complex

      !> The two waves of the film at the centre.
      subroutine add_waves()
         associate (row => harmonic%waves%centre)
            call put_complex('attenuated', 'wave of the film that moves with the surface, over Ai', row%fit%attenuated)
            call put_complex('complementary', 'wave of the film that moves with the oil, over Ai', &
               row%fit%complementary)
            call put_complex('psi', 'wave number of the complementary wave', row%fit%psi, unit='1/a')
            call put('two_wave_misfit', 'what both waves leave of the film, rms over Ai, |X| <= 0.5', row%fit%misfit)
            call put_complex('attenuated_formula', 'attenuated wave over Ai in closed form', row%attenuated)
            call put_complex('psi_formula', 'psi in closed form', row%psi, unit='1/a')
         end associate
      end subroutine add_waves

   end subroutine add_response

   !> Derivatives by the oil, where they were asked for.
   subroutine add_sensitivities(list, case, by_oil)
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      type(oil_sensitivity_t), intent(in) :: by_oil(:)
      character(len=*), parameter :: by(2) = [character(len=6) :: 'alpha', 'stress'], &
                                     of(2) = [character(len=31) :: 'alpha', 'the stress of the flow law']
      integer :: x

      do x = 1, size(by_oil)
         call list%add('film_sensitivity_'//trim(by(x)), 'd ln H(0,0) of the smooth contact/d ln '//trim(of(x)), &
            by_oil(x)%film, exists=case%sensitivities)
         call list%add('response_sensitivity_'//trim(by(x)), 'd ln harmonic_ratio/d ln '//trim(of(x)), &
            by_oil(x)%response, exists=case%sensitivities)
         call list%add('response_real_by_'//trim(by(x)), 'd harmonic_real/d ln '//trim(of(x)), &
            by_oil(x)%response_real, exists=case%sensitivities)
         call list%add('response_imaginary_by_'//trim(by(x)), 'd harmonic_imaginary/d ln '//trim(of(x)), &
                       by_oil(x)%response_imaginary, exists=case%sensitivities)
      end do
   end subroutine add_sensitivities

   subroutine add_effort(list, result)
      type(quantity_list_t), intent(inout) :: list
      type(case_result_t), intent(in) :: result

      call list%add('time_steps', 'time steps done', result%time_steps)
      call list%add('nonlinear_steps', 'Newton steps, or FAS cycles, on the finest grid', result%nonlinear_steps)
      call list%add('linear_steps', 'GMRES steps, or FAS sweeps, on the finest grid', result%linear_steps)
      call list%add('rung', 'highest rung of the rescue ladder used', trim(result%rung))
      call list%add('rescued_solutions', 'solutions that took more than the direct solve', result%rescued_solutions)
      call list%add('seconds', 'wall time of the case', result%seconds, unit='s')
      call list%add('work_units', 'wall time in plain FFT convolutions of the grid', result%work_units)
      call list%add('counted_work_units', 'the same counted, without error estimates and sensitivities', &
         result%counted_work_units)
      call list%add('total_work_units', 'the same with them, and with runs on coarser and finer grids', &
         result%total_work_units)
      call list%add('peak_memory_mib', 'peak memory of the process so far', result%peak_memory_mib, unit='MiB')
      call list%add_list('residual_history', 'mass residual of the solution that failed, before each step and at '// &
         'the end', result%residual_history)
   end subroutine add_effort

end module ehlwave_quantities
