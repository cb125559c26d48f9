!> Curves through measured points: values, slopes, no turn where the points have none.
program test_monotone_curve
   use ehlwave_kinds, only: dp
   use ehlwave_monotone_curve, only: monotone_curve_t, new_monotone_curve
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_parabola()
   call check_smoothness()
   call check_steps()
   call test%finish()

contains

   !> Parabolas come out as they are, and go on straight beyond the ends.
   subroutine check_parabola()
      real(dp), parameter :: x(5) = [0.0_dp, 0.5_dp, 2.0_dp, 3.0_dp, 3.5_dp]
      type(monotone_curve_t) :: curve
      real(dp) :: slope, y
      integer :: i, piece

      curve = new_monotone_curve(x, x**2 + 4*x)
      piece = 1
      do i = 0, 70
         associate (at => 0.05_dp*i)
            call curve%evaluate(at, piece, y, slope)
            call test%check_close(y, at**2 + 4*at, 'value of a parabola', absolute=1e-13_dp)
            call test%check_close(slope, 2*at + 4, 'slope of a parabola', absolute=1e-12_dp)
         end associate
      end do
      call curve%evaluate(5.5_dp, piece, y, slope)
      call test%check_close([y, slope], [3.5_dp**2 + 4*3.5_dp + 2*11, 11.0_dp], 'beyond the last point', &
                            relative=1e-14_dp)
      call curve%evaluate(-1.0_dp, piece, y, slope)
      call test%check_close([y, slope], [-4.0_dp, 4.0_dp], 'before the first point', relative=1e-14_dp)
      curve = new_monotone_curve([1.0_dp, 2.0_dp], [5.0_dp, 3.0_dp])
      piece = 1
      call curve%evaluate(1.75_dp, piece, y, slope)
      call test%check_close([y, slope], [3.5_dp, -2.0_dp], 'two points: straight', relative=1e-14_dp)
   end subroutine check_parabola

   !> The slope is the derivative of the value, and does not jump at the points or at the ends. The curvature, up to
   !> 2000, does.
   subroutine check_smoothness()
      real(dp), parameter :: x(6) = [0.0_dp, 1.0_dp, 1.2_dp, 4.0_dp, 4.1_dp, 7.0_dp], step = 1e-6_dp
      type(monotone_curve_t) :: curve
      real(dp) :: above, before, below, slope, unused
      integer :: i, piece

      curve = new_monotone_curve(x, [0.0_dp, 0.1_dp, 2.0_dp, 2.1_dp, 9.0_dp, 9.5_dp])
      piece = 1
      do i = -30, 250
         associate (at => 0.0313_dp*i)
            call curve%evaluate(at - step, piece, below, unused)
            call curve%evaluate(at + step, piece, above, unused)
            call curve%evaluate(at, piece, before, slope)
            call test%check_close(slope, (above - below)/(2*step), 'slope', relative=1e-7_dp, absolute=1e-7_dp)
         end associate
      end do
      do i = 1, size(x)
         call curve%evaluate(x(i) - 1e-9_dp, piece, unused, before)
         call curve%evaluate(x(i) + 1e-9_dp, piece, unused, slope)
         call test%check_close(slope, before, 'slope before and after a point', absolute=1e-5_dp)
      end do
   end subroutine check_smoothness

   !> Steps and plateaus: the curve stays between its points and never turns; where points turn it is flat.
   subroutine check_steps()
      real(dp), parameter :: x(7) = [0.0_dp, 1.0_dp, 2.0_dp, 2.1_dp, 3.0_dp, 4.0_dp, 6.0_dp]
      real(dp), parameter :: rising(7) = [0.0_dp, 0.001_dp, 0.002_dp, 5.0_dp, 5.0001_dp, 5.0002_dp, 9.0_dp]
      real(dp), parameter :: signs(2) = [1.0_dp, -1.0_dp]
      type(monotone_curve_t) :: curve
      real(dp) :: least, slope, y
      integer :: i, piece, s

      do s = 1, 2
         curve = new_monotone_curve(x, signs(s)*rising)
         piece = 1
         least = huge(least)
         do i = 0, 6000
            call curve%evaluate(1e-3_dp*i, piece, y, slope)
            least = min(least, signs(s)*slope)
         end do
         call test%check(least > 0, 'rises, or falls, everywhere')
      end do
      curve = new_monotone_curve([0.0_dp, 1.0_dp, 2.0_dp], [0.0_dp, 1.0_dp, 0.5_dp])
      piece = 2
      call curve%evaluate(1.0_dp, piece, y, slope)
      call test%check_close([y, slope], [1.0_dp, 0.0_dp], 'flat at a turn', absolute=1e-14_dp)
   end subroutine check_steps

end program test_monotone_curve
