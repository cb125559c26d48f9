!> First guess of a time step from the solutions before it.
module ehlwave_first_guess
   use ehlwave_kinds, only: dp
   use ehlwave_known_waves, only: known_waves_t
   use ehlwave_last_period, only: last_period_t
   use ehlwave_neighbour_range, only: held, neighbour_range
   use ehlwave_state, only: state_t
   use ehlwave_threads, only: is_shared
   implicit none (type, external)
   private
   public :: carry_on, extrapolate, look_up

   !> Solutions that the first guess is made from.
   type, public :: past_t
      type(state_t) :: steady, before, earlier, earliest  ! solutions for smooth surfaces; at T - dT, T - 2 dT, T - 3 dT
      ! (0:nx, 0:ny, 0:3): a period before T, T - dT, ...; absent: none
      real(dp), allocatable :: known_p(:, :, :)
      real(dp) :: known_delta(0:3) = 0
   end type past_t

contains

   !> First guess: P0, which is the solution a period before or else the steady state, plus the extrapolated difference
   !> p = P - P0. Two operators act on p in turn, theory eq. (D16): one vanishes for waves of the frequency w at a fixed
   !> place, the other for a disturbance that the oil carries along. Pressures stay in the range of their neighbours at
   !> the step before.
   subroutine extrapolate(m, wave_step, past, state)
      integer, intent(in) :: m                       !! cells that a feature travels per step, 0: less than one
      real(dp), intent(in) :: wave_step              !! w dT of the waves, 0: none
      type(past_t), intent(in) :: past
      type(state_t), intent(inout) :: state

      if (allocated(past%known_p)) then
         associate (known => past%known_p)
            call extrapolate_about(m, wave_step, past, known(:, :, 0), known(:, :, 1), known(:, :, 2), &
               known(:, :, 3), state%p)
         end associate
      else
         associate (p0 => past%steady%p)
            call extrapolate_about(m, wave_step, past, p0, p0, p0, p0, state%p)
         end associate
      end if
      associate (d => [past%before%delta, past%earlier%delta, past%earliest%delta] - past%known_delta(1:))
         state%delta = past%known_delta(0) + continued(wave_step, d, d)
      end associate
   end subroutine extrapolate

   !> The pressure of `extrapolate`, by P0 at T, T - dT, T - 2 dT and T - 3 dT.
   subroutine extrapolate_about(m, wave_step, past, now, then1, then2, then3, p)
      integer, intent(in) :: m
      real(dp), intent(in) :: wave_step
      type(past_t), intent(in) :: past
      real(dp), dimension(0:, 0:), intent(in) :: now, then1, then2, then3   !! (0:nx, 0:ny)
      real(dp), intent(inout) :: p(0:, 0:)
      real(dp) :: guess
      integer :: i, j, l

      associate (p1 => past%before%p, p2 => past%earlier%p, p3 => past%earliest%p)
         !$omp parallel do private(i, j, l, guess) schedule(static) if (is_shared(size(p)))
         do j = 0, ubound(p, 2)
            do i = 0, ubound(p, 1) - 1
               l = merge(i - m, i, i > m)      ! where the oil was a step before
               guess = now(i, j) + continued(wave_step, &
                  [p1(i, j) - then1(i, j), p2(i, j) - then2(i, j), p3(i, j) - then3(i, j)], &
                  [p1(l, j) - then1(l, j), p2(l, j) - then2(l, j), p3(l, j) - then3(l, j)])
               p(i, j) = max(0.0_dp, held(guess, neighbour_range(p1, i, j)))
            end do
         end do
      end associate
   end subroutine extrapolate_about

   !> The next value of a disturbance from its last three, the latest first, here and upstream: theory eq. (D16).
   pure real(dp) function continued(wave_step, here, upstream)
      real(dp), intent(in) :: wave_step
      real(dp), intent(in) :: here(3), upstream(3)   !! at T - dT, T - 2 dT, T - 3 dT
      real(dp) :: twice
      twice = 2*cos(wave_step)
      continued = twice*here(1) - here(2) + upstream(1) - twice*upstream(2) + upstream(3)
   end function continued

   !> First guess of the first steps from known waves: the previous solution and the change of the waves.
   !> Extrapolation would amplify the errors of the waves.
   subroutine carry_on(past, waves, t, dt, state)
      type(past_t), intent(in) :: past
      type(known_waves_t), intent(in) :: waves
      real(dp), intent(in) :: t, dt               !! time of the step
      type(state_t), intent(inout) :: state
      state = past%before
      call state%add(waves%state_at(t), 1.0_dp)
      call state%add(waves%state_at(t - dt), -1.0_dp)
      call waves%limit(state)
   end subroutine carry_on

   !> Give `past` the solutions a period before T = t and the three steps before that.
   subroutine look_up(period, t, dt, past)
      type(last_period_t), intent(in) :: period   !! in which they are known
      real(dp), intent(in) :: t, dt               !! time of the step
      type(past_t), intent(inout) :: past
      logical :: is_new
      integer :: n

      is_new = .not. allocated(past%known_p)
      if (is_new) allocate (past%known_p(0:ubound(past%steady%p, 1), 0:ubound(past%steady%p, 2), 0:3))
      do n = 3, 1, -1
         if (is_new) then
            call period%look_up(t - n*dt, past%known_p(:, :, n), past%known_delta(n))
         else
            past%known_p(:, :, n) = past%known_p(:, :, n - 1)
            past%known_delta(n) = past%known_delta(n - 1)
         end if
      end do
      call period%look_up(t, past%known_p(:, :, 0), past%known_delta(0))
   end subroutine look_up

end module ehlwave_first_guess
