!> The folder of a store: its place, a check that it is a store, the lock that keeps other jobs away.
module ehlwave_store_folder
   use, intrinsic :: iso_c_binding, only: c_long
   use ehlwave_errors, only: error_t, raise
   use ehlwave_paths, only: real_path
   use ehlwave_posix, only: clear_temporaries, file_kind, kind_link, kind_none, list_folder, lock_absent, lock_file, &
      lock_refused, lock_taken, make_folder, reason_text, replace_file
   use ehlwave_store_names, only: cases_name, defaults_name, defaults_text, files, folders, foreign_name, lock_name, &
      read_log_name, records_name
   use ehlwave_text, only: next_line, shown
   use ehlwave_text_file, only: read_whole_file
   implicit none (type, external)
   private
   public :: check_store, has_logs, refuse_inside_store, refuse_links, refuse_lost_records, take_folder

   character(len=*), parameter :: format_name = 'ehlwave-store', format_version = '1'

contains

   !> Whether this program can use a folder as a store; `is_there` returns whether there is anything.
   subroutine check_store(folder, is_there, error)
      character(len=*), intent(in) :: folder
      logical, intent(out) :: is_there
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: names, reason, text
      integer :: status

      call list_folder(folder, names, status)
      is_there = file_kind(folder) /= kind_none
      if (.not. is_there) return
      if (.not. allocated(names)) then
         call raise(error, folder//' is not a folder that can be read ('//reason_text(status)// &
            '): move it away, or name another results file')
         return
      end if
      text = ''
      if (file_kind(folder//'/store') /= kind_none) call read_whole_file(folder//'/store', text, reason)
      if (.not. allocated(text)) then
         call raise(error, 'cannot read '//folder//'/store: '//reason)
      else if (text == '') then
         ! a run that was killed right after making the folder, or a damaged disk, left it without its first line
         is_there = len(names) > 0
         if (.not. may_be_store(folder, names)) &
            call raise(error, folder//' is a folder but not the store of a sweep: move it away, or name another '// &
                       'results file')
      else if (text /= format_name//' '//format_version//new_line('a')) then
         call raise(error, folder//" has the format '"//shown(text(:index(text//new_line('a'), new_line('a')) - 1))// &
            "', this program reads and writes '"//format_name//' '//format_version// &
            "': use the program that made it, or name another results file")
      end if
   end subroutine check_store

   !> Whether a folder without the first line of a store can be a store: all its files are files of a store, and a list
   !> of cases comes with a log of a run.
   logical function may_be_store(folder, names)
      character(len=*), intent(in) :: folder, names
      character(len=:), allocatable :: foreign
      foreign = foreign_name('', names)
      may_be_store = file_kind(folder//'/'//cases_name) == kind_none
      if (.not. may_be_store) may_be_store = has_logs(folder)
      may_be_store = may_be_store .and. foreign == ''
   end function may_be_store

   !> Whether there is a log of a run in the folder of a store.
   logical function has_logs(folder)
      character(len=*), intent(in) :: folder
      character(len=:), allocatable :: names
      integer :: first, last, rank, run

      has_logs = .false.
      call list_folder(folder//'/'//records_name, names)
      if (.not. allocated(names)) return
      last = -1
      do while (next_line(names, first, last))
         call read_log_name(names(first:last), run, rank)
         has_logs = has_logs .or. run >= 0
      end do
   end function has_logs

   !> Refuse a name of results in a folder that belongs to a store, at whatever depth: foreign files make a store
   !> unusable.
   subroutine refuse_inside_store(path, error)
      character(len=*), intent(in) :: path       !! name of a file, which need not exist
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: folder
      integer :: slash

      if (allocated(error)) return
      slash = index(path, '/', back=.true.)
      folder = real_path(path(:slash)//'.')
      do while (index(folder, '/', back=.true.) > 1)
         if (is_store(folder)) then
            call raise(error, 'cannot write '//path//': '//folder// &
               ' is the store of a sweep; give a name in another folder')
            return
         end if
         folder = folder(:index(folder, '/', back=.true.) - 1)
      end do
   end subroutine refuse_inside_store

   !> Whether a folder claims to be a store, of any format, or has the name of a store and logs of runs.
   logical function is_store(folder)
      character(len=*), intent(in) :: folder
      character(len=:), allocatable :: text
      call read_whole_file(folder//'/store', text, most=int(len(format_name), c_long))
      is_store = .false.
      if (allocated(text)) is_store = text == format_name
      if (index(folder, '.store', back=.true.) == len(folder) - 5) is_store = has_logs(folder) .or. is_store
   end function is_store

   !> Refuse a store that lists cases and has no log of a run: every run opens its log before it lists its cases.
   subroutine refuse_lost_records(folder, error)
      character(len=*), intent(in) :: folder
      type(error_t), allocatable, intent(inout) :: error
      if (file_kind(folder//'/'//cases_name) == kind_none .or. allocated(error)) return
      if (has_logs(folder)) return
      call raise(error, folder//'/'//records_name//' has lost the records of all runs ('//cases_name// &
         ' lists the cases to run): put them back, or begin anew with --overwrite')
   end subroutine refuse_lost_records

   !> Refuse to use a store of which a part is a link: its target may belong to somebody else.
   subroutine refuse_links(folder, error)
      character(len=*), intent(in) :: folder
      type(error_t), allocatable, intent(inout) :: error
      character(len=len(folders)) :: parts(size(folders) + size(files))
      integer :: i

      if (allocated(error)) return
      if (file_kind(folder) == kind_link) then
         call raise(error, folder//' is a link: name the results file beside its target folder')
         return
      end if
      parts = [folders, files]
      do i = 1, size(parts)
         if (file_kind(folder//'/'//trim(parts(i))) /= kind_link) cycle
         call raise(error, folder//'/'//trim(parts(i))//' is a link, which no part of a store may be: put its '// &
            'target in its place, or name another results file')
         return
      end do
   end subroutine refuse_links

   !> Make or take over the folder of a store for this job, and lock it.
   !>
   !> Fails when the folder cannot be written, is something else, has links for parts, or when another job is at work on
   !> it.
   subroutine take_folder(folder, generation, warning, error)
      character(len=*), intent(in) :: folder
      integer, intent(in) :: generation         !! generation of the defaults of its cases
      character(len=:), allocatable, intent(out) :: warning   !! allocated: notice for the user
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: text
      logical :: is_there
      integer :: i, status

      if (allocated(error)) return
      call check_store(folder, is_there, error)
      if (is_there) call refuse_links(folder, error)
      if (allocated(error)) return
      call make_folder(folder, status)
      if (status == 0) call lock_file(folder//'/'//lock_name, status)
      select case (status)
      case (lock_taken)
      case (lock_refused)
         call raise(error, folder//' is in use by another job, which holds its lock: wait for its end, or name '// &
            'another results file')
      case (lock_absent)
         warning = 'the file system of '//folder//' has no locks: make sure that no other job uses it at the same time'
      case default
         call raise(error, 'cannot write '//folder//': does the folder above exist, is it writable, is the disk full?')
      end select
      do i = 1, size(folders)
         if (allocated(error)) return
         call make_folder(folder//'/'//trim(folders(i)), status)
         if (status /= 0) call raise(error, 'cannot write '//folder//'/'//trim(folders(i))//': '//reason_text(status))
         call clear_temporaries(folder//'/'//trim(folders(i)), '')
      end do
      call clear_temporaries(folder, '')
      if (allocated(error)) return
      call read_whole_file(folder//'/store', text)
      if (.not. allocated(text)) text = ''
      if (file_kind(folder//'/'//defaults_name) == kind_none .and. generation > 0) &
         call replace_file(folder//'/'//defaults_name, defaults_text(generation), status)
      if (text == '' .and. status == 0) &
         call replace_file(folder//'/store', format_name//' '//format_version//new_line('a'), status)
      if (status /= 0 .and. .not. allocated(error)) &
         call raise(error, 'cannot write '//folder//'/store: '//reason_text(status))
   end subroutine take_folder

end module ehlwave_store_folder
