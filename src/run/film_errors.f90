!> Errors of smooth film and friction: by the mesh, and by the edges of the domain.
module ehlwave_film_errors
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_accuracy_model, only: expected_film_error, light_film_error, upstream_error
   use ehlwave_case_account, only: add_warning
   use ehlwave_case_result, only: case_result_t
   use ehlwave_error_factors, only: by_domain, central_film, friction, smallest_film
   use ehlwave_grid, only: grid_t
   use ehlwave_hierarchy, only: hierarchy_t, level_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_mesh_errors, only: kind_of, mesh_error, mesh_error_t, observed_order
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_rolling_result, only: times_outside
   use ehlwave_shear_stress, only: friction_at, friction_outside
   use ehlwave_state, only: state_t
   implicit none (type, external)
   private
   public :: estimate_film_errors, spike_growth

   real(dp), parameter :: no_friction = 1e-8_dp      !! friction of pure rolling, by round-off
   real(dp), parameter :: friction_factor = 2        !! error of a friction over the squares of the mesh sizes, expected
   !> Frictions below the first, which heat leaves in pure rolling, are not in the sample: twice as much is expected.
   real(dp), parameter :: next_to_nothing = 1e-5_dp, nothing_factor = 2
   real(dp), parameter :: most_known = 3             !! relative error of a friction from which on none is given

