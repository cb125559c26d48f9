!> Errors of smooth film and friction: by the mesh, and by the edges of the domain.
module ehlwave_film_errors
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_accuracy_model, only: expected_film_error, light_film_error
   use ehlwave_case_account, only: add_warning
   use ehlwave_case_result, only: case_result_t
   use ehlwave_error_factors, only: by_domain, central_film, friction, rolling, smallest_film
   use ehlwave_friction_error, only: spike_growth
   use ehlwave_grid, only: grid_t
   use ehlwave_hierarchy, only: hierarchy_t, level_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_mesh_errors, only: kind_of, least_error, mesh_error, mesh_error_t, observed_order
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_shear_stress, only: friction_at, friction_outside
   implicit none (type, external)
   private
   public :: estimate_film_errors

   real(dp), parameter :: fewest_domains = 2         !! size of the domain whose oil counts for friction, at least
   real(dp), parameter :: warm_edges = 10            !! growth of the error by the edges, over |S - 1| (Hiso/H - 1)
   real(dp), parameter :: spike_order = 1            !! order of the friction in the mesh size: spikes go on growing
   real(dp), parameter :: rolling_by_meniscus = 3    !! error of the resistance to rolling of a starved contact, over hX
   real(dp), parameter :: no_friction = 1e-8_dp      !! friction of pure rolling, by round-off
   real(dp), parameter :: largest_error = 3          !! error of a friction from which on none is given

