!> Newton's method with active sets for a contact whose surfaces may touch, theory section Z.
module ehlwave_touching_newton
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_conditions, only: conditions_from_dimensional, conditions_t, contact_data_t
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_errors, only: error_t
   use ehlwave_given, only: given_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_reynolds, only: driven_flow
   use ehlwave_solve_report, only: mass_gain, solve_report_t
   use ehlwave_status, only: status_converged, status_not_finite, status_stalled
   use ehlwave_touching_change, only: new_change, touching_change_t
   use ehlwave_touching_direct, only: solve_directly
   use ehlwave_touching_equations, only: touching_equations_t, touching_past_t
   use ehlwave_touching_state, only: touching_law_t, touching_state_t
   implicit none (type, external)
   private
   public :: set_speed

   real(dp), parameter :: largest_change_p = 0.3_dp      !! of P in a step
   real(dp), parameter :: largest_change_speed = 0.3_dp  !! of ln(speed)
   real(dp), parameter :: largest_change_c = 2           !! of ln(C), soft law
   real(dp), parameter :: small_speed_step = 1e-6_dp     !! of ln(speed), for its derivative

   !> A contact on one grid, with what it is given.
   type, public :: touching_solver_t
      type(contact_problem_t) :: problem
      type(touching_law_t) :: law
      type(given_t) :: given                     !! its roughness and load count
      type(touching_past_t) :: past              !! of a march
      type(touching_equations_t) :: equations    !! at the state last solved for
      real(dp) :: tolerance = 1e-10_dp           !! of the residuals of all equations
      integer :: largest_steps = 60
   contains
      procedure :: begin
      procedure :: solve
   end type touching_solver_t

contains

   !> Make ready to solve; `problem` is set.
   subroutine begin(self)
      class(touching_solver_t), intent(inout) :: self
      call self%equations%init(self%problem)
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
      class(touching_solver_t), intent(inout) :: self
      type(touching_state_t), intent(inout) :: state
      type(solve_report_t), intent(out) :: report
      real(dp), intent(in), optional :: share    !! of the load
      type(touching_change_t) :: change, sides
      integer :: changed
      logical :: is_singular

      change = new_change(self%problem%grid)
      sides = new_change(self%problem%grid)
      sides%seeks_speed = present(share)
      if (sides%seeks_speed .and. .not. any(state%is_touching)) call touch_first(state)
      changed = 1
      do
         call set_speed(self%problem, state%speed)
         call self%equations%evaluate(self%problem, self%law, self%given, self%past, state)
         call find_sides(self, state, sides, share)
         call judge(self, state, sides, report)
         if (report%status == status_not_finite) exit
         if (report%status == status_converged .and. changed == 0) exit
         report%status = status_stalled
         if (report%nonlinear_steps == self%largest_steps) exit
         call self%equations%linearise(self%past, state)
         if (sides%seeks_speed) call differentiate_by_speed(self, state, sides)
         call solve_directly(self%problem, self%law, self%equations, state, sides, change, is_singular)
         if (is_singular) exit
         call take_step(self, state, change, changed)
         report%nonlinear_steps = report%nonlinear_steps + 1
      end do
   end subroutine solve

   !> Let the solids touch where the film is thinnest, so that there is a node to bear the share.
   subroutine touch_first(state)
      type(touching_state_t), intent(inout) :: state
      integer :: node(2)
      associate (n => shape(state%h))
         node = minloc(state%h(1:n(1) - 2, :)) + [0, -1]
      end associate
      state%is_touching(node(1), node(2)) = .true.
      state%c(node(1), node(2)) = 1e-3_dp
   end subroutine touch_first

   !> Residuals of all equations.
   subroutine find_sides(self, state, sides, share)
      class(touching_solver_t), intent(in) :: self
      type(touching_state_t), intent(in) :: state
      type(touching_change_t), intent(inout) :: sides
      real(dp), intent(in), optional :: share

      associate (grid => self%problem%grid)
         sides%p = self%equations%residual
         sides%c = 0
         where (state%is_touching) sides%c = self%law%excess(self%equations%gap, state%c)
         sides%delta = self%given%load%residual(grid%integral(state%p + state%c), state%delta)
         if (self%problem%edges%count() > 0) sides%delta = sides%delta + self%problem%edges%load
         sides%ln_speed = 0
         if (present(share)) sides%ln_speed = load_factor*grid%integral(state%c) - share*self%given%load%force
      end associate
   end subroutine find_sides

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

      allocate (driven, mold=sides%p)
      associate (problem => self%problem, equations => self%equations)
         call driven_flow(equations%mesh, equations%flow, driven)
         call set_speed(problem, state%speed*exp(small_speed_step))
         call equations%evaluate_flow(problem, state%p, state%h)
         call driven_flow(equations%mesh, equations%flow, sides%by_speed)
         sides%by_speed = (sides%by_speed - driven)/small_speed_step
         call set_speed(problem, state%speed)
         call equations%evaluate_flow(problem, state%p, state%h)
      end associate
   end subroutine differentiate_by_speed

   !> Take a limited step and choose the sets anew. Solids leave where C < 0 and bear where the gap is below the
   !> boundary
   !> film; the film breaks where P < 0 and is full where theta > 1.
   subroutine take_step(self, state, change, changed)
      class(touching_solver_t), intent(inout) :: self
      type(touching_state_t), intent(inout) :: state
      type(touching_change_t), intent(in) :: change
      integer, intent(out) :: changed            !! nodes that went from one set to another
      logical, dimension(0:self%problem%grid%nx, 0:self%problem%grid%ny) :: bears, breaks, is_unknown
      real(dp) :: part

      associate (grid => self%problem%grid, law => self%law)
         is_unknown = .false.
         is_unknown(1:grid%nx - 1, grid%first_row:grid%last_row) = .true.
         part = 1
         part = min(part, largest_change_p/max(tiny(part), maxval(abs(change%p), mask=.not. state%is_cavitated)))
         part = min(part, largest_change_speed/max(tiny(part), abs(change%ln_speed)))
         where (state%is_cavitated)
            state%theta = state%theta + part*change%p
         elsewhere
            state%p = state%p + part*change%p
         end where
         if (law%is_soft) then
            where (state%is_touching) state%c = state%c*exp(max(-largest_change_c, min(largest_change_c, &
                                                                                       part*change%c/state%c)))
         else
            state%c = state%c + part*change%c
         end if
         state%delta = state%delta + part*change%delta
         state%speed = state%speed*exp(part*change%ln_speed)
         call self%problem%film(self%given, max(state%p, 0.0_dp) + state%c, state%delta, self%equations%gap)
         breaks = is_unknown .and. merge(state%theta <= 1, state%p < 0, state%is_cavitated)
         if (law%is_soft) then
            bears = is_unknown .and. law%touches(self%equations%gap)
            where (bears .and. .not. state%is_touching) state%c = law%stress*exp((law%film - self%equations%gap) &
                                                                                 /law%softness)
         else
            bears = is_unknown .and. merge(state%c > 0, law%touches(self%equations%gap), state%is_touching)
         end if
         changed = count(bears .neqv. state%is_touching) + count(breaks .neqv. state%is_cavitated)
         state%is_touching = bears
         state%is_cavitated = breaks
      end associate
      where (.not. bears) state%c = 0
      where (breaks .or. state%p < 0) state%p = 0
      where (.not. breaks) state%theta = 1
   end subroutine take_step

end module ehlwave_touching_newton
