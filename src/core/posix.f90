!> POSIX calls: appending durably, locks, folders, signals, libraries that are loaded when they are asked for.
!>
!> Fortran's own output is not enough: compilers report a full disk late or never, and none can wait until a
!> record is on the disk.
module ehlwave_posix
   use, intrinsic :: iso_c_binding, only: c_char, c_funptr, c_int, c_int32_t, c_long, c_null_char
   implicit none (type, external)
   private
   public :: append_text, catch_signals, checksum, clear_temporaries, close_file, create_file, end_program, &
      file_kind, find_character, find_procedure, guarded, ignore_write_signals, is_broken_pipe, is_locked, &
      is_temporary, library_text, list_folder, lock_file, make_folder, open_file, process_id, read_bytes, reason_text, &
      remove_file, replace_file, set_note, signal_caught, sync_file, try_file, watchdog

   integer, parameter, public :: lock_taken = 0, lock_refused = 1, lock_absent = 2, lock_unwritable = -1
   !> of a name
   integer, parameter, public :: kind_none = 0, kind_file = 1, kind_folder = 2, kind_link = 3, kind_other = 4

   abstract interface
      integer(c_int) function of_process() bind(c)
         import :: c_int
         implicit none (type, external)
      end function of_process
      integer(c_int) function of_file(file) bind(c)
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: file
      end function of_file
      integer(c_int) function of_path(path) bind(c)
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
      end function of_path
      integer(c_int) function of_file_and_text(file, text, length) bind(c)
         import :: c_char, c_int, c_long
         implicit none (type, external)
         integer(c_int), value :: file
         character(kind=c_char), intent(in) :: text(*)
         integer(c_long), value :: length
      end function of_file_and_text
   end interface

   procedure(of_process), bind(c, name='ehlwave_process_id') :: process_id        !! number of this process
   procedure(of_process), bind(c, name='ehlwave_signal_caught') :: signal_caught  !! the last signal caught, 0 for none
   !> Wait until what was appended is on the disk. 0, or the system's error number.
   procedure(of_file), bind(c, name='ehlwave_sync') :: sync_file
   procedure(of_file), bind(c, name='ehlwave_close') :: close_file                !! 0, or the system's error number
   procedure(of_path), bind(c, name='ehlwave_create') :: c_create
   procedure(of_path), bind(c, name='ehlwave_kind') :: c_kind
   procedure(of_path), bind(c, name='ehlwave_try') :: c_try
   procedure(of_path), bind(c, name='ehlwave_make_folder') :: c_make_folder
   procedure(of_path), bind(c, name='ehlwave_remove') :: c_remove
   procedure(of_path), bind(c, name='ehlwave_lock') :: c_lock
   procedure(of_path), bind(c, name='ehlwave_is_locked') :: c_is_locked
   procedure(of_file_and_text), bind(c, name='ehlwave_append') :: c_append
   procedure(of_file_and_text), bind(c, name='ehlwave_set_note') :: c_set_note

   interface
      integer(c_int32_t) function c_crc32(text, length) bind(c, name='ehlwave_crc32')
         import :: c_char, c_int32_t, c_long
         implicit none (type, external)
         character(kind=c_char), intent(in) :: text(*)
         integer(c_long), value :: length
      end function c_crc32
      integer(c_long) function c_find(text, length, byte, backward) bind(c, name='ehlwave_find')
         import :: c_char, c_int, c_long
         implicit none (type, external)
         character(kind=c_char), intent(in) :: text(*)
         integer(c_long), value :: length
         integer(c_int), value :: byte, backward   ! a character by value does not arrive (gfortran 12)
      end function c_find
      integer(c_int) function c_open(path, bytes) bind(c, name='ehlwave_open')
         import :: c_char, c_int, c_long
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
         integer(c_long), intent(out) :: bytes
      end function c_open
      integer(c_long) function c_read(file, buffer, size) bind(c, name='ehlwave_read')
         import :: c_char, c_int, c_long
         implicit none (type, external)
         integer(c_int), value :: file
         character(kind=c_char), intent(inout) :: buffer(*)
         integer(c_long), value :: size
      end function c_read
      subroutine c_clear(path, of) bind(c, name='ehlwave_clear')
         import :: c_char
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*), of(*)
      end subroutine c_clear
      integer(c_int) function c_is_temporary(name, of) bind(c, name='ehlwave_is_temporary')
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: name(*), of(*)
      end function c_is_temporary
      integer(c_int) function c_replace(path, text, length) bind(c, name='ehlwave_replace')
         import :: c_char, c_int, c_long
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*), text(*)
         integer(c_long), value :: length
      end function c_replace
      integer(c_long) function c_list(path, buffer, size) bind(c, name='ehlwave_list')
         import :: c_char, c_long
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(inout) :: buffer(*)
         integer(c_long), value :: size
      end function c_list
      !> From now on SIGTERM, SIGUSR1, SIGINT and SIGXCPU are remembered; a second SIGINT ends the process as usual.
      subroutine catch_signals() bind(c, name='ehlwave_catch_signals')
         implicit none (type, external)
      end subroutine catch_signals
      !> End the program with an exit status and without a word, as `stop status, quiet=.true.` does, which gfortran
      !> knows from 12 on.
      subroutine end_program(status) bind(c, name='exit')
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: status
      end subroutine end_program
      !> Do work of a library that may break down on what it is given: 0, or the signal that ended it; what it holds is
      !> lost then.
      integer(c_int) function guarded(work) bind(c, name='ehlwave_guarded')
         import :: c_funptr, c_int
         implicit none (type, external)
         type(c_funptr), value :: work     !! of a procedure without arguments
      end function guarded
      !> From now on it is an error of writing, and not the end of the process, that nobody reads its output any more or
      !> that a file would be longer than `ulimit -f` allows. At the end of the processor time (`ulimit -t`) a line is
      !> printed, with status 4.
      subroutine ignore_write_signals() bind(c, name='ehlwave_ignore_write_signals')
         implicit none (type, external)
      end subroutine ignore_write_signals
      integer(c_int) function c_is_broken_pipe(status) bind(c, name='ehlwave_is_broken_pipe')
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: status
      end function c_is_broken_pipe
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
      subroutine c_reason(number, text, size) bind(c, name='ehlwave_reason')
         import :: c_char, c_int, c_long
         implicit none (type, external)
         integer(c_int), value :: number
         character(kind=c_char), intent(out) :: text(*)
         integer(c_long), value :: size
      end subroutine c_reason
   end interface

