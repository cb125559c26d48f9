!> The part of the deformation that a sparse approximation of the Jacobian keeps: that by the nearest cells.
module ehlwave_near_kernel
   use ehlwave_grid, only: grid_t
   use ehlwave_kernel, only: cell_influence, line_reference
   use ehlwave_kinds, only: dp, pi
   implicit none (type, external)
   private
   public :: new_near_kernel

   !> How far the pattern reaches, and what is done to the kernel at its edge.
   type, public :: near_settings_t
      integer :: least_x = 2                       !! smallest reach along X: the wedge alone reaches two nodes upstream
      real(dp) :: stretch_x = 1, stretch_y = 1     !! reach over that of a pattern isotropic in metres
      logical :: is_softened = .false.             !! soften the kernel instead of tapering it
      real(dp) :: taper = 0                        !! power of the taper, 0: plain cut
   end type near_settings_t

   !> Influence coefficients of a pattern.
   type, public :: near_kernel_t
      integer :: reach_x = 2, reach_y = 1          !! largest offsets
      integer :: entries = 15                      !! of the pattern
      real(dp), allocatable :: influence(:, :)     !! (-reach_x-2:reach_x+2, -reach_y-1:reach_y+1) of a cell at an offset
   contains
      procedure :: entry_at
   end type near_kernel_t

   integer, parameter :: largest_reach = 8      !! keeps memory bounded
   real(dp), parameter :: softening_reach = 3   !! radius of the softening over the reach of the pattern

contains

   !> Pattern isotropic in metres but for its stretch: cells measure a hX by b hY, so it reaches hY/(kappa hX) cells along
   !> X for one along Y, or the reverse; at most `largest_reach`. That of a line contact reaches as far as it may.
   !>
   !> A kernel that is simply cut has a symbol that is negative for waves of two cells along Y, which makes factors of the
   !> matrix amplify there, and that oscillates. Tapered, it is multiplied by a power of
   !> (1 - |i|/(reach_x+1)) (1 - |j|/(reach_y+1)); with power 1 (the Bartlett window, whose symbol is positive) its symbol
   !> is positive for all waves. Softened, only the part of 1/r that is not smooth is kept,
   !>
   !>     1/r - (15/8 - 5/4 (r/R)^2 + 3/8 (r/R)^4)/R    for r < R,    R = 3 (reach + 1) mesh sizes,
   !>
   !> so that at short wavelengths what is kept has the spectrum of the whole; coarser grids see to the smooth rest. Of the
   !> influence ln(1/r) of a line, in the same way, 3/4 - (r/R)^2 + 1/4 (r/R)^4 is taken away besides ln(1/R).
   pure function new_near_kernel(grid, kappa, k, settings) result(self)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa, k        !! ellipticity and complete elliptic integral
      type(near_settings_t), intent(in) :: settings
      type(near_kernel_t) :: self
      real(dp) :: aspect, radius
      integer :: i, j

      if (grid%is_line) then
         self%reach_x = largest_reach
         self%reach_y = 0
         radius = softening_reach*(self%reach_x + 1)*grid%hx
      else
         aspect = grid%hy/(kappa*grid%hx)
         self%reach_x = min(largest_reach, max(settings%least_x, nint(settings%stretch_x*aspect)))
         self%reach_y = min(largest_reach, max(1, nint(settings%stretch_y/aspect)))
         radius = softening_reach*min((self%reach_x + 1)*kappa*grid%hx, (self%reach_y + 1)*grid%hy)
      end if
      self%entries = (2*self%reach_x + 1)*(2*self%reach_y + 1)
      allocate (self%influence(-self%reach_x - 2:self%reach_x + 2, -self%reach_y - 1:self%reach_y + 1))
      do j = -self%reach_y - 1, self%reach_y + 1
         do i = -self%reach_x - 2, self%reach_x + 2
            self%influence(i, j) = cell_influence(i*grid%hx, j*grid%hy, grid%hx, grid%hy, kappa, k)
            if (settings%is_softened) then
               self%influence(i, j) = self%influence(i, j) - smooth_part(grid, kappa, k, i, j, radius)
            else if (settings%taper > 0) then
               self%influence(i, j) = window(self, i, j)**settings%taper*self%influence(i, j)
            end if
         end do
      end do
   end function new_near_kernel

   !> Entry of an offset within the reaches: those of one offset along X together.
   pure integer function entry_at(self, di, dj)
      class(near_kernel_t), intent(in) :: self
      integer, intent(in) :: di, dj   !! offset
      entry_at = (di + self%reach_x)*(2*self%reach_y + 1) + dj + self%reach_y + 1
   end function entry_at

   !> Bartlett window of the pattern.
   pure real(dp) function window(self, i, j)
      type(near_kernel_t), intent(in) :: self
      integer, intent(in) :: i, j   !! offset
      window = max(0.0_dp, 1 - abs(i)/(self%reach_x + 1.0_dp))*max(0.0_dp, 1 - abs(j)/(self%reach_y + 1.0_dp))
   end function window

   !> Smooth part of the influence of a cell: all of it beyond the radius.
   pure real(dp) function smooth_part(grid, kappa, k, i, j, radius)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa, k
      integer, intent(in) :: i, j          !! offset
      real(dp), intent(in) :: radius       !! R, in the units of kappa hX and hY; of a line of hX
      real(dp) :: r

      if (grid%is_line) then
         r = abs(i)*grid%hx/radius
         smooth_part = 2/pi*grid%hx*(log(line_reference/radius) + 0.75_dp - r**2 + 0.25_dp*r**4)
         return
      end if
      r = hypot(i*kappa*grid%hx, j*grid%hy)/radius
      smooth_part = (15 - 10*r**2 + 3*r**4)/(8*radius)*grid%hx*grid%hy/(pi*k)
      if (r >= 1) smooth_part = cell_influence(i*grid%hx, j*grid%hy, grid%hx, grid%hy, kappa, k)
   end function smooth_part

end module ehlwave_near_kernel
