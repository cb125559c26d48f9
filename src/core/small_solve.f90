!> Small symmetric positive definite systems.
module ehlwave_small_solve
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: solve_small

contains

   !> Solve matrix x = right by elimination without pivoting. Where a pivot is not above `smallest_pivot` nothing is
   !> solved.
   pure subroutine solve_small(matrix, right, smallest_pivot, x, is_solved)
      real(dp), intent(in) :: matrix(:, :)       !! symmetric, positive definite
      real(dp), intent(in) :: right(:)
      real(dp), intent(in) :: smallest_pivot
      real(dp), intent(out) :: x(:)
      logical, intent(out) :: is_solved
      real(dp) :: factor, left(size(right), size(right))
      integer :: i, j

      left = matrix
      x = right
      is_solved = .false.
      do i = 1, size(x)
         if (.not. left(i, i) > smallest_pivot) return
         do j = i + 1, size(x)
            factor = left(j, i)/left(i, i)
            left(j, :) = left(j, :) - factor*left(i, :)
            x(j) = x(j) - factor*x(i)
         end do
      end do
      do i = size(x), 1, -1
         x(i) = (x(i) - dot_product(left(i, i + 1:), x(i + 1:)))/left(i, i)
      end do
      is_solved = .true.
   end subroutine solve_small

end module ehlwave_small_solve
