!> The unit that costs are counted in.
module ehlwave_work_unit
   use, intrinsic :: iso_c_binding, only: c_double, c_double_complex, c_f_pointer, c_ptr, c_size_t, &
      c_int, c_int32_t, c_intptr_t, c_char, c_float, c_float_complex, c_funptr
   use ehlwave_clock, only: wall_seconds
   use ehlwave_fftw_answer, only: obtained
   use ehlwave_fftw_memory, only: make_room
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: expected_unit_seconds, largest_timed, transform_operations, work_unit_operations, work_unit_seconds

   include 'fftw3.f03'

   integer, parameter :: repeats = 3
   real(dp), parameter :: long_s = 0.05_dp     !! a unit that takes longer is timed once
   real(dp), parameter :: valid_s = 10   !! a measured unit is used again for so long
   !> Cells of the largest grid that is timed: 1024^2 cells would need 67 MiB beside all that a case has. Each doubling
   !> beyond makes an operation take `growth` times as long; measured from 512 to 1024 and 2048, see `out_of_cache`.
   integer, parameter :: largest_timed = 512**2
   real(dp), parameter :: growth = 1.08_dp
   integer, parameter :: planned_cells = 256   !! along each side of the grid on which plans measure a work unit
   !> Times as long as there an operation takes on 512 cells and more; measured on 512, 1024, 2048: 2.4, 2.6, 2.8.
   real(dp), parameter :: out_of_cache = 2.6_dp

   type :: measured_unit_t
      integer :: cells(2) = 0
      real(dp) :: seconds = 0, at = 0    ! at: `wall_seconds`
   end type measured_unit_t

   type(measured_unit_t) :: measured(16)   ! of so many grids, in turns of a sweep

   !> Operations counted besides transforms, per node or per entry of a node's row. The unit is the time of a transform
   !> operation (`transform_operations`). Measured by `perf record` on a march and a linear response: M = 100, D = 1,
   !> transverse, 0.5 a, 257 x 257 nodes.
   integer, parameter, public :: evaluation_operations = 450    !! a node: flow, residual and its right side
   integer, parameter, public :: place_operations = 500   !! a place (2 or 3 a face) of a flow that is not Newtonian;
                                                          !! Ree-Eyring measured
   integer, parameter, public :: point_operations = 60    !! a point across the film there, each time the oil is asked;
                                                          !! Carreau's takes 150
   integer, parameter, public :: fitted_operations = 250  !! a face of a fitted flux
   integer, parameter, public :: relaxation_operations = 1000   !! a node: one sweep over lines and the updates after it
   integer, parameter, public :: heat_operations = 1100   !! a level of a node: march of the energy equation (820), then
                                                          !! means, fluidities and mixture; Ree-Eyring measured
   integer, parameter, public :: mlmi_operations = 450          !! per node: about as FFT on 257 x 257 nodes

   real(dp), parameter, public :: single_share = 0.7_dp   !! share of a single-precision convolution in a
                                                          !! double-precision one;
                                                          !! measured: 0.67 to 0.72

   type, public :: work_weights_t
      integer :: solve      !! an entry: with the factors
      integer :: factor     !! an entry: making them, the matrix included
      integer :: product    !! a node: change of the residuals
      integer :: cycle      !! a node: transfers of a cycle, and its share of the orthogonalisation
   end type work_weights_t

   type(work_weights_t), parameter, public :: real_weights = work_weights_t(solve=14, factor=74, product=58, cycle=180)
   type(work_weights_t), parameter, public :: complex_weights = work_weights_t(solve=18, factor=146, product=150, &
      cycle=400)

