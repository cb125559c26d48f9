!> The march backwards against the linearised march forwards: the same derivative, and at most 1.2 times its work.
program test_march_gradient
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_contact_variant, only: contact_variable_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_hierarchy, only: work_of
   use ehlwave_kinds, only: dp, pi
   use ehlwave_march_gradient, only: march_gradient_t
   use ehlwave_march_recording, only: march_recording_t
   use ehlwave_march_settings, only: march_settings_t
   use ehlwave_marched_step, only: marched_step_t
   use ehlwave_status, only: status_converged
   use ehlwave_steady_tangent, only: steady_tangent_t
   use ehlwave_step_systems, only: step_systems_t
   use ehlwave_waviness, only: new_waviness
   use sample_contact, only: solve_sample
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test
   integer, parameter :: period = 12, last = 4*period   !! steps
   real(dp), parameter :: tolerance = 1e-7_dp, slip = 1.2_dp

   call compare(test)
   call test%finish()

contains

   !> The first Fourier coefficient of the central film over a period, by the logarithm of the amplitude.
   subroutine compare(test)
      type(test_t), intent(inout) :: test
      type(full_multigrid_t) :: multigrid
      type(march_settings_t) :: settings
      type(march_recording_t) :: recording
      type(march_gradient_t) :: gradient
      type(contact_variable_t) :: variables(1)
      real(dp) :: direct, direct_work, weights(1, last - period + 1:last)
      integer :: k

      call solve_sample(multigrid, .true.)
      associate (level => multigrid%levels(2), grid => multigrid%levels(2)%problem%grid)
         settings%film = grid%value_at_centre(level%state%h)
         settings%steps = last
         settings%surfaces%list = [new_waviness(slip*period*grid%hx, 0.0_dp, .false., -2.5_dp, slip, 0.15_dp)]
         call recording%begin(grid%nx, grid%ny, last, real(period, dp))
         do k = 0, last
            call recording%see(level, k, k*settings%time_step(grid))
         end do
         weights(1, :) = [(2*cos(2*pi*k/period)/period, k=1, period)]
         call vary_amplitude(level%problem, settings, variables(1))
         call gradient%find(multigrid%levels, settings, recording, level%state, variables, [0.0_dp], &
                            last - period + 1, weights, tolerance)
         call march(multigrid, settings, recording, weights(1, :), gradient%solves, direct, direct_work)
         call test%check(gradient%is_found, 'the weights of the steps fade')
         call test%check_close(gradient%change(1, 1), direct, 'derivative by the amplitude', relative=1e-5_dp)
         call test%check(gradient%work < 1.2_dp*direct_work, 'it costs at most 1.2 times the linearised march')
         print '(a, f6.2)', 'work backwards over work forwards:', gradient%work/direct_work
      end associate

   end subroutine compare

   !> The logarithm of the amplitude.
   subroutine vary_amplitude(problem, settings, variable)
      type(contact_problem_t), intent(in) :: problem
      type(march_settings_t), intent(in) :: settings
      type(contact_variable_t), intent(inout) :: variable
      integer :: k
      variable%is_of_waves = .true.
      call variable%place_variants(1e-5_dp, side=0)
      do k = 1, size(variable%variants)
         associate (variant => variable%variants(k))
            variant%conditions = problem%conditions
            variant%rheology = problem%rheology
            variant%waves = settings%surfaces%list
            variant%waves%amplitude_over_film = exp(variant%place)*variant%waves%amplitude_over_film
         end associate
      end do
   end subroutine vary_amplitude

   !> As many linearised steps forwards, from rest to the end of the last period.
   subroutine march(multigrid, settings, recording, weights, steps, direct, work)
      type(full_multigrid_t), intent(inout) :: multigrid
      type(march_settings_t), intent(in) :: settings
      type(march_recording_t), intent(in) :: recording
      real(dp), intent(in) :: weights(:)                     !! of the last period
      integer, intent(in) :: steps
      real(dp), intent(out) :: direct, work
      type(steady_tangent_t) :: tangent
      type(step_systems_t) :: systems
      type(marched_step_t) :: step
      real(dp), allocatable :: b(:), dh(:, :), dr(:, :), f(:, :, :), q(:, :), rough(:, :), x(:)
      real(dp) :: film(period), largest
      integer :: j, k, linear_steps, status

      call tangent%init(multigrid%levels)
      associate (levels => multigrid%levels, level => multigrid%levels(2), linear => tangent%linear, &
                 grid => multigrid%levels(2)%problem%grid, &
                 equations => tangent%linear%levels(2)%equations)
         allocate (dh, dr, q, rough, mold=level%state%p)
         allocate (b(linear%n), x(linear%n), f(0:grid%nx, 0:grid%ny, 2), source=0.0_dp)
         film = 0
         largest = 0
         work = 0
         do k = last - steps + 1, last
            call step%init(level%problem, settings, recording, level%state)
            call step%load(level%problem, recording, modulo(k - 1, period) + last - period + 1)
            call tangent%move_to(level, step%given, step%states(0))
            rough = settings%surfaces%rough_of_waves(grid%x, grid%y, k*settings%time_step(grid), settings%film)
            call linear%gap_change(rough, dr)
            do j = grid%first_row, grid%last_row
               call step%given%transport%carry_row(grid, j, f(:, j, :))
               where (.not. equations%is_cavitated(:, j)) &
                  dr(:, j) = dr(:, j) - linear%levels(2)%row_scale(:, j)*step%given%transport%carried(:, j)
            end do
            b = [-reshape(dr, [size(dr)]), 0.0_dp]
            work = work - work_of(levels)
            call linear%borrow(levels)
            call systems%begin_step()
            call systems%solve(linear, levels, b, tolerance, largest, x, status, linear_steps)
            call test%check(status == status_converged, 'a linearised step converges')
            q = reshape(x(:linear%n - 1), shape(q))
            call linear%film_change(q, x(linear%n), dh)
            call linear%release()
            work = work + work_of(levels)
            dh = dh + rough
            f(:, :, 2) = f(:, :, 1)
            f(:, :, 1) = equations%flow%rho*dh + equations%flow%f_p*q
            film(modulo(k - 1, period) + 1) = grid%value_at_centre(dh)
         end do
         direct = sum(weights*film)
      end associate
   end subroutine march

end program test_march_gradient
