!> The interface of a local solve before a Newton step, for a residual that a small part of the domain dominates.
module ehlwave_local_solver
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_equations, only: equations_t
   use ehlwave_given, only: given_t
   use ehlwave_kinds, only: dp
   use ehlwave_solve_report, only: solve_limits_t
   use ehlwave_state, only: state_t
   implicit none (type, external)
   private

   type, abstract, public :: local_solver_t
   contains
      procedure(improve_part), deferred :: improve_part
   end type local_solver_t

   abstract interface
      !> Find a better pressure for a part of the domain, the rest held.
      subroutine improve_part(self, problem, given, equations, limits, state, p)
         import :: contact_problem_t, dp, equations_t, given_t, local_solver_t, solve_limits_t, state_t
         implicit none (type, external)
         class(local_solver_t), intent(inout) :: self
         type(contact_problem_t), intent(inout) :: problem
         type(given_t), intent(in) :: given
         type(equations_t), intent(in) :: equations     !! equations of the problem, with its data, at the state
         type(solve_limits_t), intent(in) :: limits     !! limits of the calling solve
         type(state_t), intent(in) :: state
         real(dp), allocatable, intent(out) :: p(:, :)  !! pressure of the whole, (0:nx, 0:ny); not allocated without a
                                                        !! patch
                                                        !! found
      end subroutine improve_part
   end interface

end module ehlwave_local_solver
