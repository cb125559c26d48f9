!> Newton's method of this project against the variational inequality of PETSc: same discrete equations, other solver.
!> Skipped (77) in builds without PETSc.
program test_petsc
   use, intrinsic :: iso_fortran_env, only: output_unit
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_errors, only: error_t
   use ehlwave_formula, only: moes_film_formula
   use ehlwave_kinds, only: dp, pi
   use ehlwave_level_solver, only: solve_limits_t, solve_report_t
   use ehlwave_newton, only: newton_t
   use ehlwave_petsc_library, only: finish_petsc, is_petsc_built, require_petsc
   use ehlwave_petsc_solver, only: petsc_solver_t
   use ehlwave_reynolds, only: flow_t, new_flow
   use ehlwave_state, only: new_state, state_t
   use ehlwave_status, only: status_converged, status_name
   use ehlwave_text, only: to_text
   use ehlwave_transfer, only: interpolate
   use ehlwave_transport, only: characteristic_transport
   use sample_contact, only: make_contact
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: agreement = 1e-6_dp   !! relative, of film and pressure
   type(solve_limits_t), parameter :: limits = solve_limits_t(tolerance=1e-10_dp, largest_steps=60)
   type(test_t) :: test
   type(error_t), allocatable :: error

   if (.not. is_petsc_built) then
      write (output_unit, '(a)') 'skipped: built without PETSc'
      stop 77, quiet=.true.
   end if
   call require_petsc(error)
   call test%check_no_error(error, 'PETSc can be used')
   call compare_contact('M = 100, D = 1', 100.0_dp, 1.0_dp, 64)
   call compare_contact('M = 200, D = 0.35', 200.0_dp, 0.35_dp, 64)
   call compare_contact('M = 1000, D = 0.04', 1000.0_dp, 0.04_dp, 64)
   call compare_contact('M = 1000, D = 1', 1000.0_dp, 1.0_dp, 128)
   call check_repetition()
   call finish_petsc()
   call test%finish()

