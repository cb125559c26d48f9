!> The periodic state of a contact with moving waves: a march that starts in the known waves, from grid to grid.
module ehlwave_periodic_state
   use ehlwave_carried_change, only: carried_change_t, carried_share, points
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_given, only: given_t
   use ehlwave_grid, only: grid_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_known_waves, only: known_waves_t
   use ehlwave_lagrange, only: lagrange_weights
   use ehlwave_march_result, only: march_result_t
   use ehlwave_march_settings, only: march_settings_t
   use ehlwave_march_watcher, only: march_watcher_t
   use ehlwave_monitor, only: go_on, monitor_t
   use ehlwave_rescue, only: rescue_t
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged
   use ehlwave_surfaces, only: surfaces_t
   use ehlwave_time_march, only: march_t
   implicit none (type, external)
   private

   !> The state that a march from rest reaches: on each grid a march starts in the linear response, the change of the
   !> mean, and the correction from the march on the next coarser grid, and ends when the film upstream of the centre
   !> repeats.
   type, public :: periodic_state_t
      type(march_t) :: march                  !! on the finest grid
      type(solve_report_t) :: report          !! outcome of its last step
      logical :: is_found = .false.           !! it repeats
      real(dp) :: change = huge(1.0_dp)       !! largest of the film since a period or a few before, over A
      real(dp), private :: repeats = 0        ! the time between, T
      integer :: nonlinear_steps = 0, linear_steps = 0   !! steps on all grids
   contains
      procedure :: find
      procedure :: at_times
   end type periodic_state_t

   real(dp), parameter :: coarse_change = 1  !! change of a film that repeats, on coarser grids, over the change on the
                                                       !! finest
   real(dp), parameter :: coarse_tolerance = 3  !! tolerance of their time steps, over the tolerance on the finest
   real(dp), parameter :: fewest_points = 16            !! mesh sizes on a wave

