!> The unit that costs are counted in.
module ehlwave_work_unit
   use, intrinsic :: iso_c_binding, only: c_double, c_double_complex, c_f_pointer, c_ptr, c_size_t, &
      c_int, c_int32_t, c_intptr_t, c_char, c_float, c_float_complex, c_funptr
   use ehlwave_clock, only: wall_seconds
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: work_unit_seconds

   include 'fftw3.f03'

   integer, parameter :: repeats = 3

contains

   !> Seconds of one work unit (WU) here and now: the plain deformation convolution of a grid, that is
   !> a zero-padded real transform of 2 cells_x by 2 cells_y points, a product, and the inverse transform.
   !> The fastest of a few, so that a busy machine does not flatter the counts.
   function work_unit_seconds(cells_x, cells_y) result(seconds)
      integer, intent(in) :: cells_x, cells_y   !! cells over the whole domain
      real(dp) :: seconds
      real(c_double), pointer, contiguous :: plane(:, :)
      complex(c_double_complex), pointer, contiguous :: modes(:, :)
      type(c_ptr) :: forward, backward, plane_memory, modes_memory
      real(dp) :: start
      integer :: i, n

      plane_memory = fftw_alloc_real(4_c_size_t*cells_x*cells_y)
      modes_memory = fftw_alloc_complex(2_c_size_t*(cells_x + 1)*cells_y)
      call c_f_pointer(plane_memory, plane, [2*cells_x, 2*cells_y])
      call c_f_pointer(modes_memory, modes, [cells_x + 1, 2*cells_y])
      forward = fftw_plan_dft_r2c_2d(2*cells_y, 2*cells_x, plane, modes, FFTW_ESTIMATE)
      backward = fftw_plan_dft_c2r_2d(2*cells_y, 2*cells_x, modes, plane, FFTW_ESTIMATE)
      plane = 0
      seconds = huge(seconds)
      n = repeats
      if (cells_x*cells_y < 20000) n = 4*repeats
      do i = 1, n
         start = wall_seconds()
         call fftw_execute_dft_r2c(forward, plane, modes)
         modes = 0.5_dp*modes
         call fftw_execute_dft_c2r(backward, modes, plane)
         seconds = min(seconds, wall_seconds() - start)
      end do
      call fftw_destroy_plan(forward)
      call fftw_destroy_plan(backward)
      call fftw_free(plane_memory)
      call fftw_free(modes_memory)
   end function work_unit_seconds

end module ehlwave_work_unit
