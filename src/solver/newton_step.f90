!> A step of Newton's method: right side, linear system, direction, length.
module ehlwave_newton_step
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_bent_step, only: bend
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_cycle_settings, only: diagonal_shift
   use ehlwave_given, only: given_t
   use ehlwave_hierarchy, only: level_t, work_of
   use ehlwave_kept_factors, only: kept_factors_t
   use ehlwave_kinds, only: dp
   use ehlwave_meniscus, only: fill_ahead
   use ehlwave_real_gmres, only: gmres_t
   use ehlwave_real_linearised_contact, only: linearised_contact_t, set_wedge
   use ehlwave_solve_report, only: solve_report_t
   use ehlwave_state, only: state_t
   use ehlwave_step_limit, only: step_limit_t
   use ehlwave_threads, only: is_shared
   implicit none (type, external)
   private

   !> The contact linearised on every level, where coarser levels precondition finer ones, and the work space of a
   !> step.
   type, public :: newton_step_t
      type(linearised_contact_t) :: linear
      type(gmres_t) :: gmres
      type(kept_factors_t) :: kept
      logical, private :: fills = .false.        !! the gap ahead of a meniscus: a steady state with too little oil
      real(dp), allocatable, private :: rhs(:), change(:), film_change(:, :)
      logical :: is_cut = .false.                !! the last step: node by node, see `take`
      type(state_t), private :: before           ! where that began
      real(dp), allocatable, private :: shorter_change(:)   ! shorter change as a whole
      logical, allocatable :: cavitated_before(:, :)
      logical, allocatable, private :: cavitated_earlier(:, :)
   contains
      procedure :: pose
      procedure :: assemble
      procedure :: worth_of_same
      procedure :: solve
      procedure :: alternates
      procedure :: take
      procedure :: take_shorter
   end type newton_step_t

   !> Lowest pressure of an iterate; solutions are clipped at 0. Where the pressure of a heavy contact vanishes within
   !> a cell, the flow to the last node grows as exp(-alphabar P). A bound of -0.02 takes three times as many Newton
   !> steps (M = 2000, L = 20, D = 0.07, 384 x 192 cells, fitted: 16 in place of 5).
   real(dp), parameter :: lowest_pressure = -0.002_dp
   real(dp), parameter :: few = 0.01_dp                !! share of the nodes, whose changes are cut individually
   real(dp), parameter :: much_shorter = 0.5_dp        !! share of a step, where they are

