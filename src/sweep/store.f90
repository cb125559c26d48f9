!> The store of a sweep: a folder with everything that is known for sure, written so that nothing can spoil it.
!>
!>     store                     one line: format and its version
!>     lock                      locked by the job at work
!>     cases                     identity and expected cost of each case of the sweep
!>     records/RUN-RANK.log      what each rank of each run (of the program) has done; see ehlwave_record_file
!>     checkpoints/IDENTITY      marches under way
!>     fields/IDENTITY.h5        fields of a case, when they are asked for
!>
!> A rank appends to files of its own only. Records are, in this order in each file,
!>
!>     run [columns, values]     who writes: program, build, host, rank, time
!>     input TEXT                effective input of the first case of the file; the others tell what differs
!>     start IDENTITY            a case begins
!>     stop IDENTITY             it was stopped from outside
!>     columns [[name, kind],...]  of the cases that follow, again whenever they change
!>     case [values]             it is done, whatever its status
module ehlwave_store
   use ehlwave_clock, only: time_stamp
   use ehlwave_errors, only: error_t, raise
   use ehlwave_identity_index, only: identity_length
   use ehlwave_json, only: json_t
   use ehlwave_posix, only: create_file, close_file, list_folder, lock_absent, lock_file, lock_refused, lock_taken, &
      make_folder, process_id, reason_text, remove_file, replace_file
   use ehlwave_provenance, only: compiler, compiler_flags, git_revision, library_versions, program_version
   use ehlwave_record_file, only: read_whole_file, record_writer_t
   use ehlwave_text, only: to_text
   use ehlwave_text_difference, only: text_difference
   implicit none (type, external)
   private
   public :: check_store, discard_store, log_name, prepare_store, store_path

   character(len=*), parameter :: format_name = 'ehlwave-store', format_version = '1'
   character(len=*), parameter, public :: cases_name = 'cases', lock_name = 'lock', records_name = 'records'
   character(len=*), parameter :: folders(3) = [character(len=11) :: records_name, 'checkpoints', 'fields']

   !> What one rank writes to the store.
   type, public :: store_t
      character(len=:), allocatable :: folder
      character(len=:), allocatable :: host, job, mpi_library
      integer :: run = 0                   !! number of this run of the program on the store
      integer :: rank = 0
      type(record_writer_t), private :: log
      logical, private :: is_open = .false.
      character(len=:), allocatable, private :: columns, base_input
   contains
      procedure :: start
      procedure :: stop => stop_case
      procedure :: keep
      procedure :: sync
      procedure :: close => close_store
      procedure :: checkpoint_path
      procedure :: fields_path
      procedure, private :: open_log
   end type store_t

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

   !> Whether a folder is a store that this program understands; `is_there` tells whether there is anything.
   subroutine check_store(folder, is_there, error)
      character(len=*), intent(in) :: folder
      logical, intent(out) :: is_there
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: names, text

      call list_folder(folder, names)
      is_there = allocated(names)
      if (.not. is_there) then
         inquire (file=folder, exist=is_there)
         if (is_there) call raise(error, folder//' is not a folder: move it away, or name another results file')
         return
      end if
      call read_whole_file(folder//'/store', text)
      if (.not. allocated(text)) then
         ! a run that was killed right after making the folder left it empty
         is_there = len(names) > 0
         if (is_there .and. index(names, 'store') == 0 .and. names /= records_name//new_line('a')) &
            call raise(error, folder//' is a folder but not the store of a sweep: move it away, or name another '// &
                       'results file')
         return
      end if
      if (text /= format_name//' '//format_version//new_line('a')) call raise(error, folder//" has the format '"// &
         first_line(text)//"', this program reads and writes '"//format_name//' '//format_version// &
         "': use the program that made it, or name another results file")
   end subroutine check_store

   pure function first_line(text) result(line)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: line
      line = text(:index(text//new_line('a'), new_line('a')) - 1)
      if (len(line) > 60) line = line(:60)
   end function first_line

   !> Make or take over a store for this job: lock it and give the run its number. Called on rank 0 only.
   !>
   !> Fails when the folder cannot be written, is something else, or when another job is at work on it.
   subroutine prepare_store(folder, store, warning, error)
      character(len=*), intent(in) :: folder
      type(store_t), intent(inout) :: store              !! rank, host, job and MPI library are set
      character(len=:), allocatable, intent(out) :: warning   !! allocated: what the user should know
      type(error_t), allocatable, intent(inout) :: error
      logical :: is_there
      integer :: i, status

      if (allocated(error)) return
      call check_store(folder, is_there, error)
      if (allocated(error)) return
      store%folder = folder
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
      end do
      inquire (file=folder//'/store', exist=is_there)
      if (.not. is_there) call replace_file(folder//'/store', format_name//' '//format_version//new_line('a'), status)
      if (status /= 0 .and. .not. allocated(error)) &
         call raise(error, 'cannot write '//folder//'/store: '//reason_text(status))
      if (.not. allocated(error)) call claim_run(store, error)
   end subroutine prepare_store

   !> The next free number for this run; the log of rank 0 stands for it.
   subroutine claim_run(store, error)
      type(store_t), intent(inout) :: store
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: names
      integer :: i, io, last, number

      call list_folder(store%folder//'/'//records_name, names)
      last = 0
      i = 1
      do while (i <= len(names))
         read (names(i:i + index(names(i:), '-') - 2), *, iostat=io) number
         if (io == 0) last = max(last, number)
         i = i + index(names(i:), new_line('a'))
      end do
      store%run = last + 1
      call store%open_log(error)
   end subroutine claim_run

   !> Name of the log of a rank in a run.
   pure function log_name(run, rank) result(name)
      integer, intent(in) :: run, rank
      character(len=17) :: name
      write (name, '(i6.6,a,i6.6,a)') run, '-', rank, '.log'
   end function log_name

   subroutine open_log(self, error)
      class(store_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error
      type(json_t) :: json

      if (self%is_open .or. allocated(error)) return
      call self%log%create(self%folder//'/'//records_name//'/'//log_name(self%run, self%rank), error)
      call json%add('run', self%run)
      call json%add('rank', self%rank)
      call json%add('host', self%host)
      call json%add('job', self%job)
      call json%add('process', process_id())
      call json%add('opened', time_stamp())
      call json%add('program_version', program_version)
      call json%add('git_revision', git_revision)
      call json%add('compiler', compiler)
      call json%add('compiler_flags', compiler_flags)
      call json%add('library_versions', library_versions)
      call json%add('mpi_library', self%mpi_library)
      call self%log%append('run ['//json%column_list()//','//json%value_list()//']', error)
      self%is_open = .not. allocated(error)
      self%columns = ''
   end subroutine open_log

   !> A case begins. Until it is done or stopped, a death of this process counts against it.
   subroutine start(self, identity, error)
      class(store_t), intent(inout) :: self
      character(len=*), intent(in) :: identity
      type(error_t), allocatable, intent(inout) :: error
      call self%open_log(error)
      call self%log%append('start '//identity, error)
      if (.not. allocated(error)) call self%log%announce('stop '//identity)
   end subroutine start

   !> A case was stopped from outside and is to be continued.
   subroutine stop_case(self, identity, error)
      class(store_t), intent(inout) :: self
      character(len=*), intent(in) :: identity
      type(error_t), allocatable, intent(inout) :: error
      call self%log%announce('')
      call self%log%append('stop '//identity, error)
   end subroutine stop_case

   !> A case is done. Fails when that could not be stored; then it counts as not run.
   subroutine keep(self, record, input, error)
      class(store_t), intent(inout) :: self
      type(json_t), intent(inout) :: record      !! what it came to; the effective input is added
      character(len=*), intent(in) :: input      !! effective input
      type(error_t), allocatable, intent(inout) :: error
      type(json_t) :: base

      call self%open_log(error)
      if (allocated(error)) return
      if (.not. allocated(self%base_input)) then
         call base%add('input', input)
         call self%log%append('input '//base%value_list(), error)
         if (.not. allocated(error)) self%base_input = input
      end if
      if (allocated(error)) return
      call record%add('effective_input', text_difference(self%base_input, input))
      if (record%column_list() /= self%columns) then
         call self%log%append('columns '//record%column_list(), error)
         if (.not. allocated(error)) self%columns = record%column_list()
      end if
      call self%log%append('case '//record%value_list(), error)
      call self%log%announce('')
   end subroutine keep

   !> Wait for the disk if it is time to.
   subroutine sync(self, error)
      class(store_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error
      if (self%is_open) call self%log%sync(error)
   end subroutine sync

   !> Everything is on the disk afterwards, or there is an error.
   subroutine close_store(self, error)
      class(store_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error
      if (self%is_open) call self%log%close(error)
      self%is_open = .false.
   end subroutine close_store

   pure function checkpoint_path(self, identity) result(path)
      class(store_t), intent(in) :: self
      character(len=*), intent(in) :: identity
      character(len=:), allocatable :: path
      path = self%folder//'/checkpoints/'//identity
   end function checkpoint_path

   pure function fields_path(self, identity) result(path)
      class(store_t), intent(in) :: self
      character(len=*), intent(in) :: identity
      character(len=:), allocatable :: path
      path = self%folder//'/fields/'//identity//'.h5'
   end function fields_path

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
      integer :: i, n, status

      call list_folder(path, names)
      if (allocated(error) .or. .not. allocated(names)) return
      i = 1
      do while (i <= len(names))
         n = index(names(i:), new_line('a'))
         call remove_file(path//'/'//names(i:i + n - 2), status)
         i = i + n
      end do
      call remove_file(path, status)
      if (status /= 0) call raise(error, 'cannot remove '//path//': '//reason_text(status))
   end subroutine remove_folder

end module ehlwave_store
