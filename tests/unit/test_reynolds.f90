!> Jacobian product of the Reynolds equation, real and complex, against finite differences of its residual.
program test_reynolds
   use ehlwave_carreau_law, only: new_carreau_law
   use ehlwave_complex_wedge, only: complex_wedge_t => wedge_t, new_wedge
   use ehlwave_conditions, only: conditions_t
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_equations, only: equations_t
   use ehlwave_eyring_law, only: eyring_law_t
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_given, only: given_t, steady_given
   use ehlwave_kinds, only: dp
   use ehlwave_oil, only: barus, roelands
   use ehlwave_reynolds, only: reynolds_change
   use ehlwave_rheology, only: rheology_t
   use ehlwave_state, only: new_state, state_t
   use ehlwave_text, only: to_text
   use ehlwave_transport, only: characteristic_transport
   use sample_contact, only: bump_pressure, make_contact, noise
   use testing, only: test_t
   implicit none (type, external)

   integer, parameter :: steady = 0
   type(test_t) :: test
   logical :: is_half
   integer :: n

   do n = 0, 1
      is_half = n == 1
      call check_jacobian(1.0_dp, is_half, roelands, steady)
      call check_jacobian(0.12_dp, is_half, roelands, 1)
      call check_jacobian(0.12_dp, is_half, barus, 2)
      call check_jacobian(1.0_dp, is_half, barus, steady)
      call check_jacobian(1.0_dp, is_half, roelands, steady, is_fitted=.true.)
      call check_jacobian(0.12_dp, is_half, roelands, 1, is_fitted=.true.)
      call check_jacobian(0.12_dp, is_half, barus, 2, is_fitted=.true.)
      call check_jacobian(1.0_dp, is_half, roelands, steady, eyring_law_t())
      call check_jacobian(0.35_dp, is_half, roelands, 1, new_carreau_law(0.4_dp))
      call check_jacobian(1.0_dp, is_half, roelands, steady, eyring_law_t(), is_fitted=.true.)
      call check_jacobian(0.35_dp, is_half, roelands, 1, new_carreau_law(0.4_dp), is_fitted=.true.)
   end do
   call check_uniform_flow()
   call compare_half_with_whole()
   call test%finish()

