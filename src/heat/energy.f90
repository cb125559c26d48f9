!> Temperatures of the film and of both surfaces at a state: the equation of energy, theory eq. (T6) and (T7).
!>
!> Marches along the rows (`ehlwave_heat_rows`) follow on each other while viscosity and pressure settle, so that none
!> is repeated for that alone.
module ehlwave_energy
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_film_heat, only: new_film_heat
   use ehlwave_film_levels, only: new_film_levels
   use ehlwave_film_shear, only: made_by_own, made_by_stress, made_stress_by_rise, new_film_shear, shear_film
   use ehlwave_flow, only: flow_t
   use ehlwave_grid, only: grid_t
   use ehlwave_heat_data, only: heat_scales_t
   use ehlwave_heat_rows, only: heat_rows_t
   use ehlwave_kinds, only: dp, pi
   use ehlwave_layer_flux, only: find_layer_fluxes
   use ehlwave_shear_stress, only: least_pressure
   use ehlwave_state, only: state_t
   use ehlwave_wall_heat, only: new_wall_heat
   use ehlwave_wall_history, only: new_wall_history
   use ehlwave_work_unit, only: heat_operations
   implicit none (type, external)
   private
   public :: fast, new_energy, warm_problem

   !> Its rows, and how far the last march has settled.
   type, extends(heat_rows_t), public :: energy_t
      real(dp) :: heat_difference = huge(1.0_dp)    !! relative change of the heat of shear, which goes with friction
      real(dp) :: film_difference = huge(1.0_dp)    !! relative change of H(0,0) since, which who solves for it writes
      real(dp), private :: heat = 0                 ! heat of shear
   contains
      procedure :: start_in_time
      procedure :: pass_time
      procedure :: look_ahead
      procedure :: march
      procedure :: finish
      procedure, private :: settle_walls
      procedure :: weigh
   end type energy_t

   real(dp), parameter :: bearing = 1e-3_dp        ! P of nodes whose heat is compared
   !> Peclet number from which on a surface conducts no heat to before the film: 3 % of the rise (Blok, Jaeger).
   real(dp), parameter :: fast = 5
   integer, parameter :: beside = 2   ! rows and nodes beyond the film under pressure that marches of it alone take

