!> Full multigrid (FMG): solve on the coarsest grid, interpolate, solve on the next finer grid, and so on.
module ehlwave_full_multigrid
   use ehlwave_equations, only: equations_t
   use ehlwave_hierarchy, only: hertz_guess, hierarchy_t
   use ehlwave_kinds, only: dp
   use ehlwave_level_solver, only: level_solver_t
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_status, only: status_converged
   implicit none (type, external)
   private

   !> A hierarchy and its solvers, which `ehlwave_solver_choice` gives it.
   type, extends(hierarchy_t), public :: full_multigrid_t
      class(level_solver_t), allocatable :: solver
      class(level_solver_t), allocatable :: coarse_solver   !! solver of all levels except the finest, if different
   contains
      procedure :: solve
      procedure :: solve_level
      procedure :: solve_below
      procedure :: last_equations
   end type full_multigrid_t

   integer, parameter, public :: levels_below = 2   !! the finest, that error estimates compare with it

contains

   !> Solve a level from the guess in its state.
   subroutine solve_level(self, l, limits, report)
      class(full_multigrid_t), intent(inout), target :: self
      integer, intent(in) :: l
      type(solve_limits_t), intent(in) :: limits
      type(solve_report_t), intent(out) :: report
      if (l < size(self%levels) .and. allocated(self%coarse_solver)) then
         call self%coarse_solver%solve(self%hierarchy_t, l, limits, report)
      else
         call self%solver%solve(self%hierarchy_t, l, limits, report)
      end if
   end subroutine solve_level

   !> Equations of the state last left on a level by `solve_level`, until the next; or none.
   function last_equations(self, l) result(equations)
      class(full_multigrid_t), intent(in), target :: self
      integer, intent(in) :: l
      type(equations_t), pointer :: equations
      if (l < size(self%levels) .and. allocated(self%coarse_solver)) then
         equations => self%coarse_solver%last_equations()
      else
         equations => self%solver%last_equations()
      end if
   end function last_equations

   !> Steady solution on the finest level, from a Hertz guess on the coarsest.
   !>
   !> Coarse grids may be too coarse for the case: after a level that does not converge the next starts from the
   !> guess of Hertz. Only the report of the finest level counts.
   subroutine solve(self, limits, coarse_tolerance)
      class(full_multigrid_t), intent(inout) :: self
      type(solve_limits_t), intent(in) :: limits        !! for the finest level
      real(dp), intent(in) :: coarse_tolerance          !! for the others
      type(solve_limits_t) :: here
      type(solve_report_t) :: report
      real(dp) :: work_before
      integer :: l, n

      n = size(self%levels)
      work_before = self%work()
      do l = 1, n
         call self%start_level(l)
         here = limits
         here%gives_up = l < n
         if (l < n) here%tolerance = tolerance_below(limits%tolerance, coarse_tolerance, n - l)
         here%largest_work = limits%largest_work - (self%work() - work_before)
         call self%solve_level(l, here, report)
         associate (level => self%levels(l))
            level%report = report
            if (l < n .and. report%status /= status_converged) call hertz_guess(level%problem, level%state)
         end associate
         if (report%status == status_converged) call self%take_film(l)
      end do
   end subroutine solve

   !> Tolerance so many levels below the finest. A tolerance that follows the discretisation error grows with the
   !> square of the mesh size.
   pure real(dp) function tolerance_below(finest, coarse, levels)
      real(dp), intent(in) :: finest, coarse   !! tolerances
      integer, intent(in) :: levels
      real(dp), parameter :: loosest = 1e-2_dp
      tolerance_below = max(finest, coarse)
      if (finest > coarse) tolerance_below = max(finest, min(loosest, finest*4.0_dp**levels))
   end function tolerance_below

   !> Solve the levels below a solved finest level that have no solution of this contact, each from the next finer
   !> level: error estimates compare them. Full multigrid leaves no solution where a level did not converge from the
   !> coarser levels; a rescue leaves none at all.
   subroutine solve_below(self, limits)
      class(full_multigrid_t), intent(inout) :: self
      type(solve_limits_t), intent(in) :: limits
      integer :: l, n

      n = size(self%levels)
      do l = n - 1, max(1, n - levels_below), -1
         if (self%levels(l)%has_film()) cycle
         call self%start_from_finer(l)
         call self%solve_level(l, limits, self%levels(l)%report)
         if (self%levels(l)%report%status /= status_converged) return
         call self%take_film(l)
      end do
   end subroutine solve_below

end module ehlwave_full_multigrid
