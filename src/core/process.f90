!> Services of the process: signals, exits, libraries loaded on request.
module ehlwave_process
   use, intrinsic :: iso_c_binding, only: c_char, c_funptr, c_int, c_long, c_null_char
   implicit none (type, external)
   private
   public :: catch_signals, end_program, find_procedure, guarded, ignore_write_signals, library_text, process_id, &
      set_note, signal_caught, watchdog

   interface
      !> Number of this process.
      integer(c_int) function process_id() bind(c, name='ehlwave_process_id')
         import :: c_int
         implicit none (type, external)
      end function process_id
      !> The last signal caught, 0 for none.
      integer(c_int) function signal_caught() bind(c, name='ehlwave_signal_caught')
         import :: c_int
         implicit none (type, external)
      end function signal_caught
      integer(c_int) function c_set_note(file, text, length) bind(c, name='ehlwave_set_note')
         import :: c_char, c_int, c_long
         implicit none (type, external)
         integer(c_int), value :: file
         character(kind=c_char), intent(in) :: text(*)
         integer(c_long), value :: length
      end function c_set_note
      !> From now on SIGTERM, SIGUSR1, SIGINT and SIGXCPU are remembered; a second SIGINT ends the process as usual.
      subroutine catch_signals() bind(c, name='ehlwave_catch_signals')
         implicit none (type, external)
      end subroutine catch_signals
      !> End the program with an exit status silently, as `stop status, quiet=.true.` does from gfortran 12 on.
      subroutine end_program(status) bind(c, name='exit')
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: status
      end subroutine end_program
      !> Call a library procedure that may crash on its input: 0, or the signal that ended it; its memory is lost then.
      integer(c_int) function guarded(work) bind(c, name='ehlwave_guarded')
         import :: c_funptr, c_int
         implicit none (type, external)
         type(c_funptr), value :: work     !! address of a procedure without arguments
      end function guarded
      !> From now on it is an error of writing, and not the end of the process, that nobody reads its output any more or
      !> that a file would be longer than `ulimit -f` allows. At the end of the processor time (`ulimit -t`) a line is
      !> printed, with status 4.
      subroutine ignore_write_signals() bind(c, name='ehlwave_ignore_write_signals')
         implicit none (type, external)
      end subroutine ignore_write_signals
      !> End this process by SIGALRM unless called again within some seconds; 0: never.
      subroutine watchdog(seconds) bind(c, name='ehlwave_watchdog')
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: seconds
      end subroutine watchdog
      type(c_funptr) function c_find_procedure(library, name, loads, reason, size) bind(c, &
         name='ehlwave_find_procedure')
         import :: c_char, c_funptr, c_int, c_long
         implicit none (type, external)
         character(kind=c_char), intent(in) :: library(*), name(*)
         integer(c_int), value :: loads
         character(kind=c_char), intent(out) :: reason(*)
         integer(c_long), value :: size
      end function c_find_procedure
      subroutine c_library_text(name, text, size) bind(c, name='ehlwave_library_text')
         import :: c_char, c_long
         implicit none (type, external)
         character(kind=c_char), intent(in) :: name(*)
         character(kind=c_char), intent(out) :: text(*)
         integer(c_long), value :: size
      end subroutine c_library_text
   end interface

contains

   !> The text that the next signal appends to a file by itself; an empty text: nothing. At most 256 bytes.
   subroutine set_note(file, text)
      integer, intent(in) :: file
      character(len=*), intent(in) :: text
      integer :: status
      status = c_set_note(file, text, len(text, c_long))
   end subroutine set_note

   !> A C function of a shared library, not associated if there is none. `may_load`: load the library if it has not
   !> been.
   subroutine find_procedure(library, name, may_load, procedure, reason)
      character(len=*), intent(in) :: library   !! a path, or a name to look for where the system looks
      character(len=*), intent(in) :: name
      logical, intent(in) :: may_load
      type(c_funptr), intent(out) :: procedure
      character(len=:), allocatable, intent(out) :: reason   !! the system's words for why there is none, else empty
      character(len=1000) :: buffer
      procedure = c_find_procedure(library//c_null_char, name//c_null_char, merge(1_c_int, 0_c_int, may_load), buffer, &
                                   int(len(buffer), c_long))
      reason = buffer(:index(buffer, c_null_char) - 1)
   end subroutine find_procedure

   !> Text that a loaded library has under a name, as `fftw_version` of FFTW; empty if none. Without a name: name
   !> and version of the C library, empty if it gives none.
   function library_text(name) result(text)
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: text
      character(len=200) :: buffer
      call c_library_text(name//c_null_char, buffer, int(len(buffer), c_long))
      text = buffer(:index(buffer, c_null_char) - 1)
   end function library_text

end module ehlwave_process
