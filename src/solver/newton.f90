!> Newton's method with an active set for the cavitated nodes, GMRES inside.
module ehlwave_newton
   use ehlwave_assertions, only: assert, checks
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_cycle_settings, only: newton_cycle
   use ehlwave_equations, only: equations_t
   use ehlwave_given, only: given_t
   use ehlwave_hierarchy, only: hierarchy_t, level_t, work_of
   use ehlwave_kinds, only: dp
   use ehlwave_level_solver, only: level_solver_t
   use ehlwave_local_solver, only: local_solver_t
   use ehlwave_newton_step, only: newton_step_t
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged, status_diverged, status_stalled
   use ehlwave_step_limit, only: step_limit_t
   implicit none (type, external)
   private

   real(dp), parameter :: last_step_share = 0.2_dp   !! share of the tolerance, left by the linear solver in the last
                                                     !! step
   ! Oils that are not Newtonian:
   real(dp), parameter :: much_worse = 2         !! right side over the smallest so far above which a step is taken back
                                                 !! by halves
   real(dp), parameter :: starved_worse = 30     !! limit where a meniscus moves: its nodes have other residuals at
                                                 !! each place (M = 61, L = 3.9, D = 0.32, r = 0.57: a stall with 2)
   integer, parameter :: most_halvings = 10
   real(dp), parameter :: progress = 0.9_dp      !! share of the smallest right side to be reached in so many steps
   integer, parameter :: patience = 15, starved_patience = 10
   ! Starved contacts whose film closes come to rest away from the solution, at a right side that changes by less than
   ! this share for so many steps; so do contacts that a coarse grid does not resolve.
   real(dp), parameter :: starved_rest = 0.03_dp, coarse_rest = 0.01_dp
   integer, parameter :: most_starved_rests = 3, most_coarse_rests = 6
   !> Right side after a step that was cut, over that before, above which it is taken back and made shorter.
   real(dp), parameter :: cut_gain = 0.3_dp
   !> Largest linear tolerance of starved contacts: looser, the remaining residuals at the meniscus would move it by
   !> some cells and stall the method (M = 149, L = 14, D = 0.14, r = 1.6, 192 x 64 cells).
   real(dp), parameter :: starved_forcing = 5e-3_dp

   !> Iterations with limits and patience; `newton_step_t` does a single iteration.
   type, extends(level_solver_t), public :: newton_t
      type(step_limit_t) :: limit
      real(dp) :: loosest = 0.035_dp             !! linear tolerance far from the solution
      real(dp) :: tightest = 1e-4_dp             !! tolerance close to the solution
      integer :: largest_krylov = 60
      class(local_solver_t), allocatable :: local   !! for residuals large in a small part of the domain only
      type(newton_step_t), private :: step
   contains
      procedure :: init
      procedure :: init_levels
      procedure :: solve
      procedure :: improve
      procedure :: last_equations
   end type newton_t

