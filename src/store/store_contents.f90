!> Content of a store: every valid record, read from the logs of all ranks of all runs.
module ehlwave_store_contents
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_errors, only: error_t, raise
   use ehlwave_identity_index, only: identity_index_t, identity_length
   use ehlwave_json_reader, only: json_number, json_string, split_list
   use ehlwave_kinds, only: dp, i8
   use ehlwave_layout, only: layout_t, new_layout, values_t
   use ehlwave_posix, only: file_kind, kind_none, list_folder, reason_text
   use ehlwave_provenance, only: git_revision, program_version
   use ehlwave_record_reader, only: record_reader_t
   use ehlwave_status, only: status_of_name, status_pending
   use ehlwave_store_folder, only: check_store
   use ehlwave_store_names, only: log_name, read_log_name, records_name
   use ehlwave_text, only: count_lines, next_line
   use ehlwave_text_difference, only: text_from_difference
   implicit none (type, external)
   private
   public :: add_layout, read_store

   character(len=*), parameter, public :: this_build = program_version//' '//git_revision

   !> The last record of a case.
   type, extends(values_t), public :: stored_case_t
      character(len=identity_length) :: identity = ''
      integer :: status = status_pending
      real(dp) :: seconds = 0
      integer :: layout = 0, log = 0, run = 0
   end type stored_case_t

   !> A log: its writer and its progress.
   type, public :: log_t
      integer :: run = 0, rank = 0
      type(values_t) :: header
      type(layout_t) :: columns                        !! columns of the header
      character(len=:), allocatable :: base_input      !! effective input that its cases differ from
      character(len=identity_length) :: in_flight = '' !! case that was begun, and neither done nor stopped
      logical :: is_by_this_build = .false.            !! version and revision
   contains
      procedure :: element => header_element
      procedure :: build
   end type log_t

   type, public :: contents_t
      type(layout_t), allocatable :: layouts(:)
      type(stored_case_t), allocatable :: cases(:)     !! cases(:count)
      type(log_t), allocatable :: logs(:)
      integer, private :: log_count = 0                ! while they are being read
      integer :: count = 0
      integer :: runs = 0                              !! number of the last run
      character(len=8) :: list_checksum = ''           !! checksum of the file `cases`, by the last run; blank: unknown
      integer :: bad_lines = 0                         !! passed over
      type(identity_index_t) :: index                  !! from identity to place in `cases`
   contains
      procedure :: value
      procedure :: input
      procedure :: deaths
   end type contents_t

   abstract interface
      !> Identity of a case from its effective input.
      function identity_of_input(input) result(identity)
         import :: identity_length
         implicit none (type, external)
         character(len=*), intent(in) :: input
         character(len=identity_length) :: identity
      end function identity_of_input
   end interface

