!> Pressures held in the range of their neighbours.
!>
!> The steep end of the pressure moves by less than a cell between successive states, and an extrapolation or an
!> expansion across it would be off by half the Hertz pressure.
module ehlwave_neighbour_range
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: held_at_steep_end

   real(dp), parameter :: margin = 0.02_dp  !! range of P beyond; measured: fewest Newton steps of first guesses between
                                             !! 0.005 and 0.05
   real(dp), parameter :: steep = 0.15_dp   !! change of P between neighbours at a steep end

contains

   !> A pressure at node (i, j); at a steep end not beyond the values of a known state there and at its neighbours, with
   !> a margin. Elsewhere waves have crests between nodes, which no range of neighbours contains.
   pure real(dp) function held_at_steep_end(guess, p, i, j, besides) result(held)
      real(dp), intent(in) :: guess
      real(dp), intent(in) :: p(0:, 0:)   !! known state, (0:nx, 0:ny)
      integer, intent(in) :: i, j
      real(dp), intent(in), optional :: besides   !! value that the range contains, too
      real(dp) :: highest, lowest
      held = guess
      if (abs(guess - p(i, j)) <= margin) return
      associate (near => p(max(i - 1, 0):min(i + 1, ubound(p, 1)), max(j - 1, 0):min(j + 1, ubound(p, 2))))
         lowest = minval(near)
         highest = maxval(near)
      end associate
      if (highest - lowest <= steep) return
      if (present(besides)) lowest = min(lowest, besides)
      if (present(besides)) highest = max(highest, besides)
      held = min(max(guess, lowest - margin), highest + margin)
   end function held_at_steep_end

end module ehlwave_neighbour_range
