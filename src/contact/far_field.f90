!> The pressure far from a contact, where the film is thick: the boundary value of a flooded edge.
!>
!> A rigid paraboloid and an oil that neither thickens nor is compressed have an exact solution (Kapitza 1955): with
!> H = h + S X^2 + (1 - S) Y^2, theory eq. (7) holds for
!>
!>     P = lambdabar/(3 + 2 D) |X|/H^2,    X < 0,                                                             (F1)
!>
!> whatever h is, side leakage included. The bodies of a contact are flattened, and the gap opens faster beyond an edge
!> than the gap of a paraboloid with the same film there, so (F1) is too large: the far field is R(r) times it, r the
!> distance from the centre in units of a. On the axis Y = 0, g = P there, with the side leakage of (F1),
!>
!>     d/dr (H^3 dg/dr) + D H^3 d(g/r)/dr = -lambdabar dH/dr,                                                  (F2)
!>
!> exact for D = 1, where P = g(r) |X|/r, and for line contacts. H is the gap of Hertz and the film of the formula. It
!> is solved from r = 1, where the reduced pressure has Grubin's value, 1/alphabar, which hardly matters at r = 2,
!> outwards. The far field gives the reduced pressure q = int dP/eta; q = P where the oil does not thicken.
module ehlwave_far_field
   use ehlwave_conditions, only: conditions_t
   use ehlwave_formula, only: expected_film
   use ehlwave_gauss_legendre, only: gauss_rule_t
   use ehlwave_hertz_gap, only: farthest, gap_rule, gaps_on_axis, gaps_outside, hertz_gap, intervals
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   implicit none (type, external)
   private
   public :: new_far_field, rigid_strength

   !> Makes the pressure at r = 1 a quarter of ph where the oil does not thicken.
   real(dp), parameter, public :: rising_exponent = 4

   !> Far field of a contact.
   type, public :: far_field_t
      type(conditions_t), private :: conditions
      real(dp), private :: film = 0               ! H(0,0) of the formula
      real(dp), private :: ratio(0:intervals) = 1 ! R at r = farthest^(k/intervals)
      type(gauss_rule_t), private :: rule         ! for the gap
   contains
      procedure :: strength
      procedure :: film_at
      procedure :: load_outside
      procedure :: outside
   end type far_field_t

contains

   !> Far field of a contact whose oil has d ln(eta)/dP = thickening at P = 0.
   function new_far_field(conditions, thickening) result(self)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: thickening
      type(far_field_t) :: self
      real(dp) :: g(0:intervals), h(0:intervals), r(0:intervals)
      integer :: k

      self%conditions = conditions
      self%film = expected_film(conditions)
      self%rule = gap_rule()
      r = [(farthest**(k/real(intervals, dp)), k=0, intervals)]
      h = gaps_on_axis(conditions, r) + self%film
      g(0) = 1/(rising_exponent + thickening)
      g(intervals) = rigid_strength(conditions, -r(intervals))/h(intervals)**2
      call solve_axis(conditions, r, h, g)
      do k = 0, intervals
         self%ratio(k) = g(k)*h(k)**2/rigid_strength(conditions, -r(k))
      end do
   end function new_far_field

   !> Solve (F2) by central differences between the ends of g (Thomas algorithm).
   pure subroutine solve_axis(conditions, r, h, g)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: r(0:), h(0:)
      real(dp), intent(inout) :: g(0:)
      real(dp) :: east, factor(0:ubound(r, 1)), leak, lower, pivot, west
      integer :: k, n

      n = ubound(r, 1)
      factor(0) = 0
      do k = 1, n - 1
         west = (0.5_dp*(h(k - 1) + h(k)))**3/(r(k) - r(k - 1))
         east = (0.5_dp*(h(k) + h(k + 1)))**3/(r(k + 1) - r(k))
         leak = 0.5_dp*conditions%d*h(k)**3
         lower = west - leak/r(k - 1)
         pivot = -(west + east) - lower*factor(k - 1)
         factor(k) = (east + leak/r(k + 1))/pivot
         g(k) = (-0.5_dp*conditions%lambdabar*(h(k + 1) - h(k - 1)) - lower*g(k - 1))/pivot
      end do
      do k = n - 1, 1, -1
         g(k) = g(k) - factor(k)*g(k + 1)
      end do
   end subroutine solve_axis

   !> q H^2 of (F1), 0 for X >= 0.
   elemental real(dp) function rigid_strength(conditions, x)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: x   !! X
      rigid_strength = conditions%lambdabar*max(0.0_dp, -x)/(3 + 2*conditions%d)
   end function rigid_strength

   !> q H^2 at a place: the value of (F1) times R.
   elemental real(dp) function strength(self, x, y)
      class(far_field_t), intent(in) :: self
      real(dp), intent(in) :: x, y   !! X, Y
      real(dp) :: place, r
      integer :: k

      r = abs(x)
      if (abs(y) > 0) r = sqrt(x**2 + (y/self%conditions%elliptic%kappa)**2)
      place = intervals*log(max(r, 1.0_dp))/log(farthest)
      if (.not. place <= intervals) place = intervals   ! farther out than squares of numbers go
      k = min(int(place), intervals - 1)
      place = min(place - k, 1.0_dp)
      strength = rigid_strength(self%conditions, x)*((1 - place)*self%ratio(k) + place*self%ratio(k + 1))
   end function strength

   !> Film to expect outside the Hertz zone: Hertz's gap and the film of the formula.
   pure real(dp) function film_at(self, x, y)
      class(far_field_t), intent(in) :: self
      real(dp), intent(in) :: x, y   !! X, Y
      film_at = hertz_gap(self%conditions, x, y, self%rule) + self%film
   end function film_at

   !> Load beyond the inlet edge and the sides of a domain that the far field bears, over the nominal load, (F6).
   real(dp) function load_outside(self, x_min, y_max) result(load)
      class(far_field_t), intent(in) :: self
      real(dp), intent(in) :: x_min, y_max   !! as in `outside`
      real(dp), allocatable, dimension(:) :: area, film, x, y
      integer :: n
      call self%outside(x_min, y_max, x, y, area, film)
      load = load_factor*sum([(area(n)*self%strength(x(n), y(n))/film(n)**2, n=1, size(area))])
   end function load_outside

   !> Quadrature points for the region upstream of X = 0 beyond the inlet edge and the sides, and the film there.
   subroutine outside(self, x_min, y_max, x, y, area, film, times)
      class(far_field_t), intent(in) :: self
      real(dp), intent(in) :: x_min, y_max   !! as in `gaps_outside`
      real(dp), allocatable, dimension(:), intent(out) :: x, y, area, film   !! as there
      real(dp), intent(in), optional :: times   !! out to so many times the domain; absent: all that there is
      call gaps_outside(self%conditions, x_min, y_max, x, y, area, film, times)
      film = film + self%film
   end subroutine outside

end module ehlwave_far_field
