!> The gap between the dry bodies outside the Hertz zone, at places that far fields need.
!>
!> In units of the contact a gap depends on the ratio of the radii alone, so contacts that differ in load and oil share
!> it: the gaps at the last places are kept. A case needs gaps for its plan and its grids; cases of a sweep often need
!> the same ones. Called by a single thread.
module ehlwave_hertz_gap
   use ehlwave_conditions, only: conditions_t
   use ehlwave_gauss_legendre, only: gauss_rule_t, new_gauss_rule
   use ehlwave_kinds, only: dp, pi
   implicit none (type, external)
   private
   public :: gap_rule, gaps_on_axis, gaps_outside, hertz_gap

   integer, parameter, public :: intervals = 256      !! intervals on the axis, in ln r
   real(dp), parameter, public :: farthest = 60       !! their end
   integer, parameter :: most_points = 40             !! of a rule for the gap
   integer, parameter :: most_kept = 32, key_length = 7

   !> Places with their gaps.
   type :: places_t
      real(dp) :: key(key_length) = -1                ! the contact, the domain
      real(dp), allocatable, dimension(:) :: x, y, area, gap
   end type places_t

   type(places_t), save, target :: kept(most_kept)
   integer, save :: last = 0                          ! in `kept`
   type(gauss_rule_t), save :: rule_of_gap

contains

   !> The rule of `hertz_gap`.
   function gap_rule() result(rule)
      type(gauss_rule_t) :: rule
      if (rule_of_gap%n == 0) rule_of_gap = new_gauss_rule(24)
      rule = rule_of_gap
   end function gap_rule

   !> Gaps on the axis Y = 0 at r = farthest^(k/intervals).
   function gaps_on_axis(conditions, r) result(gap)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: r(0:intervals)
      real(dp) :: gap(0:intervals)
      type(places_t), pointer :: places
      logical :: is_new
      call find_places(conditions, 0.0_dp, 0.0_dp, 0.0_dp, places, is_new)
      if (is_new) then
         places%x = r(:)                              ! from 1 on, as the others
         places%y = 0*r
         call add_gaps(conditions, places)
      end if
      gap = places%gap
   end function gaps_on_axis

   !> Quadrature points for the region upstream of X = 0 beyond the inlet edge and the sides, and their gaps; on the
   !> axis for a line contact.
   subroutine gaps_outside(conditions, x_min, y_max, x, y, area, gap, times)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: x_min, y_max   !! X of the inlet edge, Y of the side; of line contacts y_max is the
                                             !! strip's width
      real(dp), allocatable, dimension(:), intent(out) :: x, y, area, gap   !! X <= 0, Y >= 0, dX dY, both sides
                                                                            !! counted
      real(dp), intent(in), optional :: times   !! out to so many times the domain; absent: all that there is
      type(places_t), pointer :: places
      real(dp) :: last_ratio
      logical :: is_new

      last_ratio = 0
      if (present(times)) last_ratio = 1/times
      call find_places(conditions, x_min, y_max, last_ratio, places, is_new)
      if (is_new) then
         call find_outside(conditions, x_min, y_max, last_ratio, places%x, places%y, places%area)
         call add_gaps(conditions, places)
      end if
      x = places%x
      y = places%y
      area = places%area
      gap = places%gap
   end subroutine gaps_outside

   !> The places of a contact and a domain, which take the room of the oldest where they are new.
   subroutine find_places(conditions, x_min, y_max, last_ratio, places, is_new)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: x_min, y_max, last_ratio
      type(places_t), pointer, intent(out) :: places
      logical, intent(out) :: is_new
      real(dp) :: key(key_length)
      integer :: k

      key = [conditions%d, conditions%s, conditions%elliptic%kappa, conditions%elliptic%k, x_min, y_max, last_ratio]
      do k = 1, most_kept
         places => kept(k)
         is_new = any(abs(places%key - key) > 0)
         if (.not. is_new) return
      end do
      last = modulo(last, most_kept) + 1
      places => kept(last)
      places%key = key
   end subroutine find_places

   subroutine add_gaps(conditions, places)
      type(conditions_t), intent(in) :: conditions
      type(places_t), intent(inout) :: places
      type(gauss_rule_t) :: rule
      integer :: n
      rule = gap_rule()
      places%gap = [(hertz_gap(conditions, places%x(n), places%y(n), rule), n=1, size(places%x))]
   end subroutine add_gaps

   !> Quadrature points outside a domain.
   pure subroutine find_outside(conditions, x_min, y_max, last, x, y, area)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: x_min, y_max, last   !! last: the domain over the region, 0: all that there is
      real(dp), allocatable, dimension(:), intent(out) :: x, y, area
      type(gauss_rule_t) :: rule
      real(dp) :: corner, half, phi
      integer :: k

      rule = new_gauss_rule(12)
      allocate (x(0), y(0), area(0))
      if (conditions%is_line()) then
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
         real(dp), dimension(rule%n) :: r, t
         t = last + 0.5_dp*(1 - last)*(1 + rule%node(:rule%n))
         r = edge/t
         x = [x, -r*along]
         y = [y, r*across]
         area = [area, 0.5_dp*(1 - last)*width*rule%weight(:rule%n)*edge/t**2 &
                       *merge(1.0_dp, r, conditions%is_line())]
      end subroutine add_ray
   end subroutine find_outside

   !> Gap between the dry bodies outside the Hertz zone, 0 inside (Johnson, Contact Mechanics, 1985, section 4.2), (F3):
   !>
   !>     S X^2 + (1 - S) Y^2 - 1 + 1/(2 kappa K) int_w0^inf (1 - X^2/(1 + w) - Y'^2/(c + w)) dw/((1 + w)(c + w)
   !>     w)^(1/2),
   !>
   !> c = 1/kappa^2, Y' = Y/kappa, w0 where the first factor vanishes; by w = (1 + w0)/t^2 - 1 an integral from 0 to 1.
   !> A line has |X| (X^2 - 1)^(1/2) - arcosh |X|, (F4).
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

end module ehlwave_hertz_gap
