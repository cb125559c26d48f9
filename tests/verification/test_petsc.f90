!> Newton's method of this project against the variational inequality of PETSc: same discrete equations, other solver.
!> Skipped (77) in builds without PETSc.
program test_petsc
   use, intrinsic :: iso_fortran_env, only: output_unit
   use ehlwave_process, only: end_program
   use ehlwave_errors, only: error_t
   use ehlwave_hierarchy, only: hertz_guess, hierarchy_t
   use ehlwave_kinds, only: dp, pi
   use ehlwave_newton, only: newton_t
   use ehlwave_petsc_library, only: finish_petsc, is_petsc_built, require_petsc
   use ehlwave_petsc_solver, only: petsc_solver_t
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_state, only: new_state, state_t
   use ehlwave_status, only: status_converged, status_name
   use ehlwave_text, only: to_text
   use ehlwave_real_transfer, only: interpolate
   use sample_contact, only: make_level, start_time_step
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: agreement = 1e-6_dp   !! relative, of film and pressure
   type(solve_limits_t), parameter :: limits = solve_limits_t(tolerance=1e-10_dp, largest_steps=60)
   type(test_t) :: test
   type(error_t), allocatable :: error

   if (.not. is_petsc_built) then
      write (output_unit, '(a)') 'skipped: built without PETSc'
      call end_program(77)
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
   !> pattern and a time step of a transverse pattern.
   subroutine compare_contact(name, m, d, cells)
      character(len=*), intent(in) :: name
      real(dp), intent(in) :: m, d
      integer, intent(in) :: cells
      type(hierarchy_t) :: coarse, single     ! hierarchies of a single level
      type(state_t) :: on_coarse, guess, smooth, wavy
      real(dp), allocatable :: pattern(:, :)
      real(dp) :: amplitude
      integer :: j

      call make_single(single, m, d, cells, is_half=.true.)
      call compare(name//', from Hertz', single, hertz(single), smooth)
      call make_single(coarse, m, d, cells/2, is_half=.true.)
      call compare(name//', coarser grid', coarse, hertz(coarse), on_coarse)
      associate (given => single%levels(1)%given, grid => single%levels(1)%problem%grid)
         guess = new_state(grid)
         call interpolate(coarse%levels(1)%problem%grid, grid, on_coarse%p, guess%p)
         guess%p = max(guess%p, 0.0_dp)
         guess%delta = on_coarse%delta
         call compare(name//', from the coarser grid', single, guess, smooth)

         amplitude = 0.2_dp*grid%value_at_centre(smooth%h)
         allocate (pattern(0:grid%nx, 0:grid%ny))
         do j = 0, grid%ny
            pattern(:, j) = amplitude*cos(2*pi*grid%y(j))
         end do
         call given%set_rough(pattern)
         call compare(name//', trough along the centre line', single, smooth, wavy)
         call given%set_rough(-pattern)
         call compare(name//', crest along the centre line', single, smooth, wavy)
         do j = 0, grid%ny
            pattern(:, j) = amplitude*cos(2*pi*grid%x)
         end do
         call start_time_step(single%levels(1)%problem, smooth, given)
         call given%set_rough(pattern)
      end associate
      call compare(name//', time step', single, smooth, wavy)
   end subroutine compare_contact

   subroutine make_single(single, m, d, cells, is_half)
      type(hierarchy_t), intent(inout) :: single
      real(dp), intent(in) :: m, d
      integer, intent(in) :: cells
      logical, intent(in) :: is_half
      allocate (single%levels(1))
      call make_level(single%levels(1), m, d, cells, is_half)
   end subroutine make_single

   !> First guess of a single level.
   function hertz(single) result(guess)
      type(hierarchy_t), intent(inout) :: single
      type(state_t) :: guess
      guess = new_state(single%levels(1)%problem%grid)
      call hertz_guess(single%levels(1)%problem, guess)
   end function hertz

   !> Solve with both from the same guess; `theirs` is the solution of PETSc.
   subroutine compare(name, single, guess, theirs)
      character(len=*), intent(in) :: name
      type(hierarchy_t), intent(inout) :: single
      type(state_t), intent(in) :: guess
      type(state_t), intent(out) :: theirs
      type(state_t) :: ours
      type(newton_t) :: newton
      type(petsc_solver_t) :: petsc
      type(solve_report_t) :: report
      real(dp) :: central, smallest, pressure

      single%levels(1)%state = guess
      call newton%init(single, 1)
      call newton%solve(single, 1, limits, report)
      call check_converged(name//', Newton', report)
      ours = single%levels(1)%state
      single%levels(1)%state = guess
      call petsc%init(single, 1)
      call petsc%solve(single, 1, limits, report)
      call check_converged(name//', PETSc', report)
      theirs = single%levels(1)%state

      associate (grid => single%levels(1)%problem%grid)
         central = grid%value_at_centre(ours%h)/grid%value_at_centre(theirs%h)
      end associate
      smallest = minval(ours%h)/minval(theirs%h)
      pressure = maxval(abs(ours%p - theirs%p))/maxval(theirs%p)
      call test%check_close(central, 1.0_dp, name//', central film', absolute=agreement)
      call test%check_close(smallest, 1.0_dp, name//', smallest film', absolute=agreement)
      call test%check_close(pressure, 0.0_dp, name//', pressure', absolute=agreement)
      call test%check(minval(theirs%p) >= 0, name//', no negative pressure')
      write (output_unit, '(a)') name//': '//to_text(report%nonlinear_steps)//' steps, '//to_text(report%linear_steps)// &
         ' GMRES steps; differ by '//to_text(central - 1, 2)//' in central film, '// &
         to_text(smallest - 1, 2)//' in smallest film, '//to_text(pressure, 2)//' in pressure'
   end subroutine compare

   subroutine check_converged(name, report)
      character(len=*), intent(in) :: name
      type(solve_report_t), intent(in) :: report
      call test%check_equal(status_name(report%status), status_name(status_converged), name)
      call test%check(max(report%residual, report%complementarity, report%load_error) <= limits%tolerance, &
                      name//', residual '//to_text(report%residual, 3))
   end subroutine check_converged

   !> A repeated solve after another solve gives the same bits. Whole domain here.
   subroutine check_repetition()
      type(hierarchy_t) :: single
      type(petsc_solver_t) :: petsc
      type(state_t) :: first
      type(solve_report_t) :: report

      call make_single(single, 100.0_dp, 1.0_dp, 32, is_half=.false.)
      call petsc%init(single, 1)
      associate (state => single%levels(1)%state)
         state = hertz(single)
         call petsc%solve(single, 1, limits, report)
         call check_converged('whole domain', report)
         first = state
         state = hertz(single)
         state%p = 0.5_dp*state%p
         call petsc%solve(single, 1, limits, report)
         call check_converged('from a guess with overlap', report)
         call test%check_close(state%delta, first%delta, 'same approach from it', relative=agreement)
         state = hertz(single)
         call petsc%solve(single, 1, limits, report)
         call test%check(all(abs(first%p - state%p) <= 0) .and. abs(first%delta - state%delta) <= 0, 'A, B, A')
         state = hertz(single)
         call petsc%solve(single, 1, solve_limits_t(tolerance=1e-10_dp, largest_steps=0), report)
         call test%check_equal(report%nonlinear_steps, 0, 'no step allowed, none taken')
         call petsc%solve(single, 1, solve_limits_t(tolerance=1e-10_dp, largest_steps=2), report)
         call test%check_equal(status_name(report%status), 'stalled', 'out of steps')
      end associate
   end subroutine check_repetition

end program test_petsc