contains

   !> See the interface.
   subroutine init(self, hierarchy, finest)
      class(newton_t), intent(inout) :: self
      type(hierarchy_t), intent(in) :: hierarchy
      integer, intent(in) :: finest
      call self%init_levels(hierarchy%levels(:finest))
   end subroutine init

   !> Initialise some levels.
   subroutine init_levels(self, levels)
      class(newton_t), intent(inout) :: self
      type(level_t), intent(in) :: levels(:)   !! coarsest first
      call self%step%linear%init(levels, newton_cycle)
   end subroutine init_levels

   !> See the interface.
   subroutine solve(self, hierarchy, l, limits, report)
      class(newton_t), intent(inout) :: self
      type(hierarchy_t), intent(inout), target :: hierarchy
      integer, intent(in) :: l
      type(solve_limits_t), intent(in) :: limits
      type(solve_report_t), intent(out) :: report
      type(state_t) :: state

      call hierarchy%levels(l)%state%move_to(state)
      call self%improve(hierarchy%levels(:l), hierarchy%levels(l)%given, state, limits, report)
      call state%move_to(hierarchy%levels(l)%state)
   end subroutine solve

   !> Improve the last of some levels, with another state and other data.
   recursive subroutine improve(self, levels, given, state, limits, report)
      class(newton_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)   !! coarsest first
      type(given_t), intent(in) :: given
      type(state_t), intent(inout) :: state
      type(solve_limits_t), intent(in) :: limits
      type(solve_report_t), intent(out) :: report
      type(state_t) :: before
      real(dp) :: best, forcing, length, work_before, worth, worth_before
      integer :: k, last_gain, rests
      logical :: asks_local, is_starved, may_cut

      if (checks) call assert(allocated(state%p) .and. limits%tolerance > 0, &
                              'newton%improve: a first guess and a tolerance')
      self%step%gmres%largest_steps = self%largest_krylov
      call self%step%pose(levels, given)
      call self%step%kept%begin(limits%keeps_factors)
      allocate (report%history(0))
      worth_before = 0
      rests = 0
      work_before = work_of(levels)
      forcing = min(self%loosest, limits%loosest)
      ! most changes by heat are smooth, and a part alone may end beside the solution
      asks_local = allocated(self%local) .and. .not. allocated(given%supply) .and. &
                   (limits%starts_in_part .or. .not. allocated(levels(size(levels))%problem%heat))
      is_starved = given%conserves_oil()
      self%step%is_cut = .false.
      may_cut = levels(size(levels))%problem%rheology%is_newtonian()
      if (.not. may_cut) before = state
      associate (problem => levels(size(levels))%problem, equations => self%step%linear%levels(size(levels))%equations)
         call problem%film_of_guess(given, state)
         do k = 0, limits%largest_steps
            call self%step%assemble(problem, given, state, worth)
            if (k == 0) then
               best = worth
               last_gain = 0
            end if
            if (.not. problem%rheology%is_newtonian()) then
               if (k > 0) then
                  call go_back(self, problem, given, before, merge(starved_worse, much_worse, is_starved)*best, &
                               work_before + limits%largest_work, levels, state, worth)
                  if (any(self%step%cavitated_before .neqv. equations%is_cavitated)) best = max(best, worth)
               end if
               if (worth < progress*best) last_gain = k
               best = min(best, worth)
            end if
            if (asks_local) call improve_part(self, problem, given, left(), state, worth, asks_local)
            if (self%step%is_cut .and. worth > cut_gain*worth_before) then
               may_cut = .false.
               if (.not. self%step%take_shorter(problem, self%limit, state)) exit
               call self%step%assemble(problem, given, state, worth)
               if (asks_local) call improve_part(self, problem, given, left(), state, worth, asks_local)
            end if
            call report%judge(given, equations, state, limits)
            report%history = [report%history, report%residual]
            if (k == 0 .and. report%status == status_converged .and. &
                report%worst() > limits%guess_share*limits%tolerance) report%status = status_stalled
            if (report%status /= status_stalled .or. k == limits%largest_steps) exit
            if (.not. problem%rheology%is_newtonian() .and. k > last_gain + patience) exit
            if (is_starved) then   ! a film that closes stays closed
               if (worth < progress*best .or. worth > much_worse*worth_before) last_gain = k
               best = min(merge(best, worth, last_gain < k), worth)
               rests = merge(rests + 1, 0, abs(worth - worth_before) < starved_rest*worth)
               if (k > last_gain + starved_patience .or. rests == most_starved_rests) exit
            else if (limits%gives_up) then
               rests = merge(rests + 1, 0, k > 0 .and. abs(worth - worth_before) < coarse_rest*worth)
               if (rests == most_coarse_rests) exit
            end if
            if (work_of(levels) - work_before >= limits%largest_work) exit

            if (k > 0) forcing = next_forcing(self, forcing, worth/worth_before)
            associate (last => last_step_share*limits%tolerance)
               forcing = min(self%loosest, max(forcing, last/max(last, report%residual)))
            end associate
            if (is_starved) forcing = min(forcing, starved_forcing)
            worth_before = worth
            if (.not. problem%rheology%is_newtonian()) before = state
            call self%step%solve(levels, forcing, work_before + limits%largest_work, report)
            length = 1
            if (self%step%alternates(k)) length = 0.5_dp
            if (is_starved .and. k > 1) then   ! a meniscus that comes back nearer to the solution is no cycle
               if (report%residual < report%history(k - 1)) length = 1
            end if
            if (.not. self%step%take(problem, self%limit, length, may_cut .and. asks_local, state)) then
               report%status = status_diverged
               exit
            end if
            report%nonlinear_steps = k + 1
            if (limits%leaves_last .and. k + 1 == limits%largest_steps) then
               call equations%follow(state)
               exit
            end if
         end do
      end associate
      if (report%status == status_converged) state%p = max(state%p, 0.0_dp)
      call self%step%linear%release()
   contains

      !> Limits of a solve on a part of the grid.
      function left()
         type(solve_limits_t) :: left
         left = limits
         left%largest_work = limits%largest_work - (work_of(levels) - work_before)
      end function left

   end subroutine improve

   !> See the interface.
   function last_equations(self) result(equations)
      class(newton_t), intent(in), target :: self
      type(equations_t), pointer :: equations
      equations => null()
      if (allocated(self%step%linear%levels)) equations => self%step%linear%levels(self%step%linear%finest)%equations
   end function last_equations

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

   !> Apply the local solver, and assemble again. Revert it where the whole does not gain, as upstream in steady
   !> states, where changes of the part move downstream.
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
      associate (equations => self%step%linear%levels(self%step%linear%finest)%equations)
         call self%local%improve_part(problem, given, equations, limits, state, p)
         if (.not. allocated(p)) return
         call state%move_to(before)
         worth_before = worth
         call move_alloc(p, state%p)
         allocate (state%h(0:problem%grid%nx, 0:problem%grid%ny))
         call problem%film(given, state%p, state%delta, state%h)
      end associate
      call self%step%assemble(problem, given, state, worth)
      is_gain = worth < worth_before
      if (is_gain) return
      call before%move_to(state)
      call self%step%assemble(problem, given, state, worth)
   end subroutine improve_part

   !> Go half of the way back to the previous state, again and again, while the right side is much larger than the
   !> smallest so far. The flow of oils that are not Newtonian can grow exponentially with the pressure gradient: a step
   !> that makes the steep end steeper recovers only by a factor e per step (line contact, M = 300, L = 12, tau0 = 0.5
   !> MPa: from 0.2 to 1e7 in a step).
   subroutine go_back(self, problem, given, before, most, largest_work, levels, state, worth)
      class(newton_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(given_t), intent(in) :: given
      type(state_t), intent(in) :: before
      real(dp), intent(in) :: most               !! norm of the current right side
      real(dp), intent(in) :: largest_work       !! on the levels, from which on it goes no farther
      type(level_t), intent(in) :: levels(:)
      type(state_t), intent(inout) :: state
      real(dp), intent(inout) :: worth           !! norm of the right side here
      integer :: n

      do n = 1, most_halvings
         if (self%step%worth_of_same() <= most .or. work_of(levels) >= largest_work) return
         state%p = 0.5_dp*(before%p + state%p)
         state%h = 0.5_dp*(before%h + state%h)
         state%delta = 0.5_dp*(before%delta + state%delta)
         call self%step%assemble(problem, given, state, worth)
      end do
   end subroutine go_back

end module ehlwave_newton
