!> A finer plan of a case whose error turned out larger than was asked for.
module ehlwave_plan_refinement
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_files, only: file_changed_since, file_digests
   use ehlwave_case_plan, only: make_plan
   use ehlwave_domain_choice, only: may_enlarge
   use ehlwave_error_parts, only: error_parts_t
   use ehlwave_errors, only: error_t
   use ehlwave_grid_choice, only: smallest_size
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t, run_march, run_standing
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: refine_plan

   real(dp), parameter :: aim = 0.75_dp            !! share of the accuracy left to the mesh: estimates scatter
   real(dp), parameter :: largest_factor = 3       !! factor on the cells in a direction, at once
   real(dp), parameter :: smallest_factor = 1.1_dp, step_back = 0.85_dp   !! the same, where the work that is left is
                                                                          !! not enough
   real(dp), parameter :: largest_domain_share = 0.4_dp   !! share of the accuracy, from which on the domain is doubled

contains

   !> Cells as the mesh error requires, and twice the domain where the domain error is large, within the free keys of
   !> the case and its limits. False where nothing can be made finer, or that would not help.
   !>
   !> Its cells are limited by the work left, if it takes as many times its plan as this one.
   subroutine refine_plan(case, plan, parts, work_taken, work_left, finer, is_finer)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(error_parts_t), intent(in) :: parts       !! errors of the result of the plan
      real(dp), intent(in) :: work_taken             !! by the run of the plan, operations
      real(dp), intent(in) :: work_left              !! operations
      type(case_plan_t), intent(out) :: finer
      logical, intent(out) :: is_finer
      type(case_t) :: copy
      type(error_t), allocatable :: error
      real(dp) :: factor, first_order, room, scale

      is_finer = .false.
      first_order = sum(parts%by_effect)
      room = case%accuracy - (parts%total() - parts%mesh - first_order)
      copy = case
      copy%accuracy = 0                             ! accuracy 0: choices are made here
      copy%time_step_over_cell = real(plan%cells_per_step, dp)/plan%steps_per_cell
      scale = plan%domain_scale
      if (parts%domain > largest_domain_share*case%accuracy .and. may_enlarge(case, scale)) then
         scale = 2*plan%domain_scale
         room = room + 0.5_dp*parts%domain
      end if
      if (.not. room > 0) return
      if (plan%is_fitted) then                          ! films have errors of order 2 to 3, waves of higher order
         factor = (parts%mesh/(aim*room))**(1/3.0_dp)
      else                                              ! mesh/factor^2 + first_order/factor = aim room
         factor = 0.5_dp*(first_order + sqrt(first_order**2 + 4*parts%mesh*aim*room))/(aim*room)
      end if
      factor = min(max(1.0_dp, factor), largest_factor)
      factor = factor*scale/plan%domain_scale
      do
         copy%cells_x = plan%cells_x
         copy%cells_y = plan%cells_y
         if (case%cells_x == 0) copy%cells_x = smallest_size(factor*plan%cells_x, case%largest_cells)
         if (case%cells_y == 0) copy%cells_y = smallest_size(factor*plan%cells_y, case%largest_cells)
         if (factor < smallest_factor .or. (copy%cells_x <= plan%cells_x .and. copy%cells_y <= plan%cells_y)) return
         call make_plan(copy, finer, error, scale)
         if (allocated(error)) return
         if (file_changed_since(finer%files, file_digests(plan%files)) > 0) return   ! since the case began
         if (expected_work(plan, finer, work_taken) <= work_left) exit
         factor = step_back*factor
      end do
      finer%largest_work = min(finer%largest_work, work_left)
      finer%grid_reason = 'refined for an accuracy of '//to_text(case%accuracy, 3)
      is_finer = .true.
   end subroutine refine_plan

   !> Work to expect of a finer plan, by its model and by the work that the plan before has taken. Measured in marches
   !> (128 to 384 cells along X): their work grows with the power 3.4 to 3.6 of the cells, which for twice the cells is
   !> 1.3 times the model; standing patterns took up to 1.5 times the model.
   real(dp) function expected_work(plan, finer, work_taken)
      type(case_plan_t), intent(in) :: plan, finer
      real(dp), intent(in) :: work_taken             !! by the run of `plan`, operations
      real(dp), parameter :: margin = 1.4_dp
      expected_work = finer%expected_work()*max(1.0_dp, work_taken/plan%expected_work())
      if (plan%kind == run_march .or. plan%kind == run_standing) expected_work = margin*expected_work
   end function expected_work

end module ehlwave_plan_refinement
