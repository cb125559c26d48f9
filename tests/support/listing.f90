!> Programs that list what a reader finds in files: a line of output for each path of standard input.
module listing
   use, intrinsic :: iso_fortran_env, only: input_unit, output_unit
   implicit none (type, external)
   private
   public :: hexadecimal, list_paths

   abstract interface
      !> Write the line of a file.
      subroutine list_file_i(path)
         character(len=*), intent(in) :: path
      end subroutine list_file_i
   end interface

contains

   subroutine list_paths(list_file)
      procedure(list_file_i) :: list_file
      character(len=4096) :: path
      integer :: io
      do
         read (input_unit, '(a)', iostat=io) path
         if (io /= 0) exit
         call list_file(trim(path))
         flush (output_unit)
      end do
   end subroutine list_paths

   pure function hexadecimal(text)
      character(len=*), intent(in) :: text
      character(len=2*len(text)) :: hexadecimal
      integer :: i
      do i = 1, len(text)
         write (hexadecimal(2*i - 1:2*i), '(z2.2)') iachar(text(i:i))
      end do
   end function hexadecimal

end module listing