contains

   !> Smooth contact from a Hertz guess and from the coarser grid, then two steady states with a longitudinal
   !> pattern and one time step of a transverse one.
   subroutine compare_contact(name, m, d, cells)
      character(len=*), intent(in) :: name
      real(dp), intent(in) :: m, d
      integer, intent(in) :: cells
      type(contact_problem_t) :: coarse, problem
      type(state_t) :: on_coarse, guess, smooth, wavy
      real(dp), allocatable :: pattern(:, :)
      real(dp) :: amplitude
      integer :: j

      call make_contact(problem, m, d, cells, cells, is_half=.true.)
      call hertz_guess(problem, guess)
      call compare(name//', from Hertz', problem, guess, smooth)

      call make_contact(coarse, m, d, cells/2, cells/2, is_half=.true.)
      call hertz_guess(coarse, guess)
      call compare(name//', coarser grid', coarse, guess, on_coarse)
      guess = new_state(problem%grid)
      call interpolate(coarse%grid, problem%grid, on_coarse%p, guess%p)
      guess%p = max(guess%p, 0.0_dp)
      guess%delta = on_coarse%delta
      call compare(name//', from the coarser grid', problem, guess, smooth)

      amplitude = 0.2_dp*problem%grid%value_at_centre(smooth%h)
      associate (grid => problem%grid)
         allocate (pattern(0:grid%nx, 0:grid%ny))
         do j = 0, grid%ny
            pattern(:, j) = amplitude*cos(2*pi*grid%y(j))
         end do
         call problem%set_rough(pattern)
         call compare(name//', trough along the centre line', problem, smooth, wavy)
         call problem%set_rough(-pattern)
         call compare(name//', crest along the centre line', problem, smooth, wavy)
         do j = 0, grid%ny
            pattern(:, j) = amplitude*cos(2*pi*grid%x)
         end do
         call problem%set_rough(pattern)
      end associate
      call start_time_step(problem, smooth)
      call compare(name//', time step', problem, smooth, wavy)
   end subroutine compare_contact

   !> Make the problem a time step that follows the state at rest.
   subroutine start_time_step(problem, state)
      type(contact_problem_t), intent(inout) :: problem
      type(state_t), intent(in) :: state
      type(flow_t) :: flow
      real(dp), allocatable :: history(:, :, :)

      flow = new_flow(problem%grid)
      call flow%evaluate(problem%rheology, problem%conditions%lambdabar, state%p, state%h)
      problem%transport = characteristic_transport(problem%grid, 1, 1)
      allocate (history(0:problem%grid%nx, 0:problem%grid%ny, 2))
      history(:, :, 1) = flow%f
      history(:, :, 2) = flow%f
      call problem%transport%carry(problem%grid, history)
   end subroutine start_time_step

   !> Solve with both from the same guess; `theirs` is what PETSc finds.
   subroutine compare(name, problem, guess, theirs)
      character(len=*), intent(in) :: name
      type(contact_problem_t), intent(inout), target :: problem
      type(state_t), intent(in) :: guess
      type(state_t), intent(out), target :: theirs
      type(state_t), target :: ours
      type(newton_t) :: newton
      type(petsc_solver_t) :: petsc
      type(solve_report_t) :: report
      real(dp) :: central, smallest, pressure

      ours = guess
      theirs = guess
      call newton%init(problem)
      call newton%solve(problem, ours, limits, report)
      call check_converged(name//', Newton', report)
      call petsc%init(problem)
      call petsc%solve(problem, theirs, limits, report)
      call check_converged(name//', PETSc', report)

      central = problem%grid%value_at_centre(theirs%h)
      smallest = minval(theirs%h)
      pressure = maxval(abs(ours%p - theirs%p))/maxval(theirs%p)
      call test%check_close(problem%grid%value_at_centre(ours%h), central, name//', central film', relative=agreement)
      call test%check_close(minval(ours%h), smallest, name//', smallest film', relative=agreement)
      call test%check_close(pressure, 0.0_dp, name//', pressure', absolute=agreement)
      call test%check(minval(theirs%p) >= 0, name//', no negative pressure')
      write (output_unit, '(a)') name//': '//to_text(report%nonlinear_steps)//' steps, '//to_text(report%linear_steps)// &
         ' GMRES steps; differ by '//to_text(problem%grid%value_at_centre(ours%h)/central - 1, 2)//' in central film, '// &
         to_text(minval(ours%h)/smallest - 1, 2)//' in smallest film, '//to_text(pressure, 2)//' in pressure'
   end subroutine compare

   subroutine check_converged(name, report)
      character(len=*), intent(in) :: name
      type(solve_report_t), intent(in) :: report
      call test%check_equal(status_name(report%status), status_name(status_converged), name)
      call test%check(max(report%residual, report%complementarity, report%load_error) <= limits%tolerance, &
                      name//', residual '//to_text(report%residual, 3))
   end subroutine check_converged

   !> The same solve before and after another one gives the same bits. Whole domain here.
   subroutine check_repetition()
      type(contact_problem_t) :: problem
      type(petsc_solver_t) :: petsc
      type(state_t) :: first, other, again
      type(solve_report_t) :: report

      call make_contact(problem, 100.0_dp, 1.0_dp, 32, 32, is_half=.false.)
      call petsc%init(problem)
      call hertz_guess(problem, first)
      again = first
      other = first
      other%p = 0.5_dp*other%p
      call petsc%solve(problem, first, limits, report)
      call check_converged('whole domain', report)
      call petsc%solve(problem, other, limits, report)
      call check_converged('from a guess with overlap', report)
      call test%check_close(other%delta, first%delta, 'same approach from it', relative=agreement)
      call petsc%solve(problem, again, limits, report)
      call test%check(all(abs(first%p - again%p) <= 0) .and. abs(first%delta - again%delta) <= 0, 'A, B, A')
      call hertz_guess(problem, other)
      call petsc%solve(problem, other, solve_limits_t(tolerance=1e-10_dp, largest_steps=0), report)
      call test%check_equal(report%nonlinear_steps, 0, 'no step allowed, none taken')
      call petsc%solve(problem, other, solve_limits_t(tolerance=1e-10_dp, largest_steps=2), report)
      call test%check_equal(status_name(report%status), 'stalled', 'out of steps')
   end subroutine check_repetition

   !> Hertz pressure, and the approach that leaves the formula's central film thickness.
   subroutine hertz_guess(problem, state)
      type(contact_problem_t), intent(inout) :: problem
      type(state_t), intent(out) :: state
      integer :: j

      state = new_state(problem%grid)
      associate (grid => problem%grid)
         do j = 0, grid%ny
            state%p(:, j) = sqrt(max(0.0_dp, 1 - grid%x**2 - grid%y(j)**2))
         end do
         call problem%deformation%apply(state%p, state%h)
         state%delta = grid%value_at_centre(state%h) &
                       - moes_film_formula(problem%conditions)/problem%conditions%moes_film_factor
      end associate
   end subroutine hertz_guess

end program test_petsc
