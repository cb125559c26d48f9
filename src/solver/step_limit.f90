!> Steps of an iteration kept within bounds: no pressure jumps, no film closes.
module ehlwave_step_limit
   use ehlwave_kinds, only: dp
   use ehlwave_state, only: state_t
   implicit none (type, external)
   private
   public :: limit_step

   real(dp), parameter :: largest_change = 0.3_dp         !! of a pressure in one step
   real(dp), parameter :: smallest_film_factor = 0.1_dp   !! of a film thickness over its value before the step

contains

   !> Go from `before` towards `state` no farther than the bounds allow. The film is linear in P and Delta, so that of
   !> the shortened step needs no new deformation.
   pure subroutine limit_step(before, state)
      type(state_t), intent(in) :: before      !! P, H, Delta before the step
      type(state_t), intent(inout) :: state    !! after the whole step; after the limited one on return
      real(dp) :: step, largest
      integer :: i, j

      largest = 0
      step = 1
      do j = 0, ubound(state%p, 2)
         do i = 0, ubound(state%p, 1)
            largest = max(largest, abs(state%p(i, j) - before%p(i, j)))
            if (state%h(i, j) < smallest_film_factor*before%h(i, j)) &
               step = min(step, (1 - smallest_film_factor)*before%h(i, j)/(before%h(i, j) - state%h(i, j)))
         end do
      end do
      if (largest*step > largest_change) step = largest_change/largest
      if (.not. step < 1) return
      state%p = before%p + step*(state%p - before%p)
      state%h = before%h + step*(state%h - before%h)
      state%delta = before%delta + step*(state%delta - before%delta)
   end subroutine limit_step

end module ehlwave_step_limit
