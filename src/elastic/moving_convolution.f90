!> Convolution of a field on a grid with a kernel that is even along Y, but not along X, by FFT.
module ehlwave_moving_convolution
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_double_complex, c_int, &
      c_int32_t, c_intptr_t, c_char, c_float, c_float_complex, c_funptr, c_null_ptr, c_ptr, c_size_t
   use ehlwave_fftw_answer, only: obtained
   use ehlwave_fftw_memory, only: allot
   use ehlwave_grid, only: grid_t
   use ehlwave_kernel_transform, only: fast_length
   use ehlwave_kinds, only: dp
   use ehlwave_work_unit, only: transform_operations
   implicit none (type, external)
   private
   public :: new_moving_convolution

   include 'fftw3.f03'

   !> Transforms of kernels on a grid.
   type, public :: moving_convolution_t
      integer :: px = 0, py = 0                         !! padded lengths
      complex(dp), allocatable :: whole(:, :)           !! (0:px/2, 0:py-1) transform of the kernel, over px py
      complex(dp), allocatable :: row(:)                !! (0:px/2) share of heat downstream, as if even along Y
   end type moving_convolution_t

   !> Plans and work space. Must not be copied (it owns C memory); pass it by reference.
   type, public :: moving_transform_t
      private
      type(c_ptr) :: forward = c_null_ptr, backward = c_null_ptr, memory(2) = c_null_ptr
      real(c_double), pointer, contiguous :: plane(:, :) => null()              ! (0:px-1, 0:py-1)
      complex(c_double_complex), pointer, contiguous :: modes(:, :) => null()   ! (0:px/2, 0:py-1)
      real(dp), public :: operations = 0                !! of all convolutions
   contains
      procedure :: init
      procedure :: apply
      final :: release
   end type moving_transform_t

contains

   !> Transforms for a grid, from the kernel and from its share within a row.
   function new_moving_convolution(grid, kernel, row) result(self)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kernel(-grid%nx:, 0:)     !! at distances along and across
      real(dp), intent(in) :: row(0:)                   !! at distances downstream
      type(moving_convolution_t) :: self
      type(moving_transform_t) :: work
      integer :: last, n

      self%px = fast_length(2*grid%nx)
      self%py = 1
      if (.not. grid%is_line) self%py = fast_length(merge(3, 2, grid%is_half)*grid%ny)
      last = min(ubound(kernel, 2), self%py - grid%ny)
      call work%init(self)
      work%plane = 0
      do n = 0, last
         call wrap(kernel(:, n), work%plane(:, n))
         if (n > 0 .and. n < grid%ny) call wrap(kernel(:, n), work%plane(:, self%py - n))
      end do
      call fftw_execute_dft_r2c(work%forward, work%plane, work%modes)
      allocate (self%whole(0:self%px/2, 0:self%py - 1), self%row(0:self%px/2))
      self%whole(:, :) = work%modes/(real(self%px, dp)*self%py)
      work%plane = 0
      work%plane(:grid%nx - 1, 0) = row(:grid%nx - 1)
      call fftw_execute_dft_r2c(work%forward, work%plane, work%modes)
      self%row(:) = work%modes(:, 0)/(real(self%px, dp)*self%py)

   contains

      !> Distances along X, negative ones at the end.
      pure subroutine wrap(values, line)
         real(dp), intent(in) :: values(-grid%nx:)
         real(dp), intent(out) :: line(0:)
         line = 0
         line(:grid%nx - 1) = values(0:grid%nx - 1)
         line(self%px - grid%nx + 1:) = values(-grid%nx + 1:-1)
      end subroutine wrap

   end function new_moving_convolution

   !> Plans for transforms of that size.
   subroutine init(self, convolution)
      class(moving_transform_t), intent(inout) :: self
      type(moving_convolution_t), intent(in) :: convolution
      integer(c_size_t) :: values

      call release(self)
      associate (px => convolution%px, py => convolution%py)
         values = int(px, c_size_t)*py
         call allot(px, py, self%memory(1), self%plane)
         call allot(px/2 + 1, py, self%memory(2), self%modes)
         self%forward = obtained(fftw_plan_dft_r2c_2d(py, px, self%plane, self%modes, FFTW_ESTIMATE), values)
         self%backward = obtained(fftw_plan_dft_c2r_2d(py, px, self%modes, self%plane, FFTW_ESTIMATE), values)
      end associate
   end subroutine init

   !> Convolution of a field, which is 0 at the edges, at all nodes: with the kernel, or with the kernel less its share
   !> within rows.
   subroutine apply(self, convolution, grid, is_whole, field, values)
      class(moving_transform_t), intent(inout) :: self
      type(moving_convolution_t), intent(in) :: convolution
      type(grid_t), intent(in) :: grid
      logical, intent(in) :: is_whole
      real(dp), intent(in) :: field(0:, 0:)             !! (0:nx, 0:ny)
      real(dp), intent(out) :: values(0:, 0:)
      integer :: j

      associate (nx => grid%nx, ny => grid%ny, px => convolution%px, py => convolution%py)
         self%plane = 0
         do j = grid%first_row, grid%last_row
            self%plane(1:nx - 1, j) = field(1:nx - 1, j)
            if (grid%is_half .and. j > 0) self%plane(1:nx - 1, py - j) = field(1:nx - 1, j)
         end do
         call fftw_execute_dft_r2c(self%forward, self%plane, self%modes)
         do j = 0, py - 1
            if (is_whole) then
               self%modes(:, j) = convolution%whole(:, j)*self%modes(:, j)
            else
               self%modes(:, j) = (convolution%whole(:, j) - convolution%row)*self%modes(:, j)
            end if
         end do
         call fftw_execute_dft_c2r(self%backward, self%modes, self%plane)
         values = self%plane(:nx, :ny)
         self%operations = self%operations + 2*transform_operations(real(px, dp)*py)
      end associate
   end subroutine apply

   !> Free plans and C memory.
   subroutine release(self)
      type(moving_transform_t), intent(inout) :: self
      if (c_associated(self%forward)) call fftw_destroy_plan(self%forward)
      if (c_associated(self%backward)) call fftw_destroy_plan(self%backward)
      if (c_associated(self%memory(1))) call fftw_free(self%memory(1))
      if (c_associated(self%memory(2))) call fftw_free(self%memory(2))
      self%forward = c_null_ptr
      self%backward = c_null_ptr
      self%memory = c_null_ptr
   end subroutine release

end module ehlwave_moving_convolution
