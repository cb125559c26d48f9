!> Transfers of node values between a grid and the one with half as many cells.
module ehlwave_transfer
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: interpolate, inject, prolong, restrict

contains

   !> Fine values from coarse ones: cubic midpoints (-1, 9, 9, -1)/16, linear next to the boundary.
   !>
   !> FMG needs an interpolation of higher order than the discretisation. Rows are mirrored at a line
   !> of symmetry. Values stay below zero where the cubic overshoots; clip them if that matters.
   pure subroutine interpolate(coarse, fine, value_coarse, value_fine)
      type(grid_t), intent(in) :: coarse, fine         !! fine has twice the cells, same domain
      real(dp), intent(in) :: value_coarse(0:, 0:)     !! (0:coarse%nx, 0:coarse%ny)
      real(dp), intent(out) :: value_fine(0:, 0:)      !! (0:fine%nx, 0:fine%ny)
      real(dp) :: half(0:fine%nx, -1:coarse%ny)
      integer :: j, ny

      ny = coarse%ny
      do j = 0, ny
         call refine_line(value_coarse(:, j), half(:, j))
      end do
      if (coarse%is_line) then
         value_fine = half(:, 0:ny)
         return
      end if
      half(:, -1) = 0
      if (coarse%is_half) half(:, -1) = half(:, 1)

      do j = 0, ny
         value_fine(:, 2*j) = half(:, j)
      end do
      do j = 0, ny - 1
         if ((j == 0 .and. .not. coarse%is_half) .or. j == ny - 1) then
            value_fine(:, 2*j + 1) = 0.5_dp*(half(:, j) + half(:, j + 1))
         else
            value_fine(:, 2*j + 1) = (9*(half(:, j) + half(:, j + 1)) - half(:, j - 1) - half(:, j + 2))/16
         end if
      end do
   end subroutine interpolate

   !> Twice as many intervals on one line.
   pure subroutine refine_line(coarse, fine)
      real(dp), intent(in) :: coarse(0:)
      real(dp), intent(out) :: fine(0:)
      integer :: i, n

      n = ubound(coarse, 1)
      do i = 0, n
         fine(2*i) = coarse(i)
      end do
      fine(1) = 0.5_dp*(coarse(0) + coarse(1))
      fine(2*n - 1) = 0.5_dp*(coarse(n - 1) + coarse(n))
      do i = 1, n - 2
         fine(2*i + 1) = (9*(coarse(i) + coarse(i + 1)) - coarse(i - 1) - coarse(i + 2))/16
      end do
   end subroutine refine_line

   !> Coarse values by injection: the fine value at the same place.
   pure subroutine inject(coarse, value_fine, value_coarse)
      type(grid_t), intent(in) :: coarse
      real(dp), intent(in) :: value_fine(0:, 0:)       !! (0:2 nx, 0:2 ny)
      real(dp), intent(out) :: value_coarse(0:, 0:)    !! (0:nx, 0:ny)
      value_coarse = value_fine(::2, ::coarse%row_ratio)
   end subroutine inject

   !> Fine values from coarse ones by bilinear interpolation.
   pure subroutine prolong(coarse, value_coarse, value_fine)
      type(grid_t), intent(in) :: coarse
      real(dp), intent(in) :: value_coarse(0:, 0:)     !! (0:nx, 0:ny)
      real(dp), intent(out) :: value_fine(0:, 0:)      !! (0:2 nx, 0:2 ny)
      integer :: i, j
      if (coarse%is_line) then
         value_fine(::2, :) = value_coarse
         value_fine(1::2, :) = 0.5_dp*(value_coarse(:coarse%nx - 1, :) + value_coarse(1:, :))
         return
      end if
      do j = 0, coarse%ny
         do i = 0, coarse%nx
            value_fine(2*i, 2*j) = value_coarse(i, j)
         end do
         do i = 0, coarse%nx - 1
            value_fine(2*i + 1, 2*j) = 0.5_dp*(value_coarse(i, j) + value_coarse(i + 1, j))
         end do
      end do
      do j = 0, coarse%ny - 1
         value_fine(:, 2*j + 1) = 0.5_dp*(value_fine(:, 2*j) + value_fine(:, 2*j + 2))
      end do
   end subroutine prolong

   !> Coarse values by full weighting, 1/4 (1 2 1) in each direction; rows are mirrored at a line of symmetry,
   !> and the outer boundary gets zero. Adjoint of `prolong` up to a factor 4 (of a line contact, 1/4 (1 2 1) along X
   !> and a factor 2).
   pure subroutine restrict(coarse, value_fine, value_coarse)
      type(grid_t), intent(in) :: coarse
      real(dp), intent(in) :: value_fine(0:, 0:)       !! (0:2 nx, 0:2 ny)
      real(dp), intent(out) :: value_coarse(0:, 0:)    !! (0:nx, 0:ny)
      real(dp) :: row(0:2*coarse%nx)
      integer :: i, j
      value_coarse = 0
      do j = coarse%first_row, coarse%ny - 1
         if (coarse%is_line) then
            row = value_fine(:, j)
         else
            row = 0.25_dp*(value_fine(:, abs(2*j - 1)) + 2*value_fine(:, 2*j) + value_fine(:, 2*j + 1))
         end if
         do i = 1, coarse%nx - 1
            value_coarse(i, j) = 0.25_dp*(row(2*i - 1) + 2*row(2*i) + row(2*i + 1))
         end do
      end do
   end subroutine restrict

end module ehlwave_transfer
