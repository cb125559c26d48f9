!> Newton's method with an active set for the cavitated nodes, GMRES inside.
module ehlwave_newton
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_kinds, only: dp
   use ehlwave_level_solver, only: level_solver_t, solve_limits_t, solve_report_t
   use ehlwave_newton_system, only: newton_system_t
   use ehlwave_real_gmres, only: gmres_t
   use ehlwave_reynolds, only: reynolds_residual
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged, status_diverged, status_stalled
   use ehlwave_transport, only: implicit_part
   implicit none (type, external)
   private

   real(dp), parameter :: lowest_pressure = -0.02_dp   !! of an iterate; solutions are clipped at 0
   real(dp), parameter :: last_step_share = 0.2_dp   !! of the tolerance, left by the linear solver in the last step

   !> Steps are limited so that no pressure changes by more than `largest_change` and no film thickness
   !> falls below `smallest_film_factor` of its value.
   type, extends(level_solver_t), public :: newton_t
      real(dp) :: largest_change = 0.3_dp
      real(dp) :: smallest_film_factor = 0.1_dp
      real(dp) :: loosest = 0.05_dp              !! linear tolerance far from the solution
      real(dp) :: tightest = 1e-4_dp             !! and close to it
      integer :: largest_krylov = 60
      type(newton_t), pointer :: coarser => null()   !! solver of the next coarser level, serves as preconditioner
      type(contact_problem_t), pointer :: own_problem => null()
      type(newton_system_t), private :: system
      type(gmres_t), private :: gmres
      real(dp), allocatable, private :: residual(:, :), rhs(:), change(:), film_change(:, :)
      logical, allocatable, private :: cavitated_before(:, :), cavitated_earlier(:, :)
   contains
      procedure :: init
      procedure :: solve
   end type newton_t

