!> First guess of a time step from the solutions before it.
module ehlwave_first_guess
   use ehlwave_equations, only: equations_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_state, only: state_t
   implicit none (type, external)
   private
   public :: carried_share, extrapolate

   !> Solutions that the first guess is made from.
   type, public :: past_t
      type(state_t) :: steady, before, earlier, earliest   ! of smooth surfaces; at T - dT, T - 2 dT, T - 3 dT
   end type past_t

   real(dp), parameter :: spread_weight = 1000   !! measured: fewest Newton steps between 100 and 10^4
   real(dp), parameter :: guess_margin = 0.02_dp !! measured: the same between 0.005 and 0.05

contains

   !> How much of a pressure disturbance is carried along with the film rather than spread by Poiseuille flow,
   !> 0 to 1 at each node: 1/(1 + weight eps/(hX K0)), K0 the deformation under a cell of unit pressure.
   function carried_share(level) result(share)
      type(level_t), intent(in) :: level    !! at its steady state
      real(dp), allocatable :: share(:, :)
      type(equations_t) :: equations

      call equations%init(level%problem)
      call equations%evaluate(level%problem, level%state)
      share = 1/(1 + spread_weight*equations%flow%mobility()/(level%problem%grid%hx*equations%self_influence))
   end function carried_share

   !> First guess. Where the film is carried along, what deviates from the steady state P0 is extrapolated
   !> along the characteristic: P0(i) + 2 p(i-m, k-1) - p(i-2m, k-2), p = P - P0; elsewhere in time at fixed X:
   !> 3 P(k-1) - 3 P(k-2) + P(k-3); in between, by share. What is extrapolated in time stays within the range of the
   !> neighbours at the step before and a small margin: the steep end of the pressure moves by less than a cell in one step, and
   !> an extrapolation across it would be off by half the Hertz pressure.
   pure subroutine extrapolate(m, share, past, state)
      integer, intent(in) :: m                       !! cells that a feature travels in one step
      real(dp), intent(in) :: share(0:, 0:)          !! (0:nx, 0:ny)
      type(past_t), intent(in) :: past
      type(state_t), intent(inout) :: state
      real(dp) :: moved, still
      integer :: i, j
      associate (p0 => past%steady%p, p1 => past%before%p, p2 => past%earlier%p, p3 => past%earliest%p)
         do j = 0, ubound(state%p, 2)
            do i = 0, ubound(state%p, 1) - 1
               still = 3*(p1(i, j) - p2(i, j)) + p3(i, j)
               moved = still
               if (i > 3*m) moved = p0(i, j) + 3*(p1(i - m, j) - p0(i - m, j)) - 3*(p2(i - 2*m, j) - p0(i - 2*m, j)) &
                  + p3(i - 3*m, j) - p0(i - 3*m, j)
               associate (near => p1(max(i - 1, 0):i + 1, max(j - 1, 0):min(j + 1, ubound(p1, 2))))
                  still = min(max(still, minval(near) - guess_margin), maxval(near) + guess_margin)
               end associate
               state%p(i, j) = max(0.0_dp, share(i, j)*moved + (1 - share(i, j))*still)
            end do
         end do
      end associate
      state%delta = 3*(past%before%delta - past%earlier%delta) + past%earliest%delta
   end subroutine extrapolate

end module ehlwave_first_guess
