!> Elastic deformation by FFT convolution with the exact cell kernel.
module ehlwave_deformation_fft
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_double_complex, c_f_pointer, c_int, &
      c_int32_t, c_intptr_t, c_char, c_float, c_float_complex, c_funptr, c_null_ptr, c_ptr, c_size_t
   use ehlwave_deformation, only: deformation_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kernel, only: cell_influence
   use ehlwave_kinds, only: dp
   use ehlwave_work_unit, only: transform_operations
   implicit none (type, external)
   private
   public :: fast_length

   include 'fftw3.f03'

   integer, parameter :: column_block = 8   !! columns transformed together: two cache lines of complex values
   integer, parameter :: rows_forward = 1, rows_backward = 2, columns_forward = 3, columns_backward = 4   ! plans

   !> Plans, kernel transform and work space of one grid.
   !>
   !> The transform along X is done on stored rows only (the zero padding along Y costs nothing), the one
   !> along Y on a few columns at a time that stay in cache: forward, product and inverse in one visit.
   !> Plans are made with FFTW_ESTIMATE: measured plans differ from run to run, and with them the last bits
   !> of every result. Must not be copied (it owns C memory); pass it by reference.
   type, extends(deformation_t), public :: deformation_fft_t
      private
      integer :: nx = 0, ny = 0              ! as in the grid
      integer :: px = 0, py = 0              ! padded lengths
      integer :: modes = 0                   ! px/2 + 1
      logical :: is_half = .true.
      real(dp), allocatable :: spectrum(:, :)  ! (0:py/2, modes) kernel transform over px py
      type(c_ptr) :: plan(4) = c_null_ptr      ! see the parameters above
      type(c_ptr) :: memory(3) = c_null_ptr    ! of rows, row_modes and column
      real(c_double), pointer, contiguous :: rows(:, :) => null()                  ! (px, 0:ny)
      complex(c_double_complex), pointer, contiguous :: row_modes(:, :) => null()  ! (modes, 0:ny)
      complex(c_double_complex), pointer, contiguous :: column(:, :) => null()     ! (0:py-1, column_block)
   contains
      procedure :: init
      procedure :: apply
      final :: release
   end type deformation_fft_t

