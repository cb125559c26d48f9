!> The steady state of a contact with heat, from that without: pressure and film by Newton's method under held
!> temperatures, and temperatures by marches through the film, in turn.
module ehlwave_warm_steady
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_anderson, only: anderson_t
   use ehlwave_capped_solver, only: capped_solver_t
   use ehlwave_energy, only: energy_t, new_energy, warm_problem
   use ehlwave_equations, only: equations_t
   use ehlwave_full_multigrid, only: full_multigrid_t, levels_below
   use ehlwave_heat_data, only: heat_scales_t
   use ehlwave_grid, only: grid_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_real_transfer, only: interpolate
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged, status_stalled
   implicit none (type, external)
   private
   public :: solve_warm

   integer, parameter :: most_rounds = 40, most_coarse_rounds = 20
   real(dp), parameter :: linear_tolerance = 0.01_dp  !! with temperatures from the coarser level: most rounds need one
                                                      !! step
   real(dp), parameter :: fastest = 0.2_dp  !! least ratio of changes in rounds that follow, which is relied upon
   integer, parameter :: more_steps = 6             !! steps of Newton's method in a round, more than the usual 1: where
                                                    !! temperatures have settled, and where its active set goes to and
   real(dp), parameter :: stuck = 0.5_dp            !! fro, the residual exceeding the previous residual
   real(dp), parameter :: settled = 100             !! change of film and heat in a round, in units of the tolerance
   real(dp), parameter :: loosening = 1.3_dp        !! factor on the tolerance with each round beyond so many: where a
                                                    !! node at the edge
   integer, parameter :: patience = 12  !! rounds before the film, or the backflow, counts as going to and fro
   real(dp), parameter :: loose = 5  !! change of temperatures over the tolerance, to which integrals hardly respond
   integer, parameter :: marches = 6                !! in a round, at most: where temperatures change by more than
   real(dp), parameter :: far = 0.03_dp             !! this share of themselves
   real(dp), parameter :: ahead_of_film = 3         !! multiple of the film's change
   ! A step of Newton's method is not judged where the changes before it are between
   real(dp), parameter :: farther = 10              !! so many bounds
   real(dp), parameter :: near = 0.05_dp            !! this share

   real(dp), parameter :: ahead = 0.25_dp           !! share of a difference of two grids: to the next, of second order

   !> Change of a state by heat.
   type :: warming_t
      real(dp), allocatable :: p(:, :), rise(:, :, :), into_wall(:, :, :)
      real(dp) :: delta = 0
   contains
      procedure :: to_finer
      procedure :: give
   end type warming_t

