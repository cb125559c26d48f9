!> The folder of a store: where it is, whether it is one, the lock that keeps other jobs away.
module ehlwave_store_folder
   use ehlwave_errors, only: error_t, raise
   use ehlwave_posix, only: checksum, clear_temporaries, file_kind, kind_none, list_folder, lock_absent, lock_file, &
      lock_refused, lock_taken, make_folder, reason_text, remove_file, replace_file
   use ehlwave_text, only: next_line, shown, to_text
   use ehlwave_text_file, only: read_whole_file
   implicit none (type, external)
   private
   public :: check_store, defaults_of_store, discard_store, log_name, read_log_name, store_path, take_folder

   character(len=*), parameter :: format_name = 'ehlwave-store', format_version = '1'
   character(len=*), parameter, public :: cases_name = 'cases', lock_name = 'lock', records_name = 'records'
   character(len=*), parameter :: defaults_name = 'defaults'
   integer, parameter :: most_digits = 9   !! of a run or a rank

   !> Of the defaults of keys, raised by one when a default changes. Stores without a file of that name are of generation 0.
   integer, parameter, public :: newest_defaults = 1
   character(len=*), parameter :: folders(3) = [character(len=11) :: records_name, 'checkpoints', 'fields']

contains

   !> Folder of the store of a results file: results.h5 has results.store. A store is its own.
   pure function store_path(output) result(path)
      character(len=*), intent(in) :: output
      character(len=:), allocatable :: path
      integer :: n
      n = len_trim(output)
      path = output(:n)
      if (n > 1 .and. output(n:n) == '/') path = output(:n - 1)
      n = len(path)
      if (n > 6) then
         if (path(n - 5:) == '.store') return
      end if
      if (n > 3) then
         if (path(n - 2:) == '.h5') path = path(:n - 3)
      end if
      path = path//'.store'
   end function store_path

   !> Name of the log of a rank in a run: six digits each, more where it takes them.
   pure function log_name(run, rank) result(name)
      integer, intent(in) :: run, rank
      character(len=:), allocatable :: name
      character(len=32) :: buffer
      write (buffer, '(i0.6,a,i0.6,a)') run, '-', rank, '.log'
      name = trim(buffer)
   end function log_name

   !> Run and rank of the log of a name; -1 where it is not the name of a log.
   pure subroutine read_log_name(name, run, rank)
      character(len=*), intent(in) :: name
      integer, intent(out) :: run, rank
      integer :: dash, io, point

      run = -1
      rank = -1
      dash = index(name, '-')
      point = index(name, '.log')
      if (dash < 2 .or. dash > most_digits + 1 .or. point < dash + 2 .or. point > dash + most_digits + 1) return
      if (point + 3 /= len(name) .or. verify(name(:dash - 1)//name(dash + 1:point - 1), '0123456789') > 0) return
      read (name(:dash - 1), *, iostat=io) run
      read (name(dash + 1:point - 1), *, iostat=io) rank
   end subroutine read_log_name

   !> Whether a folder is a store that this program understands; `is_there` tells whether there is anything.
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
         call raise(error, folder//' is not a folder that can be read ('//reason_text(status)//'): move it away, or name '// &
                    'another results file')
         return
      end if
      text = ''
      if (file_kind(folder//'/store') /= kind_none) call read_whole_file(folder//'/store', text, reason)
      if (.not. allocated(text)) then
         call raise(error, 'cannot read '//folder//'/store: '//reason)
      else if (text == '') then
         ! a run that was killed right after making the folder, or a damaged disk, left it without its first line
         is_there = len(names) > 0
         if (.not. has_known_names(names)) &
            call raise(error, folder//' is a folder but not the store of a sweep: move it away, or name another '// &
                       'results file')
      else if (text /= format_name//' '//format_version//new_line('a')) then
         call raise(error, folder//" has the format '"//shown(text(:index(text//new_line('a'), new_line('a')) - 1))// &
            "', this program reads and writes '"//format_name//' '//format_version// &
            "': use the program that made it, or name another results file")
      end if
      if (allocated(error)) return
      if (file_kind(folder//'/'//defaults_name) == kind_none) return
      call read_whole_file(folder//'/'//defaults_name, text)
      if (.not. allocated(text)) text = ''
      if (text /= defaults_text(defaults_of_store(folder)) .and. text /= '1'//new_line('a')) &
         call raise(error, folder//'/'//defaults_name//' is damaged: name another results file, or, if this version has begun '// &
                    "the store, write '"//to_text(newest_defaults)//' '//checksum(to_text(newest_defaults))//"' into it")
   end subroutine check_store

   !> Generation of the defaults that a store was begun with: its cases go on with them. A store that is still to be made will have
   !> the newest. Fails when the store says it and that cannot be read: other defaults are other results.
   integer function defaults_of_store(folder, error) result(generation)
      character(len=*), intent(in) :: folder
      type(error_t), allocatable, intent(inout), optional :: error
      character(len=:), allocatable :: reason, text
      integer :: io

      if (file_kind(folder//'/'//defaults_name) /= kind_none) then
         call read_whole_file(folder//'/'//defaults_name, text, reason)
         io = 0
         if (allocated(text)) read (text, *, iostat=io) generation
         if (allocated(text) .and. io == 0) return
         if (present(error)) then
            if (.not. allocated(error)) call raise(error, 'cannot read '//folder//'/'//defaults_name//': '//reason)
         end if
      end if
      generation = newest_defaults
      if (file_kind(folder//'/store') /= kind_none) generation = 0
      call list_folder(folder//'/'//records_name, text)   ! the line `store` can have been lost
      if (.not. allocated(text)) return
      if (len(text) > 0) generation = 0
   end function defaults_of_store

   !> What the file with the generation of the defaults holds: the number and its checksum.
   function defaults_text(generation) result(text)
      integer, intent(in) :: generation
      character(len=:), allocatable :: text
      text = to_text(generation)//' '//checksum(to_text(generation))//new_line('a')
   end function defaults_text

   !> Whether a folder holds nothing but what a store has.
   logical function has_known_names(names)
      character(len=*), intent(in) :: names   !! one a line
      integer :: first, last
      has_known_names = .true.
      last = -1
      do while (next_line(names, first, last))
         associate (name => names(first:last))
            has_known_names = has_known_names .and. (any(folders == name) .or. name == lock_name .or. name == cases_name .or. &
                                                     name == defaults_name .or. name == 'store' .or. index(name, '.part') > 0)
         end associate
      end do
   end function has_known_names

   !> Make or take over the folder of a store for this job, and lock it.
   !>
   !> Fails when the folder cannot be written, is something else, or when another job is at work on it.
   subroutine take_folder(folder, warning, error)
      character(len=*), intent(in) :: folder
      character(len=:), allocatable, intent(out) :: warning   !! allocated: what the user should know
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: text
      logical :: is_there
      integer :: generation, i, status

      if (allocated(error)) return
      call check_store(folder, is_there, error)
      if (allocated(error)) return
      generation = defaults_of_store(folder)
      call make_folder(folder, status)
      if (status == 0) call lock_file(folder//'/'//lock_name, status)
      select case (status)
      case (lock_taken)
      case (lock_refused)
         call raise(error, folder//' is in use by another job, which holds its lock: wait for its end, or name another '// &
                    'results file')
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
      if (text == '' .and. generation > 0) call replace_file(folder//'/'//defaults_name, defaults_text(generation), status)
      if (text == '' .and. status == 0) &
         call replace_file(folder//'/store', format_name//' '//format_version//new_line('a'), status)
      if (status /= 0 .and. .not. allocated(error)) &
         call raise(error, 'cannot write '//folder//'/store: '//reason_text(status))
   end subroutine take_folder

   !> Remove a store and all that is in it. Fails when it is in use, or cannot be removed.
   subroutine discard_store(folder, error)
      character(len=*), intent(in) :: folder
      type(error_t), allocatable, intent(inout) :: error
      logical :: is_there
      integer :: i, status

      if (allocated(error)) return
      call check_store(folder, is_there, error)
      if (allocated(error) .or. .not. is_there) return
      call lock_file(folder//'/'//lock_name, status)
      if (status == lock_refused) then
         call raise(error, folder//' is in use by another job: it is not overwritten')
         return
      end if
      do i = 1, size(folders)
         call remove_folder(folder//'/'//trim(folders(i)), error)
      end do
      call remove_folder(folder, error)
   end subroutine discard_store

   !> Remove a folder of files.
   subroutine remove_folder(path, error)
      character(len=*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: names
      integer :: first, last, status

      call list_folder(path, names)
      if (allocated(error) .or. .not. allocated(names)) return
      last = -1
      do while (next_line(names, first, last))
         call remove_file(path//'/'//names(first:last), status)
      end do
      call remove_file(path, status)
      if (status /= 0) call raise(error, 'cannot remove '//path//': '//reason_text(status))
   end subroutine remove_folder

end module ehlwave_store_folder
