!> Whether a results file can be written under a name: found out before the computation, not after it.
module ehlwave_output_path
   use ehlwave_errors, only: error_t, raise
   use ehlwave_posix, only: clear_temporaries, file_kind, kind_file, kind_folder, kind_link, kind_none, reason_text, try_file
   use ehlwave_text, only: shown
   implicit none (type, external)
   private
   public :: check_output_path

contains

   !> Refuse a name under which no file can be made, or under which there is something else than a regular file: that is
   !> never replaced, also not where overwriting is asked for. Removes what a process that died has left of this file.
   subroutine check_output_path(path, error)
      character(len=*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: error
      integer :: slash, status

      if (allocated(error)) return
      slash = index(path, '/', back=.true.)
      if (len_trim(path) == slash) then
         call raise(error, "cannot write '"//shown(path)//"': it names no file; give the name of one")
         return
      end if
      select case (file_kind(path))
      case (kind_none, kind_file)
         call try_file(path, status)
         if (status /= 0) call raise(error, 'cannot write '//path//': '//reason_text(status)// &
                                     '; does its folder exist and is it writable?')
         call clear_temporaries(path(:slash)//'.', path(slash + 1:))
      case (kind_folder)
         call raise(error, 'cannot write '//path//': it is a folder; give the name of a file')
      case (kind_link)
         call raise(error, 'cannot write '//path//': it is a link; give the name of the file that it leads to')
      case default
         call raise(error, 'cannot write '//path//': it is not a regular file; give the name of one')
      end select
   end subroutine check_output_path

end module ehlwave_output_path
