!> A time march so far: start and data of its next step.
module ehlwave_march_past
   use ehlwave_assertions, only: assert, checks
   use ehlwave_first_guess, only: carry_on, extrapolate, past_t
   use ehlwave_given, only: given_t
   use ehlwave_grid, only: grid_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_known_waves, only: known_waves_t
   use ehlwave_march_keeper, only: kept_march_t
   use ehlwave_march_result, only: march_result_t
   use ehlwave_march_settings, only: march_settings_t
   use ehlwave_state, only: state_t
   use ehlwave_time_history, only: time_history_t
   use ehlwave_transport, only: characteristic_transport
   implicit none (type, external)
   private

   integer, parameter :: young = 3   !! steps in which the solutions before are not yet all solutions

   !> All that the next step depends on, besides the level and its problem, temperatures, and the solver's account.
   type, abstract, extends(kept_march_t), public :: march_past_t
      type(march_settings_t) :: settings
      type(march_result_t) :: result
      type(past_t) :: past
      ! State that it started in, see `start_in`; absent: it started from rest
      type(known_waves_t), allocatable, private :: waves
      real(dp), private :: start = 0           ! T before the first step
      type(time_history_t) :: history
      real(dp), allocatable, private :: supply(:)   ! oil offered to the steady state, of a starved contact
      type(given_t) :: given                   !! data of the last solution
   contains
      procedure :: begin_past
      procedure :: start_in
      procedure :: restore
      procedure :: next_time
      procedure :: pose
      procedure :: guess
      procedure :: keep
   end type march_past_t

contains

   !> Make ready to march a level from its steady state of smooth surfaces.
   subroutine begin_past(self, level, settings)
      class(march_past_t), intent(inout) :: self
      type(level_t), intent(inout) :: level
      type(march_settings_t), intent(in) :: settings

      if (checks) then
         call assert(allocated(level%state%h), 'march%begin: a level at its steady state')
         call assert(settings%steps > 0, 'march%begin: steps to take')
      end if
      self%settings = settings
      call self%result%begin(settings%steps)
      self%start = 0
      if (allocated(self%waves)) deallocate (self%waves)
      associate (problem => level%problem, grid => level%problem%grid, given => level%given, state => level%state)
         given%transport = characteristic_transport(grid, settings%cells_per_step, settings%steps_per_cell)
         given%load = settings%balance(grid, 1.0_dp)
         if (allocated(self%supply)) deallocate (self%supply)
         if (allocated(given%supply)) allocate (self%supply(0:grid%ny), source=given%supply)
         call self%history%begin(problem, given, state)
         call self%history%carry(grid, given)
         self%given = given   ! data of the steady state as a time step
         given%load%force = settings%force
         self%past = past_t(state, state, state, state)
         if (settings%surfaces%repeat_soon()) call self%past%period%begin(settings%surfaces%repeat_period(), &
            settings%time_step(grid), grid%nx, grid%ny)
         call self%result%note(0, self%start, grid%value_at_centre(state%h), state%delta)
      end associate
   end subroutine begin_past

   !> After `begin`: start in waves at T = t, their pattern everywhere, in place of the smooth contact at 0.
   subroutine start_in(self, level, waves, t)
      class(march_past_t), intent(inout) :: self
      type(level_t), intent(inout) :: level           !! data of `begin`
      type(known_waves_t), intent(in) :: waves        !! found there
      real(dp), intent(in) :: t
      type(state_t) :: states(0:max(3, size(self%history%f, 3)))
      integer :: n

      self%start = t
      self%waves = waves
      associate (problem => level%problem)
         do n = 0, ubound(states, 1)
            states(n) = waves%state_at(t - n*self%settings%time_step(problem%grid))
         end do
         call self%history%take(problem, states(1:))
         call self%pose(problem%grid, t, level%given)
         self%given = level%given
         level%state = states(0)
         call note(self, level, 0, t)
         self%past%before = states(0)
         self%past%earlier = states(1)
         self%past%earliest = states(2)
      end associate
   end subroutine start_in

   !> Give `level` the state of a march taken up again, after `begin` with the same steady state and settings.
   subroutine restore(self, level)
      class(march_past_t), intent(in) :: self
      type(level_t), intent(inout) :: level
      level%state = self%past%before
   end subroutine restore

   !> Provide the data of the step to time t.
   subroutine pose(self, grid, t, given)
      class(march_past_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: t
      type(given_t), intent(inout) :: given
      call given%set_rough(roughness_of_march(self, grid, t))
      if (allocated(self%supply)) given%supply(:) = self%supply*self%settings%oil_share(t)
      call self%history%carry(grid, given)
   end subroutine pose

   !> The time of the next step.
   pure real(dp) function next_time(self, dt)
      class(march_past_t), intent(in) :: self
      real(dp), intent(in) :: dt
      next_time = self%start + (self%result%steps + 1)*dt
   end function next_time

   !> A first guess of the solution at time t, one step after the last.
   subroutine guess(self, t, dt, state)
      class(march_past_t), intent(inout) :: self
      real(dp), intent(in) :: t, dt
      type(state_t), intent(inout) :: state
      if (allocated(self%waves) .and. self%result%steps < young) then
         call carry_on(self%past, self%waves, t, dt, state)
      else
         call extrapolate(merge(self%settings%cells_per_step, 0, self%settings%steps_per_cell == 1), &
            self%settings%surfaces%frequency()*dt, t, dt, self%past, state, from_rest=.not. allocated(self%waves))
      end if
   end subroutine guess

   !> Record the solution at time t, and keep the data of the next steps.
   subroutine keep(self, level, t)
      class(march_past_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      real(dp), intent(in) :: t
      type(state_t) :: storage

      self%result%steps = self%result%steps + 1
      call note(self, level, self%result%steps, t)
      associate (past => self%past)
         call past%earliest%move_to(storage)
         call past%earlier%move_to(past%earliest)
         call past%before%move_to(past%earlier)
         call storage%move_to(past%before)
         past%before = level%state
      end associate
      self%given = level%given
      call self%past%period%keep(t, level%state)
   end subroutine keep

   !> Record the solution at time t in the account as step k, and as the latest in the time differences.
   subroutine note(self, level, k, t)
      class(march_past_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      integer, intent(in) :: k
      real(dp), intent(in) :: t
      call self%result%note(k, t, level%problem%grid%value_at_centre(level%state%h), level%state%delta)
      call self%history%remember(level%problem, level%given, level%state)
   end subroutine note

   !> Roughness at time t: everywhere when the march started in waves, else behind the front.
   pure function roughness_of_march(self, grid, t) result(rough)
      class(march_past_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: t
      real(dp), allocatable :: rough(:, :)
      if (allocated(self%waves)) then
         rough = self%settings%surfaces%rough_of_waves(grid%x, grid%y, t, self%settings%film)
      else
         rough = self%settings%surfaces%rough_behind_fronts(grid%x, grid%y, t, self%settings%film)
      end if
   end function roughness_of_march

end module ehlwave_march_past
