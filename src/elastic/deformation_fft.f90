!> Elastic deformation by FFT convolution with the exact cell kernel.
module ehlwave_deformation_fft
   use, intrinsic :: iso_c_binding, only: c_double, c_double_complex, c_f_pointer, c_int, &
      c_int32_t, c_intptr_t, c_char, c_float, c_float_complex, c_funptr, c_ptr, c_size_t
   use ehlwave_deformation, only: deformation_t
   use ehlwave_double_convolution, only: double_convolution_t => convolution_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kernel, only: cell_influence
   use ehlwave_kinds, only: dp
   use ehlwave_single_convolution, only: single_convolution_t => convolution_t
   use ehlwave_work_unit, only: single_share, transform_operations
   implicit none (type, external)
   private
   public :: fast_length

   include 'fftw3.f03'

   !> Must not be copied (it owns C memory); pass it by reference.
   type, extends(deformation_t), public :: deformation_fft_t
      private
      type(double_convolution_t) :: double
      type(single_convolution_t) :: single
      real(dp) :: operations = 0   ! of a convolution
   contains
      procedure :: init
      procedure :: apply
      procedure :: apply_single
   end type deformation_fft_t

contains

   !> Plans and kernel transform for a grid; kappa and K of the contact.
   subroutine init(self, grid, kappa, k)
      class(deformation_fft_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa   !! ellipticity a/b
      real(dp), intent(in) :: k       !! complete elliptic integral of the first kind
      integer :: px, py

      px = fast_length(2*grid%nx)
      py = fast_length(2*merge(2*grid%ny, grid%ny, grid%is_half))
      associate (spectrum => kernel_spectrum(grid, kappa, k, px, py))
         call self%double%init(grid, spectrum)
         call self%single%init(grid, spectrum)
      end associate
      self%operations = 2*(grid%ny + 1)*transform_operations(real(px, dp)) &
                        + 4*(px/2 + 1)*transform_operations(real(py, dp))
   end subroutine init

   !> Kernel transform over px py, (0:py/2, 0:px/2). The kernel is even in X and Y, so it is real and even; only kx, ky >= 0 are kept.
   function kernel_spectrum(grid, kappa, k, px, py) result(spectrum)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa, k
      integer, intent(in) :: px, py   !! padded lengths
      real(dp), allocatable :: spectrum(:, :)
      real(c_double), pointer, contiguous :: plane(:, :)
      complex(c_double_complex), pointer, contiguous :: modes(:, :)
      type(c_ptr) :: plan, plane_memory, modes_memory
      real(dp), allocatable :: influence(:, :)
      integer :: i, j

      plane_memory = fftw_alloc_real(int(px, c_size_t)*py)
      modes_memory = fftw_alloc_complex(int(px/2 + 1, c_size_t)*py)
      call c_f_pointer(plane_memory, plane, [px, py])
      call c_f_pointer(modes_memory, modes, [px/2 + 1, py])
      plan = fftw_plan_dft_r2c_2d(py, px, plane, modes, FFTW_ESTIMATE)

      allocate (influence(0:px/2, 0:py/2))
      do j = 0, py/2
         influence(:, j) = cell_influence([(i*grid%hx, i=0, px/2)], j*grid%hy, grid%hx, grid%hy, kappa, k)
      end do
      do j = 0, py - 1
         do i = 0, px - 1
            plane(i + 1, j + 1) = influence(min(i, px - i), min(j, py - j))
         end do
      end do
      call fftw_execute_dft_r2c(plan, plane, modes)
      allocate (spectrum(0:py/2, 0:px/2))
      spectrum = transpose(real(modes(:, 1:py/2 + 1), dp))/(real(px, dp)*py)
      call fftw_destroy_plan(plan)
      call fftw_free(plane_memory)
      call fftw_free(modes_memory)
   end function kernel_spectrum

   !> Deformation D = sum over cells of influence times P, theory eq. (9), at all nodes.
   subroutine apply(self, p, d)
      class(deformation_fft_t), intent(inout) :: self
      real(dp), intent(in) :: p(0:, 0:)    !! pressure at the nodes, (0:nx, 0:ny), zero on the outer boundary
      real(dp), intent(out) :: d(0:, 0:)   !! deformation, (0:nx, 0:ny)
      self%work = self%work + self%operations
      call self%double%apply(p, d)
   end subroutine apply

   !> The same in single precision: to about 1e-7 of the largest.
   subroutine apply_single(self, p, d)
      class(deformation_fft_t), intent(inout) :: self
      real(dp), intent(in) :: p(0:, 0:)
      real(dp), intent(out) :: d(0:, 0:)
      self%work = self%work + anint(single_share*self%operations)
      call self%single%apply(p, d)
   end subroutine apply_single

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

end module ehlwave_deformation_fft
