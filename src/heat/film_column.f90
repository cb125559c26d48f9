!> Temperature across the film at a node, from its neighbours and the surfaces upstream: theory eq. (D9).
module ehlwave_film_column
   use ehlwave_film_levels, only: add_source, film_levels_t, most_levels
   use ehlwave_film_shear, only: made_by_own, made_by_stress, made_heat, made_stress_by_rise
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: new_column, pass_across, pass_along, solve_column

   real(dp), parameter :: steepest = 30       ! growth of the source with the rise, over conduction: above it a half of
                                              ! the film would have no solution by itself

   !> A node. Arrays (0:levels), per unit of zeta.
   type, public :: column_t
      real(dp), allocatable :: own(:)          !! loss by the flow through the sides, times the node's own rise,
      real(dp), allocatable :: brought(:)      !! gain from the neighbours' rises,
      real(dp), allocatable :: net(:)          !! net oil taken, inflow less outflow
      real(dp) :: own_share = 0  !! share of the change of a level's source that follows its own rise; the rest
                                               !! follows the mean
      real(dp) :: convection = 0               !! convection of `heat_scales_t`, times H
      real(dp) :: h = 0
      real(dp) :: wall_before(2) = 0           !! rise of surfaces 1 and 2 by the heat upstream
      real(dp) :: wall_own(2) = 0              !! rise of each surface by a unit of heat flow here
   end type column_t

