!> What a program says on standard output and standard error.
module ehlwave_terminal
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use ehlwave_posix, only: append_text
   use ehlwave_text, only: shown
   implicit none (type, external)
   private
   public :: complain, print_last

   integer, parameter :: most_printed = 2000   !! characters of an error message

contains

   !> An error message, in one line that a terminal can show.
   subroutine complain(program, message)
      character(len=*), intent(in) :: program, message
      write (error_unit, '(a)') program//': '//shown(message, most_printed)
   end subroutine complain

   !> Print the last line of the output. `is_written` tells whether it and all before it have arrived: Fortran's own output
   !> does not notice a full disk, but what it could not write it tries again before each line that follows.
   subroutine print_last(line, is_written)
      character(len=*), intent(in) :: line
      logical, intent(out) :: is_written
      integer, parameter :: standard_output = 1
      integer :: status
      flush (output_unit)
      call append_text(standard_output, line//new_line('a'), status)
      is_written = status == 0
   end subroutine print_last

end module ehlwave_terminal
