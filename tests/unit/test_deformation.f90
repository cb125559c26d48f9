!> Kernel and FFT convolution: Hertz contact, direct summation, half against whole domain.
program test_deformation
   use ehlwave_conditions, only: conditions_t
   use ehlwave_deformation_fft, only: deformation_fft_t
   use ehlwave_deformation_line, only: deformation_line_t
   use ehlwave_elliptic_integrals, only: ellipticity_integrals, ellipticity_integrals_t
   use ehlwave_grid, only: grid_t, new_grid, new_line_grid
   use ehlwave_kernel, only: cell_influence, kernel_t, line_reference, line_wave_influence, new_kernel
   use ehlwave_kinds, only: dp, pi
   use ehlwave_text, only: to_text
   use sample_contact, only: make_conditions, noise
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_kernel()
   call check_hertz(1.0_dp)
   call check_hertz(0.12_dp)
   call check_line_kernel()
   call check_line_waves()
   call check_line_hertz()
   call compare_line_with_sum()
   call compare_with_sum(20, 14, 1.0_dp)
   call compare_with_sum(22, 26, 0.3_dp)
   call compare_with_sum(17, 13, 0.126_dp)
   call compare_half(48, 36, 0.25_dp)
   call compare_half(34, 22, 1.0_dp)
   call check_order(1.0_dp)
   call check_order(0.3_dp)
   call compare_with_sum(20, 14, 0.3_dp, is_curved=.true.)
   call test%finish()

