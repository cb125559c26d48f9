!> Measured surfaces: interpolation, motion, evenness, refusals.
program test_surface
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp, pi
   use ehlwave_surface, only: new_surface, surface_t
   use ehlwave_waviness, only: surface_waviness, waviness_t
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_nodes_and_parabolas()
   call check_order()
   call check_outside()
   call check_motion()
   call check_evenness()
   call check_numbers()
   call check_refusals()
   call test%finish()

contains

   !> Smooth hump of height 1 and half-width 1 about the origin.
   elemental real(dp) function hump(r)
      real(dp), intent(in) :: r
      hump = 0
      if (abs(r) < 1) hump = cos(0.5_dp*pi*r)**4
   end function hump

   !> Hump of n points over a length of 2.
   subroutine make_trace(n, surface)
      integer, intent(in) :: n
      type(surface_t), intent(out) :: surface
      type(error_t), allocatable :: error
      real(dp) :: height(n, 1)
      integer :: i
      height(:, 1) = [(hump(-1 + 2*real(i, dp)/(n - 1)), i=0, n - 1)]
      call new_surface(height, 2.0_dp/(n - 1), 0.0_dp, 4.0_dp, surface, error)
      call test%check_no_error(error, 'a trace')
   end subroutine make_trace

   !> Heights are met at their nodes; between them a parabola is, in both directions.
   subroutine check_nodes_and_parabolas()
      type(surface_t) :: surface
      type(error_t), allocatable :: error
      real(dp) :: height(21, 15), found(2, 2)
      real(dp), parameter :: x(2) = [-0.83_dp, -0.51_dp], y(2) = [-0.17_dp, 0.09_dp]
      integer :: i, j
      do j = 1, 15
         do i = 1, 21
            height(i, j) = parabola(0.1_dp*(i - 21), 0.1_dp*(j - 8))
         end do
      end do
      height(1, :) = 0
      height(21, :) = 0
      call new_surface(height, 0.1_dp, 0.1_dp, 1.0_dp, surface, error)
      call test%check_no_error(error, 'a map wider than the domain may end as it likes')
      found = surface%height_at(x, y, 0.0_dp)
      do j = 1, 2
         do i = 1, 2
            call test%check_close(found(i, j), parabola(x(i), y(j)), 'a parabola is exact', absolute=1e-13_dp)
         end do
      end do
      found = surface%height_at([-1.0_dp, -0.5_dp], [-0.3_dp, 0.0_dp], 0.0_dp)
      call test%check_close(found(2, 1), height(16, 5), 'a node', absolute=1e-13_dp)
   end subroutine check_nodes_and_parabolas

   pure real(dp) function parabola(x, y)
      real(dp), intent(in) :: x, y
      parabola = 1 + 2*x - y + 3*x**2 - x*y + 2*y**2 + x**2*y**2
   end function parabola

   !> Halving the step divides the error by 8: third order, better than the discretisation.
   subroutine check_order()
      type(surface_t) :: coarse, fine
      real(dp) :: x(400), exact(400), errors(2)
      integer :: i
      x = [(-2 + 0.005_dp*i, i=0, 399)]
      exact = hump(x + 1)
      call make_trace(33, coarse)
      call make_trace(65, fine)
      errors(1) = maxval(abs(reshape(coarse%height_at(x, [0.0_dp], 0.0_dp), [400]) - exact))
      errors(2) = maxval(abs(reshape(fine%height_at(x, [0.0_dp], 0.0_dp), [400]) - exact))
      call test%check(errors(1) > 1e-6_dp .and. errors(1)/errors(2) > 6, 'third order')
   end subroutine check_order

   subroutine check_outside()
      type(surface_t) :: surface
      real(dp) :: height(4, 1)
      call make_trace(33, surface)
      height = surface%height_at([-1e30_dp, -2.2_dp, 0.2_dp, 1e30_dp], [0.0_dp], 0.0_dp)
      call test%check(all(abs(height) <= 0), 'smooth beyond the ends')
   end subroutine check_outside

   !> The leading end starts at Xs and moves with S; a peak takes from the gap.
   subroutine check_motion()
      type(surface_t) :: surface
      type(waviness_t) :: wave
      real(dp) :: shape(3, 2)
      call make_trace(33, surface)
      wave = surface_waviness(surface, -2.5_dp, 1.5_dp)
      call test%check(wave%moves() .and. wave%is_symmetric(), 'a trace moves and is even in Y')
      shape = wave%shape_at([-2.5_dp, 0.0_dp, 1.0_dp], [0.0_dp, 0.7_dp], 0.0_dp)
      call test%check(all(abs(shape) <= 1e-15_dp), 'it starts outside')
      shape = wave%shape_at([-2.5_dp, 0.0_dp, 1.0_dp], [0.0_dp, 0.7_dp], 3.5_dp/1.5_dp)
      call test%check_close(shape(2, :), [-1.0_dp, -1.0_dp], 'its middle is at the centre after (2.5 + 1)/S', absolute=1e-12_dp)
      call test%check(all(abs(shape([1, 3], :)) <= 1e-12_dp), 'and its ends a length of 1 off')
   end subroutine check_motion

   subroutine check_evenness()
      type(surface_t) :: surface
      type(error_t), allocatable :: error
      real(dp) :: height(33, 33)
      integer :: i, j
      do j = 1, 33
         do i = 1, 33
            height(i, j) = hump(real(i - 17, dp)/16)*hump(real(j - 17, dp)/16)
         end do
      end do
      call new_surface(height, 0.1_dp, 0.1_dp, 4.0_dp, surface, error)
      call test%check(surface%is_even(), 'an even map')
      height(10, 10) = height(10, 10)*(1 + 1e-6_dp)
      call new_surface(height, 0.1_dp, 0.1_dp, 4.0_dp, surface, error)
      call test%check(.not. surface%is_even(), 'no longer even')
   end subroutine check_evenness

   !> Rq and average wavelengths of a product of cosines, fine enough to match the continuum.
   subroutine check_numbers()
      type(surface_t) :: surface
      type(error_t), allocatable :: error
      real(dp), allocatable :: height(:, :)
      integer :: i, j
      allocate (height(2001, 801))
      do j = 1, 801
         do i = 1, 2001
            height(i, j) = sin(2*pi*0.01_dp*(i - 1))*sin(2*pi*0.01_dp*(j - 1))
         end do
      end do
      call new_surface(height, 0.002_dp, 0.003_dp, 4.0_dp, surface, error)
      call test%check_no_error(error, 'a product of sines')
      call test%check_close(surface%rq, 0.5_dp, 'Rq', relative=2e-3_dp)
      call test%check_close(surface%wavelength_x, 0.2_dp, 'average wavelength along X', relative=2e-3_dp)
      call test%check_close(surface%wavelength_y, 0.3_dp, 'average wavelength along Y', relative=2e-3_dp)
      call test%check_close(surface%length, 4.0_dp, 'length', relative=1e-14_dp)
   end subroutine check_numbers

   subroutine check_refusals()
      real(dp) :: height(10, 1), map(10, 10)

      height = 0
      call refused(height, 0.0_dp, 4.0_dp, 'all 0')
      height(5, 1) = 1
      height(10, 1) = 0.02_dp
      call refused(height, 0.0_dp, 4.0_dp, 'enter the contact as a step')
      height(10, 1) = 0
      height(4, 1) = ieee_value(1.0_dp, ieee_quiet_nan)
      call refused(height, 0.0_dp, 4.0_dp, 'missing (NaN)')
      call refused(height(:7, :), 0.0_dp, 4.0_dp, 'at least 8')
      map = 0
      map(5, :) = 1
      call refused(map, 0.1_dp, 4.0_dp, 'as a step')
      call refused(map, 0.0_dp, 0.5_dp, 'steps')
   end subroutine check_refusals

   subroutine refused(height, step_y, width, message)
      real(dp), intent(in) :: height(:, :), step_y, width
      character(len=*), intent(in) :: message
      type(surface_t) :: surface
      type(error_t), allocatable :: error
      call new_surface(height, 0.1_dp, step_y, width, surface, error)
      call test%check_error(error, message, message)
   end subroutine refused

end program test_surface
