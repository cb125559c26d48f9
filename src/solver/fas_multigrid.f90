!> Multigrid of the full approximation scheme (FAS) for a level and all below it.
!>
!> Brandt (1977); for these contacts Venner (1991), Venner and Lubrecht (2000).
module ehlwave_fas_multigrid
   use ehlwave_assertions, only: assert, checks
   use ehlwave_fas_level, only: fas_level_t
   use ehlwave_given, only: given_t
   use ehlwave_hierarchy, only: hierarchy_t
   use ehlwave_kinds, only: dp
   use ehlwave_level_solver, only: level_solver_t
   use ehlwave_newton, only: newton_t
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_status, only: status_diverged, status_stalled
   implicit none (type, external)
   private

   integer, parameter :: sweeps_before = 1, sweeps_after = 2   !! the coarse problem; fewest work units measured
   integer, parameter :: direct_steps = 10           !! Newton steps per visit of the coarsest level
   real(dp), parameter :: direct_share = 0.01_dp     !! share of the residual of the finest level that may remain
   real(dp), parameter :: divergence = 1e3_dp        !! growth of the residual, over the least, that ends a solve
   !> Cycles without `progress` that end a solve: on grids that do not resolve a heavy contact a film can close, and
   !> then no step may go far (M = 10,000 on 64 to 256 cells).
   integer, parameter :: patience = 6
   real(dp), parameter :: progress = 0.9_dp          !! the largest error over the least before, at most

   type, extends(level_solver_t), public :: fas_t
      character(len=1) :: cycle = 'f'             !! 'v', 'w' or 'f'
      type(fas_level_t), allocatable, private :: levels(:)   ! coarsest first
      type(newton_t), private :: direct           ! solves the coarsest level
      real(dp), private :: most_work = huge(1.0_dp)   ! work of the hierarchy, from which on no further step begins
   contains
      procedure :: init
      procedure :: solve
   end type fas_t

contains

   !> See the interface.
   subroutine init(self, hierarchy, finest)
      class(fas_t), intent(inout) :: self
      type(hierarchy_t), intent(in) :: hierarchy
      integer, intent(in) :: finest
      integer :: l

      if (allocated(self%levels)) deallocate (self%levels)
      allocate (self%levels(finest))
      do l = 1, finest
         call self%levels(l)%init(hierarchy%levels(l)%problem)
      end do
      call self%direct%init(hierarchy, 1)
   end subroutine init

   !> See the interface. A nonlinear step is a cycle, a linear one a sweep on this level. The sweeps after the coarse
   !> problem end where the tolerance is met.
   subroutine solve(self, hierarchy, l, limits, report)
      class(fas_t), intent(inout) :: self
      type(hierarchy_t), intent(inout), target :: hierarchy
      integer, intent(in) :: l
      type(solve_limits_t), intent(in) :: limits
      type(solve_report_t), intent(out) :: report
      real(dp) :: work_before, least
      integer :: k, n, of_least

      least = huge(1.0_dp)
      of_least = 0
      if (checks) call assert(allocated(self%levels), 'fas%solve: init came first')
      if (l == 1) then
         call self%direct%solve(hierarchy, l, limits, report)
         return
      end if
      allocate (report%history(0))
      work_before = hierarchy%work()
      self%most_work = work_before + limits%largest_work
      associate (problem => hierarchy%levels(l)%problem, given => hierarchy%levels(l)%given, level => self%levels(l), &
                 state => self%levels(l)%state)
         call state%exchange(hierarchy%levels(l)%state)
         call problem%film_of_guess(given, state)
         call level%evaluate(problem, given)
         do k = 0, limits%largest_steps
            if (k == 0) call judge()
            report%history = [report%history, report%residual]
            if (report%status /= status_stalled) exit
            if (report%residual > divergence*minval(report%history)) report%status = status_diverged
            if (report%status == status_diverged .or. k == limits%largest_steps) exit
            if (hierarchy%work() >= self%most_work) exit
            if (report%worst() < progress*least) then
               least = report%worst()
               of_least = k
            end if
            if (k - of_least >= patience) exit
            call fas_cycle(self, hierarchy, l, given, self%cycle, direct_share*report%residual)
            report%linear_steps = report%linear_steps + sweeps_before
            do n = 1, sweeps_after
               call level%relax(problem, given, 1)
               report%linear_steps = report%linear_steps + 1
               call judge()
               if (report%status /= status_stalled) exit
            end do
            report%nonlinear_steps = k + 1
         end do
         call state%exchange(hierarchy%levels(l)%state)
      end associate

   contains

      !> Judge the present state.
      subroutine judge()
         call report%judge(hierarchy%levels(l)%given, self%levels(l)%equations, self%levels(l)%state, &
                           solve_limits_t(tolerance=limits%tolerance))
      end subroutine judge

   end subroutine solve

   !> A cycle from an evaluated state to an evaluated state, but for the sweeps after the coarse problem.
   recursive subroutine fas_cycle(self, hierarchy, l, given, cycle, tolerance)
      class(fas_t), intent(inout) :: self
      type(hierarchy_t), intent(inout) :: hierarchy
      integer, intent(in) :: l
      type(given_t), intent(in) :: given        !! to that level
      character(len=1), intent(in) :: cycle
      real(dp), intent(in) :: tolerance         !! tolerance of the coarsest level
      integer :: visit

      if (hierarchy%work() >= self%most_work) return   ! no correction
      if (l == 1) then
         call solve_directly(self, hierarchy, tolerance)
         return
      end if
      call self%levels(l)%relax(hierarchy%levels(l)%problem, given, sweeps_before)
      call self%levels(l - 1)%restrict(hierarchy%levels(l - 1)%problem, self%levels(l), given)
      do visit = 1, merge(1, 2, cycle == 'v' .or. l == 2)
         call fas_cycle(self, hierarchy, l - 1, self%levels(l - 1)%given, &
                        merge('v', cycle, cycle == 'f' .and. visit == 2), tolerance)
         if (l > 2) call self%levels(l - 1)%relax(hierarchy%levels(l - 1)%problem, self%levels(l - 1)%given, &
                                                  sweeps_after)
      end do
      call self%levels(l)%correct(hierarchy%levels(l)%problem, given, self%levels(l - 1))
   end subroutine fas_cycle

   !> Newton's method for the coarse problem of a finer level on the coarsest.
   subroutine solve_directly(self, hierarchy, tolerance)
      class(fas_t), intent(inout) :: self
      type(hierarchy_t), intent(inout) :: hierarchy
      real(dp), intent(in) :: tolerance
      type(solve_report_t) :: report

      associate (coarsest => self%levels(1))
         call self%direct%improve(hierarchy%levels(:1), coarsest%given, coarsest%state, &
                                  solve_limits_t(tolerance=tolerance, largest_steps=direct_steps, &
                                                 largest_work=self%most_work - hierarchy%work()), report)
         if (.not. report%residual <= report%history(1)) coarsest%state = coarsest%restricted    ! better no correction
      end associate
   end subroutine solve_directly

end module ehlwave_fas_multigrid
