!> Whole text files as they are.
module ehlwave_text_file
   use ehlwave_errors, only: error_t, raise
   implicit none (type, external)
   private
   public :: read_text

   integer, parameter :: max_bytes = 16*1024*1024   !! a larger file is not an input file

contains

   !> Read a file byte by byte. Fails when it cannot be read, is empty, very large or not text.
   subroutine read_text(path, text, error)
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(out) :: text   !! all bytes, line ends included
      type(error_t), allocatable, intent(out) :: error
      character(len=256) :: reason
      integer :: unit, io, bytes
      logical :: is_there

      if (path == '') then
         call raise(error, 'no input file is named: give its path')
         return
      end if
      inquire (file=path, exist=is_there)
      if (.not. is_there) then
         call raise(error, trim(path)//': no such file: check the path')
         return
      end if
      bytes = 0
      open (newunit=unit, file=path, access='stream', form='unformatted', status='old', action='read', &
            iostat=io, iomsg=reason)
      if (io == 0) then
         inquire (unit=unit, size=bytes)
         if (bytes > 0 .and. bytes <= max_bytes) then
            allocate (character(len=bytes) :: text)
            read (unit, iostat=io, iomsg=reason) text
         end if
         close (unit)
      end if
      if (io /= 0) then
         call raise(error, trim(path)//': cannot be read ('//trim(reason)//'): give the path of a text file')
      else if (bytes > max_bytes) then
         call raise(error, trim(path)//': is larger than 16 MiB: give the path of an input file')
      else if (bytes <= 0) then
         call raise(error, trim(path)//': is empty: check the path, or write the file')
      else if (index(text, achar(0)) > 0) then
         call raise(error, trim(path)//': holds zero bytes: give the path of a plain text file (ASCII or UTF-8)')
      end if
   end subroutine read_text

end module ehlwave_text_file
