!> The response to small waves at twice their frequency, to second order in their amplitude, by theory eq. (W8).
!>
!> With the steady state u0, the linear response u1 to a pattern of amplitude A, and J(2w) the operator for changes of
!> twice the frequency,
!>
!>     u2 = -J(2w)^(-1) 2 < R(u0 + A Re(u1 exp(-i phi))) exp(2 i phi) >,    the mean over phases phi,
!>
!> R the residual of a time step, whose earlier times are earlier phases. Five phases see all that is of second order.
module ehlwave_second_harmonic
   use ehlwave_equations, only: equations_t
   use ehlwave_given, only: given_t
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_harmonic_solver, only: harmonic_solver_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp, pi
   use ehlwave_load_balance, only: harmonic_inertia
   use ehlwave_mean_film, only: probe_over_film
   use ehlwave_state, only: state_t
   use ehlwave_transport, only: characteristic_transport
   implicit none (type, external)
   private
   public :: find_second_harmonic

   integer, parameter :: phases = 5

contains

   !> Response u2 to waves of amplitude 1: it goes with the square of the amplitude, as the real part of u2 exp(-2 i w
   !> T). The solver is left with the operator of 2w.
   subroutine find_second_harmonic(solver, levels, first, frequency, natural_frequency, steps_per_cell, second)
      type(harmonic_solver_t), intent(inout) :: solver
      type(level_t), intent(inout), target :: levels(:)   !! levels of `solver`, coarsest first
      type(harmonic_response_t), intent(in) :: first      !! u1, converged
      real(dp), intent(in) :: frequency                   !! w in units of 1/T
      real(dp), intent(in) :: natural_frequency           !! Omega of the equation of motion; 0: force balance
      integer, intent(in) :: steps_per_cell               !! m for dT = hX/m
      type(harmonic_response_t), intent(out) :: second
      complex(dp), allocatable, target :: b(:)
      complex(dp) :: inertia
      real(dp) :: dt

      associate (linear => solver%linear, problem => levels(size(levels))%problem)
         dt = problem%grid%hx/steps_per_cell
         allocate (b(linear%n))
         inertia = 0
         if (natural_frequency > 0) inertia = harmonic_inertia(natural_frequency, dt, 2*frequency)
         call solver%set_frequency(levels, 2*frequency, inertia, is_real=.false.)
         call second_residual(solver, levels(size(levels)), first, frequency*dt, steps_per_cell, b)
         call solver%respond_to(levels, b, second)
      end associate
   end subroutine find_second_harmonic

   !> Right side: minus the second harmonic of the weighted residual; 0 at cavitated nodes, in the load row and at the
   !> edges.
   subroutine second_residual(solver, level, first, turn, steps_per_cell, b)
      type(harmonic_solver_t), intent(in) :: solver
      type(level_t), intent(inout) :: level               !! the finest
      type(harmonic_response_t), intent(in) :: first
      real(dp), intent(in) :: turn                        !! phase that passes in a time step
      integer, intent(in) :: steps_per_cell
      complex(dp), intent(out), contiguous, target :: b(:)
      complex(dp), pointer, contiguous :: r(:, :)
      real(dp), allocatable :: history(:, :, :)
      type(equations_t) :: equations
      type(given_t) :: given
      type(state_t) :: state
      real(dp) :: phase, probe
      integer :: k, n

      associate (problem => level%problem, grid => level%problem%grid, &
                 smooth => solver%linear%levels(solver%linear%finest))
         r(0:grid%nx, 0:grid%ny) => b(:solver%linear%n - 1)
         probe = probe_over_film*grid%value_at_centre(level%state%h)
         call equations%init(problem)
         given%transport = characteristic_transport(grid, 1, steps_per_cell)
         allocate (history(0:grid%nx, 0:grid%ny, given%transport%history_length()))
         b = 0
         do k = 0, phases - 1
            phase = 2*pi*k/phases
            do n = size(history, 3), 0, -1
               state = level%state
               call first%add_to(state, probe*exp(cmplx(0, n*turn - phase, dp)))
               if (n > 0) history(:, :, n) = problem%density(state%p)*state%h
            end do
            call given%transport%carry(grid, history)
            call equations%evaluate(problem, given, state)
            level%problem%deformation%work = level%problem%deformation%work + equations%work()
            r = r - exp(cmplx(0, 2*phase, dp))*equations%residual*(2/(phases*probe**2))
         end do
         r = merge((0.0_dp, 0.0_dp), r*smooth%row_scale, smooth%equations%is_cavitated)
      end associate
   end subroutine second_residual

end module ehlwave_second_harmonic
