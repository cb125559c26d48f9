!> The lubricant of a case: requests and refusals by name, alpha from a law, effective input.
program test_case_lubricant
   use ehlwave_case_completion, only: complete_case
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_file, only: case_from_text
   use ehlwave_case_lubricant, only: pressure_viscosity
   use ehlwave_case_plan, only: make_plan
   use ehlwave_case_text, only: case_identity, effective_input
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_viscosity_law, only: film_forming_coefficient
   use testing, only: test_t
   implicit none (type, external)

   character(len=*), parameter :: moes = '&conditions load_parameter_m = 100, lubricant_parameter_l = 12, radius_ratio_d = 1'
   character(len=*), parameter :: modulus = ', reduced_modulus_pa = 2e11'
   character(len=*), parameter :: line = '&conditions radius_x_m = 0.01, reduced_modulus_pa = 2e11, mean_speed_m_per_s = 1, '// &
                                         'viscosity_pa_s = 0.05'
   character(len=*), parameter :: eyring = "/ &lubricant flow_law = 'eyring', eyring_stress_pa = 5e6 /"
   character(len=*), parameter :: mcewen = "/ &lubricant viscosity_law = 'mcewen', mcewen_coefficient_per_pa = 2e-8, "// &
                                           "mcewen_exponent = 9"
   character(len=*), parameter :: tait = 'tait_modulus_pa = 1.2e9, tait_modulus_rate = 11.7 /'
   type(test_t) :: test

   call check_refusals()
   call check_refused_loads()
   call check_coefficient()
   call check_texts()
   call test%finish()

