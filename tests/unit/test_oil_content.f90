!> A gap that is not full everywhere: its linearised equations against finite differences, and the oil it keeps.
program test_oil_content
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_cycle_settings, only: newton_cycle
   use ehlwave_equations, only: equations_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_given, only: given_t
   use ehlwave_inlet_oil, only: inlet_oil_t
   use ehlwave_kinds, only: dp
   use ehlwave_meniscus, only: fill_ahead, hold_empty, is_full_to_edge
   use ehlwave_oil_passage, only: follow_oil, oil_passage_t
   use ehlwave_real_linearised_contact, only: linearised_contact_t, set_wedge
   use ehlwave_rescue, only: rescue_t
   use ehlwave_solve_report, only: solve_limits_t
   use ehlwave_starvation, only: flooded_t, starve
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged
   use ehlwave_text, only: to_text
   use ehlwave_transport, only: characteristic_transport
   use sample_contact, only: make_multigrid, noise
   use testing, only: test_t
   implicit none (type, external)

   integer, parameter :: cells = 64
   real(dp), parameter :: tolerance = 1e-9_dp   ! tolerance of solutions: also of pressures that are to vanish
   type(test_t) :: test
   real(dp) :: amount(2)
   integer :: n

   amount = [0.5_dp, 1.2_dp]
   do n = 1, size(amount)
      call check_contact(amount(n), n == 1)
   end do
   call profile()
   call check_means()
   call check_lanes()
   call test%finish()

