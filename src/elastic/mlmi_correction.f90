!> Correction near the singularity of a kernel that is interpolated from every second node.
module ehlwave_mlmi_correction
   use ehlwave_kernel, only: kernel_t
   use ehlwave_kinds, only: dp, pi
   implicit none (type, external)
   private
   public :: midpoint_weights, new_correction

   integer, parameter, public :: along_x = 1, along_y = 2   !! directions of coarsening

   !> Kernel of a level: kernel of the finest grid at whole multiples of `stride` cells (injection).
   type, extends(kernel_t), public :: sampled_kernel_t
      integer :: stride(2) = 1         !! cells of the finest grid between two nodes along X and Y
   contains
      procedure :: at => sampled_at
      procedure :: gaps
      procedure :: smallest_kept
   end type sampled_kernel_t

   !> C(d, e), d nodes along X and e along Y, even in both; kept where |d| <= width(|e|).
   type, public :: correction_t
      integer :: reach_x = 0, reach_y = 0
      integer, allocatable :: width(:)   !! (0:reach_y), -1 where nothing is kept
      real(dp), allocatable :: c(:, :)   !! (0:reach_x, 0:reach_y), zero where not kept
   end type correction_t

contains

   !> Kernel at a distance of (i, j) nodes.
   elemental real(dp) function sampled_at(self, i, j) result(d)
      class(sampled_kernel_t), intent(in) :: self
      integer, intent(in) :: i, j
      d = self%kernel_t%at(self%stride(1)*i, self%stride(2)*j)
   end function sampled_at

   !> Distances between two nodes along X and Y, both in units of b.
   pure function gaps(self)
      class(sampled_kernel_t), intent(in) :: self
      real(dp) :: gaps(2)
      gaps = self%stride*[self%kappa*self%hx, self%hy]
   end function gaps

   !> Smallest correction worth its cost, when on the finest level those within `reach` nodes are.
   !>
   !> Far away K ~ A/r, A = hX hY/(pi K), and interpolation from nodes at distance s, 3 s, ... errs by
   !> C ~ A ((order - 1)!!)^2/(s (r/s)^(order + 1)): the value at r = reach on the finest level. On a coarser
   !> level a node represents n = stride(1) stride(2) of the finest, and a coefficient costs 1/n as much; so that n
   !> C (error) over 1/n (cost) is the same on all levels the bound falls as 1/n^2. The radius then grows by a
   !> factor 8^(1/(order + 1)) from a level to the next coarser in both directions.
   pure real(dp) function smallest_kept(self, order, reach)
      class(sampled_kernel_t), intent(in) :: self
      integer, intent(in) :: order     !! order of the interpolation
      real(dp), intent(in) :: reach    !! radius in the smaller node distance (in metres) of the finest grid
      integer :: s
      smallest_kept = self%hx*self%hy/(pi*self%k)/min(self%kappa*self%hx, self%hy)/real(product(self%stride), dp)**2 &
                      *product([(real(s, dp)**2, s=1, order - 1, 2)])/reach**(order + 1)
   end function smallest_kept

   !> Lagrange weights w(1:order/2) of the nodes at distances 1, 3, 5, ... on either side of a midpoint.
   pure function midpoint_weights(order) result(w)
      integer, intent(in) :: order   !! even number of nodes
      real(dp) :: w(order/2)
      integer :: a, b
      do a = 1, order/2
         w(a) = 0.5_dp
         do b = 1, order/2
            if (b /= a) w(a) = w(a)*(2*b - 1)**2/real((2*b - 1)**2 - (2*a - 1)**2, dp)
         end do
      end do
   end function midpoint_weights

   !> Correction for interpolation along one direction, where it is larger than `smallest`; along X
   !>
   !>     C(d, e) = K(d, e) - sum over s = 1, 3, ..., order - 1 of w(s) (K(d + s, e) + K(d - s, e))
   pure function new_correction(kernel, direction, order, smallest, cells) result(self)
      type(sampled_kernel_t), intent(in) :: kernel
      integer, intent(in) :: direction     !! along_x or along_y
      integer, intent(in) :: order         !! order of the interpolation: 4, 6 or 8
      real(dp), intent(in) :: smallest     !! corrections below this are left out
      integer, intent(in) :: cells(2)      !! largest distance needed along X and Y
      type(correction_t) :: self
      real(dp), allocatable :: c(:, :), table(:, :), transposed(:, :)
      integer :: d, e

      call tabulate(kernel, direction, order, smallest, cells, table)
      allocate (c(0:ubound(table, 1) - order, 0:ubound(table, 2)))
      call interpolation_error(midpoint_weights(order), table, c)
      if (direction == along_y) then
         allocate (transposed(0:ubound(c, 2), 0:ubound(c, 1)))
         transposed(:, :) = transpose(c)
         call move_alloc(transposed, c)
      end if

      do e = ubound(c, 2), 0, -1
         if (any(abs(c(:, e)) >= smallest)) exit
      end do
      self%reach_y = max(e, 0)
      allocate (self%width(0:self%reach_y))
      do e = 0, self%reach_y
         do d = ubound(c, 1), 0, -1
            if (abs(c(d, e)) >= smallest) exit
         end do
         self%width(e) = d
      end do
      self%reach_x = max(maxval(self%width), 0)
      allocate (self%c(0:self%reach_x, 0:self%reach_y), source=0.0_dp)
      do e = 0, self%reach_y
         self%c(0:self%width(e), e) = c(0:self%width(e), e)
      end do
   end function new_correction

   !> Kernel as far as corrections may reach, the coarsened direction first.
   pure subroutine tabulate(kernel, direction, order, smallest, cells, table)
      type(sampled_kernel_t), intent(in) :: kernel
      integer, intent(in) :: direction, order
      real(dp), intent(in) :: smallest
      integer, intent(in) :: cells(2)
      real(dp), allocatable, intent(out) :: table(:, :)
      real(dp) :: gaps(2), radius
      integer :: d, e, reach(2), s

      ! Distance where the asymptotic correction is `smallest`, and a few nodes more.
      gaps = kernel%gaps()
      radius = (kernel%hx*kernel%hy/(pi*kernel%k)/gaps(direction)/smallest &
                *product([(real(s, dp)**2, s=1, order - 1, 2)]))**(1.0_dp/(order + 1)) + order
      reach = int(min(radius*gaps(direction)/gaps + 1, real(cells, dp)))

      allocate (table(0:reach(direction) + order, 0:reach(3 - direction)))
      do e = 0, ubound(table, 2)
         do d = 0, ubound(table, 1)
            if (direction == along_x) table(d, e) = kernel%at(d, e)
            if (direction == along_y) table(d, e) = kernel%at(e, d)
         end do
      end do
   end subroutine tabulate

   pure subroutine interpolation_error(w, table, c)
      real(dp), intent(in) :: w(:), table(0:, 0:)
      real(dp), intent(out) :: c(0:, 0:)
      integer :: a, d, e, s
      do e = 0, ubound(c, 2)
         do d = 0, ubound(c, 1)
            c(d, e) = table(d, e)
            do a = 1, size(w)
               s = 2*a - 1
               c(d, e) = c(d, e) - w(a)*(table(d + s, e) + table(abs(d - s), e))
            end do
         end do
      end do
   end subroutine interpolation_error

end module ehlwave_mlmi_correction
