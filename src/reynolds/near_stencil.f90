!> Sparse approximation of the Jacobian: local flow terms and the deformation of the nearest cells.
module ehlwave_near_stencil
   use ehlwave_grid, only: grid_t
   use ehlwave_kernel, only: cell_influence
   use ehlwave_kinds, only: dp
   use ehlwave_reynolds, only: flow_t
   use ehlwave_transport, only: transport_t
   implicit none (type, external)
   private
   public :: new_near_stencil, row_links

   !> Pattern of the sparse operator and the influence coefficients it needs.
   type, public :: near_stencil_t
      integer :: entries = 0
      integer, allocatable :: di(:), dj(:)             !! offsets of the pattern, (entries)
      integer :: reach_x = 1, reach_y = 1              !! largest offsets
      integer, allocatable :: entry_at(:, :)           !! entry of an offset, 0 outside the pattern
      real(dp), allocatable, private :: influence(:, :) ! of a cell at an offset
   contains
      procedure :: fill_line
   end type near_stencil_t

   integer, parameter, public :: links = 6   !! nodes whose pressure and film enter the residual of a node, itself included
   integer, parameter, public :: link_i(links) = [0, 1, -1, 0, 0, -2]   !! centre, east, west, north, south, second upstream
   integer, parameter, public :: link_j(links) = [0, 0, 0, 1, -1, 0]

