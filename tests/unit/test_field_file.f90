!> The file of a case: quantities, history and fields come back bit for bit with units and long names.
program test_field_file
   use ehlwave_case_account, only: blank_result
   use ehlwave_case_completion, only: complete_case
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: make_plan
   use ehlwave_case_result, only: case_result_t
   use ehlwave_case_text, only: case_identity, effective_input
   use ehlwave_errors, only: error_t
   use ehlwave_field_file, only: write_case_file
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t
   use hdf5_readback, only: attribute_of, numbers_of
   use testing, only: test_t
   implicit none (type, external)

   character(len=*), parameter :: path = 'test_field_file.h5'
   type(test_t) :: test
   type(case_t) :: case
   type(case_plan_t) :: plan
   type(case_result_t) :: result
   type(error_t), allocatable :: error

   call make_result()
   call write_case_file(path, case, plan, result, error)
   call test%check_no_error(error, 'write')
   call check_quantities()
   call check_arrays()
   call check_unwritable()
   call test%finish()

contains

   subroutine make_result()
      integer :: i
      case%load_parameter_m = 100
      case%lubricant_parameter_l = 12.05_dp
      case%radius_ratio_d = 1
      case%cells_x = 64
      case%cells_y = 64
      call complete_case(case, '', error)
      if (.not. allocated(error)) call make_plan(case, plan, error)
      call test%check_no_error(error, 'case')
      result = blank_result(case, plan)
      result%message = 'a message'
      result%central_film = 1/3.0_dp
      result%time = [0.1_dp, 0.2_dp]
      result%film_history = [0.3_dp, 0.4_dp]
      result%x = [1.0_dp, 2.0_dp, 3.0_dp]
      result%y = [0.0_dp, 0.5_dp]
      result%p = reshape([(sin(1.0_dp*i), i=1, 6)], [3, 2])
      result%h = 2*result%p
   end subroutine make_result

   subroutine check_quantities()
      call test%check_equal(attribute_of(path, '/', 'format'), 'ehlwave-case', 'format')
      call test%check_equal(attribute_of(path, '/', 'case_id'), case_identity(case), 'identity')
      call test%check_equal(attribute_of(path, '/', 'effective_input'), effective_input(case), 'effective input')
      call test%check_equal(attribute_of(path, '/', 'status'), 'pending', 'status')
      call test%check_equal(attribute_of(path, '/', 'message'), 'a message', 'message')
      call test%check_close(numbers_of(path, 'central_film'), [1/3.0_dp], 'film', relative=0.0_dp)
      call test%check_equal(attribute_of(path, 'central_film', 'units'), '1', 'unit')
      call test%check_equal(attribute_of(path, 'central_film', 'long_name'), 'smooth central film thickness H(0,0)', 'long name')
      call test%check_equal(attribute_of(path, 'harmonic_phase', 'units'), 'rad', 'unit of a phase')
      call test%check_equal(size(numbers_of(path, 'semi_axis_a_m')), 0, 'no lengths without dimensions')
   end subroutine check_quantities

   subroutine check_arrays()
      call test%check_close(numbers_of(path, 'time'), result%time, 'time', relative=0.0_dp)
      call test%check_close(numbers_of(path, 'film_at_centre'), result%film_history, 'film at the centre', relative=0.0_dp)
      call test%check_equal(size(numbers_of(path, 'approach')), 0, 'no approach where there is none')
      call test%check_close(numbers_of(path, 'pressure'), reshape(result%p, [6]), 'pressure', relative=0.0_dp)
      call test%check_close(numbers_of(path, 'film'), reshape(result%h, [6]), 'film', relative=0.0_dp)
      call test%check_equal(attribute_of(path, 'film', 'long_name'), 'H = h/c of the last solution', 'long name of a field')
      call test%check_equal(attribute_of(path, 'x', 'NAME'), 'x', 'X is a scale')
   end subroutine check_arrays

   subroutine check_unwritable()
      call write_case_file('no-such-folder/file.h5', case, plan, result, error)
      call test%check_error(error, 'no-such-folder', 'not written')
   end subroutine check_unwritable

end program test_field_file
