!> Interpolation and injection between grids.
program test_transfer
   use ehlwave_grid, only: grid_t, new_grid
   use ehlwave_kinds, only: dp
   use ehlwave_real_transfer, only: inject, interpolate
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_cubic()
   call check_order()
   call check_half()
   call test%finish()

contains

   pure function cubic(grid)
      type(grid_t), intent(in) :: grid
      real(dp) :: cubic(0:grid%nx, 0:grid%ny)
      integer :: j
      do j = 0, grid%ny
         cubic(:, j) = (1 + grid%x - 2*grid%x**2 + 0.5_dp*grid%x**3)*(1 - grid%y(j) + grid%y(j)**2 - 0.3_dp*grid%y(j)**3)
      end do
   end function cubic

   pure function even(grid)
      type(grid_t), intent(in) :: grid
      real(dp) :: even(0:grid%nx, 0:grid%ny)
      integer :: j
      do j = 0, grid%ny
         even(:, j) = sin(grid%x)*cos(2*grid%y(j))
      end do
   end function even

   subroutine check_cubic()
      type(grid_t) :: coarse, fine
      real(dp), allocatable :: back(:, :), expected(:, :), value(:, :)
      integer :: nx, ny

      coarse = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 10, 8, .false.)
      fine = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 20, 16, .false.)
      allocate (value(0:fine%nx, 0:fine%ny), back(0:coarse%nx, 0:coarse%ny))
      call interpolate(coarse, fine, cubic(coarse), value)
      expected = cubic(fine)
      nx = fine%nx
      ny = fine%ny
      call test%check(maxval(abs(value(2:nx - 2, 2:ny - 2) - expected(3:nx - 1, 3:ny - 1))) < 1e-12_dp, 'exact for cubics inside')
      call test%check(maxval(abs(value(1, :) - expected(2, :))) > 1e-3_dp, 'linear next to the boundary')
      call inject(coarse, value, back)
      call test%check(all(abs(back - cubic(coarse)) <= 0), 'injection undoes interpolation')
   end subroutine check_cubic

   subroutine check_order()
      type(grid_t) :: coarse, fine
      real(dp), allocatable :: value(:, :)
      real(dp) :: error(2)
      integer :: n, cells

      do n = 1, 2
         cells = 16*2**n
         coarse = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells, cells, .false.)
         fine = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 2*cells, 2*cells, .false.)
         if (allocated(value)) deallocate (value)
         allocate (value(0:fine%nx, 0:fine%ny))
         call interpolate(coarse, fine, even(coarse), value)
         value = abs(value - even(fine))
         error(n) = maxval(value(2:fine%nx - 2, 2:fine%ny - 2))
      end do
      call test%check(log(error(1)/error(2))/log(2.0_dp) > 3.9_dp, 'fourth order inside')
   end subroutine check_order

   !> A half domain gives the upper half of the whole-domain result.
   subroutine check_half()
      type(grid_t) :: coarse, fine
      real(dp), allocatable :: whole(:, :), half(:, :)

      coarse = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 12, 16, .false.)
      fine = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 24, 32, .false.)
      allocate (whole(0:fine%nx, 0:fine%ny))
      call interpolate(coarse, fine, even(coarse), whole)
      coarse = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 12, 16, .true.)
      fine = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 24, 32, .true.)
      allocate (half(0:fine%nx, 0:fine%ny))
      call interpolate(coarse, fine, even(coarse), half)
      call test%check(maxval(abs(half - whole(:, 16:))) < 1e-14_dp, 'half against whole')
   end subroutine check_half

end program test_transfer
