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
   use ehlwave_gauss_legendre, only: gauss_rule_t, new_gauss_rule
   use ehlwave_kinds, only: dp, pi
   use ehlwave_load_balance, only: load_factor
   implicit none (type, external)
   private
   public :: new_far_field, rigid_strength, hertz_gap

   integer, parameter :: intervals = 256        !! intervals of (F2), in ln r
   integer, parameter :: most_points = 40       !! of a rule for the gap
   real(dp), parameter :: farthest = 60         !! r where (F1) holds
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
   pure function new_far_field(conditions, thickening) result(self)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: thickening
      type(far_field_t) :: self
      real(dp) :: g(0:intervals), h(0:intervals), r(0:intervals)
      integer :: k

      self%conditions = conditions
      self%film = expected_film(conditions)
      self%rule = new_gauss_rule(24)
      r = [(farthest**(k/real(intervals, dp)), k=0, intervals)]
      h = [(self%film_at(r(k), 0.0_dp), k=0, intervals)]
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
   pure real(dp) function load_outside(self, x_min, y_max) result(load)
      class(far_field_t), intent(in) :: self
      real(dp), intent(in) :: x_min, y_max   !! as in `outside`
      real(dp), allocatable, dimension(:) :: area, x, y
      integer :: n
      call self%outside(x_min, y_max, x, y, area)
      load = load_factor*sum([(area(n)*self%strength(x(n), y(n))/self%film_at(x(n), y(n))**2, n=1, size(area))])
   end function load_outside

   !> Quadrature points for the region upstream of X = 0 beyond the inlet edge and the sides; on the axis for a line
   !> contact.
   pure subroutine outside(self, x_min, y_max, x, y, area, times)
      class(far_field_t), intent(in) :: self
      real(dp), intent(in) :: x_min, y_max   !! X of the inlet edge, Y of the side; of line contacts y_max is the
                                             !! strip's width
      real(dp), allocatable, dimension(:), intent(out) :: x, y, area   !! X <= 0, Y >= 0 and dX dY, both sides counted
      real(dp), intent(in), optional :: times   !! out to so many times the domain; absent: all that there is
      type(gauss_rule_t) :: rule
      real(dp) :: corner, half, phi
      integer :: k

      rule = new_gauss_rule(12)
      allocate (x(0), y(0), area(0))
      if (self%conditions%is_line()) then
         call add_ray(1.0_dp, 0.0_dp, -x_min, y_max, x, y, area)
         return
      end if
      corner = atan2(y_max, -x_min)
      do k = 1, rule%n
         half = 0.5_dp*corner                  ! from the axis to the corner
         phi = half*(1 + rule%node(k))
         call add_ray(cos(phi), sin(phi), -x_min/cos(phi), 2*half*rule%weight(k), x, y, area)
         half = 0.5_dp*(pi/2 - corner)         ! from there to X = 0
         phi = corner + half*(1 + rule%node(k))
         call add_ray(cos(phi), sin(phi), y_max/sin(phi), 2*half*rule%weight(k), x, y, area)
      end do

   contains

      !> Points from the edge outwards in one direction, even in edge/r.
      pure subroutine add_ray(along, across, edge, width, x, y, area)
         real(dp), intent(in) :: along, across, edge
         real(dp), intent(in) :: width       !! angle that the ray represents; width of the strip for a line
         real(dp), allocatable, dimension(:), intent(inout) :: x, y, area
         real(dp) :: last
         real(dp), dimension(rule%n) :: r, t
         last = 0
         if (present(times)) last = 1/times
         t = last + 0.5_dp*(1 - last)*(1 + rule%node(:rule%n))
         r = edge/t
         x = [x, -r*along]
         y = [y, r*across]
         area = [area, 0.5_dp*(1 - last)*width*rule%weight(:rule%n)*edge/t**2 &
                       *merge(1.0_dp, r, self%conditions%is_line())]
      end subroutine add_ray
   end subroutine outside

   !> Gap between the dry bodies outside the Hertz zone, 0 inside (Johnson, Contact Mechanics, 1985, section 4.2), (F3):
   !>
   !>     S X^2 + (1 - S) Y^2 - 1 + 1/(2 kappa K) int_w0^inf (1 - X^2/(1 + w) - Y'^2/(c + w)) dw/((1 + w)(c + w)
   !>     w)^(1/2),
   !>
   !> c = 1/kappa^2, Y' = Y/kappa, w0 where the first factor vanishes; by w = (1 + w0)/t^2 - 1 an integral from 0 to 1.
   !> Of a line
   !> |X| (X^2 - 1)^(1/2) - arcosh |X|, (F4).
   pure real(dp) function hertz_gap(conditions, x, y, rule) result(gap)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: x, y
      type(gauss_rule_t), intent(in) :: rule   !! 24 points, at most `most_points`
      real(dp), dimension(most_points) :: t, term, w
      real(dp) :: b, c, w0, yy
      integer :: k

      gap = 0
      if (x**2 + y**2 <= 1) return
      if (conditions%is_line()) then
         gap = abs(x)*sqrt(x**2 - 1) - acosh(abs(x))
         return
      end if
      associate (kappa => conditions%elliptic%kappa, s => conditions%s)
         c = 1/kappa**2
         yy = (y/kappa)**2
         b = 0.5_dp*(x**2 + yy - 1 - c)
         w0 = b + sqrt(max(0.0_dp, b**2 + c*(x**2 - 1) + yy))
         do k = 1, rule%n                 ! several at once; the sum keeps its order
            t(k) = 0.5_dp*(1 + rule%node(k))
            w(k) = (1 + w0)/t(k)**2 - 1
            term(k) = rule%weight(k)*(1 - x**2/(1 + w(k)) - yy/(c + w(k)))/(t(k)**2*sqrt((c + w(k))*w(k)))
         end do
         do k = 1, rule%n
            gap = gap + term(k)
         end do
         gap = max(0.0_dp, s*x**2 + (1 - s)*y**2 - 1 + sqrt(1 + w0)*gap/(2*kappa*conditions%elliptic%k))
      end associate
   end function hertz_gap

end module ehlwave_far_field
