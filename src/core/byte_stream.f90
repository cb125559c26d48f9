!> Values in a stream of bytes, exactly: one procedure both writes and reads them.
module ehlwave_byte_stream
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_loc
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   integer, parameter :: bytes_of_real = storage_size(1.0_dp)/8

   !> Bytes that values are passed to, one after the other, or from.
   type, public :: bytes_t
      character(len=:), allocatable :: text
      integer :: place = 0
      logical :: is_reading = .false.
   contains
      procedure :: numbers => pass_numbers
      procedure :: count => pass_count
      procedure :: flags => pass_flags
   end type bytes_t

contains

   !> Real numbers, of any rank.
   subroutine pass_numbers(self, values)
      class(bytes_t), intent(inout) :: self
      real(dp), intent(inout), target, contiguous :: values(..)
      real(dp), pointer :: list(:)
      integer :: n
      n = bytes_of_real*size(values)
      if (n == 0) return
      call c_f_pointer(c_loc(values), list, [size(values)])
      if (self%is_reading) then
         list = transfer(self%text(self%place + 1:self%place + n), list)
      else
         if (.not. allocated(self%text)) self%text = ''
         self%text = self%text//transfer(list, repeat(' ', n))
      end if
      self%place = self%place + n
   end subroutine pass_numbers

   !> A whole number, stored exactly as a real number.
   subroutine pass_count(self, value)
      class(bytes_t), intent(inout) :: self
      integer, intent(inout) :: value
      real(dp) :: number
      number = value
      call self%numbers(number)
      value = nint(number)
   end subroutine pass_count

   !> Logical values, stored exactly as real numbers.
   subroutine pass_flags(self, values)
      class(bytes_t), intent(inout) :: self
      logical, intent(inout) :: values(:, :)
      real(dp), allocatable :: numbers(:, :)
      numbers = merge(1.0_dp, 0.0_dp, values)
      call self%numbers(numbers)
      values = numbers > 0.5_dp
   end subroutine pass_flags

end module ehlwave_byte_stream
