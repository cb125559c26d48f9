!> Sparse approximation of the linearised Reynolds equation: local terms and the deformation of the nearest cells.
module ehlwave_harmonic_stencil
   use ehlwave_grid, only: grid_t
   use ehlwave_harmonic_operator, only: harmonic_transport_t
   use ehlwave_kernel, only: cell_influence, line_reference
   use ehlwave_kinds, only: dp, pi
   use ehlwave_near_stencil, only: link_i, link_j, links
   use ehlwave_reynolds, only: flow_t
   implicit none (type, external)
   private
   public :: new_harmonic_stencil

   !> Pattern isotropic in metres, but a little longer along X, and the influence of the cells in it.
   type, public :: harmonic_stencil_t
      integer :: reach_x = 2, reach_y = 1             !! largest offsets
      real(dp), allocatable :: influence(:, :)        !! (-reach_x-2:reach_x+2, -reach_y-1:reach_y+1) used in rows
   contains
      procedure :: fill_lines
   end type harmonic_stencil_t

   real(dp), parameter :: softening_reach = 3   !! radius of the softening over the reach of the pattern

contains

   !> Pattern of a grid. Of the influence 1/r of a cell only the part that is not smooth is kept,
   !>
   !>     1/r - (15/8 - 5/4 (r/R)^2 + 3/8 (r/R)^4)/R    for r < R,    R = 3 (reach + 1) mesh sizes,
   !>
   !> so that at short wavelengths what is kept has the spectrum of the whole; coarser grids see to the smooth rest. A
   !> kernel that is cut off instead has a spectrum that oscillates: measured with a pattern of 5 by 3 cells, transverse
   !> waves of 8 mesh sizes on 257 x 257 nodes (M = 100, D = 1) take 45 GMRES steps in place of 18; R over (reach + 1) from
   !> 2 to 4 makes little difference. Of the influence ln(1/r) of a line, in the same way, 3/4 - (r/R)^2 + 1/4 (r/R)^4 is
   !> taken away besides the constant ln(1/R).
   function new_harmonic_stencil(grid, kappa, k, largest_reach) result(self)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa, k        !! ellipticity and complete elliptic integral
      integer, intent(in) :: largest_reach
      type(harmonic_stencil_t) :: self
      real(dp) :: aspect, r, radius, softened
      integer :: i, j

      if (grid%is_line) then
         call set_up_line(self, grid, largest_reach)
         return
      end if
      aspect = grid%hy/(kappa*grid%hx)
      self%reach_x = min(largest_reach, max(3, nint(2*aspect)))   ! the wedge alone reaches two nodes upstream
      self%reach_y = min(largest_reach, max(1, nint(1.5_dp/aspect)))
      radius = softening_reach*min((self%reach_x + 1)*kappa*grid%hx, (self%reach_y + 1)*grid%hy)
      allocate (self%influence(-self%reach_x - 2:self%reach_x + 2, -self%reach_y - 1:self%reach_y + 1), source=0.0_dp)
      do j = -self%reach_y - 1, self%reach_y + 1
         do i = -self%reach_x - 2, self%reach_x + 2
            r = hypot(i*kappa*grid%hx, j*grid%hy)/radius
            if (r >= 1) cycle
            softened = (15 - 10*r**2 + 3*r**4)/(8*radius)*grid%hx*grid%hy/(pi*k)
            self%influence(i, j) = cell_influence(i*grid%hx, j*grid%hy, grid%hx, grid%hy, kappa, k) - softened
         end do
      end do
   end function new_harmonic_stencil

   !> Pattern of a line contact: as long as it may be, along X only.
   pure subroutine set_up_line(self, grid, largest_reach)
      type(harmonic_stencil_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: largest_reach
      real(dp) :: influence, r, radius
      integer :: i

      self%reach_x = largest_reach
      self%reach_y = 0
      radius = softening_reach*(self%reach_x + 1)*grid%hx
      allocate (self%influence(-self%reach_x - 2:self%reach_x + 2, -1:1), source=0.0_dp)
      do i = -self%reach_x - 2, self%reach_x + 2
         r = abs(i)*grid%hx/radius
         influence = cell_influence(i*grid%hx, 0.0_dp, grid%hx, grid%hy, 0.0_dp, 1.0_dp)
         self%influence(i, :) = influence - 2/pi*grid%hx*(log(line_reference/radius) + 0.75_dp - r**2 + 0.25_dp*r**4)
      end do
   end subroutine set_up_line

   !> Rows of the sparse approximation for all unknown nodes at one X; see `near_stencil`. Entries are numbered with
   !> the offset in Y first.
   pure subroutine fill_lines(self, grid, transport, kappa, flow, p, i, rows)
      class(harmonic_stencil_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      type(harmonic_transport_t), intent(in) :: transport
      real(dp), intent(in) :: kappa
      type(flow_t), intent(in) :: flow
      real(dp), intent(in) :: p(0:, 0:)
      integer, intent(in) :: i                    !! node along X
      complex(dp), intent(out) :: rows(:, :)      !! (unknown rows, (2 reach_y + 1)(2 reach_x + 1))
      complex(dp) :: by_p(size(rows, 1), links), by_h(size(rows, 1), links)
      integer :: di, dj, entry, k, n, row, target

      n = size(rows, 1)
      associate (cx => self%reach_x, cy => self%reach_y)
         call line_links(grid, transport, kappa, flow, p, i, by_p, by_h)
         do di = -cx, cx
            do dj = -cy, cy
               entry = (di + cx)*(2*cy + 1) + dj + cy + 1
               rows(:, entry) = 0
               if (i + di < 1 .or. i + di > grid%nx - 1) cycle
               do k = 1, links
                  rows(:, entry) = rows(:, entry) + by_h(:, k)*self%influence(di - link_i(k), dj - link_j(k))
                  if (link_i(k) == di .and. link_j(k) == dj) rows(:, entry) = rows(:, entry) + by_p(:, k)
               end do
            end do
         end do
         do row = 1, n                               ! neighbours beyond the edges: mirrored or none
            if (row > cy .and. row <= n - cy) cycle
            do di = -cx, cx
               do dj = -cy, cy
                  target = row + dj
                  if (target >= 1 .and. target <= n) cycle
                  entry = (di + cx)*(2*cy + 1) + dj + cy + 1
                  if (grid%is_half .and. target < 1) then
                     target = 2 - target
                     if (target - row <= cy .and. target <= n) &
                        rows(row, entry + target - row - dj) = rows(row, entry + target - row - dj) + rows(row, entry)
                  end if
                  rows(row, entry) = 0
               end do
            end do
         end do
      end associate
   end subroutine fill_lines

   !> Derivatives of the residuals at one X by pressure and film of the linked nodes.
   pure subroutine line_links(grid, transport, kappa, flow, p, i, by_p, by_h)
      type(grid_t), intent(in) :: grid
      type(harmonic_transport_t), intent(in) :: transport
      real(dp), intent(in) :: kappa
      type(flow_t), intent(in) :: flow
      real(dp), intent(in) :: p(0:, 0:)
      integer, intent(in) :: i
      complex(dp), intent(out) :: by_p(:, :), by_h(:, :)
      real(dp) :: cx, cy, e(5), d(5)
      integer :: j, jm, k

      cx = 0.5_dp/grid%hx**2
      cy = 0.5_dp*kappa**2/grid%hy**2
      do j = grid%first_row, grid%ny - 1
         jm = grid%below(j)
         k = j - grid%first_row + 1
         e(2) = cx*(flow%eps(i, j) + flow%eps(i + 1, j))
         e(3) = cx*(flow%eps(i - 1, j) + flow%eps(i, j))
         e(4) = cy*(flow%eps(i, j) + flow%eps(i, j + 1))
         e(5) = cy*(flow%eps(i, jm) + flow%eps(i, j))
         e(1) = -sum(e(2:5))
         d(2) = cx*(p(i + 1, j) - p(i, j))
         d(3) = cx*(p(i - 1, j) - p(i, j))
         d(4) = cy*(p(i, j + 1) - p(i, j))
         d(5) = cy*(p(i, jm) - p(i, j))
         d(1) = sum(d(2:5))
         by_p(k, 1) = e(1) + d(1)*flow%eps_p(i, j) - transport%w0(i)*flow%f_p(i, j)
         by_p(k, 2) = e(2) + d(2)*flow%eps_p(i + 1, j)
         by_p(k, 3) = e(3) + d(3)*flow%eps_p(i - 1, j) - transport%w1(i)*flow%f_p(i - 1, j)
         by_p(k, 4) = e(4) + d(4)*flow%eps_p(i, j + 1)
         by_p(k, 5) = e(5) + d(5)*flow%eps_p(i, jm)
         by_h(k, 1) = d(1)*flow%eps_h(i, j) - transport%w0(i)*flow%f_h(i, j)
         by_h(k, 2) = d(2)*flow%eps_h(i + 1, j)
         by_h(k, 3) = d(3)*flow%eps_h(i - 1, j) - transport%w1(i)*flow%f_h(i - 1, j)
         by_h(k, 4) = d(4)*flow%eps_h(i, j + 1)
         by_h(k, 5) = d(5)*flow%eps_h(i, jm)
         by_p(k, 6) = 0
         by_h(k, 6) = 0
         if (i >= 2) then
            by_p(k, 6) = -transport%w2(i)*flow%f_p(i - 2, j)
            by_h(k, 6) = -transport%w2(i)*flow%f_h(i - 2, j)
         end if
      end do
   end subroutine line_links

end module ehlwave_harmonic_stencil
