!> Whole text files as they are.
module ehlwave_text_file
   use ehlwave_errors, only: error_t, raise
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
      character(len=256) :: reason
      integer :: bytes
      logical :: is_there

      inquire (file=path, exist=is_there, size=bytes)
      if (path == '') then
         call raise(error, 'no input file is named: give its path')
      else if (.not. is_there) then
         call raise(error, trim(path)//': no such file: check the path')
      else if (bytes > max_bytes) then
         call raise(error, trim(path)//': is larger than 16 MiB: give the path of an input file')
      end if
      if (allocated(error)) return
      call read_whole_file(path, text, reason)
      if (.not. allocated(text)) then
         call raise(error, trim(path)//': cannot be read ('//trim(reason)//'): give the path of a text file')
      else if (len(text) == 0) then
         call raise(error, trim(path)//': is empty: check the path, or write the file')
      else if (index(text, achar(0)) > 0) then
         call raise(error, trim(path)//': holds zero bytes: give the path of a plain text file (ASCII or UTF-8)')
      end if
   end subroutine read_text

   !> All bytes of a file; not allocated when it cannot be read.
   subroutine read_whole_file(path, text, reason)
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(out) :: text
      character(len=256), intent(out), optional :: reason   !! why it cannot be read
      character(len=256) :: words
      integer :: io, length, unit

      words = ''
      open (newunit=unit, file=path, access='stream', form='unformatted', status='old', action='read', iostat=io, iomsg=words)
      if (io == 0) then
         inquire (unit=unit, size=length)
         allocate (character(len=max(0, length)) :: text)
         if (length > 0) read (unit, iostat=io, iomsg=words) text
         close (unit)
         if (io /= 0) deallocate (text)
      end if
      if (present(reason)) reason = words
   end subroutine read_whole_file

end module ehlwave_text_file
