!> Rises of half-spaces that move under heat: closed forms, published values, and sums over all nodes.
program test_moving_source
   use ehlwave_grid, only: grid_t, new_grid, new_line_grid
   use ehlwave_kinds, only: dp, pi
   use ehlwave_moving_convolution, only: moving_convolution_t, moving_transform_t, new_moving_convolution
   use ehlwave_moving_source, only: source_weights
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_rest()
   call check_fast()
   call check_band()
   call check_square()
   call check_convolution()
   call test%finish()

contains

   !> A square at rest, Carslaw and Jaeger: (4/pi) ln(1 + 2^(1/2)) q b/k at its centre; far away a point source.
   subroutine check_rest()
      integer, parameter :: n = 40
      real(dp), parameter :: h = 1.0_dp/n
      real(dp) :: w(-2*n:2*n, 0:2*n)
      call test%check_close(centre(n, n, 0.0_dp), 4/pi*log(1 + sqrt(2.0_dp)), 'square at rest', relative=1e-4_dp)
      w = source_weights(2*n, 2*n, h, h, 0.0_dp, .false.)
      call test%check_close(w(2*n, 2*n), h**2/(2*pi*sqrt(8.0_dp)), 'point source', relative=1e-4_dp)
      call test%check_close(w(-n, 7), w(n, 7), 'symmetry', relative=1e-10_dp)
   end subroutine check_rest

   !> An even band, half its width as length: (x e^x (K0 + K1) + x e^(-x) (K0 - K1))/(pi Pe) at its centre, x = Pe. The
   !> mesh leaves an error of second order.
   subroutine check_band()
      real(dp), parameter :: peclet(2) = [1.0_dp, 0.1_dp]
      real(dp), parameter :: k0(2) = [0.42102443824070834_dp, 2.4270690247020166_dp], &
         k1(2) = [0.60190723019723457_dp, 9.8538447808706061_dp]
      real(dp) :: error(2), exact
      integer :: i, k, n
      do k = 1, 2
         exact = (exp(peclet(k))*(k0(k) + k1(k)) + exp(-peclet(k))*(k0(k) - k1(k)))/pi
         do i = 1, 2
            n = 40*i
            error(i) = centre(n, 0, peclet(k))/exact - 1
         end do
         call test%check(abs(error(2)) < 1e-4_dp, 'band: within 1e-4')
         call test%check_close(error(1)/error(2), 4.0_dp, 'band: second order', relative=0.05_dp)
      end do
   end subroutine check_band

   !> Largest rise of an even square, 2 q b/(k (pi (1.011 + Pe))^(1/2)) within 4 % (Tian and Kennedy 1994).
   subroutine check_square()
      integer, parameter :: n = 24
      real(dp), parameter :: peclet(5) = [0.0_dp, 0.3_dp, 1.0_dp, 10.0_dp, 100.0_dp], h = 1.0_dp/n
      real(dp) :: largest, w(-2*n:2*n, 0:n)
      integer :: i, k
      do k = 1, size(peclet)
         w = source_weights(2*n, n, h, h, peclet(k), .false.)
         largest = 0
         do i = -n, n
            largest = max(largest, sum(share(w(i - n:i + n, :))))
         end do
         call test%check_close(largest, 2/sqrt(pi*(1.011_dp + peclet(k))), 'square: Tian and Kennedy', relative=0.04_dp)
      end do
   end subroutine check_square

   !> Rise at the centre of an even band or square of 2 n cells along and 2 m across.
   real(dp) function centre(n, m, peclet)
      integer, intent(in) :: n, m
      real(dp), intent(in) :: peclet
      real(dp) :: w(-n:n, 0:m)
      w = source_weights(n, m, 1.0_dp/n, 1.0_dp/n, peclet, m == 0)
      centre = sum(share(w))
   end function centre

   !> Weights of nodes in a band or square that ends at nodes: a half at its ends.
   pure function share(w)
      real(dp), intent(in) :: w(:, 0:)
      real(dp) :: share(size(w, 1), 0:ubound(w, 2))
      share = w
      share(1, :) = 0.5_dp*w(1, :)
      share(size(w, 1), :) = 0.5_dp*w(size(w, 1), :)
      if (ubound(w, 2) == 0) return
      share(:, 1:ubound(w, 2) - 1) = 2*share(:, 1:ubound(w, 2) - 1)
   end function share

   !> The fast limit: (2 pi Pe)^(-1/2) times the weights of 1/X^(1/2).
   subroutine check_fast()
      integer, parameter :: n = 50
      real(dp), parameter :: h = 0.02_dp, peclet = 1e7_dp
      real(dp) :: limit(0:n), w(-n:n, 0:2)
      integer :: m
      limit(0) = 4*sqrt(h)/3
      limit(1:) = [(limit(0)*(sqrt(m + 1.0_dp)**3 - 2*sqrt(real(m, dp))**3 + sqrt(m - 1.0_dp)**3), m=1, n)]
      limit = limit/sqrt(2*pi*peclet)
      w = source_weights(n, 2, h, h, peclet, .false.)
      call test%check_close(w(0:, 0), limit, 'fast limit', absolute=1e-4_dp*limit(0))
      call test%check(maxval(abs(w(:-2, :))) < 1e-12_dp*limit(0), 'nothing upstream')
      call test%check(maxval(abs(w(:, 2))) < 1e-12_dp*limit(0), 'nothing aside')
   end subroutine check_fast

   !> Convolution on whole and half domains and lines: the sum over all nodes.
   subroutine check_convolution()
      type(grid_t) :: grids(3)
      integer :: k
      grids(1) = new_grid(-1.0_dp, 1.5_dp, 1.0_dp, 20, 14, .false.)
      grids(2) = new_grid(-1.0_dp, 1.5_dp, 1.0_dp, 20, 14, .true.)
      grids(3) = new_line_grid(-1.0_dp, 1.5_dp, 24)
      do k = 1, 3
         call compare(grids(k), .true.)
         call compare(grids(k), .false.)
      end do
   end subroutine check_convolution

   subroutine compare(grid, is_whole)
      type(grid_t), intent(in) :: grid
      logical, intent(in) :: is_whole
      type(moving_convolution_t) :: convolution
      type(moving_transform_t) :: transform
      real(dp) :: kernel(-grid%nx:grid%nx, 0:2*grid%ny), row(-grid%nx:grid%nx, 0:0)
      real(dp), dimension(0:grid%nx, 0:grid%ny) :: direct, field, found
      integer :: from, i, j, k, l

      kernel = source_weights(grid%nx, 2*grid%ny, grid%hx, grid%hy, 3.0_dp, grid%is_line)
      row = source_weights(grid%nx, 0, grid%hx, grid%hy, 3.0_dp, .true.)
      convolution = new_moving_convolution(grid, kernel, row(0:, 0))
      do j = 0, grid%ny
         do i = 0, grid%nx
            field(i, j) = merge(1.0_dp, 0.0_dp, i > 0 .and. i < grid%nx .and. (grid%is_line .or. &
               j >= grid%first_row .and. j <= grid%last_row))*sin(1.0_dp + i + 3*j**2)
         end do
      end do
      direct = 0
      do j = 0, grid%ny
         do i = 0, grid%nx
            from = 0
            if (grid%is_half) from = -grid%ny
            do l = from, grid%ny
               do k = 0, grid%nx
                  direct(i, j) = direct(i, j) + kernel(i - k, abs(j - l))*field(k, abs(l))
               end do
            end do
            if (.not. is_whole) direct(i, j) = direct(i, j) - dot_product(row(0:i, 0), field(i:0:-1, j))
         end do
      end do
      call transform%init(convolution)
      call transform%apply(convolution, grid, is_whole, field, found)
      call test%check_close(reshape(found, [size(found)]), reshape(direct, [size(direct)]), 'sum over nodes', &
                            absolute=1e-13_dp)
   end subroutine compare

end program test_moving_source
