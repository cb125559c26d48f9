!> Force balance and equation of motion, theory eq. (10) and (11).
program test_load_balance
   use ehlwave_kinds, only: dp, pi
   use ehlwave_load_balance, only: equation_of_motion, force_balance, held_approach, load_balance_t
   use ehlwave_text, only: to_text
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: omega = 5, stiffness = 1.7_dp, force = 1.2_dp
   type(test_t) :: test

   call check_force_balance()
   call check_free_oscillation()
   call check_held_approach()
   call test%finish()

contains

   subroutine check_force_balance()
      type(load_balance_t) :: load
      load = force_balance(1.0_dp)
      call load%carry([3.0_dp, 2.0_dp, 1.0_dp])
      call test%check_close(load%residual(2*pi/3, 0.7_dp), 0.0_dp, 'Hertz load', absolute=1e-15_dp)
      call test%check_close(load%residual(pi/3, 0.7_dp), -0.5_dp, 'half the load', absolute=1e-15_dp)
      load = force_balance(1.5_dp)
      call test%check_close(load%residual(pi, -3.0_dp), 0.0_dp, 'larger force', absolute=1e-15_dp)
   end subroutine check_force_balance

   !> A part of a contact that carries next to nothing has no load error by rounding.
   subroutine check_held_approach()
      type(load_balance_t) :: load
      load = held_approach(0.94036570564124167_dp, 4e-7_dp)
      call test%check_close(load%residual(4e-7_dp, 0.94036570564124167_dp)/load%force, 0.0_dp, 'load of a part', &
                            absolute=1e-7_dp)
   end subroutine check_held_approach

   !> Delta''/Omega^2 + k Delta = F: a linear spring in place of the contact.
   subroutine check_free_oscillation()
      real(dp) :: error(3), order
      integer :: n
      do n = 1, 3
         error(n) = oscillation_error(200*2**n)
      end do
      order = log(error(2)/error(3))/log(2.0_dp)
      print '(a)', 'measured: oscillation, order '//to_text(order, 4)
      call test%check(order > 1.9_dp .and. order < 2.1_dp, 'second order')
      call test%check(error(3) < 0.01_dp, 'amplitude and phase')
   end subroutine check_free_oscillation

   real(dp) function oscillation_error(steps)
      integer, intent(in) :: steps
      real(dp), parameter :: end_time = 1
      type(load_balance_t) :: load
      real(dp) :: dt, history(3), unloaded
      integer :: k

      dt = end_time/steps
      load = equation_of_motion(force, omega, dt)
      history = [exact(-dt), exact(-2*dt), exact(-3*dt)]
      do k = 0, steps
         call load%carry(history)
         ! residual is linear in Delta: inertia + stiffness is its slope
         unloaded = load%residual(0.0_dp, 0.0_dp)
         history = [-unloaded/(load%inertia + stiffness), history(1:2)]
      end do
      oscillation_error = abs(history(1) - exact(end_time))
   end function oscillation_error

   pure real(dp) function exact(t)
      real(dp), intent(in) :: t
      exact = force/stiffness + 0.3_dp*cos(omega*sqrt(stiffness)*t)
   end function exact

end program test_load_balance
