!> Multigrid of the full approximation scheme (FAS) for one level and all below it.
!>
!> Brandt (1977); for these contacts Venner (1991), Venner and Lubrecht (2000).
module ehlwave_fas_multigrid
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_fas_transfer, only: correct, restrict
   use ehlwave_kinds, only: dp
   use ehlwave_level_solver, only: level_solver_t, solve_limits_t, solve_report_t
   use ehlwave_line_relaxation, only: line_relaxation_t
   use ehlwave_load_balance, only: load_balance_t
   use ehlwave_newton, only: newton_t
   use ehlwave_state, only: new_state, state_t
   use ehlwave_status, only: status_diverged, status_stalled
   use ehlwave_transport, only: transport_t
   implicit none (type, external)
   private

   integer, parameter :: sweeps_before = 1, sweeps_after = 2   !! the coarse problem; fewest work units measured
   integer, parameter :: direct_steps = 10           !! Newton steps per visit of the coarsest level
   real(dp), parameter :: direct_share = 0.01_dp     !! of the residual of the finest level, to be left there
   real(dp), parameter :: divergence = 1e3_dp        !! growth of the residual that ends a solve

   !> What a coarse problem was before a finer level put its right sides into it.
   type :: problem_terms_t
      type(transport_t) :: transport
      type(load_balance_t) :: load
      real(dp), allocatable :: rough(:, :)
   end type problem_terms_t

   !> Solver of one level; `coarser` is that of the next coarser one, or null on the coarsest.
   type, extends(level_solver_t), public :: fas_t
      character(len=1) :: cycle = 'f'             !! 'v', 'w' or 'f'
      type(fas_t), pointer :: coarser => null()
      type(line_relaxation_t), private :: relaxation
      type(contact_problem_t), pointer, private :: own_problem => null()
      type(newton_t), allocatable, private :: direct   ! solves the coarsest level; made when it is needed
      type(state_t), private :: state, restricted ! of this level as a coarser one: present, and as it came
      type(problem_terms_t), private :: kept
      integer, private :: sweeps = 0
   contains
      procedure :: init
      procedure :: solve
   end type fas_t

contains

   !> Work space for a problem's grid.
   subroutine init(self, problem)
      class(fas_t), intent(inout) :: self
      type(contact_problem_t), intent(in), target :: problem
      self%own_problem => problem
      call self%relaxation%init(problem)
      self%state = new_state(problem%grid)
      self%restricted = self%state
   end subroutine init

   !> See the interface. A nonlinear step is a cycle, a linear one a sweep on this level.
   subroutine solve(self, problem, state, limits, report)
      class(fas_t), intent(inout) :: self
      type(contact_problem_t), intent(inout), target :: problem
      type(state_t), intent(inout), target :: state
      type(solve_limits_t), intent(in) :: limits
      type(solve_report_t), intent(out) :: report
      integer :: k

      if (.not. associated(self%coarser)) then
         call solve_directly(self, problem, state, limits, report)
         return
      end if
      call keep_terms(self%coarser)
      allocate (report%history(0))
      self%sweeps = 0
      call problem%film(state%p, state%delta, state%h)
      call self%relaxation%evaluate(problem, state)
      do k = 0, limits%largest_steps
         call report%judge(problem, state, self%relaxation%residual, self%relaxation%is_cavitated, limits%tolerance)
         report%history = [report%history, report%residual]
         if (report%status /= status_stalled) exit
         if (report%residual > divergence*report%history(1)) report%status = status_diverged
         if (report%status == status_diverged .or. k == limits%largest_steps) exit
         call fas_cycle(self, problem, state, self%cycle, direct_share*report%residual)
         report%nonlinear_steps = k + 1
      end do
      report%linear_steps = self%sweeps
      call restore_terms(self%coarser)
   end subroutine solve

   !> One cycle from an evaluated state to an evaluated state.
   recursive subroutine fas_cycle(self, problem, state, cycle, tolerance)
      class(fas_t), intent(inout) :: self
      type(contact_problem_t), intent(inout), target :: problem
      type(state_t), intent(inout), target :: state
      character(len=1), intent(in) :: cycle
      real(dp), intent(in) :: tolerance         !! of the coarsest level
      integer :: visit
      type(solve_report_t) :: report

      if (.not. associated(self%coarser)) then
         call solve_directly(self, problem, state, solve_limits_t(tolerance=tolerance, largest_steps=direct_steps), report)
         if (.not. report%residual <= report%history(1)) state = self%restricted    ! better no correction
         return
      end if
      call relax(self, problem, state, sweeps_before)
      associate (coarser => self%coarser)
         call restrict(problem, state, self%relaxation, coarser%own_problem, coarser%state, coarser%relaxation)
         coarser%restricted = coarser%state
         do visit = 1, merge(1, 2, cycle == 'v' .or. .not. associated(coarser%coarser))
            call fas_cycle(coarser, coarser%own_problem, coarser%state, merge('v', cycle, cycle == 'f' .and. visit == 2), &
                           tolerance)
         end do
         call correct(coarser%own_problem, coarser%restricted, coarser%state, problem, self%relaxation%is_cavitated, state)
      end associate
      call self%relaxation%evaluate(problem, state)
      call relax(self, problem, state, sweeps_after)
   end subroutine fas_cycle

   !> Newton's method, for the coarsest level.
   subroutine solve_directly(self, problem, state, limits, report)
      class(fas_t), intent(inout) :: self
      type(contact_problem_t), intent(inout), target :: problem
      type(state_t), intent(inout), target :: state
      type(solve_limits_t), intent(in) :: limits
      type(solve_report_t), intent(out) :: report
      if (.not. allocated(self%direct)) then
         allocate (self%direct)
         call self%direct%init(problem)
      end if
      call self%direct%solve(problem, state, limits, report)
   end subroutine solve_directly

   !> Sweeps from an evaluated state to an evaluated state.
   subroutine relax(self, problem, state, sweeps)
      class(fas_t), intent(inout) :: self
      type(contact_problem_t), intent(inout) :: problem
      type(state_t), intent(inout) :: state
      integer, intent(in) :: sweeps
      integer :: n
      do n = 1, sweeps
         call self%relaxation%relax(problem, state)
         call self%relaxation%evaluate(problem, state)
      end do
      self%sweeps = self%sweeps + sweeps
   end subroutine relax

   !> Remember the problems of this level and those below.
   recursive subroutine keep_terms(self)
      class(fas_t), intent(inout) :: self
      self%kept%transport = self%own_problem%transport
      self%kept%load = self%own_problem%load
      if (allocated(self%kept%rough)) deallocate (self%kept%rough)
      if (allocated(self%own_problem%rough)) self%kept%rough = self%own_problem%rough
      if (associated(self%coarser)) call keep_terms(self%coarser)
   end subroutine keep_terms

   recursive subroutine restore_terms(self)
      class(fas_t), intent(inout) :: self
      self%own_problem%transport = self%kept%transport
      self%own_problem%load = self%kept%load
      if (allocated(self%own_problem%rough)) deallocate (self%own_problem%rough)
      if (allocated(self%kept%rough)) self%own_problem%rough = self%kept%rough
      if (associated(self%coarser)) call restore_terms(self%coarser)
   end subroutine restore_terms

end module ehlwave_fas_multigrid