contains

   !> Prepare to solve the last of the levels with given data.
   subroutine pose(self, levels, given)
      class(newton_step_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)
      type(given_t), intent(in) :: given
      integer :: n

      n = size(levels)
      associate (linear => self%linear, nx => levels(n)%problem%grid%nx, ny => levels(n)%problem%grid%ny)
         call linear%borrow(levels, in_single=.true.)
         call linear%start(n)
         linear%inertia = given%load%inertia
         call set_wedge(linear, given%transport)
         self%fills = given%conserves_oil() .and. .not. allocated(given%transport%inflow)
         if (allocated(self%film_change)) then
            if (all(shape(self%film_change) == [nx + 1, ny + 1])) return
            deallocate (self%rhs, self%change, self%film_change, self%cavitated_before, self%cavitated_earlier)
         end if
         allocate (self%rhs(linear%n), self%change(linear%n))
         allocate (self%film_change(0:nx, 0:ny))
         allocate (self%cavitated_before(0:nx, 0:ny), self%cavitated_earlier(0:nx, 0:ny), source=.false.)
      end associate
   end subroutine pose

   !> Equations and right side at the present state.
   subroutine assemble(self, problem, given, state, worth)
      class(newton_step_t), intent(inout), target :: self
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
         !$omp parallel do private(i) schedule(static) if (is_shared(size(b)))
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

   !> Norm of the right side without the nodes that are cavitated and were not, or were and are not: their equation is
   !> another.
   real(dp) function worth_of_same(self) result(worth)
      class(newton_step_t), intent(in) :: self
      associate (now => self%linear%levels(self%linear%finest)%equations%is_cavitated, n => self%linear%n)
         worth = sqrt(sum(self%rhs(:n - 1)**2, mask=[self%cavitated_before .eqv. now]) + self%rhs(n)**2)
      end associate
   end function worth_of_same

   !> Newton direction in `change`. New factors cost 2.5 GMRES steps. They are kept for other steps while that saves
   !> work. Where new factors fail (incomplete ones can be unstable), they are made again with a stronger diagonal.
   subroutine solve(self, levels, forcing, largest_work, report)
      class(newton_step_t), intent(inout) :: self
      type(level_t), intent(in) :: levels(:)
      real(dp), intent(in) :: forcing
      real(dp), intent(in) :: largest_work   !! on these levels, from which on no GMRES step begins
      type(solve_report_t), intent(inout) :: report
      real(dp) :: factors_end, start
      integer :: rung

      self%linear%largest_work = largest_work
      if (self%kept%serve(self%linear%finest)) then
         start = work_of(levels)
         self%linear%largest_work = min(largest_work, start + self%kept%worth(forcing))
         call self%gmres%solve(self%linear, self%rhs, self%change, forcing)
         self%linear%largest_work = largest_work
         report%linear_steps = report%linear_steps + self%gmres%steps
         call self%kept%note_old(work_of(levels) - start, self%gmres%reduction)
         if (is_good(self%gmres) .or. work_of(levels) >= largest_work) return
      end if
      do rung = 1, size(diagonal_shift)
         start = work_of(levels)
         call self%linear%factorise(rung)
         factors_end = work_of(levels)
         report%factorisations = report%factorisations + 1
         call self%gmres%solve(self%linear, self%rhs, self%change, forcing)
         report%linear_steps = report%linear_steps + self%gmres%steps
         call self%kept%note_new(merge(self%linear%finest, 0, is_good(self%gmres)), factors_end - start, &
            work_of(levels) - factors_end, self%gmres%reduction)
         if (is_good(self%gmres)) exit
         if (work_of(levels) >= largest_work) exit
      end do
   end subroutine solve

   !> Whether the last solve was of use.
   pure logical function is_good(gmres)
      type(gmres_t), intent(in) :: gmres
      is_good = gmres%steps > 0 .and. gmres%reduction < 0.5_dp
   end function is_good

   !> Whether the active set goes back and forth between two sets; a half step then breaks the cycle.
   logical function alternates(self, k)
      class(newton_step_t), intent(inout) :: self
      integer, intent(in) :: k   !! steps taken
      logical, allocatable :: storage(:, :)
      associate (now => self%linear%levels(self%linear%finest)%equations%is_cavitated)
         alternates = .false.
         if (k >= 2) alternates = all(now .eqv. self%cavitated_earlier) .and. any(now .neqv. self%cavitated_before)
         call move_alloc(self%cavitated_earlier, storage)
         call move_alloc(self%cavitated_before, self%cavitated_earlier)
         call move_alloc(storage, self%cavitated_before)
         self%cavitated_before(:, :) = now
      end associate
   end function alternates

   !> Step along `change`, made shorter so that the pressure change and the film stay within their limits, and bent.
   !> False if there is no step to take.
   !>
   !> Where a few nodes of a steep spike exceed the limit of pressures, a step with cuts limits their changes and
   !> goes all the way elsewhere. A shorter step would leave most other residuals.
   !>
   !> Pressures may become slightly negative: the active set makes them zero in the next step. Clipping them at zero
   !> here instead leaves neighbours with changes that counted on the negative value, and the active set can go round
   !> in circles (measured: M = 50, D = 0.04, a cycle of four sets).
   logical function take(self, problem, limit, longest, may_cut, state) result(has_moved)
      class(newton_step_t), intent(inout), target :: self
      type(contact_problem_t), intent(inout) :: problem
      type(step_limit_t), intent(in) :: limit
      real(dp), intent(in) :: longest    !! step length, at most 1
      logical, intent(in) :: may_cut     !! node by node
      type(state_t), intent(inout) :: state
      real(dp), pointer, contiguous :: dp_(:, :)
      real(dp) :: step

      self%is_cut = .false.
      associate (grid => problem%grid, n => self%linear%n)
         dp_(0:grid%nx, 0:grid%ny) => self%change(:n - 1)
         step = longest*limit%of_pressure(dp_)
         has_moved = step > 0 .and. ieee_is_finite(self%change(n))
         if (.not. has_moved) return
         self%is_cut = may_cut .and. step < much_shorter*longest .and. &
                       count(abs(dp_) > limit%largest_change) <= few*n
         if (self%is_cut) then
            self%before = state
            self%shorter_change = self%change
            call bend_all(self, state, step, self%shorter_change)
            dp_ = limit%bounded(dp_)
            step = longest
         end if
      end associate
      call bend_all(self, state, step, self%change)
      has_moved = advance(self, problem, limit, state)
   end function take

   !> In place of a step that was cut and led nowhere: the whole step, shorter. False if there is none.
   logical function take_shorter(self, problem, limit, state) result(has_moved)
      class(newton_step_t), intent(inout) :: self
      type(contact_problem_t), intent(inout) :: problem
      type(step_limit_t), intent(in) :: limit
      type(state_t), intent(inout) :: state
      self%is_cut = .false.
      state = self%before
      self%change = self%shorter_change
      has_moved = advance(self, problem, limit, state)
   end function take_shorter

   !> A Newton direction bent and kept from pressures that are too low.
   subroutine bend_all(self, state, step, change)
      type(newton_step_t), intent(inout) :: self
      type(state_t), intent(in) :: state       !! where the step begins
      real(dp), intent(in) :: step             !! its length
      real(dp), intent(inout), contiguous, target :: change(:)
      real(dp), pointer, contiguous :: dp_(:, :)
      integer :: j

      associate (equations => self%linear%levels(self%linear%finest)%equations, n => self%linear%n)
         dp_(0:equations%mesh%grid%nx, 0:equations%mesh%grid%ny) => change(:n - 1)
         call bend(equations, step, dp_)
         !$omp parallel do schedule(static) if (is_shared(size(dp_)))
         do j = 0, ubound(dp_, 2)
            dp_(:, j) = max(dp_(:, j), lowest_pressure - state%p(:, j))
         end do
         if (self%fills) call fill_ahead(equations, state, dp_)
         change(n) = step*change(n)
      end associate
   end subroutine bend_all

   !> Go along `change` as far as the film lets. False if that is nowhere.
   logical function advance(self, problem, limit, state) result(has_moved)
      type(newton_step_t), intent(inout), target :: self
      type(contact_problem_t), intent(inout) :: problem
      type(step_limit_t), intent(in) :: limit
      type(state_t), intent(inout) :: state
      real(dp), pointer, contiguous :: dp_(:, :)
      real(dp) :: shorter
      integer :: j

      associate (grid => problem%grid, n => self%linear%n)
         dp_(0:grid%nx, 0:grid%ny) => self%change(:n - 1)
         call problem%deformation%apply(dp_, self%film_change)
         !$omp parallel do schedule(static) if (is_shared(size(dp_)))
         do j = 0, grid%ny
            self%film_change(:, j) = self%film_change(:, j) - self%change(n)
         end do
         shorter = limit%of_film(state%h, self%film_change)
         has_moved = shorter > 0
         !$omp parallel do schedule(static) if (is_shared(size(dp_)))
         do j = 0, grid%ny
            state%p(:, j) = state%p(:, j) + shorter*dp_(:, j)
            state%h(:, j) = state%h(:, j) + shorter*self%film_change(:, j)   ! the film is linear in P and Delta
         end do
         state%delta = state%delta + shorter*self%change(n)
      end associate
   end function advance

end module ehlwave_newton_step
