!> Temperatures of the film and of both surfaces at a state: the equation of energy, theory eq. (T6) and (T7).
!>
!> The oil and the surfaces carry heat downstream, so the rows are marched along X, column by column, where oil flows
!> back to and fro. Oil from a row that comes later brings the rise of the march before. Marches follow on each other
!> while viscosity and pressure settle, so that none is repeated for that alone.
module ehlwave_energy
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_film_column, only: column_t, new_column, pass_across, pass_along, solve_column
   use ehlwave_film_heat, only: new_film_heat
   use ehlwave_film_levels, only: film_levels_t, new_film_levels
   use ehlwave_film_shear, only: film_shear_t, new_film_shear, shear_film
   use ehlwave_flow, only: flow_t
   use ehlwave_grid, only: grid_t
   use ehlwave_heat_data, only: heat_scales_t
   use ehlwave_kinds, only: dp
   use ehlwave_layer_flux, only: find_layer_fluxes, layer_flux_t
   use ehlwave_shear_stress, only: least_pressure
   use ehlwave_state, only: state_t
   use ehlwave_wall_heat, only: wall_weights
   use ehlwave_wall_history, only: new_wall_history, wall_history_t
   implicit none (type, external)
   private
   public :: new_energy, warm_problem

   !> Oil at the time before.
   type, public :: earlier_t
      real(dp) :: dt = 0                                       !! time since, in units of a/ubar
      real(dp), allocatable :: f(:, :), p(:, :), rise(:, :, :) !! rho H, P and K, all nodes
      real(dp), allocatable :: before(:, :, :)                 !! K, as long before that
   end type earlier_t

   type, public :: energy_t
      type(film_levels_t) :: levels
      type(heat_scales_t) :: scales
      type(film_shear_t) :: shear
      type(layer_flux_t) :: flux
      real(dp), allocatable :: rise(:, :, :)        !! of the last march, K, (0:levels, 0:nx, 0:ny)
      real(dp), allocatable :: into_wall(:, :, :)   !! d theta/d zeta over H, into surfaces 1 and 2, (2, 0:nx, 0:ny)
      real(dp) :: difference = huge(1.0_dp)         !! of its mean rise from that before, over the largest,
      real(dp) :: heat_difference = huge(1.0_dp)    !! and of the heat of shear, which goes with friction
      real(dp) :: film_difference = huge(1.0_dp)    !! relative change of H(0,0) since, which who solves for it writes
      integer, allocatable :: until(:)              !! last node of each row that the last march came to, see `march`
      real(dp), private :: heat = 0                 ! of shear
      type(earlier_t), allocatable :: earlier       !! absent: the steady state
      type(wall_history_t), allocatable :: walls(:) !! of surfaces 1 and 2, by what heat into them is beside that of the
                                                    !! steady state; with `earlier`
      real(dp), allocatable, private :: steady_rise(:, :, :), steady_heat(:, :, :)   ! of surfaces 1 and 2 and into them
                                                                                     ! then, (2, 0:nx, 0:ny)
   contains
      procedure :: start_in_time
      procedure :: pass_time
      procedure :: look_ahead
      procedure :: march
      procedure :: finish
      procedure :: weigh
      procedure, private :: march_rows
      procedure, private :: march_row
   end type energy_t

   integer, parameter :: steady_turns = 1, turns_in_time = 2   ! marches that follow settle a steady state
   real(dp), parameter :: bearing = 1e-3_dp        ! P of nodes whose heat is compared
   real(dp), parameter :: near = 0.1_dp, largest_step_k = 100
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

   !> After marches of a steady state: let the next be those of a time later by dT, theory eq. (T9).
   pure subroutine start_in_time(self, problem, state, dt)
      class(energy_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state       !! the steady one
      real(dp), intent(in) :: dt
      real(dp) :: speed
      integer :: wall

      allocate (self%steady_rise(2, 0:problem%grid%nx, 0:problem%grid%ny))
      allocate (self%walls(2))
      do wall = 1, 2
         self%steady_rise(wall, :, :) = self%rise(merge(self%levels%n, 0, wall == 1), :, :)
         speed = merge(problem%conditions%slip_parameter, 2 - problem%conditions%slip_parameter, wall == 1)
         self%walls(wall) = new_wall_history(problem%grid%nx, problem%grid%ny, problem%grid%hx, speed, dt, &
                                             self%scales%wall(wall))
      end do
      self%steady_heat = self%into_wall
      allocate (self%earlier)
      self%earlier%dt = dt
      call take_oil(self%earlier, problem, state)
      self%earlier%before = self%earlier%rise
   end subroutine start_in_time

   !> Let them be those of the time after the last ones.
   pure subroutine pass_time(self, problem, state)
      class(energy_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state       !! now
      integer :: wall

      do wall = 1, 2
         call self%walls(wall)%take(self%into_wall(wall, :, :) - self%steady_heat(wall, :, :))
         call self%walls(wall)%go_on()
      end do
      call move_alloc(self%earlier%rise, self%earlier%before)
      call take_oil(self%earlier, problem, state)
   end subroutine pass_time

   !> The oil as it is now.
   pure subroutine take_oil(earlier, problem, state)
      type(earlier_t), intent(inout) :: earlier
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      earlier%p = state%p
      if (.not. allocated(earlier%f)) allocate (earlier%f, mold=state%p)
      earlier%f(:, :) = problem%density(state%p)*state%h
      earlier%rise = problem%heat%rise
   end subroutine take_oil

   !> Temperatures as they went on in the last step: a first guess of those of the next.
   pure subroutine look_ahead(self, problem)
      class(energy_t), intent(in) :: self
      type(contact_problem_t), intent(inout) :: problem
      problem%heat%rise = 2*self%earlier%rise - self%earlier%before
   end subroutine look_ahead

   !> One march at a state: temperatures of the problem, whose source is linearised about those before. Nothing flows
   !> back from downstream of all film under pressure: there, on request, rises are those of the last node before, until
   !> `finish`.
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
      self%until = problem%grid%nx
      if (until_film_ends) self%until = film_ends(problem%grid, state%p)
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
   end subroutine march

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

   !> All rows, each from its own node on.
   pure subroutine march_rows(self, problem, h, f, from)
      class(energy_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      real(dp), intent(in) :: h(0:, 0:), f(0:, 0:)   !! H and rho H
      integer, intent(in) :: from(0:)                !! see `march_row`
      real(dp) :: w(0:problem%grid%nx)
      integer :: j

      w = wall_weights(problem%grid%nx, problem%grid%hx)
      w = w(problem%grid%nx:0:-1)
      do j = problem%grid%first_row, problem%grid%last_row
         call self%march_row(problem%grid, problem%conditions%elliptic%kappa, w, h(:, j), f(:, j), &
                             problem%heat%rise(:, :, j), j, from(j))
      end do
   end subroutine march_rows

   !> One row, from a node on. Where oil flows back, columns are solved upstream and downstream in turn.
   pure subroutine march_row(self, grid, kappa, w, h, f, before, j, from)
      class(energy_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa
      real(dp), intent(in), contiguous :: w(0:)    !! of `wall_weights`, backward
      real(dp), intent(in), contiguous :: h(0:), f(0:)   !! H and rho H of the row, (0:nx)
      real(dp), intent(in), contiguous :: before(0:, 0:) !! rise at which the source is known, (0:levels, 0:nx)
      integer, intent(in) :: j
      integer, intent(in) :: from                  !! the node before the first, 0: the inlet; else to the outlet
      real(dp) :: q(0:grid%nx, 2)                  ! heat flows into surfaces 1 and 2
      type(column_t) :: column
      integer :: end, i, last, turn

      column = new_column(self%levels%n)
      q = transpose(self%into_wall(:, :, j))
      end = grid%nx - 1
      last = from
      if (from == 0) then
         end = min(end, self%until(j))
         do i = 1, end
            if (any(self%flux%x(:, i - 1, j) < 0)) last = i
         end do
         do turn = 1, merge(turns_in_time, steady_turns, allocated(self%earlier))
            do i = last, 1, -1
               call solve_node(self, grid, kappa, h(i), f(i), w, q, before(:, i), i, j, column)
            end do
            self%rise(:, 0, j) = merge(0.0_dp, self%rise(:, 1, j), self%flux%x(:, 0, j) >= 0)
            do i = 1, last
               call solve_node(self, grid, kappa, h(i), f(i), w, q, before(:, i), i, j, column)
            end do
         end do
      end if
      do i = last + 1, end
         call solve_node(self, grid, kappa, h(i), f(i), w, q, before(:, i), i, j, column)
      end do
      do i = end + 1, grid%nx
         self%rise(:, i, j) = self%rise(:, end, j)
      end do
      self%into_wall(:, :, j) = transpose(q)
   end subroutine march_row

   !> One node. Flows through its sides take the rise from upstream, of second order; oil that flows back along X of
   !> first.
   pure subroutine solve_node(self, grid, kappa, h, f, w, q, before, i, j, column)
      type(energy_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa, h, f          !! H and rho H of the node
      real(dp), intent(in), contiguous :: w(0:)    !! of `wall_weights`, backward
      real(dp), intent(inout), contiguous :: q(0:, :)    !! heat flows into surfaces 1 and 2 of the row
      real(dp), intent(in), contiguous :: before(0:)     !! rise at which the source is known
      integer, intent(in) :: i, j
      type(column_t), intent(inout) :: column      !! work space
      real(dp) :: cx, cy, into(2), share
      integer :: above, below, k, m

      cx = 1/grid%hx
      cy = kappa/grid%hy
      above = grid%above(j)
      below = grid%below(j)
      associate (theta => self%rise, x => self%flux%x, y => self%flux%y, nx => grid%nx)
         call pass_along(column, cx, x(:, i - 1, j), x(:, i, j), theta(:, max(i - 2, 0), j), theta(:, i - 1, j), &
                         theta(:, i + 1, j))
         if (.not. grid%is_line) then
            if (below > j) then                    ! the line of symmetry
               call pass_across(column, [cy, cy], y(:, i, j), y(:, i, j), theta(:, i, farther(below, 1)), &
                                theta(:, i, below), theta(:, i, above), theta(:, i, farther(above, 1)))
            else
               call pass_across(column, [-cy, cy], y(:, i, below), y(:, i, j), theta(:, i, farther(below, -1)), &
                                theta(:, i, below), theta(:, i, above), theta(:, i, farther(above, 1)))
            end if
         end if
         if (allocated(self%earlier)) call stay(column, self%earlier, f, i, j)
         column%own_share = merge(1.0_dp, 0.0_dp, self%difference < near)
         column%convection = self%scales%convection*h
         column%h = h
         if (allocated(self%walls)) then
            column%wall_own = self%walls%own
            column%wall_before = self%steady_rise(:, i, j) - column%wall_own*self%steady_heat(:, i, j) &
                                 + [self%walls(1)%rise(i, j), self%walls(2)%rise(i, j)]
         else
            do m = 1, 2
               column%wall_before(m) = self%scales%wall(m)*heated(i, w(nx - i:), q(:, m))
            end do
            column%wall_own = self%scales%wall*w(nx)
         end if
         call solve_column(column, self%levels, self%shear%made(:, :, i, j), before, theta(:, i, j), into)
         share = 0
         do k = 0, self%levels%n
            share = max(share, abs(theta(k, i, j) - before(k)))
         end do
         if (share > largest_step_k) then
            share = largest_step_k/share
            theta(:, i, j) = before + share*(theta(:, i, j) - before)
            into = share*into
         end if
         q(i, :) = into
      end associate

   contains

      !> Sum of so many weighted heat flows upstream.
      pure real(dp) function heated(n, w, q)
         integer, intent(in) :: n
         real(dp), intent(in) :: w(n), q(n)
         integer :: l
         heated = 0
         !$omp simd reduction(+:heated)
         do l = 1, n
            heated = heated + w(l)*q(l)
         end do
      end function heated

      !> The row beyond a row, on the way of oil that comes from there; itself at the edge.
      pure integer function farther(row, step)
         integer, intent(in) :: row, step
         farther = row + step
         if (farther < 0 .and. grid%is_half) farther = -farther
         if (farther < 0 .or. farther > grid%ny) farther = row
      end function farther

   end subroutine solve_node

   !> Oil of the time before that a node holds, in (T9).
   pure subroutine stay(column, then, f, i, j)
      type(column_t), intent(inout) :: column
      type(earlier_t), intent(in) :: then
      real(dp), intent(in) :: f                        !! rho H now
      integer, intent(in) :: i, j
      integer :: k
      do k = 0, ubound(then%rise, 1)
         column%own(k) = column%own(k) + f/then%dt
         column%brought(k) = column%brought(k) + then%f(i, j)*then%rise(k, i, j)/then%dt
         column%net(k) = column%net(k) + (f - then%f(i, j))/then%dt
      end do
   end subroutine stay

end module ehlwave_energy
