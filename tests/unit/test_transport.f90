!> Wedge and squeeze terms: exactness, carried profiles and order for every step ratio.
program test_transport
   use ehlwave_grid, only: grid_t, new_grid
   use ehlwave_kinds, only: dp
   use ehlwave_text, only: to_text
   use ehlwave_transport, only: characteristic_transport, steady_transport, transport_t
   use testing, only: test_t
   implicit none (type, external)

   integer, parameter :: cells_per_step(5) = [1, 2, 4, 1, 1], steps_per_cell(5) = [1, 1, 1, 2, 4]
   type(test_t) :: test
   integer :: ratio

   call check_steady(.false.)
   call check_steady(.true.)
   do ratio = 1, size(cells_per_step)
      call check_travelling(cells_per_step(ratio), steps_per_cell(ratio), .false.)
      call check_travelling(cells_per_step(ratio), steps_per_cell(ratio), .true.)
      call check_order(cells_per_step(ratio), steps_per_cell(ratio), .false.)
      call check_order(cells_per_step(ratio), steps_per_cell(ratio), .true.)
   end do
   call test%finish()

contains

   !> w0 f(i) + w1 f(i-1) + w2 f(i-2) + w3 f(i-3) + carried.
   pure real(dp) function at(transport, f, i, j)
      type(transport_t), intent(in) :: transport
      real(dp), intent(in) :: f(0:, 0:)
      integer, intent(in) :: i, j
      at = transport%w0(i)*f(i, j) + transport%w1(i)*f(i - 1, j)
      if (i > 1) at = at + transport%w2(i)*f(i - 2, j)
      if (i > 2 .and. allocated(transport%w3)) at = at + transport%w3(i)*f(i - 3, j)
      if (allocated(transport%carried)) at = at + transport%carried(i, j)
   end function at

   subroutine check_steady(is_fitted)
      logical, intent(in) :: is_fitted   !! third order from the third node on
      type(grid_t) :: grid
      type(transport_t) :: transport
      real(dp), allocatable :: f(:, :)
      integer :: i

      grid = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, 20, 4, .false.)
      grid%is_fitted = is_fitted
      transport = steady_transport(grid)
      f = spread(2 - 3*grid%x + 0.7_dp*grid%x**2, 2, 5)
      do i = 2, 19
         call test%check_close(at(transport, f(:, :), i, 2), -3 + 1.4_dp*grid%x(i), 'steady, quadratic', absolute=1e-12_dp)
      end do
      if (is_fitted) then
         f = spread(2 - 3*grid%x + 0.7_dp*grid%x**3, 2, 5)
         do i = 3, 19
            call test%check_close(at(transport, f(:, :), i, 2), -3 + 2.1_dp*grid%x(i)**2, 'steady, cubic', absolute=1e-11_dp)
         end do
      end if
      f = spread(2 - 3*grid%x, 2, 5)
      call test%check_close(at(transport, f(:, :), 1, 2), -3.0_dp, 'steady, linear next to the inlet', absolute=1e-12_dp)
   end subroutine check_steady

   !> Values f(X, T) = profile of all earlier times, then the operator at T.
   subroutine apply_to(f_of, cells, m, s, t, is_fitted, transport, grid, values)
      interface
         pure function f_of(x, t) result(f)
            import :: dp
            implicit none (type, external)
            real(dp), intent(in) :: x(:), t
            real(dp) :: f(size(x))
         end function f_of
      end interface
      integer, intent(in) :: cells, m, s
      real(dp), intent(in) :: t
      logical, intent(in) :: is_fitted
      type(transport_t), intent(out) :: transport
      type(grid_t), intent(out) :: grid
      real(dp), allocatable, intent(out) :: values(:)
      real(dp), allocatable :: f(:, :), history(:, :, :)
      integer :: i, n

      grid = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells, 4, .false.)
      grid%is_fitted = is_fitted
      transport = characteristic_transport(grid, m, s)
      allocate (history(0:grid%nx, 0:grid%ny, transport%history_length()))
      do n = 1, size(history, 3)
         history(:, :, n) = spread(f_of(grid%x, t - n*grid%hx*m/s), 2, grid%ny + 1)
      end do
      call transport%carry(grid, history)
      f = spread(f_of(grid%x, t), 2, grid%ny + 1)
      allocate (values(grid%nx - 1))
      do i = 1, grid%nx - 1
         values(i) = at(transport, f(:, :), i, 3)
      end do
   end subroutine apply_to

   !> Patterns that travel with the lubricant leave no residual, at any roughness.
   subroutine check_travelling(m, s, is_fitted)
      integer, intent(in) :: m, s
      logical, intent(in) :: is_fitted
      type(grid_t) :: grid
      type(transport_t) :: transport
      real(dp), allocatable :: values(:)
      integer :: first

      call apply_to(travelling, 40, m, s, 0.3_dp, is_fitted, transport, grid, values)
      call test%check(transport%history_length() == merge(3, 2, is_fitted)*s, 'history length')
      first = merge(1, 2*m, m == 1)
      call test%check(maxval(abs(values(first:)))*grid%hx < 1e-12_dp, 'travelling profile, dT/hX = '//to_text(m)//'/'//to_text(s))
   end subroutine check_travelling

   pure function travelling(x, t) result(f)
      real(dp), intent(in) :: x(:), t
      real(dp) :: f(size(x))
      f = sin(37*(x - t)) + 0.2_dp*(x - t)**5
   end function travelling

   pure function general(x, t) result(f)
      real(dp), intent(in) :: x(:), t
      real(dp) :: f(size(x))
      f = sin(2*x + 0.7_dp*t) + x*t
   end function general

   subroutine check_order(m, s, is_fitted)
      integer, intent(in) :: m, s
      logical, intent(in) :: is_fitted
      type(grid_t) :: grid
      type(transport_t) :: transport
      real(dp), allocatable :: values(:)
      real(dp), parameter :: t = 0.3_dp
      real(dp) :: error(3), order
      integer :: i, n

      do n = 1, 3
         call apply_to(general, 40*2**n, m, s, t, is_fitted, transport, grid, values)
         error(n) = 0
         do i = merge(3*m, 2, is_fitted), grid%nx - 1
            error(n) = max(error(n), abs(values(i) - 2.7_dp*cos(2*grid%x(i) + 0.7_dp*t) - t - grid%x(i)))
         end do
      end do
      order = log(error(2)/error(3))/log(2.0_dp)
      print '(a)', 'measured: transport, dT/hX = '//to_text(m)//'/'//to_text(s)//': order '//to_text(order, 4)
      call test%check_close(order, merge(3.0_dp, 2.0_dp, is_fitted), 'order, dT/hX = '//to_text(m)//'/'//to_text(s), &
                            absolute=0.2_dp)
   end subroutine check_order

end program test_transport
