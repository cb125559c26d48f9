!> Append-only files of records that survive a writer killed at any moment.
!>
!> A record is a line:  CHECKSUM LENGTH TEXT, the CRC-32 of the text in 8 hexadecimal digits and its length in
!> bytes. One call to the system appends it, and written records never change. Read by `ehlwave_record_reader`.
module ehlwave_record_file
   use ehlwave_clock, only: wall_seconds
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   use ehlwave_posix, only: append_text, checksum, close_file, create_file, reason_text, sync_file
   use ehlwave_process, only: set_note
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private

   real(dp), parameter :: sync_share = 0.02_dp   !! share of the time spent on disk synchronisation, at most

   !> Writer of a file. A killed process loses nothing that was appended; a power failure loses unsynchronised
   !> records. Synchronisation follows every record, unless records come so fast that it would take more than
   !> `sync_share` of the time.
   type, public :: record_writer_t
      character(len=:), allocatable :: path
      integer, private :: file = -1
      logical, private :: is_torn = .false.      ! the last line has no end
      logical, private :: is_behind = .false.    ! something is not yet synchronised
      real(dp), private :: synced_s = 0, sync_cost_s = 0
   contains
      procedure :: create
      procedure :: append
      procedure :: sync
      procedure :: announce
      procedure :: close => close_writer
   end type record_writer_t

contains

   !> Begin a file that must not exist.
   subroutine create(self, path, error)
      class(record_writer_t), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: error
      integer :: status
      if (allocated(error)) return
      call create_file(path, self%file, status)
      if (status /= 0) call raise(error, 'cannot write '//path//': '//reason_text(status))
      self%path = path
      self%synced_s = wall_seconds()
   end subroutine create

   !> Append a record. When this fails, the record is not there; the file stays good.
   subroutine append(self, text, error)
      class(record_writer_t), intent(inout) :: self
      character(len=*), intent(in) :: text
      type(error_t), allocatable, intent(inout) :: error
      integer :: status

      if (allocated(error)) return
      if (self%is_torn) then
         call append_text(self%file, new_line('a')//record_line(text), status)
      else
         call append_text(self%file, record_line(text), status)
      end if
      self%is_torn = status /= 0
      if (status == 0) then
         self%is_behind = .true.
         call self%sync(error)
      else
         call raise(error, 'cannot write '//self%path//': '//reason_text(status))
      end if
   end subroutine append

   !> Wait for the disk, if it is time to.
   subroutine sync(self, error, is_last)
      class(record_writer_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error
      logical, intent(in), optional :: is_last   !! true: in any case
      real(dp) :: now
      integer :: status

      if (.not. self%is_behind .or. allocated(error)) return
      now = wall_seconds()
      if (now - self%synced_s < self%sync_cost_s/sync_share .and. .not. present(is_last)) return
      status = sync_file(self%file)
      if (status /= 0) call raise(error, 'cannot write '//self%path//': '//reason_text(status))
      self%is_behind = .false.
      self%synced_s = wall_seconds()
      self%sync_cost_s = self%synced_s - now
   end subroutine sync

   !> Have a record appended at the moment in which a signal arrives; an empty text takes that back.
   subroutine announce(self, text)
      class(record_writer_t), intent(in) :: self
      character(len=*), intent(in) :: text
      if (len(text) == 0) then
         call set_note(self%file, '')
      else
         call set_note(self%file, record_line(text))
      end if
   end subroutine announce

   !> Close the file once everything is on the disk.
   subroutine close_writer(self, error)
      class(record_writer_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error
      integer :: status
      if (self%file < 0) return
      call self%sync(error, is_last=.true.)
      status = close_file(self%file)
      self%file = -1
      if (status /= 0 .and. .not. allocated(error)) &
         call raise(error, 'cannot write '//self%path//': '//reason_text(status))
   end subroutine close_writer

   function record_line(text) result(line)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: line
      line = checksum(text)//' '//to_text(len(text))//' '//text//new_line('a')
   end function record_line

end module ehlwave_record_file
