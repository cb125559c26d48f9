!> First guess of a time step from the solutions before it.
module ehlwave_first_guess
   use ehlwave_kinds, only: dp
   use ehlwave_known_waves, only: known_waves_t
   use ehlwave_last_period, only: last_period_t
   use ehlwave_neighbour_range, only: held_at_steep_end
   use ehlwave_state, only: state_t
   use ehlwave_threads, only: is_shared
   implicit none (type, external)
   private
   public :: carry_on, extrapolate

   !> Solutions that the first guess is made from.
   type, public :: past_t
      type(state_t) :: steady, before, earlier, earliest  ! solutions for smooth surfaces; at T - dT, T - 2 dT, T - 3 dT
      type(last_period_t) :: period                       ! of waves that repeat
   end type past_t

   real(dp), parameter :: outlet_fall = 0.5_dp   !! share of the steady P that it falls over two cells at its outlet end

contains

   !> First guess: P0, which is the solution a period before or else the steady state, plus the extrapolated difference
   !> p = P - P0. Two operators act on p in turn, theory eq. (D16): one vanishes for waves of the frequency w at a fixed
   !> place, the other for a disturbance that the oil carries along. In a march from rest no oil carries waves to the
   !> outlet end of the pressure at first: there the other vanishes for a p that stays the same. At steep ends pressures
   !> stay in the range of P0 and their neighbours at the step before.
   subroutine extrapolate(m, wave_step, t, dt, past, state, from_rest)
      integer, intent(in) :: m                       !! cells that a feature travels per step, 0: less than one
      real(dp), intent(in) :: wave_step              !! w dT of the waves, 0: none
      real(dp), intent(in) :: t, dt                  !! time of the step
      type(past_t), intent(in) :: past
      type(state_t), intent(inout) :: state
      logical, intent(in) :: from_rest               !! whether the waves came in at the inlet
      real(dp), allocatable :: p0(:, :, :)           ! (0:nx, 0:ny, 0:3): P0 at T, T - dT, ...
      real(dp) :: delta0(0:3), guess, twice          ! twice: 2 cos(w dT)
      integer :: i, j, l, n

      twice = 2*cos(wave_step)
      associate (steady => past%steady%p, p1 => past%before%p, p2 => past%earlier%p, p3 => past%earliest%p)
         allocate (p0(0:ubound(steady, 1), 0:ubound(steady, 2), 0:3))
         do n = 0, 3
            if (past%period%is_known()) then
               call past%period%look_up(t - n*dt, p0(:, :, n), delta0(n))
            else
               p0(:, :, n) = steady
               delta0(n) = past%steady%delta
            end if
         end do
         !$omp parallel do private(i, l, guess) schedule(static) if (is_shared(size(steady)))
         do j = 0, ubound(steady, 2)
            do i = 0, ubound(steady, 1) - 1
               l = merge(i - m, i, i > m)      ! where the oil was a step before
               if (from_rest .and. steady(max(i - 1, 0), j) - steady(i + 1, j) > outlet_fall*steady(i, j)) l = i
               guess = p0(i, j, 0) + continued(twice, &
                  [p1(i, j), p2(i, j), p3(i, j)] - p0(i, j, 1:), [p1(l, j), p2(l, j), p3(l, j)] - p0(l, j, 1:))
               state%p(i, j) = max(0.0_dp, held_at_steep_end(guess, p1, i, j, besides=p0(i, j, 0)))
            end do
         end do
      end associate
      associate (d => [past%before%delta, past%earlier%delta, past%earliest%delta] - delta0(1:))
         state%delta = delta0(0) + continued(twice, d, d)
      end associate
   end subroutine extrapolate

   !> The next value of a disturbance from its last three, the latest first, here and upstream: theory eq. (D16).
   pure real(dp) function continued(twice, here, upstream)
      real(dp), intent(in) :: twice                  !! 2 cos(w dT)
      real(dp), intent(in) :: here(3), upstream(3)   !! at T - dT, T - 2 dT, T - 3 dT
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

end module ehlwave_first_guess
