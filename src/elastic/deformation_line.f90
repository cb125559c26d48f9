!> Elastic deformation of a line contact by FFT convolution with the exact cell kernel.
module ehlwave_deformation_line
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_double_complex, c_int, &
      c_int32_t, c_intptr_t, c_char, c_float, c_float_complex, c_funptr, c_null_ptr, c_ptr, c_size_t
   use ehlwave_deformation, only: deformation_t
   use ehlwave_fftw_answer, only: obtained
   use ehlwave_fftw_memory, only: allot
   use ehlwave_kernel_transform, only: fast_length
   use ehlwave_grid, only: grid_t
   use ehlwave_kernel, only: kernel_t, new_kernel
   use ehlwave_kinds, only: dp
   use ehlwave_work_unit, only: transform_operations
   implicit none (type, external)
   private

   include 'fftw3.f03'

   !> Plans, kernel transform and work space of one line. Must not be copied (it owns C memory); pass it by reference.
   type, extends(deformation_t), public :: deformation_line_t
      private
      integer :: nx = 0                      ! as in the grid
      type(kernel_t) :: kernel
      real(dp), allocatable :: spectrum(:)   ! (modes) kernel transform over the padded length
      real(dp) :: along = 0                  ! wave number along the line of the pressures at hand
      real(dp) :: known_along = 0            ! wave number of the spectrum below
      real(dp), allocatable :: spectrum_along(:)
      type(c_ptr) :: forward = c_null_ptr, backward = c_null_ptr
      type(c_ptr) :: real_memory = c_null_ptr, mode_memory = c_null_ptr
      real(c_double), pointer, contiguous :: row(:) => null()               ! (padded length)
      complex(c_double_complex), pointer, contiguous :: modes(:) => null()
   contains
      procedure :: init
      procedure :: apply
      procedure :: vary_along
      final :: release
   end type deformation_line_t

contains

   !> Plans and kernel transform for the grid of a line contact, kappa = 0.
   subroutine init(self, grid, kappa, k)
      class(deformation_line_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa   !! 0
      real(dp), intent(in) :: k       !! not used by the kernel of a line
      real(c_double), pointer, contiguous :: rows(:, :)
      complex(c_double_complex), pointer, contiguous :: modes(:, :)
      integer(c_size_t) :: length
      integer :: i, n

      call release(self)
      self%nx = grid%nx
      self%kernel = new_kernel(grid, kappa, k)
      self%along = 0
      self%known_along = 0
      n = fast_length(2*grid%nx)
      length = n
      call allot(n, 1, self%real_memory, rows)
      call allot(n/2 + 1, 1, self%mode_memory, modes)
      self%row(1:n) => rows
      self%modes(1:n/2 + 1) => modes
      self%forward = obtained(fftw_plan_dft_r2c_1d(n, self%row, self%modes, FFTW_ESTIMATE), length)
      self%backward = obtained(fftw_plan_dft_c2r_1d(n, self%modes, self%row, FFTW_ESTIMATE), length)
      self%row = self%kernel%at([(min(i, n - i), i=0, n - 1)], 0)
      call fftw_execute_dft_r2c(self%forward, self%row, self%modes)
      self%spectrum = real(self%modes, dp)/n      ! the kernel is even, so its transform is real
      self%convolution = 2*transform_operations(real(n, dp))
   end subroutine init

   !> Deformation at all nodes of the line, D = sum over cells of influence times P.
   subroutine apply(self, p, d)
      class(deformation_line_t), intent(inout) :: self
      real(dp), intent(in), contiguous :: p(0:, 0:)    !! pressure at the nodes, (0:nx, 0:0)
      real(dp), intent(out), contiguous :: d(0:, 0:)   !! deformation, (0:nx, 0:0)

      self%work = self%work + self%convolution
      self%row(1:self%nx + 1) = p(:, 0)
      self%row(self%nx + 2:) = 0
      call fftw_execute_dft_r2c(self%forward, self%row, self%modes)
      if (self%along > 0) then
         self%modes = self%spectrum_along*self%modes
      else
         self%modes = self%spectrum*self%modes
      end if
      call fftw_execute_dft_c2r(self%backward, self%modes, self%row)
      d(:, 0) = self%row(1:self%nx + 1)
   end subroutine apply

   !> See the interface.
   subroutine vary_along(self, wave_number)
      class(deformation_line_t), intent(inout) :: self
      real(dp), intent(in) :: wave_number
      type(kernel_t) :: kernel
      integer :: i, n

      self%along = wave_number
      if (.not. wave_number > 0 .or. abs(wave_number - self%known_along) <= 0) return
      n = size(self%row)
      kernel = self%kernel
      kernel%along = wave_number
      self%row = kernel%at([(min(i, n - i), i=0, n - 1)], 0)
      call fftw_execute_dft_r2c(self%forward, self%row, self%modes)
      self%spectrum_along = real(self%modes, dp)/n
      self%known_along = wave_number
   end subroutine vary_along

   !> Free plans and C memory.
   subroutine release(self)
      type(deformation_line_t), intent(inout) :: self
      if (c_associated(self%forward)) call fftw_destroy_plan(self%forward)
      if (c_associated(self%backward)) call fftw_destroy_plan(self%backward)
      if (c_associated(self%real_memory)) call fftw_free(self%real_memory)
      if (c_associated(self%mode_memory)) call fftw_free(self%mode_memory)
      self%forward = c_null_ptr
      self%backward = c_null_ptr
      self%real_memory = c_null_ptr
      self%mode_memory = c_null_ptr
   end subroutine release

end module ehlwave_deformation_line
