!> Plan and result of a case, as text for people and as JSON for programs.
module ehlwave_case_report
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: case_plan_t, run_harmonic, run_march, run_smooth, run_standing
   use ehlwave_case_result, only: case_result_t
   use ehlwave_case_text, only: case_identity
   use ehlwave_error_estimate, only: basis_coarse_grid, basis_name
   use ehlwave_json, only: json_t
   use ehlwave_kinds, only: dp
   use ehlwave_resolution, only: flooded_inlet_gap
   use ehlwave_status, only: is_success, status_name
   use ehlwave_surface_plan, only: surface_text
   use ehlwave_text, only: to_text
   use ehlwave_work_unit, only: work_unit_seconds
   implicit none (type, external)
   private
   public :: print_plan, print_result, result_json, plan_json

contains

   !> The plan, to a unit.
   subroutine print_plan(unit, case, plan)
      integer, intent(in) :: unit
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan

      associate (c => plan%conditions)
         write (unit, '(a)') 'Conditions   M = '//to_text(c%m, 6)//', L = '//to_text(c%l, 6)//', D = '//to_text(c%d, 6)// &
            ', S = '//to_text(case%slip_parameter, 6)
         if (c%is_line()) write (unit, '(a)') '             line contact: H in units of a^2/(2 Rx), V = (lambda/a) M^(3/4) L^(-1/2)'
         write (unit, '(a)') '             kappa = '//to_text(c%elliptic%kappa, 6)//', gamma = '//to_text(c%gamma, 6)// &
            ', alphabar = '//to_text(c%alphabar, 6)//', lambdabar = '//to_text(c%lambdabar, 6)
         if (c%hertz_pressure_pa > 0) write (unit, '(a)') '             ph = '//to_text(c%hertz_pressure_pa*1e-9_dp, 5)//' GPa'
         if (c%has_dimensions) write (unit, '(a)') '             a = '//to_text(c%a_m*1e3_dp, 5)//' mm, b = '// &
            to_text(c%b_m*1e3_dp, 5)//' mm, c = '//to_text(c%c_m*1e6_dp, 5)//' um'
         write (unit, '(a)') 'Lubricant    '//trim(case%viscosity_law)//', '//trim(case%density_law)
         if (allocated(plan%waviness%surface)) then
            write (unit, '(a)') 'Waviness     '//surface_text(case, plan%waviness, c)
         else
            write (unit, '(a)') 'Waviness     '//waviness_text(case)
         end if
         write (unit, '(a)') 'Run          '//run_text(case, plan)
         write (unit, '(a)') 'Solver       '//solver_text(case)
         write (unit, '(a)') 'Domain       '//to_text(case%x_min, 4)//' <= X <= '//to_text(case%x_max, 4)//width_text(case, plan)
         if (c%is_line()) then
            write (unit, '(a)') 'Grid         '//to_text(plan%cells_x)//' cells, hX = '//to_text(plan%hx, 5)// &
               ' ('//plan%grid_reason//')'
         else
            write (unit, '(a)') 'Grid         '//to_text(plan%cells_x)//' x '//to_text(plan%cells_y)//' cells on the whole '// &
               'domain, hX = '//to_text(plan%hx, 5)//', hY = '//to_text(plan%hy, 5)//' ('//plan%grid_reason//')'
         end if
         write (unit, '(a)') 'Deformation  '//trim(merge('FFT ', 'MLMI', plan%deformation == 'fft'))//' on the finest grid ('// &
            trim(merge('the faster one', 'asked for     ', case%deformation == 'auto'))//'), method '//trim(case%method)
         write (unit, '(a)') 'Resolution   hX over the inlet length = '//to_text(plan%resolution%inlet, 3)//resolution_text(plan)
         write (unit, '(a)') '             gap at x_min over film = '//to_text(plan%resolution%inlet_gap, 3)// &
            merge(' (flooded)                                              ', &
                  ' (below 8 the boundary makes the film somewhat thinner) ', plan%resolution%inlet_gap >= flooded_inlet_gap)
         if (plan%resolution%is_resolved) then
            write (unit, '(a)') '             resolved'
         else
            write (unit, '(a)') '             NOT RESOLVED: '//plan%resolution%reason//'the result will be flagged'
         end if
         if (c%is_line()) then
            write (unit, '(a)') 'Expected     no model of error and cost for line contacts: see the errors that the result states'
         else
            write (unit, '(a)') 'Expected     relative error of '//trim(merge('Ad/Ai ', 'H(0,0)', plan%waviness%is_present .and. &
               .not. allocated(plan%waviness%surface)))// &
               ' about '//to_text(plan%expected_error, 2)//' and '//to_text(expected_seconds(plan), 2)//' s, '// &
               to_text(plan%expected_work_units, 2)//' work units (models; usually right within a factor 2)'
         end if
         if (case%accuracy > 0 .and. plan%expected_error > case%accuracy) write (unit, '(a)') &
            '             ACCURACY '//to_text(case%accuracy, 3)//' NOT TO BE REACHED with largest_cells = '// &
            to_text(case%largest_cells)//': expect '//to_text(plan%expected_error, 2)
      end associate
   end subroutine print_plan

   !> Run time to expect here and now, from the model of the work and a work unit measured on the spot.
   real(dp) function expected_seconds(plan)
      type(case_plan_t), intent(in) :: plan
      expected_seconds = plan%expected_work_units*work_unit_seconds(plan%cells_x, plan%cells_y)
   end function expected_seconds

   function width_text(case, plan) result(text)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      text = ''
      if (plan%conditions%is_line()) return
      text = ', '//merge('0 <= Y <= ', '|Y| <=    ', plan%is_half)//to_text(case%y_max, 4)// &
             merge(' (half: the case is even in Y)', ' (whole)                      ', plan%is_half)
   end function width_text

   function waviness_text(case) result(text)
      type(case_t), intent(in) :: case
      character(len=:), allocatable :: text
      text = 'none (smooth surfaces)'
      if (case%orientation == 'none') return
      text = trim(case%orientation)
      if (case%wavelength_x_over_a > 0) text = text//', lambda_x/a = '//to_text(case%wavelength_x_over_a, 6)
      if (case%wavelength_y_over_a > 0) text = text//', lambda_y/a = '//to_text(case%wavelength_y_over_a, 6)
      if (case%oblique) text = text//', oblique'
      text = text//', Ai = '//to_text(case%amplitude_over_film, 4)//' of the smooth central film'
   end function waviness_text

   function run_text(case, plan) result(text)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      select case (plan%kind)
      case (run_smooth)
         text = 'steady state of smooth surfaces'
      case (run_harmonic)
         text = 'steady state of smooth surfaces, then its linear response to small waves (no time stepping)'
      case (run_standing)
         text = 'steady state of smooth surfaces, then '//to_text(plan%phases)// &
                ' steady states of the pattern (it stands still: no time stepping)'
      case default
         text = 'steady state of smooth surfaces, then '//to_text(plan%steps)//' time steps of dT = '//to_text(plan%dt, 5)
         if (allocated(plan%waviness%surface)) then
            text = text//', surface at the contact centre from step '//to_text(plan%first_sample)
         else if (plan%waviness%moves() .and. plan%measures) then
            text = text//', amplitude measured from step '//to_text(plan%first_sample)
         else if (plan%waviness%moves()) then
            text = text//', too few to measure the amplitude'
         end if
         if (case%load_balance == 'equation_of_motion') then
            text = text//', equation of motion with Omega = '//to_text(case%natural_frequency, 5)
         else
            text = text//', force balance'
         end if
      end select
      if (plan%responds .and. plan%kind /= run_harmonic) text = text//'; and the linear response to small waves'
   end function run_text

   function solver_text(case) result(text)
      type(case_t), intent(in) :: case
      character(len=:), allocatable :: text
      select case (case%method)
      case ('fas'); text = 'FAS multigrid, '//trim(case%cycle)//' cycles'
      case ('petsc'); text = 'PETSc on the finest grid'
      case default; text = 'Newton''s method'
      end select
      text = text//', deformation by '//trim(case%deformation)
   end function solver_text

   function resolution_text(plan) result(text)
      type(case_plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      text = ''
      if (plan%resolution%points_x > 0) text = text//', points per wave along X '//to_text(plan%resolution%points_x, 4)
      if (plan%resolution%points_y > 0) text = text//', along Y '//to_text(plan%resolution%points_y, 4)
      if (plan%resolution%samples > 0) text = text//', time steps per wave '//to_text(plan%resolution%samples, 4)
   end function resolution_text

   !> The result, to a unit.
   subroutine print_result(unit, case, plan, result)
      integer, intent(in) :: unit
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result

      write (unit, '(a)') 'Status       '//status_name(result%status)
      if (len(result%message) > 0) write (unit, '(a)') '             '//result%message
      if (result%rung /= 'direct') write (unit, '(a)') 'Rescue       '//trim(result%rung)//', '// &
         to_text(result%rescued_solutions)//' solutions rescued'
      if (ieee_is_finite(result%central_film)) call print_smooth_film()
      if (allocated(plan%waviness%surface) .and. is_success(result%status)) then
         if (plan%first_sample < result%time_steps) write (unit, '(a)') 'Rough film   h(0,0) while the surface passes: mean '// &
            to_text(result%mean_film*plan%conditions%c_m*1e6_dp, 5)//', lowest '// &
            to_text(minval(result%film_history(plan%first_sample + 1:))*plan%conditions%c_m*1e6_dp, 5)//', highest '// &
            to_text(maxval(result%film_history(plan%first_sample + 1:))*plan%conditions%c_m*1e6_dp, 5)//' um'
      else if (plan%waviness%is_present .and. is_success(result%status)) then
         if (ieee_is_finite(result%amplitude_ratio)) write (unit, '(a)') 'Amplitude    Ad/Ai = '// &
            to_text(result%amplitude_ratio, 5)//' (samples), '// &
            to_text(result%amplitude_ratio_fit, 5)//' (harmonic fit); formula '//to_text(result%formula_ratio, 5)
         if (plan%responds) call print_response()
         write (unit, '(a)') '             f(r) V = '//to_text(result%f_r*result%v, 5)//', f(r) V2 = '// &
            to_text(result%f_r*result%v2, 5)//', f(r) = '//to_text(result%f_r, 5)
      end if
      if (ieee_is_finite(result%central_film_error)) write (unit, '(a)') 'Estimated    relative errors of the grid: H(0,0) '// &
         to_text(result%central_film_error, 2)//', smallest H '//to_text(result%minimum_film_error, 2)//amplitude_error()
      write (unit, '(a)') 'Errors       mass residual '//to_text(result%residual, 3)//', load error '// &
         to_text(result%load_error, 3)
      write (unit, '(a)') 'Effort       '//to_text(result%seconds, 4)//' s, '//to_text(result%work_units, 4)//' work units, '// &
         to_text(result%time_steps)//' time steps, '//iterations()//' on the finest grid, '// &
         to_text(result%peak_memory_mib, 4)//' MiB'

   contains

      function iterations() result(text)
         character(len=:), allocatable :: text
         if (case%method == 'fas') then
            text = to_text(result%nonlinear_steps)//' cycles and '//to_text(result%linear_steps)//' sweeps'
         else
            text = to_text(result%nonlinear_steps)//' Newton and '//to_text(result%linear_steps)//' GMRES steps'
         end if
      end function iterations

      function amplitude_error() result(text)
         character(len=:), allocatable :: text
         text = ''
         if (ieee_is_finite(result%amplitude_ratio_error)) text = ', Ad/Ai '//to_text(result%amplitude_ratio_error, 2)// &
            trim(merge(' (from coarser grids)', ' (from a model)      ', result%amplitude_error_basis == basis_coarse_grid))
      end function amplitude_error

      subroutine print_response()
         associate (r => result%harmonic)
            write (unit, '(a)') 'Response     Ad/Ai = '//to_text(r%ratio, 5)//' (small waves, no change of the mean film), '// &
               'phase '//to_text(r%phase, 4)//' rad; formula '//to_text(result%formula_ratio, 5)
            if (ieee_is_finite(r%extrapolated)) write (unit, '(a)') '             extrapolated to mesh size 0: '// &
               to_text(r%extrapolated, 5)//', estimated discretisation error '//to_text(100*r%error, 2)//' %'
            write (unit, '(a)') '             '//to_text(r%linear_steps)//' GMRES steps, '//to_text(r%work_units, 4)// &
               ' work units'
         end associate
      end subroutine print_response

      subroutine print_smooth_film()
         write (unit, '(a)') 'Smooth film  H(0,0) = '//to_text(result%central_film, 6)//', smallest H = '// &
            to_text(result%minimum_film, 6)//', Moes H(0,0) = '//to_text(result%central_film_moes, 6)// &
            ', largest P = '//to_text(result%max_pressure, 6)
         if (plan%conditions%has_dimensions) write (unit, '(a)') '             h(0,0) = '// &
            to_text(result%central_film*plan%conditions%c_m*1e6_dp, 5)//' um, smallest h = '// &
            to_text(result%minimum_film*plan%conditions%c_m*1e6_dp, 5)//' um'
      end subroutine print_smooth_film

   end subroutine print_result

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
      call json%add('expected_seconds', expected_seconds(plan))
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

end module ehlwave_case_report
