!> Solves within a cap on the work of a case, whose outcome is checked before it counts as converged.
module ehlwave_capped_solver
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_kinds, only: dp
   use ehlwave_level_solver, only: level_solver_t
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged, status_diverged, status_not_finite, status_stalled
   implicit none (type, external)
   private

   type, public :: capped_solver_t
      integer :: steps_left = huge(1)      !! nonlinear steps of the finest level that the case may still take
      real(dp) :: work_left = huge(1.0_dp) !! operations left, without the last step, which exceeds
                                           !! it
      real(dp) :: thinnest = huge(1.0_dp)  !! smallest H of all that `attempt` solved, places of a continuation too,
      real(dp) :: highest = 0              !! largest P
   contains
      procedure :: attempt
      procedure :: attempt_from_coarsest
      procedure :: is_spent
      procedure :: solve_below
      procedure :: solve_coarse
   end type capped_solver_t

contains

   !> Solve the finest level once within the rest of the cap; add the steps to those in its report.
   subroutine attempt(self, multigrid, limits, solver)
      class(capped_solver_t), intent(inout) :: self
      type(full_multigrid_t), intent(inout) :: multigrid
      type(solve_limits_t), intent(in) :: limits
      class(level_solver_t), intent(inout), optional :: solver   !! replaces the hierarchy's
      type(solve_report_t) :: report
      real(dp) :: work_before
      integer :: n

      n = size(multigrid%levels)
      work_before = multigrid%work()
      if (self%is_spent()) then
         multigrid%levels(n)%report%status = status_stalled
         return
      end if
      if (present(solver)) then
         call solver%solve(multigrid%hierarchy_t, n, bounded(self, limits), report)
      else
         call multigrid%solve_level(n, bounded(self, limits), report)
      end if
      self%work_left = self%work_left - (multigrid%work() - work_before)
      associate (level => multigrid%levels(n))
         call close_attempt(self, level%state, report, level%report, follows=.true.)
         level%report = report
      end associate
   end subroutine attempt

   !> Solve by full multigrid, for the finest level.
   subroutine attempt_from_coarsest(self, multigrid, limits, coarse_tolerance)
      class(capped_solver_t), intent(inout) :: self
      type(full_multigrid_t), intent(inout) :: multigrid
      type(solve_limits_t), intent(in) :: limits       !! for the finest level
      real(dp), intent(in) :: coarse_tolerance         !! for the others
      type(solve_report_t) :: spent
      real(dp) :: work_before

      work_before = multigrid%work()
      associate (level => multigrid%levels(size(multigrid%levels)))
         if (self%is_spent()) then
            level%report%status = status_stalled
            return
         end if
         spent = level%report
         call multigrid%solve(bounded(self, limits), coarse_tolerance)
         self%work_left = self%work_left - (multigrid%work() - work_before)
         call close_attempt(self, level%state, level%report, spent, follows=.false.)
      end associate
   end subroutine attempt_from_coarsest

   !> Take the steps of an attempt from the cap, and add earlier steps to its report. No solver may pass off a state
   !> as converged that is not finite or has no film.
   subroutine close_attempt(self, state, report, spent, follows)
      class(capped_solver_t), intent(inout) :: self
      type(state_t), intent(in) :: state
      type(solve_report_t), intent(inout) :: report   !! report of this attempt
      type(solve_report_t), intent(in) :: spent       !! before it
      logical, intent(in) :: follows                  !! whether `thinnest` and `highest` count its state
      real(dp) :: highest, thinnest
      logical :: is_finite

      if (report%status == status_converged) then
         call state%survey(is_finite, thinnest, highest)
         if (.not. is_finite) then
            report%status = status_not_finite
         else if (thinnest <= 0) then
            report%status = status_diverged
         else if (follows) then
            self%thinnest = min(self%thinnest, thinnest)
            self%highest = max(self%highest, highest)
         end if
      end if
      self%steps_left = self%steps_left - report%nonlinear_steps
      report%nonlinear_steps = report%nonlinear_steps + spent%nonlinear_steps
      report%linear_steps = report%linear_steps + spent%linear_steps
      report%factorisations = report%factorisations + spent%factorisations
   end subroutine close_attempt

   !> The levels that error estimates compare with a solved finest level, see `full_multigrid_t`.
   subroutine solve_below(self, multigrid, limits)
      class(capped_solver_t), intent(inout) :: self
      type(full_multigrid_t), intent(inout) :: multigrid
      type(solve_limits_t), intent(in) :: limits
      real(dp) :: work_before
      work_before = multigrid%work()
      call multigrid%solve_below(bounded(self, limits))
      self%work_left = self%work_left - (multigrid%work() - work_before)
   end subroutine solve_below

   !> A coarser level, whose steps do not count in the cap of the finest level. It may take `coarse_share` of the rest,
   !> so that a stalled solve leaves the finest level enough.
   subroutine solve_coarse(self, multigrid, l, limits, report)
      class(capped_solver_t), intent(inout) :: self
      type(full_multigrid_t), intent(inout) :: multigrid
      integer, intent(in) :: l
      type(solve_limits_t), intent(in) :: limits
      type(solve_report_t), intent(out) :: report
      real(dp), parameter :: coarse_share = 0.25_dp
      type(solve_limits_t) :: here
      real(dp) :: work_before
      work_before = multigrid%work()
      here = bounded(self, limits)
      here%largest_work = min(here%largest_work, coarse_share*max(0.0_dp, self%work_left))
      call multigrid%solve_level(l, here, report)
      self%work_left = self%work_left - (multigrid%work() - work_before)
   end subroutine solve_coarse

   !> Whether the case has reached its cap.
   pure logical function is_spent(self)
      class(capped_solver_t), intent(in) :: self
      is_spent = self%steps_left <= 0 .or. self%work_left <= 0
   end function is_spent

   pure function bounded(self, limits) result(tighter)
      class(capped_solver_t), intent(in) :: self
      type(solve_limits_t), intent(in) :: limits
      type(solve_limits_t) :: tighter
      tighter = limits
      tighter%largest_steps = max(0, min(limits%largest_steps, self%steps_left))
      tighter%largest_work = max(0.0_dp, min(limits%largest_work, self%work_left))
   end function bounded

end module ehlwave_capped_solver
