!> Multilevel multi-integration against the FFT convolution, which is exact to rounding.
program test_mlmi
   use ehlwave_deformation_fft, only: deformation_fft_t
   use ehlwave_deformation_mlmi, only: deformation_mlmi_t
   use ehlwave_elliptic_integrals, only: ellipticity_integrals, ellipticity_integrals_t
   use ehlwave_grid, only: grid_t, new_grid
   use ehlwave_kinds, only: dp, pi
   use ehlwave_mlmi_correction, only: midpoint_weights
   use ehlwave_text, only: to_text
   use sample_contact, only: noise
   use testing, only: is_long, test_t
   implicit none (type, external)

   integer, parameter :: hertz = 1, rough = 2   !! pressures
   type(test_t) :: test

   call check_weights()
   call check_exact(37, 26, 1.0_dp, is_half=.true.)
   call check_exact(21, 53, 0.126_dp, is_half=.false.)
   call check_exact(64, 18, 0.4_dp, is_half=.true.)
   call check_exact(3, 4, 0.7_dp, is_half=.true.)
   call check_direct_sum()
   call check_halves(70, 62, 0.35_dp)
   call check_repeated()
   call check_accuracy(1.0_dp, 1.0_dp)
   if (is_long()) call check_accuracy(0.35_dp, 1.0_dp)
   call check_accuracy(0.126_dp, 1.0_dp)
   call check_accuracy(0.35_dp, 0.35_dp)
   call test%finish()

