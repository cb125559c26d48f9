!> The share of the smooth part of a residual that a preconditioner leaves to its coarser grid.
module ehlwave_smooth_share
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: set_smooth_share

   real(dp), parameter :: largest_share = 0.8_dp

contains

   !> How much of what the coarser grid can represent is to be taken from a residual before the factors of this grid
   !> answer it. They know the deformation by the nearest cells only; for smooth changes of pressure that is a small part
   !> of it, so their answer to a smooth residual is several times too large, the more the finer the grid, and would spoil
   !> the correction from the coarser grid. That is so where the node's own deformation makes up most of the diagonal,
   !> which is at high pressure: there the share is large, where Poiseuille flow rules it is small.
   pure subroutine set_smooth_share(scale, wedge, f_h, self_influence, share)
      real(dp), intent(in) :: scale(:, :)        !! 1/|A_ii|
      real(dp), intent(in) :: wedge(:)           !! weight of rho H at a node in its own residual, along X
      real(dp), intent(in) :: f_h(:, :)          !! derivative of rho H by H
      real(dp), intent(in) :: self_influence     !! deformation at a node under its own unit pressure
      real(dp), intent(out) :: share(:, :)       !! 0 where `scale` is
      integer :: i, j
      do j = 1, size(share, 2)
         do i = 1, size(share, 1)
            share(i, j) = largest_share*sqrt(scale(i, j)*wedge(i)*f_h(i, j)*self_influence)
         end do
      end do
   end subroutine set_smooth_share

end module ehlwave_smooth_share
