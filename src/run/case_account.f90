!> The account of a case: a result that is blank at first and accumulates solutions.
module ehlwave_case_account
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_formula, only: amplitude_formula, anisotropy_factor, wave_parameter_v, wave_parameter_v2
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_solve_report, only: solve_report_t
   use ehlwave_monitor, only: give_up, stop_now
   use ehlwave_status, only: is_success, status_interrupted, status_name, status_over_budget
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: add_warning, blank_result, end_early, keep_history, refused_result, take_report, worse

contains

   !> Result of a case of which only its input is known.
   function blank_result(case, plan) result(result)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(case_result_t) :: result
      result%message = ''
      result%warning = ''
      result%is_resolved = plan%resolution%is_resolved
      if (plan%surfaces%is_rough() .and. .not. plan%surfaces%is_measured()) then
         result%v = wave_parameter_v(plan%conditions, case%wavelength_over_a)
         result%v2 = wave_parameter_v2(plan%conditions, case%wavelength_over_a)
         result%f_r = anisotropy_factor(case%wavelength_x_over_a, case%wavelength_y_over_a)
         result%formula_ratio = amplitude_formula(result%f_r*result%v)
         if (.not. plan%conditions%l > 0) then   ! V is infinite
            result%v = no_value
            result%v2 = no_value
            result%formula_ratio = no_value
         end if
      end if
   end function blank_result

   !> Result of a case that is not begun.
   function refused_result(case, plan, reason) result(result)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      character(len=*), intent(in) :: reason
      type(case_result_t) :: result
      result = blank_result(case, plan)
      result%status = status_over_budget
      result%message = reason
   end function refused_result

   !> Add a solution to the account of the case.
   subroutine take_report(report, what, result)
      type(solve_report_t), intent(in) :: report
      character(len=*), intent(in) :: what
      type(case_result_t), intent(inout) :: result
      result%status = report%status
      result%residual = worse(result%residual, report%residual)
      result%load_error = worse(result%load_error, report%load_error)
      result%nonlinear_steps = result%nonlinear_steps + report%nonlinear_steps
      result%linear_steps = result%linear_steps + report%linear_steps
      if (.not. is_success(report%status)) call keep_history(report, result)
      if (.not. is_success(report%status)) result%message = what//' '//status_name(report%status)//' after '// &
         to_text(report%nonlinear_steps)//' steps, residual '//to_text(report%residual, 3)// &
         ', load error '//to_text(report%load_error, 3)
   end subroutine take_report

   !> Keep the residuals of a solution that failed, if it took a step at all.
   subroutine keep_history(report, result)
      type(solve_report_t), intent(in) :: report
      type(case_result_t), intent(inout) :: result
      if (allocated(report%history)) result%residual_history = report%history
   end subroutine keep_history

   !> The larger of two errors; NaN, which max() passes over, is the largest.
   pure real(dp) function worse(first, second)
      real(dp), intent(in) :: first, second
      worse = max(first, second)
      if (ieee_is_nan(first)) worse = first
      if (ieee_is_nan(second)) worse = second
   end function worse

   !> A case that the monitor does not let go on.
   subroutine end_early(request, reached, result)
      integer, intent(in) :: request
      character(len=*), intent(in) :: reached   !! how far it came
      type(case_result_t), intent(inout) :: result
      if (request == stop_now) result%status = status_interrupted
      if (request == give_up) then
         result%status = status_over_budget
         result%message = 'the time of the case was up at '//reached
      end if
   end subroutine end_early

   !> Append to the warnings of a result; '' adds none.
   subroutine add_warning(result, text)
      type(case_result_t), intent(inout) :: result
      character(len=*), intent(in) :: text
      if (text == '') return
      if (len(result%warning) > 0) result%warning = result%warning//'; '
      result%warning = result%warning//text
   end subroutine add_warning

end module ehlwave_case_account
