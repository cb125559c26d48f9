!> Discretisation errors of smooth film and friction.
module ehlwave_film_errors
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_case_result, only: case_result_t
   use ehlwave_error_estimate, only: estimate_error, likely_order, observed_order
   use ehlwave_friction_error, only: estimate_friction_error
   use ehlwave_hierarchy, only: hierarchy_t
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t
   implicit none (type, external)
   private
   public :: estimate_film_errors

   real(dp), parameter :: minimum_margin = 2   !! error of the smallest film over that of the film, where the model
                                               !! stands in

contains

   !> From the levels that have solutions of the case; where there is none to compare with from the model, with a
   !> margin.
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
                                                 plan%thinning%steepness))
      result%film_error_basis = 'coarse_grid'
      if (.not. ieee_is_finite(result%central_film_error)) then
         result%film_error_basis = 'model'
         result%central_film_error = plan%model_margin()*plan%expected_film_mesh_error()
         result%minimum_film_error = minimum_margin*result%central_film_error
      end if
      if (ieee_is_finite(result%shear%friction_coefficient)) result%friction_error = &
         estimate_friction_error(multigrid%levels(n:1:-1), stress, result%central_film_error)
   end subroutine estimate_film_errors

end module ehlwave_film_errors
