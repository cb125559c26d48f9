!> Time, error and memory to expect of a sweep before it has run.
module ehlwave_sweep_expectation
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_case_plan, only: case_plan_t
   use ehlwave_kinds, only: dp
   use ehlwave_work_unit, only: work_unit_seconds
   implicit none (type, external)
   private
   public :: expected_seconds, expect_sweep

   type, public :: sweep_expectation_t
      real(dp) :: seconds = 0                  !! of computing, of all cases that have a model
      integer :: without_model = 0             !! cases that have none: line contacts
      real(dp) :: error = 0                    !! the largest
      integer :: error_case = 0                !! where that is; 0: no case has a model
      real(dp) :: memory_mib = 0               !! of the largest case, without what MPI takes
   end type sweep_expectation_t

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

   !> What all cases together come to.
   function expect_sweep(plans) result(expectation)
      type(case_plan_t), intent(in) :: plans(:)
      type(sweep_expectation_t) :: expectation
      real(dp) :: seconds(size(plans))
      integer :: i

      seconds = expected_seconds(plans)
      expectation%seconds = sum(seconds, mask=ieee_is_finite(seconds))
      expectation%without_model = count(.not. ieee_is_finite(seconds))
      do i = 1, size(plans)
         expectation%memory_mib = max(expectation%memory_mib, plans(i)%expected_memory_mib())
         if (.not. ieee_is_finite(plans(i)%expected_error)) cycle
         if (plans(i)%expected_error <= expectation%error) cycle
         expectation%error = plans(i)%expected_error
         expectation%error_case = i
      end do
   end function expect_sweep

end module ehlwave_sweep_expectation
