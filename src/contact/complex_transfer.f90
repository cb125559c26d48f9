!> Transfers of complex node values between a grid and the one with half as many cells.
module ehlwave_complex_transfer
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_transfer, only: interpolate, prolong, restrict
   implicit none (type, external)
   private
   public :: interpolate_complex, prolong_complex, restrict_complex

contains

   !> Fine values from coarse ones, as `interpolate` (cubic).
   pure subroutine interpolate_complex(coarse, fine, value_coarse, value_fine)
      type(grid_t), intent(in) :: coarse, fine            !! fine has twice the cells, same domain
      complex(dp), intent(in) :: value_coarse(0:, 0:)     !! (0:coarse%nx, 0:coarse%ny)
      complex(dp), intent(out) :: value_fine(0:, 0:)      !! (0:fine%nx, 0:fine%ny)
      real(dp), allocatable :: re(:, :), im(:, :)
      allocate (re(0:fine%nx, 0:fine%ny), im(0:fine%nx, 0:fine%ny))
      call interpolate(coarse, fine, real(value_coarse, dp), re)
      call interpolate(coarse, fine, aimag(value_coarse), im)
      value_fine = cmplx(re, im, dp)
   end subroutine interpolate_complex

   !> Fine values from coarse ones, as `prolong` (bilinear).
   pure subroutine prolong_complex(coarse, value_coarse, value_fine)
      type(grid_t), intent(in) :: coarse
      complex(dp), intent(in) :: value_coarse(0:, 0:)     !! (0:nx, 0:ny)
      complex(dp), intent(out) :: value_fine(0:, 0:)      !! (0:2 nx, 0:2 ny)
      real(dp), allocatable :: re(:, :), im(:, :)
      allocate (re(0:2*coarse%nx, 0:ubound(value_fine, 2)), im(0:2*coarse%nx, 0:ubound(value_fine, 2)))
      call prolong(coarse, real(value_coarse, dp), re)
      call prolong(coarse, aimag(value_coarse), im)
      value_fine = cmplx(re, im, dp)
   end subroutine prolong_complex

   !> Coarse values from fine ones, as `restrict` (full weighting).
   pure subroutine restrict_complex(coarse, value_fine, value_coarse)
      type(grid_t), intent(in) :: coarse
      complex(dp), intent(in) :: value_fine(0:, 0:)       !! (0:2 nx, 0:2 ny)
      complex(dp), intent(out) :: value_coarse(0:, 0:)    !! (0:nx, 0:ny)
      real(dp), allocatable :: re(:, :), im(:, :)
      allocate (re(0:coarse%nx, 0:coarse%ny), im(0:coarse%nx, 0:coarse%ny))
      call restrict(coarse, real(value_fine, dp), re)
      call restrict(coarse, aimag(value_fine), im)
      value_coarse = cmplx(re, im, dp)
   end subroutine restrict_complex

end module ehlwave_complex_transfer
