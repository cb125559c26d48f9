#define KIND sp
#define PLAN fftwf_plan_dft_1d
#define EXECUTE fftwf_execute_dft
#define DESTROY fftwf_destroy_plan
#define FREE fftwf_free
!> Convolution of a field on a grid with an even kernel by FFT in single precision.
module ehlwave_single_convolution
   use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_double_complex, c_f_pointer, &
      c_int, c_int32_t, c_intptr_t, c_char, c_float, c_float_complex, c_funptr, c_null_ptr, c_ptr, c_size_t
   use ehlwave_fftw_answer, only: obtained
   use ehlwave_fftw_memory, only: allot
   use ehlwave_grid, only: grid_t
   use ehlwave_kernel_transform, only: kernel_transform_t
   use ehlwave_kinds, only: dp, sp
   use ehlwave_threads, only: is_shared, thread_count, thread_number
   implicit none (type, external)
   private

   include 'fftw3.f03'
#include "convolution.inc"

end module ehlwave_single_convolution
