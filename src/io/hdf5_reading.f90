!> HDF5 files of which the programs read: opened without the locks of the library, which file systems may refuse.
module ehlwave_hdf5_reading
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_long, c_null_char
   use ehlwave_posix, only: close_file, open_file, read_bytes, reason_text
   use hdf5, only: h5eset_auto_f, h5f_acc_rdonly_f, h5fopen_f, h5open_f, hid_t
   implicit none (type, external)
   private
   public :: has_hdf5_signature, is_written_to, open_hdf5

   character(len=*), parameter :: signature = achar(137)//'HDF'//achar(13)//achar(10)//achar(26)//achar(10)

   interface
      subroutine waive_hdf5_locks() bind(c, name='ehlwave_waive_hdf5_locks')
         implicit none (type, external)
      end subroutine waive_hdf5_locks
      integer(c_int) function c_is_written_to(path) bind(c, name='ehlwave_is_written_to')
         import :: c_char, c_int
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
      end function c_is_written_to
   end interface

contains

   !> Start the library and open a file for reading; `is_open` is false where the library cannot. Called in guarded
   !> work, which ends with h5close_f.
   subroutine open_hdf5(path, file, is_open)
      character(len=*), intent(in) :: path
      integer(hid_t), intent(out) :: file
      logical, intent(out) :: is_open
      integer :: status
      call waive_hdf5_locks()
      call h5open_f(status)
      call h5eset_auto_f(0, status)
      call h5fopen_f(path, h5f_acc_rdonly_f, file, status)
      is_open = status >= 0
   end subroutine open_hdf5

   !> Whether a file begins as HDF5 files do; `reason` is empty or the system's words for a file that it does not open.
   subroutine has_hdf5_signature(path, is_hdf5, reason)
      character(len=*), intent(in) :: path
      logical, intent(out) :: is_hdf5
      character(len=:), allocatable, intent(out) :: reason
      character(len=len(signature)) :: text
      integer(c_long) :: bytes, length
      integer :: file, ignored, status

      text = ''
      call open_file(path, file, bytes, status)
      if (status == 0) then
         call read_bytes(file, text, length, status)
         ignored = close_file(file)
      end if
      is_hdf5 = status == 0 .and. text == signature
      reason = ''
      if (status /= 0) reason = reason_text(status)
   end subroutine has_hdf5_signature

   !> Whether another program holds a file open for writing, as far as the file system has locks.
   logical function is_written_to(path)
      character(len=*), intent(in) :: path
      is_written_to = c_is_written_to(path//c_null_char) /= 0
   end function is_written_to

end module ehlwave_hdf5_reading
