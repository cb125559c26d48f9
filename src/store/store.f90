!> The store of a sweep: a folder with every finished case, written so that nothing that ends a job can spoil it.
!>
!>     store                     one line: format and its version
!>     defaults                  generation of the defaults of keys that its cases have; absent: from the records lock
!>                          locked by the job at work cases                     identity and expected cost of each
!>     case of the sweep records/RUN-RANK.log      log of each rank of each run of the program; see
!>     ehlwave_record_file checkpoints/IDENTITY      marches under way fields/IDENTITY.h5        fields of a case, if
!>     the input asks for them
!>
!> A rank appends to files of its own only. Records are, in this order in each file,
!>
!>     run [columns, values]     the writer: program, build, host, rank, time list CHECKSUM             the file
!>     `cases` is complete; of rank 0 input TEXT                effective input of the first case of the file; the
!>     others list differences start IDENTITY            a case begins stop IDENTITY             it was stopped from
!>     outside columns [[name, kind],...]  of the cases that follow, again whenever they change case [values]
!>     CHECKSUM    it is finished, with any status; the checksum covers the text of its columns
!>
!> Items that many records depend on (run, input, columns) are repeated after the first case: a damaged line costs
!> at most one case.
module ehlwave_store
   use ehlwave_clock, only: time_stamp
   use ehlwave_errors, only: error_t, raise
   use ehlwave_json, only: string_json
   use ehlwave_posix, only: checksum, list_folder, reason_text
   use ehlwave_process, only: process_id
   use ehlwave_provenance_list, only: add_provenance
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_quantity_output, only: json_columns, json_values
   use ehlwave_record_file, only: record_writer_t
   use ehlwave_store_folder, only: take_folder
   use ehlwave_store_names, only: log_name, newest_defaults, read_log_name, records_name
   use ehlwave_text, only: next_line
   use ehlwave_text_difference, only: text_difference
   implicit none (type, external)
   private
   public :: prepare_store

   !> Part of the store written by a rank.
   type, public :: store_t
      character(len=:), allocatable :: folder
      character(len=256) :: host = '', job = '', mpi_library = ''
      integer :: run = 0                   !! number of this run of the program on the store
      integer :: rank = 0
      integer :: defaults = newest_defaults   !! generation of the defaults of keys that its cases have
      type(record_writer_t), private :: log
      logical, private :: is_open = .false.
      character(len=:), allocatable, private :: columns, base_input
      character(len=8), private :: tag = ''    ! checksum of the columns
      type(quantity_list_t), private :: last   ! record that has the columns
   contains
      procedure :: header
      procedure :: note_list
      procedure :: start
      procedure :: stop => stop_case
      procedure :: keep
      procedure :: sync
      procedure :: close => close_store
      procedure :: checkpoint_path
      procedure :: fields_path
      procedure :: open_log
      procedure, private :: write_header
   end type store_t

contains

   !> Make or take over a store for this job and give the run the next free number; the open log of rank 0 reserves it.
   !> Called on rank 0 only. Fails as `take_folder`.
   subroutine prepare_store(folder, store, warning, error)
      character(len=*), intent(in) :: folder
      type(store_t), intent(inout) :: store              !! rank, host, job, MPI library, defaults are set
      character(len=:), allocatable, intent(out) :: warning   !! allocated: notice for the user
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: names
      integer :: first, last, number, rank, status

      call take_folder(folder, store%defaults, warning, error)
      if (allocated(error)) return
      store%folder = folder
      call list_folder(folder//'/'//records_name, names, status)
      if (status /= 0) call raise(error, 'cannot read '//folder//'/'//records_name//': '//reason_text(status))
      if (allocated(error)) return
      store%run = 1
      last = -1
      do while (next_line(names, first, last))
         call read_log_name(names(first:last), number, rank)
         store%run = max(store%run, number + 1)
      end do
   end subroutine prepare_store

   !> Begin the log of this rank, unless it has been begun.
   subroutine open_log(self, error)
      class(store_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error

      if (self%is_open .or. allocated(error)) return
      call self%log%create(self%folder//'/'//records_name//'/'//log_name(self%run, self%rank), error)
      call self%write_header(error)
      self%is_open = .not. allocated(error)
      self%last%count = 0                        ! each log names its columns
   end subroutine open_log

   subroutine write_header(self, error)
      class(store_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error
      type(quantity_list_t) :: header
      header = self%header()
      call self%log%append('run ['//json_columns(header)//','//json_values(header)//']', error)
   end subroutine write_header

   !> Identity of the writer: head of each rank's log.
   function header(self) result(list)
      class(store_t), intent(in) :: self
      type(quantity_list_t) :: list
      call list%add('run', 'run of the program, counted from 1 in its store; -1: not run', self%run)
      call list%add('rank', 'MPI rank', self%rank)
      call list%add('host', 'machine', trim(self%host))
      call list%add('job', 'batch job the case ran in', trim(self%job))
      call list%add('process', 'number of the process', process_id())
      call list%add('opened', 'local time', time_stamp())
      call list%add('defaults', 'generation of the defaults of keys', self%defaults)
      call add_provenance(list)
      call list%add('mpi_library', 'MPI library, as it names itself', trim(self%mpi_library))
   end function header

   !> The file `cases` has been written: a copy of which bytes are lost is known by its checksum.
   subroutine note_list(self, list_checksum, error)
      class(store_t), intent(inout) :: self
      character(len=*), intent(in) :: list_checksum
      type(error_t), allocatable, intent(inout) :: error
      call self%open_log(error)
      call self%log%append('list '//list_checksum, error)
   end subroutine note_list

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
      type(quantity_list_t), intent(inout) :: record   !! result of the case; the effective input is added
      character(len=*), intent(in) :: input      !! effective input
      type(error_t), allocatable, intent(inout) :: error
      logical :: is_first

      call self%open_log(error)
      if (allocated(error)) return
      is_first = .not. allocated(self%base_input)
      if (is_first) call self%log%append('input ['//string_json(input)//']', error)
      if (allocated(error)) return
      if (is_first) self%base_input = input
      call record%add('effective_input', 'how the effective input differs', text_difference(self%base_input, input))
      if (.not. record%is_like(self%last)) then
         self%columns = json_columns(record)
         self%tag = checksum(self%columns)
         call self%log%append('columns '//self%columns, error)
         if (.not. allocated(error)) self%last = record
      end if
      call self%log%append('case '//json_values(record)//' '//self%tag, error)
      call self%log%announce('')
      if (.not. is_first) return
      if (.not. allocated(error)) call self%write_header(error)
      call self%log%append('input ['//string_json(input)//']', error)
      call self%log%append('columns '//self%columns, error)
   end subroutine keep

   !> Synchronise the log with the disk, at most for a small share of the time.
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

end module ehlwave_store
