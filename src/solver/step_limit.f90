!> Steps of an iteration kept within bounds: no pressure jumps, no film closes.
module ehlwave_step_limit
   use ehlwave_kinds, only: dp
   use ehlwave_state, only: state_t
   use ehlwave_threads, only: is_shared
   implicit none (type, external)
   private

   type, public :: step_limit_t
      real(dp) :: largest_change = 0.3_dp         !! of a pressure in one step
      real(dp) :: smallest_film_factor = 0.1_dp   !! of a film thickness over its value before the step
   contains
      procedure :: bounded
      procedure :: of_pressure
      procedure :: of_film
      procedure :: shorten
   end type step_limit_t

contains

   !> A change of pressure of one node, within the bound: where a few nodes of a steep end ask for more, the others go
   !> all the way.
   elemental real(dp) function bounded(self, change)
      class(step_limit_t), intent(in) :: self
      real(dp), intent(in) :: change   !! of P
      bounded = max(-self%largest_change, min(change, self%largest_change))
   end function bounded

   !> Share of a change of pressure, at most 1, that the bound on pressures allows.
   pure real(dp) function of_pressure(self, change) result(share)
      class(step_limit_t), intent(in) :: self
      real(dp), intent(in) :: change(:, :)   !! of P
      real(dp) :: largest
      largest = maxval(abs(change))
      share = 1
      if (largest > self%largest_change) share = self%largest_change/largest
   end function of_pressure

   !> Share of a change of film, at most 1, that the bound on films allows.
   pure real(dp) function of_film(self, h, change) result(share)
      class(step_limit_t), intent(in) :: self
      real(dp), intent(in) :: h(:, :)        !! H before the change
      real(dp), intent(in) :: change(:, :)   !! of H
      integer :: i, j
      share = 1
      do j = 1, size(h, 2)
         do i = 1, size(h, 1)
            if (share*change(i, j) < (self%smallest_film_factor - 1)*h(i, j)) &
               share = (self%smallest_film_factor - 1)*h(i, j)/change(i, j)
         end do
      end do
   end function of_film

   !> Go from `before` towards `state` no farther than the bounds allow. The film is linear in P and Delta, so that of
   !> the shortened step needs no new deformation.
   subroutine shorten(self, before, state)
      class(step_limit_t), intent(in) :: self
      type(state_t), intent(in) :: before      !! P, H, Delta before the step
      type(state_t), intent(inout) :: state    !! after the whole step; after the limited one on return
      real(dp) :: share(size(state%p, 2)), step
      integer :: j, row

      !$omp parallel do private(j) schedule(static) if (is_shared(size(state%p)))
      do row = 1, size(share)
         j = lbound(state%p, 2) + row - 1
         share(row) = min(self%of_pressure(state%p(:, j:j) - before%p(:, j:j)), &
                          self%of_film(before%h(:, j:j), state%h(:, j:j) - before%h(:, j:j)))
      end do
      step = minval(share)
      if (.not. step < 1) return
      state%p = before%p + step*(state%p - before%p)
      state%h = before%h + step*(state%h - before%h)
      state%delta = before%delta + step*(state%delta - before%delta)
   end subroutine shorten

end module ehlwave_step_limit
