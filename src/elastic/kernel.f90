!> Influence coefficients of the elastic half-space for pressure constant per cell, and of higher order.
module ehlwave_kernel
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp, pi
   implicit none (type, external)
   private
   public :: cell_bend, cell_influence, corner, line_wave_influence, new_kernel

   !> Distance, in units of a, at which the deformation of a line contact counts as zero. A line load deforms a
   !> half-space up to a constant, which the mutual approach absorbs. The kernel is positive on any domain.
   real(dp), parameter, public :: line_reference = 16

   !> Deformation of the nodes of a grid by the pressures there. A cell has the pressure of its node or the mean of a
   !> pressure that is curved, theory eq. (D18): P + (second differences of P along X and Y)/24.
   type, public :: kernel_t
      real(dp) :: hx = 0, hy = 0         !! cell size
      real(dp) :: kappa = 1, k = 0       !! ellipticity a/b and complete elliptic integral
      real(dp) :: along = 0              !! wave number along a line contact, 1/a
      logical :: is_raised = .false.     !! whether pressures are curved
   contains
      procedure :: at => kernel_at
      procedure, private :: of_cell
   end type kernel_t

   !> Share of the second difference in the mean of a cell.
   real(dp), parameter, public :: cell_curvature = 1/24.0_dp

contains

   !> Kernel of a grid; kappa and K of the contact.
   pure function new_kernel(grid, kappa, k, along) result(self)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa, k          !! ellipticity a/b, complete elliptic integral of the first kind
      real(dp), intent(in), optional :: along   !! wave number along a line contact, 1/a; absent: 0
      type(kernel_t) :: self
      self = kernel_t(grid%hx, grid%hy, kappa, k, is_raised=grid%has_curved_pressure)
      if (present(along)) self%along = along
   end function new_kernel

   !> Deformation at a distance of i cells along X and j along Y from a node with P = 1.
   elemental real(dp) function kernel_at(self, i, j) result(d)
      class(kernel_t), intent(in) :: self
      integer, intent(in) :: i, j
      d = self%of_cell(i, j)
      if (.not. self%is_raised) return
      d = d - cell_curvature*(self%of_cell(i - 1, j) - 2*self%of_cell(i, j) + self%of_cell(i + 1, j) &
                              + self%of_cell(i, j - 1) - 2*self%of_cell(i, j) + self%of_cell(i, j + 1))
   end function kernel_at

   !> Share that curved pressures add to the transform of a kernel, along one direction: `cell_curvature` times minus
   !> the second difference of a wave over the wave.
   elemental real(dp) function cell_bend(angle)
      real(dp), intent(in) :: angle        !! of the wave per cell
      cell_bend = 2*cell_curvature*(1 - cos(angle))
   end function cell_bend

   !> Deformation by P = 1 in a cell.
   elemental real(dp) function of_cell(self, i, j) result(d)
      class(kernel_t), intent(in) :: self
      integer, intent(in) :: i, j
      if (self%along > 0) then
         d = line_wave_influence(i*self%hx, self%hx, self%along)
      else
         d = cell_influence(i*self%hx, j*self%hy, self%hx, self%hy, self%kappa, self%k)
      end if
   end function of_cell

   !> Deformation at distance (dx, dy) from the centre of a cell of size hx by hy under P = 1, exact
   !> integral of theory eq. (9) (Love 1929), (D4):
   !>
   !>     1/(pi K) int int dX' dY' / sqrt(kappa^2 (X - X')^2 + (Y - Y')^2)
   !>
   !> For a line contact, kappa = 0, any dy gives (L7):
   !>
   !>     (2/pi) int ln(line_reference/|X - X'|) dX'
   elemental function cell_influence(dx, dy, hx, hy, kappa, k) result(d)
      real(dp), intent(in) :: dx, dy    !! distance in X and Y
      real(dp), intent(in) :: hx, hy    !! cell size in X and Y
      real(dp), intent(in) :: kappa     !! ellipticity a/b
      real(dp), intent(in) :: k         !! complete elliptic integral of the first kind
      real(dp) :: d
      real(dp) :: u1, u2, v1, v2

      if (.not. kappa > 0) then
         u1 = dx - 0.5_dp*hx
         u2 = dx + 0.5_dp*hx
         d = 2/pi*(log_integral(u2) - log_integral(u1))
         return
      end if
      u1 = kappa*(dx - 0.5_dp*hx)
      u2 = kappa*(dx + 0.5_dp*hx)
      v1 = dy - 0.5_dp*hy
      v2 = dy + 0.5_dp*hy
      d = (corner(u2, v2) - corner(u1, v2) - corner(u2, v1) + corner(u1, v1))/(pi*k*kappa)
   end function cell_influence

   !> Influence in a line contact under P = cos(k Y), a wave along the line, theory eq. (W17):
   !>
   !>     (2/pi) int K0(k |X - X'|) dX'
   pure real(dp) function line_wave_influence(dx, hx, wave_number) result(d)
      real(dp), intent(in) :: dx            !! distance in X
      real(dp), intent(in) :: hx            !! cell size
      real(dp), intent(in) :: wave_number   !! k > 0, 1/a
      d = 2/(pi*wave_number)*(bessel_integral(wave_number*(dx + 0.5_dp*hx)) &
                              - bessel_integral(wave_number*(dx - 0.5_dp*hx)))
   end function line_wave_influence

   !> Antiderivative of the Bessel function K0(|u|), zero at 0: sign(u) (pi/2 - Ki1(|u|)) with Bickley's function
   !>
   !>     Ki1(u) = int exp(-u cosh t)/cosh t dt     (t from 0 on)
   !>
   !> by the trapezoidal rule, whose error is exp(-pi^2/step).
   pure real(dp) function bessel_integral(u) result(f)
      real(dp), intent(in) :: u
      real(dp), parameter :: step = 0.25_dp
      integer, parameter :: most = 160             ! 1/cosh(40) is 1e-17
      real(dp), parameter :: negligible = 45       ! -ln of the neglected part
      real(dp) :: bickley, c
      integer :: n

      bickley = 0.5_dp*exp(-abs(u))
      do n = 1, most
         c = cosh(n*step)
         if (abs(u)*c > negligible) exit
         bickley = bickley + exp(-abs(u)*c)/c
      end do
      f = sign(0.5_dp*pi - step*bickley, u)
   end function bessel_integral

   !> Antiderivative of ln(line_reference/|u|), zero at 0.
   elemental function log_integral(u) result(f)
      real(dp), intent(in) :: u
      real(dp) :: f
      f = 0
      if (abs(u) > 0) f = u*(1 + log(line_reference/abs(u)))
   end function log_integral

   !> Antiderivative in both arguments of 1/sqrt(u^2 + v^2): with u = kappa X and v = Y the integral of
   !> `cell_influence` over 1/(pi K kappa).
   elemental function corner(u, v) result(f)
      real(dp), intent(in) :: u, v
      real(dp) :: f
      f = 0
      if (abs(u) > 0) f = f + u*asinh(v/abs(u))
      if (abs(v) > 0) f = f + v*asinh(u/abs(v))
   end function corner

end module ehlwave_kernel