contains

   !> Far away a cell is a point load; a square is four quarters.
   subroutine check_kernel()
      type(ellipticity_integrals_t) :: s
      s = ellipticity_integrals(0.4_dp)
      call test%check_close(cell_influence(30.0_dp, 40.0_dp, 0.1_dp, 0.2_dp, s%kappa, s%k), &
                            0.02_dp/(pi*s%k*sqrt((0.4_dp*30)**2 + 40.0_dp**2)), 'point load', relative=1e-5_dp)
      call test%check_close(cell_influence(0.0_dp, 0.0_dp, 0.2_dp, 0.2_dp, 1.0_dp, pi/2), &
                            4*0.2_dp*log(1 + sqrt(2.0_dp))/(pi*pi/2), 'under a square', relative=1e-14_dp)
      call test%check_close(cell_influence(0.05_dp, 0.1_dp, 0.2_dp, 0.4_dp, s%kappa, s%k), &
                            sum([cell_influence(0.0_dp, 0.0_dp, 0.1_dp, 0.2_dp, s%kappa, s%k), &
                                 cell_influence(0.1_dp, 0.0_dp, 0.1_dp, 0.2_dp, s%kappa, s%k), &
                                 cell_influence(0.0_dp, 0.2_dp, 0.1_dp, 0.2_dp, s%kappa, s%k), &
                                 cell_influence(0.1_dp, 0.2_dp, 0.1_dp, 0.2_dp, s%kappa, s%k)]), 'four quarters', &
                            relative=1e-13_dp)
   end subroutine check_kernel

   !> Hertz pressure flattens the contact: Dbar(0,0) - Dbar = S X^2 + (1-S) Y^2 inside.
   subroutine check_hertz(d)
      real(dp), intent(in) :: d
      type(conditions_t) :: conditions
      type(deformation_fft_t) :: deformation
      type(grid_t) :: grid
      real(dp), allocatable :: p(:, :), v(:, :)
      real(dp) :: error(3), order
      integer :: i, j, n

      conditions = make_conditions(100.0_dp, d)
      do n = 1, 3
         grid = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 32*2**n, 32*2**n, .true.)
         call deformation%init(grid, conditions%elliptic%kappa, conditions%elliptic%k)
         if (allocated(p)) deallocate (p, v)
         allocate (p(0:grid%nx, 0:grid%ny), v(0:grid%nx, 0:grid%ny))
         do j = 0, grid%ny
            p(:, j) = sqrt(max(0.0_dp, 1 - grid%x**2 - grid%y(j)**2))
         end do
         call deformation%apply(p, v)
         v = grid%value_at_centre(v) - v
         error(n) = 0
         do j = 0, grid%ny
            do i = 0, grid%nx
               if (grid%x(i)**2 + grid%y(j)**2 < 0.81_dp) error(n) = max(error(n), &
                  abs(v(i, j) - conditions%s*grid%x(i)**2 - (1 - conditions%s)*grid%y(j)**2))
            end do
         end do
      end do
      order = log(error(1)/error(3))/log(4.0_dp)
      print '(a)', 'measured: Hertz, D = '//to_text(d, 3)//': error '//to_text(error(3), 3)//', order '//to_text(order, 3)
      call test%check(error(3) < 5e-4_dp, 'Hertz deformation at 256 cells')
      call test%check(order > 1.4_dp, 'order of the Hertz deformation')   ! the pressure is not smooth at the edge
   end subroutine check_hertz

   !> Far away a cell of a line is a line load; two halves make a cell; a cell under itself.
   subroutine check_line_kernel()
      call test%check_close(line_influence(2.0_dp, 0.01_dp), 0.02_dp/pi*log(line_reference/2), 'line load', relative=1e-5_dp)
      call test%check_close(line_influence(0.0_dp, 0.2_dp), 0.4_dp/pi*(1 + log(line_reference/0.1_dp)), 'under a strip', &
                            relative=1e-14_dp)
      call test%check_close(line_influence(0.35_dp, 0.2_dp), line_influence(0.3_dp, 0.1_dp) + line_influence(0.4_dp, 0.1_dp), &
                            'two halves', relative=1e-13_dp)
      call test%check_close(line_influence(-0.35_dp, 0.2_dp), line_influence(0.35_dp, 0.2_dp), 'even', relative=1e-14_dp)
   end subroutine check_line_kernel

   real(dp) function line_influence(dx, hx)
      real(dp), intent(in) :: dx, hx
      line_influence = cell_influence(dx, 0.0_dp, hx, 1.0_dp, 0.0_dp, 1.0_dp)
   end function line_influence

   !> Waves along a line: integrals of K0 (Abramowitz and Stegun, table 11.1), the sum over X, the logarithm of long waves; and a
   !> line that goes back to pressures without waves.
   subroutine check_line_waves()
      type(deformation_line_t) :: deformation
      type(grid_t) :: grid
      real(dp) :: after(0:64, 0:0), before(0:64, 0:0), along(0:64, 0:0), p(0:64, 0:0)
      real(dp), parameter :: k = 1.7_dp, hx = 0.25_dp
      integer :: i

      call test%check_close(line_wave_influence(0.0_dp, 2.0_dp, 1.0_dp), 4/pi*1.2425098486237771_dp, 'K0 from 0 to 1', &
                            relative=1e-14_dp)
      call test%check_close(line_wave_influence(0.55_dp, 0.9_dp, 1.0_dp), &
                            2/pi*(1.2425098486237771_dp - 0.3421644437579744_dp), 'K0 from 0.1 to 1', relative=1e-13_dp)
      call test%check_close(sum([(line_wave_influence(i*hx, hx, k), i=-200, 200)]), 2/k, 'all X: 2/k', relative=1e-13_dp)
      call test%check_close(line_wave_influence(0.5_dp, hx, 1e-4_dp) - line_wave_influence(1.5_dp, hx, 1e-4_dp), &
                            line_influence(0.5_dp, hx) - line_influence(1.5_dp, hx), 'long waves', relative=1e-7_dp)
      grid = new_line_grid(-2.5_dp, 1.5_dp, 64)
      p = 0
      p(20:40, 0) = 1
      call deformation%init(grid, 0.0_dp, 1.0_dp)
      call deformation%apply(p, before)
      call deformation%vary_along(k)
      call deformation%apply(p, along)
      call deformation%vary_along(0.0_dp)
      call deformation%apply(p, after)
      call test%check_close(along(30, 0), sum([(line_wave_influence((30 - i)*grid%hx, grid%hx, k), i=20, 40)]), &
                            'convolution', relative=1e-12_dp)
      call test%check_close(after(:, 0), before(:, 0), 'without waves as before', absolute=0.0_dp)
   end subroutine check_line_waves

   !> Dry line contact: Dbar = ln 2 + 1/2 + ln(line_reference) - X^2 inside, and the load of the Hertz pressure.
   subroutine check_line_hertz()
      type(deformation_line_t) :: deformation
      type(grid_t) :: grid
      real(dp), allocatable :: p(:, :), v(:, :)
      real(dp) :: error(3), order
      integer :: n

      do n = 1, 3
         grid = new_line_grid(-2.5_dp, 1.5_dp, 128*4**n)
         call deformation%init(grid, 0.0_dp, 1.0_dp)
         if (allocated(p)) deallocate (p, v)
         allocate (p(0:grid%nx, 0:grid%ny), v(0:grid%nx, 0:grid%ny), source=0.0_dp)
         p(:, 0) = sqrt(max(0.0_dp, 1 - grid%x**2))
         call deformation%apply(p, v)
         error(n) = maxval(abs(v(:, 0) + grid%x**2 - 0.5_dp - log(2*line_reference)), mask=abs(grid%x) < 0.9_dp)
      end do
      order = log(error(1)/error(3))/log(16.0_dp)
      print '(a)', 'measured: Hertz, line: error '//to_text(error(3), 3)//', order '//to_text(order, 3)
      call test%check(error(3) < 2e-5_dp, 'Hertz deformation of a line at 8192 cells')
      call test%check(order > 1.4_dp, 'order of the Hertz deformation of a line')   ! not smooth at the edge
      call test%check_close(grid%integral(p), 2*pi/3, 'load of a line on its strip', relative=1e-5_dp)
      call test%check_close(grid%value_at_centre(v), 0.5_dp + log(2*line_reference), 'value at the centre', relative=1e-5_dp)
   end subroutine check_line_hertz

   subroutine compare_line_with_sum()
      type(deformation_line_t) :: deformation
      type(grid_t) :: grid
      real(dp), allocatable :: direct(:), p(:, :), v(:, :)
      integer :: i, ii

      grid = new_line_grid(-2.5_dp, 1.5_dp, 46)
      call deformation%init(grid, 0.0_dp, 1.0_dp)
      allocate (p(0:46, 0:0), v(0:46, 0:0), direct(0:46), source=0.0_dp)
      do i = 1, 45
         p(i, 0) = noise(i, 3)
      end do
      call deformation%apply(p, v)
      do i = 0, 46
         do ii = 0, 46
            direct(i) = direct(i) + p(ii, 0)*line_influence(grid%x(i) - grid%x(ii), grid%hx)
         end do
      end do
      call test%check_close(v(:, 0), direct, 'FFT of a line against summation', absolute=1e-13_dp*maxval(abs(direct)))
   end subroutine compare_line_with_sum

   subroutine compare_with_sum(cells_x, cells_y, kappa, is_curved)
      integer, intent(in) :: cells_x, cells_y
      real(dp), intent(in) :: kappa
      logical, intent(in), optional :: is_curved            !! pressure of a cell; absent: false
      type(deformation_fft_t) :: deformation
      type(ellipticity_integrals_t) :: s
      type(grid_t) :: grid
      type(kernel_t) :: kernel
      real(dp), allocatable :: direct(:, :), p(:, :), v(:, :)
      integer :: i, ii, j, jj

      s = ellipticity_integrals(kappa)
      grid = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells_x, cells_y, .false.)
      if (present(is_curved)) grid%has_curved_pressure = is_curved
      kernel = new_kernel(grid, s%kappa, s%k)
      call deformation%init(grid, s%kappa, s%k)
      allocate (p(0:grid%nx, 0:grid%ny), v(0:grid%nx, 0:grid%ny), direct(0:grid%nx, 0:grid%ny), source=0.0_dp)
      do j = 1, grid%ny - 1
         do i = 1, grid%nx - 1
            p(i, j) = noise(i, j)
         end do
      end do
      call deformation%apply(p, v)
      do j = 0, grid%ny
         do i = 0, grid%nx
            do jj = 0, grid%ny
               do ii = 0, grid%nx
                  direct(i, j) = direct(i, j) + p(ii, jj)*kernel%at(i - ii, j - jj)
               end do
            end do
         end do
      end do
      call test%check_close(reshape(v, [size(v)]), reshape(direct, [size(v)]), 'FFT against summation', &
                            absolute=1e-13_dp*maxval(abs(direct)))
      call deformation%apply_single(p, v)
      call test%check_close(reshape(v, [size(v)]), reshape(direct, [size(v)]), 'FFT in single precision against summation', &
                            absolute=1e-6_dp*maxval(abs(direct)))
      call test%check(any(abs(v - direct) > 1e-10_dp*maxval(abs(direct))), 'it is of single precision')
   end subroutine compare_with_sum

   !> A pressure exp(-(kappa X/w)^2 - (Y/w)^2) deforms its centre by pi^(1/2) w/(K kappa): exact integral in polar
   !> coordinates. Errors are of third order with the fitted scheme, by the cell of the
   !> singularity, of second order without.
   subroutine check_order(kappa)
      real(dp), intent(in) :: kappa
      real(dp), parameter :: width = 0.25_dp
      type(deformation_fft_t) :: deformation
      type(ellipticity_integrals_t) :: s
      type(grid_t) :: grid
      real(dp), allocatable :: p(:, :), v(:, :)
      real(dp) :: error(2, 2), order(2)
      integer :: j, n, scheme

      s = ellipticity_integrals(kappa)
      do scheme = 1, 2
         do n = 1, 2
            grid = new_grid(-6.0_dp, 6.0_dp, 2.0_dp, 64*2**n, 32*2**n, .true.)
            grid%has_curved_pressure = scheme == 2
            call deformation%init(grid, s%kappa, s%k)
            if (allocated(p)) deallocate (p, v)
            allocate (p(0:grid%nx, 0:grid%ny), v(0:grid%nx, 0:grid%ny))
            do j = 0, grid%ny
               p(:, j) = exp(-(s%kappa*grid%x/width)**2 - (grid%y(j)/width)**2)
            end do
            call deformation%apply(p, v)
            error(n, scheme) = abs(v(grid%nx/2, 0) - sqrt(pi)*width/(s%k*s%kappa))
         end do
      end do
      order = log(error(1, :)/error(2, :))/log(2.0_dp)
      print '(a, 2f6.3)', 'measured: order of the deformation by a smooth pressure, averaged and fitted ', order
      call test%check_close(order, [2.0_dp, 3.0_dp], 'order of the deformation', absolute=0.3_dp)
   end subroutine check_order

   subroutine compare_half(cells_x, cells_y, kappa)
      integer, intent(in) :: cells_x, cells_y
      real(dp), intent(in) :: kappa
      type(deformation_fft_t) :: on_half, on_whole
      type(ellipticity_integrals_t) :: s
      type(grid_t) :: half, whole
      real(dp), allocatable :: p(:, :), v(:, :), w(:, :)
      integer :: i, j, n

      s = ellipticity_integrals(kappa)
      half = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells_x, cells_y, .true.)
      whole = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells_x, cells_y, .false.)
      call on_half%init(half, s%kappa, s%k)
      call on_whole%init(whole, s%kappa, s%k)
      n = half%ny
      allocate (p(0:whole%nx, 0:whole%ny), v(0:half%nx, 0:half%ny), w(0:whole%nx, 0:whole%ny), source=0.0_dp)
      do j = 0, whole%ny                   ! at the edges, too, as where they are flooded
         do i = 0, whole%nx
            p(i, j) = noise(i, abs(j - n))
         end do
      end do
      call on_whole%apply(p, w)
      call on_half%apply(p(:, n:), v)
      call test%check_close(reshape(v, [size(v)]), reshape(w(:, n:), [size(v)]), 'half against whole', &
                            absolute=1e-13_dp*maxval(abs(w)))
   end subroutine compare_half

end program test_deformation
