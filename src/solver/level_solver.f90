!> One interface for every way to solve the discrete problem of one level.
module ehlwave_level_solver
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_kinds, only: dp
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_stalled
   implicit none (type, external)
   private

   !> When to stop.
   type, public :: solve_limits_t
      real(dp) :: tolerance = 1e-6_dp   !! on the mass residual and the load error of `solve_report_t`
      integer :: largest_steps = 40     !! nonlinear steps or cycles
   end type solve_limits_t

   !> What a solve came to. Each equation is reported by itself.
   type, public :: solve_report_t
      integer :: status = status_stalled
      real(dp) :: residual = huge(1.0_dp)         !! max |R| hX/H(0,0) over nodes with P > 0: the mass that one
                                                  !! cell gains, in units of the flow through the contact
      real(dp) :: complementarity = huge(1.0_dp)  !! max |P| over nodes where the film is cavitated
      real(dp) :: load_error = huge(1.0_dp)       !! relative error of the load balance
      integer :: nonlinear_steps = 0
      integer :: linear_steps = 0
      integer :: factorisations = 0
      real(dp), allocatable :: history(:)         !! residual before each step and at the end
   end type solve_report_t

   type, abstract, public :: level_solver_t
   contains
      procedure(init_solver), deferred :: init
      procedure(solve_level), deferred :: solve
      procedure(forget_past), deferred :: forget
   end type level_solver_t

   abstract interface
      !> Make the work space for a problem's grid.
      subroutine init_solver(self, problem)
         import :: contact_problem_t, level_solver_t
         implicit none (type, external)
         class(level_solver_t), intent(inout) :: self
         type(contact_problem_t), intent(in), target :: problem   !! must outlive the solver
      end subroutine init_solver

      !> Improve `state` until the equations hold within the limits.
      subroutine solve_level(self, problem, state, limits, report)
         import :: contact_problem_t, level_solver_t, solve_limits_t, solve_report_t, state_t
         implicit none (type, external)
         class(level_solver_t), intent(inout) :: self
         type(contact_problem_t), intent(inout), target :: problem
         type(state_t), intent(inout), target :: state           !! first guess of P and Delta, then the solution with H
         type(solve_limits_t), intent(in) :: limits
         type(solve_report_t), intent(out) :: report
      end subroutine solve_level

      !> Drop what was kept from earlier solves, so that the next depends on its own problem and guess only.
      subroutine forget_past(self)
         import :: level_solver_t
         implicit none (type, external)
         class(level_solver_t), intent(inout) :: self
      end subroutine forget_past
   end interface

end module ehlwave_level_solver
