!> Newton's method with active sets for a contact whose surfaces may touch, theory section 8.2.
module ehlwave_touching_newton
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_conditions, only: conditions_from_dimensional, conditions_t, contact_data_t
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_errors, only: error_t
   use ehlwave_given, only: given_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_real_gmres, only: gmres_t
   use ehlwave_reynolds, only: driven_flow
   use ehlwave_solve_report, only: mass_gain, solve_report_t
   use ehlwave_status, only: status_converged, status_not_finite, status_stalled
   use ehlwave_touching_change, only: new_change, touching_change_t
   use ehlwave_touching_equations, only: touching_equations_t, touching_past_t
   use ehlwave_touching_state, only: touching_law_t, touching_state_t
   use ehlwave_touching_steps, only: touch_first, touching_steps_t
   use ehlwave_touching_system, only: touching_system_t
   use ehlwave_work_unit, only: evaluation_operations
   implicit none (type, external)
   private
   public :: residuals, set_speed

   real(dp), parameter, public :: speed_step = 1e-5_dp   !! of ln(speed), for derivatives
   real(dp), parameter :: loosest = 3e-2_dp           !! linear tolerance of marches while sets change,
   real(dp), parameter :: loose = 1e-2_dp             !! once they rest,
   real(dp), parameter :: tight = 1e-4_dp             !! near the solution, at most,
   real(dp), parameter, public :: exact = 1e-8_dp     !! and of steady states
   real(dp), parameter :: near = 0.3_dp               !! largest residual near the solution of a step of a march
   real(dp), parameter :: highest_c = 1e3_dp          !! C beyond all solutions: the film under it would overflow
   integer, parameter :: largest_krylov = 150            !! linear steps of a solution

   !> A contact on one grid, with what it is given.
   type, public :: touching_solver_t
      type(contact_problem_t) :: problem
      type(touching_law_t) :: law
      type(given_t) :: given                     !! its roughness and load count
      type(touching_past_t) :: past              !! of a march
      type(touching_equations_t) :: equations    !! at the state last solved for
      real(dp) :: tolerance = 1e-10_dp           !! of the residuals of all equations
      integer :: largest_steps = 60
      type(touching_system_t), private :: system
      type(gmres_t), private :: gmres
   contains
      procedure :: begin
      procedure :: solve
      procedure :: work
      procedure :: differentiate_by_speed
      procedure, private :: count_work
   end type touching_solver_t

