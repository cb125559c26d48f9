!> Checkpoint of a time march: a march that goes on from it ends with the same numbers, bit for bit.
module ehlwave_checkpoint_file
   use, intrinsic :: iso_fortran_env, only: error_unit
   use ehlwave_byte_stream, only: bytes_t
   use ehlwave_clock, only: wall_seconds
   use ehlwave_kinds, only: dp
   use ehlwave_march_keeper, only: kept_march_t, march_keeper_t
   use ehlwave_posix, only: checksum, reason_text, remove_file, replace_file
   use ehlwave_provenance, only: compiler, compiler_flags, git_revision, program_version
   use ehlwave_terminal, only: say
   use ehlwave_text_file, only: read_whole_file
   implicit none (type, external)
   private

   character(len=*), parameter :: format_line = 'ehlwave-checkpoint 9 '//program_version//' '//git_revision//' '// &
      compiler//' '//compiler_flags

   !> Where the checkpoint of one case is kept, and when. The file is replaced as a whole and carries a checksum; a
   !> checkpoint is not used if torn, or from another case, other input files, or another build.
   type, extends(march_keeper_t), public :: checkpoint_t
      character(len=:), allocatable :: path
      character(len=:), allocatable :: identity !! identity of the case and the content of its files
      real(dp) :: interval_s = 600              !! between two files while the case runs
      real(dp) :: start_s = 0                   !! wall_seconds at the start of the case in this run
      logical, private :: is_kept = .false.     ! `kept` is newer than the file
      character(len=:), allocatable, private :: kept   ! bytes of the last remembered march
      real(dp), private :: saved_s = 0
   contains
      procedure :: load
      procedure :: keep
      procedure :: save => save_kept
      procedure :: discard
   end type checkpoint_t

contains

   !> Take up a march that has just begun where an earlier run left it; without a good file it stays as it is.
   subroutine load(self, march)
      class(checkpoint_t), intent(inout) :: self
      class(kept_march_t), intent(inout) :: march
      character(len=:), allocatable :: text
      type(bytes_t) :: expected, found

      self%saved_s = wall_seconds()
      call read_whole_file(self%path, text)
      if (.not. allocated(text)) return
      if (len(text) < len(heading(self)) + 8) return
      if (text(:len(heading(self))) /= heading(self)) return
      if (checksum(text(:len(text) - 8)) /= text(len(text) - 7:)) return
      call expected%numbers(self%seconds_before)
      call march%pass(expected)
      if (len(text) - 8 /= len(heading(self)) + len(expected%text)) return
      found = bytes_t(text, len(heading(self)), is_reading=.true.)
      call found%numbers(self%seconds_before)
      call march%pass(found)
   end subroutine load

   !> Remember a march; from time to time also in the file.
   subroutine keep(self, march)
      class(checkpoint_t), intent(inout) :: self
      class(kept_march_t), intent(inout) :: march
      type(bytes_t) :: bytes
      call march%pass(bytes)
      call move_alloc(bytes%text, self%kept)
      self%is_kept = .true.
      if (wall_seconds() - self%saved_s >= self%interval_s) call self%save()
   end subroutine keep

   !> Write the last remembered state. A checkpoint that cannot be written is reported and costs only time.
   subroutine save_kept(self)
      class(checkpoint_t), intent(inout) :: self
      type(bytes_t) :: bytes
      real(dp) :: seconds
      character(len=:), allocatable :: text
      integer :: status

      self%saved_s = wall_seconds()
      if (.not. self%is_kept) return
      seconds = self%seconds_before + self%saved_s - self%start_s
      call bytes%numbers(seconds)
      text = heading(self)//bytes%text//self%kept
      call replace_file(self%path, text//checksum(text), status)
      self%is_kept = status /= 0
      if (status /= 0) call say(error_unit, 'checkpoint '//self%path//' not written: '//reason_text(status))
   end subroutine save_kept

   !> Remove the file of a case that is done.
   subroutine discard(self)
      class(checkpoint_t), intent(inout) :: self
      integer :: status
      call remove_file(self%path, status)
   end subroutine discard

   function heading(self) result(text)
      class(checkpoint_t), intent(in) :: self
      character(len=:), allocatable :: text
      text = format_line//new_line('a')//self%identity//new_line('a')
   end function heading

end module ehlwave_checkpoint_file
