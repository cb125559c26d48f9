!> POSIX calls for files: appending durably, locks, folders. Those for processes: `core/process`.
!>
!> Fortran's own output is not enough: compilers report a full disk late or never, and none can wait until a
!> record is on the disk.
module ehlwave_posix
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_int32_t, c_long, c_null_char
   implicit none (type, external)
   private
   public :: append_text, checksum, clear_temporaries, close_file, create_file, file_kind, find_character, &
      is_broken_pipe, is_locked, is_temporary, list_folder, lock_file, make_folder, open_file, read_bytes, &
      reason_text, remove_file, replace_file, sync_file, try_file

   integer, parameter, public :: lock_taken = 0, lock_refused = 1, lock_absent = 2, lock_unwritable = -1
   !> Kinds of names
   integer, parameter, public :: kind_none = 0, kind_file = 1, kind_folder = 2, kind_link = 3, kind_other = 4

   abstract interface
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

   !> Flush appended data to the disk. 0, or the system's error number.
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
      integer(c_int) function c_is_broken_pipe(status) bind(c, name='ehlwave_is_broken_pipe')
         import :: c_int
         implicit none (type, external)
         integer(c_int), value :: status
      end function c_is_broken_pipe
      subroutine c_reason(number, text, size) bind(c, name='ehlwave_reason')
         import :: c_char, c_int, c_long
         implicit none (type, external)
         integer(c_int), value :: number
         character(kind=c_char), intent(out) :: text(*)
         integer(c_long), value :: size
      end subroutine c_reason
   end interface

contains

   !> CRC-32 of a text (as in zlib), 8 hexadecimal digits in lower case.
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
      logical, intent(in) :: back              !! the last occurrence
      find_character = c_find(text, len(text, c_long), iachar(character, c_int), merge(1_c_int, 0_c_int, back))
   end function find_character

   !> Create a file for appending. `status` is 0 or the system's error number, also when the file exists.
   subroutine create_file(path, file, status)
      character(len=*), intent(in) :: path
      integer, intent(out) :: file, status
      file = c_create(path//c_null_char)
      status = max(0, -file)
   end subroutine create_file

   !> Append a text in one piece. `status` is 0 or the system's error number; then a part may have been written.
   subroutine append_text(file, text, status)
      integer, intent(in) :: file
      character(len=*), intent(in) :: text
      integer, intent(out) :: status
      status = c_append(file, text, len(text, c_long))
   end subroutine append_text

   !> Whether an error number means that nobody reads a pipe any more.
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

   !> Whether `replace_file` could make a file: `status` is 0 or the system's error number. Existing files stay.
   subroutine try_file(path, status)
      character(len=*), intent(in) :: path
      integer, intent(out) :: status
      status = c_try(path//c_null_char)
   end subroutine try_file

   !> Remove leftovers of `replace_file` in a folder where its process died; files that another process is writing
   !> stay.
   subroutine clear_temporaries(folder, of)
      character(len=*), intent(in) :: folder
      character(len=*), intent(in) :: of       !! name of the file, without its folder; empty: all files
      call c_clear(folder//c_null_char, of//c_null_char)
   end subroutine clear_temporaries

   !> Whether a name, without its folder, is a temporary name of `replace_file`.
   logical function is_temporary(name)
      character(len=*), intent(in) :: name
      is_temporary = c_is_temporary(name//c_null_char, c_null_char) /= 0
   end function is_temporary

   !> Kind of file of a name, links not followed: one of the kinds above; `kind_other` where it cannot be read.
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

   !> Names in a folder except names that begin with a dot, one per line; not allocated when it cannot be read.
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

   !> The system's words for an error number.
   function reason_text(status) result(text)
      integer, intent(in) :: status
      character(len=:), allocatable :: text
      character(len=200) :: buffer
      call c_reason(status, buffer, int(len(buffer), c_long))
      text = buffer(:index(buffer, c_null_char) - 1)
   end function reason_text

end module ehlwave_posix
