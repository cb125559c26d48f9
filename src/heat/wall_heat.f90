!> Temperature of a surface that moves along X under a heat flow: the fast moving half-space, theory eq. (T7).
module ehlwave_wall_heat
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: wall_weights

contains

   !> Weights w of the heat flows q at and upstream of a place in
   !>
   !>     integral q(X') (X - X')^(-1/2) dX' = sum over m of w(m) q(X - m hX),
   !>
   !> exact for flows that are linear between nodes. The flow begins with 0.
   pure function wall_weights(nx, hx) result(w)
      integer, intent(in) :: nx
      real(dp), intent(in) :: hx
      real(dp) :: w(0:nx)
      integer :: m
      w(0) = 4*sqrt(hx)/3
      do m = 1, nx
         w(m) = w(0)*(sqrt(m + 1.0_dp)**3 - 2*sqrt(real(m, dp))**3 + sqrt(m - 1.0_dp)**3)
      end do
   end function wall_weights

end module ehlwave_wall_heat
