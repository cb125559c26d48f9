!> Steady state of a contact with less oil than it could take: from the flooded state, grid by grid.
module ehlwave_starvation
   use ehlwave_continuation, only: adaptive_path_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_inlet_oil, only: inlet_oil_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_meniscus, only: hold_empty, is_full_to_edge
   use ehlwave_rescue, only: rescue_t, rung_continuation
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged, status_stalled
   implicit none (type, external)
   private
   public :: starve

   !> Films of the flooded contact, and the oil it passes.
   type, public :: flooded_t
      real(dp), allocatable :: film(:)       !! H(0,0) of each level, coarsest first; NaN: none
      real(dp), allocatable :: oil(:)        !! rho H there
      real(dp) :: work = 0                   !! operations
      type(state_t) :: state                 !! state of the finest level
   end type flooded_t

   real(dp), parameter :: least_ratio = 4    !! oil where a path begins, at r = 1 or above, over that where it ends
   real(dp), parameter :: direct = 0.6_dp    !! r that is solved from the flooded state at once
   real(dp), parameter :: loose_tolerance = 1e-3_dp   !! on the way
   real(dp), parameter :: wide = 2           !! gap over the layer times (1 + r), beyond which a first guess has no
                                             !! pressure. Menisci were found at 2 to 6 at r = 1, at 3 to 14 at r = 3

