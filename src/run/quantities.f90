!> The table of quantities: input, plan and result of a case. JSON, stores and HDF5 files follow from it, so a new
!> quantity needs an entry here and the code that computes it.
!>
!> An entry has a name, a long name and the value. It has a unit where the number is not dimensionless, and `exists`
!> where only some cases have it. `add_key` takes the description of a quantity that is also a key from its table.
!> `input_quantities` and `wave_quantities` have their parts of the table.
module ehlwave_quantities
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_keys, only: list_case_keys
   use ehlwave_case_result, only: case_result_t
   use ehlwave_conditions, only: conditions_t
   use ehlwave_effect_result, only: after_film, after_friction, after_waves
   use ehlwave_effects_keys, only: effect_count
   use ehlwave_effects_plan, only: error_help, error_name
   use ehlwave_error_account, only: validity_text
   use ehlwave_error_parts, only: error_parts_t
   use ehlwave_input_quantities, only: add_case, add_formulas, add_lengths
   use ehlwave_key_list, only: key_list_t
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_rolling_result, only: rolling_result_t
   use ehlwave_sensitivity_quantities, only: add_sensitivities
   use ehlwave_status, only: status_name
   use ehlwave_wave_quantities, only: add_response
   implicit none (type, external)
   private
   public :: add_result

   real(dp), parameter :: um_per_m = 1e6_dp

