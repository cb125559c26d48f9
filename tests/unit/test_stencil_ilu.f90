!> ILU(0): exact where elimination fills nothing in, and the product of its factors on the pattern.
program test_stencil_ilu
   use ehlwave_kinds, only: dp, sp
   use ehlwave_stencil_ilu, only: new_stencil_ilu, stencil_ilu_t
   use sample_contact, only: noise
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: rounding = 10*epsilon(1.0_sp)   ! the factors are kept in single precision
   type(test_t) :: test

   call check_exact(20, 1, [-1, 0, 1], [0, 0, 0], 'tridiagonal, fast index')
   call check_exact(1, 20, [0, 0, 0], [-1, 0, 1], 'tridiagonal, slow index')
   call check_exact(20, 1, [-2, -1, 0, 1, 2], [0, 0, 0, 0, 0], 'five diagonals')
   call check_exact(20, 1, [1, 0, -2, -1], [0, 0, 0, 0], 'offsets out of order')
   call check_exact(3, 8, [-2, -1, 0, 1, 2, -2, -1, 0, 1, 2, -2, -1, 0, 1, 2], &
                    [-1, -1, -1, -1, -1, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1], 'block tridiagonal with full blocks')
   call check_incomplete()
   call check_small_pivot()
   call test%finish()

contains

   !> Nonsymmetric rows with a dominant diagonal; entries that leave the rectangle are zero.
   subroutine fill_matrix(ilu, offset_fast, offset_slow)
      type(stencil_ilu_t), intent(inout) :: ilu
      integer, intent(in) :: offset_fast(:), offset_slow(:)
      integer :: e, f, n, s
      do s = 1, ilu%slow
         do f = 1, ilu%fast
            do n = 1, ilu%entries
               e = ilu%order(n)
               ilu%a(n, f, s) = real(noise(f + 7*e, s + 3*e), sp)
               if (offset_fast(e) == 0 .and. offset_slow(e) == 0) ilu%a(n, f, s) = real(2 + ilu%entries, sp)
               if (f + offset_fast(e) < 1 .or. f + offset_fast(e) > ilu%fast .or. &
                   s + offset_slow(e) < 1 .or. s + offset_slow(e) > ilu%slow) ilu%a(n, f, s) = 0
            end do
         end do
      end do
   end subroutine fill_matrix

   pure function stencil_product(a, order, offset_fast, offset_slow, x) result(y)
      real(sp), intent(in) :: a(:, :, :)
      real(dp), intent(in) :: x(:, :)
      integer, intent(in) :: order(:), offset_fast(:), offset_slow(:)
      real(dp) :: y(size(x, 1), size(x, 2))
      integer :: f, g, n, s, t
      y = 0
      do s = 1, size(x, 2)
         do f = 1, size(x, 1)
            do n = 1, size(order)
               g = f + offset_fast(order(n))
               t = s + offset_slow(order(n))
               if (g < 1 .or. g > size(x, 1) .or. t < 1 .or. t > size(x, 2)) cycle
               y(f, s) = y(f, s) + a(n, f, s)*x(g, t)
            end do
         end do
      end do
   end function stencil_product

   subroutine check_exact(fast, slow, offset_fast, offset_slow, what)
      integer, intent(in) :: fast, slow, offset_fast(:), offset_slow(:)
      character(len=*), intent(in) :: what
      type(stencil_ilu_t) :: ilu
      real(dp) :: v(fast, slow), x(fast, slow)
      integer :: f, s

      ilu = new_stencil_ilu(fast, slow, offset_fast, offset_slow)
      call fill_matrix(ilu, offset_fast, offset_slow)
      do s = 1, slow
         do f = 1, fast
            x(f, s) = noise(3*f, s)
         end do
      end do
      v = stencil_product(ilu%a, ilu%order, offset_fast, offset_slow, x)
      call ilu%factorise()
      call ilu%solve(v)
      call test%check_close(reshape(v, [size(v)]), reshape(x, [size(x)]), what, absolute=rounding)
      v = x                                   ! the work vector of the first solve must leave no trace
      call ilu%solve(v)
      x = 0
      call ilu%solve(x)
      call test%check(all(abs(x) <= 0), what//', second solve')
   end subroutine check_exact

   !> Five-point star: fill is dropped, so the solve is not exact, yet it reduces the error.
   subroutine check_incomplete()
      integer, parameter :: offset_fast(5) = [0, -1, 1, 0, 0], offset_slow(5) = [0, 0, 0, -1, 1]
      type(stencil_ilu_t) :: ilu
      real(dp) :: v(6, 5), x(6, 5)
      integer :: f, s

      ilu = new_stencil_ilu(6, 5, offset_fast, offset_slow)
      call fill_matrix(ilu, offset_fast, offset_slow)
      do s = 1, 5
         do f = 1, 6
            x(f, s) = noise(f, s)
         end do
      end do
      v = stencil_product(ilu%a, ilu%order, offset_fast, offset_slow, x)
      call ilu%factorise()
      call ilu%solve(v)
      call test%check(maxval(abs(v - x)) < 0.05_dp .and. maxval(abs(v - x)) > 1e-8_dp, 'five-point star')
   end subroutine check_incomplete

   !> [1 1; 1 1] has no second pivot: a tenth of the diagonal takes its place.
   subroutine check_small_pivot()
      type(stencil_ilu_t) :: ilu
      real(dp) :: v(2, 1)
      ilu = new_stencil_ilu(2, 1, [-1, 0, 1], [0, 0, 0])
      ilu%a = 1
      ilu%a(1, 1, 1) = 0
      ilu%a(3, 2, 1) = 0
      call ilu%factorise()
      v(:, 1) = [1.0_dp, 1.0_dp]
      call ilu%solve(v)
      call test%check_close(v(:, 1), [1.0_dp, 0.0_dp], 'lost pivot', absolute=rounding)
      v(:, 1) = [0.0_dp, 1.0_dp]
      call ilu%solve(v)
      call test%check_close(v(:, 1), [-10.0_dp, 10.0_dp], 'lost pivot is a tenth of the diagonal', relative=rounding)
   end subroutine check_small_pivot

end program test_stencil_ilu