contains

   !> Operations of a work unit: the same on every machine, busy or not.
   elemental real(dp) function work_unit_operations(cells_x, cells_y)
      integer, intent(in) :: cells_x, cells_y   !! cells over the whole domain
      work_unit_operations = 2*transform_operations(4.0_dp*cells_x*cells_y)
   end function work_unit_operations

   !> Operations of a real transform of n values, by the usual count (a complex one takes twice as many): a whole
   !> number.
   elemental real(dp) function transform_operations(n)
      real(dp), intent(in) :: n
      transform_operations = anint(2.5_dp*n*log(n)/log(2.0_dp))
   end function transform_operations

   !> Seconds to expect of a work unit on a grid, for plans. One small grid is timed, for any plan, in some hundredths
   !> of a second and 8 MiB. It stays in cache, unlike finer grids.
   impure elemental real(dp) function expected_unit_seconds(cells_x, cells_y) result(seconds)
      integer, intent(in) :: cells_x, cells_y   !! cells over the whole domain
      real(dp) :: doublings
      doublings = log(real(cells_x, dp)*cells_y/planned_cells**2)/log(2.0_dp)
      seconds = work_unit_seconds(planned_cells, planned_cells)/work_unit_operations(planned_cells, planned_cells) &
                *work_unit_operations(cells_x, cells_y)*(1 + (out_of_cache - 1)*min(1.0_dp, max(0.0_dp, doublings/2)))
   end function expected_unit_seconds

   !> Seconds of one work unit (WU) here and now: the plain deformation convolution of a grid, that is
   !> a zero-padded real transform of 2 cells_x by 2 cells_y points, a product, and the inverse transform.
   !> The fastest of a few, so that a busy machine does not flatter the counts. A value measured shortly before, as in a
   !> sweep, is used again.
   function work_unit_seconds(cells_x, cells_y) result(seconds)
      integer, intent(in) :: cells_x, cells_y   !! cells over the whole domain
      real(dp) :: seconds
      real(c_double), pointer, contiguous :: plane(:, :)
      complex(c_double_complex), pointer, contiguous :: modes(:, :)
      type(c_ptr) :: forward, backward, plane_memory, modes_memory
      real(dp) :: slower, start
      integer(c_size_t) :: modes_count, plane_count
      integer :: i, n, nx, ny

      do i = 1, size(measured)
         if (any(measured(i)%cells /= [cells_x, cells_y]) .or. wall_seconds() - measured(i)%at >= valid_s) cycle
         seconds = measured(i)%seconds
         return
      end do
      nx = cells_x
      ny = cells_y
      slower = 1
      do while (real(nx, dp)*ny > largest_timed)
         slower = slower*growth
         nx = nx/2
         ny = max(1, ny/2)
      end do
      plane_count = 4_c_size_t*nx*ny
      modes_count = 2_c_size_t*(nx + 1)*ny
      plane_memory = obtained(fftw_alloc_real(plane_count), plane_count)
      modes_memory = obtained(fftw_alloc_complex(modes_count), modes_count)
      call c_f_pointer(plane_memory, plane, [2*nx, 2*ny])
      call c_f_pointer(modes_memory, modes, [nx + 1, 2*ny])
      call make_room()
      forward = obtained(fftw_plan_dft_r2c_2d(2*ny, 2*nx, plane, modes, FFTW_ESTIMATE), modes_count)
      backward = obtained(fftw_plan_dft_c2r_2d(2*ny, 2*nx, modes, plane, FFTW_ESTIMATE), modes_count)
      plane = 0
      seconds = huge(seconds)
      n = repeats
      if (nx*ny < 20000) n = 4*repeats
      do i = 1, n
         start = wall_seconds()
         call fftw_execute_dft_r2c(forward, plane, modes)
         modes = 0.5_dp*modes
         call fftw_execute_dft_c2r(backward, modes, plane)
         seconds = min(seconds, wall_seconds() - start)
         if (seconds > long_s) exit
      end do
      call fftw_destroy_plan(forward)
      call fftw_destroy_plan(backward)
      call fftw_free(plane_memory)
      call fftw_free(modes_memory)
      seconds = slower*seconds*work_unit_operations(cells_x, cells_y)/work_unit_operations(nx, ny)
      measured(minloc(measured%at)) = measured_unit_t([cells_x, cells_y], seconds, wall_seconds())
   end function work_unit_seconds

end module ehlwave_work_unit