contains

   !> From the coarsest of the levels that resolves the waves to the finest. All levels have their steady states of
   !> smooth surfaces; they keep them, the finest has the last solution of the march if the state is found. With a
   !> watcher the march on the finest level goes on to its last step, and the watcher sees each.
   subroutine find(self, multigrid, settings, rescue, limits, largest_change, monitor, watcher)
      class(periodic_state_t), intent(inout) :: self
      type(full_multigrid_t), intent(inout), target :: multigrid
      type(march_settings_t), intent(in) :: settings   !! settings of a march from rest on the finest grid
      type(rescue_t), intent(in) :: rescue             !! rescue of the steady state
      type(solve_limits_t), intent(in) :: limits       !! limits of a time step
      real(dp), intent(in) :: largest_change           !! change of a film that repeats, over A
      class(monitor_t), intent(inout) :: monitor
      class(march_watcher_t), intent(inout), optional :: watcher
      type(known_waves_t) :: waves, coarse_waves
      type(march_settings_t) :: here
      type(solve_limits_t) :: coarse
      type(state_t) :: smooth
      type(given_t) :: given
      real(dp) :: t
      logical :: has_rest, is_known
      integer :: l, n

      n = size(multigrid%levels)
      coarse = limits
      coarse%tolerance = coarse_tolerance*limits%tolerance
      coarse%guess_share = 0   ! errors of a period would stay
      has_rest = .false.
      associate (main => settings%surfaces%list(settings%surfaces%main))
         t = main%start/main%slip   ! so that steps are where a march from rest has its own
      end associate
      self%march%rescue = rescue
      do l = first_level(multigrid%levels, settings%surfaces), n
         associate (level => multigrid%levels(l))
            is_known = level%has_film()
            if (is_known) call waves%find(multigrid%levels(:l), settings%surfaces, settings%film, &
                                          settings%natural_frequency, settings%steps_per_cell, is_known)
            if (.not. is_known) then
               has_rest = .false.
               cycle
            end if
            self%linear_steps = self%linear_steps + waves%linear_steps
            if (has_rest) call hand_up(self%march, coarse_waves, multigrid%levels(l - 1)%problem%grid, &
               level%problem%grid, waves)
            here = settings
            here%steps = ceiling(settings%steps*0.5_dp**(n - l))
            given = level%given
            smooth = level%state
            self%is_found = .false.
            if (l < n) then
               call march_level(self, multigrid, l, waves, here, t, coarse, largest_change*coarse_change, monitor)
            else
               call march_level(self, multigrid, l, waves, here, t, limits, largest_change, monitor, watcher)
            end if
            if (monitor%request /= go_on) return
            has_rest = self%is_found
            coarse_waves = waves
            t = self%march%result%time(self%march%result%steps)
            self%report = level%report
            if (l == n .and. self%is_found) return
            level%given = given
            level%state = smooth
         end associate
      end do
   end subroutine find

   !> Give the waves of a level the correction from the march on the next coarser level.
   subroutine hand_up(march, coarse_waves, coarse, fine, waves)
      type(march_t), intent(in) :: march
      type(known_waves_t), intent(in) :: coarse_waves
      type(grid_t), intent(in) :: coarse, fine
      type(known_waves_t), intent(inout) :: waves
      associate (past => march%past, time => march%result%time(:march%result%steps))
         call waves%take_rest(fine, coarse, coarse_waves, [past%before, past%earlier, past%earliest], &
                              time(size(time)), time(size(time)) - time(size(time) - 1))
      end associate
   end subroutine hand_up

   !> Film and approach of the march at other times, T = times, if its last period went on to repeat: film and mutual
   !> approach there. Of a state that was found.
   function at_times(self, times) result(history)
      class(periodic_state_t), intent(in) :: self
      real(dp), intent(in) :: times(0:)
      type(march_result_t) :: history
      real(dp) :: dt, place
      integer :: base, k

      history%steps = ubound(times, 1)
      allocate (history%time(0:history%steps), source=times)
      allocate (history%central_film(0:history%steps), history%approach(0:history%steps))
      associate (march => self%march%result)
         dt = march%time(march%steps) - march%time(march%steps - 1)
         do k = 0, history%steps
            place = (march%time(march%steps) - march%time(0) &
               - modulo(march%time(march%steps) - times(k), self%repeats))/dt
            base = min(max(floor(place) - points/2 + 1, 0), march%steps - points + 1)
            associate (weights => lagrange_weights(points, place - base))
               history%central_film(k) = dot_product(weights, march%central_film(base:base + points - 1))
               history%approach(k) = dot_product(weights, march%approach(base:base + points - 1))
            end associate
         end do
      end associate
   end function at_times

   !> The coarsest level with a steady state that has enough points on a wave.
   pure integer function first_level(levels, surfaces) result(first)
      type(level_t), intent(in) :: levels(:)
      type(surfaces_t), intent(in) :: surfaces
      do first = 1, size(levels) - 1
         associate (grid => levels(first)%problem%grid)
            if (any(surfaces%list%is_present .and. surfaces%list%wavelength_x < fewest_points*grid%hx)) cycle
            if (any(surfaces%list%wavelength_y > 0 .and. surfaces%list%wavelength_y < fewest_points*grid%hy)) cycle
            if (levels(first)%has_film()) return
         end associate
      end do
   end function first_level

   !> March a level from `waves` at T = start until the film repeats, at most as many steps as a march from rest takes.
   subroutine march_level(self, multigrid, l, waves, settings, start, limits, tolerance, monitor, watcher)
      class(periodic_state_t), intent(inout) :: self
      type(full_multigrid_t), intent(inout) :: multigrid
      integer, intent(in) :: l                         !! level
      type(known_waves_t), intent(in) :: waves         !! waves of the level
      type(march_settings_t), intent(in) :: settings   !! settings of a march from rest
      real(dp), intent(in) :: start                    !! T
      type(solve_limits_t), intent(in) :: limits       !! limits of a time step
      real(dp), intent(in) :: tolerance                !! tolerance of `change`
      class(monitor_t), intent(inout) :: monitor
      class(march_watcher_t), intent(inout), optional :: watcher
      type(carried_change_t) :: carried
      real(dp), allocatable :: share(:, :)
      logical :: is_finest
      integer :: k

      associate (march => self%march, result => self%march%result, grid => multigrid%levels(l)%problem%grid)
         call march%begin(multigrid%levels(:l), settings, march%rescue)
         share = carried_share(multigrid%levels(l))   ! of the steady state
         call march%start_in(multigrid%levels(l), waves, start)
         self%repeats = settings%repeat_time(grid)
         is_finest = l == size(multigrid%levels)
         call carried%begin(grid, settings, share, multigrid%levels(l)%state%h)
         if (present(watcher)) call watcher%see(multigrid%levels(l), 0, start)
         do k = 1, settings%steps
            call march%take_step(multigrid, limits)
            if (result%status /= status_converged) exit
            if (present(watcher)) call watcher%see(multigrid%levels(l), k, result%time(k))
            call monitor%step_done('time step towards the periodic state', k, settings%steps)
            if (monitor%request /= go_on) exit
            call carried%see(k, multigrid%levels(l)%state%h)
            if (self%is_found .or. .not. carried%is_known(k)) cycle
            self%change = carried%largest(is_finest)/settings%amplitude()
            self%is_found = self%change <= tolerance
            if (present(watcher) .or. .not. self%is_found) cycle
            if (is_finest) call carried%correct(result%central_film(:k))
            exit
         end do
         self%is_found = self%is_found .and. result%status == status_converged
         self%nonlinear_steps = self%nonlinear_steps + result%nonlinear_steps
         self%linear_steps = self%linear_steps + result%linear_steps
      end associate
   end subroutine march_level

end module ehlwave_periodic_state
