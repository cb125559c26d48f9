!> The steady state of a contact with heat, from that without: pressure and film by Newton's method under held
!> temperatures, and temperatures by marches through the film, in turn.
module ehlwave_warm_steady
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_capped_solver, only: capped_solver_t
   use ehlwave_energy, only: energy_t, new_energy, warm_problem
   use ehlwave_equations, only: equations_t
   use ehlwave_full_multigrid, only: full_multigrid_t, levels_below
   use ehlwave_heat_data, only: heat_scales_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_real_transfer, only: interpolate
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged, status_stalled
   implicit none (type, external)
   private
   public :: solve_warm

   integer, parameter :: most_rounds = 40
   integer, parameter :: steps_a_round = 1          !! of Newton's method
   integer, parameter :: marches_a_round = 1
   real(dp), parameter :: settled = 20              !! change of film and heat in a round, in units of the tolerance
   real(dp), parameter :: loosening = 1.3_dp        !! of that with each round beyond so many: where a node at the edge
   integer, parameter :: patience = 12              !! of the film, or of the backflow, goes to and fro
   real(dp), parameter :: loose = 50                !! change of temperatures over that, of which integrals hardly know

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
      type(energy_t), intent(out) :: energy            !! of the finest level
      type(state_t) :: cold, cold_below
      type(solve_limits_t) :: here
      integer :: first, l, n
      logical :: has_guess, is_solved

      n = size(multigrid%levels)
      first = max(1, n - levels_below)
      multigrid%levels(:first - 1)%central_film = no_value
      has_guess = .false.
      do l = first, n
         is_solved = multigrid%levels(l)%has_film()
         multigrid%levels(l)%central_film = no_value
         if (.not. (is_solved .or. l == n)) cycle
         cold = multigrid%levels(l)%state
         call warm_problem(multigrid%levels(l)%problem, intervals)
         if (has_guess) call guess(multigrid%levels(l - 1), cold_below, multigrid%levels(l))
         energy = new_energy(intervals, scales, multigrid%levels(l)%problem%grid)
         here = limits
         if (l < n) here%tolerance = max(limits%tolerance, coarse_tolerance)
         call settle(multigrid, l, here, cap, energy)
         has_guess = multigrid%levels(l)%report%status == status_converged
         if (has_guess) call multigrid%take_film(l)
         cold_below = cold
      end do
   end subroutine solve_warm

   !> First guess of a level: its state without heat and what heat changed on the next coarser one.
   subroutine guess(coarse, cold, fine)
      type(level_t), intent(in) :: coarse
      type(state_t), intent(in) :: cold           !! of the coarse level, without heat
      type(level_t), intent(inout) :: fine
      real(dp), allocatable :: change(:, :), rise(:, :)
      integer :: k

      allocate (change, rise, mold=fine%state%p)
      call interpolate(coarse%problem%grid, fine%problem%grid, coarse%state%p - cold%p, change)
      where (fine%state%p > 0) fine%state%p = max(fine%state%p + change, 0.0_dp)
      fine%state%delta = fine%state%delta + (coarse%state%delta - cold%delta)
      do k = lbound(fine%problem%heat%rise, 1), ubound(fine%problem%heat%rise, 1)
         call interpolate(coarse%problem%grid, fine%problem%grid, coarse%problem%heat%rise(k, :, :), rise)
         fine%problem%heat%rise(k, :, :) = rise
      end do
   end subroutine guess

   !> Rounds on one level until neither the film nor the temperatures change.
   subroutine settle(multigrid, l, limits, cap, energy)
      type(full_multigrid_t), intent(inout) :: multigrid
      integer, intent(in) :: l
      type(solve_limits_t), intent(in) :: limits
      class(capped_solver_t), intent(inout) :: cap
      type(energy_t), intent(inout) :: energy
      type(equations_t) :: equations
      type(solve_limits_t) :: here
      type(solve_report_t) :: report, total
      real(dp) :: before, centre, work_before
      integer :: march, round

      associate (level => multigrid%levels(l))
         call equations%init(level%problem)
         call level%problem%film(level%given, level%state%p, level%state%delta, level%state%h)
         call level%problem%heat%weigh(level%problem%rheology, energy%levels%weight, level%state%p)
         total = solve_report_t(nonlinear_steps=level%report%nonlinear_steps, linear_steps=level%report%linear_steps, &
                                factorisations=level%report%factorisations)
         here = limits
         centre = level%problem%grid%value_at_centre(level%state%h)
         do round = 1, most_rounds
            do march = 1, marches_a_round
               call equations%evaluate(level%problem, level%given, level%state)
               call energy%march(level%problem, level%state, equations%flow)
            end do
            if (.not. ieee_is_finite(energy%difference)) exit
            before = centre
            here%largest_steps = min(steps_a_round, cap%steps_left)
            work_before = multigrid%work()
            call multigrid%solve_level(l, here, report)
            cap%work_left = cap%work_left - (multigrid%work() - work_before)
            if (l == size(multigrid%levels)) cap%steps_left = cap%steps_left - report%nonlinear_steps
            total%nonlinear_steps = total%nonlinear_steps + report%nonlinear_steps
            total%linear_steps = total%linear_steps + report%linear_steps
            total%factorisations = total%factorisations + report%factorisations
            centre = level%problem%grid%value_at_centre(level%state%h)
            if (report%status /= status_converged .and. report%status /= status_stalled) exit
            if (report%status == status_converged .and. &
                max(energy%heat_difference, energy%difference/loose, abs(centre/before - 1)) &
                <= settled*limits%tolerance*loosening**max(0, round - patience)) exit
            report%status = status_stalled
            if (cap%is_spent()) exit
         end do
         if (report%status == status_converged) then   ! fluxes of the film as it is now
            call equations%evaluate(level%problem, level%given, level%state)
            call energy%march(level%problem, level%state, equations%flow)
         end if
         report%nonlinear_steps = total%nonlinear_steps
         report%linear_steps = total%linear_steps
         report%factorisations = total%factorisations
         level%report = report
      end associate
   end subroutine settle

end module ehlwave_warm_steady
