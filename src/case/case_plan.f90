!> The plan of one case, made before it runs: what is computed, on which grid, in how many steps, and why.
module ehlwave_case_plan
   use ehlwave_accuracy_model, only: expected_film_error, expected_long_step_error, expected_ratio_error, &
      expected_step_error, steady_work_units, step_work_units
   use ehlwave_case_completion, only: case_conditions
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_files, only: case_file_t, case_files, note_digest
   use ehlwave_case_lubricant, only: case_lubricant
   use ehlwave_conditions, only: conditions_t
   use ehlwave_domain_choice, only: chosen_scale, expected_domain_errors, scale_domain
   use ehlwave_error_parts, only: error_parts_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_grid_choice, only: choose_grid, formula_ratio
   use ehlwave_kinds, only: dp
   use ehlwave_linear_range, only: expected_nonlinearity
   use ehlwave_resolution, only: judge_resolution, resolution_t
   use ehlwave_rheology, only: rheology_t
   use ehlwave_surface_plan, only: plan_surfaces, surface_times
   use ehlwave_surfaces, only: surfaces_t
   use ehlwave_text, only: to_text
   use ehlwave_thinning, only: new_thinning, thinning_t
   use ehlwave_work_unit, only: expected_unit_seconds, work_unit_operations
   implicit none (type, external)
   private
   public :: make_plan

   integer, parameter, public :: run_smooth = 1      !! steady state of smooth surfaces only
   integer, parameter, public :: run_standing = 2    !! steady states of a pattern that stands still
   integer, parameter, public :: run_march = 3       !! march in time
   integer, parameter, public :: run_harmonic = 4    !! linear response only

   type, public :: case_plan_t
      type(conditions_t) :: conditions
      type(rheology_t) :: rheology
      type(thinning_t) :: thinning                   !! of the oil
      type(surfaces_t) :: surfaces
      type(case_file_t), allocatable :: files(:)     !! that cases may read; with digests where this one does
      integer :: kind = run_smooth
      logical :: responds = .false.                  !! the linear response is computed
      integer :: field_sets = 0                      !! fields over time that are kept
      logical :: is_periodic = .false.               !! the periodic state is sought first; the march is what else there
                                                     !! is
      logical :: is_half = .true.                    !! only Y >= 0 is computed
      real(dp) :: x_min = 0, x_max = 0, y_max = 0    !! domain; the pattern starts at the x_min of the case whatever it
                                                     !! is
      real(dp) :: domain_scale = 1                   !! over the domain of the case
      real(dp) :: domain_error = 0                   !! relative, expected by the edges, of what expected_error is of,
      real(dp) :: film_domain_error = 0              !! and of H(0,0)
      integer :: cells_x = 0, cells_y = 0            !! of the whole domain; cells_y = 1 of a line contact
      character(len=:), allocatable :: grid_reason
      real(dp) :: hx = 0, hy = 0                     !! hy = 0 of a line contact
      character(len=4) :: deformation = ''           !! 'fft' or 'mlmi'
      integer :: cells_per_step = 1, steps_per_cell = 1
      real(dp) :: dt = 0                             !! time step, 0 without march
      integer :: steps = 0                           !! time steps
      integer :: first_sample = 0                    !! step from which the amplitude is measured,
      logical :: measures = .true.                   !! if the march is long enough for that
      integer :: largest_total_steps = 0             !! cap on the nonlinear steps of the finest grid,
      real(dp) :: largest_work = huge(1.0_dp)        !! and on operations where the case gives none, see `cap_work`
      integer :: phases = 0                          !! steady solutions of a standing pattern
      type(resolution_t) :: resolution
      type(error_parts_t) :: expected                !! relative errors of Ad/Ai, of smooth contacts of H(0,0); from
                                                     !! models
      real(dp) :: expected_error = 0                 !! of mesh, time and tolerances among them
      real(dp) :: expected_work_units = 0            !! counted, without error estimates
      real(dp) :: work_with_estimates = 0            !! the same with them: what takes time
      real(dp) :: cost = 0                           !! expected effort, node updates of the finest grid
   contains
      procedure :: expected_film_mesh_error
      procedure :: model_margin
      procedure :: model_ratio_error
      procedure :: least_ratio_error
      procedure :: expected_work
      procedure :: expected_seconds
      procedure :: has_work_cap
      procedure :: expected_memory_mib
   end type case_plan_t

   integer, parameter :: most_steps = 1000000
   integer, parameter :: steps_per_time_step = 40    !! nonlinear steps that a time step may take on average
   !> Work of a case over that of its plan, where it has no cap of its own; it ends at a share of that, since the step
   !> at which it does is finished.
   real(dp), parameter, public :: most_work = 10
   real(dp), parameter :: share_of_most = 0.8_dp
   real(dp), parameter :: share_of_steps = 0.2_dp    !! of the accuracy, for steps longer than hX
   real(dp), parameter :: fewest_long_steps = 32     !! time steps per wave that steps longer than hX must leave
   real(dp), parameter :: cost_of_estimate = 1.15_dp !! of a case with its coarser grids over that without
   real(dp), parameter :: response_work_units = 50   !! of a linear response on half a domain and the change of the
                                                     !! mean; measured: 35 to 80
   real(dp), parameter :: line_response_work_units = 250   !! the same of a line contact
   real(dp), parameter :: load_step_cost = 4         !! time steps after a load step over others; measured at M = 300, L
                                                     !! = 30, D = 1: 9
   real(dp), parameter :: petsc_cost = 2             !! of a solution by PETSc, of one by Newton's method; measured: 0.9
                                                     !! to 2.2
   real(dp), parameter :: periodic_share = 0.4_dp    !! of a march that starts in the waves, of one from rest; measured:
                                                     !! 0.2 to 0.6
   real(dp), parameter :: outlet_end = 1             !! X of the outlet end of the Hertzian contact