contains

   !> Starve the contact from the flooded steady state on all levels. The coarsest grid starts from the flooded
   !> state, the others from the next coarser grid; where that fails, the oil is reduced gradually from plenty.
   subroutine starve(rescue, multigrid, oil, limits, coarse_tolerance, flooded)
      type(rescue_t), intent(inout) :: rescue
      type(full_multigrid_t), intent(inout) :: multigrid
      type(inlet_oil_t), intent(in) :: oil
      type(solve_limits_t), intent(in) :: limits     !! for the finest level
      real(dp), intent(in) :: coarse_tolerance       !! for the others
      type(flooded_t), intent(out) :: flooded
      type(solve_limits_t) :: loose
      type(solve_report_t) :: report
      type(state_t) :: full
      logical :: is_full, is_known
      integer :: l, n

      n = size(multigrid%levels)
      flooded%film = multigrid%levels%central_film
      allocate (flooded%oil(n))
      flooded%work = multigrid%work()
      flooded%state = multigrid%levels(n)%state
      loose = limits
      loose%tolerance = max(limits%tolerance, coarse_tolerance)
      do l = n, 1, -1
         associate (level => multigrid%levels(l), finer => flooded%oil(min(l + 1, n)))
            flooded%oil(l) = oil_at_centre(level)
            if (.not. level%has_film()) flooded%oil(l) = finer
            call forget_film(level)
         end associate
      end do
      do l = 1, n
         associate (level => multigrid%levels(l))
            if (allocated(level%given%supply)) deallocate (level%given%supply)
            allocate (level%given%supply(0:level%problem%grid%ny), &
                      source=oil%supply_on(level%problem%grid, flooded%oil(l)))
            full = level%state
            is_known = l > 1
            if (is_known) is_known = multigrid%levels(l - 1)%has_film()
            if (is_known) then
               is_full = is_full_to_edge(multigrid%last_equations(l - 1))
               call multigrid%start_level(l)
               if (is_full) call settle(rescue, multigrid, l, loose)
            end if
            if (.not. is_known .and. maxval(level%given%supply) > direct*flooded%oil(l)) then
               call empty_inlet(level, flooded%oil(l))
               is_known = .true.
            end if
            if (l < n) then
               report = solve_report_t()
               if (is_known) call rescue%solve_coarse(multigrid, l, loose, report)
               if (report%status /= status_converged) &
                  call come_down(rescue, multigrid, l, full, flooded%oil(l), loose, report)
               level%report = report
            else
               level%report%status = status_stalled
               if (is_known) call rescue%attempt(multigrid, limits)
               if (level%report%status /= status_converged .and. (rescue%is_ready .or. .not. is_known)) then
                  call come_down(rescue, multigrid, l, full, flooded%oil(l), limits, level%report)
                  rescue%rung = max(rescue%rung, rung_continuation)
                  if (level%report%status == status_converged) rescue%rescued = rescue%rescued + 1
               end if
            end if
            if (level%report%status == status_converged) then
               call multigrid%take_film(l)
            else if (l < n) then
               level%state = full
            end if
         end associate
      end do
   end subroutine starve

   !> First guess from the next coarser grid where the gap is full from the inlet edge on: a step with the meniscus
   !> held. Oil offered is the flow through the full gap, so the contact determines the pressure there. A small error of
   !> it in the contact, which the new grid has yet to resolve, moves a distant meniscus by many rows.
   subroutine settle(rescue, multigrid, l, limits)
      type(rescue_t), intent(inout) :: rescue
      type(full_multigrid_t), intent(inout) :: multigrid
      integer, intent(in) :: l                      !! level
      type(solve_limits_t), intent(in) :: limits
      type(solve_limits_t) :: once
      type(solve_report_t) :: report

      once = limits
      once%tolerance = max(limits%tolerance, loose_tolerance)
      once%largest_steps = 1
      associate (level => multigrid%levels(l))
         call hold_empty(level)
         call solve_capped(rescue, multigrid, l, once, report)
         deallocate (level%given%is_empty)
      end associate
   end subroutine settle

   !> From the flooded state with plenty of oil down to the oil offered, by steps that grow and shrink.
   subroutine come_down(rescue, multigrid, l, full, flooded_oil, limits, report)
      type(rescue_t), intent(inout) :: rescue
      type(full_multigrid_t), intent(inout) :: multigrid
      integer, intent(in) :: l                      !! level
      type(state_t), intent(in) :: full             !! its flooded state
      real(dp), intent(in) :: flooded_oil           !! rho H of the flooded contact's centre
      type(solve_limits_t), intent(in) :: limits
      type(solve_report_t), intent(inout) :: report
      type(adaptive_path_t) :: path
      type(solve_limits_t) :: here
      type(solve_report_t) :: found
      type(state_t) :: last
      real(dp), allocatable :: supply(:)
      real(dp) :: most
      logical :: is_solved

      associate (level => multigrid%levels(l))
         supply = level%given%supply
         most = max(least_ratio, flooded_oil/maxval(supply))
         last = full
         is_solved = .true.
         do while (is_solved .or. path%can_retry())
            if (is_solved .and. path%is_at_end()) exit
            if (rescue%is_spent()) exit
            call path%advance(is_solved)
            level%given%supply = supply*most**(1 - path%place)
            level%state = last
            here = limits
            if (.not. path%is_at_end()) here%tolerance = max(limits%tolerance, loose_tolerance)
            call solve_capped(rescue, multigrid, l, here, found)
            report = found                       ! may be the level's own
            is_solved = report%status == status_converged
            if (is_solved) last = level%state
         end do
         level%given%supply = supply
      end associate
   end subroutine come_down

   !> A solve of a level within the cap of the case; on the finest its report counts all attempts.
   subroutine solve_capped(rescue, multigrid, l, limits, report)
      type(rescue_t), intent(inout) :: rescue
      type(full_multigrid_t), intent(inout) :: multigrid
      integer, intent(in) :: l
      type(solve_limits_t), intent(in) :: limits
      type(solve_report_t), intent(out) :: report
      if (l < size(multigrid%levels)) then
         call rescue%solve_coarse(multigrid, l, limits, report)
      else
         call rescue%attempt(multigrid, limits)
         report = multigrid%levels(l)%report
      end if
   end subroutine solve_capped

   !> First guess from the flooded state: no pressure where the gap is much wider than the layer, for a film reduced
   !> by the missing oil. From the flooded state itself the empty part of the inlet would grow by some rows a step.
   pure subroutine empty_inlet(level, flooded_oil)
      type(level_t), intent(inout) :: level
      real(dp), intent(in) :: flooded_oil   !! rho H of the flooded contact's centre
      real(dp) :: oil(0:level%problem%grid%nx, 0:level%problem%grid%ny), r
      integer :: j

      r = maxval(level%given%supply)/flooded_oil
      oil = level%problem%rheology%density(level%state%p)*level%state%h
      do j = 0, level%problem%grid%ny
         where (oil(:, j) > max(0.0_dp, 1 - r)*flooded_oil + wide*(1 + r)*level%given%supply(j)) level%state%p(:, j) = 0
      end do
   end subroutine empty_inlet

   pure real(dp) function oil_at_centre(level) result(oil)
      type(level_t), intent(in) :: level
      associate (grid => level%problem%grid)
         oil = grid%value_at_centre(level%problem%rheology%density(level%state%p)*level%state%h)
      end associate
   end function oil_at_centre

   pure subroutine forget_film(level)
      type(level_t), intent(inout) :: level
      level%central_film = no_value
      level%minimum_film = no_value
   end subroutine forget_film

end module ehlwave_starvation
