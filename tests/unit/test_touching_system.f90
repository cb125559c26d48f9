!> The linear system of contacts whose surfaces touch: products against differences of the residuals, its solution, and
!> the transposed system; first guesses of steps, and of the pressure of soft solids.
program test_touching_system
   use ehlwave_conditions, only: conditions_t
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_given, only: given_t, steady_given
   use ehlwave_grid, only: new_grid, new_line_grid
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_real_gmres, only: gmres_t, norm
   use ehlwave_touching_adjoint, only: solve_adjoint
   use ehlwave_touching_change, only: new_change, touching_change_t
   use ehlwave_touching_equations, only: touching_equations_t, touching_past_t
   use ehlwave_touching_newton, only: exact
   use ehlwave_touching_state, only: hertz_state, touching_law_t, touching_state_t
   use ehlwave_touching_system, only: touching_system_t
   use ehlwave_touching_transposed, only: touching_transposed_t
   use sample_contact, only: make_conditions, make_rheology, noise
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: step = 1e-6_dp
   type(test_t) :: test
   type(contact_problem_t), target :: problem
   type(touching_equations_t), target :: equations
   type(touching_past_t) :: past
   type(touching_state_t), target :: state
   type(touching_system_t) :: system
   type(touching_transposed_t) :: transposed
   type(touching_law_t) :: law
   type(given_t) :: given

   call check('steady line', is_line=.true., marches=.false., is_half=.false.)
   call check('marched line', is_line=.true., marches=.true., is_half=.false.)
   call check('steady line of soft solids', is_line=.true., marches=.false., is_half=.false., is_soft=.true.)
   call check('steady ellipse', is_line=.false., marches=.false., is_half=.true.)
   call check('marched ellipse', is_line=.false., marches=.true., is_half=.false.)
   call check_kept_factors()
   call check_meshes()
   call check_guess()
   call check_soft_guess()
   call test%finish()

