!> Temperature across the film at one node, by what its neighbours and the surfaces upstream are: theory eq. (D9).
module ehlwave_film_column
   use ehlwave_film_levels, only: add_source, film_levels_t
   use ehlwave_film_shear, only: made_by_own, made_by_stress, made_heat, made_stress_by_rise
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: add_inflow, add_side, new_column, solve_column

   real(dp), parameter :: steepest = 30       ! growth of the source with the rise, over conduction: above it a half of
                                              ! the film would have no solution by itself

   !> A node. Arrays (0:levels), per unit of zeta.
   type, public :: column_t
      real(dp), allocatable :: own(:)          !! what the flow through the sides takes with it of the node's own rise,
      real(dp), allocatable :: brought(:)      !! what it brings with that of its neighbours,
      real(dp), allocatable :: net(:)          !! and the oil that it takes, less what it brings
      real(dp) :: own_share = 0                !! of the change of a level's source that follows its own rise; the rest
                                               !! follows the mean
      real(dp) :: convection = 0               !! of `heat_scales_t`, times H
      real(dp) :: h = 0
      real(dp) :: wall_before(2) = 0           !! rise of surfaces 1 and 2 by the heat upstream
      real(dp) :: wall_own(2) = 0              !! and by a unit of heat flow here
   end type column_t

