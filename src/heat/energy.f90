!> Temperatures of the film and of both surfaces at a state: the equation of energy, theory eq. (T8) and (T9).
!>
!> The oil and the surfaces carry heat downstream, so the rows are marched along X, column by column. Oil that flows
!> back in the inlet brings the rise of the march before; so does oil from a row that comes later. Marches follow on each
!> other while viscosity and pressure settle, so that none is repeated for that alone.
module ehlwave_energy
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_film_column, only: column_t, solve_column
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
      real(dp) :: difference = huge(1.0_dp)         !! of its mean rise from that before, over the largest
   contains
      procedure :: march
      procedure :: carried
      procedure, private :: march_row
   end type energy_t

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
         if (.not. allocated(problem%film_flow)) &
            problem%film_flow = problem%rheology%film_flow(c%elliptic%k, c%lambdabar, c%slip_parameter)
         call problem%film_flow%set_levels(levels)
         problem%heat = film_heat_t()
         allocate (problem%heat%rise(0:levels, 0:nx, 0:ny), source=0.0_dp)
         allocate (problem%heat%ln_fluidity, source=problem%heat%rise)
         allocate (problem%heat%mean_rise(0:nx, 0:ny), source=0.0_dp)
      end associate
   end subroutine warm_problem

   !> One march at a state, and the temperatures of the problem taken towards it. Where a rise reduces its own source,
   !> they go that much less far: by 1/(1 + stiffness).
   pure subroutine march(self, problem, state, flow)
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
            problem%heat%rise(:, i, j) = problem%heat%rise(:, i, j) &
               + (self%rise(:, i, j) - problem%heat%rise(:, i, j))/(1 + self%shear%stiffness(i, j))
         end do
      end do
      self%difference = change*problem%grid%hx*problem%grid%hy/largest
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
      integer :: i, j

      share = layer_shares(self%levels)
      heat = 0
      associate (theta => self%rise, x => self%flux%x, y => self%flux%y)
         do j = grid%first_row, grid%last_row
            do i = 0, grid%nx - 1
               east(i) = dot_product(share*x(:, i, j), merge(1.5_dp*theta(:, i, j) - 0.5_dp*theta(:, max(i - 1, 0), j), &
                                                             theta(:, i + 1, j), x(:, i, j) > 0))
            end do
            heat(1:grid%nx - 1, j) = (east(1:) - east(:grid%nx - 2))/grid%hx
         end do
         if (.not. grid%is_line) then
            do j = 0, grid%ny - 1
               do i = 1, grid%nx - 1
                  north = y(:, i, j)*(merge(theta(:, i, j), theta(:, i, j + 1), y(:, i, j) > 0) &
                                      + bend(theta(:, i, :), y(:, i, j), grid, j))
                  heat(i, j) = heat(i, j) + kappa/grid%hy*dot_product(share, north)
                  heat(i, j + 1) = heat(i, j + 1) - kappa/grid%hy*dot_product(share, north)
                  if (j == 0 .and. grid%is_half) heat(i, j) = heat(i, j) + kappa/grid%hy*dot_product(share, north)
               end do
            end do
         end if
      end associate
      heat = self%scales%convection*heat
   end function carried

   !> One row, from the inlet to the outlet. Flows through its sides take the rise from upstream, of second order; oil
   !> that flows back along X of first.
   pure subroutine march_row(self, grid, kappa, h, j)
      class(energy_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa
      real(dp), intent(in) :: h(0:)                !! H of the row, (0:nx)
      integer, intent(in) :: j
      real(dp) :: w(0:grid%nx)
      type(column_t) :: column
      real(dp) :: cx, cy
      integer :: above, below, i, m, n

      n = self%levels%n
      w = wall_weights(grid%nx, grid%hx)
      cx = 1/grid%hx
      cy = kappa/grid%hy
      above = grid%above(j)
      below = grid%below(j)
      allocate (column%own(0:n), column%brought(0:n), column%net(0:n), column%source(0:n))
      associate (theta => self%rise, x => self%flux%x, y => self%flux%y, q => self%into_wall)
         theta(:, 0, j) = merge(0.0_dp, theta(:, 1, j), x(:, 0, j) >= 0)
         do i = 1, grid%nx - 1
            column%own = 0
            column%brought = 0
            column%net = 0
            call add_side(cx*x(:, i, j), theta(:, i - 1, j), theta(:, i + 1, j), column)
            call add_inflow(cx*x(:, i - 1, j), theta(:, max(i - 2, 0), j), theta(:, i - 1, j), column)
            if (.not. grid%is_line) then
               call add_across(cy*y(:, i, j), theta(:, i, above), bend(theta(:, i, :), y(:, i, j), grid, j), column)
               if (below > j) then                 ! the line of symmetry
                  call add_across(cy*y(:, i, j), theta(:, i, below), bend(theta(:, i, :), y(:, i, j), grid, j), column)
               else
                  call add_across(-cy*y(:, i, below), theta(:, i, below), &
                                  bend(theta(:, i, :), y(:, i, below), grid, below), column)
               end if
            end if
            column%source = self%shear%source(:, i, j)
            column%convection = self%scales%convection*h(i)
            column%h = h(i)
            do m = 1, 2
               column%wall_before(m) = self%scales%wall(m)*dot_product(w(i:1:-1), q(m, 0:i - 1, j))
            end do
            column%wall_own = self%scales%wall*w(0)
            call solve_column(column, self%levels, theta(:, i, j), q(:, i, j))
         end do
         theta(:, grid%nx, j) = theta(:, grid%nx - 1, j)
      end associate
   end subroutine march_row

   !> Flow out of a node downstream takes the node's rise and half of its difference to the node behind it; flow back
   !> brings that of the node beyond.
   pure subroutine add_side(flow, behind, beyond, column)
      real(dp), intent(in) :: flow(:)                     !! out of the node
      real(dp), intent(in) :: behind(:), beyond(:)        !! rises
      type(column_t), intent(inout) :: column
      column%net = column%net + flow
      where (flow > 0)
         column%own = column%own + 1.5_dp*flow
         column%brought = column%brought + 0.5_dp*flow*behind
      elsewhere
         column%brought = column%brought - flow*beyond
      end where
   end subroutine add_side

   !> Flow across rolling takes the rise of the node that it leaves, and the correction of second order.
   pure subroutine add_across(flow, beyond, correction, column)
      real(dp), intent(in) :: flow(:)                     !! out of the node
      real(dp), intent(in) :: beyond(:), correction(:)    !! rise of the node there, and beside that of the node left
      type(column_t), intent(inout) :: column
      column%net = column%net + flow
      where (flow > 0)
         column%own = column%own + flow
         column%brought = column%brought - flow*correction
      elsewhere
         column%brought = column%brought - flow*(beyond + correction)
      end where
   end subroutine add_across

   !> Half of the difference of the row that oil leaves through the face above a row to the row behind it, as it was
   !> before: none where that is outside.
   pure function bend(theta, flow, grid, row) result(correction)
      real(dp), intent(in) :: theta(:, 0:)                !! (levels, 0:ny)
      real(dp), intent(in) :: flow(:)                     !! towards the row above
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: row
      real(dp) :: correction(size(flow))
      real(dp), dimension(size(flow)) :: ahead, back
      ahead = 0
      back = 0
      if (row > 0 .or. grid%is_half) ahead = 0.5_dp*(theta(:, row) - theta(:, grid%below(row)))
      if (row + 2 <= grid%ny) back = 0.5_dp*(theta(:, row + 1) - theta(:, row + 2))
      correction = merge(ahead, back, flow > 0)
   end function bend

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
