!> Temperatures of the film and of both surfaces at a state: the equation of energy, theory eq. (T6) and (T7).
!>
!> The oil and the surfaces carry heat downstream, so the rows are marched along X, column by column, where oil flows
!> back to and fro. Oil from a row that comes later brings the rise of the march before. Marches follow on each other
!> while viscosity and pressure settle, so that none is repeated for that alone.
module ehlwave_energy
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_film_column, only: column_t, new_column, solve_column
   use ehlwave_film_heat, only: film_heat_t
   use ehlwave_film_levels, only: film_levels_t, new_film_levels
   use ehlwave_film_shear, only: film_shear_t, new_film_shear, shear_film
   use ehlwave_flow, only: flow_t
   use ehlwave_grid, only: grid_t
   use ehlwave_heat_data, only: heat_scales_t
   use ehlwave_kinds, only: dp
   use ehlwave_layer_flux, only: find_layer_fluxes, layer_flux_t, layer_shares
   use ehlwave_state, only: state_t
   use ehlwave_wall_heat, only: wall_weights
   implicit none (type, external)
   private
   public :: new_energy, warm_problem

   type, public :: energy_t
      type(film_levels_t) :: levels
      type(heat_scales_t) :: scales
      type(film_shear_t) :: shear
      type(layer_flux_t) :: flux
      real(dp), allocatable :: rise(:, :, :)        !! of the last march, K, (0:levels, 0:nx, 0:ny)
      real(dp), allocatable :: into_wall(:, :, :)   !! d theta/d zeta over H, into surfaces 1 and 2, (2, 0:nx, 0:ny)
      real(dp) :: difference = huge(1.0_dp)         !! of its mean rise from that before, over the largest,
      real(dp) :: heat_difference = huge(1.0_dp)    !! and of the heat of shear, which goes with friction
      real(dp), private :: heat = 0                 ! of shear
      real(dp), private :: damping = 1              ! of what temperatures change, while marches contradict each other
   contains
      procedure :: march
      procedure :: carried
      procedure, private :: march_row
   end type energy_t

   integer, parameter :: turns = 2
   real(dp), parameter :: contradiction = 0.8_dp, stronger = 0.7_dp, least_damping = 0.1_dp   ! see `damping`

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
   end function new_energy

   !> Let a problem have temperatures: T0 everywhere at first, and the flow across the film of a Newtonian oil, too.
   pure subroutine warm_problem(problem, levels)
      type(contact_problem_t), intent(inout) :: problem
      integer, intent(in) :: levels

      associate (c => problem%conditions, nx => problem%grid%nx, ny => problem%grid%ny)
         call problem%rheology%generalise()
         problem%film_flow = problem%rheology%film_flow(c%elliptic%k, c%lambdabar, c%slip_parameter)
         call problem%film_flow%set_levels(levels)
         problem%heat = film_heat_t()
         allocate (problem%heat%rise(0:levels, 0:nx, 0:ny), source=0.0_dp)
         allocate (problem%heat%ln_fluidity, source=problem%heat%rise)
         allocate (problem%heat%mean_rise(0:nx, 0:ny), source=0.0_dp)
      end associate
   end subroutine warm_problem

   !> One march at a state, and the temperatures of the problem taken towards it: as far as the heat that they leave
   !> allows, see `share_to_go`.
   subroutine march(self, problem, state, flow)
      class(energy_t), intent(inout) :: self
      type(contact_problem_t), intent(inout) :: problem
      type(state_t), intent(in) :: state
      type(flow_t), intent(in) :: flow             !! at the state
      real(dp) :: before, change, largest, mean
      integer :: i, j

      call shear_film(self%shear, problem, state, self%levels, self%scales)
      call find_layer_fluxes(self%flux, problem%grid, problem%conditions%elliptic%kappa, self%levels, self%shear, flow)
      self%rise = problem%heat%rise
      do j = problem%grid%first_row, problem%grid%last_row
         call self%march_row(problem%grid, problem%conditions%elliptic%kappa, state%h(:, j), j)
      end do
      change = 0
      largest = tiny(largest)
      do j = 0, problem%grid%ny
         do i = 0, problem%grid%nx
            before = problem%heat%mean_rise(i, j)
            mean = dot_product(self%levels%weight, self%rise(:, i, j))
            change = change + problem%grid%weight(j)*max(state%p(i, j), 0.0_dp)*abs(mean - before)
            largest = max(largest, abs(mean))
            associate (old => problem%heat%rise(:, i, j), new => self%rise(:, i, j))
               old = old + share_to_go(old, new, self%levels%weight, self%shear%relief(i, j), &
                                       self%shear%shear_heat(i, j))*self%damping*(new - old)
            end associate
         end do
      end do
      before = self%difference
      self%heat_difference = self%heat
      self%heat = problem%grid%integral(self%shear%shear_heat/state%h)
      self%heat_difference = abs(self%heat_difference - self%heat)/max(self%heat, tiny(before))
      self%difference = change*problem%grid%hx*problem%grid%hy/largest
      if (self%difference > contradiction*before) self%damping = max(least_damping, stronger*self%damping)
      call problem%heat%weigh(problem%rheology, self%levels%weight, state%p)
   end subroutine march

   !> Heat that the oil carries off from each node, through its sides and across all levels, in the unit of heat flows
   !> into the surfaces.
   pure function carried(self, grid, kappa) result(heat)
      class(energy_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa
      real(dp) :: heat(0:grid%nx, 0:grid%ny)
      real(dp), dimension(0:self%levels%n) :: north, share
      real(dp) :: east(0:grid%nx - 1)
      integer :: back, front, i, j

      share = layer_shares(self%levels)
      heat = 0
      associate (theta => self%rise, x => self%flux%x, y => self%flux%y)
         do j = grid%first_row, grid%last_row
            do i = 0, grid%nx - 1
               east(i) = dot_product(share*x(:, i, j), &
                  merge(1.5_dp*theta(:, i, j) - 0.5_dp*theta(:, max(i - 1, 0), j), theta(:, i + 1, j), x(:, i, j) > 0))
            end do
            heat(1:grid%nx - 1, j) = (east(1:) - east(:grid%nx - 2))/grid%hx
         end do
         if (.not. grid%is_line) then
            do j = 0, grid%ny - 1
               do i = 1, grid%nx - 1
                  back = min(j + 2, grid%ny)
                  front = j - 1
                  if (front < 0) front = merge(1, 0, grid%is_half)
                  north = y(:, i, j)*merge(1.5_dp*theta(:, i, j) - 0.5_dp*theta(:, i, front), &
                                           1.5_dp*theta(:, i, j + 1) - 0.5_dp*theta(:, i, back), y(:, i, j) > 0)
                  heat(i, j) = heat(i, j) + kappa/grid%hy*dot_product(share, north)
                  heat(i, j + 1) = heat(i, j + 1) - kappa/grid%hy*dot_product(share, north)
                  if (j == 0 .and. grid%is_half) heat(i, j) = heat(i, j) + kappa/grid%hy*dot_product(share, north)
               end do
            end do
         end if
      end associate
      heat = self%scales%convection*heat
   end function carried

   !> How far temperatures go from those of before to those that the heat of before makes. A rise m of the film over its
   !> surfaces, in the mean, reduces its own source by exp(-relief (m - m_before)), so that it is
   !>
   !>     m = m_new exp(-relief (m - m_before)).
   !>
   !> The part of it that is carried there from upstream is not reduced.
   pure real(dp) function share_to_go(before, new, weight, full_relief, shear_heat) result(share)
      real(dp), intent(in) :: before(0:), new(0:), weight(0:)   !! (0:levels)
      real(dp), intent(in) :: full_relief                       !! 1/K, of a rise by the heat of the place alone
      real(dp), intent(in) :: shear_heat                        !! of the place
      real(dp), parameter :: mean_of_source = 1/12.0_dp         ! rise by an even source of 1, that conduction leaves
      integer, parameter :: steps = 8
      real(dp), parameter :: slight_k = 1e-6_dp, least_share = 0.01_dp
      real(dp) :: m, m_before, m_new, relief
      integer :: n, step

      n = ubound(new, 1)
      m_before = dot_product(weight, before) - 0.5_dp*(before(0) + before(n))
      m_new = dot_product(weight, new) - 0.5_dp*(new(0) + new(n))
      share = 1
      if (m_new <= slight_k) return
      relief = full_relief*min(1.0_dp, mean_of_source*shear_heat/m_new)
      share = 1/(1 + relief*m_new)
      if (abs(m_new - m_before) <= slight_k) return
      m = max(share*m_new, slight_k)
      do step = 1, steps                           ! Newton for ln(m), concave: from below
         m = max(0.5_dp*m, m + (log(m_new/m) - relief*(m - m_before))/(1/m + relief))
      end do
      share = min(1.0_dp, max(least_share, (m - m_before)/(m_new - m_before)))
   end function share_to_go

   !> One row, from the inlet to the outlet. Where oil flows back, columns are solved upstream and downstream in turn.
   pure subroutine march_row(self, grid, kappa, h, j)
      class(energy_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa
      real(dp), intent(in) :: h(0:)                !! H of the row, (0:nx)
      integer, intent(in) :: j
      real(dp) :: w(0:grid%nx)
      type(column_t) :: column
      integer :: i, last, turn

      column = new_column(self%levels%n)
      w = wall_weights(grid%nx, grid%hx)
      last = 0
      do i = 1, grid%nx - 1
         if (any(self%flux%x(:, i - 1, j) < 0)) last = i
      end do
      do turn = 1, turns
         do i = last, 1, -1
            call solve_node(self, grid, kappa, h(i), w, i, j, column)
         end do
         self%rise(:, 0, j) = merge(0.0_dp, self%rise(:, 1, j), self%flux%x(:, 0, j) >= 0)
         do i = 1, last
            call solve_node(self, grid, kappa, h(i), w, i, j, column)
         end do
      end do
      do i = last + 1, grid%nx - 1
         call solve_node(self, grid, kappa, h(i), w, i, j, column)
      end do
      self%rise(:, grid%nx, j) = self%rise(:, grid%nx - 1, j)
   end subroutine march_row

   !> One node. Flows through its sides take the rise from upstream, of second order; oil that flows back along X of
   !> first.
   pure subroutine solve_node(self, grid, kappa, h, w, i, j, column)
      type(energy_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa, h             !! H of the node
      real(dp), intent(in) :: w(0:)                !! of `wall_weights`
      integer, intent(in) :: i, j
      type(column_t), intent(inout) :: column      !! work space
      real(dp) :: cx, cy
      integer :: above, below, m

      cx = 1/grid%hx
      cy = kappa/grid%hy
      above = grid%above(j)
      below = grid%below(j)
      column%own = 0
      column%brought = 0
      column%net = 0
      associate (theta => self%rise, x => self%flux%x, y => self%flux%y, q => self%into_wall)
         call add_side(cx*x(:, i, j), theta(:, i - 1, j), theta(:, i + 1, j), column)
         call add_inflow(cx*x(:, i - 1, j), theta(:, max(i - 2, 0), j), theta(:, i - 1, j), column)
         if (.not. grid%is_line) then
            call add_side(cy*y(:, i, j), theta(:, i, below), theta(:, i, above), column, farther(theta, above, 1))
            if (below > j) then                    ! the line of symmetry
               call add_side(cy*y(:, i, j), theta(:, i, above), theta(:, i, below), column, farther(theta, below, 1))
            else
               call add_side(-cy*y(:, i, below), theta(:, i, above), theta(:, i, below), column, &
                             farther(theta, below, -1))
            end if
         end if
         column%source = self%shear%source(:, i, j)
         column%convection = self%scales%convection*h
         column%h = h
         do m = 1, 2
            column%wall_before(m) = self%scales%wall(m)*dot_product(w(i:1:-1), q(m, 0:i - 1, j))
         end do
         column%wall_own = self%scales%wall*w(0)
         call solve_column(column, self%levels, theta(:, i, j), q(:, i, j))
      end associate

   contains

      !> Rise of the row beyond a row, on the way of oil that comes from there; that of the row itself at the edge.
      pure function farther(theta, row, step) result(rise)
         real(dp), intent(in) :: theta(0:, 0:, 0:)
         integer, intent(in) :: row, step
         real(dp) :: rise(size(theta, 1))
         integer :: next
         next = row + step
         if (next < 0 .and. grid%is_half) next = -next
         if (next < 0 .or. next > grid%ny) next = row
         rise = theta(:, i, next)
      end function farther

   end subroutine solve_node

   !> Flow out of a node takes the node's rise and half of its difference to the node behind it; flow back brings that
   !> of the node beyond, along Y with half of its difference to the one after it.
   pure subroutine add_side(flow, behind, beyond, column, farther)
      real(dp), intent(in) :: flow(:)                     !! out of the node
      real(dp), intent(in) :: behind(:), beyond(:)        !! rises
      type(column_t), intent(inout) :: column
      real(dp), intent(in), optional :: farther(:)
      column%net = column%net + flow
      where (flow > 0)
         column%own = column%own + 1.5_dp*flow
         column%brought = column%brought + 0.5_dp*flow*behind
      elsewhere
         column%brought = column%brought - flow*beyond
      end where
      if (.not. present(farther)) return
      where (.not. flow > 0) column%brought = column%brought - 0.5_dp*flow*(beyond - farther)
   end subroutine add_side

   !> Flow into a node from the node before, with that one's rise and half of its difference to the one before it.
   pure subroutine add_inflow(flow, farther, before, column)
      real(dp), intent(in) :: flow(:)
      real(dp), intent(in) :: farther(:), before(:)
      type(column_t), intent(inout) :: column
      column%net = column%net - flow
      where (flow > 0)
         column%brought = column%brought + flow*(1.5_dp*before - 0.5_dp*farther)
      elsewhere
         column%own = column%own - flow
      end where
   end subroutine add_inflow

end module ehlwave_energy
