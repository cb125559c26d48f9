!> Stands in for `petsc_solver.f90` in builds without PETSc: same interface, no solver.
module ehlwave_petsc_solver
   use ehlwave_errors, only: error_t, raise
   use ehlwave_hierarchy, only: hierarchy_t
   use ehlwave_kinds, only: dp
   use ehlwave_level_solver, only: level_solver_t
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_status, only: status_pending
   use ehlwave_step_limit, only: step_limit_t
   implicit none (type, external)
   private
   public :: finish_petsc, require_petsc

   logical, parameter, public :: has_petsc = .false.   !! whether this build has PETSc

   !> Settings of the true solver, without effect here.
   type, extends(level_solver_t), public :: petsc_solver_t
      type(step_limit_t) :: limit
      real(dp) :: linear_tolerance = 0
      integer :: largest_krylov = 0
      integer :: restart = 0
      integer :: fill_levels = 0
   contains
      procedure :: init
      procedure :: solve
   end type petsc_solver_t

contains

   !> An error that says how to get PETSc. Ask before choosing this solver.
   subroutine require_petsc(error)
      type(error_t), allocatable, intent(out) :: error
      call raise(error, 'this build has no PETSc: install PETSc 3.17 or later and configure with '// &
                 '-DEHLWAVE_PETSC=ON, or choose another solver')
   end subroutine require_petsc

   !> Nothing to end.
   subroutine finish_petsc()
   end subroutine finish_petsc

   !> Nothing to make.
   subroutine init(self, hierarchy, finest)
      class(petsc_solver_t), intent(inout) :: self
      type(hierarchy_t), intent(in) :: hierarchy
      integer, intent(in) :: finest
      if (.false.) then   ! silence unused-argument warnings
         associate (a => self, b => hierarchy, c => finest)
         end associate
      end if
   end subroutine init

   !> Leaves the state alone and reports that nothing was run.
   subroutine solve(self, hierarchy, l, limits, report)
      class(petsc_solver_t), intent(inout) :: self
      type(hierarchy_t), intent(inout), target :: hierarchy
      integer, intent(in) :: l
      type(solve_limits_t), intent(in) :: limits
      type(solve_report_t), intent(out) :: report

      allocate (report%history(0))
      report%status = status_pending
      if (.false.) then   ! silence unused-argument warnings
         associate (a => self, b => hierarchy, c => l, d => limits)
         end associate
      end if
   end subroutine solve

end module ehlwave_petsc_solver