contains

   !> Plans and kernel transform for a grid; kappa and K of the contact.
   subroutine init(self, grid, kappa, k)
      class(deformation_fft_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa   !! ellipticity a/b
      real(dp), intent(in) :: k       !! complete elliptic integral of the first kind
      integer(c_int) :: length(1)

      call release(self)
      self%nx = grid%nx
      self%ny = grid%ny
      self%is_half = grid%is_half
      self%px = fast_length(2*grid%nx)
      self%py = fast_length(2*merge(2*grid%ny, grid%ny, grid%is_half))
      self%modes = self%px/2 + 1

      self%memory(1) = fftw_alloc_real(int(self%px, c_size_t)*(grid%ny + 1))
      self%memory(2) = fftw_alloc_complex(int(self%modes, c_size_t)*(grid%ny + 1))
      self%memory(3) = fftw_alloc_complex(int(self%py, c_size_t)*column_block)
      block
         real(c_double), pointer, contiguous :: r(:, :)
         complex(c_double_complex), pointer, contiguous :: c(:, :)
         call c_f_pointer(self%memory(1), r, [self%px, grid%ny + 1])
         self%rows(1:, 0:) => r
         call c_f_pointer(self%memory(2), c, [self%modes, grid%ny + 1])
         self%row_modes(1:, 0:) => c
         call c_f_pointer(self%memory(3), c, [self%py, column_block])
         self%column(0:, 1:) => c
      end block

      length = self%px
      self%plan(rows_forward) = fftw_plan_many_dft_r2c(1, length, grid%ny + 1, self%rows, length, 1, self%px, &
                                                       self%row_modes, length, 1, self%modes, FFTW_ESTIMATE)
      self%plan(rows_backward) = fftw_plan_many_dft_c2r(1, length, grid%ny + 1, self%row_modes, length, 1, self%modes, &
                                                  self%rows, length, 1, self%px, FFTW_ESTIMATE)
      length = self%py
      self%plan(columns_forward) = fftw_plan_many_dft(1, length, column_block, self%column, length, 1, self%py, &
                                                self%column, length, 1, self%py, FFTW_FORWARD, FFTW_ESTIMATE)
      self%plan(columns_backward) = fftw_plan_many_dft(1, length, column_block, self%column, length, 1, self%py, &
                                                 self%column, length, 1, self%py, FFTW_BACKWARD, FFTW_ESTIMATE)
      call transform_kernel(self, grid, kappa, k)
   end subroutine init

   !> Kernel transform. The kernel is even in X and Y, so it is real and even; only ky >= 0 is kept.
   subroutine transform_kernel(self, grid, kappa, k)
      class(deformation_fft_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa, k
      real(c_double), pointer, contiguous :: plane(:, :)
      complex(c_double_complex), pointer, contiguous :: modes(:, :)
      type(c_ptr) :: plan, plane_memory, modes_memory
      real(dp), allocatable :: influence(:, :)
      integer :: i, j

      plane_memory = fftw_alloc_real(int(self%px, c_size_t)*self%py)
      modes_memory = fftw_alloc_complex(int(self%modes, c_size_t)*self%py)
      call c_f_pointer(plane_memory, plane, [self%px, self%py])
      call c_f_pointer(modes_memory, modes, [self%modes, self%py])
      plan = fftw_plan_dft_r2c_2d(self%py, self%px, plane, modes, FFTW_ESTIMATE)

      allocate (influence(0:self%px/2, 0:self%py/2))
      do j = 0, self%py/2
         influence(:, j) = cell_influence([(i*grid%hx, i=0, self%px/2)], j*grid%hy, grid%hx, grid%hy, kappa, k)
      end do
      do j = 0, self%py - 1
         do i = 0, self%px - 1
            plane(i + 1, j + 1) = influence(min(i, self%px - i), min(j, self%py - j))
         end do
      end do
      call fftw_execute_dft_r2c(plan, plane, modes)
      allocate (self%spectrum(0:self%py/2, self%modes))
      self%spectrum = transpose(real(modes(:, 1:self%py/2 + 1), dp))/(real(self%px, dp)*self%py)
      call fftw_destroy_plan(plan)
      call fftw_free(plane_memory)
      call fftw_free(modes_memory)
   end subroutine transform_kernel

   !> Deformation D = sum over cells of influence times P, theory eq. (9), at all nodes.
   subroutine apply(self, p, d)
      class(deformation_fft_t), intent(inout) :: self
      real(dp), intent(in) :: p(0:, 0:)    !! pressure at the nodes, (0:nx, 0:ny), zero on the outer boundary
      real(dp), intent(out) :: d(0:, 0:)   !! deformation, (0:nx, 0:ny)
      integer :: j

      self%work = self%work + 2*(self%ny + 1)*transform_operations(real(self%px, dp)) &
                  + 4*self%modes*transform_operations(real(self%py, dp))
      do j = 0, self%ny
         self%rows(1:self%nx + 1, j) = p(:, j)
         self%rows(self%nx + 2:, j) = 0
      end do
      call fftw_execute_dft_r2c(self%plan(rows_forward), self%rows, self%row_modes)
      call convolve_columns(self)
      call fftw_execute_dft_c2r(self%plan(rows_backward), self%row_modes, self%rows)
      do j = 0, self%ny
         d(:, j) = self%rows(1:self%nx + 1, j)
      end do
   end subroutine apply

   !> Along Y: forward transform, product with the kernel, inverse, a block of columns at a time.
   subroutine convolve_columns(self)
      type(deformation_fft_t), intent(inout) :: self
      integer :: b, count, first, j, n

      n = self%ny
      do first = 1, self%modes, column_block
         count = min(column_block, self%modes - first + 1)
         if (count < column_block) self%column = 0
         do j = 0, n
            self%column(j, 1:count) = self%row_modes(first:first + count - 1, j)
         end do
         if (self%is_half) then
            self%column(n + 1:self%py - n - 1, :) = 0
            do b = 1, count
               do j = 1, n
                  self%column(self%py - j, b) = self%column(j, b)
               end do
            end do
         else
            self%column(n + 1:, :) = 0
         end if
         call fftw_execute_dft(self%plan(columns_forward), self%column, self%column)
         do b = 1, count
            call multiply_column(self%py, self%spectrum(:, first + b - 1), self%column(:, b))
         end do
         call fftw_execute_dft(self%plan(columns_backward), self%column, self%column)
         do j = 0, n
            self%row_modes(first:first + count - 1, j) = self%column(j, 1:count)
         end do
      end do
   end subroutine convolve_columns

   pure subroutine multiply_column(n, spectrum, column)
      integer, intent(in) :: n
      real(dp), intent(in) :: spectrum(0:n/2)
      complex(dp), intent(inout) :: column(0:n - 1)
      integer :: j
      do j = 0, n/2
         column(j) = spectrum(j)*column(j)
      end do
      do j = n/2 + 1, n - 1
         column(j) = spectrum(n - j)*column(j)
      end do
   end subroutine multiply_column

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

   !> Free plans and C memory.
   subroutine release(self)
      type(deformation_fft_t), intent(inout) :: self
      integer :: i

      do i = 1, size(self%plan)
         if (c_associated(self%plan(i))) call fftw_destroy_plan(self%plan(i))
      end do
      do i = 1, size(self%memory)
         if (c_associated(self%memory(i))) call fftw_free(self%memory(i))
      end do
      self%plan = c_null_ptr
      self%memory = c_null_ptr
      if (allocated(self%spectrum)) deallocate (self%spectrum)
   end subroutine release

end module ehlwave_deformation_fft
