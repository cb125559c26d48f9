!> What a program says on standard output and standard error.
module ehlwave_terminal
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use ehlwave_posix, only: append_text, is_broken_pipe
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

   !> Print the last line of the output, or a text that is all of it. `is_written` tells whether it and all before it have
   !> arrived: Fortran's own output does not notice a full disk, but what it could not write it tries again before each line
   !> that follows. A reader who has seen enough and closed the pipe, as `head` does, is no error.
   subroutine print_last(line, is_written)
      character(len=*), intent(in) :: line
      logical, intent(out) :: is_written
      integer, parameter :: standard_output = 1
      integer :: status
      flush (output_unit)
      if (index(line, new_line('a'), back=.true.) == len(line)) then
         call append_text(standard_output, line, status)
      else
         call append_text(standard_output, line//new_line('a'), status)
      end if
      is_written = status == 0 .or. is_broken_pipe(status)
   end subroutine print_last

end module ehlwave_terminal
