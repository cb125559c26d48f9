!> Steady states of a contact whose surfaces touch, by continuation in the share of the load that solids bear.
!>
!> The speed at a share is well-conditioned where the share at a speed is not: a smooth contact goes from 0.02 to 0.75
!> within 13 % of speed.
module ehlwave_touching_continuation
   use ehlwave_formula, only: expected_film
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_monitor, only: go_on, monitor_t
   use ehlwave_solve_report, only: solve_report_t
   use ehlwave_status, only: status_converged, status_stalled
   use ehlwave_touching_newton, only: set_speed, touching_solver_t
   use ehlwave_touching_state, only: hertz_state, touching_state_t
   implicit none (type, external)
   private
   public :: reach_share, reach_speed, share_of, start_steady

   real(dp), parameter :: first_share = 0.02_dp       !! at which the solids begin to bear
   real(dp), parameter :: last_share = 0.97_dp        !! beyond which the speed decides
   real(dp), parameter :: largest_step = 0.15_dp      !! of the share
   real(dp), parameter :: smallest_step = 1e-3_dp
   real(dp), parameter :: largest_slowing = 0.7_dp    !! of ln(speed) in a step towards the dry contact
   integer, parameter :: most_solutions = 60

contains

   !> Share of the load that the solids bear.
   real(dp) function share_of(solver, state) result(share)
      type(touching_solver_t), intent(in) :: solver
      type(touching_state_t), intent(in) :: state
      share = load_factor*solver%problem%grid%integral(state%c)/solver%given%load%force
   end function share_of

   !> A first state: at the given speed if found from the Hertz pressure of the oil or of the solids, else at a small
   !> share.
   subroutine start_steady(solver, state, report)
      type(touching_solver_t), intent(inout) :: solver
      type(touching_state_t), intent(out) :: state
      type(solve_report_t), intent(out) :: report
      real(dp), parameter :: speeds(6) = [1.0_dp, 2.0_dp, 0.5_dp, 4.0_dp, 10.0_dp, 40.0_dp]   !! over that given
      real(dp) :: speed
      integer :: n, steps

      speed = solver%problem%conditions%data%mean_speed_m_per_s
      steps = 0
      do n = 1, size(speeds)
         call set_speed(solver%problem, speeds(n)*speed)
         call begin(state)
         call solver%solve(state, report)
         steps = steps + report%nonlinear_steps
         if (report%status == status_converged) exit
         if (n == 1) then
            call begin(state)
            call state%run_dry()
            call solver%solve(state, report)
            steps = steps + report%nonlinear_steps
            if (report%status == status_converged) exit
         end if
         call begin(state)
         call solver%solve(state, report, first_share)
         steps = steps + report%nonlinear_steps
         if (report%status == status_converged) exit
      end do
      report%nonlinear_steps = steps

   contains

      subroutine begin(first)
         type(touching_state_t), intent(out) :: first
         call hertz_state(solver%problem, max(2*solver%law%film, expected_film(solver%problem%conditions)), &
                          solver%given%rough, first)
      end subroutine begin

   end subroutine start_steady

   !> From a steady state to that in which the solids bear a share.
   subroutine reach_share(solver, state, share, monitor, report)
      type(touching_solver_t), intent(inout) :: solver
      type(touching_state_t), intent(inout) :: state
      real(dp), intent(in) :: share
      class(monitor_t), intent(inout) :: monitor
      type(solve_report_t), intent(out) :: report
      type(touching_state_t) :: trial
      real(dp) :: now, step
      integer :: n, steps

      now = share_of(solver, state)
      steps = 0
      step = largest_step
      do n = 1, most_solutions
         trial = state
         associate (next => now + sign(min(step, abs(share - now)), share - now))
            call solver%solve(trial, report, merge(share, next, abs(share - next) < smallest_step))
         end associate
         steps = steps + report%nonlinear_steps
         report%nonlinear_steps = steps
         call monitor%step_done('steady state with touching', n, n)
         if (monitor%request /= go_on) return
         if (report%status == status_converged) then
            state = trial
            now = share_of(solver, state)
            step = min(largest_step, 2*step)
            if (abs(now - share) < 1e-8_dp) return
         else
            step = step/4
            if (step < smallest_step) exit
         end if
      end do
      report%status = status_stalled
   end subroutine reach_share

   !> From a steady state to that at a speed: directly, or between two shares whose speeds are on either side, or down
   !> the speed towards the dry contact.
   subroutine reach_speed(solver, state, speed, monitor, report)
      type(touching_solver_t), intent(inout) :: solver
      type(touching_state_t), intent(inout) :: state
      real(dp), intent(in) :: speed              !! m/s
      class(monitor_t), intent(inout) :: monitor
      type(solve_report_t), intent(out) :: report
      type(touching_state_t) :: faster, slower, trial
      real(dp) :: low, high, share
      integer :: n, steps

      steps = 0
      call try_speed(state)
      if (report%status == status_converged) return
      trial = state
      low = 0
      high = 1
      faster = state
      slower = state
      share = first_share
      do n = 1, most_solutions
         call reach_share(solver, trial, share, monitor, report)
         steps = steps + report%nonlinear_steps
         if (report%status /= status_converged .or. monitor%request /= go_on) exit
         if (trial%speed > speed) then
            low = share
            faster = trial
         else
            high = share
            slower = trial
         end if
         state = trial
         if (high >= 1 .and. low >= last_share) then
            call slow_down()
            exit
         end if
         if (n > 3 .or. high < 1) call try_speed(state)
         if (report%status == status_converged .and. abs(state%speed - speed) <= 0) exit
         share = merge(min(last_share, max(2*low, low + largest_step)), 0.5_dp*(low + high), high >= 1)
         trial = merge_state(low >= high - share, faster, slower)
         if (high - low < smallest_step) exit
      end do
      report%nonlinear_steps = steps
      if (abs(state%speed - speed) > 0) report%status = status_stalled

   contains

      !> Solve at the speed asked for; on success that is the state.
      subroutine try_speed(from)
         type(touching_state_t), intent(in) :: from
         type(touching_state_t) :: next
         next = from
         next%speed = speed
         call solver%solve(next, report)
         steps = steps + report%nonlinear_steps
         report%nonlinear_steps = steps
         if (report%status == status_converged) state = next
      end subroutine try_speed

      !> Go down the speed in steps.
      subroutine slow_down()
         type(touching_state_t) :: next
         real(dp) :: step
         integer :: k
         step = largest_slowing
         do k = 1, most_solutions
            next = state
            next%speed = max(speed, state%speed*exp(-step))
            call solver%solve(next, report)
            steps = steps + report%nonlinear_steps
            call monitor%step_done('steady state with touching', k, k)
            if (monitor%request /= go_on) return
            if (report%status == status_converged) then
               state = next
               if (state%speed <= speed) return
            else
               step = step/2
               if (step < smallest_step) return
            end if
         end do
      end subroutine slow_down

   end subroutine reach_speed

   !> One of two states.
   function merge_state(is_first, first, second) result(state)
      logical, intent(in) :: is_first
      type(touching_state_t), intent(in) :: first, second
      type(touching_state_t) :: state
      if (is_first) then
         state = first
      else
         state = second
      end if
   end function merge_state

end module ehlwave_touching_continuation
