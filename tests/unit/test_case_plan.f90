!> The plan of a case: kind of run, number of steps, grid.
program test_case_plan
   use ehlwave_case_completion, only: complete_case
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: make_plan
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t, run_march, run_smooth, run_standing
   use ehlwave_text, only: to_text
   use sample_plan, only: plan_of
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_kinds()
   call check_steps()
   call check_layer_change()
   call check_meniscus()
   call check_grid()
   call check_deformation()
   call check_refusal()
   call check_thinning()
   call check_work_cap()
   call test%finish()

contains

   function sample(orientation, wavelength) result(case)
      character(len=*), intent(in) :: orientation
      real(dp), intent(in) :: wavelength
      type(case_t) :: case
      case%load_parameter_m = 100
      case%lubricant_parameter_l = 12.05_dp
      case%radius_ratio_d = 1
      case%orientation = orientation
      case%wavelength_over_a = wavelength
      case%cells_x = 64
      case%cells_y = 64
   end function sample

   !> Shear-thinning oils: more error, more work; none for Newtonian and nearly Newtonian oils.
   subroutine check_thinning()
      type(case_plan_t) :: newtonian, plan
      type(case_t) :: case
      newtonian = plan_of(test, sample('none', 0.0_dp))
      case = sample('none', 0.0_dp)
      case%data%reduced_modulus_pa = 2.26e11_dp
      case%slip_parameter = 0.5_dp
      case%oil%flow_law = 'eyring'
      case%oil%eyring_stress_pa = 1e12_dp
      plan = plan_of(test, case)
      call test%check_close([newtonian%thinning%steepness, newtonian%thinning%cost], [1.0_dp, 1.0_dp], 'Newtonian', relative=0.0_dp)
      call test%check_close(plan%expected%mesh, newtonian%expected%mesh, 'hardly thins', relative=1e-4_dp)
      case%oil%eyring_stress_pa = 2e5_dp
      plan = plan_of(test, case)
      associate (stress => plan%conditions%hertz_pressure_pa**2/(2.26e11_dp*2e5_dp))
         call test%check_close(plan%expected%mesh, (1 + 0.15_dp*stress)*newtonian%expected%mesh, 'thins', relative=1e-10_dp)
      end associate
      call test%check(plan%expected_work_units > plan%thinning%steepness*newtonian%expected_work_units, 'its work')
      case%oil%flow_law = 'carreau'
      case%oil%carreau_modulus_pa = 2e5_dp
      case%oil%carreau_exponent = 1
      plan = plan_of(test, case)
      call test%check_close(plan%expected%mesh, newtonian%expected%mesh, 'n = 1 is Newtonian', relative=1e-10_dp)
   end subroutine check_thinning

   !> The cap follows from the plan unless the case sets it.
   subroutine check_work_cap()
      type(case_plan_t) :: plan
      type(case_t) :: case
      case = sample('transverse', 0.5_dp)
      plan = plan_of(test, case)
      call test%check(plan%has_work_cap() .and. plan%largest_work > plan%expected_work(), 'a cap')
      call test%check(plan%largest_work < 10*plan%expected_work(), 'within ten times the plan')
      case%largest_total_steps = 100
      plan = plan_of(test, case)
      call test%check(.not. plan%has_work_cap() .and. plan%largest_total_steps == 100, 'that of the case')
   end subroutine check_work_cap

   subroutine check_kinds()
      type(case_plan_t) :: plan
      type(case_t) :: case
      plan = plan_of(test, sample('none', 0.0_dp))
      call test%check(plan%kind == run_smooth .and. plan%is_half .and. plan%steps == 0, 'smooth')
      plan = plan_of(test, sample('longitudinal', 0.5_dp))
      call test%check(plan%kind == run_standing .and. plan%phases == 2, 'longitudinal: crest and trough')
      plan = plan_of(test, sample('isotropic', 0.5_dp))
      call test%check(plan%kind == run_march .and. plan%is_half, 'isotropic: march on half the domain')
      case = sample('isotropic', 0.5_dp)
      case%slip_parameter = 0
      plan = plan_of(test, case)
      call test%check(plan%kind == run_standing .and. plan%phases == 8, 'a surface at rest: eight phases')
      case = sample('custom', 0.0_dp)
      case%wavelength_x_over_a = 0.5_dp
      case%wavelength_y_over_a = 1
      case%oblique = .true.
      plan = plan_of(test, case)
      call test%check(plan%kind == run_march .and. .not. plan%is_half, 'oblique: whole domain')
      case = sample('isotropic', 0.5_dp)
      case%domain = 'whole'
      plan = plan_of(test, case)
      call test%check(.not. plan%is_half, 'whole domain as asked')
   end subroutine check_kinds

   subroutine check_steps()
      type(case_plan_t) :: plan
      type(case_t) :: case
      plan = plan_of(test, sample('transverse', 0.5_dp))
      call test%check_close(plan%dt, 0.0625_dp, 'dT = hX', relative=1e-15_dp)
      call test%check(plan%first_sample == 64 .and. plan%steps == 72, 'one wave after T = 3.5, for one wave')
      case = sample('transverse', 0.5_dp)
      case%settling_periods = 0
      plan = plan_of(test, case)
      call test%check(plan%first_sample == 56 .and. plan%steps == 64, 'from T = 3.5 for one wave')
      case = sample('transverse', 0.5_dp)
      case%slip_parameter = 0.5_dp
      plan = plan_of(test, case)
      call test%check(plan%first_sample == 128 .and. plan%steps == 144, 'slow surface: T = 7, period 1')
      case%slip_parameter = 2
      plan = plan_of(test, case)
      call test%check(plan%first_sample == 60 .and. plan%steps == 64, 'fast surface: the lubricant is slower')
      case = sample('transverse', 1.0_dp)
      case%time_step_over_cell = 2
      plan = plan_of(test, case)
      call test%check(plan%steps == 44 .and. plan%cells_per_step == 2 .and. plan%steps_per_cell == 1, 'two cells a step')
      case%time_step_over_cell = 0.25_dp
      plan = plan_of(test, case)
      call test%check(plan%steps == 352 .and. plan%cells_per_step == 1 .and. plan%steps_per_cell == 4, 'four steps a cell')
      case = sample('transverse', 0.5_dp)
      case%end_time = 6
      plan = plan_of(test, case)
      call test%check(plan%steps == 96 .and. plan%first_sample == 88, 'end time asked for')
   end subroutine check_steps

   !> Waves are measured once a change of the layer has passed and the inlet has followed, and with the layer after it.
   subroutine check_layer_change()
      type(case_plan_t) :: plan, same
      type(case_t) :: case
      case = sample('transverse', 1.0_dp)
      case%effects%starvation%oil_over_flooded = 1.5_dp
      same = plan_of(test, case)
      case%effects%starvation%oil_change_factor = 0.1_dp
      case%effects%starvation%oil_change_start = 2
      case%effects%starvation%oil_change_length = 0.5_dp
      plan = plan_of(test, case)
      call test%check(plan%rest > 2 + 0.5_dp + 3.5_dp .and. plan%first_sample*plan%dt >= plan%rest + 1, 'a gap')
      call test%check_close(plan%effects%starvation%resolution, &
                            same%effects%starvation%resolution, 'the layer behind it', relative=0.0_dp)
      case%effects%starvation%oil_change_length = 0
      plan = plan_of(test, case)
      case%effects%starvation%oil_change_factor = 1
      case%effects%starvation%oil_over_flooded = 0.15_dp
      same = plan_of(test, case)
      call test%check(plan%first_sample > same%first_sample .and. .not. plan%resolution%is_resolved, 'a tenth of the layer')
      call test%check_close(plan%effects%starvation%resolution, &
                            same%effects%starvation%resolution, 'its meniscus', relative=1e-12_dp)
      case%effects%starvation%oil_change_factor = 0.5_dp
      case%end_time = 6
      plan = plan_of(test, case)
      call test%check(.not. plan%measures, 'too early an end')
      case%effects%starvation%oil_change_start = 6
      call refuse(case, 'oil_change_start', 'no change before the end')
      case%end_time = 0
      case%orientation = 'longitudinal'
      call refuse(case, 'end_time', 'nothing moves')
   end subroutine check_layer_change

   !> Waves need mesh sizes between the contact and the meniscus; the film does not.
   subroutine check_meniscus()
      type(case_plan_t) :: half, plan
      type(case_t) :: case
      case = sample('transverse', 1.0_dp)
      plan = plan_of(test, case)
      call test%check(plan%resolution%is_resolved .and. .not. plan%effects%starvation%distance > 0, 'flooded')
      case%effects%starvation%oil_over_flooded = 1
      plan = plan_of(test, case)
      call test%check(plan%resolution%is_resolved, 'fine enough for waves')
      call test%check_close(plan%effects%starvation%resolution*plan%effects%starvation%distance, plan%hx, &
                            'hX over the distance', relative=1e-12_dp)
      case%effects%starvation%oil_over_flooded = 0.5_dp
      half = plan_of(test, case)
      call test%check_close(half%effects%starvation%distance/plan%effects%starvation%distance, 0.5_dp**1.6_dp, &
                            'less oil, nearer meniscus', relative=1e-12_dp)
      case%effects%starvation%oil_over_flooded = 0.15_dp
      plan = plan_of(test, case)
      call test%check(.not. plan%resolution%is_resolved .and. index(plan%resolution%reason, 'meniscus') > 0, &
                      'a meniscus too near for waves')
      case%orientation = 'none'
      plan = plan_of(test, case)
      call test%check(plan%resolution%is_resolved, 'fine enough for a film')
   end subroutine check_meniscus

   subroutine check_grid()
      type(case_plan_t) :: plan
      type(case_t) :: case
      case = sample('transverse', 0.3_dp)
      case%cells_x = 0
      case%cells_y = 0
      plan = plan_of(test, case)
      call test%check(plan%cells_x == 224, '16 points per wave of 0.3: '//to_text(plan%cells_x))
      call test%check(plan%cells_y == 112, 'hY <= 2 hX: '//to_text(plan%cells_y))
      call test%check(plan%resolution%is_resolved, 'a chosen grid resolves')
      case = sample('isotropic', 1.0_dp)
      case%radius_ratio_d = 0.04_dp
      case%cells_x = 0
      case%cells_y = 0
      plan = plan_of(test, case)
      call test%check(plan%resolution%points_y >= 16, 'slender contact: 16 points per wave along Y too')
      case%largest_cells = 128
      plan = plan_of(test, case)
      call test%check(plan%cells_y == 128 .and. .not. plan%resolution%is_resolved, 'limited, and said so')
      call test%check(index(plan%grid_reason, 'limited') > 0, 'the plan says limited')
   end subroutine check_grid

   subroutine check_deformation()
      type(case_plan_t) :: plan
      type(case_t) :: case
      plan = plan_of(test, sample('none', 0.0_dp))
      call test%check(plan%deformation == 'fft', 'small: FFT')
      case = sample('none', 0.0_dp)
      case%cells_x = 512
      case%cells_y = 512
      plan = plan_of(test, case)
      call test%check(plan%deformation == 'fft', 'half of a large domain: FFT')
      case%radius_ratio_d = 0.04_dp
      plan = plan_of(test, case)
      call test%check(plan%deformation == 'fft', 'of a slender contact, too')
      case%deformation = 'mlmi'
      plan = plan_of(test, case)
      call test%check(plan%deformation == 'mlmi', 'MLMI where it is asked for')
      case%deformation = 'auto'
      case%domain = 'whole'
      plan = plan_of(test, case)
      call test%check(plan%deformation == 'fft', 'whole domain: FFT, too')
      case%domain = 'auto'
      case%deformation = 'fft'
      plan = plan_of(test, case)
      call test%check(plan%deformation == 'fft', 'as asked')
   end subroutine check_deformation

   subroutine check_refusal()
      type(case_t) :: case
      case = sample('transverse', 0.5_dp)
      case%slip_parameter = 1e-6_dp
      call refuse(case, 'slip_parameter', 'endless march')
   end subroutine check_refusal

   !> The plan of a case is refused, with this word in the reason.
   subroutine refuse(given, word, what)
      type(case_t), intent(in) :: given
      character(len=*), intent(in) :: word, what
      type(case_t) :: case
      type(case_plan_t) :: plan
      type(error_t), allocatable :: error
      case = given
      call complete_case(case, '', error)
      call make_plan(case, plan, error)
      call test%check_error(error, word, what)
   end subroutine refuse

end program test_case_plan