contains

   subroutine check(name, is_line, marches, is_half, is_soft)
      character(len=*), intent(in) :: name
      logical, intent(in) :: is_line, marches, is_half
      logical, intent(in), optional :: is_soft
      type(touching_change_t) :: sides
      type(gmres_t) :: gmres
      real(dp), allocatable :: b(:), x(:), y(:)

      call make_state(is_line, marches, is_half, is_soft)
      call equations%evaluate(problem, law, given, past, state)
      call equations%linearise(past, state)
      sides = new_change(problem%grid)
      call system%pose(problem, law, equations, .not. marches, state, sides)
      allocate (b(system%unknowns%n), x(system%unknowns%n), y(system%unknowns%n))
      sides%p = equations%residual
      sides%delta = 0.1_dp
      where (state%is_touching) sides%c = noise(size(sides%c, 1), size(sides%c, 2))
      call system%unknowns%residuals(sides, b)
      gmres%largest_steps = 80
      call gmres%solve(system, b, x, 1e-9_dp)
      call test%check(gmres%reduction <= 1e-9_dp, name//': solved in 80 steps')
      call system%multiply(x, y)
      call test%check(norm(y - b) <= 1e-8_dp*norm(b), name//': the solution solves the system, beyond single precision')
      call shorten(x)
      call system%multiply(x, y)
      call compare(name, x, y)
      if (.not. marches) call check_transposed(name, x, y)
      call system%release()
   end subroutine check

   !> With the factors of another state of the same sets the system has the same solution.
   subroutine check_kept_factors()
      type(touching_change_t) :: sides
      type(gmres_t) :: gmres
      real(dp), allocatable :: b(:), kept(:), x(:)

      call make_state(is_line=.false., marches=.true., is_half=.false.)
      sides = new_change(problem%grid)
      call equations%evaluate(problem, law, given, past, state)
      call equations%linearise(past, state)
      call system%pose(problem, law, equations, .false., state, sides)
      where (.not. state%is_cavitated) state%p = 1.02_dp*state%p
      call equations%evaluate(problem, law, given, past, state)
      call equations%linearise(past, state)
      allocate (b(system%unknowns%n), kept(system%unknowns%n), x(system%unknowns%n))
      sides%p = equations%residual
      call system%unknowns%residuals(sides, b)
      call system%pose(problem, law, equations, .false., state, sides, keeps_factors=.true.)
      call gmres%solve(system, b, kept, 1e-10_dp)
      call system%release()
      call system%pose(problem, law, equations, .false., state, sides)
      call gmres%solve(system, b, x, 1e-10_dp)
      call system%release()
      call test%check(norm(x - kept) <= 1e-7_dp*norm(x), 'solution with kept factors')
   end subroutine check_kept_factors

   !> Meshes four times finer take about as many steps, solids or not.
   subroutine check_meshes()
      type(touching_change_t) :: sides
      type(gmres_t) :: gmres
      real(dp), allocatable :: b(:), x(:)
      integer :: n, steps(2)
      logical :: is_half

      do n = 1, 4
         is_half = n > 2
         call make_state(is_line=.false., marches=.true., is_half=is_half, refinement=merge(1, 4, modulo(n, 2) == 1))
         call equations%evaluate(problem, law, given, past, state)
         call equations%linearise(past, state)
         sides = new_change(problem%grid)
         sides%p = equations%residual
         call system%pose(problem, law, equations, .false., state, sides)
         if (allocated(b)) deallocate (b, x)
         allocate (b(system%unknowns%n), x(system%unknowns%n))
         call system%unknowns%residuals(sides, b)
         call gmres%solve(system, b, x, 1e-4_dp)
         call system%release()
         steps(2 - modulo(n, 2)) = gmres%steps
         if (modulo(n, 2) == 1) cycle
         print '(a, 2i4)', 'Steps on two meshes:', steps
         call test%check(maxval(steps) <= 12 .and. steps(2) <= steps(1) + 3, 'few steps on all meshes')
      end do
   end subroutine check_meshes

   !> A disturbance of a steady state is found a cell further: pressures, contents and sets.
   subroutine check_guess()
      type(touching_state_t) :: moved, wanted

      call make_state(is_line=.false., marches=.false., is_half=.false.)
      moved = state
      wanted = state
      moved%p(10, 8) = moved%p(10, 8) + 0.2_dp
      wanted%p(11, 8) = wanted%p(11, 8) + 0.2_dp
      associate (at => findloc(state%is_touching(:, 12), .true., 1) - 1)   ! a node ahead of those that bear
         moved%is_touching(at - 2, 12) = .true.
         moved%c(at - 2, 12) = 0.3_dp
         wanted%is_touching(at - 1, 12) = .true.
         wanted%c(at - 1, 12) = 0.3_dp
      end associate
      call moved%move_on(state)
      call test%check(maxval(abs(moved%p - wanted%p)) < 1e-12_dp, 'guess of the pressure of the oil')
      call test%check(maxval(abs(moved%c - wanted%c)) < 1e-12_dp, 'guess of the pressure of the solids')
      call test%check(maxval(abs(moved%theta - wanted%theta)) < 1e-12_dp, 'guess of the content')
      call test%check(all(moved%is_touching .eqv. wanted%is_touching), 'guess of the nodes that bear')
      call test%check(all(moved%is_cavitated .eqv. wanted%is_cavitated), 'guess of the broken film')
   end subroutine check_guess

   !> Soft solids far below the boundary film: the law, but finite.
   subroutine check_soft_guess()
      type(touching_law_t) :: soft
      soft = touching_law_t(film=0.1_dp, is_soft=.true., softness=1e-3_dp, stress=0.3_dp)
      call test%check_close(soft%first_pressure(0.098_dp), 0.3_dp*exp(2.0_dp), 'soft solids', relative=1e-12_dp)
      call test%check(soft%first_pressure(-2.0_dp) < 1e30_dp, 'soft solids far below the boundary film')
   end subroutine check_soft_guess

   !> The transposed preconditioned product and solution, about the state of the system; x and y = A x.
   subroutine check_transposed(name, x, y)
      character(len=*), intent(in) :: name
      real(dp), intent(in) :: x(:)
      real(dp), intent(inout) :: y(:)
      type(touching_change_t) :: sides
      type(gmres_t) :: gmres
      real(dp), allocatable :: at(:), image(:), m(:), right(:)
      real(dp) :: work
      integer :: i
      logical :: is_solved

      call equations%evaluate(problem, law, given, past, state)
      call equations%linearise(past, state)
      sides = new_change(problem%grid)
      sides%seeks_speed = .true.
      sides%by_speed = noise(size(state%p, 1), size(state%p, 2))
      call system%pose(problem, law, equations, .true., state, sides)
      call transposed%init(problem)
      call transposed%pose(problem, law, equations, .true., state, sides)
      call transposed%set_edges(problem%edges, given, state)
      allocate (at(size(x)), image(size(x)), m(size(x)), right(size(x)))
      image = [(sin(7.0_dp*i), i=1, size(x))]
      call transposed%multiply(image, at)
      call system%precondition(y, m)
      call system%multiply(m, right)
      call test%check_close(dot_product(at, y), dot_product(right, image), name//': transposed preconditioned product', &
                            absolute=1e-4_dp*norm(right)*norm(image))
      call system%multiply(x, m)
      right = m
      right(size(state%p) + 1:) = 0.1_dp
      problem%deformation%work = 0
      call gmres%solve(system, m, y, exact)
      work = problem%deformation%work
      problem%deformation%work = 0
      call solve_adjoint(transposed, gmres, right, at, is_solved, exact)
      print '(2a, f6.2)', name, ': work of a transposed solve over a direct one:', problem%deformation%work/work
      call test%check(is_solved .and. problem%deformation%work <= 1.6_dp*work, name//': it costs at most 1.6 direct ones')
      call solve_adjoint(transposed, gmres, right, at, is_solved, 1e-11_dp)
      call test%check(is_solved, name//': transposed system solved')
      call test%check_close(dot_product(at, m), dot_product(x, right), name//': transposed solution', relative=1e-7_dp)
   end subroutine check_transposed

   !> Unknowns of a random change, in the form of a solution.
   subroutine shorten(x)
      real(dp), intent(inout), contiguous, target :: x(:)
      real(dp), pointer, contiguous :: u(:, :)
      integer :: k
      u(0:problem%grid%nx, 0:problem%grid%ny) => x(:size(state%p))
      u = 0
      associate (grid => problem%grid)
         u(1:grid%nx - 1, grid%first_row:grid%last_row) = noise(grid%nx - 1, grid%last_row - grid%first_row + 1)
      end associate
      do k = size(state%p) + 1, size(x)
         x(k) = 0.01_dp*modulo(k, 7)
         if (.not. law%is_soft .or. k > size(x) - 2) cycle   ! of soft solids, in proportion to C
         associate (i => system%unknowns%node(1, k - size(state%p)), j => system%unknowns%node(2, k - size(state%p)))
            x(k) = x(k)*state%c(i, j) + merge(u(i, j), 0.0_dp, system%unknowns%is_full(i, j))
         end associate
      end do
      x(size(x)) = 0
   end subroutine shorten

   !> Solids bear inside the contact, and the film is broken behind it.
   subroutine make_state(is_line, marches, is_half, is_soft, refinement)
      logical, intent(in) :: is_line, marches, is_half
      logical, intent(in), optional :: is_soft
      integer, intent(in), optional :: refinement      !! of the mesh of an ellipse; absent: 1
      type(conditions_t) :: conditions
      integer :: cells(2), j

      if (allocated(problem%deformation)) deallocate (problem%deformation)   ! of a line or an ellipse
      conditions = make_conditions(200.0_dp, merge(0.0_dp, 1.0_dp, is_line))
      if (is_line) then
         call problem%init(new_line_grid(-2.5_dp, 1.5_dp, 48), conditions, make_rheology(conditions))
      else
         cells = [32, 24]
         if (present(refinement)) cells = refinement*cells
         call problem%init(new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells(1), cells(2), is_half), conditions, &
                           make_rheology(conditions))
      end if
      given = steady_given(problem%grid)
      call hertz_state(problem, 0.2_dp, spread(0*problem%grid%x, 2, problem%grid%ny + 1), state)
      law%film = 0.1_dp
      associate (grid => problem%grid)
         do j = grid%first_row, grid%last_row
            state%is_touching(:, j) = abs(grid%x) + abs(grid%y(j)) < 0.5_dp .and. modulo(nint(8*grid%x), 3) /= 0
            state%is_cavitated(:, j) = grid%x > 1.05_dp .and. grid%x < 1.45_dp
         end do
         state%p = max(state%p, 0.02_dp)
         state%p(0, :) = 0
         state%p(grid%nx, :) = 0
         if (.not. is_line) state%p(:, grid%ny) = 0
         if (.not. (is_line .or. is_half)) state%p(:, 0) = 0
      end associate
      where (state%is_cavitated) state%p = 0
      where (state%is_cavitated) state%theta = 0.7_dp
      law%is_soft = .false.
      if (present(is_soft)) law%is_soft = is_soft
      if (law%is_soft) then   ! down to solids so faint that sigma/C is 1e9
         law%softness = 0.1_dp
         law%stress = 0.3_dp
         state%is_touching = state%p > 0 .and. law%touches(state%h)
         where (state%is_touching) state%c = law%stress*exp((law%film - state%h)/law%softness)
      else
         where (state%is_touching) state%c = 0.1_dp
      end if
      call system%init(problem)
      call equations%init(problem)
      if (allocated(past%f)) deallocate (past%f, past%passed)
      if (.not. marches) return
      call equations%evaluate(problem, law, given, past, state)
      call equations%remember(state%theta, 1, past)
   end subroutine make_state

   !> The product with a change is the difference of the residuals over a short part of the change.
   subroutine compare(name, x, product)
      character(len=*), intent(in) :: name
      real(dp), intent(in) :: x(:), product(:)
      type(touching_change_t) :: change
      real(dp), allocatable :: after(:, :), before(:, :), gap(:, :)
      real(dp) :: part

      change = new_change(problem%grid)
      call system%unknowns%changes(x, change)
      part = step/max(maxval(abs(change%p)), maxval(abs(change%c)), abs(change%delta))
      call move(change, -part)
      call equations%evaluate(problem, law, given, past, state)
      before = equations%residual
      gap = excess()
      call move(change, 2*part)
      call equations%evaluate(problem, law, given, past, state)
      after = equations%residual
      after = (after - before)/(2*part)*problem%grid%hx
      before = reshape(product(:size(after)), shape(after))
      call test%check(maxval(abs(after - before)) <= 1e-4_dp*maxval(abs(before)), name//': rows of the oil')
      gap = (excess() - gap)/(2*part)
      call test%check_close(pack(gap, state%is_touching), product(size(after) + 1:size(product) - 2), &
         name//': rows of the gap', absolute=1e-4_dp*maxval(abs(gap)))
      call test%check_close(load_factor*problem%grid%integral(change%p*merge(0, 1, state%is_cavitated) + change%c), &
         product(size(product) - 1), name//': load', relative=1e-9_dp)
   end subroutine compare

   !> Residuals of the gap.
   function excess()
      real(dp) :: excess(size(state%c, 1), size(state%c, 2))
      excess = equations%gap
      where (state%is_touching) excess = law%excess(equations%gap, state%c)
   end function excess

   subroutine move(change, part)
      type(touching_change_t), intent(in) :: change
      real(dp), intent(in) :: part
      state%p = state%p + part*merge(0.0_dp, change%p, state%is_cavitated)
      state%theta = state%theta + part*merge(change%p, 0.0_dp, state%is_cavitated)
      state%c = state%c + part*change%c
      state%delta = state%delta + part*change%delta
   end subroutine move

end program test_touching_system
