!> First guesses of time steps: waves that pass and disturbances that the oil carries are continued exactly.
program test_first_guess
   use ehlwave_first_guess, only: extrapolate, past_t
   use ehlwave_kinds, only: dp
   use ehlwave_state, only: state_t
   use testing, only: test_t
   implicit none (type, external)

   integer, parameter :: nx = 24, ny = 3
   real(dp), parameter :: wave_step = 0.4_dp   !! w dT: 16 steps a period
   real(dp), parameter :: rest = 0.5_dp        !! P0

   type(test_t) :: test

   call check_exact(1, by_wave=0.01_dp, by_oil=0.0_dp)
   call check_exact(1, by_wave=0.0_dp, by_oil=0.01_dp)
   call check_exact(2, by_wave=0.01_dp, by_oil=0.01_dp)
   call check_exact(0, by_wave=0.01_dp, by_oil=0.0_dp)   ! steps shorter than a cell
   call check_steep()
   call test%finish()

contains

   !> Two disturbances: a wave whose amplitude and phase vary along X, and a bump that the oil carries.
   subroutine check_exact(m, by_wave, by_oil)
      integer, intent(in) :: m                       !! cells a step
      real(dp), intent(in) :: by_wave, by_oil        !! their heights
      type(past_t) :: past
      type(state_t) :: state
      real(dp) :: p(0:nx, 0:ny)
      integer :: k

      p = rest
      past%steady = state_of(p, 0.0_dp)
      past%before = step_of(m, 9, by_wave, by_oil)
      past%earlier = step_of(m, 8, by_wave, by_oil)
      past%earliest = step_of(m, 7, by_wave, by_oil)
      state = step_of(m, 10, by_wave, by_oil)
      p = state%p
      state%p = 0
      state%delta = 0
      call extrapolate(m, wave_step, past, state)
      k = m + 1
      call test%check_close(reshape(state%p(k:nx - 1, :), [(nx - k)*(ny + 1)]), reshape(p(k:nx - 1, :), &
         [(nx - k)*(ny + 1)]), 'pressure continued', relative=1e-12_dp)
      call test%check_close(state%delta, by_wave*cos(10*wave_step), 'mutual approach continued', absolute=1e-14_dp)
   end subroutine check_exact

   !> A guess stays in the range of the neighbours at the step before.
   subroutine check_steep()
      type(past_t) :: past
      type(state_t) :: state
      real(dp) :: p(0:nx, 0:ny)

      p = rest
      past%steady = state_of(p, 0.0_dp)
      past%before = past%steady
      past%earlier = state_of(p + 0.4_dp, 0.0_dp)
      past%earliest = past%before
      state = past%before
      call extrapolate(1, 0.0_dp, past, state)
      call test%check(all(abs(state%p - rest) < 0.03_dp), 'held near the neighbours')
   end subroutine check_steep

   !> The solution at step k.
   function step_of(m, k, by_wave, by_oil) result(state)
      integer, intent(in) :: m, k
      real(dp), intent(in) :: by_wave, by_oil
      type(state_t) :: state
      real(dp) :: p(0:nx, 0:ny)
      integer :: i
      do i = 0, nx
         p(i, :) = rest + by_wave*(1 + 0.5_dp*sin(0.7_dp*i))*cos(k*wave_step - 0.3_dp*i) &
                   + by_oil*exp(-0.2_dp*(i - m*k - 3)**2)
      end do
      state = state_of(p, by_wave*cos(k*wave_step))
   end function step_of

   function state_of(p, delta) result(state)
      real(dp), intent(in) :: p(0:, 0:), delta
      type(state_t) :: state
      allocate (state%p(0:nx, 0:ny), source=p)
      state%delta = delta
   end function state_of

end program test_first_guess