contains

   !> One that nothing flows through, without heat, between cold surfaces.
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
      real(dp), intent(in), contiguous :: made(0:, :)  !! of `film_shear_t`, at
      real(dp), intent(in), contiguous :: before(0:)   !! this rise
      real(dp), intent(out) :: rise(0:)        !! K
      real(dp), intent(out) :: into_wall(2)
      real(dp), dimension(0:levels%n) :: below, diagonal, above, right, stress
      real(dp) :: across, own(0:levels%n), residual, share, stress_now, weight
      real(dp) :: upstream, wall_diagonal(2), wall_beside(2), wall_right(2), wall_stress(2)
      real(dp), parameter :: still = 1e-100_dp   ! of the convection, to divide by
      integer :: k

      associate (n => levels%n, d => levels%d, c => column)
         residual = d*(sum(c%net) - 0.5_dp*(c%net(0) + c%net(n)))   ! of the Reynolds equation
         ! convection: diagonal theta_k + below theta_(k-1) + above theta_(k+1) = right, each layer times its thickness
         below = 0
         above = 0
         diagonal = c%own - residual
         diagonal(0) = 0.5_dp*d*diagonal(0)
         diagonal(n) = 0.5_dp*d*diagonal(n)
         diagonal(1:n - 1) = d*diagonal(1:n - 1)
         right = d*c%brought
         right(0) = 0.5_dp*right(0)
         right(n) = 0.5_dp*right(n)
         across = 0
         do k = 0, n - 1
            across = across - merge(0.5_dp*d, d, k == 0)*(c%net(k) - residual)
            upstream = max(0.0_dp, abs(across) - 2/(max(c%convection, still)*d))
            diagonal(k) = diagonal(k) + 0.5_dp*(across + upstream)
            above(k) = above(k) + 0.5_dp*(across - upstream)
            diagonal(k + 1) = diagonal(k + 1) - 0.5_dp*(across - upstream)
            below(k + 1) = below(k + 1) - 0.5_dp*(across + upstream)
         end do
         below = c%convection*below
         diagonal = c%convection*diagonal
         above = c%convection*above
         right = c%convection*right
         ! conduction and source
         diagonal(0) = diagonal(0) + 1/d
         diagonal(1:n - 1) = diagonal(1:n - 1) + 2/d
         diagonal(n) = diagonal(n) + 1/d
         above(:n - 1) = above(:n - 1) - 1/d
         below(1:) = below(1:) - 1/d
         call add_source(levels, made(:, made_heat), right)
         weight = sum(made(:, made_stress_by_rise))
         share = sum(made(:, made_by_own))
         share = c%own_share*min(1.0_dp, steepest/max(d*share, steepest))
         stress = 0
         call add_source(levels, made(:, made_by_stress)*weight - (1 - share)*made(:, made_by_own), stress)
         weight = 1/sign(max(abs(weight), tiny(weight)), weight)
         own = share*d*made(:, made_by_own)
         own(0) = 0.5_dp*own(0)
         own(n) = 0.5_dp*own(n)
         diagonal = diagonal - own
         right = right - own*before + stress*(weight*dot_product(made(:, made_stress_by_rise), before))
         ! what is left at the surfaces goes into them: H q = right - diagonal theta - beside theta'
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
         stress_now = weight*dot_product(made(:, made_stress_by_rise), right) &
                      /(1 + weight*dot_product(made(:, made_stress_by_rise), stress))
         rise = right - stress_now*stress
         wall_right = wall_right - stress_now*wall_stress
         into_wall(1) = (wall_right(1) - wall_diagonal(1)*rise(n) - wall_beside(1)*rise(n - 1))/c%h
         into_wall(2) = (wall_right(2) - wall_diagonal(2)*rise(0) - wall_beside(2)*rise(1))/c%h
      end associate
   end subroutine solve_column

   !> Flow out of a node takes the node's rise and half of its difference to the node behind it; flow back brings that
   !> of the node beyond, along Y with half of its difference to the one after it.
   pure subroutine add_side(column, scale, flow, behind, beyond, farther)
      type(column_t), intent(inout) :: column
      real(dp), intent(in) :: scale, flow(:)              !! their product: out of the node
      real(dp), intent(in) :: behind(:), beyond(:)        !! rises
      real(dp), intent(in), optional :: farther(:)
      real(dp) :: back, out
      integer :: k
      do k = 1, size(flow)
         out = max(scale*flow(k), 0.0_dp)
         back = min(scale*flow(k), 0.0_dp)
         column%net(k - 1) = column%net(k - 1) + (out + back)
         column%own(k - 1) = column%own(k - 1) + 1.5_dp*out
         column%brought(k - 1) = column%brought(k - 1) + 0.5_dp*out*behind(k) - back*beyond(k)
         if (present(farther)) column%brought(k - 1) = column%brought(k - 1) - 0.5_dp*back*(beyond(k) - farther(k))
      end do
   end subroutine add_side

   !> Flow into a node from the node before, with that one's rise and half of its difference to the one before it.
   pure subroutine add_inflow(column, scale, flow, farther, before)
      type(column_t), intent(inout) :: column
      real(dp), intent(in) :: scale, flow(:)
      real(dp), intent(in) :: farther(:), before(:)
      real(dp) :: into, back
      integer :: k
      do k = 1, size(flow)
         into = max(scale*flow(k), 0.0_dp)
         back = min(scale*flow(k), 0.0_dp)
         column%net(k - 1) = column%net(k - 1) - (into + back)
         column%own(k - 1) = column%own(k - 1) - back
         column%brought(k - 1) = column%brought(k - 1) + into*(1.5_dp*before(k) - 0.5_dp*farther(k))
      end do
   end subroutine add_inflow

   !> Two right sides, from both surfaces to the middle: there pivots stay positive where a source that grows with the
   !> rise would make them vanish on the way through the film.
   pure subroutine solve_both(n, below, diagonal, above, first, second)
      integer, intent(in) :: n
      real(dp), intent(in) :: below(0:), above(0:)
      real(dp), intent(inout) :: diagonal(0:), first(0:), second(0:)   !! right sides; solutions
      real(dp) :: factor
      integer :: k, middle

      middle = n/2
      do k = 1, middle
         factor = below(k)/diagonal(k - 1)
         diagonal(k) = diagonal(k) - factor*above(k - 1)
         first(k) = first(k) - factor*first(k - 1)
         second(k) = second(k) - factor*second(k - 1)
      end do
      do k = n - 1, middle, -1
         factor = above(k)/diagonal(k + 1)
         diagonal(k) = diagonal(k) - factor*below(k + 1)
         first(k) = first(k) - factor*first(k + 1)
         second(k) = second(k) - factor*second(k + 1)
      end do
      first(middle) = first(middle)/diagonal(middle)
      second(middle) = second(middle)/diagonal(middle)
      do k = middle - 1, 0, -1
         first(k) = (first(k) - above(k)*first(k + 1))/diagonal(k)
         second(k) = (second(k) - above(k)*second(k + 1))/diagonal(k)
      end do
      do k = middle + 1, n
         first(k) = (first(k) - below(k)*first(k - 1))/diagonal(k)
         second(k) = (second(k) - below(k)*second(k - 1))/diagonal(k)
      end do
   end subroutine solve_both

end module ehlwave_film_column
