!> POSIX calls for names: the file that a name leads to, removal without following links.
module ehlwave_paths
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_long, c_null_char
   implicit none (type, external)
   private
   public :: is_same_file, is_within, real_path, remove_folder, remove_within

   interface
      integer(c_int) function c_is_same(one, other) bind(c, name='ehlwave_is_same')
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: one(*), other(*)
      end function c_is_same
      subroutine c_real_path(path, name, size) bind(c, name='ehlwave_real_path')
         import :: c_char, c_long
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(out) :: name(*)
         integer(c_long), value :: size
      end subroutine c_real_path
      integer(c_int) function c_remove_within(folder, part, name) bind(c, name='ehlwave_remove_within')
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: folder(*), part(*), name(*)
      end function c_remove_within
      integer(c_int) function c_remove_folder(path) bind(c, name='ehlwave_remove_folder')
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
      end function c_remove_folder
   end interface

contains

   !> Whether two names lead to the same file: equal names, links and hard links to it. A name without a file is none.
   logical function is_same_file(one, other)
      character(len=*), intent(in) :: one, other
      is_same_file = c_is_same(one//c_null_char, other//c_null_char) /= 0
   end function is_same_file

   !> Full name of a file or folder, without links, `.` and `..`; empty if it cannot be found.
   function real_path(path) result(full)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: full
      character(len=8192) :: buffer
      call c_real_path(path//c_null_char, buffer, int(len(buffer), c_long))
      full = buffer(:index(buffer, c_null_char) - 1)
   end function real_path

   !> Whether a path lies in a folder, at whatever depth.
   logical function is_within(path, folder)
      character(len=*), intent(in) :: path, folder
      character(len=:), allocatable :: above, full
      above = real_path(folder)
      full = real_path(path)
      is_within = len(above) > 0 .and. index(full, above//'/') == 1
   end function is_within

   !> Remove a file of a folder, or of a folder in it; links are not followed. `status` is 0, also where it is not
   !> there, or the system's error number.
   subroutine remove_within(folder, part, name, status)
      character(len=*), intent(in) :: folder
      character(len=*), intent(in) :: part     !! a folder in it; empty: the folder itself
      character(len=*), intent(in) :: name
      integer, intent(out) :: status
      status = c_remove_within(folder//c_null_char, part//c_null_char, name//c_null_char)
   end subroutine remove_within

   !> Remove an empty folder. `status` is 0, also where it is not there, or the system's error number.
   subroutine remove_folder(path, status)
      character(len=*), intent(in) :: path
      integer, intent(out) :: status
      status = c_remove_folder(path//c_null_char)
   end subroutine remove_folder

end module ehlwave_paths