contains

   !> Errors from the levels that have solutions of the case, else from the model.
   subroutine estimate_film_errors(plan, multigrid, tolerance, result)
      type(case_plan_t), intent(in) :: plan
      type(hierarchy_t), intent(in) :: multigrid
      real(dp), intent(in) :: tolerance              !! tolerance of the solution
      type(case_result_t), intent(inout) :: result
      type(mesh_error_t) :: central, smallest
      real(dp) :: order                              ! of errors by the mesh
      real(dp) :: steeper                            ! inlet, over the inlet without effects
      real(dp) :: kink                               ! part of the expected error of the smallest film
      logical :: has_coarse                          ! a coarser grid has a solution
      integer :: kind, n

      n = size(multigrid%levels)
      kind = kind_of(plan%is_fitted, plan%conditions%is_line())
      order = merge(1.0_dp, 2.0_dp, plan%effects%are_first_order())
      steeper = result%effects%error_factor()*(1 + result%effects%steepening(result%central_film))
      associate (levels => multigrid%levels(n:1:-1), expected => steeper*plan%expected_film_mesh_error() &
                 + light_film_error(result%central_film)*plan%hx**2)
         central = mesh_error(central_film, kind, levels%central_film, expected, order)
         has_coarse = central%basis == 'coarse_grid'
         kink = between_nodes(levels(1)%problem%grid, levels(1)%state%h)
         smallest = mesh_error(smallest_film, kind, levels%minimum_film, &
                               expected + merge(kink, 0.0_dp, plan%is_fitted .and. .not. has_coarse), order)
         result%central_film_error = central%relative
         result%film_error_basis = central%basis
         result%film_order = observed_order(levels%central_film)
         ! coarser grids that miss a narrow constriction agree by chance, and so does one that has none of them
         result%minimum_film_error = max(smallest%relative, least_error(smallest_film, kind, kink))
         if (ieee_is_finite(result%shear%friction_coefficient)) &
            call estimate_friction(plan, levels, steeper, tolerance, result)
         call result%rolling%estimate(kind, expected + merge(rolling_by_meniscus*plan%hx, 0.0_dp, order < 2 .and. &
                                                             .not. has_coarse), order)
      end associate
      call add_domain(plan, multigrid%levels(n), result)
   end subroutine estimate_film_errors

   !> Add errors by the edges of a flooded domain, and by a domain too short for an effect. Under slip oil gets warm
   !> ahead of the domain, too. The friction adds the oil outside, theory eq. (T11). Truncated edges are requested and
   !> add no error.
   subroutine add_domain(plan, level, result)
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(in) :: level             !! the finest
      type(case_result_t), intent(inout) :: result
      real(dp) :: edges                    ! error of the film that the model expects
      real(dp) :: outside

      edges = 0
      if (level%problem%grid%is_flooded) edges = plan%film_domain_error/by_domain(central_film) &
         *(1 + warm_edges*abs(plan%conditions%slip_parameter - 1)*result%effects%steepening(result%central_film)) &
         + result%effects%edge_error()
      result%film_domain_error = by_domain(central_film)*edges
      result%minimum_film_domain_error = by_domain(smallest_film)*edges
      result%minimum_film_error = result%minimum_film_error + result%minimum_film_domain_error
      call result%rolling%add_errors(by_domain(rolling)*result%film_domain_error, result%effects%film_error(), &
                                     result%effects%lacks_oil_outside(level%problem%grid))
      if (.not. ieee_is_finite(result%friction_error)) return
      outside = friction_outside(level%problem, level%state, &
                                 max(fewest_domains, plan%conditions%radius_over_a()/abs(plan%x_min)))
      result%friction_domain_error = by_domain(friction)*result%film_domain_error &
                                     + abs(outside/result%shear%friction_coefficient)
      result%friction_error = result%friction_error + result%friction_domain_error
   end subroutine add_domain

   !> Error of the friction by the mesh. Stresses whose sum is nothing, as in pure rolling, are known to the tolerance
   !> each. A friction with a very large error is dropped, and zero friction without heat has no error.
   subroutine estimate_friction(plan, levels, steeper, tolerance, result)
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(in) :: levels(:)         !! finest first
      real(dp), intent(in) :: steeper                !! inlet, over the inlet without effects
      real(dp), intent(in) :: tolerance
      type(case_result_t), intent(inout) :: result
      type(mesh_error_t) :: error
      real(dp) :: expected, values(size(levels))
      integer :: l

      values = no_value
      values(1) = result%shear%friction_coefficient
      if (abs(values(1)) < no_friction .and. plan%levels == 0) return
      do l = 2, size(levels)
         if (levels(l)%has_film()) values(l) = friction_at(levels(l)%problem, levels(l)%state)
      end do
      ! the sum of the stresses has the averaged error with either scheme
      expected = steeper*plan%thinning%steepness*expected_film_error(plan%conditions, plan%hx) &
                 + light_film_error(result%central_film)*plan%hx**2 + spike_growth(levels, values(1))
      error = mesh_error(friction, kind_of(plan%is_fitted, plan%conditions%is_line()), values, expected, &
                         spike_order)
      result%friction_error = error%relative
      if (result%shear%cancellation > 1/epsilon(1.0_dp)) return
      result%friction_error = max(result%friction_error, tolerance*result%shear%cancellation)
      if (result%friction_error > largest_error) then
         result%friction_error = no_value
         if (abs(values(1)) < no_friction) return
         result%shear%friction_coefficient = no_value
         call add_warning(result, 'friction is not known on this grid, so none is given')
      end if
   end subroutine estimate_friction

   !> Part of the expected error of the smallest film: by how much the film may be thinner between the nodes than at the
   !> thinnest node, over the film there. A kink is by half of its second difference along X and Y.
   pure real(dp) function between_nodes(grid, h)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: h(0:, 0:)   !! H, (0:nx, 0:ny)
      real(dp), parameter :: kink = 0.5_dp
      real(dp) :: thinnest
      integer :: i, j

      thinnest = minval(h)
      do j = grid%first_row, grid%last_row
         do i = 1, grid%nx - 1
            thinnest = min(thinnest, h(i, j) - kink*(abs(h(i + 1, j) - 2*h(i, j) + h(i - 1, j)) &
                                                     + abs(h(i, grid%above(j)) - 2*h(i, j) + h(i, grid%below(j)))))
         end do
      end do
      between_nodes = 1 - thinnest/minval(h)
   end function between_nodes

end module ehlwave_film_errors
