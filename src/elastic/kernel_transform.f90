!> Fourier transform of the deformation kernel of a grid.
module ehlwave_kernel_transform
   use, intrinsic :: iso_c_binding, only: c_double, c_double_complex, c_f_pointer, c_int, &
      c_int32_t, c_intptr_t, c_char, c_float, c_float_complex, c_funptr, c_ptr, c_size_t
   use ehlwave_fftw_answer, only: obtained
   use ehlwave_grid, only: grid_t
   use ehlwave_kernel, only: corner
   use ehlwave_kinds, only: dp, pi
   use ehlwave_threads, only: is_shared, thread_count, thread_number
   implicit none (type, external)
   private
   public :: fast_length, new_kernel_transform

   include 'fftw3.f03'

   !> The kernel is even in X and Y, so that its transforms along X are real and even. Let k(j) be one of them, j the
   !> distance along Y, of a wave number along X. A column p(0:ny) of the whole domain has the deformation
   !>
   !>     d(j) = sum over i of k(j - i) p(i).
   !>
   !> On half a domain, mirrored at j = 0, with p(0) halved,
   !>
   !>     d(j) = sum over i of k(j - i) p(i) + sum over i of k(j + i) p(i),
   !>
   !> the second a convolution of the mirrored column. Both kernels have the period py >= 2 ny, so that it takes
   !> transforms of py values where those of the column and its mirror image would be twice as long. Where py = 2 ny,
   !> distances 0 and 2 ny along the second are the same to it: it takes k(0), and what is wrong, between the outermost
   !> nodes, is `corner`.
   type, public :: kernel_transform_t
      integer :: px = 0, py = 0                         !! even padded lengths along X and Y
      real(dp), allocatable :: direct(:, :)             !! (0:py/2, 0:px/2) transform of k(j - i), real and even, over
                                                        !! px py
      complex(dp), allocatable :: mirrored(:, :)        !! (0:py/2, 0:px/2) of half a domain: that of k(j + i), over px
                                                        !! py
      real(dp), allocatable :: corner(:)                !! (0:px/2) of half a domain: k(2 ny) - k(0) where py = 2 ny,
                                                        !! else 0, over px
   end type kernel_transform_t

contains

   !> Of the exact cell kernel on a grid; kappa and K of the contact.
   function new_kernel_transform(grid, kappa, k) result(self)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa   !! ellipticity a/b
      real(dp), intent(in) :: k       !! complete elliptic integral of the first kind
      type(kernel_transform_t) :: self
      real(dp), allocatable :: column(:, :), padded(:, :)
      integer :: j, reach

      self%px = fast_length(2*grid%nx)
      self%py = fast_length(2*grid%ny)
      reach = merge(2*grid%ny, self%py/2, grid%is_half)
      associate (px => self%px, py => self%py)
         allocate (column(0:reach, 0:px/2))
         column = transpose(real(spectra(distances(grid, kappa, k, px, reach)), dp))/px
         allocate (self%direct(0:py/2, 0:px/2))
         self%direct = real(spectra(column([(min(j, py - j), j=0, py - 1)], :)), dp)/py
         if (.not. grid%is_half) return
         allocate (self%mirrored(0:py/2, 0:px/2), self%corner(0:px/2))
         allocate (padded(0:py - 1, 0:px/2), source=0.0_dp)
         padded(:min(reach, py - 1), :) = column(:min(reach, py - 1), :)
         self%mirrored = spectra(padded)/py
         self%corner = 0
         if (py == reach) self%corner = column(reach, :) - column(0, :)
      end associate
   end function new_kernel_transform

   !> Influence at the distances i along X, mirrored in the middle, and j = 0 to `reach` along Y. Four cells share a
   !> corner: each row of them is found once, for a part of the rows.
   function distances(grid, kappa, k, px, reach) result(influence)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa, k
      integer, intent(in) :: px, reach
      real(dp) :: influence(0:px - 1, 0:reach)
      real(dp) :: lower(0:px/2 + 1), u(0:px/2 + 1), upper(0:px/2 + 1)
      integer :: i, j, last

      u = kappa*grid%hx*([(i, i=0, px/2 + 1)] - 0.5_dp)
      last = -huge(last)
      !$omp parallel do private(lower, upper) firstprivate(last) schedule(static) if (is_shared(size(influence)))
      do j = 0, reach
         if (j == last + 1) then
            lower = upper
         else
            lower = corner(u, grid%hy*(j - 0.5_dp))
         end if
         upper = corner(u, grid%hy*(j + 0.5_dp))
         influence(:px/2, j) = (upper(1:) - upper(:px/2) - lower(1:) + lower(:px/2))/(pi*k*kappa)
         influence(px/2 + 1:, j) = influence(px/2 - 1:1:-1, j)
         last = j
      end do
   end function distances

   !> Transform of each column, the first half of it and the middle.
   function spectra(columns) result(modes)
      real(dp), intent(in) :: columns(:, :)
      complex(dp) :: modes(size(columns, 1)/2 + 1, size(columns, 2))
      real(c_double), pointer, contiguous :: values(:, :)                  ! (n, threads)
      complex(c_double_complex), pointer, contiguous :: transform(:, :)    ! (n/2 + 1, threads)
      type(c_ptr) :: plan, transform_memory, values_memory
      integer(c_size_t) :: length
      integer :: m, n, t, threads

      n = size(columns, 1)
      threads = merge(thread_count(), 1, is_shared(size(columns)))
      length = int(n, c_size_t)*threads
      values_memory = obtained(fftw_alloc_real(length), length)
      transform_memory = obtained(fftw_alloc_complex((n/2 + 1_c_size_t)*threads), length)
      call c_f_pointer(values_memory, values, [n, threads])
      call c_f_pointer(transform_memory, transform, [n/2 + 1, threads])
      plan = obtained(fftw_plan_dft_r2c_1d(n, values, transform, FFTW_ESTIMATE), length)
      !$omp parallel do num_threads(threads) private(t) schedule(static)
      do m = 1, size(columns, 2)
         t = thread_number() + 1
         values(:, t) = columns(:, m)
         call fftw_execute_dft_r2c(plan, values(:, t), transform(:, t))
         modes(:, m) = transform(:, t)
      end do
      call fftw_destroy_plan(plan)
      call fftw_free(values_memory)
      call fftw_free(transform_memory)
   end function spectra

   !> Smallest even n' >= n whose prime factors are 2, 3, 5, 7.
   pure integer function fast_length(n)
      integer, intent(in) :: n
      integer :: rest
      fast_length = n + modulo(n, 2)
      do
         rest = fast_length
         do while (modulo(rest, 2) == 0); rest = rest/2; end do
         do while (modulo(rest, 3) == 0); rest = rest/3; end do
         do while (modulo(rest, 5) == 0); rest = rest/5; end do
         do while (modulo(rest, 7) == 0); rest = rest/7; end do
         if (rest == 1) exit
         fast_length = fast_length + 2
      end do
   end function fast_length

end module ehlwave_kernel_transform
