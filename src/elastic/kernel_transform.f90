!> Fourier transform of the deformation kernel of a grid.
module ehlwave_kernel_transform
   use, intrinsic :: iso_c_binding, only: c_double, c_double_complex, c_int, &
      c_int32_t, c_intptr_t, c_char, c_float, c_float_complex, c_funptr, c_ptr, c_size_t
   use ehlwave_fftw_answer, only: obtained
   use ehlwave_fftw_memory, only: allot
   use ehlwave_grid, only: grid_t
   use ehlwave_kernel, only: cell_bend, cell_curvature, corner
   use ehlwave_kinds, only: dp, pi
   use ehlwave_threads, only: is_shared, thread_count, thread_number
   implicit none (type, external)
   private
   public :: fast_length, new_kernel_transform

   include 'fftw3.f03'

   !> The kernel is even in X and Y, so that its transforms along X are real and even. Let k(j), j the distance along
   !> Y, be the transform at a wave number along X. A column p(0:ny) of the whole domain has the deformation
   !>
   !>     d(j) = sum over i of k(j - i) p(i).
   !>
   !> On half a domain, mirrored at j = 0, with p(0) halved,
   !>
   !>     d(j) = sum over i of k(j - i) p(i) + sum over i of k(j + i) p(i),
   !>
   !> the second a convolution of the mirrored column. Both kernels have the period py >= 2 ny, so that transforms of
   !> py values suffice. A column with its mirror image would need twice that length. Where py = 2 ny, distances 0 and
   !> 2 ny along the second are the same to it: it takes k(0); `corner` corrects the error between the outermost nodes.
   type, public :: kernel_transform_t
      integer :: px = 0, py = 0                         !! even padded lengths along X and Y
      real(dp), allocatable :: direct(:, :)             !! (0:py/2, 0:px/2) transform of k(j - i), real and even, over
                                                        !! px py
      complex(dp), allocatable :: mirrored(:, :)  !! (0:py/2, 0:px/2) for half a domain: transform of k(j + i), over px
                                                        !! py
      real(dp), allocatable :: corner(:)                !! (0:px/2) of half a domain: k(2 ny) - k(0) where py = 2 ny,
                                                        !! else 0, over px
   end type kernel_transform_t

   !> A plan, and a row or column with its transform for each thread. Must not be copied (it owns C memory).
   type :: transforms_t
      integer :: threads = 1
      type(c_ptr) :: plan, memory(2)
      real(c_double), pointer, contiguous :: values(:, :) => null()              !! (0:n-1, 0:threads-1)
      complex(c_double_complex), pointer, contiguous :: modes(:, :) => null()    !! (0:n/2, 0:threads-1)
   end type transforms_t