contains

   !> Read a store; a missing store is empty. Fails when the folder is no store, or unreadable in part.
   subroutine read_store(folder, identify, contents, error, ranks_of_last_run)
      character(len=*), intent(in) :: folder
      procedure(identity_of_input) :: identify
      type(contents_t), intent(out) :: contents
      type(error_t), allocatable, intent(inout) :: error
      integer, intent(in), optional :: ranks_of_last_run   !! look for these logs by name, too: on network file
                                                           !! systems a new file may be late in the listing
      character(len=:), allocatable :: names, path
      logical :: is_there
      integer :: first, kind, last, rank, status

      if (.not. allocated(error)) call check_store(folder, is_there, error)
      path = folder//'/'//records_name
      if (.not. allocated(error)) call list_folder(path, names, status)
      if (.not. allocated(names)) then
         names = ''
         kind = file_kind(path)
         if (kind /= kind_none .and. .not. allocated(error)) call raise(error, 'cannot read '//path//': '// &
            reason_text(status))
      end if
      rank = 0
      if (present(ranks_of_last_run)) rank = ranks_of_last_run
      allocate (contents%layouts(0), contents%cases(64), contents%logs(count_lines(names) + rank))
      last = -1
      do while (next_line(names, first, last))
         call read_log(folder, names(first:last), identify, contents, error)
      end do
      do rank = 0, rank - 1
         if (index(names, log_name(contents%runs, rank)) > 0) cycle
         kind = file_kind(path//'/'//log_name(contents%runs, rank))
         if (kind /= kind_none) call read_log(folder, log_name(contents%runs, rank), identify, contents, error)
      end do
      contents%logs = contents%logs(:contents%log_count)
   end subroutine read_store

   !> Take the content of a log; files with names of another kind are skipped. Fails when it cannot be read.
   subroutine read_log(folder, name, identify, contents, error)
      character(len=*), intent(in) :: folder, name
      procedure(identity_of_input) :: identify
      type(contents_t), intent(inout) :: contents
      type(error_t), allocatable, intent(inout) :: error
      type(log_t) :: log
      type(record_reader_t) :: reader
      integer(i8) :: begins, ends
      integer :: layout

      call read_log_name(name, log%run, log%rank)
      if (log%run < 0) return
      call reader%open(folder//'/'//records_name//'/'//name, error)
      if (allocated(error)) return
      if (log%run > contents%runs) contents%list_checksum = ''
      contents%runs = max(contents%runs, log%run)
      contents%log_count = contents%log_count + 1
      log%columns = new_layout('[]')
      layout = 0
      do
         call reader%next(begins, ends, contents%bad_lines, error)
         if (ends == 0) exit
         call take_record(reader%text(begins:ends), identify, log, layout, contents)
      end do
      call reader%close()
      contents%logs(contents%log_count) = log
   end subroutine read_log

   !> Take a record of a log.
   subroutine take_record(record, identify, log, layout, contents)
      character(len=*), intent(in) :: record
      procedure(identity_of_input) :: identify
      type(log_t), intent(inout) :: log
      integer, intent(inout) :: layout                 !! number of the latest columns, 0: none yet
      type(contents_t), intent(inout) :: contents
      integer, allocatable :: first(:), last(:)
      integer :: blank
      logical :: fits

      blank = index(record, ' ')
      associate (value => record(blank + 1:))
         select case (record(:max(0, blank - 1)))
         case ('run')
            call split_list(value, first, last)
            if (size(first) /= 2) return
            log%columns = new_layout(value(first(1):last(1)))
            call log%header%split(value(first(2):last(2)), log%columns, fits)
            if (.not. fits) log%columns = new_layout('[]')
            log%is_by_this_build = log%build() == this_build
         case ('input')
            if (len(value) > 2) log%base_input = json_string(value(2:len(value) - 1))
         case ('list')
            if (log%run == contents%runs) contents%list_checksum = value
         case ('start')
            log%in_flight = value
         case ('stop')
            log%in_flight = ''
         case ('columns')
            call add_layout(value, contents, layout)
         case ('case')
            log%in_flight = ''
            call take_case(value, identify, log, layout, contents)
         end select
      end associate
   end subroutine take_record

   !> Keep the record of a case unless a later run has one. A record without columns, or with an identity other than
   !> its input's, counts as damaged.
   subroutine take_case(text, identify, log, layout, contents)
      character(len=*), intent(in) :: text
      procedure(identity_of_input) :: identify
      type(log_t), intent(in) :: log
      integer, intent(in) :: layout                    !! layout of records without a reference to one
      type(contents_t), intent(inout) :: contents
      type(stored_case_t) :: record
      type(stored_case_t), allocatable :: more(:)
      integer :: before, list_end, place
      logical :: fits

      list_end = index(text, ']', back=.true.)
      record%layout = layout
      if (list_end + 1 < len(text)) record%layout = findloc(contents%layouts%tag == text(list_end + 2:), .true., 1)
      fits = record%layout > 0
      if (fits) call record%split(text(:list_end), contents%layouts(record%layout), fits)
      if (fits) then
         record%run = log%run
         record%log = contents%log_count
         record%identity = json_string(contents%layouts(record%layout)%element(record, 'case_id'))
         fits = identify(input_of(record, log, contents)) == record%identity
      end if
      if (.not. fits) then
         contents%bad_lines = contents%bad_lines + 1
         return
      end if
      record%status = status_of_name(json_string(contents%layouts(record%layout)%element(record, 'status')))
      record%seconds = json_number(contents%layouts(record%layout)%element(record, 'seconds'))
      if (.not. ieee_is_finite(record%seconds)) record%seconds = 0

      before = contents%index%count
      call contents%index%add(record%identity, place)
      if (place > size(contents%cases)) then
         allocate (more(2*size(contents%cases)))
         more(:before) = contents%cases(:before)
         call move_alloc(more, contents%cases)
      end if
      contents%count = contents%index%count
      if (place <= before) then
         if (contents%cases(place)%run > log%run) return
      end if
      contents%cases(place) = record
   end subroutine take_case

   !> Number of a layout among the contents' layouts; a new layout is added.
   subroutine add_layout(text, contents, layout)
      character(len=*), intent(in) :: text
      type(contents_t), intent(inout) :: contents
      integer, intent(out) :: layout
      type(layout_t) :: new
      do layout = 1, size(contents%layouts)
         if (contents%layouts(layout)%text == text) return
      end do
      new = new_layout(text)   ! in a constructor gfortran 12 would never free it
      contents%layouts = [contents%layouts, new]
   end subroutine add_layout

   !> Value of the last record of a case as JSON; empty when it has no such value.
   pure function value(self, place, name) result(text)
      class(contents_t), intent(in) :: self
      integer, intent(in) :: place             !! in `cases`
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: text
      text = self%layouts(self%cases(place)%layout)%element(self%cases(place), name)
   end function value

   !> Effective input of a case as it was stored.
   function input(self, place) result(text)
      class(contents_t), intent(in) :: self
      integer, intent(in) :: place             !! in `cases`
      character(len=:), allocatable :: text
      text = input_of(self%cases(place), self%logs(self%cases(place)%log), self)
   end function input

   !> Effective input of a record, empty if unknown.
   function input_of(record, log, contents) result(text)
      class(stored_case_t), intent(in) :: record
      type(log_t), intent(in) :: log
      class(contents_t), intent(in) :: contents
      character(len=:), allocatable :: difference, text
      text = ''
      difference = contents%layouts(record%layout)%element(record, 'effective_input')
      if (difference /= '' .and. allocated(log%base_input)) &
         text = text_from_difference(log%base_input, json_string(difference))
   end function input_of

   !> Value of the header as JSON; empty when it has no such value.
   pure function header_element(self, name) result(text)
      class(log_t), intent(in) :: self
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: text
      text = self%columns%element(self%header, name)
   end function header_element

   !> Version and revision of the program that wrote a log.
   function build(self) result(text)
      class(log_t), intent(in) :: self
      character(len=:), allocatable :: text
      text = json_string(self%element('program_version'))//' '//json_string(self%element('git_revision'))
   end function build

   !> Number of runs in which the death of a single process happened in this case since its last completion.
   !>
   !> When a rank dies MPI ends the others, which note this in their logs first. If several logs lack the note (a
   !> lost node or mpirun), no case is blamed.
   integer function deaths(self, identity)
      class(contents_t), intent(in) :: self
      character(len=*), intent(in) :: identity
      integer :: k, place, since

      deaths = 0
      since = 0
      place = self%index%find(identity)
      if (place > 0) since = self%cases(place)%run
      do k = 1, size(self%logs)
         if (self%logs(k)%in_flight /= identity .or. self%logs(k)%run <= since) cycle
         if (count(self%logs%run == self%logs(k)%run .and. self%logs%in_flight /= '') == 1) deaths = deaths + 1
      end do
   end function deaths

end module ehlwave_store_contents