contains

   subroutine check_contact(r, is_half)
      real(dp), intent(in) :: r        !! oil offered over the flow of the flooded contact
      logical, intent(in) :: is_half
      type(full_multigrid_t) :: multigrid
      type(rescue_t) :: rescue
      type(flooded_t) :: flooded
      type(solve_limits_t) :: limits
      character(len=:), allocatable :: what
      integer :: l

      what = 'r = '//to_text(r, 2)//', '
      limits = solve_limits_t(tolerance=tolerance)
      call make_multigrid(multigrid, 100.0_dp, 0.6_dp, cells, is_half)
      call multigrid%solve(limits, 1e-5_dp)
      call starve(rescue, multigrid, inlet_oil_t(over_flooded=r), limits, 1e-5_dp, flooded)
      l = size(multigrid%levels)
      call test%check(multigrid%levels(l)%report%status == status_converged, what//'converged')
      call check_passage(multigrid, what)
      call check_state(multigrid, what)
      call check_jacobian(multigrid, what//'steady: ')
      call check_filling(multigrid, what)
      call check_holding(multigrid, what)
      call check_step(multigrid, what)
      call check_jacobian(multigrid, what//'time step: ')
   end subroutine check_contact

   !> Inflow equals outflow, and no more than the supply.
   subroutine check_passage(multigrid, what)
      type(full_multigrid_t), intent(in) :: multigrid
      character(len=*), intent(in) :: what
      type(oil_passage_t) :: passage

      associate (level => multigrid%levels(size(multigrid%levels)))
         call follow_oil(level%problem, level%given, level%state, passage)
         call test%check(passage%balance_error < 1e-7_dp, what//'balance of the oil')
         call test%check(all(passage%content <= 1) .and. minval(passage%content) > 0, what//'content')
         call test%check(passage%meniscus_x > level%problem%grid%x(0) .and. passage%meniscus_x < -1, what//'meniscus')
      end associate
   end subroutine check_passage

   !> P >= 0, theta <= 1, P (1 - theta) = 0.
   subroutine check_state(multigrid, what)
      type(full_multigrid_t), intent(in) :: multigrid
      character(len=*), intent(in) :: what
      type(equations_t) :: equations

      associate (level => multigrid%levels(size(multigrid%levels)))
         call equations%init(level%problem)
         call equations%evaluate(level%problem, level%given, level%state)
         associate (c => equations%content, flow => equations%flow)
            call test%check(minval(level%state%p) >= 0, what//'pressure')
            call test%check(any(c%is_partial) .and. .not. all(c%is_partial), what//'both kinds of nodes')
            call test%check(maxval(abs(level%state%p), mask=c%is_partial) <= tolerance, &
                            what//'no pressure where not full')
         end associate
      end associate
   end subroutine check_state

   !> A step that makes nodes overflow fills them, at pressures that leave little of the imbalance; one that lowers the
   !> pressure fills nothing.
   subroutine check_filling(multigrid, what)
      type(full_multigrid_t), intent(inout) :: multigrid
      character(len=*), intent(in) :: what
      type(equations_t) :: filled, overfull, solved
      type(state_t) :: state
      real(dp), allocatable :: change(:, :), step(:, :)
      integer :: j

      associate (level => multigrid%levels(size(multigrid%levels)))
         call solved%init(level%problem)
         call solved%evaluate(level%problem, level%given, level%state)
         step = level%state%p
         do j = 0, ubound(step, 2)
            step(:, j) = merge(3*step(:, j), 0.0_dp, level%problem%grid%x < -1)
         end do
         change = -0.3_dp*step
         call fill_ahead(solved, level%state, change)
         call test%check_close([change], [-0.3_dp*step], what//'less pressure fills nothing', absolute=0.0_dp)
         change = step
         call fill_ahead(solved, level%state, change)
         call test%check(all(abs(change - step) <= 0 .or. solved%content%is_partial), what//'full nodes keep their step')
         state = level%state
         state%p = level%state%p + step
         call overfull%init(level%problem)
         call overfull%evaluate(level%problem, level%given, state)
         state%p = level%state%p + change
         call filled%init(level%problem)
         call filled%evaluate(level%problem, level%given, state)
         associate (were_empty => solved%content%is_partial)
            call test%check(count(change > step) > 0 .and. .not. any(filled%content%is_partial .and. change > step), &
                            what//'filled nodes are full')
            call test%check(maxval(abs(filled%residual), mask=were_empty) < &
                            0.7_dp*maxval(abs(overfull%residual), mask=were_empty), what//'and take what overflows')
         end associate
      end associate
   end subroutine check_filling

   !> Held, the empty part has no pressure, and the other nodes have the equations of a full gap.
   subroutine check_holding(multigrid, what)
      type(full_multigrid_t), intent(inout) :: multigrid
      character(len=*), intent(in) :: what
      type(equations_t) :: full, held
      type(given_t) :: without

      associate (level => multigrid%levels(size(multigrid%levels)))
         call held%init(level%problem)
         call held%evaluate(level%problem, level%given, level%state)
         call test%check(.not. is_full_to_edge(held), what//'a meniscus away from the edge')
         call hold_empty(level)
         call held%evaluate(level%problem, level%given, level%state)
         without = level%given
         deallocate (without%supply, without%is_empty)
         call full%init(level%problem)
         call full%evaluate(level%problem, without, level%state)
         call test%check(.not. allocated(held%content) .and. &
                         all(held%is_cavitated .eqv. (full%is_cavitated .or. level%given%is_empty)), &
                         what//'held nodes are cavitated')
         call test%check(any(level%given%is_empty) .and. &
                         maxval(level%state%p, mask=level%given%is_empty) <= 0, what//'no pressure in them')
         call test%check_close([held%residual], [full%residual], what//'the others as in a full gap', absolute=0.0_dp)
         deallocate (level%given%is_empty)
      end associate
   end subroutine check_holding

   !> Set the problem of a time step with a changed gap.
   subroutine check_step(multigrid, what)
      type(full_multigrid_t), intent(inout) :: multigrid
      character(len=*), intent(in) :: what
      type(equations_t) :: equations
      real(dp), allocatable :: history(:, :, :), steady(:, :)

      associate (level => multigrid%levels(size(multigrid%levels)))
         associate (grid => level%problem%grid, given => level%given)
            call equations%init(level%problem)
            call equations%evaluate(level%problem, given, level%state)
            allocate (history(0:grid%nx, 0:grid%ny, 2), steady(0:grid%nx, 0:grid%ny))
            steady = equations%residual
            call equations%content%history_of(equations%flow%rho*level%state%h, history(:, :, 1), &
                                              history(:, :, 2))
            given%transport = characteristic_transport(grid, 1, 1)
            call given%transport%carry_content(grid, history)
            call equations%evaluate(level%problem, given, level%state)
            call test%check_close([equations%residual], [steady], what//'a steady state stays in time', &
                                  absolute=1e-11_dp)
         end associate
      end associate
   end subroutine check_step

   !> Products with the Jacobian, contents eliminated, against differences of the residual.
   subroutine check_jacobian(multigrid, what)
      type(full_multigrid_t), intent(inout) :: multigrid
      character(len=*), intent(in) :: what
      type(linearised_contact_t) :: linear
      type(given_t) :: given
      type(state_t) :: state
      type(equations_t) :: down, up
      real(dp), parameter :: step = 1e-7_dp, ddelta = 0.02_dp
      real(dp), allocatable :: expected(:, :)
      real(dp), allocatable, target :: x(:), y(:)
      integer :: i, j, l

      l = size(multigrid%levels)
      given = multigrid%levels(l)%given
      state = multigrid%levels(l)%state
      associate (problem => multigrid%levels(l)%problem, grid => multigrid%levels(l)%problem%grid)
         call linear%init(multigrid%levels, newton_cycle)
         call linear%borrow(multigrid%levels)
         call linear%start(l)
         call set_wedge(linear, given%transport)
         call linear%levels(l)%equations%evaluate(problem, given, state)
         call linear%weigh(l)
         allocate (x(linear%n), y(linear%n), source=0.0_dp)
         associate (partial => linear%levels(l)%equations%is_cavitated, scale => linear%levels(l)%row_scale)
            do j = grid%first_row, grid%last_row
               do i = 1, grid%nx - 1
                  if (.not. partial(i, j)) x(1 + i + j*(grid%nx + 1)) = 0.01_dp*noise(i, j)*state%p(i, j)
               end do
            end do
            x(linear%n) = ddelta
            call linear%multiply(x, y)
            call residual_at(problem, given, state, x, -step, down)
            call residual_at(problem, given, state, x, step, up)
            call test%check(all(down%is_cavitated .eqv. partial) .and. all(up%is_cavitated .eqv. partial), &
                            what//'the same nodes are full')
            expected = scale*(up%residual - down%residual)/(2*step)
            where (partial) expected = 0
            call test%check_close(y(:linear%n - 1), [expected], what//'Jacobian', &
                                  absolute=1e-5_dp*maxval(abs(expected)))
         end associate
         call linear%release()
      end associate

   end subroutine check_jacobian

   !> Residuals of a state changed by a share of x.
   subroutine residual_at(problem, given, state, x, share, equations)
      type(contact_problem_t), intent(inout) :: problem
      type(given_t), intent(in) :: given
      type(state_t), intent(in) :: state
      real(dp), intent(in) :: x(:), share
      type(equations_t), intent(out) :: equations
      type(state_t) :: moved

      moved = state
      moved%p = state%p + share*reshape(x(:size(x) - 1), shape(state%p))
      moved%delta = state%delta + share*x(size(x))
      call problem%film(given, moved%p, moved%delta, moved%h)
      call equations%init(problem)
      call equations%evaluate(problem, given, moved)
   end subroutine residual_at

   !> A layer that varies across, between its places and beyond them, and its mirror image.
   subroutine profile()
      type(full_multigrid_t) :: multigrid
      type(inlet_oil_t) :: oil
      real(dp) :: expected

      call make_multigrid(multigrid, 100.0_dp, 1.0_dp, 32, .false.)
      oil = inlet_oil_t(over_flooded=2.0_dp, y=[0.0_dp, 1.0_dp], share=[0.5_dp, 1.0_dp])
      associate (grid => multigrid%levels(size(multigrid%levels))%problem%grid)
         associate (supply => oil%supply_on(grid, 0.1_dp))
            expected = 0.2_dp*0.75_dp   ! linear about this row: its mean is its value
            call test%check_close(supply(1 + minloc(abs(grid%y - 0.5_dp), 1) - 1), expected, 'between two places', &
                                  absolute=1e-12_dp)
            call test%check_close(supply(1), 0.2_dp, 'beyond the last place, mirrored', absolute=1e-12_dp)
         end associate
      end associate
   end subroutine profile

   !> Means of a profile over cells are exact: a spike and a dry lane far narrower than a cell count with all their oil.
   subroutine check_means()
      real(dp), parameter :: narrow = 1e-3_dp
      type(full_multigrid_t) :: multigrid
      type(inlet_oil_t) :: even, odd
      real(dp), allocatable :: supply(:)

      call make_multigrid(multigrid, 100.0_dp, 1.0_dp, 32, .false.)
      odd = inlet_oil_t(over_flooded=1.0_dp, y=[-9.0_dp, 0.3_dp - narrow, 0.3_dp, 0.3_dp + narrow, 9.0_dp], &
                        share=[1.0_dp, 1.0_dp, 501.0_dp, 1.0_dp, 1.0_dp])
      even = inlet_oil_t(over_flooded=1.0_dp, y=[0.0_dp, narrow, 2*narrow, 9.0_dp], share=[0.0_dp, 0.0_dp, 1.0_dp, 1.0_dp])
      associate (grid => multigrid%levels(size(multigrid%levels))%problem%grid)
         supply = odd%supply_on(grid, 1.0_dp)
         call test%check_close(sum(supply - 1)*grid%hy, 500*narrow, 'oil of a spike', relative=1e-10_dp)
         supply = even%supply_on(grid, 1.0_dp)
         call test%check_close(sum(1 - supply)*grid%hy, 3*narrow, 'oil that a dry lane lacks', relative=1e-10_dp)
         call test%check_close(minval(supply), 1 - 3*narrow/grid%hy, 'the cell about the lane', relative=1e-10_dp)
      end associate
      call test%check_close(even%mean_share(-narrow, -narrow), 0.0_dp, 'a cell of no width', absolute=0.0_dp)
      call test%check_close(even%mean_share(-narrow, narrow), 0.0_dp, 'dry cells are dry exactly', absolute=0.0_dp)
      call test%check_close(even%mean_share(-3*narrow, 2*narrow), 0.4_dp, 'both sides of the mirror', relative=1e-12_dp)
   end subroutine check_means

   !> The narrowest ridge or dry lane that a grid has to resolve.
   subroutine check_lanes()
      type(inlet_oil_t) :: oil
      oil = inlet_oil_t(over_flooded=1.0_dp, y=[0.0_dp, 1.0_dp], share=[0.5_dp, 1.0_dp])
      call check(oil, 1.0_dp, 'the valley at the mirror')
      oil%share = 1
      call check(oil, huge(1.0_dp)/2, 'an even layer', is_least=.true.)
      oil = inlet_oil_t(over_flooded=1.0_dp, y=[-1.0_dp, 0.2_dp, 0.21_dp, 0.3_dp, 0.31_dp, 2.0_dp], &
                        share=[1.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, 1.0_dp])
      call check(oil, 0.1_dp, 'a dry lane')
      oil = inlet_oil_t(over_flooded=1.0_dp, y=[-1.0_dp, 0.0_dp, 0.01_dp, 0.02_dp, 0.03_dp, 0.04_dp, 1.0_dp], &
                        share=[1.0_dp, 1.0_dp, 1.5_dp, 2.0_dp, 1.5_dp, 1.0_dp, 1.0_dp])
      call check(oil, 0.02_dp, 'a spike with two places on each side')
      oil%share = [1.0_dp, 1.0_dp, 1.02_dp, 1.04_dp, 1.02_dp, 1.0_dp, 1.0_dp]
      call check(oil, huge(1.0_dp)/2, 'a spike too low to count', is_least=.true.)
      oil = inlet_oil_t(over_flooded=1.0_dp, y=[0.0_dp, 0.05_dp, 0.06_dp, 1.0_dp], share=[0.0_dp, 0.0_dp, 1.0_dp, 1.0_dp])
      call check(oil, 0.11_dp, 'a dry lane about the mirror')
      oil = inlet_oil_t(over_flooded=1.0_dp, y=[-1.0_dp, 5.0_dp, 5.01_dp, 5.02_dp, 6.0_dp], &
                        share=[1.0_dp, 1.0_dp, 0.0_dp, 1.0_dp, 1.0_dp])
      call check(oil, huge(1.0_dp)/2, 'a lane outside the domain', is_least=.true.)
   end subroutine check_lanes

   subroutine check(oil, expected, what, is_least)
      type(inlet_oil_t), intent(in) :: oil
      real(dp), intent(in) :: expected
      character(len=*), intent(in) :: what
      logical, intent(in), optional :: is_least
      real(dp) :: width
      width = oil%narrowest_lane(3.0_dp, 0.05_dp)
      if (present(is_least)) call test%check(width >= expected, what)
      if (.not. present(is_least)) call test%check_close(width, expected, what, relative=1e-9_dp)
   end subroutine check

end program test_oil_content
