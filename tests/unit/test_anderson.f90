!> Acceleration of fixed points.
program test_anderson
   use ehlwave_anderson, only: anderson_t
   use ehlwave_kinds, only: dp
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_linear()
   call check_weights()
   call test%finish()

contains

   !> x = c - a x converges slowly or not at all by itself; with as many differences as there are values of a, at once.
   subroutine check_linear()
      type(anderson_t) :: anderson
      real(dp), parameter :: a(2, 3) = reshape([0.9_dp, -0.8_dp, 1.2_dp, 0.9_dp, -0.8_dp, 1.2_dp], [2, 3])
      real(dp) :: g(2, 3), x(2, 3)
      integer :: step

      x = 0
      do step = 1, 6
         g = 1 - a*x
         call anderson%mix(2, 3, [1.0_dp, 2.0_dp, 0.5_dp], x, g)
         x = g
      end do
      call test%check_close(reshape(x, [6]), reshape(1/(1 + a), [6]), 'a fixed point', relative=1e-4_dp)
   end subroutine check_linear

   !> A place without weight, which goes on flickering, does not keep the others from settling.
   subroutine check_weights()
      type(anderson_t) :: anderson
      real(dp) :: g(1, 2), x(1, 2)
      integer :: step

      x = 0
      do step = 1, 6
         g(1, 1) = 2 - 0.9_dp*x(1, 1)
         g(1, 2) = (-1)**step
         call anderson%mix(1, 2, [1.0_dp, 0.0_dp], x, g)
         x = g
      end do
      call test%check_close(x(1, 1), 2/1.9_dp, 'the other place', relative=1e-5_dp)
   end subroutine check_weights

end program test_anderson
