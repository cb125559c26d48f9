!> Plans of cases that are legal.
module sample_plan
   use ehlwave_case_completion, only: complete_case
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: make_plan
   use ehlwave_errors, only: error_t
   use ehlwave_planned_case, only: case_plan_t
   use testing, only: test_t
   implicit none (type, external)
   private
   public :: plan_of

contains

   !> The plan of a case, once completed; a refusal is a failure of the test.
   function plan_of(test, given) result(plan)
      type(test_t), intent(inout) :: test
      type(case_t), intent(in) :: given
      type(case_plan_t) :: plan
      type(case_t) :: case
      type(error_t), allocatable :: error
      case = given
      call complete_case(case, '', error)
      if (.not. allocated(error)) call make_plan(case, plan, error)
      call test%check_no_error(error, 'plan')
   end function plan_of

end module sample_plan
