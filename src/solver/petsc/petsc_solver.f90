!> The discrete problem of a level solved by SNES of PETSc: an independent reference.
!>
!> Shares with `newton` the discrete equations only: Newton's method, active set, line search, GMRES and the
!> incomplete factors are PETSc's (SNESVINEWTONRSLS, Benson and Munson 2006). Ask `require_petsc` first whether PETSc
!> is available; without it a solve fails at its start.
module ehlwave_petsc_solver
   use ehlwave_contact_inequality, only: contact_inequality_t
   use ehlwave_hierarchy, only: hierarchy_t
   use ehlwave_kinds, only: dp
   use ehlwave_level_solver, only: level_solver_t
   use ehlwave_petsc_binding, only: out_of_steps, outcome_t, run_snes, settings_t
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_status, only: status_diverged, status_stalled
   use ehlwave_step_limit, only: step_limit_t
   implicit none (type, external)
   private

   !> Newton steps are limited so that no pressure changes by more than `largest_change` and no film thickness
   !> falls below `smallest_film_factor` of its value, then shortened by a line search. When that fails, a second
   !> round goes on from the best state without line search.
   type, extends(level_solver_t), public :: petsc_solver_t
      type(step_limit_t) :: limit
      real(dp) :: linear_tolerance = 1e-6_dp     !! tolerance of GMRES, relative to the right side
      integer :: largest_krylov = 400            !! GMRES steps per Newton step
      integer :: restart = 100
      integer :: fill_levels = 1                 !! fill of the incomplete factors
      type(contact_inequality_t), private :: inequality
   contains
      procedure :: init
      procedure :: solve
   end type petsc_solver_t

contains

   !> Work space for a problem's grid. PETSc itself is started by the first solve.
   subroutine init(self, hierarchy, finest)
      class(petsc_solver_t), intent(inout) :: self
      type(hierarchy_t), intent(in) :: hierarchy
      integer, intent(in) :: finest
      call self%inequality%init(hierarchy%levels(finest)%problem)
   end subroutine init

   !> See the interface. Two rounds of SNES at most; hands back the best state met. A guess whose surfaces overlap is
   !> opened first.
   subroutine solve(self, hierarchy, l, limits, report)
      class(petsc_solver_t), intent(inout) :: self
      type(hierarchy_t), intent(inout), target :: hierarchy
      integer, intent(in) :: l
      type(solve_limits_t), intent(in) :: limits
      type(solve_report_t), intent(out) :: report
      type(settings_t) :: settings
      type(outcome_t) :: outcome
      logical :: has_failed
      integer :: linear_steps, round, steps

      steps = 0
      linear_steps = 0
      settings = settings_t(1, self%fill_levels, limits%largest_steps, self%restart, self%largest_krylov, &
                            self%linear_tolerance)
      associate (inequality => self%inequality, level => hierarchy%levels(l))
         inequality%limit = self%limit
         call inequality%start(level%problem, level%given, level%state, limits)
         do round = 1, 2
            if (inequality%report%status /= status_stalled .or. settings%largest_steps <= 0) exit
            if (inequality%is_spent()) exit
            settings%backtracks = merge(1, 0, round == 1)
            call run_snes(inequality, settings, outcome, has_failed)
            if (has_failed) exit
            steps = steps + outcome%steps
            linear_steps = linear_steps + outcome%linear_steps
            settings%largest_steps = settings%largest_steps - max(outcome%steps, 1)
            call inequality%return_to_best()
         end do
         call inequality%finish(level%state, report)
      end associate
      report%nonlinear_steps = steps
      report%linear_steps = linear_steps
      report%factorisations = steps
      if (report%status == status_stalled .and. outcome%reason /= out_of_steps) report%status = status_diverged
   end subroutine solve

end module ehlwave_petsc_solver
