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
   integer, parameter :: repeats = 8           !! steps of a period

   type(test_t) :: test

   call check_exact(1, by_wave=0.01_dp, by_oil=0.0_dp)
   call check_exact(1, by_wave=0.0_dp, by_oil=0.01_dp)
   call check_exact(2, by_wave=0.01_dp, by_oil=0.01_dp)
   call check_exact(0, by_wave=0.01_dp, by_oil=0.0_dp)   ! steps shorter than a cell
   call check_steep()
   call check_crest()
   call check_outlet()
   call check_period()
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
      call extrapolate(m, wave_step, 10.0_dp, 1.0_dp, past, state, from_rest=.false.)
      k = m + 1
      call test%check_close(reshape(state%p(k:nx - 1, :), [(nx - k)*(ny + 1)]), reshape(p(k:nx - 1, :), &
         [(nx - k)*(ny + 1)]), 'pressure continued', relative=1e-12_dp)
      call test%check_close(state%delta, by_wave*cos(10*wave_step), 'mutual approach continued', absolute=1e-14_dp)
   end subroutine check_exact

   !> A guess at a steep end stays in the range of its neighbours at the step before.
   subroutine check_steep()
      type(past_t) :: past
      type(state_t) :: state
      real(dp) :: p(0:nx, 0:ny)

      p(:9, :) = rest
      p(10:, :) = 0
      past = past_of(p, p, p + 0.4_dp, p)
      state = past%before
      call extrapolate(1, 0.0_dp, 10.0_dp, 1.0_dp, past, state, from_rest=.false.)
      call test%check(all(state%p(9:10, :) > -1e-9_dp .and. state%p(9:10, :) < rest + 0.03_dp), 'held near the neighbours')
   end subroutine check_steep

   !> A crest rises above all neighbours at the step before.
   subroutine check_crest()
      type(past_t) :: past
      type(state_t) :: state
      real(dp) :: p(0:nx, 0:ny)

      p = rest
      past = past_of(p, p + 0.2_dp, p + 0.1_dp, p)
      state = past%before
      call extrapolate(0, 0.0_dp, 10.0_dp, 1.0_dp, past, state, from_rest=.false.)
      call test%check_close(maxval(state%p), rest + 0.3_dp, 'a crest between nodes', relative=1e-12_dp)
   end subroutine check_crest

   !> At the outlet end of the pressure a change in proportion to it is continued there, not carried along.
   subroutine check_outlet()
      type(past_t) :: past
      type(state_t) :: state
      real(dp) :: p(0:nx, 0:ny)
      integer :: i

      do i = 0, nx
         p(i, :) = 0.1_dp*exp(-0.5_dp*i)
      end do
      past = past_of(p, 1.3_dp*p, 1.2_dp*p, 1.1_dp*p)
      state = past%before
      call extrapolate(1, 0.0_dp, 10.0_dp, 1.0_dp, past, state, from_rest=.true.)
      call test%check_close(state%p(4, 1), 1.4_dp*p(4, 1), 'outlet end', relative=1e-12_dp)
   end subroutine check_outlet

   !> Peaks that repeat each period are known once a period has passed.
   subroutine check_period()
      type(past_t) :: past
      type(state_t) :: state
      real(dp) :: p(0:nx, 0:ny)
      integer :: k

      p = rest
      past = past_of(p, p, p, p)
      call past%period%begin(real(repeats, dp), 1.0_dp, nx, ny)
      do k = 1, 2*repeats
         past%earliest = past%earlier
         past%earlier = past%before
         past%before = repeating(k)
         call past%period%keep(real(k, dp), past%before)
      end do
      state = past%before
      call extrapolate(1, 2*acos(-1.0_dp)/repeats, real(k, dp), 1.0_dp, past, state, from_rest=.false.)
      past%before = repeating(k)
      call test%check_close(state%p(12, 1), past%before%p(12, 1), 'pressure a period before', relative=1e-6_dp)
      call test%check_close(state%delta, past%before%delta, 'mutual approach a period before', relative=1e-6_dp)
   end subroutine check_period

   !> A solution with peaks at every eighth step.
   function repeating(k) result(state)
      integer, intent(in) :: k
      type(state_t) :: state
      real(dp) :: p(0:nx, 0:ny)
      p = rest + merge(0.1_dp, 0.0_dp, modulo(k, repeats) == 1)
      state = state_of(p, merge(0.2_dp, 0.1_dp, modulo(k, repeats) == 1))
   end function repeating

   !> Solutions before a step, the latest first.
   function past_of(steady, before, earlier, earliest) result(past)
      real(dp), intent(in), dimension(0:, 0:) :: steady, before, earlier, earliest
      type(past_t) :: past
      past%steady = state_of(steady, 0.0_dp)
      past%before = state_of(before, 0.0_dp)
      past%earlier = state_of(earlier, 0.0_dp)
      past%earliest = state_of(earliest, 0.0_dp)
   end function past_of

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
