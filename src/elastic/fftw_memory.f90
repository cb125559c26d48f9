!> Memory that FFTW lays out for its transforms: aligned, so that plans and their bits do not depend on where it is.
module ehlwave_fftw_memory
   use, intrinsic :: iso_c_binding, only: c_double, c_double_complex, c_f_pointer, c_int, &
      c_int32_t, c_intptr_t, c_char, c_float, c_float_complex, c_funptr, c_ptr, c_size_t
   use ehlwave_fftw_answer, only: obtained
   implicit none (type, external)
   private
   public :: allot, make_room

   include 'fftw3.f03'

   !> Make an array (0:n-1, 0:m-1), a row or column of n values for each of m. Who asks for it frees `memory`, by the
   !> `fftw_free` or `fftwf_free` of the precision; where there is none, the program ends: `obtained`.
   interface allot
      procedure allot_real, allot_complex, allot_single
   end interface allot

   integer(c_size_t), parameter :: bytes_of_plan = 2**21   !! more than planning takes

contains

   !> End the program for lack of memory unless there is enough for a plan: FFTW itself crashes where planning lacks it.
   subroutine make_room()
      call fftw_free(obtained(fftw_malloc(bytes_of_plan), bytes_of_plan/16))
   end subroutine make_room

   subroutine allot_real(n, m, memory, array)
      integer, intent(in) :: n, m
      type(c_ptr), intent(out) :: memory
      real(c_double), pointer, contiguous, intent(out) :: array(:, :)
      real(c_double), pointer, contiguous :: from_one(:, :)
      integer(c_size_t) :: values
      values = int(n, c_size_t)*m
      memory = obtained(fftw_alloc_real(values), values)
      call c_f_pointer(memory, from_one, [n, m])
      array(0:, 0:) => from_one
      call make_room()
   end subroutine allot_real

   subroutine allot_complex(n, m, memory, array)
      integer, intent(in) :: n, m
      type(c_ptr), intent(out) :: memory
      complex(c_double_complex), pointer, contiguous, intent(out) :: array(:, :)
      complex(c_double_complex), pointer, contiguous :: from_one(:, :)
      integer(c_size_t) :: values
      values = int(n, c_size_t)*m
      memory = obtained(fftw_alloc_complex(values), values)
      call c_f_pointer(memory, from_one, [n, m])
      array(0:, 0:) => from_one
      call make_room()
   end subroutine allot_complex

   subroutine allot_single(n, m, memory, array)
      integer, intent(in) :: n, m
      type(c_ptr), intent(out) :: memory
      complex(c_float_complex), pointer, contiguous, intent(out) :: array(:, :)
      complex(c_float_complex), pointer, contiguous :: from_one(:, :)
      integer(c_size_t) :: values
      values = int(n, c_size_t)*m
      memory = obtained(fftwf_alloc_complex(values), values)
      call c_f_pointer(memory, from_one, [n, m])
      array(0:, 0:) => from_one
      call make_room()
   end subroutine allot_single

end module ehlwave_fftw_memory
