!> LU factors of a complex band matrix: the near part of the system of a line contact.
!>
!> Double precision: along one line the flow terms have a condition of the square of the number of cells, and factors in
!> single precision fail from 2048 cells on. Without pivoting, as the incomplete factors of elliptical contacts.
module ehlwave_complex_band
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: new_complex_band

   type, public :: complex_band_t
      integer :: n = 0, reach = 0
      complex(dp), allocatable :: a(:, :)   !! (-reach:reach, n) row i in column i, then its factors (diagonal inverted)
   contains
      procedure :: factorise
      procedure :: solve
   end type complex_band_t

   real(dp), parameter :: smallest_pivot = 0.1_dp   !! of the diagonal entry

contains

   !> Storage for n unknowns, `reach` entries on either side of the diagonal.
   pure function new_complex_band(n, reach) result(self)
      integer, intent(in) :: n, reach
      type(complex_band_t) :: self
      self%n = n
      self%reach = reach
      allocate (self%a(-reach:reach, n), source=(0.0_dp, 0.0_dp))
   end function new_complex_band

   !> Factors in place of the matrix in `a`, whose entries off the n unknowns are zero. A pivot that lost most of its size
   !> against the diagonal that it started from is set to `smallest_pivot` of it: the factors only precondition.
   pure subroutine factorise(self)
      class(complex_band_t), intent(inout) :: self
      complex(dp) :: diagonal
      integer :: i, k, r

      r = self%reach
      associate (a => self%a)
         do i = 1, self%n
            diagonal = a(0, i)
            do k = max(-r, 1 - i), -1
               a(k, i) = a(k, i)*a(0, i + k)
               a(k + 1:k + r, i) = a(k + 1:k + r, i) - a(k, i)*a(1:r, i + k)
            end do
            if (.not. abs(a(0, i)) > smallest_pivot*abs(diagonal)) a(0, i) = smallest_pivot*diagonal
            a(0, i) = 1/a(0, i)
         end do
      end associate
   end subroutine factorise

   !> Solve in place.
   pure subroutine solve(self, x)
      class(complex_band_t), intent(in) :: self
      complex(dp), intent(inout) :: x(:)   !! (n) right side, then solution
      integer :: first, i, last

      do i = 1, self%n
         first = max(1, i - self%reach)
         x(i) = x(i) - sum(self%a(first - i:-1, i)*x(first:i - 1))
      end do
      do i = self%n, 1, -1
         last = min(self%n, i + self%reach)
         x(i) = (x(i) - sum(self%a(1:last - i, i)*x(i + 1:last)))*self%a(0, i)
      end do
   end subroutine solve

end module ehlwave_complex_band
