!> Removes a store: only files with the names that runs give, never through a link.
module ehlwave_store_removal
   use ehlwave_errors, only: error_t, raise
   use ehlwave_paths, only: remove_folder, remove_within
   use ehlwave_posix, only: file_kind, is_temporary, kind_file, kind_folder, kind_none, list_folder, lock_file, &
      lock_refused, reason_text
   use ehlwave_store_folder, only: check_store, has_logs, refuse_links
   use ehlwave_store_names, only: files, folders, foreign_name, lock_name, part_name
   use ehlwave_text, only: next_line, shown
   implicit none (type, external)
   private
   public :: discard_store

contains

   !> Remove the files of a store, and its folders if nothing else is in them. Fails, before anything is removed, when
   !> it is in use, when a part is a link or no regular file, or when somebody has put a file into it.
   subroutine discard_store(folder, error)
      character(len=*), intent(in) :: folder
      type(error_t), allocatable, intent(inout) :: error
      logical :: is_there
      integer :: i, status

      if (allocated(error)) return
      call check_store(folder, is_there, error)
      if (allocated(error) .or. .not. is_there) return
      call refuse_links(folder, error)
      do i = 0, size(folders)
         call refuse_foreign(folder, part_name(i), error)
      end do
      if (allocated(error)) return
      is_there = has_logs(folder)
      if (file_kind(folder//'/store') == kind_none .and. .not. is_there) return   ! nothing marks it as a store
      call lock_file(folder//'/'//lock_name, status)
      if (status == lock_refused) then
         call raise(error, folder//' is in use by another job: it is not overwritten')
         return
      end if
      ! if interrupted at any point, the rest is still recognisable as a store
      do i = size(folders), 0, -1
         call remove_files(folder, part_name(i), error)
      end do
      do i = 1, size(files)
         call remove_within(folder, '', trim(files(i)), status)
         if (status /= 0 .and. .not. allocated(error)) &
            call raise(error, 'cannot remove '//folder//'/'//trim(files(i))//': '//reason_text(status))
      end do
      do i = size(folders), 0, -1
         ! a folder that is not empty stays
         if (.not. allocated(error)) call remove_folder(folder//'/'//part_name(i), status)
      end do
   end subroutine discard_store

   !> Fail when a part of a store holds files that no run has written.
   subroutine refuse_foreign(folder, part, error)
      character(len=*), intent(in) :: folder
      character(len=*), intent(in) :: part    !! a folder, or empty
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: foreign, names, path
      integer :: first, kind, last

      path = folder//'/'//part
      call list_folder(path, names)
      if (allocated(error) .or. .not. allocated(names)) return
      foreign = foreign_name(part, names)
      last = -1
      do while (next_line(names, first, last) .and. foreign == '')
         kind = file_kind(path//'/'//names(first:last))
         if (kind /= merge(kind_folder, kind_file, part == '' .and. any(folders == names(first:last)))) foreign = &
            names(first:last)
      end do
      if (foreign /= '') call raise(error, folder//merge('/', ' ', part /= '')//part//" holds '"//shown(foreign)// &
         "', which no sweep has put there: move it away; nothing has been removed")
   end subroutine refuse_foreign

   !> Remove the files of a folder of a store that have names of ours; of the store itself those that were under way.
   subroutine remove_files(folder, part, error)
      character(len=*), intent(in) :: folder
      character(len=*), intent(in) :: part    !! a folder, or empty
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: names
      integer :: first, last, status

      call list_folder(folder//'/'//part, names)
      if (allocated(error) .or. .not. allocated(names)) return
      last = -1
      do while (next_line(names, first, last))
         if (.not. is_temporary(names(first:last)) .and. part == '') cycle
         if (foreign_name(part, names(first:last)) /= '') cycle
         call remove_within(folder, part, names(first:last), status)
         if (status /= 0 .and. .not. allocated(error)) &
            call raise(error, 'cannot remove '//folder//'/'//part//'/'//names(first:last)//': '//reason_text(status))
      end do
   end subroutine remove_files

end module ehlwave_store_removal
