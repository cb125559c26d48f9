!> Interpolation of measured values that rise or fall throughout, with a continuous slope.
module ehlwave_monotone_curve
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: new_monotone_curve

   !> Cubics between the points. They have the slopes of parabolas through three points, within the limits of Fritsch
   !> and Carlson, SIAM Journal on Numerical Analysis 17, 1980, 238-246: where the points rise, the curve rises. Beyond
   !> the first and the last point it goes on straight.
   type, public :: monotone_curve_t
      real(dp), allocatable :: x(:), y(:)       !! points, x increasing
      real(dp), allocatable :: slope(:)         !! dy/dx there
   contains
      procedure :: evaluate
   end type monotone_curve_t

   real(dp), parameter :: most_steep = 3        ! slope over the slope of a chord,
   real(dp), parameter :: least_steep = 0.5_dp  ! likewise at the ends

contains

   !> Curve through points, at least two of them, x increasing.
   pure function new_monotone_curve(x, y) result(self)
      real(dp), intent(in) :: x(:), y(:)
      type(monotone_curve_t) :: self
      real(dp) :: chord(size(x) - 1), h(size(x) - 1)
      integer :: i, n

      n = size(x)
      allocate (self%x, source=x)
      allocate (self%y, source=y)
      h = x(2:) - x(:n - 1)
      chord = (y(2:) - y(:n - 1))/h
      allocate (self%slope(n))
      self%slope(1) = chord(1)
      self%slope(n) = chord(n - 1)
      if (n == 2) return
      self%slope(1) = end_slope(chord(1), chord(2), h(1), h(2))
      self%slope(n) = end_slope(chord(n - 1), chord(n - 2), h(n - 1), h(n - 2))
      do i = 2, n - 1
         self%slope(i) = inner_slope(chord(i - 1), chord(i), h(i - 1), h(i))
      end do
   end function new_monotone_curve

   !> Slope of the parabola through three points at the middle point; 0 where the points turn.
   pure real(dp) function inner_slope(before, after, h_before, h_after) result(slope)
      real(dp), intent(in) :: before, after       !! slopes of the chords
      real(dp), intent(in) :: h_before, h_after   !! their lengths along x
      slope = 0
      if (before*after <= 0) return
      slope = (h_after*before + h_before*after)/(h_before + h_after)
      slope = sign(min(abs(slope), most_steep*min(abs(before), abs(after))), slope)
   end function inner_slope

   !> Slope of the parabola through three points at the outer point of the first chord.
   pure real(dp) function end_slope(chord, next, h, h_next) result(slope)
      real(dp), intent(in) :: chord, next   !! slopes of the chords
      real(dp), intent(in) :: h, h_next     !! their lengths along x
      slope = chord + (chord - next)*h/(h + h_next)
      if (chord < 0) then
         slope = min(max(slope, most_steep*chord), least_steep*chord)
      else
         slope = max(min(slope, most_steep*chord), least_steep*chord)
      end if
   end function end_slope

   !> Value and slope at a place. `piece` is the number of the piece of the place before, 1 at first: neighbours mostly
   !> have the same.
   pure subroutine evaluate(self, x, piece, y, slope)
      class(monotone_curve_t), intent(in) :: self
      real(dp), intent(in) :: x
      integer, intent(inout) :: piece
      real(dp), intent(out) :: y, slope   !! value, dy/dx
      real(dp) :: a, b, chord, h, t
      integer :: n

      n = size(self%x)
      if (x <= self%x(1)) then
         slope = self%slope(1)
         y = self%y(1) + slope*(x - self%x(1))
      else if (x >= self%x(n)) then
         slope = self%slope(n)
         y = self%y(n) + slope*(x - self%x(n))
      else
         if (x < self%x(piece) .or. x >= self%x(piece + 1)) piece = piece_of(self%x, x)
         h = self%x(piece + 1) - self%x(piece)
         chord = (self%y(piece + 1) - self%y(piece))/h
         a = self%slope(piece)
         b = self%slope(piece + 1)
         t = (x - self%x(piece))/h
         y = self%y(piece) + h*t*(a + t*(3*chord - 2*a - b + t*(a + b - 2*chord)))
         slope = a + t*(2*(3*chord - 2*a - b) + 3*t*(a + b - 2*chord))
      end if
   end subroutine evaluate

   !> The piece k with x(k) <= place < x(k + 1), by bisection.
   pure integer function piece_of(x, place) result(first)
      real(dp), intent(in) :: x(:), place
      integer :: last, middle
      first = 1
      last = size(x)
      do while (last - first > 1)
         middle = (first + last)/2
         if (x(middle) <= place) then
            first = middle
         else
            last = middle
         end if
      end do
   end function piece_of

end module ehlwave_monotone_curve
