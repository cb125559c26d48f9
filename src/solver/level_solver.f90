!> One interface for every way to solve the discrete problem of a level.
module ehlwave_level_solver
   use ehlwave_equations, only: equations_t
   use ehlwave_hierarchy, only: hierarchy_t
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   implicit none (type, external)
   private

   !> A solver has work space for a hierarchy and keeps nothing of former solves.
   type, abstract, public :: level_solver_t
   contains
      procedure(init_solver), deferred :: init
      procedure(solve_level), deferred :: solve
      procedure :: last_equations
   end type level_solver_t

   abstract interface
      !> Make the work space to solve the levels of a hierarchy up to `finest`.
      subroutine init_solver(self, hierarchy, finest)
         import :: hierarchy_t, level_solver_t
         implicit none (type, external)
         class(level_solver_t), intent(inout) :: self
         type(hierarchy_t), intent(in) :: hierarchy
         integer, intent(in) :: finest
      end subroutine init_solver

      !> Improve the state of a level, a first guess of P and Delta, until the equations of its problem hold within the
      !> limits; H belongs to it on return. Nothing is kept from earlier solves: the outcome depends on the problem and
      !> the guess only. Nothing else in the hierarchy changes.
      subroutine solve_level(self, hierarchy, l, limits, report)
         import :: hierarchy_t, level_solver_t, solve_limits_t, solve_report_t
         implicit none (type, external)
         class(level_solver_t), intent(inout) :: self
         type(hierarchy_t), intent(inout), target :: hierarchy   !! hierarchy of `init`
         integer, intent(in) :: l                        !! level
         type(solve_limits_t), intent(in) :: limits
         type(solve_report_t), intent(out) :: report
      end subroutine solve_level
   end interface

contains

   !> Equations of the state at the end of the last solve, until the next; none where a solver has not kept them.
   function last_equations(self) result(equations)
      class(level_solver_t), intent(in), target :: self
      type(equations_t), pointer :: equations
      equations => null()
   end function last_equations

end module ehlwave_level_solver
