!> How the oil of a made-up state shears: stress, friction, share beyond the limit, warnings.
program test_shear_result
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_file, only: case_from_text
   use ehlwave_case_plan, only: make_plan
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_errors, only: error_t
   use ehlwave_grid, only: grid_t, new_grid
   use ehlwave_kinds, only: dp, no_value, pi
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_shear_result, only: shear_result_t
   use ehlwave_shear_stress, only: mean_shear_stress
   use ehlwave_state, only: new_state, state_t
   use ehlwave_thermal_estimate, only: warm_inlet_t
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_friction()
   call check_warning()
   call test%finish()

contains

   !> A made-up state, uniform film and pressure in a strip: tau = eta Du/h, or asinh of it in units of tau0.
   subroutine check_friction()
      type(case_t) :: case
      type(case_plan_t) :: plan
      type(error_t), allocatable :: error
      type(contact_problem_t), allocatable :: newtonian, sinh_oil
      type(state_t) :: state
      type(grid_t) :: grid
      type(shear_result_t) :: r
      real(dp), allocatable :: stress(:, :), stress_pa(:, :)
      real(dp) :: area, du, eta, tau
      character(len=*), parameter :: contact = '&conditions radius_x_m = 0.01, radius_y_m = 0.01, reduced_modulus_pa = 2e11, '// &
         'load_n = 50, mean_speed_m_per_s = 1, viscosity_pa_s = 0.05, slip_parameter = 1.5'

      allocate (newtonian, sinh_oil)
      grid = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 32, 32, .true.)
      state = new_state(grid)
      state%h = 0.25_dp
      state%p(10:20, :grid%ny - 1) = 0.5_dp
      call case_from_text(contact//"/ &lubricant viscosity_law = 'barus' /", case, error)
      call make_plan(case, plan, error)
      call test%check_no_error(error, 'Newtonian')
      call newtonian%init(grid, plan%conditions, plan%rheology)
      area = grid%integral(merge(1.0_dp, 0.0_dp, state%p > 0))
      du = 1
      eta = 0.05_dp*exp(0.5_dp*plan%conditions%alphabar)
      tau = eta*du/(0.25_dp*plan%conditions%c_m)
      call r%take(newtonian, state, stress)
      call test%check_close(r%dropped, 3/(2*pi)*area*tau/plan%conditions%hertz_pressure_pa, 'dropped friction', &
                            relative=1e-11_dp)
      call test%check(r%friction_coefficient /= r%friction_coefficient, 'no friction is given that no oil has')
      call test%check(index(r%warning(.false., .false.), 'no friction coefficient is given: the oil would have 11,') == 1, &
                      'warning of a dropped friction')
      state%p = 0.7_dp*state%p
      call r%take(newtonian, state, stress)
      call test%check_close(r%friction_coefficient, 3/(2*pi)*area*tau*exp(-0.15_dp*plan%conditions%alphabar) &
                            /plan%conditions%hertz_pressure_pa, 'Newtonian friction', relative=1e-11_dp)
      call test%check(r%dropped /= r%dropped, 'a friction below 1 is given')
      call test%check_close(r%tangent_factor, [1.0_dp, 1.0_dp], 'Newtonian factors', relative=0.0_dp)
      call test%check(r%largest_b /= r%largest_b, 'no B of a Newtonian oil')
      call test%check_close(r%share_beyond_limit, 1.0_dp, 'far beyond the limit', relative=1e-14_dp)
      call test%check(r%contact_rise_k > 100, 'a Newtonian contact would boil')
      state%p = state%p/0.7_dp

      call case_from_text(contact//"/ &lubricant viscosity_law = 'barus', flow_law = 'eyring', eyring_stress_pa = 4e6 /", &
                          case, error)
      call make_plan(case, plan, error)
      call sinh_oil%init(grid, plan%conditions, plan%rheology)
      call mean_shear_stress(sinh_oil, state, stress_pa)
      call test%check_close(stress_pa(15, 4), 4e6_dp*asinh(tau/4e6_dp), 'stress in the middle', relative=1e-11_dp)
      call r%take(sinh_oil, state, stress)
      call test%check_close(r%largest_b, tau/4e6_dp, 'B', relative=1e-11_dp)
      call test%check_close(r%share_beyond_limit, 0.0_dp, 'within the limit', absolute=0.0_dp)
   end subroutine check_friction

   subroutine check_warning()
      type(shear_result_t) :: r
      call test%check_equal(r%warning(.false., .false.), '', 'nothing is known')
      r%share_beyond_limit = 0.5_dp
      call test%check(index(r%warning(.false., .false.), &
                            'the shear stress is above 0.08 of the pressure where 50 % of the load') == 1, &
                      'limit')
      r%share_beyond_limit = 0
      r%inlet = warm_inlet_t(0.9_dp, 0.02_dp, 4.0_dp)
      r%contact_rise_k = 30
      call test%check(index(r%warning(.false., .false.), &
                            'the inlet would warm by about 4 K, which makes the film 10 % thinner (within 2 %)') == 1, &
                      'inlet')
      r%inlet%error = no_value
      call test%check(index(r%warning(.false., .false.), &
                            'the inlet would warm by at most about 4 K, which makes the film up to 10 % thinner') == 1, &
                      'inlet beyond the law')
      call test%check(index(r%warning(.false., .false.), 'the oil in the contact would warm by about 30 K') > 0, 'contact')
      call test%check_equal(r%warning(.false., .true.), '', 'a model with heat has that')
      r%share_beyond_limit = 0.5_dp
      call test%check_equal(r%warning(.true., .true.), '', 'and one with a limit')
   end subroutine check_warning

end program test_shear_result