contains

   !> A column without flow and heat, between cold surfaces.
   pure function new_column(n) result(self)
      integer, intent(in) :: n                 !! intervals across
      type(column_t) :: self
      allocate (self%own(0:n), self%brought(0:n), self%net(0:n), source=0.0_dp)
   end function new_column

   !> Rise at the levels, and the flow of heat into surfaces 1 and 2, d theta/d zeta over H.
   !>
   !> Conduction is the second difference with the source weighted 1, 10, 1: of fourth order where the two balance.
   !> Oil moves across the levels as conservation of its mass asks; in between the rise is the mean, with as little
   !> upstream weight as keeps it monotone. Half a layer at each surface gives its heat to it.
   pure subroutine solve_column(column, levels, made, before, rise, into_wall)
      type(column_t), intent(in) :: column
      type(film_levels_t), intent(in) :: levels
      real(dp), intent(in), contiguous :: made(0:, :)  !! source of `film_shear_t`, at
      real(dp), intent(in), contiguous :: before(0:)   !! this rise
      real(dp), intent(out), contiguous :: rise(0:)    !! K
      real(dp), intent(out) :: into_wall(2)
      real(dp), dimension(0:most_levels) :: below, diagonal, above, right, stress   ! (0:n) of each
      real(dp) :: change, layer, own, share, slope, stress_before, stress_now, weight
      real(dp) :: wall_diagonal(2), wall_beside(2), wall_right(2), wall_stress(2)
      integer :: k

      associate (n => levels%n, d => levels%d, c => column)
         call convect(c, n, d, below, diagonal, above, right)
         call add_source(levels, made(:, made_heat), right)
         weight = 0
         slope = 0
         stress_before = 0
         do k = 0, n
            weight = weight + made(k, made_stress_by_rise)
            slope = slope + made(k, made_by_own)
            stress_before = stress_before + made(k, made_stress_by_rise)*before(k)
         end do
         share = c%own_share*min(1.0_dp, steepest/max(d*slope, steepest))
         do k = 0, n
            rise(k) = made(k, made_by_stress)*weight - (1 - share)*made(k, made_by_own)
            stress(k) = 0
         end do
         call add_source(levels, rise, stress)
         weight = 1/sign(max(abs(weight), tiny(weight)), weight)
         do k = 0, n
            layer = merge(0.5_dp*d, d, k == 0 .or. k == n)
            own = share*layer*made(k, made_by_own)
            diagonal(k) = diagonal(k) - own
            right(k) = right(k) - own*before(k) + stress(k)*(weight*stress_before)
         end do
         ! Heat left at the surfaces enters them: H q = right - diagonal theta - beside theta'
         wall_diagonal = [diagonal(n), diagonal(0)]
         wall_beside = [below(n), above(0)]
         wall_right = [right(n), right(0)]
         wall_stress = [stress(n), stress(0)]
         diagonal(n) = 1 + c%wall_own(1)/c%h*wall_diagonal(1)
         below(n) = c%wall_own(1)/c%h*wall_beside(1)
         right(n) = c%wall_before(1) + c%wall_own(1)/c%h*wall_right(1)
         diagonal(0) = 1 + c%wall_own(2)/c%h*wall_diagonal(2)
         above(0) = c%wall_own(2)/c%h*wall_beside(2)
         right(0) = c%wall_before(2) + c%wall_own(2)/c%h*wall_right(2)
         stress(n) = c%wall_own(1)/c%h*wall_stress(1)
         stress(0) = c%wall_own(2)/c%h*wall_stress(2)
         call solve_both(n, below, diagonal, above, right, stress)
         stress_now = 0
         change = 0
         do k = 0, n
            stress_now = stress_now + made(k, made_stress_by_rise)*right(k)
            change = change + made(k, made_stress_by_rise)*stress(k)
         end do
         stress_now = weight*stress_now/(1 + weight*change)
         do k = 0, n
            rise(k) = right(k) - stress_now*stress(k)
         end do
         wall_right = wall_right - stress_now*wall_stress
         into_wall(1) = (wall_right(1) - wall_diagonal(1)*rise(n) - wall_beside(1)*rise(n - 1))/c%h
         into_wall(2) = (wall_right(2) - wall_diagonal(2)*rise(0) - wall_beside(2)*rise(1))/c%h
      end associate
   end subroutine solve_column

   !> Convection and conduction: diagonal theta_k + below theta_(k-1) + above theta_(k+1) = right, each layer times its
   !> thickness.
   pure subroutine convect(c, n, d, below, diagonal, above, right)
      type(column_t), intent(in) :: c
      integer, intent(in) :: n                         !! intervals across,
      real(dp), intent(in) :: d                        !! each of this size
      real(dp), intent(out), dimension(0:n) :: below, diagonal, above, right
      real(dp), parameter :: still = 1e-100_dp         ! floor of the convection, to divide by
      real(dp) :: across(0:most_levels), gained, largest, upstream
      integer :: k

      gained = -0.5_dp*(c%net(0) + c%net(n))           ! oil gained, as in the Reynolds equation
      do k = 0, n
         gained = gained + c%net(k)
      end do
      gained = d*gained
      do k = 0, n
         diagonal(k) = (c%convection*d)*(c%own(k) - gained)
         right(k) = (c%convection*d)*c%brought(k)
      end do
      diagonal(0) = 0.5_dp*diagonal(0)
      right(0) = 0.5_dp*right(0)
      diagonal(n) = 0.5_dp*diagonal(n)
      right(n) = 0.5_dp*right(n)
      across(0) = -0.5_dp*d*(c%net(0) - gained)
      do k = 1, n - 1
         across(k) = across(k - 1) - d*(c%net(k) - gained)
      end do
      largest = 2/(max(c%convection, still)*d)
      below(0) = 0
      above(n) = 0
      do k = 0, n - 1
         upstream = max(0.0_dp, abs(across(k)) - largest)
         above(k) = 0.5_dp*c%convection*(across(k) - upstream) - 1/d
         below(k + 1) = -0.5_dp*c%convection*(across(k) + upstream) - 1/d
      end do
      do k = 0, n - 1                                  ! flow up from a level, and down to the next
         diagonal(k) = diagonal(k) - below(k + 1)
      end do
      do k = 1, n
         diagonal(k) = diagonal(k) - above(k - 1)
      end do
   end subroutine convect

   !> Flow along X into a node from the node before and out to the next. It takes the rise of the node that it
   !> leaves and half of its difference to the previous node; flow back takes the rise of the node beyond.
   pure subroutine pass_along(column, scale, into, out, farther, before, beyond)
      type(column_t), intent(inout) :: column
      real(dp), intent(in) :: scale
      real(dp), intent(in), contiguous :: into(0:), out(0:)                    !! flows, over the scale
      real(dp), intent(in), contiguous :: farther(0:), before(0:), beyond(0:)  !! rises
      real(dp) :: ahead, back, came, left
      integer :: k
      do k = 0, ubound(out, 1)
         ahead = max(scale*out(k), 0.0_dp)
         back = min(scale*out(k), 0.0_dp)
         came = max(scale*into(k), 0.0_dp)
         left = min(scale*into(k), 0.0_dp)
         column%net(k) = ahead + back - (came + left)
         column%own(k) = 1.5_dp*ahead - left
         column%brought(k) = 0.5_dp*ahead*before(k) - back*beyond(k) + came*(1.5_dp*before(k) - 0.5_dp*farther(k))
      end do
   end subroutine pass_along

   !> After that, flow out of a node along Y, downward and upward. All of it takes half a difference with it.
   pure subroutine pass_across(column, scale, down, up, lowest, lower, upper, uppermost)
      type(column_t), intent(inout) :: column
      real(dp), intent(in) :: scale(2)
      real(dp), intent(in), contiguous :: down(0:), up(0:)           !! flows, over the scale
      real(dp), intent(in), contiguous :: lowest(0:), lower(0:)      !! rises of the neighbours
      real(dp), intent(in), contiguous :: upper(0:), uppermost(0:)
      real(dp) :: fell, from_above, from_below, rose
      integer :: k
      do k = 0, ubound(up, 1)
         fell = max(scale(1)*down(k), 0.0_dp)
         from_below = min(scale(1)*down(k), 0.0_dp)
         rose = max(scale(2)*up(k), 0.0_dp)
         from_above = min(scale(2)*up(k), 0.0_dp)
         column%net(k) = column%net(k) + ((fell + from_below) + (rose + from_above))
         column%own(k) = column%own(k) + 1.5_dp*(fell + rose)
         column%brought(k) = column%brought(k) + 0.5_dp*(fell*upper(k) + rose*lower(k)) &
                             - from_below*(1.5_dp*lower(k) - 0.5_dp*lowest(k)) &
                             - from_above*(1.5_dp*upper(k) - 0.5_dp*uppermost(k))
      end do
   end subroutine pass_across

   !> Two right sides, from both surfaces to the middle: there pivots stay positive where a source that grows with the
   !> rise would make them vanish on the way through the film.
   pure subroutine solve_both(n, below, diagonal, above, first, second)
      integer, intent(in) :: n
      real(dp), intent(in), dimension(0:n) :: below, above
      real(dp), intent(inout), dimension(0:n) :: diagonal, first, second   !! right sides; solutions
      real(dp) :: factor
      integer :: k, middle

      middle = n/2                                    ! pivots are kept as their inverses
      diagonal(0) = 1/diagonal(0)
      do k = 1, middle - 1
         factor = below(k)*diagonal(k - 1)
         diagonal(k) = 1/(diagonal(k) - factor*above(k - 1))
         first(k) = first(k) - factor*first(k - 1)
         second(k) = second(k) - factor*second(k - 1)
      end do
      diagonal(n) = 1/diagonal(n)
      do k = n - 1, middle + 1, -1
         factor = above(k)*diagonal(k + 1)
         diagonal(k) = 1/(diagonal(k) - factor*below(k + 1))
         first(k) = first(k) - factor*first(k + 1)
         second(k) = second(k) - factor*second(k + 1)
      end do
      k = middle
      factor = below(k)*diagonal(k - 1)
      diagonal(k) = diagonal(k) - factor*above(k - 1)
      first(k) = first(k) - factor*first(k - 1)
      second(k) = second(k) - factor*second(k - 1)
      factor = above(k)*diagonal(k + 1)
      diagonal(k) = 1/(diagonal(k) - factor*below(k + 1))
      first(k) = (first(k) - factor*first(k + 1))*diagonal(k)
      second(k) = (second(k) - factor*second(k + 1))*diagonal(k)
      do k = middle - 1, 0, -1
         first(k) = (first(k) - above(k)*first(k + 1))*diagonal(k)
         second(k) = (second(k) - above(k)*second(k + 1))*diagonal(k)
      end do
      do k = middle + 1, n
         first(k) = (first(k) - below(k)*first(k - 1))*diagonal(k)
         second(k) = (second(k) - below(k)*second(k - 1))*diagonal(k)
      end do
   end subroutine solve_both

end module ehlwave_film_column
