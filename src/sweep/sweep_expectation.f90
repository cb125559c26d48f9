!> Time to expect of the cases of a sweep before any has run.
module ehlwave_sweep_expectation
   use ehlwave_case_plan, only: case_plan_t
   use ehlwave_kinds, only: dp
   use ehlwave_work_unit, only: work_unit_operations, work_unit_seconds
   implicit none (type, external)
   private
   public :: expected_seconds

   integer, parameter :: measured_cells = 256  !! along each side of the grid on which a work unit is measured

contains

   !> Wall time of each case in seconds, NaN where there is no model. One work unit is measured here and now and scaled to
   !> the other grids as a Fourier transform, so that 100,000 cases take no longer than one.
   function expected_seconds(plans) result(seconds)
      type(case_plan_t), intent(in) :: plans(:)
      real(dp) :: seconds(size(plans))
      real(dp) :: unit_s
      unit_s = work_unit_seconds(measured_cells, measured_cells)/work_unit_operations(measured_cells, measured_cells)
      seconds = plans%work_with_estimates*unit_s*work_unit_operations(plans%cells_x, plans%cells_y)
   end function expected_seconds

end module ehlwave_sweep_expectation