contains

   !> Plan of a completed case. Fails when the case asks for something that cannot be run. A coarser or finer plan of a
   !> case that has one takes its domain from that.
   subroutine make_plan(case, plan, error, domain_scale)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(out) :: plan
      type(error_t), allocatable, intent(inout) :: error
      real(dp), intent(in), optional :: domain_scale   !! of the domain over that of the keys; absent: chosen
      type(case_t) :: copy
      real(dp) :: errors(2), thickening

      copy = case
      call case_conditions(copy, plan%conditions, error)
      if (allocated(error)) return
      plan%rheology = case_lubricant(copy, plan%conditions)
      plan%files = case_files(case)
      associate (measured => copy%oil%measured)
         if (allocated(measured%path)) call note_digest(plan%files, measured%path, measured%digest())
      end associate
      thickening = plan%rheology%thickening()
      copy = case
      if (present(domain_scale)) then
         plan%domain_scale = domain_scale
      else
         plan%domain_scale = chosen_scale(case, plan%conditions, thickening)
      end if
      call scale_domain(copy, plan%domain_scale)
      plan%x_min = copy%x_min
      plan%x_max = copy%x_max
      plan%y_max = copy%y_max
      errors = expected_domain_errors(case, plan%conditions, thickening, plan%domain_scale)
      plan%film_domain_error = errors(1)
      plan%domain_error = errors(2)
      if (case%edges == 'flooded') copy%accuracy = case%accuracy - min(0.5_dp*case%accuracy, plan%domain_error)
      plan%thinning = new_thinning(plan%rheology, plan%conditions, case%oil%flow_exponent())
      call plan_surfaces(case, plan%conditions, plan%surfaces, plan%files, error)
      if (allocated(error)) return
      plan%is_half = (case%domain == 'auto' .or. plan%conditions%is_line()) .and. plan%surfaces%is_symmetric()
      call choose_grid(copy, plan%conditions, plan%surfaces, plan%thinning%steepness, plan%cells_x, plan%cells_y, &
                       plan%grid_reason)
      plan%hx = (plan%x_max - plan%x_min)/plan%cells_x
      if (.not. plan%conditions%is_line()) plan%hy = 2*plan%y_max/plan%cells_y
      plan%deformation = merge('mlmi', 'fft ', case%deformation == 'mlmi')   ! 'auto': the FFT, measured

      plan%is_periodic = plan%surfaces%moves() .and. case%response == 'periodic'
      plan%responds = plan%surfaces%is_rough() .and. (case%response == 'harmonic' .or. case%response == 'both')
      if (plan%responds .and. case%response == 'harmonic') then
         plan%kind = run_harmonic
         if (case%time_step_over_cell > 0) plan%steps_per_cell = nint(1/min(1.0_dp, case%time_step_over_cell))
      else if (plan%surfaces%moves() .or. case%end_time > 0) then
         call plan_march(case, plan, error)
      else if (plan%surfaces%is_rough()) then
         plan%kind = run_standing
         plan%phases = merge(8, 2, any(plan%surfaces%list%wavelength_x > 0))
      end if
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
         plan%dt)
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

   !> dT/hX for the accuracy asked for: 2 for waves of at least 64 mesh sizes, where it adds little error (measured:
   !> lambda = 2 a on 128 cells, 33 to 62 per cent of the GMRES steps of dT = hX), else 1: for shorter waves
   !> longer steps save nothing. The linear response is that of steps of at most one cell.
   pure integer function chosen_step(case, plan)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      real(dp) :: steps   ! per wave with dT = 2 hX

      chosen_step = 1
      if (.not. plan%surfaces%moves() .or. plan%responds .or. plan%is_periodic .or. &
         case%load_balance /= 'force_balance') return
      steps = plan%surfaces%period()/(2*plan%hx)
      if (steps < fewest_long_steps) return
      if (expected_long_step_error(2, steps) <= share_of_steps*case%accuracy) chosen_step = 2
   end function chosen_step

   !> Error and cost to expect of a plan that is complete but for them. Whole domains cost twice as much as half ones.
   subroutine expect(case, plan)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(inout) :: plan
      real(dp) :: samples, step_tolerance, steps_cost
      logical :: is_newtonian

      is_newtonian = plan%rheology%is_newtonian()
      steps_cost = 1
      samples = plan%resolution%samples
      step_tolerance = case%step_tolerance
      if (plan%kind == run_harmonic) then     ! has the frequency of steps dT = hX, and no tolerance of its own
         if (plan%surfaces%moves()) samples = plan%surfaces%period()/plan%hx
         step_tolerance = 0
      end if
      plan%expected%domain = plan%domain_error
      plan%expected%mesh = plan%expected_film_mesh_error()
      if (plan%surfaces%is_rough() .and. .not. plan%surfaces%is_measured()) then
         plan%expected%mesh = expected_ratio_error(plan%conditions, &
                                                   formula_ratio(case, plan%conditions, plan%surfaces%moves()), &
                                                   plan%hx, &
                                                   plan%resolution%points_y, 1, samples, 0.0_dp)*plan%thinning%steepness
         if (samples > 0) plan%expected%time = expected_long_step_error(plan%cells_per_step, samples)
         if (samples > 0) plan%expected%algebraic = expected_step_error(step_tolerance)
         if (plan%kind == run_march .or. plan%kind == run_standing) plan%expected%amplitude = &
            expected_nonlinearity(case)
      end if
      plan%expected_error = plan%expected%mesh + plan%expected%time + plan%expected%algebraic
      associate (steady => steady_work_units(plan%conditions, plan%cells_x, is_newtonian, plan%thinning%cost), &
                 step => step_work_units(plan%conditions, plan%cells_x, is_newtonian, plan%thinning%cost))
         if (abs(case%load_factor - 1) > 0) steps_cost = load_step_cost
         if (case%method == 'petsc') steps_cost = petsc_cost*steps_cost
         plan%expected_work_units = (1 + 0.5_dp*plan%phases)*steady*merge(petsc_cost, 1.0_dp, case%method == 'petsc') &
                                    + merge(periodic_share, 1.0_dp, plan%is_periodic)*plan%steps*step*steps_cost
      end associate
      if (plan%responds) plan%expected_work_units = plan%expected_work_units &
         + merge(line_response_work_units, response_work_units, plan%conditions%is_line())
      if (.not. (plan%is_half .or. plan%conditions%is_line())) plan%expected_work_units = 2*plan%expected_work_units
      plan%work_with_estimates = plan%expected_work_units
      if (plan%surfaces%is_rough() .and. plan%kind /= run_harmonic .and. case%error_estimate == 'coarse_grid') &
         plan%work_with_estimates = cost_of_estimate*plan%expected_work_units
   end subroutine expect

   !> A case takes at most ten times the work that its plan expects, rescues, error estimates and runs on finer grids
   !> included, unless it has a cap of its own, `largest_total_steps`.
   subroutine cap_work(case, plan)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(inout) :: plan
      plan%largest_work = huge(1.0_dp)
      if (case%largest_total_steps == 0) plan%largest_work = share_of_most*most_work*plan%expected_work()
   end subroutine cap_work

   !> Whether it is the plan that says how much a case may take.
   pure logical function has_work_cap(self)
      class(case_plan_t), intent(in) :: self
      has_work_cap = self%largest_work < huge(1.0_dp)
   end function has_work_cap

   !> Relative error of H(0,0) of the smooth contact to expect by the mesh.
   pure real(dp) function expected_film_mesh_error(self)
      class(case_plan_t), intent(in) :: self
      expected_film_mesh_error = self%thinning%steepness*expected_film_error(self%conditions, self%hx)
   end function expected_film_mesh_error

   !> The factor of errors that the plan expects, where they stand in for an estimate: models are right within a factor
   !> of 2 or 3, and were fitted to grids with hY up to 2 hX and to contacts whose pressure spike is below the Hertz
   !> pressure. The spike of a light contact is above: at 1.6 times the film was 3.3 times as far off as twice the
   !> model.
   pure real(dp) function model_margin(self, max_pressure)
      class(case_plan_t), intent(in) :: self
      real(dp), intent(in) :: max_pressure   !! of the smooth contact, over the Hertz pressure
      real(dp), parameter :: usual_margin = 2, usual_ratio = 2
      model_margin = usual_margin*max(1.0_dp, (self%hy/(usual_ratio*self%hx))**2)*max(1.0_dp, max_pressure)**2
   end function model_margin

   !> Relative error of Ad/Ai by the mesh, where no coarser grid tells it. Under slip two waves add up whose phases the
   !> mesh shifts, which the model has not: measured 2 to 10 over the square of the points per wave for S = 0.3 to 0.76
   !> and 1.37 where the formula gives Ad/Ai above 0.8, at most 1 in pure rolling.
   pure real(dp) function model_ratio_error(self, max_pressure)
      class(case_plan_t), intent(in) :: self
      real(dp), intent(in) :: max_pressure   !! see `model_margin`
      real(dp), parameter :: slip_factor = 6, largest_slip = 0.5_dp
      model_ratio_error = self%model_margin(max_pressure)*self%expected%mesh
      if (self%surfaces%moves() .and. self%resolution%points_x > 0) model_ratio_error = model_ratio_error &
         + slip_factor*min(1.0_dp, abs(self%conditions%slip_parameter - 1)/largest_slip)/self%resolution%points_x**2
   end function model_ratio_error

   !> The least relative error of Ad/Ai, or of a response, by the mesh that two grids can show. Their values can agree
   !> by chance, which tells nothing of either. Of 17 random cases the expected error was 0.65 to 3 times the error, an
   !> estimate from grids 0.02 to 3 times. Where the film is further off than the model says, so is Ad/Ai: both errors
   !> come from the inlet (films of line contacts are 1.2 to 1.5 times as far off as the model of elliptical ones says).
   pure real(dp) function least_ratio_error(self, film_error)
      class(case_plan_t), intent(in) :: self
      real(dp), intent(in) :: film_error      !! relative, of the smooth H(0,0) of the case, by its mesh
      real(dp), parameter :: least_share = 0.8_dp
      least_ratio_error = least_share*self%expected%mesh*max(1.0_dp, film_error/self%expected_film_mesh_error())
   end function least_ratio_error

   !> Operations to expect, error estimates included.
   elemental real(dp) function expected_work(self)
      class(case_plan_t), intent(in) :: self
      expected_work = self%work_with_estimates*work_unit_operations(self%cells_x, self%cells_y)
   end function expected_work

   !> Run time to expect here and now, from the model of the work and a work unit timed on the spot.
   real(dp) function expected_seconds(self)
      class(case_plan_t), intent(in) :: self
      expected_seconds = self%work_with_estimates*expected_unit_seconds(self%cells_x, self%cells_y)
   end function expected_seconds

   !> Peak memory of the process to expect, in MiB, without what MPI takes: a constant and so much for each cell that is
   !> computed, more on finer grids, whose GMRES keeps more vectors. Measured within an eighth: 64 to 2048 cells along
   !> each side, M = 100 and, up to 1024, 1000; smooth, transverse waves of 0.5 a by their response, and marches.
   pure real(dp) function expected_memory_mib(self)
      class(case_plan_t), intent(in) :: self
      real(dp), parameter :: program_mib = 17, bytes_smooth = 720, bytes_wavy = 900, bytes_response = 1830, &
         bytes_line = 2600, bytes_periodic = 1900, bytes_set = 48   ! three fields, and their file
      real(dp), parameter :: usual_cells = 256*128, smooth_growth = 0.18_dp, response_growth = 0.06_dp
      real(dp) :: bytes, cells, halvings   ! of the mesh of `usual_cells`
      cells = real(self%cells_x, dp)*self%cells_y
      if (self%is_half) cells = cells/2
      halvings = 0.5_dp*log(max(1.0_dp, cells/usual_cells))/log(2.0_dp)
      bytes = bytes_smooth*(1 + smooth_growth*halvings)
      if (self%kind /= run_smooth) bytes = max(bytes, bytes_wavy)
      if (self%is_periodic) bytes = bytes_periodic
      if (self%responds) bytes = max(bytes, bytes_response)
      if (self%is_periodic .or. self%responds) bytes = bytes*(1 + response_growth*halvings**2)
      if (self%conditions%is_line()) then
         bytes = bytes_line
         cells = self%cells_x
      end if
      expected_memory_mib = program_mib + (bytes + bytes_set*self%field_sets)*cells/2.0_dp**20
   end function expected_memory_mib

   !> Refuse keys that contradict the accuracy asked for. A grid that only `largest_cells` limits is no contradiction:
   !> the plan says what it can reach.
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

   !> Steps until the slower of the surface pattern (speed S) and of the pattern in the lubricant (speed 1) has
   !> passed the outlet end, `settling_periods` more (measured: long waves, lambda = 2 a, are 2 per cent off in the
   !> first period and below 0.1 per cent in the second), then one period. A measured surface is followed until its
   !> trailing end is at the contact centre. An `end_time` overrides both; where it comes before the patterns have
   !> passed and one period more, no amplitude is measured.
   subroutine plan_march(case, plan, error)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(inout) :: plan
      type(error_t), allocatable, intent(inout) :: error
      real(dp) :: passed, settled, total

      plan%kind = run_march
      if (case%time_step_over_cell <= 0) then
         plan%cells_per_step = chosen_step(case, plan)
      else if (case%time_step_over_cell >= 1) then
         plan%cells_per_step = nint(case%time_step_over_cell)
      else
         plan%steps_per_cell = nint(1/case%time_step_over_cell)
      end if
      plan%dt = plan%hx*plan%cells_per_step/plan%steps_per_cell
      if (plan%surfaces%is_measured()) then
         call surface_times(plan%surfaces, settled, total)
         if (case%end_time > 0) total = case%end_time
         settled = min(settled, total)
      else if (plan%surfaces%moves()) then
         passed = plan%surfaces%passing_time(outlet_end)
         settled = passed + case%settling_periods*plan%surfaces%period()
         total = settled + plan%surfaces%period()
         if (case%end_time > 0) then
            total = case%end_time
            plan%measures = total - plan%surfaces%period() > passed - 0.5_dp*plan%dt
            settled = max(0.0_dp, total - plan%surfaces%period())
         end if
      else
         settled = case%end_time
         total = case%end_time
      end if
      if (total/plan%dt > most_steps) then
         call raise(error, 'the case needs '//to_text(total/plan%dt, 3)//' time steps, more than '// &
                    to_text(most_steps)//': with slip_parameter near 0 the pattern hardly moves; use 0 for a '// &
                    'pattern that stands still, or set &dynamics end_time')
         return
      end if
      plan%steps = ceiling(total/plan%dt - 1e-9_dp)
      plan%first_sample = ceiling(settled/plan%dt - 1e-9_dp)
   end subroutine plan_march

end module ehlwave_case_plan
