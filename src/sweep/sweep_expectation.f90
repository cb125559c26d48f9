!> Expected time of the cases of a sweep before any has run.
module ehlwave_sweep_expectation
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_work_unit, only: expected_unit_seconds
   implicit none (type, external)
   private
   public :: expected_seconds

contains

   !> Wall time of each case in seconds, NaN where there is no model. A single grid is timed for all, so that
   !> 100,000 cases take no longer than a single case.
   function expected_seconds(plans) result(seconds)
      type(case_plan_t), intent(in) :: plans(:)
      real(dp) :: seconds(size(plans))
      seconds = plans%work_with_estimates*expected_unit_seconds(plans%cells_x, plans%cells_y)
   end function expected_seconds

end module ehlwave_sweep_expectation
