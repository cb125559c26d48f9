!> Grid: nodes, weights of a half domain, value at the centre.
program test_grid
   use ehlwave_grid, only: grid_t, new_grid, new_line_grid
   use ehlwave_kinds, only: dp
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_nodes()
   call check_integral()
   call check_centre()
   call check_line()
   call check_coarser()
   call test%finish()

contains

   subroutine check_nodes()
      type(grid_t) :: half, whole
      whole = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 64, 32, .false.)
      half = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 64, 32, .true.)
      call test%check_close([whole%hx, whole%hy, whole%x(0), whole%x(64), whole%y(0), whole%y(32)], &
                            [0.0625_dp, 0.125_dp, -2.5_dp, 1.5_dp, -2.0_dp, 2.0_dp], 'whole domain', relative=1e-15_dp)
      call test%check_close([half%hy, half%y(0), half%y(16)], [0.125_dp, 0.0_dp, 2.0_dp], 'half domain', absolute=0.0_dp)
      call test%check(half%ny == 16 .and. half%first_row == 0 .and. whole%first_row == 1, 'rows')
      call test%check(half%below(0) == 1 .and. half%below(3) == 2 .and. whole%below(1) == 0, 'the row below is mirrored')
   end subroutine check_nodes

   !> The grid of a line contact has a single row, which is its own neighbour.
   subroutine check_line()
      type(grid_t) :: line
      line = new_line_grid(-2.5_dp, 1.5_dp, 64)
      call test%check(line%ny == 0 .and. line%first_row == 0 .and. line%last_row == 0, 'one row of unknowns')
      call test%check(line%above(0) == 0 .and. line%below(0) == 0, 'nothing across')
      call test%check_close(line%integral(spread(sqrt(max(0.0_dp, 1 - line%x**2)), 2, 1)), 2*acos(-1.0_dp)/3, &
                            'its strip bears the load of an elliptical contact', relative=1e-2_dp)
      call test%check(line%can_coarsen(32) .and. .not. line%can_coarsen(33), 'cells along X count')
   end subroutine check_line

   !> The coarser grid equals a grid made with half the cells, to the last bit.
   subroutine check_coarser()
      type(grid_t) :: coarse, fine
      fine = new_grid(-2.5_dp, 1.7_dp, 2.1_dp, 96, 80, .true.)
      coarse = new_grid(-2.5_dp, 1.7_dp, 2.1_dp, 48, 40, .true.)
      call compare_grids(fine, coarse)
      fine = new_grid(-2.5_dp, 1.7_dp, 2.1_dp, 96, 80, .false.)
      coarse = new_grid(-2.5_dp, 1.7_dp, 2.1_dp, 48, 40, .false.)
      call compare_grids(fine, coarse)
      fine = new_line_grid(-2.5_dp, 1.7_dp, 96)
      coarse = new_line_grid(-2.5_dp, 1.7_dp, 48)
      call compare_grids(fine, coarse)
      fine = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 96, 84, .true.)
      call test%check(fine%can_coarsen(40) .and. .not. fine%can_coarsen(43), 'the shorter side counts')
      fine = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 96, 82, .true.)
      call test%check(.not. fine%can_coarsen(8), 'a half domain needs an even count on the coarser grid too')
   end subroutine check_coarser

   subroutine compare_grids(fine, expected)
      type(grid_t), intent(in) :: fine, expected
      type(grid_t) :: grid
      grid = fine%coarser()
      call test%check(all([grid%nx, grid%ny, grid%first_row, grid%last_row] == &
                          [expected%nx, expected%ny, expected%first_row, expected%last_row]), 'coarser: shape')
      call test%check_close([grid%hx, grid%hy, grid%x, grid%y, grid%weight], &
                            [expected%hx, expected%hy, expected%x, expected%y, expected%weight], 'coarser', absolute=0.0_dp)
      call test%check(lbound(grid%x, 1) == 0 .and. lbound(grid%y, 1) == 0, 'coarser: bounds')
   end subroutine compare_grids

   subroutine check_integral()
      type(grid_t) :: half, whole
      whole = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 20, 12, .false.)
      half = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 20, 12, .true.)
      call test%check_close(half%integral(field(half)), whole%integral(field(whole)), 'half against whole', relative=1e-14_dp)
      call test%check_close(whole%integral(field(whole)), sum(field(whole))*whole%hx*whole%hy, 'plain sum', relative=1e-14_dp)
   end subroutine check_integral

   !> Even in Y, zero at |Y| = 2.
   pure function field(grid)
      type(grid_t), intent(in) :: grid
      real(dp) :: field(0:grid%nx, 0:grid%ny)
      integer :: j
      do j = 0, grid%ny
         field(:, j) = (2 + grid%x + 0.3_dp*grid%x**3)*(4 - grid%y(j)**2)
      end do
   end function field

   !> The field is cubic, so the interpolation is exact where the origin is no node; it is 8 there.
   subroutine check_centre()
      call check_centre_of(64, 32)     ! a node
      call check_centre_of(30, 22)     ! between nodes along X
      call check_centre_of(18, 18)
      call check_centre_of(50, 36)
   end subroutine check_centre

   subroutine check_centre_of(cells_x, cells_y)
      integer, intent(in) :: cells_x, cells_y
      type(grid_t) :: grid
      grid = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells_x, cells_y, .false.)
      call test%check_close(grid%value_at_centre(field(grid)), 8.0_dp, 'centre, whole domain', relative=1e-13_dp)
      grid = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells_x, cells_y, .true.)
      call test%check_close(grid%value_at_centre(field(grid)), 8.0_dp, 'centre, half domain', relative=1e-13_dp)
      grid = new_grid(-2.4_dp, 1.7_dp, 2.0_dp, cells_x, cells_y + 1, .false.)
      call test%check_close(grid%value_at_centre(field(grid)), 8.0_dp, 'centre, between nodes along Y too', relative=1e-13_dp)
   end subroutine check_centre_of

end program test_grid
