!> Newton's method with an active set for the cavitated nodes, GMRES inside.
module ehlwave_newton
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_bent_step, only: bend
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_cycle_settings, only: diagonal_shift, newton_cycle
   use ehlwave_given, only: given_t
   use ehlwave_hierarchy, only: hierarchy_t, level_t, work_of
   use ehlwave_kinds, only: dp
   use ehlwave_level_solver, only: level_solver_t
   use ehlwave_local_solver, only: local_solver_t
   use ehlwave_real_gmres, only: gmres_t
   use ehlwave_real_linearised_contact, only: linearised_contact_t, set_wedge
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged, status_diverged, status_stalled
   use ehlwave_step_limit, only: step_limit_t
   implicit none (type, external)
   private

   real(dp), parameter :: lowest_pressure = -0.02_dp   !! of an iterate; solutions are clipped at 0
   real(dp), parameter :: last_step_share = 0.2_dp   !! of the tolerance, left by the linear solver in the last step
   ! Of oils that are not Newtonian:
   real(dp), parameter :: much_worse = 2         !! right side over the smallest so far above which a step is taken back
                                                 !! by halves
   integer, parameter :: most_halvings = 10
   real(dp), parameter :: progress = 0.9_dp      !! of the smallest right side, or less, to be reached in so many steps
   integer, parameter :: patience = 15

   !> It owns the contact linearised on every level, of which the coarser ones precondition the finer.
   type, extends(level_solver_t), public :: newton_t
      type(step_limit_t) :: limit
      real(dp) :: loosest = 0.035_dp             !! linear tolerance far from the solution
      real(dp) :: tightest = 1e-4_dp             !! and close to it
      integer :: largest_krylov = 60
      class(local_solver_t), allocatable :: local   !! takes what is large in a small part of the domain only
      type(linearised_contact_t), private :: linear
      type(gmres_t), private :: gmres
      real(dp), allocatable, private :: rhs(:), change(:), film_change(:, :)
      logical, allocatable, private :: cavitated_before(:, :), cavitated_earlier(:, :)
   contains
      procedure :: init
      procedure :: init_levels
      procedure :: solve
      procedure :: improve
   end type newton_t

