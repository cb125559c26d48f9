!> The Fortran side of petsc_snes.c: its types and its solver, and the callbacks that give it the equations.
module ehlwave_petsc_binding
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_f_procpointer, c_funloc, c_funptr, &
      c_int, c_loc, c_ptr
   use ehlwave_contact_inequality, only: contact_inequality_t
   use ehlwave_petsc_library, only: find_solver
   use ehlwave_status, only: status_converged, status_over_budget
   implicit none (type, external)
   private
   public :: run_snes

   integer, parameter, public :: out_of_steps = -5   !! SNES_DIVERGED_MAX_IT

   type, bind(c), public :: settings_t
      integer(c_int) :: backtracks, fill_levels, largest_steps, restart, largest_krylov
      real(c_double) :: linear_tolerance
   end type settings_t

   type, bind(c), public :: outcome_t
      integer(c_int) :: reason = 0, steps = 0, linear_steps = 0
   end type outcome_t

   type, bind(c) :: equations_t
      type(c_ptr) :: context
      type(c_funptr) :: evaluate, linearise, multiply, step_length, judge
   end type equations_t

   abstract interface
      integer(c_int) function solve_inequality_t(n, row_start, column, x, lower, settings, equations, outcome) bind(c)
         import :: c_double, c_int, equations_t, outcome_t, settings_t
         implicit none (type, external)
         integer(c_int), value :: n
         integer(c_int), intent(in) :: row_start(*), column(*)
         real(c_double), intent(inout) :: x(*)
         real(c_double), intent(in) :: lower(*)
         type(settings_t), intent(in) :: settings
         type(equations_t), intent(inout) :: equations
         type(outcome_t), intent(inout) :: outcome
      end function solve_inequality_t
   end interface

contains

   !> SNES from the best state of an inequality that has been started.
   subroutine run_snes(inequality, settings, outcome, has_failed)
      type(contact_inequality_t), intent(inout), target :: inequality
      type(settings_t), intent(in) :: settings
      type(outcome_t), intent(inout) :: outcome
      logical, intent(out) :: has_failed            !! PETSc has, as a program, or cannot be had
      procedure(solve_inequality_t), pointer :: solve_inequality
      type(equations_t) :: equations
      type(c_funptr) :: solver
      character(len=:), allocatable :: reason
      real(c_double), allocatable :: x(:)

      call find_solver(solver, reason)
      has_failed = .not. c_associated(solver)
      if (has_failed) return
      call c_f_procpointer(solver, solve_inequality)
      equations = equations_t(c_loc(inequality), c_funloc(evaluate), c_funloc(linearise), c_funloc(multiply), &
                              c_funloc(step_length), c_funloc(judge))
      allocate (x, source=inequality%best)
      associate (matrix => inequality%near_matrix)
         has_failed = solve_inequality(int(inequality%n, c_int), matrix%row_start, matrix%column, x, inequality%lower, &
                                       settings, equations, outcome) /= 0
      end associate
   end subroutine run_snes

   subroutine evaluate(context, x, f) bind(c)
      type(c_ptr), intent(in), value :: context
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(inout) :: f(*)
      type(contact_inequality_t), pointer :: inequality
      call c_f_pointer(context, inequality)
      call inequality%evaluate(x(:inequality%n), f(:inequality%n))
   end subroutine evaluate

   subroutine linearise(context, x, matrix) bind(c)
      type(c_ptr), intent(in), value :: context
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(inout) :: matrix(*)
      type(contact_inequality_t), pointer :: inequality
      call c_f_pointer(context, inequality)
      call inequality%linearise(x(:inequality%n), matrix(:size(inequality%near_matrix%column)))
   end subroutine linearise

   subroutine multiply(context, x, y) bind(c)
      type(c_ptr), intent(in), value :: context
      real(c_double), intent(in) :: x(*)
      real(c_double), intent(inout) :: y(*)
      type(contact_inequality_t), pointer :: inequality
      call c_f_pointer(context, inequality)
      call inequality%multiply(x(:inequality%n), y(:inequality%n))
   end subroutine multiply

   real(c_double) function step_length(context, change) bind(c)
      type(c_ptr), intent(in), value :: context
      real(c_double), intent(in) :: change(*)
      type(contact_inequality_t), pointer :: inequality
      call c_f_pointer(context, inequality)
      step_length = inequality%step_length(change(:inequality%n))
   end function step_length

   integer(c_int) function judge(context, x) bind(c)
      type(c_ptr), intent(in), value :: context
      real(c_double), intent(in) :: x(*)
      type(contact_inequality_t), pointer :: inequality
      call c_f_pointer(context, inequality)
      judge = int(inequality%judge(x(:inequality%n)), c_int)
      if (judge /= status_converged .and. inequality%is_spent()) judge = int(status_over_budget, c_int)
   end function judge

end module ehlwave_petsc_binding
