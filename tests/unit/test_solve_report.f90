!> How a state is measured and judged, on the fields that decide it.
program test_solve_report
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_positive_inf, ieee_quiet_nan, ieee_value
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_equations, only: equations_t
   use ehlwave_given, only: steady_given
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_state, only: new_state, state_t
   use ehlwave_status, only: status_name
   use sample_contact, only: make_contact
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test
   type(contact_problem_t) :: problem
   type(state_t) :: state
   type(solve_report_t) :: report
   type(equations_t) :: equations

   call make_contact(problem, 100.0_dp, 1.0_dp, 32, 32, is_half=.true.)
   state = new_state(problem%grid)
   call equations%init(problem)
   state%p(1:31, 0:15) = 1
   state%p = state%p/(load_factor*problem%grid%integral(state%p))
   state%h = 2
   state%h(5, 3) = 8

   call judge(1e-6_dp, 'converged', 'no residual')
   equations%residual(5, 3) = -0.4_dp
   equations%residual(20, 2) = 0.3_dp
   call judge(1e-6_dp, 'stalled', 'a residual')
   call test%check_close(report%residual, 0.3_dp*problem%grid%hx/2, 'mass in units of the larger film', relative=1e-14_dp)
   call judge(report%residual, 'converged', 'a residual that equals the tolerance')
   equations%is_cavitated(20, 2) = .true.
   call judge(0.9_dp*report%residual, 'stalled', 'a pressure where it is cavitated')
   call test%check_close(report%residual, 0.4_dp*problem%grid%hx/8, 'no residual counts there', relative=1e-14_dp)
   call test%check_close(report%complementarity, state%p(20, 2), 'its complementarity', relative=1e-14_dp)
   call test%check_close(report%worst(), state%p(20, 2), 'is the worst', relative=1e-14_dp)
   equations%residual(20, 2) = ieee_value(1.0_dp, ieee_quiet_nan)
   call judge(1e9_dp, 'not_finite', 'NaN, even where it is cavitated')
   call test%check(ieee_is_nan(report%residual), 'shows in the residual')
   equations%residual(20, 2) = ieee_value(1.0_dp, ieee_positive_inf)
   call judge(1e9_dp, 'not_finite', 'infinity')
   equations%residual = 0
   equations%is_cavitated = .false.
   state%p = 1.5_dp*state%p
   call judge(1e-6_dp, 'stalled', 'too large a load')
   call test%check_close(report%load_error, 0.5_dp, 'load error', relative=1e-12_dp)
   call test%finish()

contains

   subroutine judge(tolerance, expected, what)
      real(dp), intent(in) :: tolerance
      character(len=*), intent(in) :: expected, what
      call report%judge(steady_given(problem%grid), equations, state, solve_limits_t(tolerance=tolerance))
      call test%check_equal(status_name(report%status), expected, what)
   end subroutine judge

end program test_solve_report
