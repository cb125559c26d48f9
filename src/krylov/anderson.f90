!> Anderson's acceleration of a fixed point x = g(x): theory section 12.
module ehlwave_anderson
   use ehlwave_kinds, only: dp, sp
   use ehlwave_small_solve, only: solve_small
   implicit none (type, external)
   private

   integer, parameter :: depth = 3                     ! differences that are kept
   real(dp), parameter :: least_pivot = 1e-6_dp        ! least pivot of normal equations whose diagonal is 1
   real(dp), parameter :: largest_weight = 3           ! weight of a difference; beyond, it is not used

   !> The last iterations. Values are (k, places); each place has a weight.
   type, public :: anderson_t
      private
      integer :: kept = 0
      real(sp), allocatable :: by_f(:, :, :), by_g(:, :, :)     ! differences of f = g(x) - x and of g, newest first
      real(sp), allocatable :: f(:, :), g(:, :)                 ! f and g of the last iteration
   contains
      procedure :: mix
   end type anderson_t

contains

   !> Replace g(x) by the combination of the last iterates with the least f.
   pure subroutine mix(self, k, places, weight, x, g)
      class(anderson_t), intent(inout) :: self
      integer, intent(in) :: k, places
      real(dp), intent(in) :: weight(places)
      real(dp), intent(in) :: x(k, places)
      real(dp), intent(inout) :: g(k, places)          !! g(x), then the next x
      real(sp) :: f(k, places), now(k, places)
      real(dp) :: share(depth)
      integer :: m

      f = real(g - x, sp)
      now = real(g, sp)
      if (allocated(self%f)) then
         if (.not. allocated(self%by_f)) allocate (self%by_f(k, places, depth), self%by_g(k, places, depth))
         do m = min(self%kept, depth - 1), 1, -1
            self%by_f(:, :, m + 1) = self%by_f(:, :, m)
            self%by_g(:, :, m + 1) = self%by_g(:, :, m)
         end do
         self%by_f(:, :, 1) = f - self%f
         self%by_g(:, :, 1) = now - self%g
         self%kept = min(self%kept + 1, depth)
         call shares(self, weight, f, share)
         do m = 1, self%kept
            if (abs(share(m)) > 0) g = g - share(m)*self%by_g(:, :, m)
         end do
      end if
      self%f = f
      self%g = now
   end subroutine mix

   !> Weights of the differences that leave the least f; with fewer of them where these contradict each other.
   pure subroutine shares(self, weight, f, share)
      type(anderson_t), intent(in) :: self
      real(dp), intent(in) :: weight(:)
      real(sp), intent(in) :: f(:, :)
      real(dp), intent(out) :: share(depth)
      real(dp) :: matrix(depth, depth), right(depth), unit(depth)
      integer :: m, n, used
      logical :: is_solved

      share = 0
      do m = 1, self%kept
         do n = 1, m
            matrix(m, n) = product_of(weight, self%by_f(:, :, m), self%by_f(:, :, n))
            matrix(n, m) = matrix(m, n)
         end do
         right(m) = product_of(weight, self%by_f(:, :, m), f)
         unit(m) = sqrt(max(matrix(m, m), tiny(share)))
      end do
      do used = self%kept, 1, -1
         associate (u => unit(:used))
            call solve_small(matrix(:used, :used)/spread(u, 1, used)/spread(u, 2, used), right(:used)/u, least_pivot, &
                             share(:used), is_solved)
            share(:used) = share(:used)/u
         end associate
         if (is_solved .and. sum(abs(share(:used))) <= largest_weight) return
         share = 0
      end do
   end subroutine shares

   pure real(dp) function product_of(weight, a, b)
      real(dp), intent(in) :: weight(:)
      real(sp), intent(in), contiguous :: a(:, :), b(:, :)
      real(sp) :: product
      integer :: i, k
      product_of = 0
      do i = 1, size(weight)
         if (.not. weight(i) > 0) cycle
         product = 0
         !$omp simd reduction(+:product)
         do k = 1, size(a, 1)
            product = product + a(k, i)*b(k, i)
         end do
         product_of = product_of + weight(i)*real(product, dp)
      end do
   end function product_of

end module ehlwave_anderson
