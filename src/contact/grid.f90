!> One uniform grid over the contact: the whole domain, its half Y >= 0 when the case is even in Y, or one line along X.
module ehlwave_grid
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: new_grid, new_line_grid

   !> Nodes X(0:nx), Y(0:ny). P = 0 on the outer boundary; unknown P at i = 1..nx-1, j = first_row..ny-1.
   !> On a half domain Y(0) = 0 is the line of symmetry and row 0 is unknown too. The grid of a line contact is a half
   !> domain of that row alone: row 1 holds P = 0 and a copy of the film, and nothing depends on it (kappa = 0).
   type, public :: grid_t
      integer :: nx = 0, ny = 0             !! cells along X; stored cells along Y
      real(dp) :: hx = 0, hy = 0            !! mesh sizes in X and Y
      logical :: is_half = .true.           !! whether only Y >= 0 is stored
      logical :: is_line = .false.          !! whether it is that of a line contact
      integer :: row_ratio = 2              !! rows for one row of the next coarser grid
      integer :: first_row = 0              !! first row with unknown pressure
      real(dp), allocatable :: x(:), y(:)   !! node coordinates, (0:nx), (0:ny)
      real(dp), allocatable :: weight(:)    !! (0:ny) how many rows of the whole domain a stored row stands for
   contains
      procedure :: below
      procedure :: last_row
      procedure :: integral
      procedure :: value_at_centre
   end type grid_t

   !> Width of the strip that stands for a line contact: under the Hertz pressure of a line, (1 - X^2)^(1/2), it bears
   !> what an elliptical contact bears under its own, int P dX dY = 2 pi/3, so that one load balance serves both.
   real(dp), parameter :: strip_width = 4/3.0_dp

contains

   !> Grid of `cells_x` by `cells_y` cells over x_min..x_max by -y_max..y_max (the whole domain).
   !> A half domain needs an even `cells_y`.
   pure function new_grid(x_min, x_max, y_max, cells_x, cells_y, is_half) result(self)
      real(dp), intent(in) :: x_min, x_max, y_max   !! domain in units of a (X) and b (Y)
      integer, intent(in) :: cells_x, cells_y       !! cells over the whole domain
      logical, intent(in) :: is_half
      type(grid_t) :: self
      integer :: i, j

      self%nx = cells_x
      self%hx = (x_max - x_min)/cells_x
      self%hy = 2*y_max/cells_y
      self%is_half = is_half
      self%ny = merge(cells_y/2, cells_y, is_half)
      self%first_row = merge(0, 1, is_half)
      allocate (self%x(0:self%nx), self%y(0:self%ny), self%weight(0:self%ny))
      self%x = [(x_min + i*self%hx, i=0, self%nx)]
      if (is_half) then
         self%y = [(j*self%hy, j=0, self%ny)]
         self%weight = 2
         self%weight(0) = 1
      else
         self%y = [(-y_max + j*self%hy, j=0, self%ny)]
         self%weight = 1
      end if
   end function new_grid

   !> Grid of a line contact over x_min..x_max.
   pure function new_line_grid(x_min, x_max, cells_x) result(self)
      real(dp), intent(in) :: x_min, x_max   !! domain in units of a
      integer, intent(in) :: cells_x
      type(grid_t) :: self

      self = new_grid(x_min, x_max, strip_width, cells_x, 2, is_half=.true.)
      self%is_line = .true.
      self%row_ratio = 1
      self%weight = 1
   end function new_line_grid

   !> Last row that belongs in a result.
   pure integer function last_row(self)
      class(grid_t), intent(in) :: self
      last_row = merge(0, self%ny, self%is_line)
   end function last_row

   !> Row below row j: j - 1, mirrored at the line of symmetry.
   pure integer function below(self, j)
      class(grid_t), intent(in) :: self
      integer, intent(in) :: j
      below = j - 1
      if (self%is_half) below = abs(j - 1)
   end function below

   !> Integral over the whole domain by the sum of nodal values times hX hY; of a line contact over its strip, 4/3 int dX.
   pure real(dp) function integral(self, field)
      class(grid_t), intent(in) :: self
      real(dp), intent(in) :: field(0:, 0:)   !! (0:nx, 0:ny)
      integer :: j
      integral = 0
      do j = 0, self%ny
         integral = integral + self%weight(j)*sum(field(:, j))
      end do
      integral = integral*self%hx*self%hy
   end function integral

   !> Value at X = Y = 0: the node there, else cubic interpolation from the nodes around.
   pure real(dp) function value_at_centre(self, field)
      class(grid_t), intent(in) :: self
      real(dp), intent(in) :: field(0:, 0:)   !! (0:nx, 0:ny)
      real(dp) :: wx(-1:2), wy(-1:2)
      integer :: i, j, k, row

      call cubic_weights(-self%x(0)/self%hx, self%nx, i, wx)
      if (self%is_line) then
         value_at_centre = dot_product(wx, field(i - 1:i + 2, 0))
         return
      end if
      call cubic_weights(-self%y(0)/self%hy, self%ny, j, wy, lowest=merge(-1, 0, self%is_half))
      value_at_centre = 0
      do k = -1, 2
         if (abs(wy(k)) <= 0) cycle
         row = abs(j + k)
         value_at_centre = value_at_centre + wy(k)*dot_product(wx, field(i - 1:i + 2, row))
      end do
   end function value_at_centre

   !> Lagrange weights of the four nodes base-1..base+2 around a position in units of the mesh size.
   pure subroutine cubic_weights(position, cells, base, weight, lowest)
      real(dp), intent(in) :: position
      integer, intent(in) :: cells
      integer, intent(out) :: base
      real(dp), intent(out) :: weight(-1:2)
      integer, intent(in), optional :: lowest   !! smallest node that may be used (default 0)
      real(dp) :: t
      integer :: first

      first = 0
      if (present(lowest)) first = lowest
      base = nint(position)
      if (abs(position - base) > 1e-9_dp) base = floor(position)
      base = min(max(base, first + 1), cells - 2)
      t = position - base
      if (abs(t - nint(t)) < 1e-9_dp) t = nint(t)
      weight(-1) = -t*(t - 1)*(t - 2)/6
      weight(0) = (t + 1)*(t - 1)*(t - 2)/2
      weight(1) = -(t + 1)*t*(t - 2)/2
      weight(2) = (t + 1)*t*(t - 1)/6
   end subroutine cubic_weights

end module ehlwave_grid
