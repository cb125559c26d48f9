!> A case whose surfaces may touch: on its mesh and on wider ones, from which its errors follow.
module ehlwave_touching_case
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_case_account, only: add_warning, blank_result, end_early, take_report
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_lubricant, only: extrapolation_text
   use ehlwave_case_plan, only: make_plan
   use ehlwave_case_result, only: case_result_t
   use ehlwave_clock, only: peak_memory_mib, wall_seconds
   use ehlwave_errors, only: error_t
   use ehlwave_given, only: given_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_march_keeper, only: march_keeper_t
   use ehlwave_monitor, only: go_on, monitor_t, stop_now
   use ehlwave_planned_case, only: case_plan_t, run_march
   use ehlwave_shared_steady, only: grid_of
   use ehlwave_shear_result, only: is_impossible
   use ehlwave_shear_stress, only: knows_stress, mean_shear_stress
   use ehlwave_solve_report, only: solve_report_t
   use ehlwave_status, only: is_success, status_converged, status_unresolved
   use ehlwave_text, only: to_text
   use ehlwave_touching_continuation, only: reach_share, reach_speed, start_steady
   use ehlwave_touching_march, only: count_steps, march_touching, unrest
   use ehlwave_touching_march_state, only: most_meshes, touching_march_t
   use ehlwave_touching_newton, only: touching_solver_t
   use ehlwave_touching_account_result, only: error_of, state_of, touching_values_t
   use ehlwave_touching_sensitivity, only: find_touching_sensitivities
   use ehlwave_touching_state, only: new_touching_law, prolonged, rough_at_rest, touching_state_t
   use ehlwave_work_unit, only: work_unit_operations, work_unit_seconds
   implicit none (type, external)
   private
   public :: run_touching

   integer, parameter :: fewest_cells = 48     !! of a wider mesh,
   integer, parameter :: fewest_point_cells = 16   !! and of an elliptical contact

