!> One uniform grid over the contact: the whole domain, its half Y >= 0 when the case is even in Y, or one line along X.
module ehlwave_grid
   use ehlwave_assertions, only: assert, checks
   use ehlwave_kinds, only: dp
   use ehlwave_lagrange, only: lagrange_weights
   use ehlwave_threads, only: is_shared
   implicit none (type, external)
   private

   !> Nodes in a direction around the centre for values there. Measured on waves of 6.7 cells, where the centre is
   !> between nodes: cubics through four are 1.8 per cent off.
   integer, parameter :: nearest = 8
   integer, parameter, public :: centre_nodes = nearest**2
   public :: new_grid, new_line_grid

   !> Nodes X(0:nx), Y(0:ny). On the outer boundary P = 0 or, in a flooded domain, the far-field pressure; unknown P at
   !> i = 1..nx-1, j = first_row..last_row. On a half domain Y(0) = 0 is the line of symmetry and row 0 is unknown too.
   !> The grid of a line contact has one dimension: ny = 0, and row 0 is its own neighbour across, so that differences
   !> along Y vanish.
   type, public :: grid_t
      integer :: nx = 0, ny = 0             !! cells along X; stored cells along Y
      real(dp) :: hx = 0, hy = 0            !! mesh sizes in X and Y
      logical :: is_half = .true.           !! whether only Y >= 0 is stored
      logical :: is_line = .false.          !! whether it is the grid of a line contact
      logical :: is_flooded = .false.       !! whether the edges have the pressure of the far field, else P = 0
      logical :: is_fitted = .false.        !! whether differences are fitted to steep inlets, see theory eq. (D11)
      logical :: has_curved_pressure = .false.   !! whether the pressure is curved in cells, see theory eq. (D18)
      integer :: row_ratio = 2              !! rows for one row of the next coarser grid
      integer :: first_row = 0, last_row = 0   !! rows with unknown pressure
      real(dp), allocatable :: x(:), y(:)   !! node coordinates, (0:nx), (0:ny)
      real(dp), allocatable :: weight(:)    !! (0:ny) number of rows of the whole domain that a stored row represents
   contains
      procedure :: below
      procedure :: above
      procedure :: can_coarsen
      procedure :: coarser
      procedure :: new_field
      generic :: integral => real_integral, complex_integral
      procedure, private :: real_integral, complex_integral
      procedure :: value_at_centre
      procedure :: centre_weights
   end type grid_t

   !> Width of the strip that represents a line contact: under the Hertz pressure of a line, (1 - X^2)^(1/2), it bears
   !> the load of an elliptical contact, int P dX dY = 2 pi/3, so that one load balance serves both.
   real(dp), parameter, public :: strip_width = 4/3.0_dp

