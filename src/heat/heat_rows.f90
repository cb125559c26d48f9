!> March of the equation of energy along the rows of a grid, theory eq. (T6) and, in time, (T9).
!>
!> The oil and the surfaces carry heat downstream, so the rows are marched along X, column by column, where oil flows
!> back to and fro. Oil from a row that comes later brings the rise of the march before.
module ehlwave_heat_rows
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_earlier_oil, only: earlier_t
   use ehlwave_film_column, only: column_t, new_column, pass_across, pass_along, solve_column
   use ehlwave_film_levels, only: film_levels_t
   use ehlwave_film_shear, only: film_shear_t
   use ehlwave_grid, only: grid_t
   use ehlwave_heat_data, only: heat_scales_t
   use ehlwave_kinds, only: dp
   use ehlwave_layer_flux, only: layer_flux_t
   use ehlwave_wall_heat, only: wall_heat_t
   use ehlwave_wall_history, only: wall_history_t
   implicit none (type, external)
   private

   !> The film and the surfaces on a grid, with heat sources and convection.
   type, public :: heat_rows_t
      type(film_levels_t) :: levels
      type(heat_scales_t) :: scales
      type(film_shear_t) :: shear
      type(layer_flux_t) :: flux
      real(dp), allocatable :: rise(:, :, :)        !! rises of the last march, K, (0:levels, 0:nx, 0:ny)
      real(dp), allocatable :: into_wall(:, :, :)   !! d theta/d zeta over H, into surfaces 1 and 2, (2, 0:nx, 0:ny)
      real(dp) :: difference = huge(1.0_dp)         !! change of its mean rise from the previous march, over the largest
      integer, allocatable :: until(:)              !! last node of each row that a march comes to, (0:ny)
      type(wall_heat_t), allocatable :: bodies      !! steady heat in both bodies
      type(earlier_t), allocatable :: earlier       !! absent: the steady state
      type(wall_history_t), allocatable :: walls(:) !! history of surfaces 1 and 2, by the difference of heat into
                                                    !! them from the steady state; with `earlier`
      real(dp), allocatable :: steady_rise(:, :, :), steady_heat(:, :, :)   !! rises of surfaces 1 and 2 and heat into
                                                                            !! them then,
                                                                            !! (2, 0:nx, 0:ny)
   contains
      procedure :: march_rows
      procedure, private :: march_row
   end type heat_rows_t

   integer, parameter :: steady_turns = 1, turns_in_time = 2   ! marches that follow settle a steady state
   real(dp), parameter :: near = 0.1_dp, largest_step_k = 100

contains

   !> All rows, each from its own node on. The source of heat is linearised about the rises of the problem, which stay
   !> as they are.
   pure subroutine march_rows(self, problem, h, f, from)
      class(heat_rows_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      real(dp), intent(in) :: h(0:, 0:), f(0:, 0:)   !! H and rho H, (0:nx, 0:ny)
      integer, intent(in) :: from(0:)                !! see `march_row`, (0:ny)
      integer :: j

      do j = problem%grid%first_row, problem%grid%last_row
         call self%march_row(problem%grid, problem%conditions%elliptic%kappa, h(:, j), f(:, j), &
                             problem%heat%rise(:, :, j), j, from(j))
      end do
   end subroutine march_rows

   !> A row, from a node on. Where oil flows back, columns are solved upstream and downstream in turn.
   pure subroutine march_row(self, grid, kappa, h, f, before, j, from)
      class(heat_rows_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa
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
               call solve_node(self, grid, kappa, h(i), f(i), q, before(:, i), i, j, column)
            end do
            self%rise(:, 0, j) = merge(0.0_dp, self%rise(:, 1, j), self%flux%x(:, 0, j) >= 0)
            do i = 1, last
               call solve_node(self, grid, kappa, h(i), f(i), q, before(:, i), i, j, column)
            end do
         end do
      end if
      do i = last + 1, end
         call solve_node(self, grid, kappa, h(i), f(i), q, before(:, i), i, j, column)
      end do
      do i = end + 1, grid%nx
         self%rise(:, i, j) = self%rise(:, end, j)
      end do
      self%into_wall(:, :, j) = transpose(q)
   end subroutine march_row

   !> A node. Flows through its sides take the rise from upstream, of second order; backflow along X of first order.
   pure subroutine solve_node(self, grid, kappa, h, f, q, before, i, j, column)
      class(heat_rows_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa, h, f          !! H and rho H of the node
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
               column%wall_before(m) = self%bodies%rest(m, i, j) + heated(i, self%bodies%upstream(nx - i:, m), q(:, m))
            end do
            column%wall_own = self%bodies%upstream(nx, :)
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

end module ehlwave_heat_rows
