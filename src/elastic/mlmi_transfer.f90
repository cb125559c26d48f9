!> Steps of multilevel multi-integration between a level and the next coarser one.
module ehlwave_mlmi_transfer
   use ehlwave_kinds, only: dp
   use ehlwave_mlmi_correction, only: along_x
   use ehlwave_mlmi_level, only: half_below, mlmi_level_t
   use ehlwave_mlmi_rows, only: add_centre, add_pairs, add_products
   implicit none (type, external)
   private
   public :: anterpolate, interpolate_and_correct, sum_directly

contains

   !> Pressure of the next level, by the adjoint of interpolation along the coarsened direction:
   !>
   !>     P'(I) = P(2I) + sum over s = 1, 3, ..., order - 1 of w(s) (P(2I + s) + P(2I - s))
   pure subroutine anterpolate(fine, coarse)
      type(mlmi_level_t), intent(in) :: fine
      type(mlmi_level_t), intent(inout) :: coarse
      integer :: a, first, j, last

      first = coarse%first(1)
      last = coarse%last(1)
      do j = coarse%first(2), coarse%last(2)
         associate (row => coarse%row)
            if (fine%direction == along_x) then
               row(:) = fine%even(first:last, j)
               do a = 1, fine%order/2
                  row(:) = row + fine%weight(a)*(fine%odd(first + a - 1:last + a - 1, j) &
                                                 + fine%odd(first - a:last - a, j))
               end do
            else
               row(:) = fine%p(first:last, 2*j)
               do a = 1, fine%order/2
                  row(:) = row + fine%weight(a)*(fine%p(first:last, 2*j + 2*a - 1) + fine%p(first:last, 2*j - 2*a + 1))
               end do
            end if
         end associate
         call coarse%put_row(j, first, coarse%row)
      end do
      call coarse%mirror_pressure()
   end subroutine anterpolate

   !> Result u from the result of the next level, u'; along the coarsened direction, with the sums over d and e,
   !>
   !>     u'(I)    := u'(I) + sum over odd d of C(d, e) P(2I + d, e)
   !>     u(2I)     = u'(I)
   !>     u(2I + 1) = sum over s of w(s) (u'(I + (1 + s)/2) + u'(I + (1 - s)/2))
   !>                 + sum over all d of C(d, e) P(2I + 1 + d, e)
   pure subroutine interpolate_and_correct(fine, coarse, first, u)
      type(mlmi_level_t), intent(inout) :: fine, coarse
      integer, intent(in) :: first(2)                       !! fine%first
      real(dp), intent(inout) :: u(first(1):, first(2):)    !! (first(1):last(1), first(2):last(2)) of the fine level
      integer :: j

      if (fine%direction == along_x) then
         do j = fine%first(2), fine%last(2)
            call correct_along_x(fine, coarse, j)
            call interpolate_along_x(fine, u(:, j))
         end do
      else
         do j = coarse%first(2), coarse%last(2)
            call correct_along_y(fine, 2*j, coarse%u(:, j))
         end do
         call coarse%mirror_result()
         do j = fine%first(2), fine%last(2)
            call interpolate_along_y(fine, coarse, j, u(:, j))
            if (modulo(j, 2) == 1) call correct_along_y(fine, j, u(:, j))
         end do
      end if
   end subroutine interpolate_and_correct

   !> Corrected coarse values of row j into y_even, the corrections of the nodes between them into y_odd.
   pure subroutine correct_along_x(fine, coarse, j)
      type(mlmi_level_t), intent(inout) :: fine
      type(mlmi_level_t), intent(in) :: coarse
      integer, intent(in) :: j
      integer :: e, first, g, n, pairs, w

      g = fine%ghost_x
      first = lbound(fine%y_even, 1)
      n = size(fine%y_even)
      fine%y_even(:) = coarse%u(:, j)
      fine%y_odd(:) = 0
      do e = 0, fine%correction%reach_y
         w = fine%correction%width(e)
         if (w < 0) cycle
         call fold(fine%even, j, e, fine%fold)
         call fold(fine%odd, j, e, fine%fold_odd)
         pairs = (w + 1)/2
         call add_pairs(n, pairs, g, 0, -1, fine%c_odd(:, e), fine%fold_odd, fine%y_even)
         call add_pairs(n, pairs, g, 1, 0, fine%c_odd(:, e), fine%fold, fine%y_odd)
         call add_centre(n, fine%c_even(0, e), fine%fold_odd(first), fine%y_odd)
         call add_pairs(n, w/2, g, 1, -1, fine%c_even(1, e), fine%fold_odd, fine%y_odd)
      end do
   end subroutine correct_along_x

   pure subroutine interpolate_along_x(fine, u)
      type(mlmi_level_t), intent(inout) :: fine
      real(dp), intent(inout) :: u(fine%first(1):)
      integer :: a, first, i, last

      first = half_below(fine%first(1))
      last = half_below(fine%last(1) - 1)
      do a = 1, fine%order/2
         do i = first, last
            fine%y_odd(i) = fine%y_odd(i) + fine%weight(a)*(fine%y_even(i + a) + fine%y_even(i + 1 - a))
         end do
      end do
      do i = first, last
         u(2*i + 1) = fine%y_odd(i)
      end do
      do i = half_below(fine%first(1) + 1), half_below(fine%last(1))
         u(2*i) = fine%y_even(i)
      end do
   end subroutine interpolate_along_x

   !> Add the corrections of fine row j: from odd rows when it is even, from all rows when it is odd.
   pure subroutine correct_along_y(fine, j, u)
      type(mlmi_level_t), intent(inout) :: fine
      integer, intent(in) :: j
      real(dp), intent(inout) :: u(fine%first(1):)
      integer :: e, n, odd, w

      n = size(u)
      odd = modulo(j, 2)
      do e = 1 - odd, fine%correction%reach_y, 2 - odd
         w = fine%correction%width(e)
         if (w < 0) cycle
         call fold(fine%p, j, e, fine%fold)
         call add_centre(n, fine%correction%c(0, e), fine%fold(fine%first(1)), u)
         if (w > 0) call add_pairs(n, w, fine%ghost_x, 1, -1, fine%correction%c(1, e), fine%fold, u)
      end do
   end subroutine correct_along_y

   pure subroutine interpolate_along_y(fine, coarse, j, u)
      type(mlmi_level_t), intent(in) :: fine, coarse
      integer, intent(in) :: j
      real(dp), intent(inout) :: u(fine%first(1):)
      integer :: a, i, k

      k = half_below(j)
      if (modulo(j, 2) == 0) then
         u(:) = coarse%u(:, k)
         return
      end if
      u(:) = 0
      do a = 1, fine%order/2
         do i = fine%first(1), fine%last(1)
            u(i) = u(i) + fine%weight(a)*(coarse%u(i, k + a) + coarse%u(i, k + 1 - a))
         end do
      end do
   end subroutine interpolate_along_y

   !> Result of the coarsest level: u(i, j) = sum over k and l of K(i - k, j - l) P(k, l).
   pure subroutine sum_directly(level, first, u)
      type(mlmi_level_t), intent(inout) :: level
      integer, intent(in) :: first(2)                       !! level%first
      real(dp), intent(inout) :: u(first(1):, first(2):)    !! (first(1):last(1), first(2):last(2))
      integer :: e, j, lowest, n

      n = size(u, 1)
      lowest = merge(-level%last(2), level%first(2), level%is_half)
      do j = level%first(2), level%last(2)
         u(:, j) = 0
         do e = 0, max(level%last(2) - j, j - lowest)
            call fold(level%p, j, e, level%fold)
            call add_products(n, level%influence(:, e), level%fold, u(:, j))
         end do
      end do
   end subroutine sum_directly

   !> Sum of the rows at a distance e above and below row j.
   pure subroutine fold(p, j, e, rows)
      real(dp), allocatable, intent(in) :: p(:, :)
      integer, intent(in) :: j, e
      real(dp), intent(inout) :: rows(:)
      rows = p(:, j - e)
      if (e > 0) rows = rows + p(:, j + e)
   end subroutine fold

end module ehlwave_mlmi_transfer
