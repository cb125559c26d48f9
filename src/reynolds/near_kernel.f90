!> The part of the deformation that a sparse approximation of the Jacobian keeps: that by the nearest cells.
module ehlwave_near_kernel
   use ehlwave_grid, only: grid_t
   use ehlwave_kernel, only: kernel_t, new_kernel
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: new_near_kernel

   !> Reach of the pattern, and treatment of the kernel at its edge.
   type, public :: near_settings_t
      integer :: least_x = 2                       !! smallest reach along X: the wedge alone reaches two nodes upstream
      integer :: least_fine_x = 3                  !! least reach on grids of more than `fine_cells` along X
      real(dp) :: stretch_x = 1, stretch_y = 1     !! reach relative to a pattern isotropic in metres
      real(dp) :: taper = 0                        !! power of the taper, 0: plain cut
      real(dp) :: least_taper = 0                  !! taper of patterns of an ellipse with the least reach
   end type near_settings_t

   !> Influence coefficients of a pattern.
   type, public :: near_kernel_t
      integer :: reach_x = 2, reach_y = 1          !! largest offsets
      integer :: entries = 15                      !! entries of the pattern
      real(dp), allocatable :: influence(:, :)     !! (-reach_x-2:reach_x+2, -reach_y-1:reach_y+1) of a cell at an
                                                   !! offset
   contains
      procedure :: entry_at
   end type near_kernel_t

   integer, parameter :: largest_reach = 8   !! keeps memory bounded

   !> Measured (M = 1000, L = 12.05, D = 1, Newton's method): with three nodes for two GMRES takes 12 steps in place of
   !> 27 on 1024^2 cells for two thirds of the work, 15 in place of 23 on 512^2 for as much, 12 in place of 14 on 256^2
   !> for a tenth more.
   integer, parameter :: fine_cells = 512

contains

   !> Pattern isotropic in metres but for its stretch: cells measure a hX by b hY, so it reaches hY/(kappa hX) cells
   !> along X per cell along Y, or the reverse; at most `largest_reach`. In a line contact it takes the largest reach.
   !>
   !> A kernel that is simply cut has a symbol that oscillates and is negative for waves of two cells along Y, which
   !> makes factors of the matrix amplify there. So it is tapered: multiplied by a power of (1 - |i|/(reach_x+1)) (1 -
   !> |j|/(reach_y+1)); with power 1 (the Bartlett window, whose symbol is positive) its symbol is positive for all
   !> waves.
   pure function new_near_kernel(grid, kappa, k, settings, along) result(self)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa, k        !! ellipticity and complete elliptic integral
      type(near_settings_t), intent(in) :: settings
      real(dp), intent(in), optional :: along   !! wave number along a line contact, 1/a; absent: 0
      type(near_kernel_t) :: self
      type(kernel_t) :: kernel
      real(dp) :: aspect, taper
      integer :: i, j, least

      taper = settings%taper
      if (grid%is_line) then
         self%reach_x = largest_reach
         self%reach_y = 0
      else
         aspect = grid%hy/(kappa*grid%hx)
         least = settings%least_x
         if (grid%nx > fine_cells) least = max(least, settings%least_fine_x)
         self%reach_x = min(largest_reach, max(least, nint(settings%stretch_x*aspect)))
         self%reach_y = min(largest_reach, max(1, nint(settings%stretch_y/aspect)))
         if (self%reach_x == least .and. self%reach_y == 1) taper = settings%least_taper
      end if
      self%entries = (2*self%reach_x + 1)*(2*self%reach_y + 1)
      allocate (self%influence(-self%reach_x - 2:self%reach_x + 2, -self%reach_y - 1:self%reach_y + 1))
      kernel = new_kernel(grid, kappa, k, along)
      do j = -self%reach_y - 1, self%reach_y + 1
         do i = -self%reach_x - 2, self%reach_x + 2
            self%influence(i, j) = kernel%at(i, j)
            if (taper > 0) self%influence(i, j) = window(self, i, j)**taper*self%influence(i, j)
         end do
      end do
   end function new_near_kernel

   !> Entry of an offset within the reaches, sorted by offset along X.
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

end module ehlwave_near_kernel
