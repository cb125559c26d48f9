!> Steps of an iteration kept within bounds: no pressure jumps, no film closes.
module ehlwave_step_limit
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_kinds, only: dp
   use ehlwave_state, only: state_t
   use ehlwave_threads, only: is_shared
   implicit none (type, external)
   private

   type, public :: step_limit_t
      real(dp) :: largest_change = 0.3_dp         !! change of a pressure in a step
      real(dp) :: smallest_film_factor = 0.1_dp   !! film thickness over its value before the step
   contains
      procedure :: bounded
      procedure :: of_pressure
      procedure :: of_film
      procedure :: shorten
   end type step_limit_t

contains

   !> Change of pressure of a node, within the bound: nodes of a steep end that exceed it do not limit the others.
   elemental real(dp) function bounded(self, change)
      class(step_limit_t), intent(in) :: self
      real(dp), intent(in) :: change   !! change of P
      bounded = max(-self%largest_change, min(change, self%largest_change))
   end function bounded

   !> Share of a change of pressure, at most 1, that the bound on pressures allows. 0 where the largest is not finite.
   real(dp) function of_pressure(self, change) result(share)
      class(step_limit_t), intent(in) :: self
      real(dp), intent(in) :: change(:, :)   !! change of P
      real(dp) :: largest(size(change, 2))
      integer :: j
      !$omp parallel do schedule(static) if (is_shared(size(change)))
      do j = 1, size(largest)
         largest(j) = maxval(abs(change(:, j)))
      end do
      share = 0
      if (ieee_is_finite(maxval(largest))) share = share_of(self, maxval(largest))
   end function of_pressure

   !> Share of a change of film, at most 1, that the bound on films allows.
   real(dp) function of_film(self, h, change) result(share)
      class(step_limit_t), intent(in) :: self
      real(dp), intent(in) :: h(:, :)        !! H before the change
      real(dp), intent(in) :: change(:, :)   !! change of H
      real(dp) :: shares(size(h, 2))
      integer :: j
      !$omp parallel do schedule(static) if (is_shared(size(h)))
      do j = 1, size(shares)
         shares(j) = row_of_film(self, h(:, j), change(:, j))
      end do
      share = minval(shares)
   end function of_film

   !> Share of the largest change of a pressure, at most 1, that its bound allows.
   pure real(dp) function share_of(self, largest) result(share)
      class(step_limit_t), intent(in) :: self
      real(dp), intent(in) :: largest
      share = 1
      if (largest > self%largest_change) share = self%largest_change/largest
   end function share_of

   !> `of_film` of a row.
   pure real(dp) function row_of_film(self, h, change) result(share)
      class(step_limit_t), intent(in) :: self
      real(dp), intent(in) :: h(:), change(:)
      integer :: i
      share = 1
      do i = 1, size(h)
         if (share*change(i) < (self%smallest_film_factor - 1)*h(i)) &
            share = (self%smallest_film_factor - 1)*h(i)/change(i)
      end do
   end function row_of_film

   !> Go from `before` towards `state` no farther than the bounds allow. The film is linear in P and Delta, so the
   !> film of a shortened step needs no new deformation.
   subroutine shorten(self, before, state)
      class(step_limit_t), intent(in) :: self
      type(state_t), intent(in) :: before      !! P, H, Delta before the step
      type(state_t), intent(inout) :: state    !! after the whole step; after the limited one on return
      real(dp) :: share(size(state%p, 2)), step
      integer :: j, row

      !$omp parallel do private(j) schedule(static) if (is_shared(size(state%p)))
      do row = 1, size(share)
         j = lbound(state%p, 2) + row - 1
         share(row) = min(share_of(self, maxval(abs(state%p(:, j) - before%p(:, j)))), &
                          row_of_film(self, before%h(:, j), state%h(:, j) - before%h(:, j)))
      end do
      step = minval(share)
      if (.not. step < 1) return
      state%p = before%p + step*(state%p - before%p)
      state%h = before%h + step*(state%h - before%h)
      state%delta = before%delta + step*(state%delta - before%delta)
   end subroutine shorten

end module ehlwave_step_limit
