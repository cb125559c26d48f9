!> Plan of a case as text for people.
module ehlwave_plan_report
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_lubricant, only: extrapolation_text
   use ehlwave_error_account, only: errors_text
   use ehlwave_grid_choice, only: smallest_size
   use ehlwave_grid, only: grid_t
   use ehlwave_hierarchy, only: level_count
   use ehlwave_kinds, only: dp
   use ehlwave_linear_range, only: is_beyond_linear, linear_limit_text
   use ehlwave_memory_plan, only: memory_shortage
   use ehlwave_planned_case, only: case_plan_t, run_harmonic, run_smooth, run_standing
   use ehlwave_resolution, only: flooded_inlet_gap
   use ehlwave_roughness, only: roughness_t
   use ehlwave_scheme_choice, only: averaged_cells
   use ehlwave_shared_steady, only: grid_of
   use ehlwave_surface_plan, only: surface_text
   use ehlwave_text, only: to_text
   use ehlwave_threads, only: thread_count
   use ehlwave_work_unit, only: work_unit_operations
   implicit none (type, external)
   private
   public :: print_plan

   !> Cells of the coarsest grid above which solves are slow. Measured (M = 100, D = 1): 258 x 258 cells, which half
   !> a domain cannot halve, take 445 work units, 256 x 256 take 50.
   integer, parameter :: many_coarsest = 100

contains

   !> The plan, to a unit.
   subroutine print_plan(unit, case, plan)
      integer, intent(in) :: unit
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan

      character(len=:), allocatable :: shortage
      type(roughness_t) :: both(2)
      integer :: coarsest

      associate (c => plan%conditions)
         write (unit, '(a)') 'Conditions   M = '//to_text(c%m, 6)//', L = '//to_text(c%l, 6)//', D = '// &
            to_text(c%d, 6)//', S = '//to_text(c%slip_parameter, 6)
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
         if (.not. c%l > 0) write (unit, '(a)') '             L = 0: viscosity and density are constant, whatever '// &
            'their laws'
         if (extrapolation_text(case, plan%rheology, 1.0_dp) /= '') write (unit, '(a)') '             WARNING: '// &
            extrapolation_text(case, plan%rheology, 1.0_dp)
         call plan%effects%print(unit, case, plan%bare_plan_t)
         both = case%surfaces()
         write (unit, '(a)') 'Waviness     '//surface_text(both(1), plan%surfaces%list(1), c)
         if (case%is_pair()) write (unit, '(a)') '  surface 2  '//surface_text(both(2), plan%surfaces%list(2), c)// &
            ', speed 2 - S = '//to_text(2 - c%slip_parameter, 6)
         if (is_beyond_linear(case)) &
            write (unit, '(a)') '             WARNING: such waves may respond unlike small waves: take Ai '// &
            '(amplitude_over_film) below '//linear_limit_text(case)//', or compare by response = ''both'''
         write (unit, '(a)') 'Run          '//run_text(case, plan)
         write (unit, '(a)') 'Solver       '//solver_text(case)
         if (allocated(case%idle)) write (unit, '(a)') 'No effect    '//case%idle
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
            coarsest = coarsest_cells(case, plan)
            if (coarsest > many_coarsest) write (unit, '(a)') '             WARNING: these numbers can hardly be '// &
               'halved ('//to_text(coarsest)//' cells on the coarsest grid): several times the work of '// &
               to_text(smallest_size(real(plan%cells_x, dp), huge(1)))//' x '// &
               to_text(smallest_size(real(plan%cells_y, dp), huge(1)))
         end if
         write (unit, '(a)') 'Deformation  '//trim(merge('FFT ', 'MLMI', plan%deformation == 'fft'))// &
            ' on the finest grid ('// &
            trim(merge('the faster one', 'asked for     ', case%deformation == 'auto'))//'), method '// &
            trim(case%method)//scheme_text(case, plan)
         write (unit, '(a)') 'Resolution   hX over the inlet length = '//to_text(plan%resolution%inlet, 3)// &
            resolution_text(plan)
         write (unit, '(a)') '             gap at x_min over film = '//to_text(plan%resolution%inlet_gap, 3)// &
            trim(merge(' (flooded)                                             ', &
                       ' (below 8 the boundary makes the film somewhat thinner)', &
                       plan%resolution%inlet_gap >= flooded_inlet_gap))
         if (plan%resolution%is_resolved) then
            write (unit, '(a)') '             resolved'
         else
            write (unit, '(a)') '             NOT RESOLVED: '//plan%resolution%reason//'; the result will be flagged'
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

   !> The fitted scheme, if used, and its savings.
   function scheme_text(case, plan) result(text)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      text = ''
      if (.not. plan%is_fitted) return
      text = ', fitted scheme'
      if (case%accuracy > 0) text = text//' (the averaged one would take '// &
         to_text(nint(averaged_cells(case, plan%conditions)))//' cells along X)'
   end function scheme_text

   !> Where a case ends that does not converge.
   function cap_text(plan) result(text)
      type(case_plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      if (plan%has_work_cap()) then
         text = 'at most '//to_text(plan%largest_work_in_all/work_unit_operations(plan%cells_x, plan%cells_y), 2)// &
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
      if (thread_count() > 1) text = text//', '//to_text(thread_count())//' threads'
   end function solver_text

   function resolution_text(plan) result(text)
      type(case_plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      text = ''
      if (plan%resolution%points_x > 0) text = text//', points per wave along X '//to_text(plan%resolution%points_x, 4)
      if (plan%resolution%points_y > 0) text = text//', along Y '//to_text(plan%resolution%points_y, 4)
      if (plan%resolution%samples > 0) text = text//', time steps per wave '//to_text(plan%resolution%samples, 4)
   end function resolution_text

   !> Cells of the coarsest grid of an elliptical contact along its longer side; factors of lines are exact.
   pure integer function coarsest_cells(case, plan) result(most)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(grid_t) :: grid
      grid = grid_of(case, plan)
      most = max(grid%nx, grid%ny*merge(2, 1, grid%is_half))/2**(level_count(grid) - 1)
   end function coarsest_cells

end module ehlwave_plan_report
