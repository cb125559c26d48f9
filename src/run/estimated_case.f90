!> Runs a planned case and estimates the discretisation error of its Ad/Ai.
module ehlwave_estimated_case
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_files, only: file_changed_since, file_digests
   use ehlwave_case_plan, only: make_plan
   use ehlwave_case_result, only: case_result_t
   use ehlwave_case_runner, only: run_case
   use ehlwave_clock, only: wall_seconds
   use ehlwave_error_factors, only: amplitude_ratio
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_march_keeper, only: march_keeper_t
   use ehlwave_mesh_errors, only: kind_of, mesh_error, mesh_error_t
   use ehlwave_monitor, only: go_on, monitor_t, stop_now
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_resolution, only: telling_inlet, telling_points_per_wave, times_as_wide
   use ehlwave_shared_steady, only: shared_steady_t
   use ehlwave_status, only: is_success, status_interrupted, status_over_budget, status_pending
   use ehlwave_touching_case, only: run_touching
   use ehlwave_work_unit, only: work_unit_operations
   implicit none (type, external)
   private
   public :: run_estimated_case

   integer, parameter :: fewest_cells = 24   !! cells of a useful coarser grid

   !> Asked to stop, the coarse runs are finished if that takes no longer.
   real(dp), parameter :: largest_delay_s = 10

   !> Passes on progress and requests of a coarse run.
   type, extends(monitor_t) :: relay_t
      class(monitor_t), pointer :: whole => null()   ! monitor of the case
      real(dp) :: asked_s = huge(1.0_dp)             ! wall_seconds when it was to stop first
   contains
      procedure :: step_done => pass_on
   end type relay_t

