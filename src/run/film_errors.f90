!> Discretisation errors of smooth film and friction.
module ehlwave_film_errors
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_accuracy_model, only: fitted_share, grids_margin, spike_factor
   use ehlwave_case_account, only: add_warning
   use ehlwave_case_result, only: case_result_t
   use ehlwave_error_estimate, only: estimate_error, formal_order, likely_order, observed_order
   use ehlwave_friction_error, only: estimate_friction_error
   use ehlwave_grid, only: grid_t
   use ehlwave_hierarchy, only: hierarchy_t, level_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_shear_stress, only: friction_outside
   implicit none (type, external)
   private
   public :: estimate_film_errors, limit_spread

   real(dp), parameter :: minimum_margin = 2   !! error of the smallest film over the film error, where the model
                                               !! applies; a share of the film without error,
   real(dp), parameter :: largest_share = 0.95_dp   !! at most: the film is too thin by it

   !> Factor on the error of the smallest film shown by two grids: one of 1362 random contacts exceeded it 1.6 times (96
   !> x 48 cells).
   real(dp), parameter :: side_margin = 1.3_dp

   !> Between nodes a film may be thinner by so much of its second differences: a parabola by an eighth, a kink by half.
   !> Fitted meshes are coarse enough for kinks (line contact, M = 32, 64 to 512 cells: 0.0689, 0.0647, 0.0641, 0.0640).
   !> Without this part some of 913 random contacts were off by 1.8 to 2.0 times the error, with it all by less than 1.1
   !> times.
   real(dp), parameter :: kink_share = 0.5_dp, smooth_share = 0.125_dp

   !> Least share of the expected film error, larger for a fitted scheme: it goes up and down with the mesh, and grids
   !> agree by chance (isoviscous, M = 221: 0.02269, 0.02271, 0.02262, 0.02262 on 32 to 256 cells).
   real(dp), parameter :: least_share = 0.8_dp
   !> Share for shear-thinning oils, whose inlet is locally steeper than on average: one exceeded the expected error
   !> 4.9 times (M = 197, Ree-Eyring, 13 MPa, S = 0.78, 128 x 128 cells).
   real(dp), parameter :: thinning_share = 4
   !> Share of hX^2 + hY^2: error at the centre, independent of the inlet. Three of 400 random fitted contacts with 24
   !> and 32 cells along X had 0.24, 0.3 and 0.6 of it, 4 times the estimate.
   real(dp), parameter :: centre_share = 0.5_dp
   !> Share for the friction over hX^2, `sum_factor` for either scheme: two isoviscous line contacts of M = 7 with 64
   !> and 96 cells had 6 and 10 of it, an averaged one of M = 32 with 96 x 96 cells had 6.
   real(dp), parameter :: fitted_sum = 7, sum_factor = 4

   !> Order with two grids where errors are of first order: a film with a meniscus exceeded the second-order estimate
   !> 3 times (S = 0.26, R = 0.33).
   real(dp), parameter :: first_order = 1

   !> Largest P above which coarse grids are less reliable for the film: one of 1573 random contacts, with P = 1.96 (M
   !> = 30, D = 0.09), exceeded the estimate 1.6 times.
   real(dp), parameter :: high_spike = 1.25_dp

   !> Factor on the model of the film error: one of 95 random films exceeded it 1.9 times (M = 25, D = 0.09, 50 x 32
   !> cells).
   real(dp), parameter :: film_margin = 1.5_dp
   !> Factor for a fitted scheme in shear-thinning oils, whose thinning between nodes is overestimated. One of 130
   !> random contacts exceeded it 3.5 times (24 x 24 cells, M = 91, D = 0.03, S = 0.68, Carreau).
   real(dp), parameter :: thinning_margin = 2.5_dp

   !> Largest estimate of the friction error, above which none is given; 1 without a second grid that shows the growth
   !> of the pressure spike. Random cases with estimates of 1 to 10 from a second grid were off by less.
   real(dp), parameter :: most_friction_error = 10
   real(dp), parameter :: rolling_margin = 2.5_dp      !! factor on the model, for friction by pure rolling
   !> Factor on the error by levels: 11 of 82 random frictions by heat exceeded their estimate by 1.2 to 1.6 times.
   real(dp), parameter :: rolling_levels_margin = 1.5_dp
   real(dp), parameter :: no_friction = 1e-8_dp   !! friction of pure rolling, by round-off

   !> Error by the edges of a flooded domain, over the error of the central film: up to 1.5 times for 152 random
   !> smallest films, on domains of two and four times the size; up to 3.2 times for friction in the pressure spike,
   !> which the film moves. Friction also includes the oil outside, out to `fewest_domains` at least.
   real(dp), parameter :: smallest_domain_share = 1.5_dp, friction_domain_share = 3.5_dp, fewest_domains = 2

