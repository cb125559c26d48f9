!> Plan and result of a case as text for people.
module ehlwave_case_report
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_lubricant, only: extrapolation_text
   use ehlwave_case_plan, only: case_plan_t, run_harmonic, run_march, run_smooth, run_standing
   use ehlwave_case_result, only: case_result_t
   use ehlwave_error_account, only: errors_text, validity_text
   use ehlwave_kinds, only: dp
   use ehlwave_linear_range, only: linear_limit
   use ehlwave_memory_plan, only: memory_shortage
   use ehlwave_resolution, only: flooded_inlet_gap
   use ehlwave_status, only: is_solved, status_name
   use ehlwave_surface_plan, only: surface_text
   use ehlwave_text, only: to_text
   use ehlwave_work_unit, only: work_unit_operations
   implicit none (type, external)
   private
   public :: print_plan, print_result

contains

   !> The plan, to a unit.
   subroutine print_plan(unit, case, plan)
      integer, intent(in) :: unit
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan

      character(len=:), allocatable :: shortage

      associate (c => plan%conditions)
         write (unit, '(a)') 'Conditions   M = '//to_text(c%m, 6)//', L = '//to_text(c%l, 6)//', D = '// &
            to_text(c%d, 6)//', S = '//to_text(case%slip_parameter, 6)
         if (c%is_line()) write (unit, '(a)') '             line contact: H in units of a^2/(2 Rx), V = (lambda/a) '// &
            'M^(3/4) L^(-1/2)'
         write (unit, '(a)') '             kappa = '//to_text(c%elliptic%kappa, 6)//', gamma = '// &
            to_text(c%gamma, 6)//', alphabar = '//to_text(c%alphabar, 6)//', lambdabar = '//to_text(c%lambdabar, 6)
         if (c%hertz_pressure_pa > 0) write (unit, '(a)') '             ph = '// &
            to_text(c%hertz_pressure_pa*1e-9_dp, 5)//' GPa'
         if (c%has_dimensions .and. c%is_line()) then
            write (unit, '(a)') '             a = '//to_text(c%a_m*1e3_dp, 5)//' mm, c = '// &
               to_text(c%c_m*1e6_dp, 5)//' um'
         else if (c%has_dimensions) then
            write (unit, '(a)') '             a = '//to_text(c%a_m*1e3_dp, 5)//' mm, b = '// &
               to_text(c%b_m*1e3_dp, 5)//' mm, c = '//to_text(c%c_m*1e6_dp, 5)//' um'
         end if
         write (unit, '(a)') 'Lubricant    '//trim(case%oil%viscosity_law)//', '//trim(case%oil%density_law)//', '// &
            trim(case%oil%flow_law)//', alpha = '//to_text(c%alpha_per_pa*1e9_dp, 5)//' 1/GPa'
         if (extrapolation_text(case, plan%rheology, 1.0_dp) /= '') write (unit, '(a)') '             WARNING: '// &
            extrapolation_text(case, plan%rheology, 1.0_dp)
         if (plan%surfaces%is_measured()) then
            write (unit, '(a)') 'Waviness     '//surface_text(case, plan%surfaces, c)
         else
            write (unit, '(a)') 'Waviness     '//waviness_text(case)
         end if
         if (plan%surfaces%is_rough() .and. case%orientation /= 'none' .and. &
            case%amplitude_over_film > linear_limit(case)) &
            write (unit, '(a)') '             WARNING: such waves may respond unlike small ones: take '// &
            'amplitude_over_film below '//to_text(linear_limit(case), 2)//', or compare by response = ''both'''
         write (unit, '(a)') 'Run          '//run_text(case, plan)
         write (unit, '(a)') 'Solver       '//solver_text(case)
         write (unit, '(a)') 'Domain       '//to_text(plan%x_min, 4)//' <= X <= '//to_text(plan%x_max, 4)// &
            width_text(plan)
         write (unit, '(a)') '             edges '//edges_text(case, plan)
         if (c%is_line()) then
            write (unit, '(a)') 'Grid         '//to_text(plan%cells_x)//' cells, hX = '//to_text(plan%hx, 5)// &
               ' ('//plan%grid_reason//')'
         else
            write (unit, '(a)') 'Grid         '//to_text(plan%cells_x)//' x '//to_text(plan%cells_y)// &
               ' cells on the whole '// &
               'domain, hX = '//to_text(plan%hx, 5)//', hY = '//to_text(plan%hy, 5)//' ('//plan%grid_reason//')'
         end if
         write (unit, '(a)') 'Deformation  '//trim(merge('FFT ', 'MLMI', plan%deformation == 'fft'))// &
            ' on the finest grid ('// &
            trim(merge('the faster one', 'asked for     ', case%deformation == 'auto'))//'), method '//trim(case%method)
         write (unit, '(a)') 'Resolution   hX over the inlet length = '//to_text(plan%resolution%inlet, 3)// &
            resolution_text(plan)
         write (unit, '(a)') '             gap at x_min over film = '//to_text(plan%resolution%inlet_gap, 3)// &
            trim(merge(' (flooded)                                             ', &
                       ' (below 8 the boundary makes the film somewhat thinner)', &
                       plan%resolution%inlet_gap >= flooded_inlet_gap))
         if (plan%resolution%is_resolved) then
            write (unit, '(a)') '             resolved'
         else
            write (unit, '(a)') '             NOT RESOLVED: '//plan%resolution%reason//'the result will be flagged'
         end if
         write (unit, '(a)') 'Expected     '//expected_text(plan)
         write (unit, '(a)') '             about '//to_text(plan%expected_seconds(), 2)//' s, '// &
            to_text(plan%expected_work_units, 2)//' work units (models; usually right within a factor '// &
            to_text(nint(plan%thinning%cost_factor))//'), '// &
            to_text(plan%expected_memory_mib(), 2)//' MiB; '//cap_text(plan)
         if (case%accuracy > 0 .and. plan%expected_error > case%accuracy) write (unit, '(a)') &
            '             ACCURACY '//to_text(case%accuracy, 3)//' NOT TO BE REACHED with largest_cells = '// &
            to_text(case%largest_cells)//': expect '//to_text(plan%expected_error, 2)
         shortage = memory_shortage(plan)
         if (shortage /= '') write (unit, '(a)') '             TOO LITTLE MEMORY: '//shortage
      end associate
   end subroutine print_plan

   !> The error that a plan expects, and its parts.
   function expected_text(plan) result(text)
      type(case_plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      text = 'relative error of '// &
         trim(merge('Ad/Ai ', 'H(0,0)', plan%surfaces%is_rough() .and. .not. plan%surfaces%is_measured()))// &
         ' about '//to_text(plan%expected%total(), 2)//' ('//errors_text(plan%expected)//')'
   end function expected_text

   !> Where a case ends that does not converge.
   function cap_text(plan) result(text)
      type(case_plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      if (plan%has_work_cap()) then
         text = 'at most '//to_text(plan%largest_work/work_unit_operations(plan%cells_x, plan%cells_y), 2)// &
            ' work units'
      else
         text = 'at most '//to_text(plan%largest_total_steps)//' steps (largest_total_steps)'
      end if
   end function cap_text

   function edges_text(case, plan) result(text)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      text = trim(case%edges)//merge(' (P = 0)', '        ', case%edges == 'truncated')
      text = trim(text)//': expect an error of '//to_text(plan%domain_error, 2)//' by the domain'
      if (plan%domain_scale > 1) text = text//', which is enlarged for the accuracy'
   end function edges_text

   function width_text(plan) result(text)
      type(case_plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      text = ''
      if (plan%conditions%is_line()) return
      text = ', '//merge('0 <= Y <= ', '|Y| <=    ', plan%is_half)//to_text(plan%y_max, 4)// &
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
         text = 'steady state of smooth surfaces, then '
         if (plan%is_periodic) text = text//'the periodic state; where it is not found '
         text = text//to_text(plan%steps)//' time steps of dT = '//to_text(plan%dt, 5)
         if (plan%surfaces%is_measured()) then
            text = text//', surface at the contact centre from step '//to_text(plan%first_sample)
         else if (plan%surfaces%moves() .and. plan%measures) then
            text = text//', amplitude measured from step '//to_text(plan%first_sample)
         else if (plan%surfaces%moves()) then
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
      call print_shear()
      if (plan%surfaces%is_measured() .and. is_solved(result%status)) then
         if (plan%first_sample < result%time_steps) write (unit, &
            '(a)') 'Rough film   h(0,0) while the surface passes: mean '// &
            to_text(result%mean_film*plan%conditions%c_m*1e6_dp, 5)//', lowest '// &
            to_text(minval(result%film_history(plan%first_sample + 1:))*plan%conditions%c_m*1e6_dp, 5)//', highest '// &
            to_text(maxval(result%film_history(plan%first_sample + 1:))*plan%conditions%c_m*1e6_dp, 5)//' um'
      else if (plan%surfaces%is_rough() .and. is_solved(result%status)) then
         if (ieee_is_finite(result%amplitude_ratio)) write (unit, '(a)') 'Amplitude    Ad/Ai = '// &
            to_text(result%amplitude_ratio, 5)//' (samples), '// &
            to_text(result%amplitude_ratio_fit, 5)//' (harmonic fit)'//formula()
         if (plan%responds) call print_response()
         write (unit, '(a)') '             f(r) V = '//to_text(result%f_r*result%v, 5)//', f(r) V2 = '// &
            to_text(result%f_r*result%v2, 5)//', f(r) = '//to_text(result%f_r, 5)
      end if
      call print_sensitivities()
      if (ieee_is_finite(result%central_film_error)) write (unit, &
         '(a)') 'Estimated    relative errors of the grid: H(0,0) '// &
         to_text(result%central_film_error, 2)//', smallest H '//to_text(result%minimum_film_error, 2)// &
         friction_error()//trim(merge(' (from a model)', '               ', result%film_error_basis == 'model'))// &
         amplitude_error()
      if (plan%surfaces%is_rough() .and. ieee_is_finite(result%ratio_errors%mesh)) then
         write (unit, '(a)') '             of Ad/Ai in all '//to_text(result%error_estimate, 2)//': '// &
            errors_text(result%ratio_errors)
      else if (ieee_is_finite(result%film_errors%mesh)) then
         write (unit, '(a)') '             of H(0,0) in all '//to_text(result%error_estimate, 2)//': '// &
            errors_text(result%film_errors)
      end if
      write (unit, '(a)') 'Validity     '//validity_text(case, plan, result%warning)
      write (unit, '(a)') 'Errors       mass residual '//to_text(result%residual, 3)//', load error '// &
         to_text(result%load_error, 3)
      write (unit, '(a)') 'Effort       '//to_text(result%seconds, 4)//' s, '// &
         to_text(result%counted_work_units, 4)//' work units, '//to_text(result%time_steps)//' time steps, '// &
         iterations()//' on the finest grid, '//to_text(result%peak_memory_mib, 4)//' MiB'

   contains

      !> Ad/Ai by the formula, which is one for pure rolling.
      function formula() result(text)
         character(len=:), allocatable :: text
         text = ''
         if (.not. abs(case%slip_parameter - 1) > 0) text = '; formula '//to_text(result%formula_ratio, 5)
      end function formula

      function iterations() result(text)
         character(len=:), allocatable :: text
         if (case%method == 'fas') then
            text = to_text(result%nonlinear_steps)//' cycles and '//to_text(result%linear_steps)//' sweeps'
         else
            text = to_text(result%nonlinear_steps)//' Newton and '//to_text(result%linear_steps)//' GMRES steps'
         end if
      end function iterations

      function friction_error() result(text)
         character(len=:), allocatable :: text
         text = ''
         if (ieee_is_finite(result%friction_error)) text = ', friction '//to_text(result%friction_error, 2)
      end function friction_error

      function amplitude_error() result(text)
         character(len=:), allocatable :: text
         text = ''
         if (ieee_is_finite(result%amplitude_ratio_error)) text = ', Ad/Ai '// &
            to_text(result%amplitude_ratio_error, 2)// &
            trim(merge(' (from coarser grids)', ' (from a model)      ', result%amplitude_error_basis == 'coarse_grid'))
      end function amplitude_error

      subroutine print_response()
         associate (r => result%harmonic)
            write (unit, '(a)') 'Response     Ad/Ai = '//to_text(r%ratio, 5)// &
               ' (small waves, no change of the mean film), phase '//to_text(r%phase, 4)//' rad'//formula()
            if (ieee_is_finite(r%extrapolated)) write (unit, '(a)') '             extrapolated to mesh size 0: '// &
               to_text(r%extrapolated, 5)//', estimated discretisation error '//to_text(100*r%error, 2)//' %'
            if (ieee_is_finite(r%waves%centre%fit%misfit)) write (unit, '(a)') '             with the surface: '// &
               to_text(abs(r%waves%centre%fit%attenuated), 4)//' of Ai, with the oil: '// &
               to_text(abs(r%waves%centre%fit%complementary), 4)//', left: '//to_text(r%waves%centre%fit%misfit, 2)
            write (unit, '(a)') '             '//to_text(r%linear_steps)//' GMRES steps, '// &
               to_text(r%counted_work_units, 4)//' work units'
         end associate
      end subroutine print_response

      !> Exponents of the oil's coefficient and stress in laws of H(0,0) and Ad/Ai.
      subroutine print_sensitivities()
         character(len=6), parameter :: by(2) = [character(len=6) :: 'alpha', 'stress']
         character(len=:), allocatable :: response
         integer :: x
         do x = 1, size(by)
            associate (r => result%by_oil(x))
               response = ''
               if (ieee_is_finite(r%response)) response = ', Ad/Ai with '//to_text(r%response, 4)
               if (ieee_is_finite(r%film)) write (unit, '(a)') 'Sensitivity  H(0,0) goes with the power '// &
                  to_text(r%film, 4)//' of '//trim(by(x))//response
            end associate
         end do
      end subroutine print_sensitivities

      subroutine print_shear()
         associate (r => result%shear)
            if (ieee_is_finite(r%friction_coefficient)) write (unit, '(a)') 'Friction     coefficient '// &
               to_text(r%friction_coefficient, 5)//largest_b()
            if (ieee_is_finite(r%inlet_rise_k)) write (unit, '(a)') '             estimated temperature rise: '// &
               'inlet '// &
               to_text(r%inlet_rise_k, 2)//' K, contact '//to_text(r%contact_rise_k, 2)//' K (the model is isothermal)'
         end associate
         if (result%warning /= '') write (unit, '(a)') 'Warning      '//result%warning
      end subroutine print_shear

      function largest_b() result(text)
         character(len=:), allocatable :: text
         associate (r => result%shear)
            text = ' (Newtonian oil)'
            if (ieee_is_finite(r%largest_b)) text = ', B up to '//to_text(r%largest_b, 3)// &
               ', small gradients at the '// &
               'centre drive '//to_text(r%tangent_factor(1), 4)//' (X) and '//to_text(r%tangent_factor(2), 4)// &
               ' (Y) times Newton'
         end associate
      end function largest_b

      subroutine print_smooth_film()
         write (unit, '(a)') 'Smooth film  H(0,0) = '//to_text(result%central_film, 6)//', smallest H = '// &
            to_text(result%minimum_film, 6)//', Moes H(0,0) = '//to_text(result%central_film_moes, 6)// &
            ', largest P = '//to_text(result%max_pressure, 6)
         if (plan%conditions%has_dimensions) write (unit, '(a)') '             h(0,0) = '// &
            to_text(result%central_film*plan%conditions%c_m*1e6_dp, 5)//' um, smallest h = '// &
            to_text(result%minimum_film*plan%conditions%c_m*1e6_dp, 5)//' um'
      end subroutine print_smooth_film

   end subroutine print_result

end module ehlwave_case_report