contains

   !> See the interface.
   subroutine init(self, hierarchy, finest)
      class(newton_t), intent(inout) :: self
      type(hierarchy_t), intent(in) :: hierarchy
      integer, intent(in) :: finest
      call self%init_levels(hierarchy%levels(:finest))
   end subroutine init

   !> The same for some levels.
   subroutine init_levels(self, levels)
      class(newton_t), intent(inout) :: self
      type(level_t), intent(in) :: levels(:)   !! coarsest first
      call self%linear%init(levels, newton_cycle)
   end subroutine init_levels

   !> See the interface.
   subroutine solve(self, hierarchy, l, limits, report)
      class(newton_t), intent(inout) :: self
      type(hierarchy_t), intent(inout), target :: hierarchy
      integer, intent(in) :: l
      type(solve_limits_t), intent(in) :: limits
      type(solve_report_t), intent(out) :: report
      type(state_t) :: state

      state = hierarchy%levels(l)%state
      call self%improve(hierarchy%levels(:l), hierarchy%levels(l)%given, state, limits, report)
      hierarchy%levels(l)%state = state
   end subroutine solve

   !> The same for the last of some levels, with another state and whatever else is given.
   recursive subroutine improve(self, levels, given, state, limits, report)
      class(newton_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)   !! coarsest first
      type(given_t), intent(in) :: given
      type(state_t), intent(inout) :: state
      type(solve_limits_t), intent(in) :: limits
      type(solve_report_t), intent(out) :: report
      type(state_t) :: before
      real(dp) :: best, forcing, work_before, worth, worth_before, step
      integer :: k, last_gain
      logical :: asks_local

      call pose(self, levels, given)
      allocate (report%history(0))
      worth_before = 0
      work_before = work_of(levels)
      forcing = self%loosest
      before = state
      asks_local = allocated(self%local)
      associate (problem => levels(size(levels))%problem, equations => self%linear%levels(size(levels))%equations)
         call problem%film_of_guess(given, state)
         do k = 0, limits%largest_steps
            call assemble(self, problem, given, state, worth)
            if (k == 0) then
               best = worth
               last_gain = 0
            end if
            if (allocated(problem%film_flow)) then
               if (k > 0) then
                  call go_back(self, problem, given, before, best, state, worth)
                  if (any(self%cavitated_before .neqv. equations%is_cavitated)) best = max(best, worth)
               end if
               if (worth < progress*best) last_gain = k
               best = min(best, worth)
            end if
            if (asks_local) call improve_part(self, problem, given, limits, state, worth, asks_local)
            call report%judge(given, equations, state, limits)
            report%history = [report%history, report%residual]
            if (k == 0 .and. report%status == status_converged .and. &
                report%worst() > limits%guess_share*limits%tolerance) report%status = status_stalled
            if (report%status /= status_stalled .or. k == limits%largest_steps) exit
            if (allocated(problem%film_flow) .and. k > last_gain + patience) exit
            if (work_of(levels) - work_before >= limits%largest_work) exit

            if (k > 0) forcing = next_forcing(self, forcing, worth/worth_before)
            forcing = min(self%loosest, max(forcing, last_step_share*limits%tolerance/report%residual))
            worth_before = worth
            if (allocated(problem%film_flow)) before = state
            call linear_solve(self, levels, forcing, work_before + limits%largest_work, report)
            step = 1
            if (alternates(self, k)) step = 0.5_dp
            if (.not. take_step(self, problem, state, step)) then
               report%status = status_diverged
               exit
            end if
            report%nonlinear_steps = k + 1
         end do
      end associate
      if (report%status == status_converged) state%p = max(state%p, 0.0_dp)
      call self%linear%release()
   end subroutine improve

   !> Make ready to solve the last of the levels with what is given.
   subroutine pose(self, levels, given)
      class(newton_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)
      type(given_t), intent(in) :: given
      integer :: n

      n = size(levels)
      associate (linear => self%linear, nx => levels(n)%problem%grid%nx, ny => levels(n)%problem%grid%ny)
         call linear%borrow(levels, in_single=.true.)
         call linear%start(n)
         linear%inertia = given%load%inertia
         call set_wedge(linear, given%transport)
         self%gmres%largest_steps = self%largest_krylov
         if (allocated(self%film_change)) then
            if (all(shape(self%film_change) == [nx + 1, ny + 1])) return
            deallocate (self%rhs, self%change, self%film_change, self%cavitated_before, self%cavitated_earlier)
         end if
         allocate (self%rhs(linear%n), self%change(linear%n))
         allocate (self%film_change(0:nx, 0:ny))
         allocate (self%cavitated_before(0:nx, 0:ny), self%cavitated_earlier(0:nx, 0:ny), source=.false.)
      end associate
   end subroutine pose

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

   !> Equations and right side at the present state.
   subroutine assemble(self, problem, given, state, worth)
      class(newton_t), intent(inout), target :: self
      type(contact_problem_t), intent(in) :: problem
      type(given_t), intent(in) :: given
      type(state_t), intent(in) :: state
      real(dp), intent(out) :: worth   !! Euclidean norm of the right side
      real(dp), pointer, contiguous :: b(:, :)
      integer :: i, j

      associate (grid => problem%grid, linear => self%linear, level => self%linear%levels(self%linear%finest))
         call level%equations%evaluate(problem, given, state)
         call linear%count_evaluation()
         call linear%weigh(linear%finest)
         b(0:grid%nx, 0:grid%ny) => self%rhs(:linear%n - 1)
         do j = 0, grid%ny
            do i = 0, grid%nx
               if (level%equations%is_cavitated(i, j)) then
                  b(i, j) = -state%p(i, j)
               else
                  b(i, j) = -level%row_scale(i, j)*level%equations%residual(i, j)
               end if
            end do
         end do
         do i = 1, level%equations%edges%count()
            b(level%equations%edges%i(i), level%equations%edges%j(i)) = -level%equations%edge_excess(i)
         end do
         self%rhs(linear%n) = -level%equations%load_residual(given, state)
         worth = sqrt(sum(self%rhs**2))
      end associate
   end subroutine assemble

   !> Let the local solver do what it can, and assemble again. Where that is no gain for the whole, as upstream in
   !> steady states, which carry all that the part changes downstream, take it back.
   recursive subroutine improve_part(self, problem, given, limits, state, worth, is_gain)
      class(newton_t), intent(inout) :: self
      type(contact_problem_t), intent(inout) :: problem
      type(given_t), intent(in) :: given
      type(solve_limits_t), intent(in) :: limits
      type(state_t), intent(inout) :: state
      real(dp), intent(inout) :: worth       !! norm of the right side
      logical, intent(out) :: is_gain        !! or nothing was changed
      type(state_t) :: before
      real(dp), allocatable :: p(:, :)
      real(dp) :: worth_before

      is_gain = .true.
      associate (equations => self%linear%levels(self%linear%finest)%equations)
         call self%local%improve_part(problem, given, equations, limits, state, p)
         if (.not. allocated(p)) return
         before = state
         worth_before = worth
         state%p = p
         call problem%film(given, state%p, state%delta, state%h)
      end associate
      call assemble(self, problem, given, state, worth)
      is_gain = worth < worth_before
      if (is_gain) return
      state = before
      call assemble(self, problem, given, state, worth)
   end subroutine improve_part

   !> Go half of the way back to the state before, again and again, while the right side is much larger than the
   !> smallest so far. The flow of oils that are not Newtonian can grow exponentially with the pressure gradient: a step
   !> that makes the steep end steeper would be paid back by one factor e a step (line contact, M = 300, L = 12, tau0 =
   !> 0.5 MPa: from 0.2 to 1e7 in one step).
   subroutine go_back(self, problem, given, before, best, state, worth)
      class(newton_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(given_t), intent(in) :: given
      type(state_t), intent(in) :: before
      real(dp), intent(in) :: best               !! smallest norm of the right side so far
      type(state_t), intent(inout) :: state
      real(dp), intent(inout) :: worth           !! norm of the right side here
      integer :: n

      do n = 1, most_halvings
         if (worth_of_same(self) <= much_worse*best) return
         state%p = 0.5_dp*(before%p + state%p)
         state%h = 0.5_dp*(before%h + state%h)
         state%delta = 0.5_dp*(before%delta + state%delta)
         call assemble(self, problem, given, state, worth)
      end do
   end subroutine go_back

   !> Norm of the right side without the nodes that are cavitated and were not, or were and are not: their equation is
   !> another.
   real(dp) function worth_of_same(self) result(worth)
      class(newton_t), intent(in) :: self
      associate (now => self%linear%levels(self%linear%finest)%equations%is_cavitated, n => self%linear%n)
         worth = sqrt(sum(self%rhs(:n - 1)**2, mask=[self%cavitated_before .eqv. now]) + self%rhs(n)**2)
      end associate
   end function worth_of_same

   !> Newton direction in `change`. The factors are made afresh: that costs about one GMRES step and a half, and factors
   !> of the step before need two more on average, many more where the pattern moves the edge of the film. Where the
   !> factors do not serve (incomplete ones can be unstable), they are made again with a stronger diagonal.
   subroutine linear_solve(self, levels, forcing, largest_work, report)
      class(newton_t), intent(inout) :: self
      type(level_t), intent(in) :: levels(:)
      real(dp), intent(in) :: forcing
      real(dp), intent(in) :: largest_work   !! on these levels, from which on nothing is tried again
      type(solve_report_t), intent(inout) :: report
      integer :: rung

      do rung = 1, size(diagonal_shift)
         call self%linear%factorise(rung)
         report%factorisations = report%factorisations + 1
         call self%gmres%solve(self%linear, self%rhs, self%change, forcing)
         report%linear_steps = report%linear_steps + self%gmres%steps
         if (self%gmres%steps > 0 .and. self%gmres%reduction < 0.5_dp) exit
         if (work_of(levels) >= largest_work) exit
      end do
   end subroutine linear_solve

   !> Whether the active set goes back and forth between two sets; a half step then breaks the cycle.
   logical function alternates(self, k)
      class(newton_t), intent(inout) :: self
      integer, intent(in) :: k   !! steps taken
      associate (now => self%linear%levels(self%linear%finest)%equations%is_cavitated)
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
      real(dp) :: shorter, step

      associate (grid => problem%grid, n => self%linear%n)
         dp_(0:grid%nx, 0:grid%ny) => self%change(:n - 1)
         has_moved = ieee_is_finite(maxval(abs(dp_))) .and. ieee_is_finite(self%change(n))
         if (.not. has_moved) return
         step = longest*self%limit%of_pressure(dp_)
         call bend(self%linear%levels(self%linear%finest)%equations, step, dp_)
         dp_ = max(dp_, lowest_pressure - state%p)
         self%change(n) = step*self%change(n)
         call problem%deformation%apply(dp_, self%film_change)
         self%film_change = self%film_change - self%change(n)
         shorter = self%limit%of_film(state%h, self%film_change)
         has_moved = shorter > 0
         state%p = state%p + shorter*dp_
         state%delta = state%delta + shorter*self%change(n)
         state%h = state%h + shorter*self%film_change      ! the film is linear in P and Delta
      end associate
   end function take_step

end module ehlwave_newton
