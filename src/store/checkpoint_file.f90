!> Checkpoint of a time march: a march that goes on from it ends with the same numbers, bit for bit.
module ehlwave_checkpoint_file
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_loc
   use, intrinsic :: iso_fortran_env, only: error_unit
   use ehlwave_clock, only: wall_seconds
   use ehlwave_energy, only: energy_t
   use ehlwave_kinds, only: dp
   use ehlwave_march_keeper, only: march_keeper_t
   use ehlwave_posix, only: checksum, reason_text, remove_file, replace_file
   use ehlwave_provenance, only: compiler, compiler_flags, git_revision, program_version
   use ehlwave_terminal, only: say
   use ehlwave_text_file, only: read_whole_file
   use ehlwave_time_march, only: march_t
   implicit none (type, external)
   private

   character(len=*), parameter :: format_line = 'ehlwave-checkpoint 7 '//program_version//' '//git_revision//' '// &
      compiler//' '//compiler_flags

   integer, parameter :: bytes_of_real = storage_size(1.0_dp)/8

   !> Bytes that values are passed to, one after the other, or from.
   type :: bytes_t
      character(len=:), allocatable :: text
      integer :: place = 0
      logical :: is_reading = .false.
   contains
      procedure :: numbers => pass_numbers
      procedure :: count => pass_count
   end type bytes_t

   !> Where the checkpoint of one case is kept, and when. The file is replaced as a whole and carries a checksum; a
   !> checkpoint is not used if torn, or from another case, other input files, or another build.
   type, extends(march_keeper_t), public :: checkpoint_t
      character(len=:), allocatable :: path
      character(len=:), allocatable :: identity !! identity of the case and the content of its files
      real(dp) :: interval_s = 600              !! between two files while the case runs
      real(dp) :: start_s = 0                   !! wall_seconds at the start of the case in this run
      logical, private :: is_kept = .false.     ! `kept` is newer than the file
      type(march_t), private :: kept
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
      type(march_t), intent(inout) :: march
      character(len=:), allocatable :: text
      type(march_t) :: same_shape
      type(bytes_t) :: expected, found

      self%saved_s = wall_seconds()
      call read_whole_file(self%path, text)
      if (.not. allocated(text)) return
      if (len(text) < len(heading(self)) + 8) return
      if (text(:len(heading(self))) /= heading(self)) return
      if (checksum(text(:len(text) - 8)) /= text(len(text) - 7:)) return
      same_shape = march
      call pass_march(expected, same_shape, self%seconds_before)
      if (len(text) - 8 /= len(heading(self)) + len(expected%text)) return
      found = bytes_t(text, len(heading(self)), is_reading=.true.)
      call pass_march(found, march, self%seconds_before)
   end subroutine load

   !> Remember a march; from time to time also in the file.
   subroutine keep(self, march)
      class(checkpoint_t), intent(inout) :: self
      type(march_t), intent(in) :: march
      self%kept = march
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
      call pass_march(bytes, self%kept, seconds)
      text = heading(self)//bytes%text
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

   !> Everything that the next steps depend on, to the bytes or from them. The steady state and `share` are not among
   !> it: they follow from the case.
   subroutine pass_march(bytes, march, seconds)
      type(bytes_t), intent(inout) :: bytes
      type(march_t), intent(inout) :: march     !! when read: of the same shape
      real(dp), intent(inout) :: seconds        !! wall time of the case so far

      associate (r => march%result, past => march%past, given => march%given, rescue => march%rescue)
         if (.not. allocated(given%rough)) call given%set_rough(0*given%transport%carried)   ! before step 1
         call bytes%numbers(seconds)
         call bytes%numbers(march%history%approach)
         call bytes%numbers(past%before%delta)
         call bytes%numbers(past%earlier%delta)
         call bytes%numbers(past%earliest%delta)
         call bytes%numbers(r%worst_residual)
         call bytes%numbers(r%worst_load_error)
         call bytes%numbers(r%work)
         call bytes%numbers(given%load%carried)
         call bytes%numbers(given%load%force)
         call bytes%numbers(rescue%thinnest)
         call bytes%numbers(rescue%work_left)
         call bytes%numbers(rescue%highest)
         call bytes%count(r%steps)
         call bytes%count(r%nonlinear_steps)
         call bytes%count(r%linear_steps)
         call bytes%count(r%factorisations)
         call bytes%count(rescue%steps_left)
         call bytes%count(rescue%rung)
         call bytes%count(rescue%rescued)
         call bytes%numbers(r%time)
         call bytes%numbers(r%central_film)
         call bytes%numbers(r%approach)
         call bytes%numbers(past%before%p)
         call bytes%numbers(past%before%h)
         call bytes%numbers(past%earlier%p)
         call bytes%numbers(past%earliest%p)
         call bytes%numbers(march%history%f)
         call bytes%numbers(given%transport%carried)
         call bytes%numbers(given%rough)
      end associate
      if (allocated(march%energy)) call pass_energy(bytes, march%energy)
   end subroutine pass_march

   !> Temperatures so far for the next steps, besides the steady temperatures.
   subroutine pass_energy(bytes, energy)
      type(bytes_t), intent(inout) :: bytes
      type(energy_t), intent(inout) :: energy
      integer :: wall

      call bytes%numbers(energy%difference)
      call bytes%numbers(energy%into_wall)
      call bytes%numbers(energy%rise)
      call bytes%numbers(energy%earlier%f)
      call bytes%numbers(energy%earlier%p)
      call bytes%numbers(energy%earlier%rise)
      call bytes%numbers(energy%earlier%before)
      do wall = 1, size(energy%walls)
         call bytes%numbers(energy%walls(wall)%rise)
         call bytes%numbers(energy%walls(wall)%heat)
         call bytes%numbers(energy%walls(wall)%modes)
      end do
   end subroutine pass_energy

   !> Real numbers, of any rank.
   subroutine pass_numbers(self, values)
      class(bytes_t), intent(inout) :: self
      real(dp), intent(inout), target, contiguous :: values(..)
      real(dp), pointer :: list(:)
      integer :: n
      n = bytes_of_real*size(values)
      if (n == 0) return
      call c_f_pointer(c_loc(values), list, [size(values)])
      if (self%is_reading) then
         list = transfer(self%text(self%place + 1:self%place + n), list)
      else
         if (.not. allocated(self%text)) self%text = ''
         self%text = self%text//transfer(list, repeat(' ', n))
      end if
      self%place = self%place + n
   end subroutine pass_numbers

   !> A whole number, stored exactly as a real number.
   subroutine pass_count(self, value)
      class(bytes_t), intent(inout) :: self
      integer, intent(inout) :: value
      real(dp) :: number
      number = value
      call self%numbers(number)
      value = nint(number)
   end subroutine pass_count

end module ehlwave_checkpoint_file