contains

   !> Errors from the levels that have solutions of the case, else from the model.
   subroutine estimate_film_errors(plan, multigrid, tolerance, result)
      type(case_plan_t), intent(in) :: plan
      type(hierarchy_t), intent(in) :: multigrid
      real(dp), intent(in) :: tolerance              !! tolerance of the solution
      type(case_result_t), intent(inout) :: result
      type(mesh_error_t) :: central, smallest
      real(dp) :: light                              ! error by the model that no steep inlet makes
      real(dp) :: order                              ! of errors by the mesh
      integer :: kind, n

      n = size(multigrid%levels)
      kind = kind_of(plan%is_fitted, plan%conditions%is_line())
      order = merge(1.0_dp, 2.0_dp, plan%effects%are_first_order())
      light = light_film_error(result%central_film)*plan%hx**2
      if (plan%is_fitted) light = light + upstream_error(plan%resolution%inlet)
      associate (levels => multigrid%levels(n:1:-1), steeper => 1 + result%effects%steepening(result%central_film))
         associate (expected => steeper*plan%expected_film_mesh_error() + light)
            central = mesh_error(central_film, kind, levels%central_film, expected, order)
            smallest = mesh_error(smallest_film, kind, levels%minimum_film, &
                                  expected + between_nodes(levels(1)%problem%grid, levels(1)%state%h), order)
            result%central_film_error = central%relative
            result%film_error_basis = central%basis
            result%film_order = observed_order(levels%central_film)
            result%minimum_film_error = smallest%relative
            ! Little is left of the resistance of starved contacts, so their meniscus counts twice
            call result%rolling%estimate(kind, expected + merge(2*plan%hx, 0.0_dp, order < 2), &
                                         merge(1.0_dp, order, plan%is_fitted))
         end associate
         if (ieee_is_finite(result%shear%friction_coefficient)) call estimate_friction(plan, levels, &
            steeper*plan%thinning%steepness*expected_film_error(plan%conditions, plan%hx) &
            + friction_factor*(plan%hx**2 + plan%hy**2), tolerance, result)
      end associate
      call add_domain(plan, multigrid%levels(n), result)
   end subroutine estimate_film_errors

   !> Add errors by the edges of a flooded domain, which grow with the steepness of the inlet, and by a domain too short
   !> for an effect. Friction has the error of the film and the whole part by the oil outside, theory eq. (T11): much of
   !> it is beyond twice the domain, where the sample ends. Rolling resistance has a share of its part, the whole of
   !> which a starved contact may lack. Truncated edges are requested and add no error.
   subroutine add_domain(plan, level, result)
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(in) :: level             !! the finest
      type(case_result_t), intent(inout) :: result
      real(dp) :: edges                    ! error of the film that the model expects

      edges = 0
      if (level%problem%grid%is_flooded) edges = plan%film_domain_error/by_domain(central_film) &
         *(1 + result%effects%steepening(result%central_film)) + result%effects%edge_error()
      result%film_domain_error = by_domain(central_film)*edges
      result%minimum_film_domain_error = by_domain(smallest_film)*edges
      result%minimum_film_error = result%minimum_film_error + result%minimum_film_domain_error
      call result%rolling%add_errors(result%film_domain_error, result%effects%film_error(), &
         plan%effects%are_first_order(), result%effects%lacks_oil_outside(level%problem%grid))
      if (.not. ieee_is_finite(result%friction_error)) return
      result%friction_domain_error = result%film_domain_error + abs(friction_outside(level%problem, level%state, &
         times_outside(level%problem))/result%shear%friction_coefficient)
      result%friction_error = result%friction_error + result%friction_domain_error
   end subroutine add_domain

   !> Error of the friction by the mesh. Stresses whose sum is nothing, as in pure rolling, are known to the tolerance
   !> each. A friction with a very large error is dropped, and zero friction without heat has no error.
   subroutine estimate_friction(plan, levels, expected, tolerance, result)
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(in) :: levels(:)         !! finest first
      real(dp), intent(in) :: expected               !! error by the model without a pressure spike
      real(dp), intent(in) :: tolerance
      type(case_result_t), intent(inout) :: result
      type(mesh_error_t) :: error
      real(dp) :: by_model, values(size(levels))
      integer :: l

      values = no_value
      values(1) = result%shear%friction_coefficient
      if (abs(values(1)) < no_friction .and. plan%levels == 0) return
      do l = 2, size(levels)
         if (levels(l)%has_film()) values(l) = friction_at(levels(l)%problem, levels(l)%state)
      end do
      ! first order, since spikes go on growing
      by_model = expected + spike_growth(levels(1), values(1))
      if (abs(values(1)) < next_to_nothing) by_model = nothing_factor*by_model
      error = mesh_error(friction, kind_of(plan%is_fitted, plan%conditions%is_line()), values, by_model, 1.0_dp)
      result%friction_error = error%relative
      if (result%shear%cancellation > 1/epsilon(1.0_dp)) return
      result%friction_error = max(result%friction_error, tolerance*result%shear%cancellation)
      if (result%friction_error > most_known) then
         result%friction_error = no_value
         if (abs(values(1)) < no_friction) return
         result%shear%friction_coefficient = no_value
         call add_warning(result, 'friction is not known on this grid, so none is given')
      end if
   end subroutine estimate_friction

   !> Part of the expected error of the friction, of which much is in the pressure spike where stress follows viscosity:
   !> its relative change when the pressure grows by half of its second difference along X wherever it is concave, as it
   !> may between its nodes. A spike may be below the largest pressure.
   real(dp) function spike_growth(level, friction) result(change)
      type(level_t), intent(in) :: level         !! the finest
      real(dp), intent(in) :: friction           !! on it
      type(state_t) :: grown
      integer :: nx

      nx = level%problem%grid%nx
      grown = level%state
      associate (p => level%state%p)
         grown%p(1:nx - 1, :) = p(1:nx - 1, :) + max(0.0_dp, p(1:nx - 1, :) - (p(0:nx - 2, :) + p(2:nx, :))/2)
      end associate
      change = abs(friction_at(level%problem, grown)/friction - 1)
   end function spike_growth

   !> Part of the expected error of the smallest film: by how much the film may be thinner between the nodes than at the
   !> thinnest node, over the film there. Beside a kink it is by at most half of the second difference along X and Y.
   pure real(dp) function between_nodes(grid, h)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: h(0:, 0:)   !! H, (0:nx, 0:ny)
      real(dp) :: thinnest
      integer :: i, j

      thinnest = minval(h)
      do j = grid%first_row, grid%last_row
         do i = 1, grid%nx - 1
            thinnest = min(thinnest, h(i, j) - (abs(h(i + 1, j) - 2*h(i, j) + h(i - 1, j)) &
                                                + abs(h(i, grid%above(j)) - 2*h(i, j) + h(i, grid%below(j))))/2)
         end do
      end do
      between_nodes = 1 - thinnest/minval(h)
   end function between_nodes

end module ehlwave_film_errors
