!> The discrete problem of a level as a variational inequality between vectors.
module ehlwave_contact_inequality
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_equations, only: equations_t
   use ehlwave_given, only: given_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_near_matrix, only: near_matrix_t
   use ehlwave_reynolds, only: reynolds_change
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_state, only: new_state, state_t
   use ehlwave_status, only: status_not_finite
   use ehlwave_step_limit, only: step_limit_t
   implicit none (type, external)
   private

   !> Unit of the vectors that PETSc sees. Its active set treats an unknown below 1e-8 as at its bound. True
   !> pressures near the free boundary are smaller, and Newton's method then slows down (M = 2000, D = 1, 257^2: the
   !> residual falls by 0.4 per step, not quadratically).
   real(dp), parameter :: unit = 1e-8_dp
   integer, parameter :: largest_trials = 40   ! trials of a step length
   integer, parameter :: edge_passes = 3       ! passes of edges that follow their film: each gains two or three digits

   !> P >= 0, F >= 0, P F = 0 at the unknown nodes, with the load balance for Delta, as vectors:
   !>
   !>     F = -R |A_ii|^(-1/4)   node (i, j), number (i - 1) rows + j - first_row + 1: flow order
   !>     F = load balance       last
   !>
   !> The weights |A_ii|^(-1/4) belong to the best state when `return_to_best` was last called.
   type, public :: contact_inequality_t
      integer :: n = 0                            !! unknowns
      real(dp), allocatable :: lower(:)           !! their bounds
      type(near_matrix_t) :: near_matrix
      type(step_limit_t) :: limit                 !! limit of a step
      real(dp), allocatable :: best(:)            !! vector of the best state judged since `start`
      type(solve_report_t) :: report              !! errors and status of the state judged last, and the history
      type(contact_problem_t), pointer, private :: problem => null()
      type(given_t), pointer, private :: given => null()
      integer, private :: rows = 0                ! unknown nodes along Y
      real(dp), private :: tolerance = 0
      real(dp), private :: last_work = huge(1.0_dp)   ! work of the grid, from which on no further step begins
      real(dp), private :: least = huge(1.0_dp)   ! worst error of the best state
      type(state_t), private :: state             ! visited last,
      type(equations_t), private :: equations     ! its equations
      type(state_t), private :: base              ! the point of linearisation,
      type(equations_t), private :: base_equations   ! its equations
      ! weights and scratch
      real(dp), allocatable, dimension(:, :), private :: weight, change, film_change, r_change
   contains
      procedure :: init
      procedure :: start
      procedure :: return_to_best
      procedure :: finish
      procedure :: evaluate
      procedure :: linearise
      procedure :: multiply
      procedure :: step_length
      procedure :: judge
      procedure :: is_spent
   end type contact_inequality_t