contains

   subroutine refuse(text, needle)
      character(len=*), intent(in) :: text, needle
      type(case_t) :: case
      type(error_t), allocatable :: error
      call case_from_text(text, case, error)
      call test%check_error(error, needle, needle)
   end subroutine refuse

   subroutine check_refusals()
      call refuse(moes//eyring, '&conditions reduced_modulus_pa is missing: &lubricant flow_law = ''eyring''')
      call refuse(moes//modulus//"/ &lubricant flow_law = 'eyring' /", '&lubricant eyring_stress_pa is missing')
      call refuse(moes//modulus//"/ &lubricant flow_law = 'carreau', carreau_modulus_pa = 7e6 /", &
                  '&lubricant carreau_exponent is missing: flow_law = ''carreau'' needs it')
      call refuse(moes//modulus//'/ &lubricant eyring_stress_pa = 5e6 /', &
                  'eyring_stress_pa = 5000000 belongs to flow_law = ''eyring''')
      call refuse('&conditions load_parameter_m = 100, lubricant_parameter_l = 0, radius_ratio_d = 1'//modulus//eyring, &
                  'lubricant_parameter_l = 0 leaves the pressure unknown')
      call refuse(moes//mcewen//', pressure_viscosity_per_pa = 2e-8 /', 'pressure_viscosity_per_pa = 2e-8 belongs to')
      call refuse(moes//mcewen//', roelands_index = 0.6 /', 'roelands_index = 0.6 belongs to')
      call refuse(moes//"/ &lubricant density_law = 'tait', tait_modulus_pa = 1e9 /", '&lubricant tait_modulus_rate is missing')
      call refuse(moes//"/ &lubricant viscosity_law = 'doolittle', doolittle_factor = 4, "//tait, &
                  'doolittle_occupied_fraction is missing')
      call refuse(moes//"/ &lubricant viscosity_law = 'yasutomi' /", 'yasutomi_c1 is missing')
      call refuse(moes//'/ &lubricant '//tait, 'belongs to density_law = ''tait''')
   end subroutine check_refusals

   subroutine check_refused_loads()
      call refuse(line//', load_n_per_m = 1e5, load_n = 10 /', 'load_n_per_m = 100000 is the load of a line contact')
      call refuse(line//', load_n_per_m = 1e5, radius_y_m = 0.01 /', 'load_n_per_m = 100000 is the load of a line contact')
      call refuse(line//' /', 'radius_y_m is missing')
      call refuse(line//', radius_y_m = 0.01 /', 'load_n is missing')
      call refuse(moes//', load_n_per_m = 1e5 /', 'give one of the two')
      call refuse("&conditions reduced_modulus_pa = 2e11 /", 'load_parameter_m is missing')
      call refuse(line//", load_n_per_m = 1e5 / &waviness orientation = 'isotropic', wavelength_over_a = 1 /", &
                  'waves along Y in linear responses only')
   end subroutine check_refused_loads

   !> alpha of L and ph is the film-forming coefficient.
   subroutine check_coefficient()
      type(case_t) :: case, same
      type(case_plan_t) :: plan
      type(error_t), allocatable :: error
      real(dp) :: alpha

      call case_from_text(moes//mcewen//' /', case, error)
      call make_plan(case, plan, error)
      call test%check_no_error(error, 'McEwen')
      alpha = film_forming_coefficient(case%oil%mcewen)
      call test%check_close(pressure_viscosity(case), alpha, 'alpha', relative=0.0_dp)
      call test%check(abs(alpha - 2e-8_dp) > 1e-10_dp, 'not the coefficient at ambient pressure')
      call test%check_close(plan%conditions%hertz_pressure_pa, plan%conditions%alphabar/alpha, 'ph', relative=1e-14_dp)
      same = case
      same%is_dimensional = .true.
      same%data%radius_x_m = 0.01_dp
      same%data%radius_y_m = 0.01_dp
      same%data%reduced_modulus_pa = 2e11_dp
      same%data%load_n = 50
      same%data%mean_speed_m_per_s = 1
      same%data%viscosity_pa_s = 0.05_dp
      call complete_case(same, '', error)
      call test%check_no_error(error, 'dimensional')
      call test%check_close(same%lubricant_parameter_l, alpha*2e11_dp*(0.1_dp/2e9_dp)**0.25_dp, 'L', relative=1e-13_dp)
   end subroutine check_coefficient

   !> Written and read again: unchanged; a case without the new keys does not mention them.
   subroutine check_texts()
      type(case_t) :: case
      type(error_t), allocatable :: error
      call check_text(moes//modulus//eyring, 'eyring_stress_pa = 5000000')
      call check_text(moes//modulus//"/ &lubricant flow_law = 'carreau', carreau_modulus_pa = 7e6, carreau_exponent = 0.5 /", &
                      'carreau_exponent = 0.5')
      call check_text(line//', load_n_per_m = 2e5 /', 'load_n_per_m = 200000')
      call check_text(moes//mcewen//' /', 'mcewen_exponent = 9')
      call check_text(moes//"/ &lubricant viscosity_law = 'yasutomi', yasutomi_c1 = 16, yasutomi_c2_k = 14, "// &
                      'yasutomi_above_glass_k = 105, yasutomi_a1_k = 188, yasutomi_a2_per_pa = 7e-10, '// &
                      'yasutomi_b1_per_pa = 8e-9, yasutomi_b2 = -0.5 /', 'yasutomi_b2 = -0.5')
      call check_text(moes//"/ &lubricant viscosity_law = 'doolittle', density_law = 'tait', doolittle_factor = 4.5, "// &
                      'doolittle_occupied_fraction = 0.65, '//tait, 'tait_modulus_rate = 11.6')
      call case_from_text(moes//"/ &lubricant flow_law = 'newtonian', shear_limit_over_pressure = 0 /", case, error)
      call test%check_no_error(error, 'defaults')
      call test%check_equal(index(effective_input(case), 'flow_law') + index(effective_input(case), 'shear_limit') &
                            + index(effective_input(case), 'modulus'), 0, 'defaults of late keys are not written')
   end subroutine check_texts

   subroutine check_text(text, needle)
      character(len=*), intent(in) :: text, needle
      type(case_t) :: again, case
      type(error_t), allocatable :: error
      call case_from_text(text, case, error)
      call test%check_no_error(error, needle)
      if (allocated(error)) return
      call test%check(index(effective_input(case), needle) > 0, needle//' is written')
      call case_from_text(effective_input(case), again, error)
      call test%check_no_error(error, needle//', again')
      if (allocated(error)) return
      call test%check_equal(effective_input(again), effective_input(case), needle//', same text')
      call test%check_equal(case_identity(again), case_identity(case), needle//', same identity')
   end subroutine check_text

end program test_case_lubricant