contains

   !> Run a case on its mesh, after the same on meshes two and four times as wide, whose states begin its own.
   subroutine run_touching(case, plan, monitor, result, keeper)
      type(case_t), intent(in) :: case              !! completed input
      type(case_plan_t), intent(in) :: plan
      class(monitor_t), intent(inout) :: monitor
      type(case_result_t), intent(out) :: result
      class(march_keeper_t), intent(inout), optional :: keeper   !! of the march on the mesh at work
      type(case_plan_t), allocatable :: plans(:)
      type(touching_march_t) :: march
      type(touching_solver_t) :: solver
      type(touching_state_t) :: state
      real(dp) :: start
      integer :: first, n
      logical :: has_coarser

      start = wall_seconds()
      result = blank_result(case, plan)
      call plan_meshes(case, plan, plans)
      first = size(plans)
      if (present(keeper) .and. plan%kind == run_march) call take_up(case, plans, keeper, march, first)
      has_coarser = .false.
      do n = first, 1, -1
         result%message = ''
         result%status = status_converged
         result%residual = 0
         result%load_error = 0
         if (march%steps > 0) then
            call lay_out(case, plans(n), solver)
         else
            call find_steady(case, plans(n), monitor, n == 1, has_coarser, solver, march%steady, result)
         end if
         has_coarser = result%status == status_converged
         if (has_coarser .and. plan%kind == run_march) then
            call march_touching(case, plans(n), monitor, solver, march, state, result, keeper)
         else if (has_coarser) then
            state = march%steady
            call march%values%take(solver, state)
         end if
         if (monitor%request == stop_now .and. present(keeper)) call keeper%save()
         if (monitor%request /= go_on) then
            call end_early(monitor%request, 'mesh '//to_text(size(plans) - n + 1)//' of '//to_text(size(plans)), result)
            return
         end if
         if (result%status == status_converged) march%meshes(n) = march%values
         march%steps = 0
         march%values = touching_values_t()
      end do
      if (result%status == status_converged) then
         n = findloc(ieee_is_finite(march%meshes%share), .false., 1) - 1
         if (n < 0) n = most_meshes
         result%effects%touching%account%touching_values_t = march%meshes(1)
         result%effects%touching%account%planned_meshes = size(plans)
         result%effects%touching%seeks_speed = case%effects%touching%data%seeks_speed()
         call estimate_errors(case, plan, march%meshes(:n), result)
         call take_solution(case, plan, solver, state, result)
      end if
      result%work = solver%work()
      if (case%sensitivities .and. is_success(result%status)) &
         call find_touching_sensitivities(case, plan, solver, state, result)
      result%seconds = wall_seconds() - start
      if (present(keeper)) result%seconds = result%seconds + keeper%seconds_before
      if (allocated(solver%problem%deformation)) result%own_convolution = solver%problem%deformation%convolution
      if (result%own_convolution > 0) result%own_units = result%work/result%own_convolution
      result%work_units = result%seconds/work_unit_seconds(plan%cells_x, plan%cells_y)
      result%counted_work_units = result%work/work_unit_operations(plan%cells_x, plan%cells_y)
      result%all_work = solver%work()
      result%total_work_units = result%all_work/work_unit_operations(plan%cells_x, plan%cells_y)
      result%peak_memory_mib = peak_memory_mib()
   end subroutine run_touching

   !> Plans of the case on its mesh and on wider ones, the finest first.
   subroutine plan_meshes(case, plan, plans)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(case_plan_t), allocatable, intent(out) :: plans(:)
      type(case_t) :: wider
      type(case_plan_t) :: wider_plan
      type(error_t), allocatable :: error
      integer :: n

      plans = [plan]
      wider = case
      do n = 1, most_meshes - 1
         if (modulo(plan%cells_x, 2**n) /= 0) return
         wider%cells_x = plan%cells_x/2**n
         if (plan%conditions%is_line()) then
            if (wider%cells_x < fewest_cells) return
         else
            if (modulo(plan%cells_y, 2**(n + 1)) /= 0 .or. wider%cells_x < fewest_point_cells) return
            wider%cells_y = plan%cells_y/2**n
         end if
         call make_plan(wider, wider_plan, error, plan%domain_scale)
         if (allocated(error)) return
         plans = [plans, wider_plan]
      end do
   end subroutine plan_meshes

   !> Take up a march that an earlier run left, on whichever mesh that was; without one `first` stays.
   subroutine take_up(case, plans, keeper, march, first)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plans(:)      !! the finest first
      class(march_keeper_t), intent(inout) :: keeper
      type(touching_march_t), intent(inout) :: march
      integer, intent(inout) :: first                !! mesh to begin with
      integer :: n

      do n = 1, size(plans)
         call march%make_room(grid_of(case, plans(n)), plans(n)%steps, plans(n)%steps_per_cell)
         call keeper%load(march)
         if (march%steps > 0) first = n
         if (march%steps > 0) return
      end do
   end subroutine take_up

   !> The steady state of a mesh: of a wave at rest with the wave, else of smooth surfaces.
   subroutine find_steady(case, plan, monitor, is_finest, has_coarser, solver, state, result)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      class(monitor_t), intent(inout) :: monitor
      logical, intent(in) :: is_finest, has_coarser      !! whether `state` is the solution of the mesh twice as wide
      type(touching_solver_t), intent(inout) :: solver
      type(touching_state_t), intent(inout) :: state
      type(case_result_t), intent(inout) :: result
      type(touching_state_t) :: first
      type(solve_report_t) :: report
      real(dp), allocatable :: rough(:, :)

      if (has_coarser) first = prolonged(state, grid_of(case, plan))
      call lay_out(case, plan, solver)
      associate (grid => solver%problem%grid)
         call grid%new_field(rough)
         if (plan%kind /= run_march .and. plan%surfaces%is_rough()) &
            rough = rough_at_rest(plan%surfaces%list, case%phase_deg, grid)
      end associate
      call solver%given%set_rough(rough)
      report%status = status_unresolved
      if (has_coarser) then
         if (case%effects%touching%data%seeks_speed()) then
            call solver%solve(first, report, case%effects%touching%data%share)
         else
            call solver%solve(first, report)
         end if
         if (report%status == status_converged) state = first
      end if
      if (report%status /= status_converged) then
         call start_steady(solver, state, report)
         if (report%status == status_converged .and. case%effects%touching%data%seeks_speed()) then
            call reach_share(solver, state, case%effects%touching%data%share, monitor, report)
         else if (report%status == status_converged) then
            call reach_speed(solver, state, plan%conditions%data%mean_speed_m_per_s, monitor, report)
         end if
      end if
      call count_steps(report, result)
      if (is_finest .or. report%status /= status_converged) call take_report(report, 'steady state with touching', &
         result)
   end subroutine find_steady

   !> The contact on the mesh of a plan.
   subroutine lay_out(case, plan, solver)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(touching_solver_t), intent(inout) :: solver
      if (allocated(solver%past%f)) deallocate (solver%past%f, solver%past%passed)
      solver%given = given_t()
      solver%law = new_touching_law(case%effects%touching%data, plan%conditions)
      call solver%problem%init(grid_of(case, plan), plan%conditions, plan%rheology)
      solver%largest_steps = case%largest_steps
      call solver%begin()
   end subroutine lay_out

   !> Friction coefficient of the solids, with the sign of sliding.
   elemental real(dp) function solid_friction(case, plan, share) result(friction)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      real(dp), intent(in) :: share
      friction = 0
      if (abs(plan%conditions%slip_parameter - 1) > 0) friction = &
         sign(case%effects%touching%data%solid_friction*share, plan%conditions%slip_parameter - 1)
   end function solid_friction

   !> Errors by the mesh, and of a march by its unrest. The relative error of friction is NaN without a wider mesh or
   !> sliding.
   subroutine estimate_errors(case, plan, levels, result)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(touching_values_t), intent(in) :: levels(:)   !! the finest first
      type(case_result_t), intent(inout) :: result
      real(dp) :: friction(size(levels)), unsettled(3)

      associate (account => result%effects%touching%account)
         unsettled = 0
         if (plan%kind == run_march) unsettled = &
            [unrest(plan, account%share_history), unrest(plan, account%area_history), &
             unrest(plan, account%friction_history + solid_friction(case, plan, account%share_history))]
         call account%estimate(levels(2:), plan%hx, unsettled(:2))
         result%friction_error = no_value
         friction = levels%friction_oil + solid_friction(case, plan, levels%share)
         if (size(levels) > 1 .and. abs(friction(1)) > 0) &
            result%friction_error = (error_of(friction) + unsettled(3))/abs(friction(1))
      end associate
   end subroutine estimate_errors

   !> Films, friction, fields and warnings of the last solution.
   subroutine take_solution(case, plan, solver, state, result)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(touching_solver_t), intent(in) :: solver
      type(touching_state_t), intent(in) :: state
      type(case_result_t), intent(inout) :: result
      real(dp), allocatable :: stress(:, :)

      associate (problem => solver%problem, touching => result%effects%touching%account)
         result%central_film = problem%grid%value_at_centre(state%h)
         result%minimum_film = minval(state%h)
         result%central_film_moes = result%central_film*problem%conditions%moes_film_factor
         result%max_pressure = maxval(state%p)
         touching%mass_error = result%residual
         touching%solid_friction = solid_friction(case, plan, touching%share)
         call result%shear%take(problem, state_of(state), stress)
         result%shear%friction_coefficient = touching%friction_oil
         call result%shear%drop_impossible(problem, state_of(state))
         touching%friction_oil = result%shear%friction_coefficient
         if (allocated(touching%friction_history)) &
            where (is_impossible(touching%friction_history)) touching%friction_history = no_value
         result%shear%friction_coefficient = touching%friction_oil + touching%solid_friction
         call result%shear%estimate_temperatures(problem%conditions, result%central_film)
         if (.not. ieee_is_finite(touching%friction_oil)) result%friction_error = no_value
         call add_warning(result, touching%warning())
         call add_warning(result, result%shear%warning(case%oil%shear_limit_over_pressure > 0, .false.))
         call add_warning(result, extrapolation_text(case, plan%rheology, result%max_pressure))
         if (case%fields) then
            allocate (result%x, source=problem%grid%x)
            allocate (result%y, source=problem%grid%y)
            allocate (result%p, source=state%p)
            allocate (result%h, source=state%h)
            allocate (touching%c, source=state%c)
            allocate (touching%theta, source=state%theta)
            if (knows_stress(problem%conditions)) call mean_shear_stress(problem, state_of(state), &
               result%shear_stress_pa)
         end if
      end associate
      result%is_resolved = plan%resolution%is_resolved .and. .not. result%effects%touching%account%is_artefact
      if (result%is_resolved) return
      result%status = status_unresolved
      result%message = plan%resolution%reason
      if (result%effects%touching%account%is_artefact) result%message = result%effects%touching%account%warning()
   end subroutine take_solution

end module ehlwave_touching_case