contains

   !> Transform of the kernel of a grid, see `kernel_t`; kappa and K of the contact.
   function new_kernel_transform(grid, kappa, k) result(self)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa   !! ellipticity a/b
      real(dp), intent(in) :: k       !! complete elliptic integral of the first kind
      type(kernel_transform_t) :: self
      type(transforms_t) :: along_y
      real(dp), allocatable :: column(:, :)
      integer :: j, m, reach, t

      self%px = fast_length(2*grid%nx)
      self%py = fast_length(2*grid%ny)
      associate (px => self%px, py => self%py)
         reach = merge(2*grid%ny, py/2, grid%is_half)
         allocate (column(0:reach + 1, 0:px/2), self%direct(0:py/2, 0:px/2))
         call transform_rows(grid, kappa, k, px, column)
         if (grid%is_half) then
            allocate (self%mirrored(0:py/2, 0:px/2))
            allocate (self%corner(0:px/2), source=0.0_dp)
         end if
         call begin(along_y, py, size(column))
         !$omp parallel do num_threads(along_y%threads) private(j, t) schedule(static)
         do m = 0, px/2
            t = thread_number()
            associate (values => along_y%values, modes => along_y%modes(:, t), last => min(reach, py - 1))
               if (grid%has_curved_pressure) call curve(column(:, m), 2*pi*m/px)
               values(:, t) = column([(min(j, py - j), j=0, py - 1)], m)
               call fftw_execute_dft_r2c(along_y%plan, values(:, t), modes)
               self%direct(:, m) = real(modes, dp)/py
               if (.not. grid%is_half) cycle
               values(:last, t) = column(:last, m)
               values(last + 1:, t) = 0
               call fftw_execute_dft_r2c(along_y%plan, values(:, t), modes)
               self%mirrored(:, m) = modes/py
               if (py == reach) self%corner(m) = column(reach, m) - column(0, m)
            end associate
         end do
         call finish(along_y)
      end associate
   end function new_kernel_transform

   !> The kernel of pressures that are curved along X and Y, from the kernel of cells, both transformed along X.
   pure subroutine curve(column, angle)
      real(dp), intent(inout) :: column(0:)     !! (0:reach + 1), the last is left alone
      real(dp), intent(in) :: angle             !! of the wave per cell along X
      real(dp) :: along_x, before, here
      integer :: j
      along_x = 1 + cell_bend(angle)
      before = column(1)
      do j = 0, ubound(column, 1) - 1
         here = column(j)
         column(j) = along_x*here - cell_curvature*(before - 2*here + column(j + 1))
         before = here
      end do
   end subroutine curve

   !> Transforms along X of the influence of cells at the distances j = 0 to `reach` + 1 along Y. The influence depends
   !> on distances along X and is mirrored in the middle. Four cells share a corner: each row of them is found once, for
   !> a part of the rows.
   subroutine transform_rows(grid, kappa, k, px, column)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa, k
      integer, intent(in) :: px
      real(dp), intent(out) :: column(0:, 0:)   !! (0:reach + 1, 0:px/2), over px
      type(transforms_t) :: along_x
      real(dp), dimension(0:px/2 + 1) :: lower, u, upper
      integer :: i, j, last, t

      u = kappa*grid%hx*([(i, i=0, px/2 + 1)] - 0.5_dp)
      call begin(along_x, px, size(column))
      last = -huge(last)
      !$omp parallel do num_threads(along_x%threads) private(lower, t, upper) firstprivate(last) schedule(static)
      do j = 0, ubound(column, 1)
         t = thread_number()
         if (j == last + 1) then
            lower = upper
         else
            lower = corner(u, grid%hy*(j - 0.5_dp))
         end if
         upper = corner(u, grid%hy*(j + 0.5_dp))
         last = j
         associate (influence => along_x%values)
            influence(:px/2, t) = (upper(1:) - upper(:px/2) - lower(1:) + lower(:px/2))/(pi*k*kappa)
            influence(px/2 + 1:, t) = influence(px/2 - 1:1:-1, t)
         end associate
         call fftw_execute_dft_r2c(along_x%plan, along_x%values(:, t), along_x%modes(:, t))
         column(j, :) = real(along_x%modes(:, t), dp)/px
      end do
      call finish(along_x)
   end subroutine transform_rows

   !> Plan and memory for real transforms of length n, by as many threads as so many values are worth.
   subroutine begin(self, n, values)
      type(transforms_t), intent(out) :: self
      integer, intent(in) :: n, values

      self%threads = merge(thread_count(), 1, is_shared(values))
      call allot(n, self%threads, self%memory(1), self%values)
      call allot(n/2 + 1, self%threads, self%memory(2), self%modes)
      self%plan = obtained(fftw_plan_dft_r2c_1d(n, self%values, self%modes, FFTW_ESTIMATE), int(n, c_size_t))
   end subroutine begin

   subroutine finish(self)
      type(transforms_t), intent(inout) :: self
      call fftw_destroy_plan(self%plan)
      call fftw_free(self%memory(1))
      call fftw_free(self%memory(2))
   end subroutine finish

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
