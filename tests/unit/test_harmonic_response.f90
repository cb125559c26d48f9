!> The linearised equations against the discrete equations of a time step.
program test_harmonic_response
   use ehlwave_complex_wedge, only: wedge_t
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_equations, only: equations_t
   use ehlwave_grid, only: grid_t
   use ehlwave_given, only: given_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_harmonic_solver, only: harmonic_solver_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: equation_of_motion, harmonic_inertia, load_balance_t
   use ehlwave_state, only: new_state, state_t
   use ehlwave_transport, only: characteristic_transport, harmonic_wedge, transport_t
   use ehlwave_waviness, only: new_waviness
   use sample_contact, only: noise, solve_sample
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call transport_on_grids(test)
   call inertia(test)
   call against_residual(test, 'half domain', .true., 4.0_dp)
   call against_residual(test, 'whole domain', .false., 4.0_dp)
   call against_residual(test, 'standing', .true., 0.0_dp)
   call independent_of_history(test)
   call real_and_complex(test)
   call test%finish()

contains

   !> On the grid of the time step the weights equal the characteristic weights; coarser grids agree for a smooth f.
   subroutine transport_on_grids(test)
      type(test_t), intent(inout) :: test
      type(full_multigrid_t) :: multigrid
      type(wedge_t) :: fine, coarse
      type(transport_t) :: steps
      complex(dp) :: z
      real(dp), parameter :: frequency = 9
      call solve_sample(multigrid, .true.)
      associate (grid => multigrid%levels(2)%problem%grid, wide => multigrid%levels(1)%problem%grid)
         z = exp(cmplx(0, frequency*grid%hx, dp))
         fine = harmonic_wedge(grid, frequency, grid%hx)
         coarse = harmonic_wedge(wide, frequency, grid%hx)
         steps = characteristic_transport(grid, 1, 1)
         call test%check_close(abs(fine%w0(1:) - steps%w0(1:)), 0*steps%w0(1:), 'weights at the node', absolute=1e-11_dp)
         call test%check_close(abs(fine%w1(5)*grid%hx + 2*z), 0.0_dp, 'one node upstream', absolute=1e-12_dp)
         call test%check_close(abs(fine%w2(5)*grid%hx - 0.5_dp*z**2), 0.0_dp, 'two nodes upstream', absolute=1e-12_dp)
         call test%check_close(abs(fine%w1(1)*grid%hx + z) + abs(fine%w2(1)), 0.0_dp, 'first node', absolute=1e-12_dp)
         call test%check_close(abs(sum([coarse%w0(5), coarse%w1(5), coarse%w2(5)]) - sum([fine%w0(5), fine%w1(5), fine%w2(5)])), &
                               0.0_dp, 'constant f on the coarse grid', absolute=1e-11_dp)
         call test%check_close(abs(-wide%hx*(coarse%w1(5) + 2*coarse%w2(5)) + grid%hx*(fine%w1(5) + 2*fine%w2(5))), 0.0_dp, &
                               'linear f on the coarse grid', absolute=1e-11_dp)
      end associate
      call fitted_transport(test, multigrid%levels(2)%problem%grid, multigrid%levels(1)%problem%grid)
   end subroutine transport_on_grids

   !> Transport of third order.
   subroutine fitted_transport(test, grid, wide)
      type(test_t), intent(inout) :: test
      type(grid_t), intent(in) :: grid, wide
      type(grid_t) :: fitted, fitted_wide
      type(wedge_t) :: fine, coarse
      complex(dp) :: z
      real(dp), parameter :: frequency = 9
      integer :: k
      integer, parameter :: places(0:3) = [0, 1, 2, 3]

      fitted = grid
      fitted%is_fitted = .true.
      fitted_wide = wide
      fitted_wide%is_fitted = .true.
      z = exp(cmplx(0, frequency*grid%hx, dp))
      fine = harmonic_wedge(fitted, frequency, grid%hx)
      coarse = harmonic_wedge(fitted_wide, frequency, grid%hx)
      call test%check_close(abs([fine%w0(5), fine%w1(5), fine%w2(5), fine%w3(5)]*grid%hx &
                                - [11/6.0_dp, -3.0_dp, 1.5_dp, -1/3.0_dp]*z**places), spread(0.0_dp, 1, 4), &
                            'third order along the characteristic', absolute=1e-11_dp)
      do k = 0, 3       ! f = X^k, zero at the node
         call test%check_close(abs(sum([coarse%w0(5), coarse%w1(5), coarse%w2(5), coarse%w3(5)]*(-places*wide%hx)**k) &
                                   - sum([fine%w0(5), fine%w1(5), fine%w2(5), fine%w3(5)]*(-places*grid%hx)**k)), 0.0_dp, &
                               'a power of X on the coarse grid', absolute=1e-11_dp)
      end do
   end subroutine fitted_transport

   !> The equation of motion for Delta = exp(-i w T).
   subroutine inertia(test)
      type(test_t), intent(inout) :: test
      type(load_balance_t) :: load
      complex(dp) :: delta(0:3), sum_of_terms
      real(dp), parameter :: dt = 0.1_dp, omega = 3, frequency = 2
      real(dp) :: part(2)
      integer :: k
      delta = [(exp(cmplx(0, frequency*k*dt, dp)), k=0, 3)]
      load = equation_of_motion(0.0_dp, omega, dt)
      call load%carry(real(delta(1:), dp))
      part(1) = load%residual(0.0_dp, real(delta(0), dp))
      call load%carry(aimag(delta(1:)))
      part(2) = load%residual(0.0_dp, aimag(delta(0)))
      sum_of_terms = cmplx(part(1), part(2), dp)
      call test%check_close(abs(harmonic_inertia(omega, dt, frequency) - sum_of_terms), 0.0_dp, 'inertia', absolute=1e-12_dp)
   end subroutine inertia

   !> A time step with small harmonic P, Delta and pattern at this and the two earlier times: the change of the
   !> nonlinear residual, central differences in the amplitude, against the linearised operator.
   subroutine against_residual(test, what, is_half, frequency)
      type(test_t), intent(inout) :: test
      character(len=*), intent(in) :: what
      logical, intent(in) :: is_half
      real(dp), intent(in) :: frequency
      type(full_multigrid_t) :: multigrid
      type(harmonic_solver_t) :: solver
      complex(dp), allocatable, target :: x(:), y(:)
      complex(dp), allocatable :: b(:, :), g(:, :)
      complex(dp), pointer, contiguous :: q(:, :), linear(:, :)
      real(dp), allocatable :: up(:, :), down(:, :)
      real(dp), parameter :: amplitude = 1e-4_dp
      real(dp) :: worst
      integer :: i, j, turn

      call solve_sample(multigrid, is_half)
      call solver%init(multigrid%levels)
      associate (level => multigrid%levels(size(multigrid%levels)), grid => multigrid%levels(size(multigrid%levels))%problem%grid, &
                 system => solver%linear, linearised => solver%linear%levels(solver%linear%finest))
         call solver%set_frequency(multigrid%levels, frequency, (0.0_dp, 0.0_dp), is_real=.false.)
         call system%borrow(multigrid%levels)
         allocate (x(system%n), y(system%n), b(0:grid%nx, 0:grid%ny), g(0:grid%nx, 0:grid%ny))
         allocate (up(0:grid%nx, 0:grid%ny), down(0:grid%nx, 0:grid%ny))
         x = 0
         q(0:grid%nx, 0:grid%ny) => x(:system%n - 1)
         do j = 0, grid%ny
            do i = 0, grid%nx
               g(i, j) = cmplx(noise(3*i, j), noise(i, 5*j), dp)
               if (level%state%p(i, j) > 1e-3_dp) q(i, j) = level%state%p(i, j)*cmplx(noise(i, j), noise(i + 1, j), dp)
            end do
         end do
         x(system%n) = (0.2_dp, -0.4_dp)
         call system%multiply(x, y)
         linear(0:grid%nx, 0:grid%ny) => y(:system%n - 1)
         call system%gap_change(g, b)
         call system%release()
         linear = linear + b
         do turn = 0, 1                     ! phases 0 and a quarter period: real and imaginary part
            call step_residual(level%problem, level%state, frequency, amplitude*(0.0_dp, 1.0_dp)**turn, q, x(system%n), g, up)
            call step_residual(level%problem, level%state, frequency, -amplitude*(0.0_dp, 1.0_dp)**turn, q, x(system%n), g, down)
            worst = 0
            do j = grid%first_row, grid%last_row
               do i = 1, grid%nx - 1
                  if (linearised%equations%is_cavitated(i, j)) cycle
                  worst = max(worst, abs(linearised%row_scale(i, j)*(up(i, j) - down(i, j))/(2*amplitude) &
                                         - real((0.0_dp, 1.0_dp)**turn*linear(i, j), dp)))
               end do
            end do
            call test%check_close(worst/maxval(abs(linear)), 0.0_dp, what//': residual of a time step', absolute=1e-6_dp)
         end do
         call test%check(count(linearised%equations%is_cavitated) > 0, what//': some nodes are cavitated')
      end associate
   end subroutine against_residual

   !> Residual at T = 0 with everything at T - n dT the steady state plus the real part of factor exp(i w n dT) times
   !> the amplitudes.
   subroutine step_residual(problem, state, frequency, factor, q, delta, g, r)
      type(contact_problem_t), intent(inout) :: problem
      type(state_t), intent(in) :: state
      real(dp), intent(in) :: frequency
      complex(dp), intent(in) :: factor, q(0:, 0:), delta, g(0:, 0:)
      real(dp), intent(out) :: r(0:, 0:)
      type(equations_t) :: equations
      type(given_t) :: given
      type(state_t) :: now
      complex(dp) :: turned
      real(dp), allocatable :: history(:, :, :)
      integer :: n

      associate (grid => problem%grid, transport => given%transport)
         call equations%init(problem)
         transport = characteristic_transport(grid, 1, 1)
         now = new_state(grid)
         allocate (history(0:grid%nx, 0:grid%ny, 2))
         do n = 2, 0, -1
            turned = factor*exp(cmplx(0, frequency*n*grid%hx, dp))
            now%p = state%p + real(turned*q, dp)
            call problem%smooth_film(now%p, state%delta + real(turned*delta, dp), now%h)
            now%h = now%h + real(turned*g, dp)
            if (n == 0) call transport%carry(grid, history)
            call equations%evaluate(problem, given, now)
            if (n > 0) history(:, :, n) = equations%flow%f
         end do
         r = equations%residual
      end associate
   end subroutine step_residual

   !> A response does not depend on earlier responses, bit for bit; oblique and product patterns have the same at the
   !> centre, because sin(ky Y) has none there.
   subroutine independent_of_history(test)
      type(test_t), intent(inout) :: test
      type(full_multigrid_t) :: multigrid
      type(harmonic_solver_t) :: solver
      type(harmonic_response_t) :: first, other, again, oblique
      call solve_sample(multigrid, .false.)
      call solver%init(multigrid%levels)
      call solver%respond(multigrid%levels, new_waviness(1.2_dp, 1.0_dp, .false., -2.5_dp, 1.0_dp), 0.0_dp, 1, first)
      call solver%respond(multigrid%levels, new_waviness(0.0_dp, 1.0_dp, .false., -2.5_dp, 1.0_dp), 0.0_dp, 1, other)
      call test%check_close(maxval(abs(aimag(other%h))), 0.0_dp, 'longitudinal waves have no phase', absolute=1e-14_dp)
      call solver%respond(multigrid%levels, new_waviness(1.2_dp, 1.0_dp, .false., -2.5_dp, 1.0_dp), 0.0_dp, 1, again)
      call test%check(abs(first%film - again%film) <= 0 .and. all(abs(first%p - again%p) <= 0), 'the same twice')
      call solver%respond(multigrid%levels, new_waviness(1.2_dp, 1.0_dp, .true., -2.5_dp, 1.0_dp), 0.0_dp, 1, oblique)
      call test%check_close(abs(oblique%film), abs(first%film), 'oblique at the centre', relative=3e-4_dp)
      call test%check(maxval(abs(oblique%h - first%h)) > 0.1_dp, 'but not elsewhere')
      call solver%respond(multigrid%levels, new_waviness(1.2_dp, 1.0_dp, .false., -2.5_dp, 1.0_dp), 0.3_dp, 1, again)
      call test%check(abs(again%approach) < 0.5_dp*abs(first%approach), 'inertia holds the approach back')
      call solver%respond(multigrid%levels, new_waviness(1.2_dp, 1.0_dp, .false., -2.5_dp, 1.0_dp), 0.0_dp, 1, again)
      call test%check(abs(first%film - again%film) <= 0 .and. all(abs(first%p - again%p) <= 0), 'force balance again')
      call solver%respond(multigrid%levels, new_waviness(1.2_dp, 0.0_dp, .false., -2.5_dp, 1.0_dp), 0.0_dp, 1, other)
      call solver%init(multigrid%levels)
      call solver%respond(multigrid%levels, new_waviness(1.2_dp, 0.0_dp, .false., -2.5_dp, 1.0_dp), 0.0_dp, 1, again)
      call test%check(abs(other%film - again%film) <= 0 .and. all(abs(other%p - again%p) <= 0), &
                      'factors of another pattern are its own')
      call solver%respond(multigrid%levels, new_waviness(1.2_dp, 0.0_dp, .false., -2.5_dp, 0.5_dp), 0.0_dp, 1, again)
      call test%check(abs(other%film - again%film) > 1e-3_dp, 'not those of half the speed')
   end subroutine independent_of_history

   !> Waves along Y have a real response; waves that vary very slowly along X have a complex response close to it.
   subroutine real_and_complex(test)
      type(test_t), intent(inout) :: test
      type(full_multigrid_t) :: multigrid
      type(harmonic_solver_t) :: solver
      type(harmonic_response_t) :: exact, slow
      call solve_sample(multigrid, .true.)
      call solver%init(multigrid%levels)
      solver%tolerance = 1e-9_dp
      call solver%respond(multigrid%levels, new_waviness(0.0_dp, 0.8_dp, .false., -2.5_dp, 1.5_dp), 0.0_dp, 1, exact)
      call solver%respond(multigrid%levels, new_waviness(1e7_dp, 0.8_dp, .false., -2.5_dp, 1.5_dp), 0.0_dp, 1, slow)
      call test%check_close(maxval(abs(slow%p - exact%p)), 0.0_dp, 'pressure of longitudinal waves', absolute=1e-5_dp)
      call test%check_close(maxval(abs(slow%h - exact%h)), 0.0_dp, 'film of longitudinal waves', absolute=1e-5_dp)
      call test%check(maxval(abs(exact%p)) > 0.1_dp .and. exact%linear_steps > 0, 'which are not nothing')
   end subroutine real_and_complex

end program test_harmonic_response