contains

   !> Pattern isotropic in metres: cells of the stencil measure a hX by b hY, so it reaches
   !> round(hY/(kappa hX)) cells along X for one along Y, or the reverse; at most `largest_reach`. That of a line contact
   !> reaches as far as it may along X, and not at all along Y.
   !>
   !> The kernel may be tapered: multiplied by the `taper`-th power of (1 - |i|/(reach_x+1)) (1 - |j|/(reach_y+1)). The
   !> symbol of a kernel that is simply cut is negative for waves of two cells along Y, which makes factors of the matrix
   !> amplify there; with taper 1 (the Bartlett window, whose symbol is positive) it is positive for all waves.
   function new_near_stencil(grid, kappa, k, largest_reach, taper) result(self)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa, k        !! ellipticity and complete elliptic integral
      integer, intent(in) :: largest_reach
      real(dp), intent(in) :: taper           !! 0: plain cut
      type(near_stencil_t) :: self
      real(dp) :: aspect, weight
      integer :: i, j, n

      if (grid%is_line) then
         self%reach_x = largest_reach
         self%reach_y = 0
      else
         aspect = grid%hy/(kappa*grid%hx)
         self%reach_x = min(largest_reach, max(1, nint(aspect)))
         self%reach_y = min(largest_reach, max(1, nint(1/aspect)))
      end if
      self%reach_x = max(self%reach_x, 2)     ! the wedge reaches two nodes upstream
      allocate (self%entry_at(-self%reach_x:self%reach_x, -self%reach_y:self%reach_y), source=0)
      self%entries = size(self%entry_at)
      allocate (self%di(self%entries), self%dj(self%entries))
      n = 0
      do i = -self%reach_x, self%reach_x
         do j = -self%reach_y, self%reach_y
            n = n + 1
            self%di(n) = i
            self%dj(n) = j
            self%entry_at(i, j) = n
         end do
      end do
      allocate (self%influence(-self%reach_x - 2:self%reach_x + 2, -self%reach_y - 1:self%reach_y + 1))
      do j = -self%reach_y - 1, self%reach_y + 1
         do i = -self%reach_x - 2, self%reach_x + 2
            weight = max(0.0_dp, 1 - abs(i)/(self%reach_x + 1.0_dp))*max(0.0_dp, 1 - abs(j)/(self%reach_y + 1.0_dp))
            if (.not. taper > 0) weight = 1
            self%influence(i, j) = weight**taper*cell_influence(i*grid%hx, j*grid%hy, grid%hx, grid%hy, kappa, k)
         end do
      end do
   end function new_near_stencil

   !> Coefficients of the Jacobian in the pattern for the nodes of one grid line: the entry at offset o of node i holds
   !>
   !>     dR_i/dP_(i+o) + sum over links k of dR_i/dH_(i+k) influence(o - k),
   !>
   !> entries that fall below a line of symmetry folded back, entries off the unknown nodes zero.
   pure subroutine fill_line(self, grid, transport, kappa, flow, p, j, line)
      class(near_stencil_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      type(transport_t), intent(in) :: transport
      real(dp), intent(in) :: kappa
      type(flow_t), intent(in) :: flow        !! evaluated at the point of linearisation
      real(dp), intent(in) :: p(0:, 0:)       !! its pressure, (0:nx, 0:ny)
      integer, intent(in) :: j                !! line of nodes along X
      real(dp), intent(out) :: line(:, :)     !! (nx-1, entries), nodes 1 to nx-1
      real(dp) :: by_p(grid%nx - 1, links), by_h(grid%nx - 1, links), value(grid%nx - 1)
      integer :: di, dj, first, last, link, n, target_line

      call row_links(grid, transport, kappa, flow, p, 1, grid%nx - 1, j, by_p, by_h)
      line = 0
      do dj = -self%reach_y, self%reach_y
         target_line = j + dj
         if (target_line < 0) target_line = -target_line
         if (target_line < grid%first_row .or. target_line > grid%ny - 1) cycle
         if (target_line - j > self%reach_y) cycle
         do di = -self%reach_x, self%reach_x
            value = 0
            do link = 1, links
               value = value + self%influence(di - link_i(link), dj - link_j(link))*by_h(:, link)
               if (di == link_i(link) .and. dj == link_j(link)) value = value + by_p(:, link)
            end do
            first = max(1, 1 - di)
            last = min(grid%nx - 1, grid%nx - 1 - di)
            n = self%entry_at(di, target_line - j)
            line(first:last, n) = line(first:last, n) + value(first:last)
         end do
      end do
   end subroutine fill_line

   !> Derivatives of the residuals of nodes first..last of a row by the pressure (at fixed film) and by the film of
   !> their links.
   pure subroutine row_links(grid, transport, kappa, flow, p, first, last, j, by_p, by_h)
      type(grid_t), intent(in) :: grid
      type(transport_t), intent(in) :: transport
      real(dp), intent(in) :: kappa
      type(flow_t), intent(in) :: flow        !! evaluated at the point of linearisation
      real(dp), intent(in) :: p(0:, 0:)       !! its pressure
      integer, intent(in) :: first, last, j   !! nodes
      real(dp), intent(out) :: by_p(first:, :), by_h(first:, :)   !! (first:last, links)
      real(dp) :: cx, cy, east, north, south, west
      integer :: i, jm

      cx = 0.5_dp/grid%hx**2
      cy = 0.5_dp*kappa**2/grid%hy**2
      jm = grid%below(j)
      do i = first, last
         east = cx*(p(i + 1, j) - p(i, j))
         west = cx*(p(i - 1, j) - p(i, j))
         north = cy*(p(i, j + 1) - p(i, j))
         south = cy*(p(i, jm) - p(i, j))
         by_p(i, 2) = cx*(flow%eps(i, j) + flow%eps(i + 1, j))
         by_p(i, 3) = cx*(flow%eps(i - 1, j) + flow%eps(i, j))
         by_p(i, 4) = cy*(flow%eps(i, j) + flow%eps(i, j + 1))
         by_p(i, 5) = cy*(flow%eps(i, jm) + flow%eps(i, j))
         by_p(i, 1) = -(by_p(i, 2) + by_p(i, 3) + by_p(i, 4) + by_p(i, 5)) &
                      + (east + west + north + south)*flow%eps_p(i, j) - transport%w0(i)*flow%f_p(i, j)
         by_p(i, 2) = by_p(i, 2) + east*flow%eps_p(i + 1, j)
         by_p(i, 3) = by_p(i, 3) + west*flow%eps_p(i - 1, j) - transport%w1(i)*flow%f_p(i - 1, j)
         by_p(i, 4) = by_p(i, 4) + north*flow%eps_p(i, j + 1)
         by_p(i, 5) = by_p(i, 5) + south*flow%eps_p(i, jm)
         by_h(i, 1) = (east + west + north + south)*flow%eps_h(i, j) - transport%w0(i)*flow%f_h(i, j)
         by_h(i, 2) = east*flow%eps_h(i + 1, j)
         by_h(i, 3) = west*flow%eps_h(i - 1, j) - transport%w1(i)*flow%f_h(i - 1, j)
         by_h(i, 4) = north*flow%eps_h(i, j + 1)
         by_h(i, 5) = south*flow%eps_h(i, jm)
      end do
      by_p(first:last, 6) = 0
      by_h(first:last, 6) = 0
      do i = max(first, 2), last
         by_p(i, 6) = -transport%w2(i)*flow%f_p(i - 2, j)
         by_h(i, 6) = -transport%w2(i)*flow%f_h(i - 2, j)
      end do
   end subroutine row_links

end module ehlwave_near_stencil
