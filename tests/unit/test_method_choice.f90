!> Which cases are solved by FAS without being asked, and how well.
program test_method_choice
   use ehlwave_case_completion, only: complete_case
   use ehlwave_case_definition, only: case_t
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test
   type(case_t) :: case

   call check(sample(100.0_dp, 512), 'newton', 1e-6_dp, 'a light load on a grid of usual size')
   call check(sample(1000.0_dp, 384), 'newton', 1e-6_dp, 'a heavy load on a small grid')
   call check(sample(1000.0_dp, 512), 'fas', 1.5e-3_dp, 'a heavy load')
   call check(sample(100.0_dp, 1024), 'fas', 5*0.172_dp*100*(4/1024.0_dp)**2, 'a large grid')

   case = sample(20.0_dp, 512)
   case%oil%viscosity_law = 'barus'
   call check(case, 'fas', 1.5e-3_dp, 'a steep spike')
   case%cells_x = 8192
   call check(case, 'fas', 50*0.172_dp*20*(4/8192.0_dp)**2, 'on a grid whose own error is small')
   case = sample(1000.0_dp, 512)
   case%has_free_tolerance = .false.
   call check(case, 'fas', 1e-6_dp, 'a tolerance that was given')
   case = sample(1000.0_dp, 0)
   case%accuracy = 1e-6_dp
   case%scheme = 'averaged'
   call check(case, 'fas', 5e-6_dp, 'a grid that the plan chooses')
   case = sample(1000.0_dp, 512)
   case%method = 'newton'
   call check(case, 'newton', 1e-6_dp, 'a method that was given')
   case = sample(1000.0_dp, 512)
   case%orientation = 'transverse'
   case%wavelength_over_a = 0.5_dp
   call check(case, 'newton', 1e-6_dp, 'time steps')
   case%response = 'harmonic'
   call check(case, 'fas', 1.5e-3_dp, 'a linear response')
   case%sensitivities = .true.
   call check(case, 'newton', 1e-6_dp, 'derivatives by the oil')
   case = sample(1000.0_dp, 512)
   case%effects%starvation%oil_over_flooded = 0.5_dp
   call check(case, 'newton', 1e-6_dp, 'too little oil')
   case = sample(1000.0_dp, 512)
   case%radius_ratio_d = 0
   call check(case, 'newton', 1e-6_dp, 'a line contact')
   call test%finish()

contains

   function sample(m, cells) result(case)
      real(dp), intent(in) :: m
      integer, intent(in) :: cells
      type(case_t) :: case
      case%load_parameter_m = m
      case%lubricant_parameter_l = 12.05_dp
      case%radius_ratio_d = 1
      case%cells_x = cells
      case%cells_y = cells
      case%has_free_tolerance = .true.
   end function sample

   pure function expected_name(method) result(name)
      character(len=*), intent(in) :: method
      character(len=:), allocatable :: name
      name = method
      if (method == 'fas') name = method//'f'   ! method and its cycle
   end function expected_name

   subroutine check(given, method, tolerance, name)
      type(case_t), intent(in) :: given
      character(len=*), intent(in) :: method, name
      real(dp), intent(in) :: tolerance
      type(case_t) :: case
      type(error_t), allocatable :: error
      case = given
      call complete_case(case, '', error)
      call test%check_no_error(error, name)
      call test%check_equal(trim(case%method)//trim(case%cycle), expected_name(method), name)
      call test%check_close(case%tolerance, tolerance, name, relative=1e-12_dp)
   end subroutine check

end program test_method_choice