contains

   !> Interpolation of a given order is exact for polynomials of lower degree.
   subroutine check_weights()
      integer :: degree, order, s
      real(dp), allocatable :: w(:)
      call test%check_close(midpoint_weights(4), [9.0_dp, -1.0_dp]/16, 'cubic midpoint', relative=1e-15_dp)
      do order = 4, 8, 2
         w = midpoint_weights(order)
         do degree = 0, order - 2, 2
            call test%check_close(2*sum(w*[(real(2*s - 1, dp)**degree, s=1, order/2)]), &
                                  merge(1.0_dp, 0.0_dp, degree == 0), &
                                  'order '//to_text(order)//', degree '//to_text(degree), absolute=1e-11_dp)
         end do
      end do
   end subroutine check_weights

   !> With corrections everywhere nothing is neglected: any number of cells, levels and order of transfers.
   subroutine check_exact(cells_x, cells_y, kappa, is_half)
      integer, intent(in) :: cells_x, cells_y
      real(dp), intent(in) :: kappa
      logical, intent(in) :: is_half
      type(deformation_mlmi_t) :: deformation
      type(grid_t) :: grid
      real(dp), allocatable :: exact(:, :), p(:, :), v(:, :)
      integer :: levels, order

      grid = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells_x, cells_y, is_half)
      p = noisy_pressure(grid)
      call by_fft(grid, kappa, p, exact)
      deformation%reach = 1000
      do levels = 2, 6, 2
         do order = 4, 8, 2
            deformation%levels = levels
            deformation%order = order
            call by_mlmi(deformation, grid, kappa, p, v)
            call test%check_close([v], [exact], to_text(levels)//' levels, order '//to_text(order)// &
                                  ', all corrections', absolute=1e-11_dp*maxval(abs(exact)))
         end do
      end do
   end subroutine check_exact

   subroutine check_direct_sum()
      type(deformation_mlmi_t) :: deformation
      type(grid_t) :: grid
      real(dp), allocatable :: exact(:, :), p(:, :), v(:, :)
      integer :: i

      deformation%levels = 1
      do i = 1, 2
         grid = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 23, 20, is_half=i == 1)
         p = noisy_pressure(grid)
         call by_fft(grid, 0.5_dp, p, exact)
         call by_mlmi(deformation, grid, 0.5_dp, p, v)
         call test%check_close([v], [exact], 'direct sum', absolute=1e-13_dp*maxval(abs(exact)))
      end do
   end subroutine check_direct_sum

   !> Even pressure, all corrections: half and whole domain agree.
   subroutine check_halves(cells_x, cells_y, kappa)
      integer, intent(in) :: cells_x, cells_y
      real(dp), intent(in) :: kappa
      type(deformation_mlmi_t) :: deformation
      type(grid_t) :: half, whole
      real(dp), allocatable :: p(:, :), v(:, :), w(:, :)
      integer :: j, n

      half = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells_x, cells_y, .true.)
      whole = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells_x, cells_y, .false.)
      n = half%ny
      allocate (p(0:half%nx, 0:2*n))
      p(:, n:) = noisy_pressure(half)
      do j = 1, n
         p(:, n - j) = p(:, n + j)
      end do
      deformation%levels = 5
      deformation%reach = 1000
      call by_mlmi(deformation, half, kappa, p(:, n:), v)
      call by_mlmi(deformation, whole, kappa, p, w)
      call test%check_close([v], [w(:, n + 1:)], 'half against whole', absolute=1e-11_dp*maxval(abs(w)))
   end subroutine check_halves

   !> No trace of an earlier pressure or grid.
   subroutine check_repeated()
      type(deformation_mlmi_t) :: deformation
      type(grid_t) :: grid, other
      real(dp), allocatable :: a(:, :), b(:, :), c(:, :), d(:, :), p(:, :)

      grid = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 75, 66, .true.)
      p = pressure(grid, hertz)
      call by_mlmi(deformation, grid, 0.6_dp, p, a)
      b = a
      call deformation%apply(noisy_pressure(grid), b)
      call deformation%apply(p, b)
      call test%check_equal(count(abs(a - b) > 0), 0, 'the same after another pressure')
      other = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 40, 40, .false.)
      call by_mlmi(deformation, other, 0.6_dp, noisy_pressure(other), c)
      call by_mlmi(deformation, grid, 0.6_dp, p, d)
      call test%check_equal(count(abs(a - d) > 0), 0, 'the same after another grid')
   end subroutine check_repeated

   !> Defaults: below a tenth of the change from a grid of half as many cells, falling at least as h^2.
   subroutine check_accuracy(kappa, cells_ratio)
      real(dp), intent(in) :: kappa
      real(dp), intent(in) :: cells_ratio   !! cells along X over cells along Y
      type(deformation_mlmi_t) :: deformation
      type(grid_t) :: coarse, grid
      real(dp), allocatable :: exact(:, :), p(:, :), previous(:, :), v(:, :)
      real(dp) :: change, error(3, 2), order
      integer :: cells_x, cells_y, kind, n

      do kind = hertz, rough
         do n = 1, 3
            cells_y = nint(16/sqrt(cells_ratio))*4*2**n   ! 128^2, 256^2, 512^2 cells or as many
            cells_x = nint(16*sqrt(cells_ratio))*4*2**n
            coarse = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells_x/2, cells_y/2, .true.)
            call by_fft(coarse, kappa, pressure(coarse, hertz), previous)
            grid = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells_x, cells_y, .true.)
            call by_fft(grid, kappa, pressure(grid, hertz), exact)
            change = norm2(exact(1::2, 1::2) - previous)/sqrt(real(size(previous), dp))
            p = pressure(grid, kind)
            call by_fft(grid, kappa, p, exact)
            call by_mlmi(deformation, grid, kappa, p, v)
            error(n, kind) = norm2(v - exact)/sqrt(real(size(exact), dp))
         end do
         order = log(error(1, kind)/error(3, kind))/log(4.0_dp)
         print '(a)', 'measured: kappa = '//to_text(kappa, 3)//', cells '//to_text(cells_x)//' x '//to_text(cells_y)// &
            ': rms error '//to_text(error(3, kind), 3)//', Hertz change '//to_text(change, 3)// &
            ', order '//to_text(order, 3)
         call test%check(error(3, kind) < 0.1_dp*change, 'error against discretisation error')
         call test%check(order > 1.9_dp, 'order of the error')
      end do
   end subroutine check_accuracy

   !> Hertz pressure; or with waves of 16 points, an inlet and a spike near the outlet.
   function pressure(grid, kind) result(p)
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: kind
      real(dp), allocatable :: p(:, :)
      real(dp) :: outlet
      integer :: i, j

      allocate (p(0:grid%nx, 0:grid%ny), source=0.0_dp)
      do j = 0, grid%ny - 1
         do i = 1, grid%nx - 1
            p(i, j) = sqrt(max(0.0_dp, 1 - grid%x(i)**2 - grid%y(j)**2))
            if (kind == hertz) cycle
            p(i, j) = p(i, j)*(1 + 0.15_dp*cos(2*pi*i/16))
            outlet = 0.85_dp*sqrt(max(0.0_dp, 1 - grid%y(j)**2))
            p(i, j) = p(i, j) + 0.5_dp*exp(-((grid%x(i) - outlet)/0.04_dp)**2 - 4*grid%y(j)**2)
            if (grid%x(i) < 0) p(i, j) = p(i, j) + 0.1_dp*exp(-8*(grid%x(i)**2 + grid%y(j)**2 - 1)**2)
         end do
      end do
   end function pressure

   function noisy_pressure(grid) result(p)
      type(grid_t), intent(in) :: grid
      real(dp), allocatable :: p(:, :)
      integer :: i, j
      allocate (p(0:grid%nx, 0:grid%ny), source=0.0_dp)
      do j = grid%first_row, grid%ny - 1
         p(1:grid%nx - 1, j) = [(noise(i, j), i=1, grid%nx - 1)]
      end do
   end function noisy_pressure

   subroutine by_fft(grid, kappa, p, d)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa, p(:, :)
      real(dp), allocatable, intent(out) :: d(:, :)   !! lower bounds 1
      type(deformation_fft_t) :: deformation
      type(ellipticity_integrals_t) :: s
      s = ellipticity_integrals(kappa)
      allocate (d(size(p, 1), size(p, 2)))
      call deformation%init(grid, s%kappa, s%k)
      call deformation%apply(p, d)
   end subroutine by_fft

   subroutine by_mlmi(deformation, grid, kappa, p, d)
      type(deformation_mlmi_t), intent(inout) :: deformation
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa, p(:, :)
      real(dp), allocatable, intent(out) :: d(:, :)   !! lower bounds 1
      type(ellipticity_integrals_t) :: s
      s = ellipticity_integrals(kappa)
      allocate (d(size(p, 1), size(p, 2)))
      call deformation%init(grid, s%kappa, s%k)
      call deformation%apply(p, d)
   end subroutine by_mlmi

end program test_mlmi
