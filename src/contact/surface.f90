!> A measured piece of surface: heights on a uniform grid, interpolated anywhere.
module ehlwave_surface
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp, pi
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: new_surface

   !> Heights in dimensionless coordinates, positive out of the material. Outside its ends the surface is smooth.
   type, public :: surface_t
      real(dp), allocatable :: height(:, :)   !! (points along X, points along Y), units of c; 1 along Y: no variation
      real(dp) :: step_x = 0, step_y = 0      !! sampling steps, units of a and b; step_y 0: no variation along Y
      real(dp) :: length = 0                  !! from the first to the last point along X, units of a
      real(dp) :: rq = 0                      !! root mean square of the heights about their mean, units of c
      real(dp) :: wavelength_x = 0            !! RMS average wavelength along X, 2 pi Rq over the RMS slope, units of a
      real(dp) :: wavelength_y = 0            !! average along Y, units of b; 0: no variation along Y
   contains
      procedure :: height_at
      procedure :: is_even
   end type surface_t

   real(dp), parameter :: largest_edge = 0.01_dp   !! height at the ends over the largest, so that nothing enters as a
                                                   !! step

contains

   !> Surface of heights in units of c, steps in units of a and b (step_y 0 with one point along Y).
   !>
   !> X of the heights counts along the motion: the last point leads. Fails when there are too few points or a height
   !> is not finite, or when the surface does not begin and end at height 0 (along Y: unless it is at least
   !> `width` wide, 2 y_max), because the contact would meet a step there.
   subroutine new_surface(height, step_x, step_y, width, self, error)
      real(dp), intent(in) :: height(:, :)
      real(dp), intent(in) :: step_x, step_y
      real(dp), intent(in) :: width                !! width of the domain, units of b
      type(surface_t), intent(out) :: self
      type(error_t), allocatable, intent(inout) :: error
      real(dp) :: edge, highest

      if (size(height, 1) < 8 .or. (size(height, 2) > 1 .and. size(height, 2) < 8)) then
         call raise(error, to_text(size(height, 1))//' x '//to_text(size(height, 2))//' heights: at least 8 are '// &
                    'needed in each direction the surface varies in')
         return
      else if (.not. (step_x > 0 .and. (step_y > 0 .or. size(height, 2) == 1))) then
         call raise(error, 'steps must be above 0')
         return
      end if
      if (.not. all(ieee_is_finite(height))) then
         call raise(error, 'a height is missing (NaN) or infinite')
         return
      end if
      highest = maxval(abs(height))
      if (highest <= 0) then
         call raise(error, 'heights are all 0')
         return
      end if
      edge = max(maxval(abs(height(1, :))), maxval(abs(height(size(height, 1), :))))
      if (size(height, 2) > 1 .and. (size(height, 2) - 1)*step_y < width) &
         edge = max(edge, maxval(abs(height(:, 1))), maxval(abs(height(:, size(height, 2)))))
      if (edge > largest_edge*highest) then
         call raise(error, 'heights at the ends of the surface reach '//to_text(edge/highest, 3)// &
            ' of the largest: it '// &
                    'would enter the contact as a step. Write the file by ehlwave surface, which fades the ends')
         return
      end if

      self%height = height
      self%step_x = step_x
      self%step_y = step_y
      self%length = (size(height, 1) - 1)*step_x
      self%rq = sqrt(sum((height - sum(height)/size(height))**2)/size(height))
      self%wavelength_x = average_wavelength(self%rq, height(2:, :) - height(:size(height, 1) - 1, :), step_x)
      if (size(height, 2) > 1) self%wavelength_y = average_wavelength(self%rq, height(:, 2:) &
                                                                      - height(:, :size(height, 2) - 1), step_y)
   end subroutine new_surface

   !> 2 pi Rq over the RMS slope: the wavelength of a cosine, a mean weighted to short waves otherwise.
   pure real(dp) function average_wavelength(rq, difference, step)
      real(dp), intent(in) :: rq, difference(:, :), step
      real(dp) :: slope
      slope = sqrt(sum(difference**2)/size(difference))/step
      average_wavelength = 0
      if (slope > 0) average_wavelength = 2*pi*rq/slope
   end function average_wavelength

   !> Whether the heights are even in Y to rounding; Y = 0 is in the middle.
   pure logical function is_even(self)
      class(surface_t), intent(in) :: self
      integer :: n
      n = size(self%height, 2)
      is_even = maxval(abs(self%height - self%height(:, n:1:-1))) <= 1e-12_dp*maxval(abs(self%height))
   end function is_even

   !> Heights at the nodes (x, y) when the last, leading point is at X = `front`; shape (size(x), size(y)).
   !>
   !> Cubic convolution (Keys 1981, IEEE Transactions ASSP 29, 1153): continuous slopes, exact for parabolas. Beyond
   !> the ends the surface goes on at height 0.
   pure function height_at(self, x, y, front) result(height)
      class(surface_t), intent(in) :: self
      real(dp), intent(in) :: x(:), y(:), front
      real(dp) :: height(size(x), size(y))
      real(dp), allocatable :: along(:, :)
      real(dp) :: weight(4), weights(4, size(x))
      integer :: first, firsts(size(x)), i, j, k, n

      ! first along X, on every line of the surface
      do i = 1, size(x)
         call stencil((x(i) - front + self%length)/self%step_x, firsts(i), weights(:, i))
      end do
      allocate (along(size(x), size(self%height, 2)), source=0.0_dp)
      do j = 1, size(self%height, 2)
         do i = 1, size(x)
            do k = max(1, 1 - firsts(i)), min(4, size(self%height, 1) - firsts(i))
               along(i, j) = along(i, j) + weights(k, i)*self%height(firsts(i) + k, j)
            end do
         end do
      end do
      if (size(self%height, 2) == 1) then
         height = spread(along(:, 1), 2, size(y))
         return
      end if
      height = 0
      do j = 1, size(y)
         call stencil(y(j)/self%step_y + 0.5_dp*(size(self%height, 2) - 1), first, weight)
         do k = 1, 4
            n = first + k
            if (n >= 1 .and. n <= size(self%height, 2)) height(:, j) = height(:, j) + weight(k)*along(:, n)
         end do
      end do
   end function height_at

   !> The four points about a position in steps from the first point, and their weights; they are numbered
   !> first + 1 to first + 4.
   pure subroutine stencil(position, first, weight)
      real(dp), intent(in) :: position
      integer, intent(out) :: first
      real(dp), intent(out) :: weight(4)
      real(dp) :: s
      first = floor(max(-1e6_dp, min(1e9_dp, position))) - 1
      s = position - floor(max(-1e6_dp, min(1e9_dp, position)))
      weight = [s*(-0.5_dp + s*(1 - 0.5_dp*s)), 1 + s**2*(-2.5_dp + 1.5_dp*s), &
                s*(0.5_dp + s*(2 - 1.5_dp*s)), s**2*(-0.5_dp + 0.5_dp*s)]
   end subroutine stencil

end module ehlwave_surface