contains

   !> Work space for a grid.
   pure function new_energy(levels, scales, grid) result(self)
      integer, intent(in) :: levels
      type(heat_scales_t), intent(in) :: scales
      type(grid_t), intent(in) :: grid
      type(energy_t) :: self
      self%levels = new_film_levels(levels)
      self%scales = scales
      self%shear = new_film_shear(levels, grid%nx, grid%ny)
      allocate (self%rise(0:levels, 0:grid%nx, 0:grid%ny), self%into_wall(2, 0:grid%nx, 0:grid%ny), source=0.0_dp)
      allocate (self%until(0:grid%ny), source=grid%nx)
   end function new_energy

   !> Let a problem have temperatures: T0 everywhere at first, and the flow across the film of a Newtonian oil, too.
   pure subroutine warm_problem(problem, levels)
      type(contact_problem_t), intent(inout) :: problem
      integer, intent(in) :: levels

      associate (c => problem%conditions, nx => problem%grid%nx, ny => problem%grid%ny)
         call problem%rheology%generalise()
         if (.not. allocated(problem%film_flow)) &
            problem%film_flow = problem%rheology%film_flow(c%elliptic%k, c%lambdabar, c%slip_parameter)
         call problem%film_flow%rules%set_levels(levels)
         problem%heat = new_film_heat(levels, nx, ny, problem%film_flow)
      end associate
   end subroutine warm_problem

   !> After marches of a steady state: prepare the march to a time later by dT, theory eq. (T9).
   pure subroutine start_in_time(self, problem, state, dt)
      class(energy_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state       !! the steady state
      real(dp), intent(in) :: dt
      real(dp) :: speed
      integer :: wall

      allocate (self%steady_rise(2, 0:problem%grid%nx, 0:problem%grid%ny))
      allocate (self%walls(2))
      do wall = 1, 2
         self%steady_rise(wall, :, :) = self%rise(merge(self%levels%n, 0, wall == 1), :, :)
         speed = merge(problem%conditions%slip_parameter, 2 - problem%conditions%slip_parameter, wall == 1)
         self%walls(wall) = new_wall_history(problem%grid%nx, problem%grid%ny, problem%grid%hx, speed, dt, &
                                             self%scales%body(wall)/sqrt(2*pi*self%scales%peclet(wall)))
      end do
      self%steady_heat = self%into_wall
      allocate (self%earlier)
      call self%earlier%begin(problem, state, dt)
   end subroutine start_in_time

   !> Advance the earlier temperatures to the last time.
   pure subroutine pass_time(self, problem, state)
      class(energy_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state       !! now
      integer :: wall

      do wall = 1, 2
         call self%walls(wall)%take(self%into_wall(wall, :, :) - self%steady_heat(wall, :, :))
         call self%walls(wall)%go_on()
      end do
      call self%earlier%pass(problem, state)
   end subroutine pass_time

   !> Extrapolate temperatures from the last step: a first guess for the next.
   pure subroutine look_ahead(self, problem)
      class(energy_t), intent(in) :: self
      type(contact_problem_t), intent(inout) :: problem
      problem%heat%rise = 2*self%earlier%rise - self%earlier%before
   end subroutine look_ahead

   !> March at a state: temperatures of the problem, with the source linearised about the previous temperatures. Nothing
   !> flows back from downstream of all film under pressure: there, on request, rises equal the last node's before,
   !> until `finish`.
   subroutine march(self, problem, state, flow, until_film_ends)
      class(energy_t), intent(inout) :: self
      type(contact_problem_t), intent(inout) :: problem
      type(state_t), intent(in) :: state
      type(flow_t), intent(in) :: flow             !! at the state
      logical, intent(in) :: until_film_ends
      real(dp) :: before, change, largest, mean
      integer :: i, j

      if (allocated(self%earlier)) then
         call shear_film(self%shear, problem, state, self%levels, self%scales, &
                         (state%p - self%earlier%p)/self%earlier%dt)
      else
         call shear_film(self%shear, problem, state, self%levels, self%scales)
      end if
      call find_layer_fluxes(self%flux, problem%grid, problem%conditions%elliptic%kappa, self%levels, self%shear, flow)
      self%rise = problem%heat%rise
      if (.not. allocated(self%bodies)) then
         self%bodies = new_wall_heat(problem%grid, problem%conditions%elliptic%kappa, self%scales)
         call self%bodies%take(problem%grid, self%into_wall)
      end if
      self%until = problem%grid%nx
      if (until_film_ends .and. minval(self%scales%peclet) > fast) self%until = film_ends(problem%grid, state%p)
      call self%march_rows(problem, state%h, flow%f, [(0, j=0, problem%grid%ny)])
      change = 0
      largest = tiny(largest)
      do j = 0, problem%grid%ny
         do i = 0, problem%grid%nx
            before = problem%heat%mean_rise(i, j)
            mean = dot_product(self%levels%weight, self%rise(:, i, j))
            change = change + problem%grid%weight(j)*max(state%p(i, j), 0.0_dp)*abs(mean - before)
            largest = max(largest, abs(mean))
            problem%heat%rise(:, i, j) = self%rise(:, i, j)
         end do
      end do
      before = self%difference
      self%heat_difference = self%heat
      self%heat = problem%grid%integral(merge(self%shear%shear_heat/state%h, 0.0_dp, state%p > bearing))
      self%heat_difference = abs(self%heat_difference - self%heat)/max(self%heat, tiny(before))
      self%difference = change*problem%grid%hx*problem%grid%hy/largest
      call count(problem, real(heat_operations, dp)*size(self%rise))
      if (allocated(self%earlier)) return
      before = self%bodies%operations
      call self%settle_walls(problem, state, change)
      call count(problem, self%bodies%operations - before)
      self%difference = max(self%difference, change/largest)
   end subroutine march

   !> Add operations to the work done on a grid.
   subroutine count(problem, operations)
      type(contact_problem_t), intent(inout) :: problem
      real(dp), intent(in) :: operations
      if (allocated(problem%deformation)) problem%deformation%work = problem%deformation%work + operations
   end subroutine count

   !> Rises of the surfaces by the heat of a march, as the film conducts it.
   subroutine settle_walls(self, problem, state, change)
      class(energy_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      real(dp), intent(out) :: change            !! what the rises of the march lacked, K, weighted with the pressure
      real(dp), dimension(2, 0:problem%grid%nx, 0:problem%grid%ny) :: missing, response
      real(dp) :: less
      integer :: i, j

      response = 0
      associate (grid => problem%grid, weight => self%levels%weight)
         do j = grid%first_row, grid%last_row
            do i = 1, min(grid%nx - 1, self%until(j))
               associate (made => self%shear%made(:, :, i, j))
                  less = dot_product(weight, made(:, made_by_own)) &
                         - dot_product(weight, made(:, made_by_stress))*sum(made(:, made_stress_by_rise))
               end associate
               less = min(less, 0.0_dp)
               response(:, i, j) = [1.0_dp, 0.25_dp*less/(1 - less/12)]/state%h(i, j)
            end do
         end do
         call self%bodies%settle(grid, self%into_wall, response, minval(self%scales%peclet) > fast, missing)
         change = 0
         do j = grid%first_row, grid%last_row
            do i = 1, grid%nx - 1
               change = change + grid%weight(j)*max(state%p(i, j), 0.0_dp)*0.5_dp*sum(abs(missing(:, i, j)))
            end do
         end do
         change = change*grid%hx*grid%hy
      end associate
   end subroutine settle_walls

   !> Last node of each row that is within so many nodes and rows of the film under pressure.
   pure function film_ends(grid, p) result(until)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: p(0:, 0:)
      integer :: until(0:grid%ny)
      integer :: i, j, last(0:grid%ny)

      do j = 0, grid%ny
         last(j) = 1
         do i = grid%nx - beside, 2, -1
            if (.not. p(i, j) > least_pressure) cycle
            last(j) = i + beside
            exit
         end do
      end do
      do j = 0, grid%ny
         until(j) = maxval(last(max(0, j - beside):min(grid%ny, j + beside)))
         if (until(j) >= grid%nx - 1) until(j) = grid%nx
      end do
   end function film_ends

   !> The rest of the nodes, after a march until the film ends.
   pure subroutine finish(self, problem, state)
      class(energy_t), intent(inout) :: self
      type(contact_problem_t), intent(inout) :: problem
      type(state_t), intent(in) :: state
      call self%march_rows(problem, state%h, problem%density(state%p)*state%h, self%until)
      self%until = problem%grid%nx
      problem%heat%rise = self%rise
   end subroutine finish

   !> Means and fluidities of the temperatures of a problem at a state.
   pure subroutine weigh(self, problem, state)
      class(energy_t), intent(in) :: self
      type(contact_problem_t), intent(inout) :: problem
      type(state_t), intent(in) :: state
      call problem%heat%weigh(problem%rheology, problem%film_flow, self%levels%weight, state%p, self%until)
   end subroutine weigh

end module ehlwave_energy