contains

   !> Residual with the film that belongs to a pressure and an approach.
   subroutine residual_of(problem, given, equations, p, delta, r)
      type(contact_problem_t), intent(inout) :: problem
      type(given_t), intent(in) :: given
      type(equations_t), intent(inout) :: equations
      real(dp), intent(in) :: p(0:, 0:)
      real(dp), intent(in) :: delta
      real(dp), intent(out) :: r(0:, 0:)
      type(state_t) :: state
      state = new_state(problem%grid)
      state%p = p
      call problem%smooth_film(p, delta, state%h)
      call equations%evaluate(problem, given, state)
      r = equations%residual
   end subroutine residual_of

   subroutine check_jacobian(d, is_half, law, cells_per_step, flow_law, is_fitted)
      real(dp), intent(in) :: d
      logical, intent(in) :: is_half
      character(len=*), intent(in) :: law
      integer, intent(in) :: cells_per_step
      class(flow_law_t), intent(in), optional :: flow_law   !! flow law of an oil that is not Newtonian, S = 1.4
      logical, intent(in), optional :: is_fitted            !! scheme; absent: averaged
      type(contact_problem_t) :: problem
      type(conditions_t) :: conditions
      type(rheology_t) :: oil
      type(equations_t) :: equations
      type(given_t) :: given
      real(dp), parameter :: step = 1e-6_dp, delta = -0.2_dp, ddelta = 0.3_dp
      real(dp), allocatable, dimension(:, :) :: change, dh, down, dr, expected, p, up
      real(dp), allocatable :: history(:, :, :)
      character(len=:), allocatable :: what
      integer :: i, j

      call make_contact(problem, 100.0_dp, d, 24, 16, is_half, law)
      what = 'Jacobian, D = '//to_text(d, 3)//', '//law//', half '//to_text(is_half)//', step '// &
             to_text(cells_per_step)
      if (present(is_fitted)) then
         what = what//', fitted'
         problem%grid%is_fitted = is_fitted
      end if
      if (present(flow_law)) then
         what = what//', not Newtonian'
         oil = problem%rheology
         call oil%use_flow(flow_law, 226e9_dp*5e6_dp)
         conditions = problem%conditions
         conditions%slip_parameter = 1.4_dp
         call problem%set_conditions(conditions, oil)
      end if
      given = steady_given(problem%grid)
      associate (grid => problem%grid)
         if (cells_per_step > 0) then
            given%transport = characteristic_transport(grid, cells_per_step, 1)
            allocate (history(0:grid%nx, 0:grid%ny, given%transport%history_length()), source=0.3_dp)
            call given%transport%carry(grid, history)
         end if
         allocate (p(0:grid%nx, 0:grid%ny), source=0.0_dp)
         p = 0.5_dp*bump_pressure(grid)
         allocate (dh, dr, down, expected, up, change, source=p)
         change = 0
         do j = grid%first_row, grid%last_row
            do i = 1, grid%nx - 1
               change(i, j) = noise(i, j)*p(i, j)
            end do
         end do
         call equations%init(problem)
         call residual_of(problem, given, equations, p - step*change, delta - step*ddelta, down)
         call residual_of(problem, given, equations, p + step*change, delta + step*ddelta, up)
         expected = (up - down)/(2*step)
         call residual_of(problem, given, equations, p, delta, dr)
         call problem%deformation%apply(change, dh)
         dh = dh - ddelta
         call reynolds_change(equations%mesh, given%transport, equations%flow, change, dh, dr)
         dr = dr*equations%scale
         expected = expected*equations%scale
         call test%check_close(reshape(dr, [size(dr)]), reshape(expected, [size(dr)]), what, &
                               absolute=1e-7_dp*maxval(abs(expected)))
         call test%check(maxval(abs(expected)) > 1e-3_dp, what//' is not zero')
         call check_order(problem, given, p, delta, change, ddelta, dr, what)
         call check_complex(equations, given, change, dh, dr, what)
         call test%check(all(equations%scale(1:grid%nx - 1, grid%first_row:grid%last_row) > 0) .and. &
                         all(abs(equations%scale(0, :)) <= 0), 'scale is positive at unknown nodes only')
      end associate
   end subroutine check_jacobian

   !> Taylor test: the difference between product and change of the residual shrinks with the square of the step.
   subroutine check_order(problem, given, p, delta, change, ddelta, product, what)
      type(contact_problem_t), intent(inout) :: problem
      type(given_t), intent(in) :: given
      real(dp), intent(in) :: p(0:, 0:), change(0:, 0:), delta, ddelta   !! state, and the change of it
      real(dp), intent(in) :: product(0:, 0:)                            !! times the scale at the state
      character(len=*), intent(in) :: what
      type(equations_t) :: equations
      real(dp), dimension(0:ubound(p, 1), 0:ubound(p, 2)) :: at_state, moved, scale
      real(dp) :: left(2), order
      real(dp), parameter :: steps(2) = [2e-4_dp, 1e-4_dp]
      integer :: k

      call equations%init(problem)
      call residual_of(problem, given, equations, p, delta, at_state)
      scale = equations%scale
      do k = 1, 2
         call residual_of(problem, given, equations, p + steps(k)*change, delta + steps(k)*ddelta, moved)
         left(k) = norm2(scale*(moved - at_state) - steps(k)*product)
      end do
      order = log(left(1)/left(2))/log(2.0_dp)
      call test%check_close(order, 2.0_dp, what//', observed order', absolute=0.05_dp)
      print '(a, f6.3)', 'measured: '//what//': observed order', order
   end subroutine check_order

   !> The complex product with real weights is the product of both parts.
   subroutine check_complex(equations, given, change, dh, scaled, what)
      type(equations_t), intent(in) :: equations
      type(given_t), intent(in) :: given
      real(dp), intent(in) :: change(0:, 0:), dh(0:, 0:)
      real(dp), intent(in) :: scaled(0:, 0:)   !! the real product times the scale
      character(len=*), intent(in) :: what
      complex(dp), parameter :: factor = (0.6_dp, -1.7_dp)
      type(complex_wedge_t) :: wedge
      complex(dp) :: dr(0:ubound(change, 1), 0:ubound(change, 2))

      wedge = new_wedge(ubound(change, 1))
      wedge%w0 = given%transport%w0
      wedge%w1 = given%transport%w1
      wedge%w2 = given%transport%w2
      if (allocated(given%transport%w3)) &
         allocate (wedge%w3(0:ubound(change, 1)), source=cmplx(given%transport%w3, kind=dp))
      call reynolds_change(equations%mesh, wedge, equations%flow, factor*change, factor*dh, dr)
      call test%check_close(maxval(abs(dr*equations%scale - factor*scaled))/maxval(abs(scaled)), 0.0_dp, what//', complex', &
                            absolute=1e-12_dp)
   end subroutine check_complex

   !> Without pressure gradients only the wedge is left: H = x, rho = 1 gives R = -1.
   subroutine check_uniform_flow()
      type(contact_problem_t) :: problem
      type(equations_t) :: equations
      type(state_t) :: state

      call make_contact(problem, 100.0_dp, 1.0_dp, 16, 16, .false.)
      associate (grid => problem%grid)
         state = new_state(grid)
         state%h = spread(3 + grid%x, 2, grid%ny + 1)
         call equations%init(problem)
         call equations%evaluate(problem, steady_given(grid), state)
         associate (r => equations%residual)
            call test%check_close(reshape(r(1:15, 1:15), [225]), spread(-1.0_dp, 1, 225), 'wedge alone', absolute=1e-12_dp)
            call test%check(all(abs(r(0, :)) <= 0) .and. all(abs(r(:, 16)) <= 0), 'zero on the boundary')
         end associate
      end associate
   end subroutine check_uniform_flow

   subroutine compare_half_with_whole()
      type(contact_problem_t) :: half, whole
      type(equations_t) :: equations
      real(dp), allocatable, dimension(:, :) :: on_half, on_whole

      call make_contact(half, 100.0_dp, 0.35_dp, 24, 16, .true.)
      call make_contact(whole, 100.0_dp, 0.35_dp, 24, 16, .false.)
      allocate (on_half(0:24, 0:8), on_whole(0:24, 0:16))
      call equations%init(half)
      call residual_of(half, steady_given(half%grid), equations, 0.5_dp*bump_pressure(half%grid), -0.2_dp, on_half)
      call equations%init(whole)
      call residual_of(whole, steady_given(whole%grid), equations, 0.5_dp*bump_pressure(whole%grid), -0.2_dp, on_whole)
      call test%check_close(reshape(on_half, [225]), reshape(on_whole(:, 8:), [225]), 'half against whole', &
                            absolute=1e-12_dp*maxval(abs(on_whole)))
   end subroutine compare_half_with_whole

end program test_reynolds
