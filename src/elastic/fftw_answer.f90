!> Checks of FFTW's answers to requests for memory and for plans.
module ehlwave_fftw_answer
   use, intrinsic :: iso_c_binding, only: c_associated, c_ptr, c_size_t
   use ehlwave_memory, only: out_of_memory
   implicit none (type, external)
   private
   public :: obtained

contains

   !> The answer, unless empty: then the program ends for lack of memory. FFTW gives no other reason.
   function obtained(answer, values) result(same)
      type(c_ptr), intent(in) :: answer
      integer(c_size_t), intent(in) :: values  !! values of at most 16 bytes that were requested, or that a plan is for
      type(c_ptr) :: same
      if (.not. c_associated(answer)) call out_of_memory(16_c_size_t*values)
      same = answer
   end function obtained

end module ehlwave_fftw_answer
