!> Discretisation errors of smooth film and friction.
module ehlwave_film_errors
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_case_account, only: add_warning
   use ehlwave_case_result, only: case_result_t
   use ehlwave_error_estimate, only: estimate_error, likely_order, observed_order
   use ehlwave_friction_error, only: estimate_friction_error
   use ehlwave_grid, only: grid_t
   use ehlwave_hierarchy, only: hierarchy_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_planned_case, only: case_plan_t
   implicit none (type, external)
   private
   public :: estimate_film_errors

   real(dp), parameter :: minimum_margin = 2   !! error of the smallest film over that of the film, where the model
                                               !! stands in

   !> Of the friction, above which none is given; 1 where no second grid shows how the pressure spike grows. Random
   !> cases that said 1 to 10 with a second grid were off by less.
   real(dp), parameter :: most_friction_error = 10
   real(dp), parameter :: no_friction = 1e-8_dp   !! of pure rolling, by round-off

contains

   !> From the levels that have solutions of the case; where there is none to compare with from the model, with a
   !> margin.
   !>
   !> The smallest film is known no better than that of the centre: it lies at a node, so that two levels can agree by
   !> chance. Of 119 random contacts whose estimate was smaller, one in twenty was off by more than 1.6 times that, one
   !> by 3.3 times; of the error of the centre it was 1.2 and 1.5 times.
   subroutine estimate_film_errors(plan, multigrid, stress, result)
      type(case_plan_t), intent(in) :: plan
      type(hierarchy_t), intent(in) :: multigrid
      real(dp), allocatable, intent(in) :: stress(:, :)   !! tau/ph on the finest level, where it is known
      type(case_result_t), intent(inout) :: result
      integer :: n

      n = size(multigrid%levels)
      result%central_film_error = estimate_error(multigrid%levels(n:1:-1)%central_film)
      result%film_order = observed_order(multigrid%levels(n:1:-1)%central_film)
      result%minimum_film_error = estimate_error(multigrid%levels(n:1:-1)%minimum_film, &
                                                 likely_order(result%film_order, plan%resolution, &
                                                 plan%steepness))
      result%film_error_basis = 'coarse_grid'
      if (ieee_is_finite(result%minimum_film_error)) &
         result%minimum_film_error = max(result%minimum_film_error, result%central_film_error)
      if (plan%is_fitted) result%minimum_film_error = result%minimum_film_error &
         + error_between_nodes(multigrid%levels(n)%problem%grid, multigrid%levels(n)%state%h)
      if (.not. ieee_is_finite(result%central_film_error)) then
         result%film_error_basis = 'model'
         result%central_film_error = plan%model_margin(result%max_pressure)*plan%expected_film_mesh_error()
         result%minimum_film_error = minimum_margin*result%central_film_error
      end if
      if (ieee_is_finite(result%shear%friction_coefficient)) result%friction_error = &
         estimate_friction_error(multigrid%levels(n:1:-1), stress, result%central_film_error)
      if (.not. ieee_is_finite(result%friction_error)) return
      if (abs(result%shear%friction_coefficient) < no_friction) return
      if (result%friction_error > merge(1.0_dp, most_friction_error, result%film_error_basis == 'model')) then
         result%shear%friction_coefficient = no_value
         result%friction_error = no_value
         call add_warning(result, 'friction is not known on this grid, so none is given')
      end if
   end subroutine estimate_film_errors

   !> By how much, relative, the film may be thinner between the nodes than at the thinnest one: an eighth of its second
   !> differences there. With the averaged scheme this is less than the error of the film.
   pure real(dp) function error_between_nodes(grid, h) result(error)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: h(0:, 0:)   !! H, (0:nx, 0:ny)
      integer :: i, j, node(2)

      node = minloc(h) - 1
      i = min(max(node(1), 1), grid%nx - 1)
      j = min(max(node(2), grid%first_row), grid%last_row)
      error = (abs(h(i + 1, j) - 2*h(i, j) + h(i - 1, j)) &
               + abs(h(i, grid%above(j)) - 2*h(i, j) + h(i, grid%below(j))))/(8*h(i, j))
   end function error_between_nodes

end module ehlwave_film_errors
