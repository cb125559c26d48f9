!> Four routes to the same discrete solution: FAS multigrid, Newton's method and PETSc, with the deformation by FFT;
!> FAS and Newton's method with the deformation by MLMI. The last two also agree with the others to the error of MLMI.
!> The balances of mass and load are computed here once more, from the solution alone.
program test_four_routes
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_conditions, only: conditions_from_moes, conditions_t
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_deformation_fft, only: deformation_fft_t
   use ehlwave_errors, only: error_t
   use ehlwave_equations, only: equations_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_grid, only: new_grid
   use ehlwave_given, only: steady_given
   use ehlwave_kinds, only: dp, pi
   use ehlwave_petsc_library, only: finish_petsc, is_petsc_built, require_petsc
   use ehlwave_solve_report, only: mass_gain, solve_limits_t, solve_report_t
   use ehlwave_solver_choice, only: init_multigrid, method_t
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged
   use ehlwave_text, only: to_text
   use ehlwave_transport, only: characteristic_transport
   use sample_contact, only: make_rheology
   use testing, only: test_t
   implicit none (type, external)

   integer, parameter :: cells = 128
   real(dp), parameter :: agreement = 1e-6_dp      !! relative, of Hc, Hmin and the pressure field
   real(dp), parameter :: mlmi_film = 1.5e-3_dp    !! relative: a tenth of the discretisation error on this grid
   real(dp), parameter :: mlmi_pressure = 3e-3_dp  !! relative to the largest, at the pressure spike
   type(solve_limits_t), parameter :: limits = solve_limits_t(tolerance=1e-8_dp, largest_steps=40)
   type(test_t) :: test
   type(error_t), allocatable :: error

   if (is_petsc_built) call require_petsc(error)
   call test%check_no_error(error, 'PETSc can be used')
   call compare_contact('M = 20, L = 2.5, D = 1', 20.0_dp, 2.5_dp, 1.0_dp)
   call compare_contact('M = 100, L = 12.05, D = 1', 100.0_dp, 12.05_dp, 1.0_dp)
   call compare_contact('M = 100, L = 12.05, D = 0.12', 100.0_dp, 12.05_dp, 0.12_dp)
   call compare_contact('M = 2000, L = 12.05, D = 0.35', 2000.0_dp, 12.05_dp, 0.35_dp)
   call compare_march()
   if (is_petsc_built) call finish_petsc()
   call test%finish()