contains

   !> CRC-32 of a text (that of zlib), 8 hexadecimal digits in lower case.
   function checksum(text) result(digits)
      character(len=*), intent(in) :: text
      character(len=8) :: digits
      character(len=*), parameter :: hex = '0123456789abcdef'
      integer(c_int32_t) :: value
      integer :: i, place
      value = c_crc32(text, len(text, c_long))
      do i = 1, 8
         place = ibits(value, 32 - 4*i, 4) + 1
         digits(i:i) = hex(place:place)
      end do
   end function checksum

   !> Place of the first or last character of a kind in a text of any length, 0: none. Ten times as fast as `index`.
   integer(c_long) function find_character(text, character, back)
      character(len=*), intent(in) :: text
      character(len=1), intent(in) :: character
      logical, intent(in) :: back              !! the last one
      find_character = c_find(text, len(text, c_long), iachar(character, c_int), merge(1_c_int, 0_c_int, back))
   end function find_character

   !> Create a file for appending. `status` is 0 or the system's error number, also when the file exists.
   subroutine create_file(path, file, status)
      character(len=*), intent(in) :: path
      integer, intent(out) :: file, status
      file = c_create(path//c_null_char)
      status = max(0, -file)
   end subroutine create_file

   !> Append a text in one piece. `status` is 0 or the system's error number; then a part may be there.
   subroutine append_text(file, text, status)
      integer, intent(in) :: file
      character(len=*), intent(in) :: text
      integer, intent(out) :: status
      status = c_append(file, text, len(text, c_long))
   end subroutine append_text

   !> Whether an error number says that nobody reads a pipe any more.
   logical function is_broken_pipe(status)
      integer, intent(in) :: status
      is_broken_pipe = c_is_broken_pipe(status) /= 0
   end function is_broken_pipe

   !> Give a file a new text, all of it or nothing. `status` is 0 or the system's error number.
   subroutine replace_file(path, text, status)
      character(len=*), intent(in) :: path, text
      integer, intent(out) :: status
      status = c_replace(path//c_null_char, text, len(text, c_long))
   end subroutine replace_file

   !> Whether `replace_file` could make a file: `status` is 0 or the system's error number. What is there stays.
   subroutine try_file(path, status)
      character(len=*), intent(in) :: path
      integer, intent(out) :: status
      status = c_try(path//c_null_char)
   end subroutine try_file

   !> Remove what `replace_file` has left in a folder where its process died; what another process writes at the moment
   !> stays.
   subroutine clear_temporaries(folder, of)
      character(len=*), intent(in) :: folder
      character(len=*), intent(in) :: of       !! name of the file, without its folder; empty: all files
      call c_clear(folder//c_null_char, of//c_null_char)
   end subroutine clear_temporaries

   !> Whether a name, without its folder, is one that `replace_file` gives to what it is at work on.
   logical function is_temporary(name)
      character(len=*), intent(in) :: name
      is_temporary = c_is_temporary(name//c_null_char, c_null_char) /= 0
   end function is_temporary

   !> The kind of file that has a name, links not followed: one of the kinds above; `kind_other` where it cannot be
   !> looked at.
   integer function file_kind(path)
      character(len=*), intent(in) :: path
      file_kind = c_kind(path//c_null_char)
      if (file_kind < 0) file_kind = kind_other
   end function file_kind

   !> Open a regular file for reading, with its length. `status` is 0 or an error number for `reason_text`, also of
   !> folders, pipes and devices: none of them is waited for.
   subroutine open_file(path, file, bytes, status)
      character(len=*), intent(in) :: path
      integer, intent(out) :: file
      integer(c_long), intent(out) :: bytes
      integer, intent(out) :: status
      file = c_open(path//c_null_char, bytes)
      status = max(0, -file)
   end subroutine open_file

   !> Read until a buffer is full or the file ends. `status` is 0 or the system's error number.
   subroutine read_bytes(file, buffer, length, status)
      integer, intent(in) :: file
      character(len=*), intent(inout) :: buffer
      integer(c_long), intent(out) :: length   !! bytes read
      integer, intent(out) :: status
      length = c_read(file, buffer, len(buffer, c_long))
      status = int(max(0_c_long, -length))
   end subroutine read_bytes

   !> Make a folder unless it is there. `status` is 0 or the system's error number.
   subroutine make_folder(path, status)
      character(len=*), intent(in) :: path
      integer, intent(out) :: status
      status = c_make_folder(path//c_null_char)
   end subroutine make_folder

   !> Remove a file or an empty folder, if it is there. `status` is 0 or the system's error number.
   subroutine remove_file(path, status)
      character(len=*), intent(in) :: path
      integer, intent(out) :: status
      status = c_remove(path//c_null_char)
   end subroutine remove_file

   !> Names in a folder but for those that begin with a dot, one a line; not allocated when it cannot be read.
   subroutine list_folder(path, names, status)
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(out) :: names
      integer, intent(out), optional :: status   !! 0 or the system's error number
      character(len=:), allocatable :: buffer
      integer(c_long) :: length, room
      room = 65536
      do
         allocate (character(len=room) :: buffer)
         length = c_list(path//c_null_char, buffer, room)
         if (length <= room) exit
         room = 2*length
         deallocate (buffer)
      end do
      if (present(status)) status = int(max(0_c_long, -length))
      if (length >= 0) names = buffer(:length)
   end subroutine list_folder

   !> Lock a file until this process ends. `status` is one of lock_taken, lock_refused (another process has it),
   !> lock_absent (this file system has no locks), lock_unwritable.
   subroutine lock_file(path, status)
      character(len=*), intent(in) :: path
      integer, intent(out) :: status
      status = c_lock(path//c_null_char)
   end subroutine lock_file

   !> Whether another process holds the lock of a file.
   logical function is_locked(path)
      character(len=*), intent(in) :: path
      is_locked = c_is_locked(path//c_null_char) /= 0
   end function is_locked

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

   !> The text that a loaded library has under a name, as `fftw_version` of FFTW; empty if there is none. Without a
   !> name: name and version of the C library, empty if it does not say.
   function library_text(name) result(text)
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: text
      character(len=200) :: buffer
      call c_library_text(name//c_null_char, buffer, int(len(buffer), c_long))
      text = buffer(:index(buffer, c_null_char) - 1)
   end function library_text

   !> The system's words for an error number.
   function reason_text(status) result(text)
      integer, intent(in) :: status
      character(len=:), allocatable :: text
      character(len=200) :: buffer
      call c_reason(status, buffer, int(len(buffer), c_long))
      text = buffer(:index(buffer, c_null_char) - 1)
   end function reason_text

end module ehlwave_posix
