!> Temperature across the film at one node, by what its neighbours and the surfaces upstream are: theory eq. (D9).
module ehlwave_film_column
   use ehlwave_film_levels, only: film_levels_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: new_column, solve_column

   !> A node. Arrays (0:levels), per unit of zeta.
   type, public :: column_t
      real(dp), allocatable :: own(:)          !! what the flow through the sides takes with it of the node's own rise,
      real(dp), allocatable :: brought(:)      !! what it brings with that of its neighbours,
      real(dp), allocatable :: net(:)          !! and the oil that it takes, less what it brings
      real(dp), allocatable :: source(:)       !! heat, K
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
      allocate (self%own(0:n), self%brought(0:n), self%net(0:n), self%source(0:n), source=0.0_dp)
   end function new_column

   !> Rise at the levels, and the flow of heat into surfaces 1 and 2, d theta/d zeta over H.
   !>
   !> Conduction is the second difference with the source weighted 1, 10, 1: of fourth order where the two balance.
   !> Oil moves across the levels as conservation of its mass asks; in between the rise is the mean, with as little
   !> upstream weight as keeps it monotone. Half a layer at each surface gives its heat to it.
   pure subroutine solve_column(column, levels, rise, into_wall)
      type(column_t), intent(in) :: column
      type(film_levels_t), intent(in) :: levels
      real(dp), intent(out) :: rise(0:)        !! K
      real(dp), intent(out) :: into_wall(2)
      real(dp), dimension(0:levels%n) :: below, diagonal, above, right
      real(dp) :: across, residual, upstream, wall_diagonal(2), wall_beside(2), wall_right(2)
      integer :: k

      associate (n => levels%n, d => levels%d, c => column, s => column%source)
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
            upstream = max(0.0_dp, abs(across) - 2/(max(c%convection, tiny(d))*d))
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
         right(1:n - 1) = right(1:n - 1) + d/12*(s(:n - 2) + 10*s(1:n - 1) + s(2:))
         right(0) = right(0) + d/24*(7*s(0) + 6*s(1) - s(2))
         right(n) = right(n) + d/24*(7*s(n) + 6*s(n - 1) - s(n - 2))
         ! what is left at the surfaces goes into them: H q = right - diagonal theta - beside theta'
         wall_diagonal = [diagonal(n), diagonal(0)]
         wall_beside = [below(n), above(0)]
         wall_right = [right(n), right(0)]
         diagonal(n) = 1 + c%wall_own(1)/c%h*wall_diagonal(1)
         below(n) = c%wall_own(1)/c%h*wall_beside(1)
         right(n) = c%wall_before(1) + c%wall_own(1)/c%h*wall_right(1)
         diagonal(0) = 1 + c%wall_own(2)/c%h*wall_diagonal(2)
         above(0) = c%wall_own(2)/c%h*wall_beside(2)
         right(0) = c%wall_before(2) + c%wall_own(2)/c%h*wall_right(2)
         do k = 1, n
            diagonal(k) = diagonal(k) - below(k)/diagonal(k - 1)*above(k - 1)
            right(k) = right(k) - below(k)/diagonal(k - 1)*right(k - 1)
         end do
         rise(n) = right(n)/diagonal(n)
         do k = n - 1, 0, -1
            rise(k) = (right(k) - above(k)*rise(k + 1))/diagonal(k)
         end do
         into_wall(1) = (wall_right(1) - wall_diagonal(1)*rise(n) - wall_beside(1)*rise(n - 1))/c%h
         into_wall(2) = (wall_right(2) - wall_diagonal(2)*rise(0) - wall_beside(2)*rise(1))/c%h
      end associate
   end subroutine solve_column

end module ehlwave_film_column
