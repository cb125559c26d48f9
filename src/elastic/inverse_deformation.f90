!> Pressure for a deformation, by the reciprocal transform of the cell kernel: for preconditioners.
!>
!> Cosine transforms mirror fields at all edges, so that a field needs no padding. The product with the deformation is
!> close to 1 away from the edges. Double precision: a preconditioner that rounds to single precision is not linear, and
!> transposed systems preconditioned from the left would keep its error.
module ehlwave_inverse_deformation
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_double_complex, c_int, &
      c_int32_t, c_intptr_t, c_char, c_float, c_float_complex, c_funptr, c_null_ptr, c_ptr, c_size_t
   use ehlwave_fftw_answer, only: obtained
   use ehlwave_fftw_memory, only: make_room
   use ehlwave_grid, only: grid_t
   use ehlwave_kernel, only: cell_bend, kernel_t, new_kernel
   use ehlwave_kinds, only: dp, pi
   use ehlwave_work_unit, only: transform_operations
   implicit none (type, external)
   private

   include 'fftw3.f03'

   !> Plan and spectrum of one grid. Must not be copied (it owns C memory); pass it by reference.
   type, public :: inverse_deformation_t
      real(dp) :: operations = 0                        !! of an application
      real(dp) :: shortest = 0                          !! deformation by the shortest waves over their pressure
      type(c_ptr), private :: plan = c_null_ptr
      real(c_double), allocatable, private :: spectrum(:, :), field(:, :), modes(:, :)   ! (0:nx, 0:ny)
   contains
      procedure :: init
      procedure :: apply
      procedure :: near
      final :: release
   end type inverse_deformation_t

   real(dp), parameter :: flattest = 1e-4_dp   !! least transform of the kernel, over its largest

contains

   !> Plan and spectrum of a grid; kappa and K of the contact.
   subroutine init(self, grid, kappa, k)
      class(inverse_deformation_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa   !! ellipticity a/b
      real(dp), intent(in) :: k       !! complete elliptic integral of the first kind
      real(dp), allocatable :: symbol(:, :)
      type(kernel_t) :: kernel
      integer(c_size_t) :: values
      integer :: i, j

      call release(self)
      allocate (symbol(0:grid%nx, 0:grid%ny))
      allocate (self%spectrum(0:grid%nx, 0:grid%ny), self%field(0:grid%nx, 0:grid%ny), self%modes(0:grid%nx, 0:grid%ny))
      values = size(self%field, kind=c_size_t)
      call make_room()
      if (grid%is_line) then
         self%plan = obtained(fftw_plan_r2r_1d(grid%nx + 1, self%field, self%modes, FFTW_REDFT00, &
                                               FFTW_ESTIMATE + FFTW_UNALIGNED), values)
      else
         self%plan = obtained(fftw_plan_r2r_2d(grid%ny + 1, grid%nx + 1, self%field, self%modes, FFTW_REDFT00, &
                                               FFTW_REDFT00, FFTW_ESTIMATE + FFTW_UNALIGNED), values)
      end if
      kernel = new_kernel(grid, kappa, k)
      kernel%is_raised = .false.            ! waves of the symbol have a factor in its place
      do j = 0, grid%ny
         self%field(:, j) = kernel%at([(i, i=0, grid%nx)], j)
      end do
      call fftw_execute_r2r(self%plan, self%field, self%modes)
      symbol = self%modes
      if (grid%has_curved_pressure) then
         do j = 0, grid%ny
            symbol(:, j) = symbol(:, j)*(1 + cell_bend([(pi*i/grid%nx, i=0, grid%nx)]) &
                                           + cell_bend(pi*j/max(1, grid%ny)))
         end do
      end if
      symbol(0, 0) = maxval(abs(symbol))    ! a line's constant is arbitrary
      symbol = max(symbol, flattest*symbol(0, 0))
      self%shortest = symbol(grid%nx, grid%ny)
      self%spectrum = 1/(symbol*2*grid%nx*merge(1, 2*grid%ny, grid%is_line))
      self%operations = transform_operations(4.0_dp*max(1, grid%ny)*grid%nx)
   end subroutine init

   !> Pressure at all nodes for a deformation.
   subroutine apply(self, d, p)
      class(inverse_deformation_t), intent(inout) :: self
      real(dp), intent(in), contiguous :: d(0:, 0:)
      real(dp), intent(out), contiguous :: p(0:, 0:)
      self%field = d
      call fftw_execute_r2r(self%plan, self%field, self%modes)
      self%modes = self%spectrum*self%modes
      call fftw_execute_r2r(self%plan, self%modes, self%field)
      p = self%field
   end subroutine apply

   !> Pressure at the offsets up to some reaches from the only node that is deformed, by 1.
   subroutine near(self, grid, values)
      class(inverse_deformation_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(out), allocatable :: values(:, :)   !! (0:nx/2, 0:ny or ny/2)
      real(dp), allocatable :: d(:, :), p(:, :)
      integer :: centre(2)

      centre = [grid%nx/2, merge(0, grid%ny/2, grid%is_half .or. grid%is_line)]
      allocate (d(0:grid%nx, 0:grid%ny), source=0.0_dp)
      allocate (p, mold=d)
      d(centre(1), centre(2)) = 1
      call self%apply(d, p)
      allocate (values(0:grid%nx - centre(1), 0:grid%ny - centre(2)))
      values = p(centre(1):, centre(2):)
   end subroutine near

   !> Free the plan.
   subroutine release(self)
      type(inverse_deformation_t), intent(inout) :: self
      if (allocated(self%spectrum)) deallocate (self%spectrum)
      if (allocated(self%field)) deallocate (self%field)
      if (allocated(self%modes)) deallocate (self%modes)
      if (c_associated(self%plan)) call fftw_destroy_plan(self%plan)
      self%plan = c_null_ptr
   end subroutine release

end module ehlwave_inverse_deformation