contains

   !> From the levels that have solutions of the case; where there is none to compare with from the model, with a
   !> margin.
   !>
   !> The smallest film is no more accurate than the central film: it lies at a node, so that two levels can agree by
   !> chance. Of 119 random contacts with a smaller estimate, one in twenty exceeded 1.6 times this estimate, one 3.3
   !> times; relative to the central error 1.2 and 1.5 times.
   subroutine estimate_film_errors(plan, multigrid, stress, tolerance, result)
      type(case_plan_t), intent(in) :: plan
      type(hierarchy_t), intent(in) :: multigrid
      real(dp), allocatable, intent(in) :: stress(:, :)   !! tau/ph on the finest level, where it is known
      real(dp), intent(in) :: tolerance              !! tolerance of the solution
      type(case_result_t), intent(inout) :: result
      real(dp) :: between   !! the nodes, of the smallest film
      integer :: n

      n = size(multigrid%levels)
      between = between_nodes(multigrid%levels(n)%problem%grid, multigrid%levels(n)%state%h, &
                              merge(kink_share, smooth_share, plan%is_fitted))
      call estimate_by_levels(plan, multigrid%levels(n:1:-1), between, result)
      if (.not. ieee_is_finite(result%central_film_error)) call estimate_by_model(plan, between, result)
      if (ieee_is_finite(result%shear%friction_coefficient)) &
         call estimate_friction(plan, multigrid%levels(n:1:-1), stress, tolerance, result)
      if (plan%is_fitted) result%central_film_error = &
         max(centre_share*(plan%hx**2 + plan%hy**2), result%central_film_error)
      call add_steepness(plan, result)
      call add_domain(plan, multigrid%levels(n), result)
   end subroutine estimate_film_errors

   !> Add errors by the edges of a flooded domain, and by a domain too short for an effect: in the smallest film as in
   !> the central film, whose part is counted apart. The friction adds the oil outside, theory eq. (T11). Truncated
   !> edges are requested and add no error.
   subroutine add_domain(plan, level, result)
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(in) :: level             !! the finest
      type(case_result_t), intent(inout) :: result
      real(dp) :: left, outside, short     ! short: by an inlet that is too short

      left = merge(plan%film_domain_error, 0.0_dp, level%problem%grid%is_flooded)
      short = merge(result%effects%edge_error(), 0.0_dp, level%problem%grid%is_flooded)
      result%minimum_film_domain_error = smallest_domain_share*left + short
      result%minimum_film_error = result%minimum_film_error + result%minimum_film_domain_error
      call result%rolling%add_errors(result%central_film_error, left + short, result%effects%film_error(), &
                                     result%effects%lacks_oil_outside(level%problem%grid))
      if (.not. ieee_is_finite(result%friction_error)) return
      outside = friction_outside(level%problem, level%state, &
                                 max(fewest_domains, plan%conditions%radius_over_a()/abs(plan%x_min)))
      result%friction_domain_error = friction_domain_share*left + short &
                                     + abs(outside/result%shear%friction_coefficient)
      result%friction_error = result%friction_error + result%friction_domain_error
   end subroutine add_domain

   !> Errors of the central and the smallest film, where coarser levels show them; else NaN.
   subroutine estimate_by_levels(plan, levels, between, result)
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(in) :: levels(:)         !! finest first
      real(dp), intent(in) :: between
      type(case_result_t), intent(inout) :: result
      real(dp) :: least

      result%film_error_basis = 'coarse_grid'
      result%film_order = observed_order(levels%central_film)
      result%central_film_error = estimate_error(levels%central_film, &
                                                 merge(first_order, formal_order, plan%effects%are_first_order()))
      if (.not. ieee_is_finite(result%central_film_error)) return
      least = 0
      if (plan%is_fitted) least = merge(least_share, thinning_share, plan%rheology%is_newtonian())* &
                                  plan%expected_film_mesh_error()
      result%central_film_error = limit_spread(plan, result)*result%effects%error_factor()* &
                                  max(1.0_dp, result%max_pressure/high_spike)*max(least, result%central_film_error)
      result%minimum_film_error = estimate_error(levels%minimum_film, &
                                                 likely_order(result%film_order, plan%resolution, plan%steepness))
      if (ieee_is_finite(result%minimum_film_error)) &
         result%minimum_film_error = merge(1.0_dp, side_margin, ieee_is_finite(result%film_order))* &
                                     max(result%minimum_film_error, result%central_film_error + between)
   end subroutine estimate_by_levels

   !> Errors by the model.
   subroutine estimate_by_model(plan, between, result)
      type(case_plan_t), intent(in) :: plan
      real(dp), intent(in) :: between
      type(case_result_t), intent(inout) :: result
      result%film_error_basis = 'model'
      result%central_film_error = merge(thinning_margin, film_margin, plan%is_fitted .and. .not. &
                                        plan%rheology%is_newtonian())*result%effects%error_factor()* &
                                  plan%model_margin(result%max_pressure)*plan%expected_film_mesh_error()
      result%minimum_film_error = of_found(minimum_margin*result%central_film_error) + between
   end subroutine estimate_by_model

   !> Error of the friction by the mesh. A friction with a very large error is dropped, and zero friction has no error.
   subroutine estimate_friction(plan, levels, stress, tolerance, result)
      type(case_plan_t), intent(in) :: plan
      type(level_t), intent(in) :: levels(:)         !! finest first
      real(dp), allocatable, intent(in) :: stress(:, :)
      real(dp), intent(in) :: tolerance
      type(case_result_t), intent(inout) :: result
      real(dp) :: largest, spread
      logical :: is_rolling

      is_rolling = .not. abs(plan%conditions%slip_parameter - 1) > 0
      if (is_rolling .and. plan%levels == 0 .and. &
          abs(result%shear%friction_coefficient) < no_friction) return
      spread = grids_margin
      largest = most_friction_error
      if (result%film_error_basis == 'model') then
         ! one random friction with P up to 1.8 exceeded it 2.4 times, one of pure rolling, by heat, 2.5 times
         spread = spread*spike_factor(result%max_pressure)
         if (is_rolling) spread = rolling_margin*spread
         largest = 1
      else if (is_rolling) then
         spread = rolling_levels_margin*spread
      end if
      result%friction_error = spread*estimate_friction_error(levels, stress, averaged_error(plan, result))
      if (.not. ieee_is_finite(result%friction_error)) return
      result%friction_error = max(merge(fitted_sum, sum_factor, plan%is_fitted)*plan%hx**2, result%friction_error)
      if (result%shear%cancellation > 1/epsilon(1.0_dp)) return
      ! stresses whose sum is nothing, as in pure rolling, are known to the tolerance each
      result%friction_error = max(result%friction_error, tolerance*result%shear%cancellation)
      if (result%friction_error > spread*largest) then
         if (is_rolling) result%friction_error = no_value
         if (abs(result%shear%friction_coefficient) < no_friction) return
         result%shear%friction_coefficient = no_value
         result%friction_error = no_value
         call add_warning(result, 'friction is not known on this grid, so none is given')
      end if
   end subroutine estimate_friction

   !> Factor of errors where the stress is far beyond its limit at the centre, where grids and models are less
   !> reliable. Films of three of 45 such line contacts with a limit had 1.1, 1.3 and 8 times the estimated error, a
   !> response of a fitted scheme 2.3 times the model (M = 97, L = 11, S = 2: 0.63, 0.77, 0.39 on 24 to 48 cells).
   pure real(dp) function limit_spread(plan, result) result(spread)
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result
      real(dp), parameter :: far_beyond = 100       ! tangent factor at the centre from which on
      real(dp), parameter :: limit_margin = 3
      spread = merge(limit_margin, 1.0_dp, plan%rheology%is_limited() .and. &
                     any(result%shear%tangent_factor > far_beyond))
   end function limit_spread

   !> A share of the exact film as a share of the computed film. A film too thin by 0.6 of the true film (starved, hY =
   !> 0.24, a side lobe) was off by 1.6 times its own value.
   pure real(dp) function of_found(share)
      real(dp), intent(in) :: share
      of_found = share/(1 - min(share, largest_share))
   end function of_found

   !> Heat that thins the film makes the inlet steeper by as much, like a shear-thinning oil, see `thinning_t`; coarse
   !> grids do not show it. Films of 0.15 and 0.13 of the isothermal film with 64 x 64 and 64 x 24 cells were off by
   !> 0.24 and 0.09, smallest films by 0.5 and 1.2, with estimates of 0.12, 0.11 and 0.23.
   subroutine add_steepness(plan, result)
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(inout) :: result
      real(dp) :: steeper
      steeper = result%effects%steepening(result%central_film)* &
                plan%model_margin(result%max_pressure)*plan%expected_film_mesh_error()
      result%central_film_error = max(result%central_film_error, steeper)
      result%minimum_film_error = max(result%minimum_film_error, minimum_margin*steeper)
   end subroutine add_steepness

   !> Film error by the mesh for the friction: with the model the error of the averaged scheme, else a part of it. A
   !> fitted inlet improves the film, but hardly the sum of the stresses: errors of 0.022 (isoviscous, 64 x 50
   !> cells, a model) and 0.0065 (M = 10, L = 1.1, 96 x 96, estimated as 0.0018).
   pure real(dp) function averaged_error(plan, result) result(error)
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result
      real(dp), parameter :: sum_share = 0.25_dp
      error = result%central_film_error
      if (plan%is_fitted) error = error*merge(1.0_dp, sum_share, result%film_error_basis == 'model')/fitted_share
   end function averaged_error

   !> By how much the film may be thinner somewhere between the nodes than at the thinnest node, over the film there. A
   !> film may go below each node by a share of its second differences along X and Y. Not below the thinnest node alone:
   !> a constriction that is narrower than a cell leaves the plateau as the thinnest place (line contact, M = 141, 192
   !> to 768 cells, fitted: 0.0154, 0.0148, 0.0147).
   pure real(dp) function between_nodes(grid, h, share)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: h(0:, 0:)   !! H, (0:nx, 0:ny)
      real(dp), intent(in) :: share
      real(dp) :: thinnest
      integer :: i, j

      thinnest = minval(h)
      do j = grid%first_row, grid%last_row
         do i = 1, grid%nx - 1
            thinnest = min(thinnest, h(i, j) - share*(abs(h(i + 1, j) - 2*h(i, j) + h(i - 1, j)) &
                                                      + abs(h(i, grid%above(j)) - 2*h(i, j) + h(i, grid%below(j)))))
         end do
      end do
      between_nodes = 1 - thinnest/minval(h)
   end function between_nodes

end module ehlwave_film_errors
