!> Rise of a half-space that moves along X under heat on a cell of its surface, at any Peclet number: theory eq. (T7).
module ehlwave_moving_source
   use ehlwave_gauss_legendre, only: gauss_rule_t, new_gauss_rule
   use ehlwave_kinds, only: dp, pi
   implicit none (type, external)
   private
   public :: source_weights

   integer, parameter :: points = 10               ! Gauss points of a panel of the integral over the spread
   real(dp), parameter :: growth = 2             ! largest ratio of the ends of a panel
   real(dp), parameter :: widths = 7               ! spreads beyond which a normal distribution vanishes: 1e-12
   real(dp), parameter :: smooth = 100             ! spread, in cells, from which on cells are normal distributions
   real(dp), parameter :: farthest = 1e3_dp        ! spread, in sizes of the domain, beyond which 1/spread is integrated

   !> Cells and motion, lengths in units of a.
   type :: source_t
      real(dp) :: hx, hy, peclet
      logical :: is_line                           ! heat that does not change across the motion
   end type source_t

contains

   !> Rise at m cells downstream and n rows aside of heat of 1 at a node, in units of a/k_s: linear along X to 0 at both
   !> neighbours, even across a row.
   !>
   !> Heat spreads as a normal distribution about the place where the surface has come to. The integral over its spread
   !> sigma, theory eq. (D15), takes panels no longer than the scale 1/Pe of the motion and a share of sigma.
   pure function source_weights(nx, reach, hx, hy, peclet, is_line) result(w)
      integer, intent(in) :: nx, reach             !! largest distances, cells
      real(dp), intent(in) :: hx, hy               !! mesh sizes
      real(dp), intent(in) :: peclet               !! u a rho_s c_s/(2 k_s); of a line above 0
      logical, intent(in) :: is_line
      real(dp) :: w(-nx:nx, 0:reach)
      type(gauss_rule_t) :: rule
      type(source_t) :: source
      real(dp) :: from, last, length, limit, until
      integer :: i

      source = source_t(hx, hy, peclet, is_line)
      rule = new_gauss_rule(points)
      length = nx*hx
      if (.not. is_line) length = max(length, reach*hy)
      limit = huge(limit)
      if (.not. is_line) limit = farthest*length
      last = huge(last)
      if (peclet > tiny(last)**0.5_dp) &           ! there all heat has gone by
         last = (widths + sqrt(widths**2 + 4*peclet*(length + hx)))/(2*peclet)
      w = 0
      from = 0
      until = merge(hx, min(hx, hy), is_line)/12
      if (peclet*until > 2) until = 2/peclet
      do while (from < min(last, limit))
         do i = 1, points
            call add(source, 0.5_dp*(from + until + (until - from)*rule%node(i)), &
                     0.5_dp*(until - from)*rule%weight(i), w)
         end do
         from = until
         until = growth*from
         if (peclet*(until - from) > 2) until = from + 2/peclet
      end do
      if (from >= last) return
      do i = 1, points
         last = 0.5_dp*(1 + rule%node(i))/from
         call add(source, 1/last, 0.5_dp*rule%weight(i)/from/last**2, w)
      end do
   end function source_weights

   !> Share of a spread: normal distributions along and across, of the heat of a node.
   pure subroutine add(source, sigma, weight, w)
      type(source_t), intent(in) :: source
      real(dp), intent(in) :: sigma, weight
      real(dp), intent(inout) :: w(:, 0:)          !! (-nx:nx, 0:reach)
      real(dp) :: along(size(w, 1)), margin, moved
      integer :: first, last, n, nx

      nx = size(w, 1)/2
      associate (hx => source%hx, hy => source%hy)
         moved = source%peclet*sigma**2
         margin = hx + widths*sigma
         if (moved - margin > nx*hx) return
         first = ceiling(max((moved - margin)/hx, real(-nx, dp)))
         last = floor(min((moved + margin)/hx, real(nx, dp)))
         if (last < first) return
         call hats(hx, sigma, [(n*hx - moved, n=first - 1, last + 1)], along(:last - first + 1))
         along(:last - first + 1) = sqrt(2/pi)*weight*along(:last - first + 1)
         if (source%is_line) then
            w(first + nx + 1:last + nx + 1, 0) = w(first + nx + 1:last + nx + 1, 0) + along(:last - first + 1)
            return
         end if
         do n = 0, min(ubound(w, 2), floor(min(1 + widths*sigma/hy, real(ubound(w, 2), dp))))
            w(first + nx + 1:last + nx + 1, n) = w(first + nx + 1:last + nx + 1, n) &
                                                 + box(hy, sigma, n*hy)*along(:last - first + 1)
         end do
      end associate
   end subroutine add

   !> A hat of width 2 h times a normal distribution, integrated, at equidistant places but the first and last.
   pure subroutine hats(h, sigma, x, value)
      real(dp), intent(in) :: h, sigma
      real(dp), intent(in) :: x(0:)
      real(dp), intent(out) :: value(:)            ! (size(x) - 2)
      real(dp) :: ramp(0:ubound(x, 1)), width
      integer :: n

      n = size(value)
      if (sigma > smooth*h) then                   ! the variances add up
         width = sqrt(sigma**2 + h**2/6)
         value = h*exp(-0.5_dp*(x(1:n)/width)**2)/(sqrt(2*pi)*width)
      else
         ramp = 0.5_dp*x*erfc(-x/(sqrt(2.0_dp)*sigma)) + sigma*exp(-0.5_dp*(x/sigma)**2)/sqrt(2*pi)
         value = (ramp(2:) - 2*ramp(1:n) + ramp(:n - 1))/h
      end if
   end subroutine hats

   !> A box of width h times a normal distribution, integrated.
   elemental real(dp) function box(h, sigma, y)
      real(dp), intent(in) :: h, sigma, y
      real(dp) :: width
      if (sigma > smooth*h) then
         width = sqrt(sigma**2 + h**2/12)
         box = h*exp(-0.5_dp*(y/width)**2)/(sqrt(2*pi)*width)
      else
         width = sqrt(2.0_dp)*sigma
         box = 0.5_dp*(erfc((y - 0.5_dp*h)/width) - erfc((y + 0.5_dp*h)/width))
      end if
   end function box

end module ehlwave_moving_source