contains

   !> Make ready to solve; `problem` is set.
   subroutine begin(self)
      class(touching_solver_t), intent(inout) :: self
      call self%equations%init(self%problem)
      call self%system%init(self%problem)
   end subroutine begin

   !> Conditions of the same contact at another speed.
   subroutine set_speed(problem, speed)
      type(contact_problem_t), intent(inout) :: problem
      real(dp), intent(in) :: speed              !! mean speed, m/s
      type(conditions_t) :: conditions
      type(contact_data_t) :: data
      type(error_t), allocatable :: error

      if (.not. abs(speed - problem%conditions%data%mean_speed_m_per_s) > 0) return
      data = problem%conditions%data
      data%mean_speed_m_per_s = speed
      call conditions_from_dimensional(data, conditions, error)
      if (allocated(error)) return
      conditions%slip_parameter = problem%conditions%slip_parameter
      call problem%set_conditions(conditions, problem%rheology)
   end subroutine set_speed

   !> Solve from the state at hand. With a share the speed is found at which the solids bear it.
   subroutine solve(self, state, report, share)
      class(touching_solver_t), intent(inout), target :: self
      type(touching_state_t), intent(inout), target :: state
      type(solve_report_t), intent(out) :: report
      real(dp), intent(in), optional :: share    !! of the load
      type(touching_change_t) :: change, sides
      type(touching_steps_t) :: steps

      change = new_change(self%problem%grid)
      sides = new_change(self%problem%grid)
      sides%seeks_speed = present(share)
      if (sides%seeks_speed .and. .not. any(state%is_touching)) call touch_first(state)
      do
         report%status = status_not_finite
         if (.not. maxval(state%c) < highest_c) exit
         call set_speed(self%problem, state%speed)
         call self%equations%evaluate(self%problem, self%law, self%given, self%past, state)
         call self%count_work(real(evaluation_operations, dp)*size(state%p))
         call residuals(self%problem, self%law, self%given, self%equations, state, sides, share)
         call judge(self, state, sides, report)
         if (report%status == status_not_finite) exit
         if (report%status == status_converged .and. steps%are_settled) exit
         report%status = status_stalled
         if (report%nonlinear_steps == self%largest_steps) exit
         call self%equations%linearise(self%past, state)
         if (sides%seeks_speed) call differentiate_by_speed(self, state, sides)
         call solve_linear(self, state, sides, steps%are_settled, change, report)
         call steps%take(self%problem, self%law, self%given, allocated(self%past%f), change, self%equations%gap, state)
         report%nonlinear_steps = report%nonlinear_steps + 1
      end do
   end subroutine solve

   !> Change of a step of Newton's method. Near the solution of a step of a march the factors of the step before serve.
   subroutine solve_linear(self, state, sides, are_settled, change, report)
      class(touching_solver_t), intent(inout), target :: self
      type(touching_state_t), intent(in), target :: state
      type(touching_change_t), intent(in) :: sides
      logical, intent(in) :: are_settled         !! whether the sets are those of the step before
      type(touching_change_t), intent(inout) :: change
      type(solve_report_t), intent(inout) :: report
      real(dp), allocatable :: b(:), x(:)
      real(dp) :: tolerance                      ! relative
      logical :: is_near

      is_near = allocated(self%past%f) .and. are_settled
      if (is_near) is_near = report%worst() < near .and. self%gmres%reduction <= loosest
      if (is_near) then
         tolerance = min(loose, max(tight, report%worst(), near*self%tolerance/report%worst()))
      else if (allocated(self%past%f)) then
         tolerance = merge(loose, loosest, are_settled)
      else
         tolerance = exact
      end if
      call self%system%pose(self%problem, self%law, self%equations, .not. allocated(self%past%f), state, sides, &
                            keeps_factors=is_near)
      allocate (b(self%system%unknowns%n), x(self%system%unknowns%n))
      call self%system%unknowns%residuals(sides, b)
      self%gmres%largest_steps = largest_krylov
      call self%gmres%solve(self%system, b, x, tolerance)
      report%linear_steps = report%linear_steps + self%gmres%steps
      call self%system%unknowns%changes(x, change)
      call self%system%release()
   end subroutine solve_linear

   !> Operations so far, see `ehlwave_work_unit`.
   pure real(dp) function work(self)
      class(touching_solver_t), intent(in) :: self
      work = 0
      if (allocated(self%problem%deformation)) work = self%problem%deformation%work
   end function work

   subroutine count_work(self, operations)
      class(touching_solver_t), intent(inout) :: self
      real(dp), intent(in) :: operations
      self%problem%deformation%work = self%problem%deformation%work + operations
   end subroutine count_work

   !> Residuals of all equations.
   subroutine residuals(problem, law, given, equations, state, sides, share)
      type(contact_problem_t), intent(in) :: problem
      type(touching_law_t), intent(in) :: law
      type(given_t), intent(in) :: given
      type(touching_equations_t), intent(in) :: equations   !! at the state
      type(touching_state_t), intent(in) :: state
      type(touching_change_t), intent(inout) :: sides
      real(dp), intent(in), optional :: share               !! of the load

      associate (grid => problem%grid)
         sides%p = equations%residual
         sides%c = 0
         where (state%is_touching) sides%c = law%excess(equations%gap, state%c)
         sides%delta = given%load%residual(grid%integral(state%p + state%c), state%delta)
         if (problem%edges%count() > 0) sides%delta = sides%delta + problem%edges%load
         sides%ln_speed = 0
         if (present(share)) sides%ln_speed = load_factor*grid%integral(state%c) - share*given%load%force
      end associate
   end subroutine residuals

   !> The largest of each, and whether all are within the tolerance.
   subroutine judge(self, state, sides, report)
      class(touching_solver_t), intent(in) :: self
      type(touching_state_t), intent(in) :: state
      type(touching_change_t), intent(in) :: sides
      type(solve_report_t), intent(inout) :: report
      real(dp) :: centre, total

      centre = max(self%law%film, self%problem%grid%value_at_centre(state%h))
      report%residual = maxval(mass_gain(sides%p, self%problem%grid%hx, state%h, centre))
      report%complementarity = maxval(abs(sides%c))/centre
      report%load_error = abs(sides%delta)/abs(self%given%load%force) + abs(sides%ln_speed)
      total = sum(sides%p) + sum(sides%c) + sides%delta + sides%ln_speed
      if (.not. ieee_is_finite(total)) then
         report%status = status_not_finite
      else if (report%worst() <= self%tolerance) then
         report%status = status_converged
      else
         report%status = status_stalled
      end if
   end subroutine judge

   !> Derivative of the residual of the oil by ln(speed): through what gradients drive alone.
   subroutine differentiate_by_speed(self, state, sides)
      class(touching_solver_t), intent(inout) :: self
      type(touching_state_t), intent(in) :: state
      type(touching_change_t), intent(inout) :: sides
      real(dp), allocatable :: driven(:, :)
      integer :: side

      allocate (driven, mold=sides%p)
      sides%by_speed = 0
      associate (problem => self%problem, equations => self%equations)
         do side = -1, 1, 2
            call set_speed(problem, state%speed*exp(side*speed_step))
            call equations%evaluate_flow(problem, state%p, state%h)
            call driven_flow(equations%mesh, equations%flow, driven)
            sides%by_speed = sides%by_speed + side/(2*speed_step)*driven
         end do
         call set_speed(problem, state%speed)
         call equations%evaluate_flow(problem, state%p, state%h)
      end associate
   end subroutine differentiate_by_speed

end module ehlwave_touching_newton
