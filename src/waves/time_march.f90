!> March in time of one contact with moving waviness, from the smooth steady state.
module ehlwave_time_march
   use ehlwave_assertions, only: assert, checks
   use ehlwave_clock, only: wall_seconds
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_energy, only: energy_t
   use ehlwave_equations, only: equations_t
   use ehlwave_first_guess, only: carried_share, carry_on, extrapolate, look_up, past_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_given, only: given_t
   use ehlwave_grid, only: grid_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_known_waves, only: known_waves_t
   use ehlwave_last_period, only: last_period_t
   use ehlwave_load_balance, only: equation_of_motion, force_balance
   use ehlwave_march_settings, only: march_settings_t
   use ehlwave_march_watcher, only: march_watcher_t
   use ehlwave_monitor, only: go_on, monitor_t, stop_now
   use ehlwave_rescue, only: rescue_t
   use ehlwave_solve_report, only: solve_limits_t
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged
   use ehlwave_threads, only: is_shared
   use ehlwave_transport, only: characteristic_transport
   implicit none (type, external)
   private

   !> Steps between two points where the march can be taken up again, bit for bit: solvers keep nothing from one
   !> solution to the next.
   integer, parameter, public :: steps_per_stretch = 32

   integer, parameter :: heat_rounds = 1    !! of temperatures and film after the first solution of a step: it leaves up
                                            !! to 0.0005 of Ai against four, the step 0.002 against half of it
   real(dp), parameter :: looser = 30       !! tolerance of that solution, over that of the step
   integer, parameter :: young = 3   !! steps in which the solutions before are not yet all solutions

   !> History of the contact centre and the account of the march.
   type, public :: march_result_t
      integer :: status = status_converged     !! of the first step that failed, else converged
      integer :: steps = 0                     !! steps done
      real(dp), allocatable :: time(:)         !! (0:steps) T
      real(dp), allocatable :: central_film(:) !! (0:steps) H(0,0,T)
      real(dp), allocatable :: approach(:)     !! (0:steps) Delta(T)
      real(dp) :: worst_residual = 0           !! largest over the steps
      real(dp) :: worst_load_error = 0
      integer :: nonlinear_steps = 0, linear_steps = 0, factorisations = 0
      real(dp) :: work = 0                     !! operations, see `ehlwave_work_unit`
   end type march_result_t

   !> A march under way: everything that its next step depends on, besides the level and its problem.
   type, public :: march_t
      type(march_settings_t) :: settings
      type(march_result_t) :: result
      type(past_t) :: past
      ! that it started in, see `start_in`; absent: it started from rest
      type(known_waves_t), allocatable, private :: waves
      type(last_period_t), private :: period               ! with `waves`
      integer, private :: l = 0                ! level that is marched
      real(dp), private :: start = 0           ! T before the first step
      real(dp), allocatable :: share(:, :)     !! see carried_share
      real(dp), allocatable :: history(:, :, :) !! f = rho H of the steps before, latest first; of a starved contact
                                                !! what `carry_content` takes
      real(dp), allocatable, private :: supply(:)   ! oil offered to the steady state, of a starved contact
      real(dp) :: approach(3) = 0              !! Delta of the steps before, latest first
      type(given_t) :: given                   !! what the last solution was given
      type(rescue_t) :: rescue                 !! its account goes on from step to step
      type(energy_t), allocatable :: energy    !! that carries temperatures on; absent: they are held, if there are any
   contains
      procedure :: begin
      procedure :: start_in
      procedure :: restore
      procedure :: advance
      procedure :: take_step
   end type march_t

   !> Asked to stop, a march goes on to the end of its stretch if that takes no longer.
   real(dp), parameter :: largest_delay_s = 10