contains

   !> Steady state with heat on the finest level and, for error estimates, on those next below. All levels have the
   !> state without heat, the finest converged; those that have none are passed over.
   subroutine solve_warm(multigrid, cap, scales, intervals, limits, coarse_tolerance, energy)
      type(full_multigrid_t), intent(inout) :: multigrid
      class(capped_solver_t), intent(inout) :: cap
      type(heat_scales_t), intent(in) :: scales
      integer, intent(in) :: intervals                 !! across the film
      type(solve_limits_t), intent(in) :: limits       !! for the finest level
      real(dp), intent(in) :: coarse_tolerance         !! for the others
      type(energy_t), intent(out) :: energy            !! energy equation of the finest level
      type(warming_t), allocatable :: below, predicted
      type(state_t) :: cold
      type(solve_limits_t) :: here
      integer :: l, n
      logical :: is_solved

      n = size(multigrid%levels)
      multigrid%levels(:n - levels_below - 1)%central_film = no_value
      do l = max(1, n - levels_below), n
         is_solved = multigrid%levels(l)%has_film()
         multigrid%levels(l)%central_film = no_value
         if (.not. (is_solved .or. l == n)) cycle
         cold = multigrid%levels(l)%state
         call warm_problem(multigrid%levels(l)%problem, intervals)
         if (allocated(predicted)) deallocate (predicted)
         if (allocated(below)) then
            predicted = below%to_finer(multigrid%levels(l - 1)%problem%grid, multigrid%levels(l)%problem%grid)
            call predicted%give(multigrid%levels(l))
            deallocate (below)
         end if
         energy = new_energy(intervals, scales, multigrid%levels(l)%problem%grid)
         if (allocated(predicted)) energy%into_wall = predicted%into_wall
         here = limits
         if (l < n) here%tolerance = max(limits%tolerance, coarse_tolerance)
         call settle(multigrid, l, allocated(predicted), here, cap, energy)
         if (multigrid%levels(l)%report%status /= status_converged) cycle
         call multigrid%take_film(l)
         if (l < n) below = warming_of(multigrid%levels(l), cold, energy%into_wall, predicted)
      end do
   end subroutine solve_warm

   !> Change of a level's state by heat. Where it was predicted from the next coarser level, a quarter of the
   !> difference is added, the expected difference of the next finer grid.
   pure function warming_of(level, cold, into_wall, predicted) result(found)
      type(level_t), intent(in) :: level
      type(state_t), intent(in) :: cold                    !! without heat
      real(dp), intent(in) :: into_wall(:, 0:, 0:)         !! heat flows into both surfaces
      type(warming_t), intent(in), optional :: predicted
      type(warming_t) :: found
      found%p = level%state%p - cold%p
      found%delta = level%state%delta - cold%delta
      found%rise = level%problem%heat%rise
      found%into_wall = into_wall
      if (.not. present(predicted)) return
      found%p = found%p + ahead*(found%p - predicted%p)
      found%delta = found%delta + ahead*(found%delta - predicted%delta)
      found%rise = found%rise + ahead*(found%rise - predicted%rise)
      found%into_wall = found%into_wall + ahead*(found%into_wall - predicted%into_wall)
   end function warming_of

   !> Change on the next finer grid.
   function to_finer(self, coarse, fine) result(finer)
      class(warming_t), intent(in) :: self
      type(grid_t), intent(in) :: coarse, fine
      type(warming_t) :: finer

      allocate (finer%p(0:fine%nx, 0:fine%ny))
      call interpolate(coarse, fine, self%p, finer%p)
      finer%delta = self%delta
      finer%rise = planes_of(self%rise)
      finer%into_wall = planes_of(self%into_wall)

   contains

      function planes_of(values) result(found)
         real(dp), intent(in) :: values(:, :, :)
         real(dp) :: found(size(values, 1), 0:fine%nx, 0:fine%ny), plane(0:fine%nx, 0:fine%ny)
         integer :: k
         do k = 1, size(values, 1)
            call interpolate(coarse, fine, values(k, :, :), plane)
            found(k, :, :) = plane
         end do
      end function planes_of

   end function to_finer

   !> Change the state of a level, and its temperatures.
   pure subroutine give(self, level)
      class(warming_t), intent(in) :: self
      type(level_t), intent(inout) :: level
      where (level%state%p > 0) level%state%p = max(level%state%p + self%p, 0.0_dp)
      level%state%delta = level%state%delta + self%delta
      level%problem%heat%rise = self%rise
   end subroutine give

   !> Rounds on a level until neither the film nor the temperatures change. Each marches temperatures. Then it solves
   !> for the film under them, unless both are settled.
   subroutine settle(multigrid, l, is_predicted, limits, cap, energy)
      type(full_multigrid_t), intent(inout) :: multigrid
      integer, intent(in) :: l
      logical, intent(in) :: is_predicted              !! whether the level has temperatures that its film is not yet of
      type(solve_limits_t), intent(in) :: limits
      class(capped_solver_t), intent(inout) :: cap
      type(energy_t), intent(inout) :: energy
      type(anderson_t) :: anderson
      type(solve_limits_t) :: here
      type(solve_report_t) :: report, total
      real(dp), allocatable :: rise(:, :, :)
      real(dp) :: before, bound, centre, change, earlier(2), residual
      integer :: again, round, rounds
      logical :: is_near, is_settled, is_stuck, is_warm

      associate (level => multigrid%levels(l))
         total = level%report
         rounds = merge(most_rounds, most_coarse_rounds, l == size(multigrid%levels))
         call level%problem%film(level%given, level%state%p, level%state%delta, level%state%h)
         call energy%weigh(level%problem, level%state)
         centre = level%problem%grid%value_at_centre(level%state%h)
         is_stuck = .false.
         residual = 0
         earlier = huge(before)
         energy%film_difference = huge(before)
         report%status = status_stalled
         here = limits
         if (is_predicted) then
            here%loosest = linear_tolerance
            here%starts_in_part = .true.
            call improve(multigrid, l, here, 1, .false., cap, report, total)
            here%starts_in_part = .false.
            energy%film_difference = abs(level%problem%grid%value_at_centre(level%state%h)/centre - 1)
         end if
         do round = 1, rounds
            rise = level%problem%heat%rise
            do again = 1, marches
               if (again > 1) call energy%weigh(level%problem, level%state)
               call march(multigrid, l, is_predicted .or. round > 1, cap, energy)
               if (.not. (energy%difference > far .and. energy%difference/ahead_of_film > energy%film_difference)) exit
            end do
            is_settled = .false.
            if (.not. ieee_is_finite(energy%difference)) exit
            bound = settled*limits%tolerance*loosening**max(0, round - patience)
            if (again > 1) earlier = huge(before)   ! marches under one film settle faster than rounds
            change = share_left([energy%difference, energy%heat_difference], earlier)
            is_warm = change*max(energy%heat_difference, energy%difference/loose) <= bound
            earlier = [energy%difference, merge(energy%heat_difference, huge(before), round > 1)]
            is_settled = report%status == status_converged .and. is_warm .and. energy%film_difference <= bound
            if (is_settled) exit
            if (is_predicted .or. round > 1) &
               call anderson%mix(size(rise, 1), size(level%state%p), max(level%state%p, 0.0_dp), rise, &
                                 level%problem%heat%rise)
            call energy%weigh(level%problem, level%state)
            before = level%problem%grid%value_at_centre(level%state%h)
            residual = report%residual
            change = max(energy%difference, energy%film_difference)
            is_near = .not. max(change, merge(energy%heat_difference, 0.0_dp, round > 1)) > farther*bound
            call improve(multigrid, l, here, merge(more_steps, 1, is_warm .or. is_stuck), &
                         .not. (is_near .or. is_stuck .or. change > near), cap, report, total)
            centre = level%problem%grid%value_at_centre(level%state%h)
            energy%film_difference = abs(centre/before - 1)
            if (report%status /= status_converged .and. report%status /= status_stalled) exit
            is_settled = report%status == status_converged .and. is_warm .and. energy%film_difference <= bound
            if (is_settled) exit
            is_stuck = round > 2 .and. report%status == status_stalled .and. report%residual > stuck*residual
            if (cap%is_spent()) exit
         end do
         if (is_settled) then
            call energy%finish(level%problem, level%state)
            call energy%weigh(level%problem, level%state)
         end if
         if (report%status == status_converged .and. .not. is_settled) report%status = status_stalled
         report%nonlinear_steps = total%nonlinear_steps
         report%linear_steps = total%linear_steps
         report%factorisations = total%factorisations
         level%report = report
      end associate
   end subroutine settle

   !> Share of the last changes, of temperatures and of their heat, that all further rounds may change: they fall as a
   !> geometric series with the slower ratio.
   pure real(dp) function share_left(now, earlier) result(share)
      real(dp), intent(in) :: now(2), earlier(2)   !! changes; earlier ones are huge if not known
      real(dp) :: ratio
      ratio = maxval([fastest, now/earlier])
      share = 1
      if (earlier(1) < huge(ratio) .and. ratio < 0.5_dp) share = ratio/(1 - ratio)
   end function share_left

   !> Temperatures by a march through the film of a level.
   subroutine march(multigrid, l, is_solved, cap, energy)
      type(full_multigrid_t), intent(inout), target :: multigrid
      integer, intent(in) :: l
      logical, intent(in) :: is_solved             !! whether it was the last that was solved for
      class(capped_solver_t), intent(inout) :: cap
      type(energy_t), intent(inout) :: energy
      type(equations_t), target :: own
      type(equations_t), pointer :: equations
      real(dp) :: work_before

      work_before = multigrid%work()
      associate (level => multigrid%levels(l))
         equations => null()
         if (is_solved) equations => multigrid%last_equations(l)
         if (.not. associated(equations)) then
            call own%init(level%problem)
            call own%evaluate(level%problem, level%given, level%state)
            equations => own
         end if
         call energy%march(level%problem, level%state, equations%flow, until_film_ends=.true.)
      end associate
      cap%work_left = cap%work_left - (multigrid%work() - work_before)
   end subroutine march

   !> Steps of Newton's method under the temperatures of a level, within the cap; the last is judged or kept. `total`
   !> counts the steps of all rounds.
   subroutine improve(multigrid, l, limits, steps, leaves_last, cap, report, total)
      type(full_multigrid_t), intent(inout) :: multigrid
      integer, intent(in) :: l, steps
      logical, intent(in) :: leaves_last
      type(solve_limits_t), intent(in) :: limits
      class(capped_solver_t), intent(inout) :: cap
      type(solve_report_t), intent(out) :: report
      type(solve_report_t), intent(inout) :: total
      type(solve_limits_t) :: here
      real(dp) :: work_before

      here = limits
      here%largest_steps = min(steps, cap%steps_left)
      here%leaves_last = leaves_last
      work_before = multigrid%work()
      call multigrid%solve_level(l, here, report)
      cap%work_left = cap%work_left - (multigrid%work() - work_before)
      if (l == size(multigrid%levels)) cap%steps_left = cap%steps_left - report%nonlinear_steps
      total%nonlinear_steps = total%nonlinear_steps + report%nonlinear_steps
      total%linear_steps = total%linear_steps + report%linear_steps
      total%factorisations = total%factorisations + report%factorisations
   end subroutine improve

end module ehlwave_warm_steady
