!> First guess of a time step from the solutions before it.
module ehlwave_first_guess
   use ehlwave_equations, only: equations_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_known_waves, only: known_waves_t
   use ehlwave_last_period, only: last_period_t
   use ehlwave_neighbour_range, only: held, neighbour_range
   use ehlwave_state, only: state_t
   use ehlwave_threads, only: is_shared
   implicit none (type, external)
   private
   public :: carried_share, carry_on, extrapolate, look_up

   !> Solutions that the first guess is made from.
   type, public :: past_t
      type(state_t) :: steady, before, earlier, earliest  ! solutions for smooth surfaces; at T - dT, T - 2 dT, T - 3 dT
      ! (0:nx, 0:ny, 0:3): a period before T, T - dT, ...; absent: none
      real(dp), allocatable :: known_p(:, :, :)
      real(dp) :: known_delta(0:3) = 0
   end type past_t

   real(dp), parameter :: spread_weight = 1000   !! measured: fewest Newton steps between 100 and 10^4

contains

   !> How much of a pressure disturbance is carried along with the film rather than spread by Poiseuille flow,
   !> 0 to 1 at each node: 1/(1 + weight eps/(hX K0)), K0 the deformation under a cell of unit pressure.
   function carried_share(level) result(share)
      type(level_t), intent(in) :: level    !! at its steady state
      real(dp), allocatable :: share(:, :)
      type(equations_t) :: equations

      call equations%init(level%problem)
      call equations%evaluate(level%problem, level%given, level%state)
      share = 1/(1 + spread_weight*equations%flow%mobility()/(level%problem%grid%hx*equations%self_influence))
   end function carried_share

   !> First guess: P0, which is the solution a period before or else the steady state, plus the extrapolated difference,
   !> p = P - P0. Where the oil carries the film, extrapolation follows the characteristic: 3 p(i-m, k-1) - 3 p(i-2m,
   !> k-2) + p(i-3m, k-3); elsewhere in time at fixed X: 3 p(k-1) - 3 p(k-2) + p(k-3); in between, by share. The latter
   !> stays in the range of the neighbours at the step before.
   subroutine extrapolate(m, share, past, state)
      integer, intent(in) :: m                       !! cells that a feature travels per step
      real(dp), intent(in) :: share(0:, 0:)          !! (0:nx, 0:ny)
      type(past_t), intent(in) :: past
      type(state_t), intent(inout) :: state

      if (allocated(past%known_p)) then
         associate (known => past%known_p)
            call extrapolate_about(m, share, past, known(:, :, 0), known(:, :, 1), known(:, :, 2), known(:, :, 3), &
               state%p)
         end associate
      else
         associate (p0 => past%steady%p)
            call extrapolate_about(m, share, past, p0, p0, p0, p0, state%p)
         end associate
      end if
      associate (known => past%known_delta)
         state%delta = known(0) + 3*((past%before%delta - known(1)) - (past%earlier%delta - known(2))) &
                       + past%earliest%delta - known(3)
      end associate
   end subroutine extrapolate

   !> The pressure of `extrapolate`, by P0 at T, T - dT, T - 2 dT and T - 3 dT.
   subroutine extrapolate_about(m, share, past, now, then1, then2, then3, p)
      integer, intent(in) :: m
      real(dp), dimension(0:, 0:), intent(in) :: share, now, then1, then2, then3   !! (0:nx, 0:ny)
      type(past_t), intent(in) :: past
      real(dp), intent(inout) :: p(0:, 0:)
      real(dp) :: moved, still
      integer :: i, j

      associate (p1 => past%before%p, p2 => past%earlier%p, p3 => past%earliest%p)
         !$omp parallel do private(i, j, moved, still) schedule(static) if (is_shared(size(p)))
         do j = 0, ubound(p, 2)
            do i = 0, ubound(p, 1) - 1
               still = now(i, j) + 3*((p1(i, j) - then1(i, j)) - (p2(i, j) - then2(i, j))) + (p3(i, j) - then3(i, j))
               moved = still
               if (i > 3*m) moved = now(i, j) &
                  + 3*((p1(i - m, j) - then1(i - m, j)) - (p2(i - 2*m, j) - then2(i - 2*m, j))) &
                                    + (p3(i - 3*m, j) - then3(i - 3*m, j))
               still = held(still, neighbour_range(p1, i, j))
               p(i, j) = max(0.0_dp, share(i, j)*moved + (1 - share(i, j))*still)
            end do
         end do
      end associate
   end subroutine extrapolate_about

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