contains

   !> Work space for a problem's grid.
   subroutine init(self, problem)
      class(newton_t), intent(inout) :: self
      type(contact_problem_t), intent(in), target :: problem

      self%own_problem => problem
      call self%system%init(problem)
      self%gmres%largest_steps = self%largest_krylov
      allocate (self%cavitated_before(0:problem%grid%nx, 0:problem%grid%ny), &
                self%cavitated_earlier(0:problem%grid%nx, 0:problem%grid%ny), source=.false.)
      allocate (self%residual(0:problem%grid%nx, 0:problem%grid%ny), &
                self%film_change(0:problem%grid%nx, 0:problem%grid%ny), source=0.0_dp)
      allocate (self%rhs(self%system%n), self%change(self%system%n), source=0.0_dp)
   end subroutine init

   !> Make the systems of all coarser levels ready to precondition a finer one.
   recursive subroutine connect(solver)
      type(newton_t), intent(inout), target :: solver
      solver%system%problem => solver%own_problem
      nullify (solver%system%coarser)
      if (.not. associated(solver%coarser)) return
      solver%system%coarser => solver%coarser%system
      call connect(solver%coarser)
   end subroutine connect

   !> See the interface.
   subroutine solve(self, problem, state, limits, report)
      class(newton_t), intent(inout) :: self
      type(contact_problem_t), intent(inout), target :: problem
      type(state_t), intent(inout), target :: state
      type(solve_limits_t), intent(in) :: limits
      type(solve_report_t), intent(out) :: report
      real(dp) :: forcing, worth, worth_before, step
      integer :: k

      self%system%problem => problem
      self%system%p => state%p
      self%system%transport = implicit_part(problem%transport, problem%grid)
      self%system%is_coarse = .false.
      nullify (self%system%coarser)
      if (associated(self%coarser)) then
         self%system%coarser => self%coarser%system
         call connect(self%coarser)
      end if
      allocate (report%history(0))
      worth_before = 0
      forcing = self%loosest
      call problem%film(state%p, state%delta, state%h)
      do k = 0, limits%largest_steps
         call assemble(self, problem, state, worth)
         call report%judge(problem, state, self%residual, self%system%is_cavitated, limits%tolerance)
         report%history = [report%history, report%residual]
         if (report%status /= status_stalled .or. k == limits%largest_steps) exit

         if (k > 0) forcing = next_forcing(self, forcing, worth/worth_before)
         forcing = min(self%loosest, max(forcing, last_step_share*limits%tolerance/report%residual))
         worth_before = worth
         call linear_solve(self, forcing, report)
         step = 1
         if (alternates(self, k)) step = 0.5_dp
         if (.not. take_step(self, problem, state, step)) then
            report%status = status_diverged
            exit
         end if
         report%nonlinear_steps = k + 1
      end do
      if (report%status == status_converged) state%p = max(state%p, 0.0_dp)
      nullify (self%system%problem, self%system%p)
   end subroutine solve

   !> Linear tolerance after a step that changed the residual by `ratio`: tighter the closer to the
   !> solution (Eisenstat and Walker 1996), and tighter also when a loose solve gained little.
   pure real(dp) function next_forcing(self, forcing, ratio)
      class(newton_t), intent(in) :: self
      real(dp), intent(in) :: forcing, ratio
      if (ratio > 0.5_dp) then
         next_forcing = max(self%tightest, 0.1_dp*forcing)
      else
         next_forcing = min(self%loosest, max(self%tightest, 0.5_dp*ratio**1.5_dp))
      end if
   end function next_forcing

   !> Residual, active set and right side at the present state.
   !> Active (cavitated) where P + R/|A_ii| <= 0.
   subroutine assemble(self, problem, state, worth)
      class(newton_t), intent(inout), target :: self
      type(contact_problem_t), intent(inout) :: problem
      type(state_t), intent(in) :: state
      real(dp), intent(out) :: worth   !! Euclidean norm of the right side
      real(dp), pointer, contiguous :: b(:, :)
      integer :: i, j

      associate (grid => problem%grid, system => self%system, r => self%residual)
         call system%flow%evaluate(problem%rheology, problem%conditions%lambdabar, state%p, state%h)
         call reynolds_residual(grid, problem%transport, problem%conditions%elliptic%kappa, system%flow, state%p, r)
         call system%set_scale()
         b(0:grid%nx, 0:grid%ny) => self%rhs(:system%n - 1)
         do j = 0, grid%ny
            do i = 0, grid%nx
               if (system%scale(i, j) > 0 .and. state%p(i, j) + system%scale(i, j)*r(i, j) <= 0) then
                  system%is_cavitated(i, j) = .true.
                  b(i, j) = -state%p(i, j)
               else
                  system%is_cavitated(i, j) = .false.
                  b(i, j) = -system%row_scale(i, j)*r(i, j)
               end if
            end do
         end do
         self%rhs(system%n) = -problem%load%residual(grid%integral(state%p), state%delta)
         worth = sqrt(sum(self%rhs**2))
      end associate
   end subroutine assemble

   !> Newton direction in `change`. The factors are made afresh: that costs about one GMRES step and a half, and factors
   !> of the step before need two more on average, many more where the pattern moves the edge of the film. Where the
   !> factors do not serve (incomplete ones can be unstable), they are made again with a stronger diagonal.
   subroutine linear_solve(self, forcing, report)
      class(newton_t), intent(inout) :: self
      real(dp), intent(in) :: forcing
      type(solve_report_t), intent(inout) :: report
      real(dp) :: shift
      integer :: attempt

      shift = 0
      do attempt = 1, 4
         call self%system%factorise(shift)
         report%factorisations = report%factorisations + 1
         call self%gmres%solve(self%system, self%rhs, self%change, forcing)
         report%linear_steps = report%linear_steps + self%gmres%steps
         if (self%gmres%steps > 0 .and. self%gmres%reduction < 0.5_dp) exit
         shift = max(0.1_dp, 4*shift)
      end do
   end subroutine linear_solve

   !> Whether the active set goes back and forth between two sets; a half step then breaks the cycle.
   logical function alternates(self, k)
      class(newton_t), intent(inout) :: self
      integer, intent(in) :: k   !! steps taken
      associate (now => self%system%is_cavitated)
         alternates = .false.
         if (k >= 2) alternates = all(now .eqv. self%cavitated_earlier) .and. any(now .neqv. self%cavitated_before)
         self%cavitated_earlier = self%cavitated_before
         self%cavitated_before = now
      end associate
   end function alternates

   !> Step along `change`, made shorter so that the pressure change and the film stay within their limits, and bent.
   !> False if there is no step to take.
   !>
   !> Pressures may become slightly negative: the active set makes them zero in the next step. Clipping them at zero
   !> here instead leaves neighbours with changes that counted on the negative value, and the active set can go round
   !> in circles (measured: M = 50, D = 0.04, a cycle of four sets).
   logical function take_step(self, problem, state, longest) result(has_moved)
      class(newton_t), intent(inout), target :: self
      type(contact_problem_t), intent(inout) :: problem
      type(state_t), intent(inout) :: state
      real(dp), intent(in) :: longest    !! step length, at most 1
      real(dp), pointer, contiguous :: dp_(:, :)
      real(dp) :: largest, shorter, step
      integer :: i, j

      associate (grid => problem%grid, n => self%system%n)
         dp_(0:grid%nx, 0:grid%ny) => self%change(:n - 1)
         largest = maxval(abs(dp_))
         has_moved = ieee_is_finite(largest) .and. ieee_is_finite(self%change(n))
         if (.not. has_moved) return
         step = longest
         if (largest > self%largest_change) step = step*self%largest_change/largest
         call bend(self, problem, state%p, step, dp_)
         dp_ = max(dp_, lowest_pressure - state%p)
         self%change(n) = step*self%change(n)
         call problem%deformation%apply(dp_, self%film_change)
         self%film_change = self%film_change - self%change(n)
         shorter = 1
         do j = 0, grid%ny
            do i = 0, grid%nx
               if (shorter*self%film_change(i, j) < (self%smallest_film_factor - 1)*state%h(i, j)) &
                  shorter = (self%smallest_film_factor - 1)*state%h(i, j)/self%film_change(i, j)
            end do
         end do
         has_moved = shorter > 0
         state%p = state%p + shorter*dp_
         state%delta = state%delta + shorter*self%change(n)
         state%h = state%h + shorter*self%film_change      ! the film is linear in P and Delta
      end associate
   end function take_step

   !> Bend a pressure change at nodes whose residual is an exponential of their own pressure.
   !>
   !> Where a node takes in oil from neighbours at higher pressure, R behaves like A exp(-s P) - c and
   !> Newton's method gains one factor e a step. In u = exp(-s P) it is linear: with Newton's change d
   !>
   !>     P <- P - ln(1 - s d)/s,     s = phi d ln(eta)/dP,
   !>
   !> phi: share of that exponential in the diagonal of the Jacobian. The difference from P + d is of second
   !> order, so the final convergence stays quadratic.
   pure subroutine bend(self, problem, p, step, dp_)
      class(newton_t), intent(in) :: self
      type(contact_problem_t), intent(in) :: problem
      real(dp), intent(in) :: p(0:, 0:)         !! P before the step
      real(dp), intent(in) :: step              !! step length
      real(dp), intent(inout) :: dp_(0:, 0:)    !! Newton's change, then the change to make
      real(dp) :: cx, cy, intake, s
      integer :: i, j, jm

      associate (grid => problem%grid, flow => self%system%flow)
         cx = 0.5_dp/grid%hx**2
         cy = 0.5_dp*problem%conditions%elliptic%kappa**2/grid%hy**2
         do j = grid%first_row, grid%ny - 1
            jm = grid%below(j)
            do i = 1, grid%nx - 1
               dp_(i, j) = step*dp_(i, j)
               s = -flow%eps_p(i, j)/flow%eps(i, j)
               if (s*abs(dp_(i, j)) < 0.05_dp .or. self%system%is_cavitated(i, j)) cycle
               intake = -flow%eps_p(i, j)*(cx*(p(i + 1, j) - 2*p(i, j) + p(i - 1, j)) &
                                           + cy*(p(i, j + 1) - 2*p(i, j) + p(i, jm)))
               if (intake <= 0) cycle
               s = s*intake/(intake + 1/self%system%scale(i, j))
               if (s*abs(dp_(i, j)) > 1e-3_dp) dp_(i, j) = -log(max(1 - s*dp_(i, j), 0.1_dp))/s
            end do
         end do
      end associate
   end subroutine bend

end module ehlwave_newton
