!> Reads files of records (see ehlwave_record_file) piece by piece, whatever their length.
!>
!> Only lines whose checksum and length are right are accepted; remains of a kill, a full disk or a damaged byte are
!> skipped and counted.
module ehlwave_record_reader
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: i8
   use ehlwave_posix, only: checksum, close_file, find_character, open_file, read_bytes, reason_text
   implicit none (type, external)
   private
   public :: next_record

   integer(i8), parameter :: piece = 4*1024*1024_i8         !! bytes read at once
   integer(i8), parameter :: longest_line = 64*1024*1024_i8 !! a longer line is damaged

   !> A file being read. Record text(first:last) is good until the next call.
   type, public :: record_reader_t
      character(len=:), allocatable :: path
      character(len=:), allocatable :: text                 !! a piece of the file, from the beginning of a line on
      integer, private :: file = -1
      integer(i8), private :: position = 1                  ! in the text
      integer(i8), private :: whole = 0, filled = 0         ! bytes in the text: of lines that are complete, of all
      logical, private :: is_at_end = .false., skips_line = .false.
   contains
      procedure :: open => open_reader
      procedure :: next
      procedure :: close => close_reader
      procedure, private :: refill
   end type record_reader_t

contains

   !> Begin to read a file. Fails when it cannot be read.
   subroutine open_reader(self, path, error)
      class(record_reader_t), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: error
      integer(i8) :: bytes
      integer :: status
      if (allocated(error)) return
      self%path = path
      call open_file(path, self%file, bytes, status)
      if (status /= 0) call raise(error, 'cannot read '//path//': '//reason_text(status))
      if (status == 0) allocate (character(len=min(piece, bytes + 1)) :: self%text)
   end subroutine open_reader

   !> The next good record is text(first:last); no more: last = 0. Fails when the file cannot be read.
   subroutine next(self, first, last, bad_lines, error)
      class(record_reader_t), intent(inout) :: self
      integer(i8), intent(out) :: first, last
      integer, intent(inout) :: bad_lines                   !! lines passed over so far
      type(error_t), allocatable, intent(inout) :: error
      first = 1
      last = 0
      do while (.not. allocated(error))
         call next_record(self%text(:self%whole), self%position, first, last, bad_lines)
         if (last > 0 .or. self%is_at_end) return
         call self%refill(bad_lines, error)
      end do
   end subroutine next

   !> Read on, after the part of a line already read.
   subroutine refill(self, bad_lines, error)
      class(record_reader_t), intent(inout) :: self
      integer, intent(inout) :: bad_lines
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: more
      integer(i8) :: begun, length
      integer :: status

      begun = self%filled - self%whole
      if (begun >= longest_line .or. self%skips_line) begun = 0
      if (begun < self%filled - self%whole .and. .not. self%skips_line) bad_lines = bad_lines + 1
      self%skips_line = begun < self%filled - self%whole
      if (begun == len(self%text, i8)) then
         allocate (character(len=2*begun) :: more)
         more(:begun) = self%text
         call move_alloc(more, self%text)
      else if (begun > 0) then
         self%text(:begun) = self%text(self%whole + 1:self%filled)
      end if
      call read_bytes(self%file, self%text(begun + 1:), length, status)
      if (status /= 0) then
         call raise(error, 'cannot read '//self%path//': '//reason_text(status))
         return
      end if
      self%is_at_end = begun + length < len(self%text, i8)
      self%filled = begun + length
      self%position = 1
      if (self%skips_line) then
         self%position = find_character(self%text(:self%filled), new_line('a'), back=.false.) + 1
         self%skips_line = self%position == 1
      end if
      self%whole = find_character(self%text(:self%filled), new_line('a'), back=.true.)
      ! a last line without end counts as cut off
      if (self%is_at_end .and. .not. self%skips_line) self%whole = self%filled
   end subroutine refill

   subroutine close_reader(self)
      class(record_reader_t), intent(inout) :: self
      integer :: status
      if (self%file >= 0) status = close_file(self%file)
      self%file = -1
   end subroutine close_reader

   !> The next good record from `position` on is text(first:last); no more: last = 0.
   subroutine next_record(text, position, first, last, bad_lines)
      character(len=*), intent(in) :: text       !! complete lines, except perhaps the last
      integer(i8), intent(inout) :: position     !! begin with 1
      integer(i8), intent(out) :: first, last
      integer, intent(inout) :: bad_lines        !! lines passed over so far
      integer(i8) :: blank, length, line_end, start
      integer :: io

      do while (position <= len(text, i8))
         start = position
         line_end = find_character(text(start:), new_line('a'), back=.false.)
         if (line_end == 0) then                 ! cut off
            position = len(text, i8) + 1
            bad_lines = bad_lines + 1
            exit
         end if
         position = start + line_end
         last = start + line_end - 2
         if (last < start) cycle                 ! the end put after a torn line
         blank = index(text(min(start + 9, last):min(start + 29, last)), ' ', kind=i8)
         first = start + 9 + blank
         if (blank > 1 .and. first <= last + 1 .and. text(min(start + 8, last):min(start + 8, last)) == ' ') then
            io = verify(text(start + 9:first - 2), '0123456789')
            if (io == 0) read (text(start + 9:first - 2), *, iostat=io) length
            if (io == 0 .and. length <= last - first + 1) then
               if (checksum(text(first:first + length - 1)) == text(start:start + 7)) then
                  last = first + length - 1
                  if (last < position - 2) position = last + 2   ! its end is damaged: the rest is another line
                  return
               end if
            end if
         end if
         bad_lines = bad_lines + 1
      end do
      first = 1
      last = 0
   end subroutine next_record

end module ehlwave_record_reader
