!> Which cases take the scheme that is fitted to steep inlets without being asked.
program test_scheme_choice
   use ehlwave_case_completion, only: complete_case
   use ehlwave_case_definition, only: case_t
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_oil, only: eyring
   use ehlwave_planned_case, only: case_plan_t
   use sample_plan, only: plan_of
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test
   type(case_t) :: case
   type(case_plan_t) :: averaged, fitted

   call check(sample(100.0_dp), 'auto', 'a light load')
   call check(sample(300.0_dp), 'fitted', 'a heavier one')
   call check(with_waves(100.0_dp, 0.5_dp), 'fitted', 'waves and a light load')
   call check(with_waves(10000.0_dp, 0.5_dp), 'fitted', 'waves and a heavy one')
   call check(with_waves(1000.0_dp, 0.1_dp), 'auto', 'waves so short that they decide on the grid')
   case = sample(300.0_dp)
   case%slip_parameter = 1.3_dp
   case%data%reduced_modulus_pa = 226e9_dp
   case%oil%flow_law = eyring
   case%oil%eyring_stress_pa = 2e6_dp
   call check(case, 'fitted', 'an oil that thins')
   case = sample(10000.0_dp)
   case%accuracy = 0
   call check(case, 'auto', 'no accuracy')
   case = sample(10000.0_dp)
   case%cells_x = 2048
   call check(case, 'auto', 'cells that were given')
   case = sample(10000.0_dp)
   case%edges = 'truncated'
   call check(case, 'auto', 'edges as results that are there have them')
   case = sample(10000.0_dp)
   case%scheme = 'averaged'
   call check(case, 'averaged', 'a scheme that was given')
   case = sample(10000.0_dp)
   case%effects%starvation%oil_over_flooded = 0.5_dp
   call check(case, 'auto', 'too little oil')
   case = sample(10000.0_dp)
   case%method = 'fas'
   call check(case, 'auto', 'FAS, which was asked for')
   case = sample(1000.0_dp)
   case%radius_ratio_d = 0
   call check(case, 'auto', 'a line contact')

   fitted = plan_of(test, sample(10000.0_dp))
   case = sample(10000.0_dp)
   case%scheme = 'averaged'
   case%largest_cells = 4096
   averaged = plan_of(test, case)
   call test%check(fitted%resolution%is_resolved .and. fitted%expected_error <= 0.01_dp, 'the plan reaches it')
   call test%check(fitted%expected_work() < 0.2_dp*averaged%expected_work(), 'at a fifth of the work')
   case = sample(10000.0_dp)
   case%lubricant_parameter_l = 2.5_dp
   fitted = plan_of(test, case)
   call test%check(fitted%resolution%is_resolved, 'an inlet that is short for its accuracy')
   call check_marches()
   call test%finish()

contains

   function sample(m) result(case)
      real(dp), intent(in) :: m
      type(case_t) :: case
      case%load_parameter_m = m
      case%lubricant_parameter_l = 12.05_dp
      case%radius_ratio_d = 1
      case%accuracy = 0.01_dp
      case%edges = 'flooded'
      case%cells_x = 0
      case%cells_y = 0
   end function sample

   function with_waves(m, wavelength) result(case)
      real(dp), intent(in) :: m, wavelength
      type(case_t) :: case
      case = sample(m)
      case%orientation = 'transverse'
      case%wavelength_over_a = wavelength
      case%response = 'harmonic'
   end function with_waves

   !> Marches take the scheme and the step of the least work; keys that are given stay.
   subroutine check_marches()
      type(case_t) :: case
      type(case_plan_t) :: averaged, one, plan

      case = with_waves(20.0_dp, 1.0_dp)
      case%response = 'transient'
      case%time_step_over_cell = 0
      plan = plan_of(test, case)
      call test%check(plan%is_fitted .and. plan%cells_per_step == 1, 'a march: fitted, steps of a cell')
      call test%check(plan%expected_error <= case%accuracy, 'its error')
      call test%check(plan%resolution%is_resolved .and. plan%resolution%samples >= 8, 'steps resolve the wave')
      case%scheme = 'averaged'
      case%wavelength_over_a = 1
      averaged = plan_of(test, case)
      call test%check(.not. averaged%is_fitted .and. averaged%cells_per_step == 2, 'a scheme that was given: steps of two cells')
      call test%check(averaged%expected_error <= case%accuracy .and. averaged%expected%time > 0, 'with their error')
      call test%check(plan%expected_work() < 0.5_dp*averaged%expected_work(), 'less work')
      case%time_step_over_cell = 1
      one = plan_of(test, case)
      call test%check(one%cells_per_step == 1 .and. .not. one%expected%time > 0, 'a step that was given')
      call test%check(averaged%expected_work() < one%expected_work(), 'longer steps take less work')
      case%time_step_over_cell = 0
      case%response = 'both'
      plan = plan_of(test, case)
      call test%check(plan%cells_per_step == 1, 'steps of the linear response')
      case%scheme = 'auto'
      case%response = 'transient'
      case%radius_ratio_d = 0
      plan = plan_of(test, case)
      call test%check(plan%is_fitted .and. plan%cells_per_step == 1, 'a line contact: short steps')
   end subroutine check_marches

   subroutine check(given, scheme, name)
      type(case_t), intent(in) :: given
      character(len=*), intent(in) :: scheme, name
      type(case_t) :: case
      type(error_t), allocatable :: error
      case = given
      call complete_case(case, '', error)
      call test%check_no_error(error, name)
      call test%check_equal(trim(case%scheme), scheme, name)
   end subroutine check

end program test_scheme_choice