contains

   !> Grid of `cells_x` by `cells_y` cells over x_min..x_max by -y_max..y_max (the whole domain).
   !> A half domain needs an even `cells_y`.
   pure function new_grid(x_min, x_max, y_max, cells_x, cells_y, is_half) result(self)
      real(dp), intent(in) :: x_min, x_max, y_max   !! domain in units of a (X) and b (Y)
      integer, intent(in) :: cells_x, cells_y       !! cells over the whole domain
      logical, intent(in) :: is_half
      type(grid_t) :: self
      integer :: i, j

      if (checks) then
         call assert(x_max > x_min .and. y_max > 0, 'new_grid: a domain of positive size')
         call assert(min(cells_x, cells_y) > 0 .and. .not. (is_half .and. modulo(cells_y, 2) /= 0), &
                     'new_grid: cells, of half a domain an even number across')
      end if
      self%nx = cells_x
      self%hx = (x_max - x_min)/cells_x
      self%hy = 2*y_max/cells_y
      self%is_half = is_half
      self%ny = merge(cells_y/2, cells_y, is_half)
      self%first_row = merge(0, 1, is_half)
      self%last_row = self%ny - 1
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

      integer :: i

      if (checks) call assert(x_max > x_min .and. cells_x > 0, 'new_line_grid: cells, and a domain of positive size')
      self%nx = cells_x
      self%hx = (x_max - x_min)/cells_x
      self%hy = strip_width
      self%is_line = .true.
      self%row_ratio = 1
      allocate (self%x(0:cells_x), self%y(0:0), self%weight(0:0))
      self%x = [(x_min + i*self%hx, i=0, cells_x)]
      self%y = 0
      self%weight = 1
   end function new_line_grid

   !> Row below row j: j - 1, mirrored at the line of symmetry; of a line contact the row itself.
   pure integer function below(self, j)
      class(grid_t), intent(in) :: self
      integer, intent(in) :: j
      below = j - 1
      if (self%is_half) below = abs(j - 1)
      if (self%is_line) below = j
   end function below

   !> Row above row j: j + 1; of a line contact the row itself.
   pure integer function above(self, j)
      class(grid_t), intent(in) :: self
      integer, intent(in) :: j
      above = merge(j, j + 1, self%is_line)
   end function above

   !> Whether every second node makes a grid of at least `fewest` cells along X and over the whole width.
   pure logical function can_coarsen(self, fewest)
      class(grid_t), intent(in) :: self
      integer, intent(in) :: fewest
      can_coarsen = modulo(self%nx, 2) == 0 .and. self%nx/2 >= fewest
      if (self%is_line) return
      can_coarsen = can_coarsen .and. modulo(self%ny, 2) == 0 .and. self%ny*merge(2, 1, self%is_half)/2 >= fewest
   end function can_coarsen

   !> The grid of every second node, of a line contact along X.
   pure function coarser(self)
      class(grid_t), intent(in) :: self
      type(grid_t) :: coarser
      coarser = self
      coarser%nx = self%nx/2
      coarser%hx = 2*self%hx
      if (.not. self%is_line) then
         coarser%ny = self%ny/2
         coarser%hy = 2*self%hy
         coarser%last_row = coarser%ny - 1
      end if
      deallocate (coarser%x, coarser%y, coarser%weight)
      allocate (coarser%x(0:coarser%nx), coarser%y(0:coarser%ny), coarser%weight(0:coarser%ny))
      coarser%x = self%x(::2)
      coarser%y = self%y(::self%row_ratio)
      coarser%weight = self%weight(::self%row_ratio)
   end function coarser

   !> Zeros at all nodes. Threads share them, as new memory is slow to touch.
   subroutine new_field(self, field)
      class(grid_t), intent(in) :: self
      real(dp), allocatable, intent(out) :: field(:, :)   !! (0:nx, 0:ny)
      integer :: j
      allocate (field(0:self%nx, 0:self%ny))
      !$omp parallel do schedule(static) if (is_shared(size(field)))
      do j = 0, self%ny
         field(:, j) = 0
      end do
   end subroutine new_field

   !> Integral over the whole domain by the sum of nodal values times hX hY; of a line contact over its strip, 4/3 int
   !> dX.
   real(dp) function real_integral(self, field) result(integral)
      class(grid_t), intent(in) :: self
      real(dp), intent(in) :: field(0:, 0:)   !! (0:nx, 0:ny)
      real(dp) :: row(0:self%ny)
      integer :: j
      !$omp parallel do schedule(static) if (is_shared(size(field)))
      do j = 0, self%ny
         row(j) = self%weight(j)*sum(field(:, j))
      end do
      integral = 0
      do j = 0, self%ny
         integral = integral + row(j)
      end do
      integral = integral*self%hx*self%hy
   end function real_integral

   !> Integral of a complex field.
   complex(dp) function complex_integral(self, field) result(integral)
      class(grid_t), intent(in) :: self
      complex(dp), intent(in) :: field(0:, 0:)
      integral = cmplx(self%real_integral(field%re), self%real_integral(field%im), dp)
   end function complex_integral

   !> Value at X = Y = 0: the node there, else interpolation from the nodes around.
   pure real(dp) function value_at_centre(self, field)
      class(grid_t), intent(in) :: self
      real(dp), intent(in) :: field(0:, 0:)   !! (0:nx, 0:ny)
      real(dp) :: weight(centre_nodes)
      integer :: k, node(2, centre_nodes)

      call self%centre_weights(node, weight)
      value_at_centre = 0
      do k = 1, size(weight)
         if (abs(weight(k)) > 0) value_at_centre = value_at_centre + weight(k)*field(node(1, k), node(2, k))
      end do
   end function value_at_centre

   !> Nodes whose weighted values sum to the value at the centre. A node may come twice.
   pure subroutine centre_weights(self, node, weight)
      class(grid_t), intent(in) :: self
      integer, intent(out) :: node(2, centre_nodes)     !! i, j
      real(dp), intent(out) :: weight(centre_nodes)
      real(dp), dimension(0:nearest - 1) :: wx, wy
      integer :: i, j, k, m

      call weights_at(-self%x(0)/self%hx, 0, self%nx, i, wx)
      j = 0
      wy = 0
      wy(0) = 1
      if (.not. self%is_line) &
         call weights_at(-self%y(0)/self%hy, merge(1 - nearest/2, 0, self%is_half), self%ny, j, wy)
      do k = 0, nearest - 1
         do m = 0, nearest - 1
            node(:, nearest*k + m + 1) = [min(i + m, self%nx), min(abs(j + k), self%ny)]
            weight(nearest*k + m + 1) = wy(k)*wx(m)
         end do
      end do
   end subroutine centre_weights

   !> Lagrange weights of the nodes around a position in units of the mesh size: of `nearest` nodes, or of all that
   !> there are.
   pure subroutine weights_at(position, lowest, highest, first, weight)
      real(dp), intent(in) :: position
      integer, intent(in) :: lowest, highest   !! nodes that may be used
      integer, intent(out) :: first            !! the first of them
      real(dp), intent(out) :: weight(0:nearest - 1)
      real(dp) :: t
      integer :: points

      points = min(nearest, highest - lowest + 1)
      first = nint(position)
      if (abs(position - first) > 1e-9_dp) first = floor(position)
      first = min(max(first - points/2 + 1, lowest), highest - points + 1)
      t = position - first
      if (abs(t - nint(t)) < 1e-9_dp) t = nint(t)
      weight = 0
      weight(:points - 1) = lagrange_weights(points, t)
   end subroutine weights_at

end module ehlwave_grid
