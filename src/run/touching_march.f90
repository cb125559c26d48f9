!> March of a contact whose surfaces may touch, and mean values over the time that is measured.
module ehlwave_touching_march
   use ehlwave_case_account, only: take_report
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_kinds, only: dp
   use ehlwave_march_keeper, only: march_keeper_t
   use ehlwave_monitor, only: go_on, monitor_t
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_solve_report, only: solve_report_t
   use ehlwave_status, only: status_converged
   use ehlwave_text, only: to_text
   use ehlwave_touching_account_result, only: touching_values_t
   use ehlwave_touching_march_state, only: touching_march_t
   use ehlwave_touching_newton, only: touching_solver_t
   use ehlwave_touching_state, only: touching_state_t
   implicit none (type, external)
   private
   public :: count_steps, march_touching, unrest

   integer, parameter :: most_cuts = 4   !! halvings of the change of the roughness in a step
   real(dp), parameter :: slow = 0.5_dp  !! S of roughness that is closer to rest than to the oil

contains

   !> March in time from the steady state of smooth surfaces, `march%steady`, or on from its steps so far; mean values
   !> over the time that is measured. After any step a march that is stopped goes on with the same bits.
   subroutine march_touching(case, plan, monitor, solver, march, state, result, keeper)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      class(monitor_t), intent(inout) :: monitor
      type(touching_solver_t), intent(inout) :: solver
      type(touching_march_t), intent(inout) :: march
      type(touching_state_t), intent(out) :: state        !! of the last step
      type(case_result_t), intent(inout) :: result
      class(march_keeper_t), intent(inout), optional :: keeper
      type(solve_report_t) :: report
      real(dp) :: film
      integer :: first, k

      state = march%steady
      film = solver%problem%grid%value_at_centre(state%h)
      first = min(plan%first_sample + 1, plan%steps)
      if (.not. plan%measures) first = plan%steps
      call begin_histories(plan, result)
      if (march%steps > 0) then
         call march%restore(solver, state, result)
      else
         call solver%equations%evaluate(solver%problem, solver%law, solver%given, solver%past, state)
         call solver%equations%remember(state%theta, plan%steps_per_cell, solver%past)
      end if
      solver%given%load%force = case%load_factor
      do k = march%steps + 1, plan%steps
         associate (grid => solver%problem%grid)
            call take_step(solver, march%steady, moves_on(plan), &
                           plan%surfaces%rough_behind_fronts(grid%x, grid%y, k*plan%dt, film), state, report)
         end associate
         call count_steps(report, result)
         if (report%status /= status_converged) then
            call take_report(report, 'time step '//to_text(k)//' of '//to_text(plan%steps), result)
            return
         end if
         result%residual = max(result%residual, report%residual)
         result%load_error = max(result%load_error, report%load_error)
         call solver%equations%remember(state%theta, plan%steps_per_cell, solver%past)
         call note_step(solver, state, k, merge(plan%steps - first + 1, 0, k >= first), march%values, result)
         if (present(keeper)) then
            call march%gather(k, solver, state, result)
            call keeper%keep(march)
         end if
         call monitor%step_done('time step with touching', k, plan%steps)
         if (monitor%request /= go_on) return
      end do
      result%time_steps = plan%steps
      result%mean_film = sum(result%film_history(first:))/(plan%steps - first + 1)
   end subroutine march_touching

   !> Largest difference of the mean of a quantity over the measured time to its means up to two periods before: waves
   !> repeat once a march has settled, apart from the position of steps in a period. 0 of measured surfaces, whose
   !> passage has no period.
   pure real(dp) function unrest(plan, history)
      type(case_plan_t), intent(in) :: plan
      real(dp), intent(in) :: history(:)                 !! of all steps
      integer :: first, n, period

      unrest = 0
      if (.not. plan%measures .or. plan%surfaces%is_measured()) return
      period = nint(plan%surfaces%longest_period()/plan%dt)
      first = min(plan%first_sample + 1, plan%steps)
      do n = 1, 2
         if (first - n*period < 1) exit
         unrest = max(unrest, abs(sum(history(first:) - history(first - n*period:plan%steps - n*period))) &
                      /(plan%steps - first + 1))
      end do
   end function unrest

   !> Values of a step in the histories, and in the means over `measured` steps, if any.
   subroutine note_step(solver, state, k, measured, values, result)
      type(touching_solver_t), intent(in) :: solver
      type(touching_state_t), intent(in) :: state
      integer, intent(in) :: k, measured
      type(touching_values_t), intent(inout) :: values
      type(case_result_t), intent(inout) :: result
      type(touching_values_t) :: now

      call now%take(solver, state)
      result%film_history(k) = solver%problem%grid%value_at_centre(state%h)
      result%approach_history(k) = state%delta
      associate (account => result%effects%touching%account)
         account%share_history(k) = now%share
         account%area_history(k) = now%area
         account%friction_history(k) = now%friction_oil
         account%mean_film_history(k) = now%mean_film
      end associate
      if (measured > 0) call values%add(now, measured)
   end subroutine note_step

   !> Make room for the values of all steps.
   subroutine begin_histories(plan, result)
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(inout) :: result
      integer :: k
      result%time = [(k*plan%dt, k=1, plan%steps)]
      result%film_history = 0*result%time
      result%approach_history = 0*result%time
      associate (account => result%effects%touching%account)
         account%share_history = 0*result%time
         account%area_history = 0*result%time
         account%friction_history = 0*result%time
         account%mean_film_history = 0*result%time
      end associate
   end subroutine begin_histories

   !> Whether the state of a step before, moved on by a cell, is closer to the state of a step: steps are of a cell, and
   !> the roughness is faster than half the oil.
   pure logical function moves_on(plan)
      type(case_plan_t), intent(in) :: plan
      moves_on = plan%steps_per_cell == 1 .and. plan%surfaces%is_rough()
      if (moves_on) moves_on = plan%surfaces%list(plan%surfaces%main)%slip > slow
   end function moves_on

   !> A step to another roughness, from a guess that moves with the oil. Where Newton's method fails, the roughness
   !> changes in parts.
   subroutine take_step(solver, steady, moves, rough, state, report)
      type(touching_solver_t), intent(inout) :: solver
      type(touching_state_t), intent(in) :: steady       !! of smooth surfaces
      logical, intent(in) :: moves                       !! whether the guess moves
      real(dp), intent(in) :: rough(0:, 0:)
      type(touching_state_t), intent(inout) :: state
      type(solve_report_t), intent(out) :: report
      type(touching_state_t) :: before
      real(dp), allocatable :: rough_before(:, :)
      integer :: cut, linear_steps, m, steps

      before = state
      rough_before = solver%given%rough
      linear_steps = 0
      steps = 0
      if (moves) call state%move_on(steady)
      do cut = 0, most_cuts
         if (cut > 0) state = before
         do m = 1, 2**cut
            call solver%given%set_rough(rough_before + (m*0.5_dp**cut)*(rough - rough_before))
            call solver%solve(state, report)
            steps = steps + report%nonlinear_steps
            linear_steps = linear_steps + report%linear_steps
            if (report%status /= status_converged) exit
         end do
         if (report%status == status_converged) exit
      end do
      report%nonlinear_steps = steps
      report%linear_steps = linear_steps
   end subroutine take_step

   !> Add the effort of a solution.
   subroutine count_steps(report, result)
      type(solve_report_t), intent(in) :: report
      type(case_result_t), intent(inout) :: result
      result%nonlinear_steps = result%nonlinear_steps + report%nonlinear_steps
      result%linear_steps = result%linear_steps + report%linear_steps
   end subroutine count_steps

end module ehlwave_touching_march