contains

   !> Quantities of the input and of the result.
   subroutine add_result(list, case, plan, result, identity)
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result
      character(len=*), intent(in), optional :: identity   !! identity of the case, if at hand
      type(key_list_t), save :: keys

      call list%add('status', 'outcome', status_name(result%status))
      call list%add('message', 'why a case did not converge or is not resolved', result%message)
      if (.not. list%has_errors_only) then
         call list_case_keys(case, keys)
         call add_case(list, case, keys, plan, identity)
      end if
      call list%add('is_resolved', '1 when the grid resolves the case', result%is_resolved)
      call add_smooth_film(list, plan, result)
      call result%effects%add_quantities(after_film, list, case, plan)
      call add_shear(list, case, plan, result)
      call list%add('load_error', 'largest load error of the solutions', result%load_error)
      call list%add('residual', 'largest mass residual of the solutions', result%residual)
      call list%add('amplitude_ratio', 'Ad/Ai from the samples', result%amplitude_ratio)
      call list%add('amplitude_ratio_fit', 'Ad/Ai from a harmonic fit', result%amplitude_ratio_fit)
      call list%add('phase_fit', 'phase of the harmonic fit against the pattern at the centre', result%phase_fit, &
         unit='rad')
      call list%add('mean_film', 'mean of H(0,0) over the measurement: a period, all phases, or a surface', &
         result%mean_film)
      call list%add('march_from', "start of the march of Ad/Ai: 'rest' or 'waves'", trim(result%route))
      call list%add('central_film_error', 'estimated relative error of central_film', result%central_film_error, &
                    error_of='H(0,0)')
      call list%add('minimum_film_error', 'estimated relative error of minimum_film', result%minimum_film_error, &
                    error_of='smallest H')
      call list%add('minimum_film_error_domain', 'part of it by the edges of the domain', &
                    result%minimum_film_domain_error)
      call list%add('friction_error', 'estimated relative error of friction_coefficient', result%friction_error, &
                    error_of='friction')
      call list%add('friction_error_domain', 'part of it by the oil outside the domain, out to radius_x_m from the '// &
                    'centre and at least twice the domain', result%friction_domain_error)
      call list%add('film_error_basis', 'basis of the errors of film and friction', trim(result%film_error_basis))
      call list%add('film_order', 'observed order of central_film on three levels', result%film_order)
      call list%add('amplitude_ratio_error', 'estimated relative error of Ad/Ai', result%amplitude_ratio_error, &
                    error_of='Ad/Ai')
      call list%add('amplitude_error_basis', 'basis of amplitude_ratio_error', &
                    trim(result%amplitude_error_basis))
      call add_parts(list, 'film', 'H(0,0)', result%film_errors)
      call add_parts(list, 'ratio', 'Ad/Ai', result%ratio_errors)
      call list%add('error_estimate', 'sum of the parts of the error of Ad/Ai, the larger of two surfaces, '// &
                    'or of H(0,0) of a smooth contact; compared with accuracy', result%error_estimate, &
                    error_of=trim(merge('Ad/Ai ', 'H(0,0)', case%has_ratio())))
      call list%add('refinements', 'runs on finer grids than the first, for an accuracy', result%refinements)
      call list%add('validity', 'range of validity: edges, linear range, warnings', &
                    validity_text(case, plan, result%warning))
      call add_response(list, result%harmonic, '', .true.)
      call result%effects%add_quantities(after_waves, list, case, plan)
      call add_sensitivities(list, case, result)
      call add_formulas(list, result)
      call add_effort(list, result)
   end subroutine add_result

   !> The parts of an error.
   subroutine add_parts(list, of, what, parts)
      type(quantity_list_t), intent(inout) :: list
      character(len=*), intent(in) :: of, what
      type(error_parts_t), intent(in) :: parts
      integer :: k
      call list%add(of//'_error_mesh', 'relative error of '//what//' by the mesh', parts%mesh)
      do k = 1, effect_count
         if (error_name(k) /= '') call list%add(of//'_error_'//error_name(k), 'part by '//error_help(k), &
                                                parts%by_effect(k))
      end do
      call list%add(of//'_error_domain', 'part by the edges of the domain', parts%domain)
      call list%add(of//'_error_time', 'part by steps longer than hX', parts%time)
      call list%add(of//'_error_amplitude', 'part by the size of the waves, which respond unlike small waves', &
         parts%amplitude)
      call list%add(of//'_error_settling', 'part by changes from period to period', parts%settling)
      call list%add(of//'_error_algebraic', 'part by the tolerances', parts%algebraic)
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
         call add_lengths(list, c)
         call list%add('hertz_pressure_pa', 'largest Hertz pressure', c%hertz_pressure_pa, unit='Pa', &
            exists=c%has_dimensions)
      end associate
   end subroutine add_smooth_film

   subroutine add_shear(list, case, plan, result)
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result
      logical :: is_estimated   !! the temperature rise, which &heat computes

      is_estimated = plan%conditions%has_dimensions .and. .not. case%effects%are_warm()
      associate (r => result%shear)
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
            r%inlet%rise_k, unit='K', exists=is_estimated)
         call list%add('inlet_film_factor', 'film with an inlet as warm over the isothermal film, estimated', &
            r%inlet%film_factor, exists=is_estimated)
         call list%add('inlet_film_factor_error', 'its error; unknown where the factor is a rough low estimate', &
            r%inlet%error, exists=is_estimated)
         call list%add('contact_temperature_rise_k', 'estimated mean temperature rise of the oil in the contact', &
            r%contact_rise_k, unit='K', exists=is_estimated)
      end associate
      call add_rolling(list, plan%conditions, result%rolling)
      call result%effects%add_quantities(after_friction, list, case, plan)
      call list%add('warning', 'relevant effect that the model lacks', result%warning)
   end subroutine add_shear

   !> Resistance to rolling.
   subroutine add_rolling(list, conditions, rolling)
      type(quantity_list_t), intent(inout) :: list
      type(conditions_t), intent(in) :: conditions
      type(rolling_result_t), intent(in) :: rolling
      character(len=4) :: per_width

      per_width = merge('/m  ', '    ', conditions%is_line())
      associate (c => conditions)
         call list%add('pressure_centre_x', 'X of the centre of pressure of the smooth contact, oil outside the '// &
                       'domain included, out to radius_x_m and at least twice the domain', rolling%pressure_centre_x)
         call list%add('rolling_resistance_coefficient', 'force that resists rolling at each surface of the smooth '// &
                       'contact over the load, the same oil included', rolling%coefficient)
         call list%add('rolling_resistance', 'force that resists rolling, at each surface', rolling%force(c), &
                       unit='N'//trim(per_width), exists=c%has_dimensions)
         call list%add('rolling_moment', 'moment of the pressure about the contact centre, rolling_resistance '// &
                       'times 2 radius_x_m', rolling%moment(c), unit=trim(merge('N  ', 'N m', c%is_line())), &
                       exists=c%has_dimensions)
         call list%add('rolling_power', 'power that rolling takes, rolling_resistance times the sum of the speeds', &
                       rolling%power(c), unit='W'//trim(per_width), exists=c%has_dimensions)
         call list%add('rolling_resistance_error', 'estimated relative error of them', rolling%error, &
                       error_of='rolling resistance')
         call list%add('rolling_resistance_error_domain', 'part of it by the edges of the domain and the oil outside', &
                       rolling%domain_error)
         call list%add('rolling_resistance_outside', 'share of them by oil outside the domain', rolling%share_outside)
      end associate
   end subroutine add_rolling

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
      call list%add('own_units', 'the same in deformations of the program itself: half domain, precision of linear '// &
         'systems', result%own_units)
      call list%add('total_work_units', 'the same with them, and with runs on coarser and finer grids', &
         result%total_work_units)
      call list%add('peak_memory_mib', 'peak memory of the process so far', result%peak_memory_mib, unit='MiB')
      call list%add_list('residual_history', 'mass residual of the solution that failed, before each step and at '// &
         'the end', result%residual_history)
   end subroutine add_effort

end module ehlwave_quantities
