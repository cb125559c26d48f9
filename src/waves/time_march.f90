!> Time march of a contact with moving waviness, from the smooth steady state.
module ehlwave_time_march
   use ehlwave_byte_stream, only: bytes_t
   use ehlwave_clock, only: wall_seconds
   use ehlwave_energy, only: energy_t
   use ehlwave_equations, only: equations_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_march_bytes, only: pass_energy, pass_past
   use ehlwave_march_past, only: march_past_t
   use ehlwave_march_settings, only: march_settings_t
   use ehlwave_march_watcher, only: march_watcher_t
   use ehlwave_monitor, only: go_on, monitor_t, stop_now
   use ehlwave_rescue, only: rescue_t
   use ehlwave_solve_report, only: solve_limits_t
   use ehlwave_status, only: status_converged
   implicit none (type, external)
   private

   !> Steps between two restart points, where the march resumes bit for bit: solvers keep nothing across them.
   integer, parameter, public :: steps_per_stretch = 32

   integer, parameter :: heat_rounds = 1    !! rounds of temperatures and film after the first solution of a step: it
                                            !! leaves up
                                            !! to 0.0005 of Ai against four, the step 0.002 against half of it
   real(dp), parameter :: looser = 30       !! tolerance of that solution, over the tolerance of the step

   !> A march under way: everything that its next step depends on, besides the level and its problem.
   type, extends(march_past_t), public :: march_t
      integer, private :: l = 0                !! level that is marched
      type(rescue_t) :: rescue                 !! its account goes on from step to step
      type(energy_t), allocatable :: energy    !! energy equation of the temperatures; absent: they are held, if any
   contains
      procedure :: begin
      procedure :: advance
      procedure :: take_step
      procedure :: pass
   end type march_t

   !> Asked to stop, a march goes on to the end of its stretch if that takes no longer.
   real(dp), parameter :: largest_delay_s = 10

contains

   !> Make ready to march the finest of some levels from its steady state of smooth surfaces.
   subroutine begin(self, levels, settings, rescue, energy)
      class(march_t), intent(inout) :: self
      type(level_t), intent(inout) :: levels(:)
      type(march_settings_t), intent(in) :: settings
      type(rescue_t), intent(in) :: rescue     !! rescue of the steady state
      type(energy_t), intent(in), optional :: energy   !! energy equation of the steady state, if temperatures change

      self%l = size(levels)
      self%rescue = rescue
      call self%begin_past(levels(self%l), settings)
      if (allocated(self%energy)) deallocate (self%energy)
      if (.not. present(energy)) return
      self%energy = energy
      associate (problem => levels(self%l)%problem)
         call self%energy%start_in_time(problem, levels(self%l)%state, settings%time_step(problem%grid))
      end associate
   end subroutine begin

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

   !> A time step.
   !>
   !> A step that fails from the extrapolated guess goes to `rescue`; if that fails too the march ends with its
   !> status. The level holds the last solution reached.
   subroutine take_step(self, multigrid, limits)
      class(march_t), intent(inout) :: self
      type(full_multigrid_t), intent(inout) :: multigrid
      type(solve_limits_t), intent(in) :: limits
      real(dp) :: dt, t, work_before

      associate (level => multigrid%levels(self%l))
         dt = self%settings%time_step(level%problem%grid)
         t = self%next_time(dt)
         call self%pose(level%problem%grid, t, level%given)
         call self%guess(t, dt, level%state)
         work_before = multigrid%work()
         if (allocated(self%energy)) then
            call carry_heat(self, multigrid, limits)
         else
            call solve_step(self, multigrid, limits)
         end if
         self%result%work = self%result%work + multigrid%work() - work_before
         if (self%result%status == status_converged) call self%keep(level, t)
      end associate
   end subroutine take_step

   !> A time step that alternates between film and temperatures. Films that only serve temperatures have a loose
   !> tolerance.
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
         if (self%result%status == status_converged) then   ! only the cost of the steps counts
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

   !> A time step and its account. Factors are kept within a stretch only: a march resumes with none.
   subroutine solve_step(self, multigrid, limits)
      class(march_t), intent(inout) :: self
      type(full_multigrid_t), intent(inout) :: multigrid
      type(solve_limits_t), intent(in) :: limits
      type(solve_limits_t) :: keeping

      keeping = limits
      keeping%keeps_factors = modulo(self%result%steps, steps_per_stretch) > 0
      if (self%l == size(multigrid%levels)) then
         call self%rescue%solve_step(multigrid, self%past%before, self%given, keeping)
      else
         call multigrid%solve_level(self%l, keeping, multigrid%levels(self%l)%report)
      end if
      call self%result%count(multigrid%levels(self%l)%report)
   end subroutine solve_step

   !> Pass all values that the next steps depend on, for checkpoints.
   subroutine pass(self, bytes)
      class(march_t), intent(inout) :: self
      type(bytes_t), intent(inout) :: bytes
      call pass_past(bytes, self, self%rescue)
      if (allocated(self%energy)) call pass_energy(bytes, self%energy)
   end subroutine pass

end module ehlwave_time_march
