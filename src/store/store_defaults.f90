!> The defaults of keys that the cases of a store were begun with: in a file of its own, and in its records.
module ehlwave_store_defaults
   use ehlwave_errors, only: error_t, raise
   use ehlwave_json_reader, only: json_number, json_string, split_list
   use ehlwave_kinds, only: dp, i8
   use ehlwave_layout, only: layout_t, new_layout, values_t
   use ehlwave_posix, only: file_kind, kind_none, list_folder
   use ehlwave_record_reader, only: record_reader_t
   use ehlwave_store_folder, only: check_store, refuse_links, refuse_lost_records
   use ehlwave_store_names, only: defaults_name, defaults_text, newest_defaults, read_log_name, records_name
   use ehlwave_text, only: next_line, to_text
   use ehlwave_text_file, only: read_whole_file
   implicit none (type, external)
   private
   public :: read_origin

   integer, parameter, public :: not_said = -1

   !> Facts about the beginning of a store.
   type, public :: origin_t
      integer :: filed = not_said                  !! generation of the defaults in the file of that name
      integer :: recorded = not_said               !! generation from the head of the earliest log that has it
      character(len=:), allocatable :: input       !! effective input of a case of the earliest run that finished one
   contains
      procedure, private :: read_log
      procedure, private :: take_header
   end type origin_t

contains

   !> Read it. Fails where the folder is no store or has links for parts, where the file is damaged, and where the
   !> records are lost.
   subroutine read_origin(folder, origin, error)
      character(len=*), intent(in) :: folder
      type(origin_t), intent(out) :: origin
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: names
      integer :: first, last, next, now, rank, run
      logical :: is_there

      if (allocated(error)) return
      call check_store(folder, is_there, error)
      if (allocated(error) .or. .not. is_there) return
      call refuse_links(folder, error)
      if (.not. allocated(error)) call read_file(folder//'/'//defaults_name, origin%filed, error)
      call refuse_lost_records(folder, error)
      call list_folder(folder//'/'//records_name, names)
      if (.not. allocated(names)) return
      now = -1
      do while (.not. allocated(error))
         next = huge(next)                         ! the run after `now`
         last = -1
         do while (next_line(names, first, last))
            call read_log_name(names(first:last), run, rank)
            if (run > now) next = min(next, run)
         end do
         if (next == huge(next)) return
         now = next
         last = -1
         do while (next_line(names, first, last))
            call read_log_name(names(first:last), run, rank)
            if (run == now) call origin%read_log(folder//'/'//records_name//'/'//names(first:last), error)
            if (allocated(origin%input)) return
         end do
      end do
   end subroutine read_origin

   !> The generation in a file; the default where there is none.
   subroutine read_file(path, generation, error)
      character(len=*), intent(in) :: path
      integer, intent(inout) :: generation
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: reason, text
      integer :: io

      if (file_kind(path) == kind_none) return
      call read_whole_file(path, text, reason)
      if (.not. allocated(text)) then
         call raise(error, 'cannot read '//path//': '//reason)
         return
      end if
      read (text, *, iostat=io) generation
      if (io /= 0) generation = not_said
      if (text /= defaults_text(generation) .and. text /= '1'//new_line('a')) then
         call raise(error, path//' is damaged: remove it; the records of the store replace it')
      else if (generation > newest_defaults) then
         call raise(error, path//' is of a later version of the program ('//to_text(generation)//', this one reads '// &
                    to_text(newest_defaults)//'): use that, or name another results file')
      end if
   end subroutine read_file

   !> Take the entries of a log, up to its first input.
   subroutine read_log(self, path, error)
      class(origin_t), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: error
      type(record_reader_t) :: reader
      integer(i8) :: first, last
      integer :: bad_lines

      call reader%open(path, error)
      if (allocated(error)) return
      bad_lines = 0
      do
         call reader%next(first, last, bad_lines, error)
         if (last == 0) exit
         associate (record => reader%text(first:last))
            if (index(record, 'run ') == 1) call self%take_header(record(5:))
            if (index(record, 'input [') == 1) self%input = json_string(record(8:len(record) - 1))
         end associate
         if (allocated(self%input)) exit
      end do
      call reader%close()
   end subroutine read_log

   !> The generation in the head of a log, if none has been found.
   subroutine take_header(self, text)
      class(origin_t), intent(inout) :: self
      character(len=*), intent(in) :: text         !! [columns, values]
      type(layout_t) :: columns
      type(values_t) :: values
      character(len=:), allocatable :: number
      integer, allocatable :: first(:), last(:)
      logical :: fits

      if (self%recorded /= not_said) return
      call split_list(text, first, last)
      if (size(first) /= 2) return
      columns = new_layout(text(first(1):last(1)))
      call values%split(text(first(2):last(2)), columns, fits)
      if (.not. fits) return
      number = columns%element(values, defaults_name)
      if (number /= '') self%recorded = nint(max(-1.0_dp, min(1e6_dp, json_number(number))))
   end subroutine take_header

end module ehlwave_store_defaults
