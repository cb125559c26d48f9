!> Correction of a kernel that has been interpolated from every second node, near its singularity.
module ehlwave_mlmi_correction
   use ehlwave_kernel, only: cell_influence
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: midpoint_weights, new_correction

   !> Sampled kernel: the cell kernel of the finest grid at whole multiples of `stride` cells.
   type, public :: sampled_kernel_t
      real(dp) :: hx = 0, hy = 0       !! cell size of the finest grid
      real(dp) :: kappa = 1, k = 0     !! ellipticity and elliptic integral
      integer :: stride(2) = 1         !! cells of the finest grid per node distance along X and Y
   contains
      procedure :: at
      procedure :: gaps
   end type sampled_kernel_t

   !> C(d, e) = K(d, e) - sum over s of w(s) (K(d + s, e) + K(d - s, e)), d along the coarsened direction.
   !>
   !> Kept where d and e are within `reach` node distances (of the coarsened direction, in metres). What is
   !> left out is not dropped but added to the coefficients next to d = e = 0, separately for even and odd
   !> d because these see different pressures: then the correction is exact for constant pressure.
   type, public :: correction_t
      integer :: reach_x = 0, reach_y = 0
      integer, allocatable :: width(:)   !! (0:reach_y) |dx| <= width(|dy|) is corrected
      real(dp), allocatable :: c(:, :)   !! (0:reach_x, 0:reach_y), even in both
   end type correction_t

contains

   !> Kernel at (i, j) node distances.
   elemental real(dp) function at(self, i, j)
      class(sampled_kernel_t), intent(in) :: self
      integer, intent(in) :: i, j
      at = cell_influence(self%stride(1)*i*self%hx, self%stride(2)*j*self%hy, self%hx, self%hy, self%kappa, self%k)
   end function at

   !> Node distances along X and Y in one physical unit, that of Y.
   pure function gaps(self)
      class(sampled_kernel_t), intent(in) :: self
      real(dp) :: gaps(2)
      gaps = self%stride*[self%kappa*self%hx, self%hy]
   end function gaps

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

   !> Correction for interpolation along one direction.
   pure function new_correction(kernel, direction, order, reach, cells, moments) result(self)
      type(sampled_kernel_t), intent(in) :: kernel
      integer, intent(in) :: direction    !! 1: X is coarsened, 2: Y
      integer, intent(in) :: order        !! of the interpolation, 4, 6 or 8
      real(dp), intent(in) :: reach       !! radius of the corrected disc in node distances of that direction
      integer, intent(in) :: cells(2)     !! largest distance between two nodes along X and Y
      integer, intent(in) :: moments
      type(correction_t) :: self
      real(dp), allocatable :: c(:, :), table(:, :)
      real(dp) :: gaps(2), ratio
      integer :: across, along, d, e, far_across, far_along, near_across, near_along

      along = direction
      across = 3 - direction
      gaps = kernel%gaps()
      ratio = gaps(across)/gaps(along)
      near_along = min(int(reach), cells(along))
      near_across = min(int(reach/ratio), cells(across))
      far_along = min(int(4*reach) + 4, max(cells(along), 3))
      far_across = min(int((4*reach + 4)/ratio) + 2, max(cells(across), 3))

      allocate (table(0:far_along + order, 0:far_across), c(0:far_along, 0:far_across))
      do e = 0, far_across
         do d = 0, ubound(table, 1)
            if (along == 1) table(d, e) = kernel%at(d, e)
            if (along == 2) table(d, e) = kernel%at(e, d)
         end do
      end do
      call interpolation_error(midpoint_weights(order), table, c)
      call lump_far_part(c, reach, ratio, near_along, near_across, moments)

      if (along == 1) then
         self%c = c(0:near_along, 0:near_across)
      else
         self%c = transpose(c(0:near_along, 0:near_across))
      end if
      self%reach_x = merge(near_along, near_across, along == 1)
      self%reach_y = merge(near_across, near_along, along == 1)
      allocate (self%width(0:self%reach_y))
      do e = 0, self%reach_y
         self%width(e) = count([(is_near(merge(d, e, along == 1), merge(e, d, along == 1), reach, ratio), &
                                 d=0, self%reach_x)]) - 1
      end do
      call move_to_zero_base(self%c)
   end function new_correction

   !> Whether a distance (along, across) belongs to the corrected disc.
   elemental logical function is_near(along, across, reach, ratio)
      integer, intent(in) :: along, across
      real(dp), intent(in) :: reach, ratio
      is_near = real(along, dp)**2 + (ratio*across)**2 <= reach**2 + 1e-9_dp
   end function is_near

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

   !> Set the coefficients outside the disc to zero and put their sums on the smallest distances.
   pure subroutine lump_far_part(c, reach, ratio, near_along, near_across, moments)
      real(dp), intent(inout) :: c(0:, 0:)
      real(dp), intent(in) :: reach, ratio
      integer, intent(in) :: near_along, near_across, moments
      real(dp) :: t(0:1), t2(0:1), ta(0:1), part, w
      integer :: d, e

      t = 0; t2 = 0; ta = 0
      do e = 0, ubound(c, 2)
         do d = 0, ubound(c, 1)
            if (is_near(d, e, reach, ratio) .and. d <= near_along .and. e <= near_across) cycle
            w = c(d, e)*merge(1, 2, d == 0)*merge(1, 2, e == 0)
            c(d, e) = 0
            t(modulo(d, 2)) = t(modulo(d, 2)) + w
            t2(modulo(d, 2)) = t2(modulo(d, 2)) + w*d*d
            ta(modulo(d, 2)) = ta(modulo(d, 2)) + w*e*e
         end do
      end do
      if (moments < 1) return
      part = 0
      if (moments == 2 .and. near_along > 2 .and. near_across > 0) then
         c(2, 0) = c(2, 0) + t2(0)/8
         c(0, 1) = c(0, 1) + ta(0)/2
         t(0) = t(0) - t2(0)/4 - ta(0)
         c(3, 0) = c(3, 0) + (t2(1) - t(1))/16
         c(1, 1) = c(1, 1) + ta(1)/4
         t(1) = t(1) - (t2(1) - t(1))/8 - ta(1)
      end if
      c(0, 0) = c(0, 0) + t(0)
      if (near_along > 0) c(1, 0) = c(1, 0) + t(1)/2
   end subroutine lump_far_part

   pure subroutine move_to_zero_base(c)
      real(dp), allocatable, intent(inout) :: c(:, :)
      real(dp), allocatable :: moved(:, :)
      allocate (moved(0:size(c, 1) - 1, 0:size(c, 2) - 1))
      moved(:, :) = c
      call move_alloc(moved, c)
   end subroutine move_to_zero_base

end module ehlwave_mlmi_correction
