!> Pressure at the edges of a flooded domain: the far-field pressure for the film there.
!>
!> Theory eq. (F5): with the reduced pressure q = A/H^2 of the far field (`ehlwave_far_field`) and an oil that thickens
!> by exp(alpha P) at these low pressures, P = -ln(1 - alpha q)/alpha: an additional equation for each edge node. Edges
!> of a truncated domain have no such nodes, P = 0 there.
!>
!> H counts without roughness: of waves that pass an edge the far field sees the mean (Ad/Ai, M = 20, L = 5, D = 1, on
!> the paper's domain: 0.05 % off in place of 0.28 %).
module ehlwave_edge_values
   use ehlwave_conditions, only: conditions_t
   use ehlwave_far_field, only: far_field_t, new_far_field
   use ehlwave_given, only: given_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_rheology, only: rheology_t
   implicit none (type, external)
   private
   public :: new_edge_values

   real(dp), parameter :: most_thickening = 0.9_dp   !! bound of alpha q, which far out is some per cent

   !> The nodes, and the far field there.
   type, public :: edge_values_t
      integer, allocatable :: i(:), j(:)        !! nodes
      integer, allocatable :: link(:)  !! index in `poiseuille_links` by which the next node inside sees it, 0 for
                                                !! corners
      real(dp), allocatable :: strength(:)      !! A
      real(dp) :: load = 0                      !! load outside the domain, over the nominal load
      real(dp), private :: thickening = 0       ! alpha: d ln(eta)/dP at P = 0
      real(dp), private :: x_min = 0, y_max = 0 ! start of the outside region, as for `far_field_t%outside`
      type(far_field_t), private :: far
   contains
      procedure :: count => count_nodes
      procedure :: inner
      procedure :: compare
      procedure :: run_dry
      procedure :: film_outside
      procedure :: pressure_outside
      procedure :: impose
      procedure :: rough_from
   end type edge_values_t

   integer, parameter :: west = 3, north = 4, south = 5                      ! links
   integer, parameter :: inner_i(west:south) = [1, 0, 0], inner_j(west:south) = [0, -1, 1]

contains

   !> Edges of a grid. A flooded one has pressure upstream of X = 0: at the inlet, and at the sides up to there.
   function new_edge_values(grid, conditions, rheology) result(self)
      type(grid_t), intent(in) :: grid
      type(conditions_t), intent(in) :: conditions
      type(rheology_t), intent(in) :: rheology
      type(edge_values_t) :: self
      integer :: first, i, j, wet

      allocate (self%i(0), self%j(0), self%link(0), self%strength(0))
      if (.not. grid%is_flooded) return
      self%thickening = rheology%thickening()
      self%far = new_far_field(conditions, self%thickening)
      self%x_min = grid%x(0) - 0.5_dp*grid%hx
      self%y_max = merge(grid%hy, grid%y(grid%ny) + 0.5_dp*grid%hy, grid%is_line)   ! for a line the strip's width
      self%load = self%far%load_outside(self%x_min, self%y_max)
      self%i = [(0, j=0, grid%ny)]
      self%j = [(j, j=0, grid%ny)]
      self%link = merge(west, 0, self%j >= grid%first_row .and. self%j <= grid%last_row)
      if (.not. grid%is_line) then
         wet = count(grid%x(1:grid%nx - 1) < 0)
         do first = merge(grid%ny, 0, grid%is_half), grid%ny, grid%ny
            self%i = [self%i, (i, i=1, wet)]
            self%j = [self%j, (first, i=1, wet)]
            self%link = [self%link, (merge(south, north, first == 0), i=1, wet)]
         end do
      end if
      self%strength = self%far%strength(grid%x(self%i), grid%y(self%j))
   end function new_edge_values

   !> Number of nodes.
   pure integer function count_nodes(self)
      class(edge_values_t), intent(in) :: self
      count_nodes = size(self%i)
   end function count_nodes

   !> The next node inside of a node that has a link.
   pure function inner(self, k) result(node)
      class(edge_values_t), intent(in) :: self
      integer, intent(in) :: k
      integer :: node(2)   !! i, j
      node = [self%i(k) + inner_i(self%link(k)), self%j(k) + inner_j(self%link(k))]
   end function inner

   !> By how much the pressures at the edges exceed the far-field pressures, and how fast the latter fall with the film.
   pure subroutine compare(self, given, p, h, excess, slope)
      class(edge_values_t), intent(in) :: self
      type(given_t), intent(in) :: given
      real(dp), intent(in) :: p(0:, 0:), h(0:, 0:)          !! P and H > 0, (0:nx, 0:ny)
      real(dp), intent(inout) :: excess(:), slope(:)        !! (nodes) P - P_far(H), -d P_far/dH
      real(dp) :: film
      integer :: k
      do k = 1, size(self%i)
         film = h(self%i(k), self%j(k)) - edge_rough_at(self, given, k)
         excess(k) = p(self%i(k), self%j(k)) - far_pressure(self, self%strength(k), film)
         slope(k) = 2*self%strength(k)/film**3/(1 - share_thickened(self, self%strength(k), film))
      end do
   end subroutine compare

   !> Where the gap at the edges is not full there is no far field, and P = 0 there.
   pure subroutine run_dry(self, supply, p, h, excess, slope, unit)
      class(edge_values_t), intent(inout) :: self
      real(dp), intent(in) :: supply(0:)                    !! (0:ny) oil offered at the inlet edge, rho H
      real(dp), intent(in) :: p(0:, 0:), h(0:, 0:)          !! P and H, (0:nx, 0:ny)
      real(dp), intent(inout) :: excess(:), slope(:)        !! as `compare` left them
      real(dp), intent(out) :: unit                         !! largest pressure that the far field would have
      logical :: is_dry(size(self%i))
      integer :: k

      unit = 0
      do k = 1, size(self%i)
         unit = max(unit, abs(p(self%i(k), self%j(k)) - excess(k)))
         is_dry(k) = supply(self%j(k)) < h(self%i(k), self%j(k))
         if (.not. is_dry(k)) cycle
         excess(k) = p(self%i(k), self%j(k))
         slope(k) = 0
      end do
      self%load = self%load*count(.not. is_dry)/max(size(is_dry), 1)
   end subroutine run_dry

   !> Places outside the domain, out to `times` its size: the areas dX dY that they represent, H and alpha q of the far
   !> field. None where the edges are not flooded.
   subroutine film_outside(self, times, area, h, thickened)
      class(edge_values_t), intent(in) :: self
      real(dp), intent(in) :: times
      real(dp), allocatable, dimension(:), intent(out) :: area, h, thickened
      real(dp), allocatable :: x(:), y(:)
      call places_outside(self, times, x, y, area, h)
      thickened = share_thickened(self, self%far%strength(x, y), h)
   end subroutine film_outside

   !> Pressure at these places.
   subroutine pressure_outside(self, times, area, x, p)
      class(edge_values_t), intent(in) :: self
      real(dp), intent(in) :: times
      real(dp), allocatable, dimension(:), intent(out) :: area, x, p   !! dX dY, X, P
      real(dp), allocatable :: h(:), y(:)
      call places_outside(self, times, x, y, area, h)
      p = far_pressure(self, self%far%strength(x, y), h)
   end subroutine pressure_outside

   !> The places themselves.
   subroutine places_outside(self, times, x, y, area, h)
      class(edge_values_t), intent(in) :: self
      real(dp), intent(in) :: times
      real(dp), allocatable, dimension(:), intent(out) :: x, y, area, h
      if (size(self%i) > 0) then
         call self%far%outside(self%x_min, self%y_max, x, y, area, h, times)
      else
         allocate (x(0), y(0), area(0), h(0))
      end if
   end subroutine places_outside

   !> Give the edges the pressures of the far field.
   pure subroutine impose(self, given, h, p)
      class(edge_values_t), intent(in) :: self
      type(given_t), intent(in) :: given
      real(dp), intent(in) :: h(0:, 0:)
      real(dp), intent(inout) :: p(0:, 0:)
      integer :: k
      do k = 1, size(self%i)
         p(self%i(k), self%j(k)) = far_pressure(self, self%strength(k), &
                                                h(self%i(k), self%j(k)) - edge_rough_at(self, given, k))
      end do
   end subroutine impose

   !> Roughness at the edges of a grid, from the data of the next finer grid.
   pure function rough_from(self, fine, given, row_ratio) result(rough)
      class(edge_values_t), intent(in) :: self
      type(edge_values_t), intent(in) :: fine
      type(given_t), intent(in) :: given        !! to the finer grid
      integer, intent(in) :: row_ratio          !! its rows per row of this grid
      real(dp), allocatable :: field(:, :), rough(:)
      integer :: k

      allocate (field(0:maxval(fine%i), 0:maxval(fine%j)), rough(size(self%i)), source=0.0_dp)
      do k = 1, size(fine%i)
         field(fine%i(k), fine%j(k)) = edge_rough_at(fine, given, k)
      end do
      do k = 1, size(self%i)
         rough(k) = field(2*self%i(k), row_ratio*self%j(k))
      end do
   end function rough_from

   !> Roughness at a node.
   pure real(dp) function edge_rough_at(self, given, k) result(rough)
      class(edge_values_t), intent(in) :: self
      type(given_t), intent(in) :: given
      integer, intent(in) :: k
      rough = 0
      if (allocated(given%edge_rough)) then
         rough = given%edge_rough(k)
      else if (allocated(given%rough)) then
         rough = given%rough(self%i(k), self%j(k))
      end if
   end function edge_rough_at

   !> Pressure of the far field for a film.
   elemental real(dp) function far_pressure(self, strength, h)
      class(edge_values_t), intent(in) :: self
      real(dp), intent(in) :: strength, h   !! A, H
      far_pressure = strength/h**2
      if (self%thickening > 0) far_pressure = -log(1 - share_thickened(self, strength, h))/self%thickening
   end function far_pressure

   !> alpha q.
   elemental real(dp) function share_thickened(self, strength, h)
      class(edge_values_t), intent(in) :: self
      real(dp), intent(in) :: strength, h
      share_thickened = min(self%thickening*strength/h**2, most_thickening)
   end function share_thickened

end module ehlwave_edge_values