contains

   subroutine compare_contact(name, m, l, d)
      character(len=*), intent(in) :: name
      real(dp), intent(in) :: m, l, d
      type(state_t) :: newton, fas, petsc, newton_mlmi, fas_mlmi

      call solve(name//', Newton', m, l, d, 'newton', 'fft', newton)
      call solve(name//', FAS', m, l, d, 'fas', 'fft', fas)
      call compare(name//', FAS and Newton', fas, newton, agreement, agreement)
      if (is_petsc_built) then
         call solve(name//', PETSc', m, l, d, 'petsc', 'fft', petsc)
         call compare(name//', FAS and PETSc', fas, petsc, agreement, agreement)
      end if
      call solve(name//', Newton with MLMI', m, l, d, 'newton', 'mlmi', newton_mlmi)
      call solve(name//', FAS with MLMI', m, l, d, 'fas', 'mlmi', fas_mlmi)
      call compare(name//', FAS and Newton with MLMI', fas_mlmi, newton_mlmi, agreement, agreement)
      call compare(name//', FAS with MLMI and FFT', fas_mlmi, fas, mlmi_film, mlmi_pressure)
   end subroutine compare_contact

   subroutine make_levels(levels, m, l, d, method, deformation)
      type(full_multigrid_t), intent(inout) :: levels
      real(dp), intent(in) :: m, l, d
      character(len=*), intent(in) :: method, deformation
      type(conditions_t) :: conditions

      call conditions_from_moes(m, l, d, 2.2e-8_dp, conditions, error)
      call test%check_no_error(error, 'conditions')
      call init_multigrid(levels, conditions, make_rheology(conditions), new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells, cells, .true.), &
                       method_t(solver=method, deformation=deformation))
   end subroutine make_levels

   subroutine solve(name, m, l, d, method, deformation, state)
      character(len=*), intent(in) :: name, method, deformation
      real(dp), intent(in) :: m, l, d
      type(state_t), intent(out) :: state
      type(full_multigrid_t) :: levels

      call make_levels(levels, m, l, d, method, deformation)
      call levels%solve(limits, 1e-3_dp)
      associate (level => levels%levels(size(levels%levels)))
         call test%check(level%report%status == status_converged, name//': converged')
         state = level%state
         call check_balances(name, level%problem, state, deformation == 'fft')
      end associate
   end subroutine solve

   !> No node with pressure gains or loses oil, no node without pressure would gain any, and the pressure carries the
   !> load. The film is computed anew, by FFT.
   subroutine check_balances(name, problem, state, is_fft)
      character(len=*), intent(in) :: name
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      logical, intent(in) :: is_fft
      type(deformation_fft_t) :: deformation
      type(equations_t) :: equations
      real(dp), allocatable :: h(:, :), r(:, :)
      real(dp) :: unit
      integer :: j

      associate (grid => problem%grid, elliptic => problem%conditions%elliptic)
         call test%check_close(3/(2*pi)*grid%integral(state%p), 1.0_dp, name//': load', absolute=limits%tolerance)
         call test%check(minval(state%p) >= 0, name//': no pressure below zero')
         if (.not. is_fft) return
         allocate (h, r, mold=state%h)
         call deformation%init(grid, elliptic%kappa, elliptic%k)
         call deformation%apply(state%p, h)
         do j = 0, grid%ny
            h(:, j) = h(:, j) + problem%smooth_gap(j) - state%delta
         end do
         call test%check_close(maxval(abs(h - state%h)), 0.0_dp, name//': film', absolute=1e-12_dp)
         call equations%init(problem)
         call equations%evaluate(problem, steady_given(grid), state_t(state%p, h, state%delta))
         r = equations%residual
         unit = grid%hx/grid%value_at_centre(h)
         call test%check_close(maxval(mass_gain(r, grid%hx, h, grid%value_at_centre(h)), &
                                      mask=state%p > limits%tolerance), 0.0_dp, &
                               name//': mass where there is pressure', absolute=1.1_dp*limits%tolerance)
         call test%check(maxval(r, mask=.not. state%p > limits%tolerance)*unit <= 1.1_dp*limits%tolerance, &
                         name//': mass where it is cavitated')
      end associate
   end subroutine check_balances

   subroutine compare(name, a, b, film, pressure)
      character(len=*), intent(in) :: name
      type(state_t), intent(in) :: a, b
      real(dp), intent(in) :: film, pressure     !! allowed relative differences
      real(dp) :: difference(3)

      difference = [abs(a%h(80, 0)/b%h(80, 0) - 1), abs(minval(a%h)/minval(b%h) - 1), maxval(abs(a%p - b%p))/maxval(b%p)]
      print '(a)', name//': Hc '//to_text(difference(1), 2)//', Hmin '//to_text(difference(2), 2)//', pressure '// &
         to_text(difference(3), 2)
      call test%check(all(ieee_is_finite(difference)), name//': finite')
      call test%check_close(difference(1), 0.0_dp, name//': Hc', absolute=film)
      call test%check_close(difference(2), 0.0_dp, name//': Hmin', absolute=film)
      call test%check_close(difference(3), 0.0_dp, name//': pressure', absolute=pressure)
   end subroutine compare

   !> Eight time steps with a wave in the gap.
   subroutine compare_march()
      type(state_t) :: newton, fas
      call march('newton', newton)
      call march('fas', fas)
      call compare('time steps, FAS and Newton', fas, newton, agreement, agreement)
   end subroutine compare_march

   subroutine march(method, state)
      character(len=*), intent(in) :: method
      type(state_t), intent(out) :: state
      type(full_multigrid_t) :: levels
      type(solve_report_t) :: report
      real(dp), allocatable :: history(:, :, :)
      integer :: k

      call make_levels(levels, 100.0_dp, 12.05_dp, 1.0_dp, method, 'fft')
      call levels%solve(limits, 1e-3_dp)
      associate (level => levels%levels(size(levels%levels)))
         associate (problem => level%problem, given => level%given, grid => level%problem%grid)
            allocate (history(0:grid%nx, 0:grid%ny, 2))
            history = spread(problem%rheology%density(level%state%p)*level%state%h, 3, 2)
            given%transport = characteristic_transport(grid, 1, 1)
            do k = 1, 8
               call given%transport%carry(grid, history)
               call given%set_rough(0.02_dp*spread(cos(4*pi*(grid%x - k*grid%hx)), 2, grid%ny + 1))
               call levels%solve_level(size(levels%levels), limits, report)
               call test%check(report%status == status_converged, method//': time step')
               history(:, :, 2) = history(:, :, 1)
               history(:, :, 1) = problem%rheology%density(level%state%p)*level%state%h
            end do
            state = level%state
         end associate
      end associate
   end subroutine march

end program test_four_routes
