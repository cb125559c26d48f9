!> Grid: nodes, weights of a half domain, value at the centre.
program test_grid
   use ehlwave_grid, only: grid_t, new_grid
   use ehlwave_kinds, only: dp
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_nodes()
   call check_integral()
   call check_centre()
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
