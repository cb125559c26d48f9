!> Output of a program on standard output and standard error. Names of files and texts of stores can hold control
!> sequences. They are removed here.
module ehlwave_terminal
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use ehlwave_posix, only: append_text, is_broken_pipe
   use ehlwave_text, only: harmless, next_line, shown
   implicit none (type, external)
   private
   public :: complain, print_last, say, say_lines

   integer, parameter :: most_printed = 2000   !! characters of an error message

contains

   !> A line.
   subroutine say(unit, text)
      integer, intent(in) :: unit
      character(len=*), intent(in) :: text
      write (unit, '(a)') harmless(text)
   end subroutine say

   !> Lines, if there are any.
   subroutine say_lines(unit, text)
      integer, intent(in) :: unit
      character(len=*), intent(in) :: text
      integer :: first, last
      last = -1
      do while (next_line(text, first, last))
         call say(unit, text(first:last))
      end do
   end subroutine say_lines

   !> An error message as a single line that a terminal can show.
   subroutine complain(program, message)
      character(len=*), intent(in) :: program, message
      write (error_unit, '(a)') program//': '//shown(message, most_printed)
   end subroutine complain

   !> Print the last line of the output, or a text that is all of it. `is_written` returns whether all output has
   !> arrived, since Fortran's own output does not notice a full disk. A reader that closed the pipe, as `head` does,
   !> is no error.
   subroutine print_last(line, is_written)
      character(len=*), intent(in) :: line
      logical, intent(out) :: is_written
      integer, parameter :: standard_output = 1
      character(len=:), allocatable :: clean
      integer :: first, last, status
      flush (output_unit)
      clean = ''
      last = -1
      do while (next_line(line, first, last))
         clean = clean//harmless(line(first:last))//new_line('a')
      end do
      call append_text(standard_output, clean, status)
      is_written = status == 0 .or. is_broken_pipe(status)
   end subroutine print_last

end module ehlwave_terminal
