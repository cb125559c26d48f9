!> Whether a results file can be written under a name: found out before the computation, not after it.
module ehlwave_output_path
   use ehlwave_errors, only: error_t, raise
   use ehlwave_own_result, only: found_damaged, found_foreign, found_own, found_unreadable, is_own_result, &
      look_at_result
   use ehlwave_paths, only: is_same_file
   use ehlwave_posix, only: clear_temporaries, file_kind, kind_file, kind_folder, kind_link, kind_none, reason_text, &
      try_file
   use ehlwave_text, only: shown
   implicit none (type, external)
   private
   public :: check_output_name, check_output_path

   character(len=*), parameter :: suffix = '.h5'
   integer, parameter :: found_other = -1   !! result of another program of ehlwave

contains

   !> Refuse a name under which no file can be made, under which there is something else than a regular file, or a file
   !> that the run reads: those are never replaced. A file that is no result of the programs is replaced where
   !> overwriting is asked for, as is a damaged HDF5 file beside its store. Removes the temporary files of this file
   !> that dead processes have left.
   subroutine check_output_path(path, inputs, overwrites, error, format, has_store)
      character(len=*), intent(in) :: path
      character(len=*), intent(in) :: inputs(:)   !! files that the run reads; blank: none
      logical, intent(in) :: overwrites
      type(error_t), allocatable, intent(inout) :: error
      character(len=*), intent(in), optional :: format  !! format of the results that are replaced silently; absent: all
      logical, intent(in), optional :: has_store         !! whether the results are written anew from a store
      integer :: slash

      if (allocated(error)) return
      slash = index(path, '/', back=.true.)
      if (len_trim(path) == slash) then
         call raise(error, "cannot write '"//shown(path)//"': it names no file; give the name of one")
         return
      end if
      select case (file_kind(path))
      case (kind_none, kind_file)
         call refuse_inputs(path, inputs, error)
         call check_output_name(path, error)
         if (.not. overwrites) call refuse_foreign(path, format, has_store, error)
         if (allocated(error)) return
         call refuse_unwritable(path, error)
         call clear_temporaries(path(:slash)//'.', path(slash + 1:))
      case (kind_folder)
         call raise(error, 'cannot write '//path//': it is a folder; give the name of a file')
      case (kind_link)
         call raise(error, 'cannot write '//path//': it is a link; give the name of the file that it leads to')
      case default
         call raise(error, 'cannot write '//path//': it is not a regular file; give the name of one')
      end select
   end subroutine check_output_path

   !> Results are HDF5 and have that suffix, so that no two of them share a store.
   subroutine check_output_name(path, error)
      character(len=*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: error
      if (allocated(error)) return
      if (len(path) - index(path, '/', back=.true.) > len(suffix)) then
         if (path(len(path) - len(suffix) + 1:) == suffix) return
      end if
      call raise(error, 'cannot write '//path//': results are HDF5 files; give a name that ends in '//suffix// &
                 ' (ehlwave export makes CSV of them)')
   end subroutine check_output_name

   subroutine refuse_inputs(path, inputs, error)
      character(len=*), intent(in) :: path, inputs(:)
      type(error_t), allocatable, intent(inout) :: error
      integer :: i
      do i = 1, size(inputs)
         if (allocated(error) .or. inputs(i) == '') cycle
         if (is_same_file(path, trim(inputs(i)))) call raise(error, 'cannot write '//path// &
            ': it is the same file as '//trim(inputs(i))//', which the run reads; give another name')
      end do
   end subroutine refuse_inputs

   subroutine refuse_foreign(path, format, has_store, error)
      character(len=*), intent(in) :: path
      character(len=*), intent(in), optional :: format
      logical, intent(in), optional :: has_store
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: reason
      integer :: found

      if (allocated(error)) return
      if (file_kind(path) == kind_none) return
      call look_at_result(path, found, reason, format)
      if (found == found_foreign) found = merge(found_other, found_foreign, is_own_result(path))
      if (present(has_store)) found = merge(found_own, found, has_store .and. found == found_damaged)
      select case (found)
      case (found_unreadable)
         call raise(error, 'cannot write '//path//': it exists and cannot be opened now ('//reason// &
            '): make it readable, or give another name')
      case (found_damaged)
         call raise(error, 'cannot write '//path//': it is a damaged HDF5 file, or another program has it '// &
            'open for writing: close it there, move it away, or give another name')
      case (found_other)
         call raise(error, 'cannot write '//path//': it is a result of another program of ehlwave, of a sweep '// &
            'perhaps; give another name, or --overwrite')
      case (found_foreign)
         call raise(error, 'cannot write '//path//': it exists and is no result of ehlwave; move it away or give '// &
            'another name (--overwrite replaces it and, of a sweep, drops the store, too)')
      end select
   end subroutine refuse_foreign

   subroutine refuse_unwritable(path, error)
      character(len=*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: error
      integer :: status
      call try_file(path, status)
      if (status /= 0) call raise(error, 'cannot write '//path//': '//reason_text(status)// &
                                  '; does its folder exist and is it writable?')
   end subroutine refuse_unwritable

end module ehlwave_output_path
