!> LU factors of a full matrix, with row exchanges.
module ehlwave_dense_lu
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: solve_dense

   integer, parameter :: block = 48   !! columns that are eliminated together

contains

   !> Solve A x = b in place. The matrix is overwritten by its factors. Rows are scaled by their largest entry first.
   subroutine solve_dense(a, x, is_singular)
      real(dp), intent(inout), contiguous :: a(:, :)   !! (n, n)
      real(dp), intent(inout), contiguous :: x(:)      !! (n) right side, then solution
      logical, intent(out) :: is_singular              !! the solution is of no use then
      integer :: first, i, last, n
      real(dp) :: scale

      n = size(x)
      is_singular = .true.
      do i = 1, n
         scale = maxval(abs(a(i, :)))
         if (.not. (scale > 0 .and. scale <= huge(scale))) return
         a(i, :) = a(i, :)/scale
         x(i) = x(i)/scale
      end do
      do first = 1, n, block
         last = min(first + block - 1, n)
         call factorise_columns(a, x, first, last, is_singular)
         if (is_singular) return
         if (last == n) exit
         do i = first + 1, last
            a(i, last + 1:) = a(i, last + 1:) - matmul(a(i, first:i - 1), a(first:i - 1, last + 1:))
         end do
         a(last + 1:, last + 1:) = a(last + 1:, last + 1:) - matmul(a(last + 1:, first:last), a(first:last, last + 1:))
      end do
      do i = 1, n - 1
         x(i + 1:) = x(i + 1:) - x(i)*a(i + 1:, i)
      end do
      do i = n, 1, -1
         x(i) = x(i)/a(i, i)
         x(:i - 1) = x(:i - 1) - x(i)*a(:i - 1, i)
      end do
   end subroutine solve_dense

   !> Eliminate the columns of a block in the rows from its first on; exchanged rows are exchanged in all columns.
   subroutine factorise_columns(a, x, first, last, is_singular)
      real(dp), intent(inout), contiguous :: a(:, :), x(:)
      integer, intent(in) :: first, last
      logical, intent(out) :: is_singular
      real(dp) :: row(size(x)), value
      integer :: j, k, pivot

      is_singular = .true.
      do k = first, last
         pivot = k - 1 + maxloc(abs(a(k:, k)), 1)
         if (.not. abs(a(pivot, k)) > 0) return
         if (pivot /= k) then
            row = a(k, :)
            a(k, :) = a(pivot, :)
            a(pivot, :) = row
            value = x(k)
            x(k) = x(pivot)
            x(pivot) = value
         end if
         a(k + 1:, k) = a(k + 1:, k)/a(k, k)
         do j = k + 1, last
            a(k + 1:, j) = a(k + 1:, j) - a(k, j)*a(k + 1:, k)
         end do
      end do
      is_singular = .false.
   end subroutine factorise_columns

end module ehlwave_dense_lu
