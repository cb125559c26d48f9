!> Whole text files as they are.
module ehlwave_text_file
   use, intrinsic :: iso_c_binding, only: c_long, c_size_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_memory, only: can_allocate
   use ehlwave_posix, only: close_file, file_kind, kind_none, open_file, read_bytes, reason_text
   implicit none (type, external)
   private
   public :: read_text, read_whole_file

   integer, parameter :: max_bytes = 16*1024*1024   !! a larger file is not an input file

contains

   !> Read an input file byte by byte. Fails when it cannot be read, is empty, very large or not text.
   subroutine read_text(path, text, error)
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(out) :: text   !! all bytes, line ends included
      type(error_t), allocatable, intent(out) :: error
      character(len=:), allocatable :: reason

      if (path == '') then
         call raise(error, 'no input file is named: give its path')
         return
      end if
      call read_whole_file(trim(path), text, reason, max_bytes + 1_c_long)
      if (.not. allocated(text)) then
         if (file_kind(trim(path)) == kind_none) then
            call raise(error, trim(path)//': no such file: check the path')
         else
            call raise(error, trim(path)//': cannot be read ('//reason//'): give the path of a text file')
         end if
      else if (len(text) > max_bytes) then
         call raise(error, trim(path)//': is larger than 16 MiB: give the path of an input file')
      else if (len(text) == 0) then
         call raise(error, trim(path)//': is empty: check the path, or write the file')
      else if (index(text, achar(0)) > 0) then
         call raise(error, trim(path)//': holds zero bytes: give the path of a plain text file (ASCII or UTF-8)')
      end if
   end subroutine read_text

   !> All bytes of a regular file; not allocated when it cannot be read.
   subroutine read_whole_file(path, text, reason, most)
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(out) :: text
      character(len=:), allocatable, intent(out), optional :: reason   !! why it cannot be read, else empty
      integer(c_long), intent(in), optional :: most                    !! bytes to read: the rest is left out
      integer(c_long) :: bytes, length
      integer :: file, status, ignored
      logical :: fits

      call open_file(path, file, bytes, status)
      if (present(most)) bytes = min(bytes, most)
      fits = .true.
      if (status == 0) then
         fits = can_allocate(int(bytes, c_size_t))
         if (fits) allocate (character(len=bytes) :: text)
         if (fits) call read_bytes(file, text, length, status)
         ignored = close_file(file)
      end if
      if (allocated(text)) then
         if (status /= 0) deallocate (text)
      end if
      if (allocated(text)) then
         if (length < bytes) text = text(:length)
      end if
      if (.not. present(reason)) return
      reason = ''
      if (status /= 0) reason = reason_text(status)
      if (.not. fits) reason = 'it does not fit into memory'
   end subroutine read_whole_file

end module ehlwave_text_file
