!> Elastic deformation by FFT convolution with the exact cell kernel.
module ehlwave_deformation_fft
   use ehlwave_assertions, only: assert, checks
   use ehlwave_deformation, only: deformation_t
   use ehlwave_double_convolution, only: double_convolution_t => convolution_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kernel_transform, only: kernel_transform_t, new_kernel_transform
   use ehlwave_kinds, only: dp
   use ehlwave_single_convolution, only: single_convolution_t => convolution_t
   use ehlwave_work_unit, only: single_share, transform_operations
   implicit none (type, external)
   private

   !> Must not be copied (it owns C memory); pass it by reference.
   type, extends(deformation_t), public :: deformation_fft_t
      private
      type(double_convolution_t) :: double
      type(single_convolution_t) :: single
      real(dp) :: operations = 0   ! operations of a convolution
      real(dp) :: made_for(8) = 0  ! all that it depends on
   contains
      procedure :: init
      procedure :: apply
      procedure :: apply_single
   end type deformation_fft_t

contains

   !> Plans and kernel transform for a grid; kappa and K of the contact. Those at hand serve the same again.
   subroutine init(self, grid, kappa, k)
      class(deformation_fft_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa   !! ellipticity a/b
      real(dp), intent(in) :: k       !! complete elliptic integral of the first kind
      type(kernel_transform_t) :: kernel
      real(dp) :: made_for(8)

      if (checks) call assert(min(grid%hx, grid%hy) > 0 .and. kappa > 0 .and. k > 0, &
                              'deformation%init: positive mesh sizes and kappa')
      made_for = [grid%hx, grid%hy, kappa, k, &
                  real([grid%nx, grid%ny, merge(1, 0, [grid%is_half, grid%has_curved_pressure])], dp)]
      if (all(abs(made_for - self%made_for) <= 0)) return
      self%made_for = made_for
      kernel = new_kernel_transform(grid, kappa, k)
      call self%double%init(grid, kernel)
      call self%single%init(grid, kernel, self%double%memory_of_rows())
      self%operations = 2*(grid%ny + 1)*transform_operations(real(kernel%px, dp)) &
                        + 4*(kernel%px/2 + 1)*transform_operations(real(kernel%py, dp))
      self%convolution = anint(single_share*self%operations)
   end subroutine init

   !> Deformation D = sum over cells of influence times P, theory eq. (9), at all nodes.
   subroutine apply(self, p, d)
      class(deformation_fft_t), intent(inout) :: self
      real(dp), intent(in), contiguous :: p(0:, 0:)    !! pressure at the nodes, (0:nx, 0:ny), zero on the outer
                                                       !! boundary
      real(dp), intent(out), contiguous :: d(0:, 0:)   !! deformation, (0:nx, 0:ny)
      if (checks) call assert(all(shape(p) == shape(d)), 'deformation%apply: one grid')
      self%work = self%work + self%operations
      call self%double%apply(p, d)
   end subroutine apply

   !> Deformation in single precision: to about 1e-7 of the largest.
   subroutine apply_single(self, p, d)
      class(deformation_fft_t), intent(inout) :: self
      real(dp), intent(in), contiguous :: p(0:, 0:)
      real(dp), intent(out), contiguous :: d(0:, 0:)
      self%work = self%work + self%convolution
      call self%single%apply(p, d)
   end subroutine apply_single

end module ehlwave_deformation_fft
