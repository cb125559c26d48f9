!> Fitted fluxes: exact where they integrate exactly, derivatives, the averaged fluxes where nodes are alike.
program test_fitted_flux
   use ehlwave_face_flow, only: face_flow_t, new_face_flow, node_oil_t
   use ehlwave_fitted_flux, only: fit_faces
   use ehlwave_grid, only: grid_t, new_grid, new_line_grid
   use ehlwave_kinds, only: dp
   use ehlwave_raised_flux, only: raise_order, raised_across, raised_row
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: lambdabar = 0.02_dp, thickening = 40, pressure = 0.3_dp
   integer, parameter :: along_line = 1, across_whole = 2, across_half = 3
   type(test_t) :: test

   call check_steep_oil()
   call check_wedge()
   call check_alike()
   call check_order()
   call test%finish()

contains

   !> State of an oil of constant density whose viscosity is exp(40 P), or constant.
   function oil_of(p, h, thickens) result(oil)
      real(dp), intent(in) :: p(0:, 0:), h(0:, 0:)
      logical, intent(in) :: thickens
      type(node_oil_t) :: oil
      real(dp) :: slope

      slope = merge(thickening, 0.0_dp, thickens)
      allocate (oil%p, oil%h, oil%fluidity, oil%dln_eta, oil%rho, oil%drho, source=p)
      oil%h(:, :) = h
      oil%fluidity(:, :) = exp(-slope*p)
      oil%dln_eta(:, :) = slope
      oil%rho(:, :) = 1
      oil%drho(:, :) = 0
   end function oil_of

   !> Between parallel walls the same flow passes all faces along X, driven by the whole pressure drop, however
   !> steep the viscosity is from node to node. The averaged flow is far from it.
   subroutine check_steep_oil()
      integer, parameter :: n = 8
      type(grid_t) :: grid
      type(face_flow_t) :: x, y
      type(node_oil_t) :: oil
      real(dp) :: p(0:n, 0:n), q(0:n), averaged
      real(dp), parameter :: film = 0.2_dp
      integer :: i

      grid = new_grid(-1.0_dp, 1.0_dp, 1.0_dp, n, n, .false.)
      q = (1 - exp(-thickening*pressure))/thickening*[(i, i=0, n)]/real(n, dp)     ! int dP/eta, linear in X
      p = spread(-log(1 - thickening*q)/thickening, 2, n + 1)
      oil = oil_of(p, spread(spread(film, 1, n + 1), 2, n + 1), .true.)
      x = new_face_flow(grid)
      y = x
      call fit_faces(grid, lambdabar, oil, x, y)
      call test%check_close(x%flux(:n - 1, 3), spread(2*film**3/lambdabar*q(n)/n, 1, n), 'flux of a steep oil', relative=1e-12_dp)
      call test%check(all(abs(y%flux) <= 0), 'none across')
      averaged = film**3/lambdabar*(oil%fluidity(n - 1, 3) + oil%fluidity(n, 3))*(p(n, 3) - p(n - 1, 3))
      call test%check(averaged > 1.5_dp*x%flux(n - 1, 3), 'averages are far off')
      ! along Y, and transposed
      oil = oil_of(transpose(p), spread(spread(film, 1, n + 1), 2, n + 1), .true.)
      call fit_faces(grid, lambdabar, oil, x, y)
      call test%check_close(y%flux(3, :n - 1), spread(2*film**3/lambdabar*q(n)/n, 1, n), 'along Y', relative=1e-12_dp)
   end subroutine check_steep_oil

   !> In a straight wedge of a thin oil, too: P from H^3 dP/dX = const.
   subroutine check_wedge()
      integer, parameter :: n = 12
      type(grid_t) :: grid
      type(face_flow_t) :: x, y
      real(dp) :: h(0:n, 0:0), p(0:n, 0:0)

      grid = new_line_grid(-2.0_dp, 1.0_dp, n)
      h(:, 0) = 1.2_dp - grid%x                       ! 3.2 to 0.2
      p(:, 0) = 0.5_dp/h(:, 0)**2                     ! dP/dX = 1/H^3
      x = new_face_flow(grid)
      y = x
      call fit_faces(grid, lambdabar, oil_of(p, h, .false.), x, y)
      call test%check_close(x%flux(:n - 1, 0), spread(2*grid%hx/lambdabar, 1, n), 'flux in a wedge', relative=1e-12_dp)
   end subroutine check_wedge

   !> Where nodes hardly differ, the mean equals the averaged scheme, and the series joins the logarithm.
   subroutine check_alike()
      type(grid_t) :: grid
      type(face_flow_t) :: x, y
      type(node_oil_t) :: oil
      real(dp) :: p(0:2, 0:0)
      real(dp), parameter :: apart(2) = [0.019999999_dp, 0.020000001_dp]   ! ln(phi_2/phi_1) on both sides of the switch
      real(dp) :: own(2), slope(2)
      integer :: k

      grid = new_line_grid(-1.0_dp, 1.0_dp, 2)
      x = new_face_flow(grid)
      y = x
      do k = 1, 2
         p(:, 0) = [0.0_dp, apart(k)/thickening, 0.0_dp]
         oil = oil_of(p, spread(spread(0.2_dp, 1, 3), 2, 1), .true.)
         call fit_faces(grid, lambdabar, oil, x, y)
         own(k) = x%own(0, 0)
         slope(k) = x%by_p1(0, 0)/p(1, 0)
      end do
      call test%check_close(own(1), own(2), 'mean on both sides of the switch', relative=2e-9_dp)
      call test%check_close(slope(1), slope(2), 'its derivative', relative=1e-8_dp)
      call test%check_close(own(1), (oil%fluidity(0, 0) + oil%fluidity(1, 0))*0.2_dp**3/lambdabar, 'averaged', relative=1e-4_dp)
   end subroutine check_alike

   !> Raised fluxes of a thin oil in a curved gap: their differences are the derivative of the flow at the nodes, of fourth
   !> order, along X and, on whole and half domains, along Y.
   subroutine check_order()
      call check_order_of(along_line, 'along X')
      call check_order_of(across_whole, 'along Y')
      call check_order_of(across_half, 'along Y from a line of symmetry')
   end subroutine check_order

   subroutine check_order_of(where_to, name)
      integer, intent(in) :: where_to
      character(len=*), intent(in) :: name
      real(dp) :: error(2)
      error = [largest_error(32, where_to), largest_error(64, where_to)]
      print '(a, f6.3)', 'measured: observed order of raised fluxes '//name//' ', log(error(1)/error(2))/log(2.0_dp)
      call test%check_close(log(error(1)/error(2))/log(2.0_dp), 4.0_dp, 'order of raised fluxes '//name, absolute=0.25_dp)
   end subroutine check_order_of

   !> Largest error of the derivative of the flow q = sin(2 X) in the gap 1 + 0.4 cos(3 X), on n cells, two nodes and more
   !> from the ends; the same along Y. P by Gauss's rule.
   real(dp) function largest_error(n, where_to)
      integer, intent(in) :: n, where_to
      real(dp), parameter :: place(3) = [-sqrt(0.6_dp), 0.0_dp, sqrt(0.6_dp)], weight(3) = [5, 8, 5]/18.0_dp
      integer, parameter :: across = 4          ! cells in the other direction
      type(grid_t) :: grid
      type(face_flow_t) :: x, y
      real(dp), allocatable :: at(:), flux(:), h(:), p(:)
      real(dp) :: size_of_cell
      integer :: first, i, j

      select case (where_to)
      case (along_line)
         grid = new_line_grid(-1.0_dp, 1.0_dp, n)
         allocate (at(n + 1), source=grid%x)
      case (across_whole)
         grid = new_grid(-1.0_dp, 1.0_dp, 1.0_dp, across, n, .false.)
         allocate (at(grid%ny + 1), source=grid%y)
      case (across_half)
         grid = new_grid(-1.0_dp, 1.0_dp, 1.0_dp, across, n, .true.)
         allocate (at(grid%ny + 1), source=grid%y)
      end select
      size_of_cell = merge(grid%hx, grid%hy, where_to == along_line)
      h = gap(at)
      allocate (p(size(at)), source=0.0_dp)
      do i = 2, size(at)
         associate (between => at(i) - 0.5_dp*size_of_cell*(1 - place))
            p(i) = p(i - 1) + lambdabar*size_of_cell*sum(weight*sin(2*between)/gap(between)**3)
         end associate
      end do
      x = new_face_flow(grid)
      y = x
      if (where_to == along_line) then
         call fit_faces(grid, lambdabar, oil_of(reshape(p, [n + 1, 1]), reshape(h, [n + 1, 1]), .false.), x, y)
         call raise_order(x, y, grid, reshape(h, [n + 1, 1]))
         flux = raised_row(x, 0)/(2*size_of_cell)
         first = 3
      else
         call fit_faces(grid, lambdabar, oil_of(spread(p, 1, across + 1), spread(h, 1, across + 1), .false.), x, y)
         call raise_order(x, y, grid, spread(h, 1, across + 1))
         flux = [(value_of(raised_across(y, j)), j=0, grid%ny - 1)]/(2*size_of_cell)
         first = merge(1, 3, where_to == across_half)
      end if
      associate (last => size(at) - 4)
         largest_error = maxval(abs((flux(first + 1:last + 1) - flux(first:last))/size_of_cell - 2*cos(2*at(first + 1:last + 1))))
      end associate
      if (where_to == across_half) largest_error = max(largest_error, abs(2*flux(1)/size_of_cell - 2))
   end function largest_error

   !> Flux in the middle of a row.
   pure real(dp) function value_of(row)
      real(dp), intent(in) :: row(0:)
      value_of = row(ubound(row, 1)/2)
   end function value_of

   elemental real(dp) function gap(x)
      real(dp), intent(in) :: x
      gap = 1 + 0.4_dp*cos(3*x)
   end function gap

end program test_fitted_flux
