!> Time to expect of the cases of a sweep before any has run.
module ehlwave_sweep_expectation
   use ehlwave_case_plan, only: case_plan_t
   use ehlwave_kinds, only: dp
   use ehlwave_work_unit, only: work_unit_seconds
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
      unit_s = work_unit_seconds(measured_cells, measured_cells)/transform_work(measured_cells, measured_cells)
      seconds = plans%expected_work_units*unit_s*transform_work(plans%cells_x, plans%cells_y)
   end function expected_seconds

   !> Work of a transform of so many points, up to a factor.
   elemental real(dp) function transform_work(cells_x, cells_y)
      integer, intent(in) :: cells_x, cells_y
      real(dp) :: points
      points = 4*real(cells_x, dp)*cells_y
      transform_work = points*log(points)
   end function transform_work

end module ehlwave_sweep_expectation