contains

   !> Work space for a problem's grid.
   subroutine init(self, problem)
      class(contact_inequality_t), intent(out) :: self
      type(contact_problem_t), intent(in) :: problem
      real(dp), allocatable :: zero(:, :)

      associate (grid => problem%grid)
         self%rows = grid%last_row - grid%first_row + 1
         self%n = self%rows*(grid%nx - 1) + 1
         call self%equations%init(problem)
         self%state = new_state(grid)
         self%base = self%state
         allocate (zero(0:grid%nx, 0:grid%ny), source=0.0_dp)
         allocate (self%weight, self%change, self%film_change, self%r_change, source=zero)
         allocate (self%best(self%n), self%lower(self%n), source=0.0_dp)
         self%lower(self%n) = -huge(1.0_dp)   ! Delta is free
         call self%near_matrix%init(problem)
      end associate
   end subroutine init

   !> Begin a solve with a guess as the best state. A guess whose surfaces overlap is opened first, to the film of the
   !> formula at the closest point.
   subroutine start(self, problem, given, guess, limits)
      class(contact_inequality_t), intent(inout) :: self
      type(contact_problem_t), intent(inout), target :: problem   !! must live until the end of the solve, and so must
      type(given_t), intent(in), target :: given
      type(state_t), intent(in) :: guess
      type(solve_limits_t), intent(in) :: limits
      type(solve_report_t) :: blank

      self%problem => problem
      self%given => given
      self%tolerance = limits%tolerance
      self%last_work = problem%deformation%work + limits%largest_work
      self%report = blank
      allocate (self%report%history(0))
      self%least = huge(1.0_dp)
      self%state = guess
      self%state%p = max(guess%p, 0.0_dp)
      call problem%film_of_guess(given, self%state)
      call pack_field(self, self%state%p/unit, self%best)
      self%best(self%n) = self%state%delta/unit
      call self%return_to_best()
   end subroutine start

   !> Visit and judge the best state once more, and weight by it from now on.
   subroutine return_to_best(self)
      class(contact_inequality_t), intent(inout) :: self
      call visit(self, self%best)
      call self%report%judge(self%given, self%equations, self%state, solve_limits_t(tolerance=self%tolerance))
      self%weight = sqrt(sqrt(self%equations%scale))
   end subroutine return_to_best

   !> End a solve: hand over the state visited last and the report on it, steps not counted.
   subroutine finish(self, state, report)
      class(contact_inequality_t), intent(inout) :: self
      type(state_t), intent(inout) :: state
      type(solve_report_t), intent(inout) :: report
      state = self%state
      report = self%report
      nullify (self%problem, self%given)
   end subroutine finish

   !> f = F(x).
   subroutine evaluate(self, x, f)
      class(contact_inequality_t), intent(inout) :: self
      real(dp), intent(in) :: x(:)
      real(dp), intent(inout) :: f(:)
      call visit(self, x)
      call pack_field(self, -self%weight*self%equations%residual/unit, f)
      f(self%n) = self%equations%load_residual(self%given, self%state)/unit
   end subroutine evaluate

   !> Linearise about x; `a`: nonzeros of the near matrix.
   subroutine linearise(self, x, a)
      class(contact_inequality_t), intent(inout) :: self
      real(dp), intent(in) :: x(:)
      real(dp), intent(inout) :: a(:)

      call visit(self, x)
      self%base = self%state
      self%base_equations = self%equations
      self%change = 0
      self%film_change = -1   ! Delta column: dH = -1
      call follow_edges(self)
      call multiply_reynolds(self)
      call self%near_matrix%fill(self%given, self%base_equations, self%r_change, self%weight, a)
   end subroutine linearise

   !> y = F'(x_0) x, deformation by FFT included; x_0: where it was linearised.
   subroutine multiply(self, x, y)
      class(contact_inequality_t), intent(inout) :: self
      real(dp), intent(in) :: x(:)
      real(dp), intent(inout) :: y(:)

      associate (problem => self%problem)
         call unpack_field(self, 1.0_dp, x, self%change)
         call problem%deformation%apply(self%change, self%film_change)
         self%film_change = self%film_change - x(self%n)
         call follow_edges(self)
         call multiply_reynolds(self)
         call pack_field(self, -self%weight*self%r_change, y)
         y(self%n) = load_factor*problem%grid%integral(self%change) + self%given%load%inertia*x(self%n)
      end associate
   end subroutine multiply

   !> Longest step, at most 1, from x_0 along -x with pressures cut off at 0 that keeps to the limits; 0 if there is
   !> none.
   real(dp) function step_length(self, x) result(step)
      class(contact_inequality_t), intent(inout) :: self
      real(dp), intent(in) :: x(:)
      real(dp) :: largest
      integer :: trial

      step = 0
      if (.not. ieee_is_finite(sum(x))) return
      call unpack_field(self, unit, x, self%change)
      largest = maxval(abs(self%change), mask=self%change < self%base%p)   ! those not cut off by a full step
      step = 1
      if (largest > self%limit%largest_change) step = self%limit%largest_change/largest
      do trial = 1, largest_trials
         call self%problem%film(self%given, max(self%base%p - step*self%change, 0.0_dp), &
                                self%base%delta - step*unit*x(self%n), self%film_change)
         if (all(self%film_change >= self%limit%smallest_film_factor*self%base%h)) return
         step = 0.7_dp*step
      end do
      step = 0
   end function step_length

   !> Status of the state of a vector, noted in the history; the best is kept.
   integer function judge(self, x)
      class(contact_inequality_t), intent(inout) :: self
      real(dp), intent(in) :: x(:)

      call visit(self, x)
      call self%report%judge(self%given, self%equations, self%state, solve_limits_t(tolerance=self%tolerance))
      self%report%history = [self%report%history, self%report%residual]
      judge = self%report%status
      if (judge == status_not_finite .or. .not. self%report%worst() < self%least) return
      self%least = self%report%worst()
      self%best = x
   end function judge

   !> Whether the solve has reached its cap.
   pure logical function is_spent(self)
      class(contact_inequality_t), intent(in) :: self
      is_spent = self%problem%deformation%work >= self%last_work
   end function is_spent

   !> Pressure, film and equations of a vector.
   subroutine visit(self, x)
      class(contact_inequality_t), intent(inout) :: self
      real(dp), intent(in) :: x(:)
      integer :: pass

      associate (problem => self%problem, state => self%state)
         call unpack_field(self, unit, x, state%p)
         state%delta = unit*x(self%n)
         call problem%film(self%given, state%p, state%delta, state%h)
         do pass = 1, merge(edge_passes, 0, problem%edges%count() > 0)
            call problem%edges%impose(self%given, state%h, state%p)
            call problem%film(self%given, state%p, state%delta, state%h)
         end do
         call self%equations%evaluate(problem, self%given, state)
         problem%deformation%work = problem%deformation%work + self%equations%work()
      end associate
   end subroutine visit

   !> Update the pressures at the edges of a flooded domain from their film, and add the change to the film.
   subroutine follow_edges(self)
      class(contact_inequality_t), intent(inout) :: self
      real(dp), allocatable :: at_edges(:, :), film_change(:, :)
      integer :: k

      associate (edges => self%base_equations%edges)
         if (edges%count() == 0) return
         allocate (at_edges, film_change, mold=self%change)
         at_edges = 0
         do k = 1, edges%count()
            at_edges(edges%i(k), edges%j(k)) = -self%base_equations%edge_slope(k)*self%film_change(edges%i(k), &
               edges%j(k))
         end do
         call self%problem%deformation%apply(at_edges, film_change)
         self%change = self%change + at_edges
         self%film_change = self%film_change + film_change
      end associate
   end subroutine follow_edges

   !> r_change = dR for `change` of pressure and `film_change`, at the point of linearisation.
   subroutine multiply_reynolds(self)
      class(contact_inequality_t), intent(inout) :: self
      associate (equations => self%base_equations)
         call reynolds_change(equations%mesh, self%given%transport, equations%flow, self%change, &
            self%film_change, self%r_change)
      end associate
   end subroutine multiply_reynolds

   !> Vector of the values at the unknown nodes.
   pure subroutine pack_field(self, field, x)
      class(contact_inequality_t), intent(in) :: self
      real(dp), intent(in) :: field(0:, 0:)
      real(dp), intent(inout) :: x(:)
      integer :: i, j, low

      low = self%problem%grid%first_row - 1
      do i = 1, self%problem%grid%nx - 1
         do j = 1, self%rows
            x((i - 1)*self%rows + j) = field(i, j + low)
         end do
      end do
   end subroutine pack_field

   !> Values at the unknown nodes of a vector times `factor`, 0 on the outer boundary.
   pure subroutine unpack_field(self, factor, x, field)
      class(contact_inequality_t), intent(in) :: self
      real(dp), intent(in) :: factor, x(:)
      real(dp), intent(inout) :: field(0:, 0:)
      integer :: i, j, low

      low = self%problem%grid%first_row - 1
      field = 0
      do j = 1, self%rows
         do i = 1, self%problem%grid%nx - 1
            field(i, j + low) = factor*x((i - 1)*self%rows + j)
         end do
      end do
   end subroutine unpack_field

end module ehlwave_contact_inequality
