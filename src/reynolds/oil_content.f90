!> Oil in a gap that it does not fill everywhere: content and outflow of each node, mass conserved.
!>
!> Theory eq. (C1): content theta <= 1, P >= 0, P (1 - theta) = 0. A full node has theta = 1, and its pressure is
!> unknown; a partly filled one has P = 0, and its balance alone gives its content, from P, H and the inflow from
!> upstream. So content is no unknown: one pass along the flow finds it.
module ehlwave_oil_content
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_transport, only: no_film, transport_t
   implicit none (type, external)
   private
   public :: new_content

   !> Contents of the gap at a state. Fields (0:nx, 0:ny).
   type, public :: oil_content_t
      logical, allocatable :: is_partial(:, :)    !! whether a node is partly filled
      real(dp), allocatable :: slope(:, :)        !! 1 where the outflow of a node is extrapolated to its face, else 0
      real(dp), allocatable :: outflow(:, :)      !! outflow of a node, (C3)
   contains
      procedure :: carry
      procedure :: inject_from
      procedure :: history_of
   end type oil_content_t

contains

   !> Work space for a grid.
   function new_content(grid) result(self)
      type(grid_t), intent(in) :: grid
      type(oil_content_t) :: self
      allocate (self%is_partial(0:grid%nx, 0:grid%ny), source=.false.)
      call grid%new_field(self%slope)
      call grid%new_field(self%outflow)
   end function new_content

   !> Contents and residuals of all nodes, along the flow. With G the outflow of a node,
   !>
   !>     R_i = (flow driven into node i) - (G_i - G_(i-1))/hX,    G_i = f_i + s_i (f_i - f_(i-1))/2,
   !>
   !> s_i = 1 where node i is full, else 0, and f_(i-1) there rho H, full or not: theory eq. (C3); in a time step node
   !> i - 1 one step before. A node is partly filled where P + R/|A_ii| <= 0, R that with f = rho H, the condition that
   !> `equations_t` uses for cavitated nodes. Its G = f then makes R = 0.
   pure subroutine carry(self, grid, transport, supply, p, scale, f, r)
      class(oil_content_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      type(transport_t), intent(in) :: transport
      real(dp), intent(in) :: supply(0:)                 !! (0:ny) oil offered at the inlet edge, in units of rho H
      real(dp), intent(in) :: p(0:, 0:), scale(0:, 0:)   !! P; 1/|A_ii|, 0 off the unknown nodes
      real(dp), intent(inout) :: f(0:, 0:)               !! rho H; theta rho H on return
      real(dp), intent(inout) :: r(0:, 0:)               !! flow driven into each node; R on return
      real(dp) :: capacity, inflow, partner, passed
      logical :: is_step
      integer :: i, j

      is_step = allocated(transport%inflow)
      do j = 0, grid%ny
         self%is_partial(:, j) = .false.
         self%is_partial(0, j) = supply(j) < f(0, j)
         f(0, j) = min(f(0, j), supply(j))
         capacity = merge(no_film, f(0, j), self%is_partial(0, j))
         self%slope(:, j) = 0
         self%outflow(:, j) = f(:, j)
         if (j < grid%first_row .or. j > grid%last_row) cycle
         do i = 1, grid%nx - 1
            if (is_step) then
               inflow = transport%inflow(i, j)
               partner = transport%partner(i, j)
            else
               inflow = self%outflow(i - 1, j)
               partner = capacity
            end if
            capacity = f(i, j)
            passed = f(i, j)
            if (partner > no_film) passed = passed + 0.5_dp*(f(i, j) - partner)
            ! at the first node the inflow is extrapolated as far as the outflow is
            associate (residual => r(i, j) - (merge(f(i, j), passed, i == 1) - inflow)/grid%hx)
               self%is_partial(i, j) = p(i, j) + scale(i, j)*residual <= 0
               if (self%is_partial(i, j)) then
                  f(i, j) = inflow + grid%hx*r(i, j)
                  self%outflow(i, j) = f(i, j)
                  r(i, j) = 0
               else
                  if (partner > no_film) self%slope(i, j) = 1
                  self%outflow(i, j) = passed
                  r(i, j) = residual
               end if
            end associate
         end do
      end do
   end subroutine carry

   !> Content of the next finer grid, at the nodes of this grid, as far as linear changes need it.
   pure subroutine inject_from(self, fine, row_ratio)
      class(oil_content_t), intent(inout) :: self
      class(oil_content_t), intent(in) :: fine
      integer, intent(in) :: row_ratio
      self%is_partial = fine%is_partial(::2, ::row_ratio)
      self%slope = merge(0.0_dp, 1.0_dp, self%is_partial)
      self%slope(0, :) = 0
      where (self%is_partial(0, :)) self%slope(1, :) = 0
   end subroutine inject_from

   !> Data for a later time step: outflow of each node, and rho H, `no_film` at dry edges.
   pure subroutine history_of(self, capacity, outflow, partner)
      class(oil_content_t), intent(in) :: self
      real(dp), intent(in) :: capacity(0:, 0:)   !! rho H
      real(dp), intent(out) :: outflow(0:, 0:), partner(0:, 0:)
      outflow = self%outflow
      partner = capacity
      where (self%is_partial(0, :)) partner(0, :) = no_film
   end subroutine history_of

end module ehlwave_oil_content