contains

   !> Run a case as planned; with `error_estimate = 'coarse_grid'` also on grids of two and four times the mesh
   !> size and time step (about a tenth of the cost), where these are useful, for a Richardson estimate; the
   !> expected error by the step tolerance is added, as no grid shows it. Otherwise the estimate is the expected
   !> error of the plan, if any. Linear responses come with their own estimate, `harmonic_error`; without a
   !> transient there is none of its Ad/Ai. `shared`: see run_case.
   !>
   !> `keeper` keeps the march of the case itself; stopped in a coarse run, the case counts as interrupted, and its
   !> coarse runs start again. When its time is up in a coarse run, the plan gives the estimate.
   subroutine run_estimated_case(case, plan, monitor, result, shared, keeper)
      type(case_t), intent(in) :: case              !! completed input
      type(case_plan_t), intent(in) :: plan
      class(monitor_t), intent(inout) :: monitor
      type(case_result_t), intent(out) :: result
      type(shared_steady_t), intent(inout), target, optional :: shared
      class(march_keeper_t), intent(inout), optional :: keeper   !! see `run_case`
      real(dp), allocatable :: ratios(:, :)   ! values of each surface
      real(dp) :: seconds
      integer :: status

      if (case%effects%touching%is_given()) then
         call run_touching(case, plan, monitor, result, keeper)
         return
      end if
      call run_case(case, plan, monitor, result, shared, keeper)
      if (.not. plan%surfaces%is_rough() .or. .not. is_success(result%status)) return
      if (.not. any(ieee_is_finite(result%ratios(size(plan%surfaces%list))))) return
      call take_ratio_error(plan, reshape(result%ratios(size(plan%surfaces%list)), &
                            [size(plan%surfaces%list), 1]), result)
      if (case%error_estimate /= 'coarse_grid') return

      call coarse_ratios(case, plan, monitor, result, ratios, seconds, status)
      if (status == status_interrupted) then
         result%status = status
         if (present(keeper)) call keeper%save()
      end if
      if (status == status_interrupted .or. status == status_over_budget) return
      result%work_units = result%work_units*(1 + seconds/result%seconds)
      result%seconds = result%seconds + seconds
      result%total_work_units = result%all_work/work_unit_operations(plan%cells_x, plan%cells_y)
      call take_ratio_error(plan, reshape([result%ratios(size(plan%surfaces%list)), ratios], &
                                          [size(ratios, 1), size(ratios, 2) + 1]), result)
   end subroutine run_estimated_case

   !> Relative error of Ad/Ai, the larger of two surfaces, with the parts by time steps and their tolerance. The
   !> response to the same waves, if available, has no smaller error.
   subroutine take_ratio_error(plan, ratios, result)
      type(case_plan_t), intent(in) :: plan
      real(dp), intent(in) :: ratios(:, :)           !! ratios of each surface, finer grid first
      type(case_result_t), intent(inout) :: result
      type(mesh_error_t) :: error
      real(dp) :: largest
      integer :: n

      largest = 0
      do n = 1, size(ratios, 1)
         if (.not. ieee_is_finite(ratios(n, 1))) cycle
         error = mesh_error(amplitude_ratio, kind_of(plan%is_fitted, plan%conditions%is_line()), ratios(n, :), &
                            plan%expected_ratio_mesh_error(result%central_film))
         largest = max(largest, error%relative)
         result%amplitude_error_basis = error%basis
      end do
      if (ieee_is_finite(result%harmonic%error)) largest = max(largest, result%response_error())
      result%amplitude_ratio_error = largest + result%effects%film_error() + plan%expected%time &
                                     + plan%expected%algebraic
   end subroutine take_ratio_error

   !> Ad/Ai of the same case on grids of two and four times the mesh size, as far as they converge and are not
   !> hopelessly coarse, and as long as the monitor lets them go on.
   subroutine coarse_ratios(case, plan, monitor, result, ratios, seconds, status)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      class(monitor_t), intent(inout), target :: monitor
      type(case_result_t), intent(inout) :: result      !! result of the case: its work grows
      real(dp), allocatable, intent(out) :: ratios(:, :)   !! ratios of each surface, finer grid first
      real(dp), intent(out) :: seconds                  !! time of these runs
      integer, intent(out) :: status                    !! status of the last run
      type(case_t) :: coarse_case
      type(case_plan_t) :: coarse_plan
      type(case_result_t) :: coarse_result
      type(error_t), allocatable :: error
      type(relay_t) :: relay
      integer :: cells(2), factor

      allocate (ratios(size(plan%surfaces%list), 0))
      seconds = 0
      status = status_pending
      relay%whole => monitor
      coarse_case = case
      coarse_case%fields = .false.
      coarse_case%fields_every = 0
      coarse_case%sensitivities = .false.
      if (plan%is_fitted) coarse_case%scheme = 'fitted'
      coarse_case%accuracy = 0                    ! belongs to the case itself
      if (case%response /= 'periodic') coarse_case%response = 'transient'   ! others have their own estimate
      coarse_case%time_step_over_cell = 1.0_dp/plan%steps_per_cell   ! long steps have a part of their own
      cells = [plan%cells_x, plan%cells_y]
      if (plan%conditions%is_line()) cells(2) = cells(1)
      do factor = 2, 4, 2
         if (any(modulo(cells, 2*factor) /= 0 .or. cells/factor < fewest_cells)) return
         coarse_case%cells_x = cells(1)/factor
         if (.not. plan%conditions%is_line()) coarse_case%cells_y = cells(2)/factor
         call make_plan(coarse_case, coarse_plan, error, plan%domain_scale)
         if (allocated(error)) return
         if (file_changed_since(coarse_plan%files, file_digests(plan%files)) > 0) return   ! since the case began
         if (.not. can_tell(coarse_plan)) return
         coarse_plan%largest_work = min(coarse_plan%largest_work, plan%largest_work - result%all_work)
         if (coarse_plan%largest_work <= 0) return
         call run_case(coarse_case, coarse_plan, relay, coarse_result)
         result%all_work = result%all_work + coarse_result%all_work
         seconds = seconds + coarse_result%seconds
         status = coarse_result%status
         if (.not. is_success(status)) return
         ratios = reshape([ratios, coarse_result%ratios(size(ratios, 1))], [size(ratios, 1), size(ratios, 2) + 1])
      end do
   end subroutine coarse_ratios

   subroutine pass_on(self, stage, done, total)
      class(relay_t), intent(inout) :: self
      character(len=*), intent(in) :: stage
      integer, intent(in) :: done, total
      call self%whole%step_done('coarser grid: '//stage, done, total)
      self%request = self%whole%request
      if (self%request /= stop_now) return
      self%asked_s = min(self%asked_s, wall_seconds())
      if (wall_seconds() - self%asked_s < largest_delay_s) self%request = go_on
   end subroutine pass_on

   !> Whether a grid is fine enough for a meaningful difference.
   pure logical function can_tell(plan)
      type(case_plan_t), intent(in) :: plan
      real(dp) :: points(3)
      associate (r => plan%resolution)
         points = [r%points_x, r%points_y, r%samples]
         can_tell = r%inlet <= telling_inlet*times_as_wide(plan%is_fitted) .and. &
                    all(points <= 0 .or. points >= telling_points_per_wave - 1e-9_dp)
      end associate
   end function can_tell

end module ehlwave_estimated_case
