!> Sums along one row of nodes: the inner loops of multilevel multi-integration.
module ehlwave_mlmi_rows
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: add_centre, add_pairs, add_products

contains

   !> y(i) = y(i) + c s(i).
   pure subroutine add_centre(n, c, s, y)
      integer, intent(in) :: n
      real(dp), intent(in) :: c, s(n)
      real(dp), intent(inout) :: y(n)
      integer :: i
      do i = 1, n
         y(i) = y(i) + c*s(i)
      end do
   end subroutine add_centre

   !> y(i) = y(i) + sum over k = 0..pairs-1 of c(k) (s(i + right + k) + s(i + left - k)), i = 1..n.
   !>
   !> `s` starts `ghost` values before the place of y(1). Four pairs a pass, so that y is seldom read.
   pure subroutine add_pairs(n, pairs, ghost, right, left, c, s, y)
      integer, intent(in) :: n, pairs, ghost, right, left
      real(dp), intent(in) :: c(0:pairs - 1)
      real(dp), intent(in) :: s(1 - ghost:n + ghost)
      real(dp), intent(inout) :: y(n)
      integer :: i, k, l, r

      do k = 0, pairs - 4, 4
         r = right + k
         l = left - k
         do i = 1, n
            y(i) = y(i) + c(k)*(s(i + r) + s(i + l)) + c(k + 1)*(s(i + r + 1) + s(i + l - 1)) &
                   + c(k + 2)*(s(i + r + 2) + s(i + l - 2)) + c(k + 3)*(s(i + r + 3) + s(i + l - 3))
         end do
      end do
      k = pairs - modulo(pairs, 4)
      r = right + k
      l = left - k
      select case (pairs - k)
      case (1)
         do i = 1, n
            y(i) = y(i) + c(k)*(s(i + r) + s(i + l))
         end do
      case (2)
         do i = 1, n
            y(i) = y(i) + c(k)*(s(i + r) + s(i + l)) + c(k + 1)*(s(i + r + 1) + s(i + l - 1))
         end do
      case (3)
         do i = 1, n
            y(i) = y(i) + c(k)*(s(i + r) + s(i + l)) + c(k + 1)*(s(i + r + 1) + s(i + l - 1)) &
                   + c(k + 2)*(s(i + r + 2) + s(i + l - 2))
         end do
      end select
   end subroutine add_pairs

   !> y(i) = y(i) + sum over k of c(i - k) s(k), i and k = 1..n.
   pure subroutine add_products(n, c, s, y)
      integer, intent(in) :: n
      real(dp), intent(in) :: c(1 - n:n - 1), s(n)
      real(dp), intent(inout) :: y(n)
      integer :: i, k
      do k = 1, n - 3, 4
         do i = 1, n
            y(i) = y(i) + s(k)*c(i - k) + s(k + 1)*c(i - k - 1) + s(k + 2)*c(i - k - 2) + s(k + 3)*c(i - k - 3)
         end do
      end do
      do k = n - modulo(n, 4) + 1, n
         do i = 1, n
            y(i) = y(i) + s(k)*c(i - k)
         end do
      end do
   end subroutine add_products

end module ehlwave_mlmi_rows
