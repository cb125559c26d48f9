!> FAS multigrid: the coarse problem of a solution has it as its solution, cycles converge at a rate that does not depend
!> on the grid, and nothing of a solve is left behind.
program test_fas
   use, intrinsic :: ieee_arithmetic, only: ieee_all, ieee_quiet_nan, ieee_set_flag, ieee_set_halting_mode, &
      ieee_value
   use ehlwave_fas_level, only: fas_level_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: equation_of_motion
   use ehlwave_newton, only: newton_t
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_solver_choice, only: method_t
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged, status_not_finite, status_stalled
   use ehlwave_text, only: to_text
   use sample_contact, only: make_multigrid, start_time_step
   use testing, only: is_long, test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_identity(1.0_dp, .true., is_step=.false.)
   call check_identity(0.12_dp, .false., is_step=.false.)
   call check_identity(1.0_dp, .true., is_step=.true.)
   call check_cycles()
   call check_grids()
   call check_nothing_left()
   call check_status()
   call check_closing_film()
   call test%finish()

contains

   subroutine make_levels(levels, d, cells, method, is_half, cycle)
      type(full_multigrid_t), intent(inout) :: levels
      real(dp), intent(in) :: d
      integer, intent(in) :: cells
      character(len=*), intent(in) :: method
      logical, intent(in) :: is_half
      character(len=1), intent(in), optional :: cycle
      type(method_t) :: chosen
      chosen%solver = method
      if (present(cycle)) chosen%cycle = cycle
      call make_multigrid(levels, 100.0_dp, d, cells, is_half, chosen)
   end subroutine make_levels

   !> Give a level the time step with an equation of motion and a wave that follows its state, at rest.
   subroutine start_heavy_step(level)
      type(level_t), intent(inout) :: level
      call start_time_step(level%problem, level%state, level%given)
      level%given%load = equation_of_motion(1.0_dp, 5.0_dp, level%problem%grid%hx)
      call level%given%load%carry(spread(level%state%delta, 1, 3))
   end subroutine start_heavy_step

   !> The coarse problem of a solution: no residual, no change by Newton's method, no correction. The problem of
   !> another state corrects it.
   subroutine check_identity(d, is_half, is_step)
      real(dp), intent(in) :: d
      logical, intent(in) :: is_half, is_step
      type(full_multigrid_t) :: levels
      type(fas_level_t) :: on_coarse, on_fine
      type(newton_t) :: newton
      type(solve_report_t) :: report
      type(state_t) :: solution
      character(len=:), allocatable :: name
      real(dp) :: error
      integer :: n

      name = 'D = '//to_text(d, 3)//trim(merge(', time step', '           ', is_step))
      call make_levels(levels, d, 64, 'newton', is_half)
      call levels%solve(solve_limits_t(tolerance=1e-12_dp), 1e-3_dp)
      n = size(levels%levels)
      if (is_step) then
         call start_heavy_step(levels%levels(n))
         call levels%solve_level(n, solve_limits_t(tolerance=1e-12_dp), report)
         levels%levels(n)%report = report
      end if
      associate (fine => levels%levels(n), coarse => levels%levels(n - 1)%problem)
         call test%check(fine%report%status == status_converged, name//': solution')
         solution = fine%state
         call on_fine%init(fine%problem)
         call on_coarse%init(coarse)
         call newton%init(levels%hierarchy_t, n - 1)

         on_fine%state = solution
         call on_fine%evaluate(fine%problem, fine%given)
         call on_coarse%restrict(coarse, on_fine, fine%given)
         call test%check_close(maxval(abs(on_coarse%equations%residual), mask=.not. on_coarse%equations%is_cavitated), 0.0_dp, &
                               name//': coarse residual of the solution', absolute=1e-9_dp)
         call test%check_close(on_coarse%equations%load_residual(on_coarse%given, on_coarse%state), 0.0_dp, &
                               name//': coarse load of the solution', absolute=1e-10_dp)
         call newton%improve(levels%levels(:n - 1), on_coarse%given, on_coarse%state, &
                             solve_limits_t(tolerance=1e-11_dp), report)
         call test%check(report%status == status_converged, name//': coarse problem')
         call test%check_close(maxval(abs(on_coarse%state%p - on_coarse%restricted%p)), 0.0_dp, name//': coarse solution', &
                               absolute=1e-8_dp)
         call on_fine%correct(fine%problem, fine%given, on_coarse)
         call test%check_close([maxval(abs(on_fine%state%p - solution%p)), on_fine%state%delta - solution%delta], &
                               [0.0_dp, 0.0_dp], name//': no correction at the solution', absolute=1e-8_dp)

         associate (state => on_fine%state)
            state%p = solution%p*(1 + 1e-3_dp*spread(cos(3*fine%problem%grid%x), 2, fine%problem%grid%ny + 1))
            state%delta = solution%delta + 1e-4_dp
            call fine%problem%film(fine%given, state%p, state%delta, state%h)
            error = sqrt(sum((state%p - solution%p)**2))
            call on_fine%evaluate(fine%problem, fine%given)
            call on_coarse%restrict(coarse, on_fine, fine%given)
            call newton%improve(levels%levels(:n - 1), on_coarse%given, on_coarse%state, &
                                solve_limits_t(tolerance=1e-8_dp), report)
            call on_fine%correct(fine%problem, fine%given, on_coarse)
            print '(a)', name//': smooth error left by the coarse correction '// &
               to_text(sqrt(sum((state%p - solution%p)**2))/error, 2)
            call test%check(sqrt(sum((state%p - solution%p)**2)) < 0.3_dp*error, name//': a smooth error is corrected')
            call test%check(abs(state%delta - solution%delta) < 0.3e-4_dp, name//': the approach is corrected')
         end associate
      end associate
   end subroutine check_identity

   !> Every kind of cycle converges to the solution of Newton's method; W and F no slower than V.
   subroutine check_cycles()
      character(len=1), parameter :: kinds(3) = ['v', 'w', 'f']
      type(full_multigrid_t) :: fas(3), newton
      integer :: cycles(3), k

      call make_levels(newton, 1.0_dp, 128, 'newton', .true.)
      call newton%solve(solve_limits_t(tolerance=1e-11_dp), 1e-3_dp)
      do k = 1, 3
         call make_levels(fas(k), 1.0_dp, 128, 'fas', .true., kinds(k))
         call fas(k)%solve(solve_limits_t(tolerance=1e-9_dp), 1e-3_dp)
         associate (level => fas(k)%levels(size(fas(k)%levels)), other => newton%levels(size(newton%levels)))
            call test%check(level%report%status == status_converged, kinds(k)//' cycles converge')
            call test%check_equal(size(level%report%history), level%report%nonlinear_steps + 1, kinds(k)//': history')
            call test%check(any(3*level%report%nonlinear_steps - level%report%linear_steps == [0, 1]), &
                            kinds(k)//': sweeps, of which the last may not be needed')
            call test%check(level%report%load_error <= 1e-9_dp .and. level%report%residual <= 1e-9_dp, kinds(k)//': errors')
            call test%check_close(maxval(abs(level%state%p - other%state%p)), 0.0_dp, kinds(k)//': pressure', absolute=1e-8_dp)
            call test%check_close(level%state%h(100, 0), other%state%h(100, 0), kinds(k)//': film', relative=1e-8_dp)
            cycles(k) = level%report%nonlinear_steps
         end associate
      end do
      print '(a,3(i0,1x))', 'V, W, F cycles to 1e-9: ', cycles
      call test%check(all(cycles(2:) <= cycles(1)), 'W and F cycles are no fewer than V cycles')
      call test%check(cycles(1) <= 20 .and. maxval(cycles(2:)) <= 14, 'few cycles')
   end subroutine check_cycles

   !> The number of W cycles does not grow with the grid; 256 cells are for long runs.
   subroutine check_grids()
      integer, parameter :: cells(3) = [64, 128, 256]
      integer :: cycles(3), k, n
      n = merge(3, 2, is_long())
      do k = 1, n
         block
            type(full_multigrid_t) :: fas
            call make_levels(fas, 0.12_dp, cells(k), 'fas', .true., 'w')
            call fas%solve(solve_limits_t(tolerance=1e-6_dp), 1e-3_dp)
            associate (report => fas%levels(size(fas%levels))%report)
               call test%check(report%status == status_converged, to_text(cells(k))//' cells converge')
               cycles(k) = report%nonlinear_steps
            end associate
         end block
      end do
      print '(a,3(i0,1x))', 'W cycles to 1e-6 on 64, 128, 256 cells: ', cycles(:n)
      call test%check(maxval(cycles(:n)) <= 8 .and. cycles(n) <= cycles(1), 'grid-independent cycles')
   end subroutine check_grids

   !> Where a film closes on a grid that does not resolve the contact, a solve ends soon.
   subroutine check_closing_film()
      type(full_multigrid_t) :: fas
      call make_multigrid(fas, 1e4_dp, 1.0_dp, 64, .true., method_t(solver='fas'))
      call fas%solve(solve_limits_t(tolerance=1e-6_dp, largest_steps=60), 1e-3_dp)
      associate (report => fas%levels(size(fas%levels))%report)
         call test%check(report%status == status_stalled .and. report%nonlinear_steps < 20, 'a closing film: '// &
            to_text(report%nonlinear_steps)//' cycles')
      end associate
   end subroutine check_closing_film

   !> Solving A, B, A gives the same A, and the coarse problems are as they were.
   subroutine check_nothing_left()
      type(full_multigrid_t) :: fas
      type(state_t) :: first
      type(solve_report_t) :: report
      type(solve_limits_t), parameter :: limits = solve_limits_t(tolerance=1e-6_dp)

      call make_levels(fas, 0.35_dp, 64, 'fas', .true.)
      call fas%solve(limits, 1e-3_dp)
      associate (level => fas%levels(size(fas%levels)), coarse => fas%levels(size(fas%levels) - 1)%given)
         first = level%state
         call test%check(.not. allocated(coarse%rough), 'no roughness left')
         call test%check(.not. allocated(coarse%transport%carried), 'no carried terms left')
         call test%check(.not. coarse%transport%is_local, 'steady transport is back')
         call test%check_close([coarse%load%carried, coarse%load%force], [0.0_dp, 1.0_dp], 'load balance is back', &
                               absolute=0.0_dp)
         call start_heavy_step(level)
         call fas%solve_level(size(fas%levels), limits, report)
         call test%check(report%status == status_converged, 'another problem')
         call test%check(maxval(abs(level%state%p - first%p)) > 1e-3_dp, 'it has another solution')
         call test%check(.not. coarse%transport%is_local, 'steady transport is back again')
      end associate
      block
         type(full_multigrid_t) :: again
         call make_levels(again, 0.35_dp, 64, 'fas', .true.)
         call again%solve(limits, 1e-3_dp)
         call again%solve(limits, 1e-3_dp)
         associate (state => again%levels(size(again%levels))%state)
            call test%check(all(abs(state%p - first%p) <= 0) .and. all(abs(state%h - first%h) <= 0) &
                            .and. abs(state%delta - first%delta) <= 0, 'the same bits, twice')
         end associate
      end block
   end subroutine check_nothing_left

   !> A solve that does not converge returns that status.
   subroutine check_status()
      type(full_multigrid_t) :: fas
      type(solve_report_t) :: report

      call make_levels(fas, 1.0_dp, 64, 'fas', .true.)
      call fas%solve(solve_limits_t(tolerance=1e-8_dp, largest_steps=2), 1e-3_dp)
      associate (level => fas%levels(size(fas%levels)))
         call test%check_equal(level%report%status, status_stalled, 'two cycles are not enough')
         call test%check_equal(level%report%nonlinear_steps, 2, 'cycle cap')
         call test%check(level%report%residual > 1e-8_dp, 'its residual')
         call ieee_set_halting_mode(ieee_all, .false.)      ! debug builds stop at a NaN
         level%state%p(30, 5) = ieee_value(1.0_dp, ieee_quiet_nan)
         call fas%solve_level(size(fas%levels), solve_limits_t(), report)
         call test%check_equal(report%status, status_not_finite, 'NaN is met')
         call ieee_set_flag(ieee_all, .false.)
      end associate
   end subroutine check_status

end program test_fas
