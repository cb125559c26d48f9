!> Runs a case, and again on finer grids if its estimated error is above the `accuracy` of the input.
module ehlwave_refined_case
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_case_account, only: add_warning
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_error_account, only: errors_text, take_errors
   use ehlwave_error_parts, only: error_parts_t
   use ehlwave_error_warning, only: error_warning
   use ehlwave_estimated_case, only: run_estimated_case
   use ehlwave_kinds, only: dp
   use ehlwave_linear_range, only: linear_limit_text
   use ehlwave_memory_plan, only: memory_shortage
   use ehlwave_march_keeper, only: march_keeper_t
   use ehlwave_monitor, only: go_on, monitor_t
   use ehlwave_plan_effort, only: most_finer_work, most_work
   use ehlwave_plan_refinement, only: refine_plan
   use ehlwave_planned_case, only: case_plan_t, run_march, run_smooth
   use ehlwave_quantities, only: add_result
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_shared_steady, only: shared_steady_t
   use ehlwave_status, only: is_success, status_converged, status_inaccurate, status_interrupted
   use ehlwave_text, only: to_text
   use ehlwave_work_unit, only: work_unit_operations
   implicit none (type, external)
   private
   public :: run_refined_case

   integer, parameter :: most_refinements = 3

contains

   !> Run a case, with an accuracy on finer grids, and warn of large errors: see `run_and_refine`.
   subroutine run_refined_case(case, plan, monitor, result, shared, keeper)
      type(case_t), intent(in) :: case              !! completed input
      type(case_plan_t), intent(inout) :: plan
      class(monitor_t), intent(inout) :: monitor
      type(case_result_t), intent(out) :: result
      type(shared_steady_t), intent(inout), target, optional :: shared
      class(march_keeper_t), intent(inout), optional :: keeper
      type(quantity_list_t) :: quantities

      call run_and_refine(case, plan, monitor, result, shared, keeper)
      quantities%has_errors_only = .true.
      call add_result(quantities, case, plan, result)
      call add_warning(result, error_warning(quantities))
   end subroutine run_refined_case

   !> Run a case as planned, see `run_estimated_case`. With an accuracy and flooded edges it is run again on finer grids
   !> while the estimate is above it; `plan` then belongs to the result. A result above the accuracy is `inaccurate`.
   !> With truncated edges, as in old results, the estimate is reported without consequence.
   !>
   !> A case that is stopped in a finer run counts as interrupted; its finer runs start again. When its time is up
   !> there, the previous result is kept.
   subroutine run_and_refine(case, plan, monitor, result, shared, keeper)
      type(case_t), intent(in) :: case              !! completed input
      type(case_plan_t), intent(inout) :: plan
      class(monitor_t), intent(inout) :: monitor
      type(case_result_t), intent(out) :: result
      type(shared_steady_t), intent(inout), target, optional :: shared
      class(march_keeper_t), intent(inout), optional :: keeper
      type(case_plan_t) :: finer
      type(case_result_t) :: again
      real(dp) :: largest_work, taken
      logical :: is_finer

      largest_work = plan%largest_work_in_all
      taken = 0
      if (case%accuracy > 0 .and. case%edges == 'flooded' .and. plan%kind == run_march .and. &
          case%has_heights() .and. .not. case%effects%touching%is_given()) &
         call refine_by_smooth_film(case, plan, monitor, shared, taken)
      call run_estimated_case(case, plan, monitor, result, shared, keeper)
      result%all_work = result%all_work + taken
      result%total_work_units = result%all_work/work_unit_operations(plan%cells_x, plan%cells_y)
      call take_errors(case, plan, result)
      if (.not. case%accuracy > 0 .or. case%edges == 'truncated' .or. result%status /= status_converged) return
      taken = result%all_work
      do while (result%error_estimate > case%accuracy .and. result%refinements < most_refinements)
         if (monitor%request /= go_on) exit
         call refine_plan(case, plan, parts_of(case, result), taken, largest_work - result%all_work, finer, &
                          is_finer)
         if (.not. is_finer) exit
         if (memory_shortage(finer) /= '') exit
         call run_estimated_case(case, finer, monitor, again, shared)
         if (again%status == status_interrupted) then
            result%status = status_interrupted
            if (present(keeper)) call keeper%save()
            return
         end if
         if (.not. is_success(again%status)) then
            result%all_work = result%all_work + again%all_work
            result%total_work_units = result%all_work/work_unit_operations(plan%cells_x, plan%cells_y)
            exit
         end if
         taken = again%all_work
         call take_errors(case, finer, again)
         again%work_units = again%work_units*(1 + result%seconds/again%seconds)
         again%work = again%work + result%work
         again%counted_work_units = again%work/work_unit_operations(finer%cells_x, finer%cells_y)
         again%own_units = again%work/again%own_convolution
         again%all_work = again%all_work + result%all_work
         again%total_work_units = again%all_work/work_unit_operations(finer%cells_x, finer%cells_y)
         again%seconds = again%seconds + result%seconds
         again%refinements = result%refinements + 1
         result = again
         plan = finer
      end do
      if (result%status /= status_converged) return
      if (ieee_is_finite(result%error_estimate) .and. result%error_estimate <= case%accuracy) then
         if (is_measured(case, result)) return
         result%status = status_inaccurate
         result%message = 'no coarser grid shows the error: the '//to_text(result%error_estimate, 2)// &
                          ' expected by the plan does not prove the requested accuracy; take other cells'
         return
      end if
      result%status = status_inaccurate
      result%message = 'estimated relative error '//to_text(result%error_estimate, 2)//' ('// &
                       errors_text(parts_of(case, result))//') above the accuracy of '//to_text(case%accuracy, 2)// &
                       advice(case, plan, result)
   end subroutine run_and_refine

   !> A plan as fine as the smooth film needs for the accuracy, before the march of measured heights, whose films have
   !> the same error by the mesh.
   subroutine refine_by_smooth_film(case, plan, monitor, shared, work)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(inout) :: plan
      class(monitor_t), intent(inout) :: monitor
      type(shared_steady_t), intent(inout), target, optional :: shared
      real(dp), intent(out) :: work                !! operations
      type(case_plan_t) :: finer, smooth
      type(case_result_t) :: result
      type(case_t) :: film
      integer :: n
      logical :: is_finer

      work = 0
      film = case
      film%sensitivities = .false.
      do n = 1, most_refinements
         smooth = plan
         smooth%kind = run_smooth
         call run_estimated_case(film, smooth, monitor, result, shared)
         work = work + result%all_work
         if (result%status /= status_converged .or. monitor%request /= go_on) return
         call take_errors(case, smooth, result)
         if (result%error_estimate <= case%accuracy) return
         call refine_plan(case, plan, result%film_errors, 0.0_dp, plan%largest_work_in_all - work, finer, is_finer)
         if (.not. is_finer) return
         if (memory_shortage(finer) /= '') return
         finer%largest_work_in_all = plan%largest_work_in_all
         plan = finer
      end do
   end subroutine refine_by_smooth_film

   !> Whether coarser grids gave the error of the main quantity, unless the model was requested.
   pure logical function is_measured(case, result)
      type(case_t), intent(in) :: case
      type(case_result_t), intent(in) :: result
      if (.not. case%has_ratio()) then
         is_measured = result%film_error_basis /= 'model'
      else if (ieee_is_finite(result%amplitude_ratio_fit)) then
         is_measured = result%amplitude_error_basis /= 'model' .or. case%error_estimate == 'model'
      else
         is_measured = all([result%harmonic%error_basis, result%effects%second%surface%harmonic%error_basis] /= 'model')
      end if
   end function is_measured

   !> Errors of the main quantity.
   type(error_parts_t) function parts_of(case, result)
      type(case_t), intent(in) :: case
      type(case_result_t), intent(in) :: result
      parts_of = merge(result%ratio_errors, result%film_errors, case%has_ratio())
   end function parts_of

   !> Advice on a remedy.
   function advice(case, plan, result) result(text)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result
      character(len=:), allocatable :: by_effect, text
      type(error_parts_t) :: parts
      real(dp) :: others

      parts = parts_of(case, result)
      others = max(parts%mesh, parts%domain, parts%time, parts%algebraic)
      text = ': ask for less, or leave cells and domain to the plan with a larger largest_cells '// &
         '(and &solver largest_total_steps, where finer runs would take a case beyond '// &
         to_text(most_finer_work*most_work, 3)// &
         ' times its plan)'
      by_effect = ''
      if (.not. case%has_ratio()) by_effect = result%effects%advice(plan, parts%total())
      if (by_effect /= '') text = ': '//by_effect
      if (parts%amplitude > others) text = ': take Ai (amplitude_over_film) below '//linear_limit_text(case)// &
         ", or response = 'harmonic'"
      if (parts%settling > max(others, parts%amplitude)) text = ': take more settling_periods, or a later end_time'
   end function advice

end module ehlwave_refined_case