contains

   !> Make ready to march the finest of some levels from its steady state of smooth surfaces.
   subroutine begin(self, levels, settings, rescue, energy)
      class(march_t), intent(inout) :: self
      type(level_t), intent(inout) :: levels(:)
      type(march_settings_t), intent(in) :: settings
      type(rescue_t), intent(in) :: rescue     !! what the steady state has left of it
      type(energy_t), intent(in), optional :: energy   !! of the steady state, if temperatures are to be carried on
      integer :: n

      if (checks) then
         call assert(allocated(levels(size(levels))%state%h), 'march%begin: a level at its steady state')
         call assert(settings%steps > 0, 'march%begin: steps to take')
      end if
      self%settings = settings
      self%rescue = rescue
      self%result = march_result_t()
      self%l = size(levels)
      self%start = 0
      if (allocated(self%waves)) deallocate (self%waves)
      associate (problem => levels(self%l)%problem, grid => levels(self%l)%problem%grid, &
                 given => levels(self%l)%given, state => levels(self%l)%state)
         given%transport = characteristic_transport(grid, settings%cells_per_step, settings%steps_per_cell)
         given%load = force_balance(1.0_dp)
         if (settings%natural_frequency > 0) &
            given%load = equation_of_motion(1.0_dp, settings%natural_frequency, self%settings%time_step(grid))
         if (allocated(self%history)) deallocate (self%history)
         allocate (self%history(0:grid%nx, 0:grid%ny, given%transport%history_length()))
         if (allocated(self%supply)) deallocate (self%supply)
         if (allocated(given%supply)) allocate (self%supply(0:grid%ny), source=given%supply)
         do n = 1, size(self%history, 3)
            call remember(self, problem, given, state)
         end do
         self%approach = state%delta
         call carry_history(self, grid, given)
         call given%load%carry(self%approach)
         self%given = given   ! what the steady state would be given as a time step
         given%load%force = settings%force
         self%past = past_t(state, state, state, state)
         if (allocated(self%energy)) deallocate (self%energy)
         if (present(energy)) then
            self%energy = energy
            call self%energy%start_in_time(problem, state, self%settings%time_step(grid))
         end if
         self%share = carried_share(levels(self%l))
         allocate (self%result%time(0:settings%steps), self%result%central_film(0:settings%steps), &
                   self%result%approach(0:settings%steps), source=0.0_dp)
         self%result%central_film(0) = grid%value_at_centre(state%h)
         self%result%approach(0) = state%delta
      end associate
   end subroutine begin

   !> After `begin`: start in waves at T = t, their pattern everywhere, in place of the smooth contact at 0.
   subroutine start_in(self, level, waves, t)
      class(march_t), intent(inout) :: self
      type(level_t), intent(inout) :: level           !! that of `begin`
      type(known_waves_t), intent(in) :: waves        !! found there
      real(dp), intent(in) :: t
      type(state_t) :: states(0:max(3, size(self%history, 3)))
      integer :: n

      self%start = t
      self%waves = waves
      associate (grid => level%problem%grid)
         call self%period%begin(self%settings%repeat_time(grid), self%settings%time_step(grid), grid%nx, grid%ny)
      end associate
      associate (problem => level%problem, history => self%history)
         do n = 0, ubound(states, 1)
            states(n) = waves%state_at(t - n*self%settings%time_step(problem%grid))
            if (n >= 1 .and. n <= size(history, 3)) history(:, :, n) = problem%density(states(n)%p)*states(n)%h
         end do
         self%approach = states(1:3)%delta
         call pose_step(self, problem%grid, t, level%given)
         self%given = level%given
         level%state = states(0)
         call note(self, level, 0, t)
         self%past = past_t(self%past%steady, states(0), states(1), states(2))
      end associate
   end subroutine start_in

   !> Give `level` the state of a march taken up again, after `begin` with the same steady state and settings.
   subroutine restore(self, level)
      class(march_t), intent(in) :: self
      type(level_t), intent(inout) :: level
      level%state = self%past%before
   end subroutine restore

   !> March to the end of the stretch, or until a step fails or the monitor asks for something else.
   subroutine advance(self, multigrid, limits, monitor, watcher)
      class(march_t), intent(inout) :: self
      type(full_multigrid_t), intent(inout) :: multigrid
      type(solve_limits_t), intent(in) :: limits
      class(monitor_t), intent(inout) :: monitor
      class(march_watcher_t), intent(inout), optional :: watcher   !! sees every solution
      real(dp) :: start_s
      integer :: first, k, last

      start_s = wall_seconds()
      first = self%result%steps + 1
      last = min(self%settings%steps, (self%result%steps/steps_per_stretch + 1)*steps_per_stretch)
      do k = first, last
         call self%take_step(multigrid, limits)
         if (self%result%status /= status_converged) exit
         if (present(watcher)) call watcher%see(multigrid%levels(self%l), k, self%result%time(k))
         call monitor%step_done('time step', k, self%settings%steps)
         if (monitor%request == go_on) cycle
         if (monitor%request /= stop_now) exit
         if ((wall_seconds() - start_s)/(k - first + 1)*(last - k) > largest_delay_s) exit
      end do
   end subroutine advance

   !> One time step.
   !>
   !> One that fails from the extrapolated guess is left to `rescue`; when that fails too the march ends and says
   !> so. The level holds the last solution reached.
   subroutine take_step(self, multigrid, limits)
      class(march_t), intent(inout) :: self
      type(full_multigrid_t), intent(inout) :: multigrid
      type(solve_limits_t), intent(in) :: limits
      real(dp) :: dt, t, work_before

      associate (level => multigrid%levels(self%l), settings => self%settings)
         dt = settings%time_step(level%problem%grid)
         t = self%start + (self%result%steps + 1)*dt
         call pose_step(self, level%problem%grid, t, level%given)
         if (allocated(self%waves) .and. self%result%steps < young) then
            call carry_on(self%past, self%waves, t, dt, level%state)
         else if (settings%steps_per_cell == 1) then
            if (self%period%is_known()) call look_up(self%period, t, dt, self%past)
            call extrapolate(settings%cells_per_step, self%share, self%past, level%state)
         end if
         work_before = multigrid%work()
         if (allocated(self%energy)) then
            call carry_heat(self, multigrid, limits)
         else
            call solve_step(self, multigrid, limits)
         end if
         self%result%work = self%result%work + multigrid%work() - work_before
         if (self%result%status /= status_converged) return
         call keep_step(self, level, t)
         if (allocated(self%waves)) call self%period%keep(t, level%state)
      end associate
   end subroutine take_step

   !> One time step whose film and temperatures take turns. The film that only temperatures follow from is solved for
   !> loosely.
   subroutine carry_heat(self, multigrid, limits)
      class(march_t), intent(inout) :: self
      type(full_multigrid_t), intent(inout), target :: multigrid
      type(solve_limits_t), intent(in) :: limits
      type(equations_t), target :: own
      type(equations_t), pointer :: equations
      type(solve_limits_t) :: loose
      real(dp) :: worst(2)
      integer :: round

      loose = limits
      loose%tolerance = looser*limits%tolerance
      associate (problem => multigrid%levels(self%l)%problem, level => multigrid%levels(self%l))
         call self%energy%look_ahead(problem)
         call self%energy%weigh(problem, level%state)
         worst = [self%result%worst_residual, self%result%worst_load_error]
         call solve_step(self, multigrid, loose)
         if (self%result%status == status_converged) then   ! those of the steps alone count
            self%result%worst_residual = worst(1)
            self%result%worst_load_error = worst(2)
         end if
         do round = 1, heat_rounds
            if (self%result%status /= status_converged) return
            equations => multigrid%last_equations(self%l)
            if (associated(equations)) then     ! a rescue has another solver
               if (.not. all(abs(equations%flow%h - level%state%h) <= 0)) nullify (equations)
            end if
            if (.not. associated(equations)) then
               call own%init(problem)
               call own%evaluate(problem, level%given, level%state)
               equations => own
            end if
            call self%energy%march(problem, level%state, equations%flow, until_film_ends=.false.)
            call self%energy%weigh(problem, level%state)
            call solve_step(self, multigrid, limits)
         end do
         call self%energy%pass_time(problem, level%state)
      end associate
   end subroutine carry_heat

   !> Give what the step to time t is given.
   subroutine pose_step(self, grid, t, given)
      class(march_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: t
      type(given_t), intent(inout) :: given
      call given%set_rough(rough_at(self, grid, t))
      call carry_history(self, grid, given)
      if (allocated(self%supply)) given%supply(:) = self%supply*self%settings%oil_share(t)
      call given%load%carry(self%approach)
   end subroutine pose_step

   !> Terms of earlier times from the history.
   subroutine carry_history(self, grid, given)
      class(march_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      type(given_t), intent(inout) :: given
      if (allocated(given%supply)) then
         call given%transport%carry_content(grid, self%history)
      else
         call given%transport%carry(grid, self%history)
      end if
   end subroutine carry_history

   !> Put a state at the head of the history.
   subroutine remember(self, problem, given, state)
      class(march_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(given_t), intent(in) :: given               !! to the solution
      type(state_t), intent(in) :: state
      type(equations_t) :: equations
      integer :: j, n, steps

      associate (history => self%history)
         steps = size(history, 3)
         if (allocated(given%supply)) steps = steps/2
         !$omp parallel do private(n) schedule(static) if (is_shared(size(state%p)))
         do j = 0, ubound(history, 2)
            do n = size(history, 3), 2, -1
               if (n /= steps + 1) history(:, j, n) = history(:, j, n - 1)
            end do
         end do
         if (allocated(given%supply)) then
            call equations%init(problem)
            call equations%evaluate(problem, given, state)
            call equations%content%history_of(equations%flow%rho*state%h, history(:, :, 1), history(:, :, steps + 1))
         else
            history(:, :, 1) = problem%density(state%p)*state%h
         end if
      end associate
   end subroutine remember

   !> Roughness at time t: everywhere when the march started in waves, else behind the front.
   pure function rough_at(self, grid, t) result(rough)
      class(march_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: t
      real(dp), allocatable :: rough(:, :)
      if (allocated(self%waves)) then
         rough = self%settings%surfaces%rough_of_waves(grid%x, grid%y, t, self%settings%film)
      else
         rough = self%settings%surfaces%rough_at(grid%x, grid%y, t, self%settings%film)
      end if
   end function rough_at

   !> Note the solution at time t, and keep what the next steps need of it.
   subroutine keep_step(self, level, t)
      class(march_t), intent(inout) :: self
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
   end subroutine keep_step

   !> Write the solution at time t into the account as step k, and as the latest into what the differences in time use.
   subroutine note(self, level, k, t)
      class(march_t), intent(inout) :: self
      type(level_t), intent(in) :: level
      integer, intent(in) :: k
      real(dp), intent(in) :: t

      associate (result => self%result, state => level%state)
         result%time(k) = t
         result%central_film(k) = level%problem%grid%value_at_centre(state%h)
         result%approach(k) = state%delta
         call remember(self, level%problem, level%given, state)
         self%approach = [state%delta, self%approach(1:2)]
      end associate
   end subroutine note

   !> One time step and its account.
   subroutine solve_step(self, multigrid, limits)
      class(march_t), intent(inout) :: self
      type(full_multigrid_t), intent(inout) :: multigrid
      type(solve_limits_t), intent(in) :: limits

      if (self%l == size(multigrid%levels)) then
         call self%rescue%solve_step(multigrid, self%past%before, self%given, limits)
      else
         call multigrid%solve_level(self%l, limits, multigrid%levels(self%l)%report)
      end if
      associate (report => multigrid%levels(self%l)%report, result => self%result)
         result%nonlinear_steps = result%nonlinear_steps + report%nonlinear_steps
         result%linear_steps = result%linear_steps + report%linear_steps
         result%factorisations = result%factorisations + report%factorisations
         result%status = report%status
         result%worst_residual = max(result%worst_residual, report%residual)
         result%worst_load_error = max(result%worst_load_error, report%load_error)
      end associate
   end subroutine solve_step

end module ehlwave_time_march
