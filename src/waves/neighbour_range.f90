!> Pressures held in the range of their neighbours.
!>
!> The steep end of the pressure moves by less than a cell between successive states, and an extrapolation or an
!> expansion across it would be off by half the Hertz pressure.
module ehlwave_neighbour_range
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: held, neighbour_range

   real(dp), parameter :: margin = 0.02_dp  !! range of P beyond; measured: fewest Newton steps of first guesses between
                                             !! 0.005 and 0.05

contains

   !> Lowest and highest value at node (i, j) and its neighbours.
   pure function neighbour_range(p, i, j) result(range)
      real(dp), intent(in) :: p(0:, 0:)   !! (0:nx, 0:ny)
      integer, intent(in) :: i, j
      real(dp) :: range(2)
      associate (near => p(max(i - 1, 0):min(i + 1, ubound(p, 1)), max(j - 1, 0):min(j + 1, ubound(p, 2))))
         range = [minval(near), maxval(near)]
      end associate
   end function neighbour_range

   !> A pressure, or the end of a range and its margin.
   pure real(dp) function held(p, range)
      real(dp), intent(in) :: p, range(2)
      held = min(max(p, range(1) - margin), range(2) + margin)
   end function held

end module ehlwave_neighbour_range
