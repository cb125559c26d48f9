!> Checkpoint of a time march: a march that goes on from it ends with the same numbers, bit for bit.
module ehlwave_checkpoint_file
   use, intrinsic :: iso_fortran_env, only: error_unit
   use ehlwave_clock, only: wall_seconds
   use ehlwave_kinds, only: dp
   use ehlwave_march_keeper, only: march_keeper_t
   use ehlwave_posix, only: checksum, reason_text, remove_file, replace_file
   use ehlwave_provenance, only: compiler, compiler_flags, git_revision, program_version
   use ehlwave_record_file, only: read_whole_file
   use ehlwave_time_march, only: march_t
   implicit none (type, external)
   private

   character(len=*), parameter :: format_line = 'ehlwave-checkpoint 2 '//program_version//' '//git_revision//' '// &
      compiler//' '//compiler_flags

   integer, parameter :: bytes_of_real = storage_size(1.0_dp)/8, bytes_of_integer = storage_size(1)/8

   !> Where the checkpoint of one case is kept, and when. The file is replaced as a whole and carries a checksum;
   !> one that is torn, of another case or of another build of the program is not used.
   type, extends(march_keeper_t), public :: checkpoint_t
      character(len=:), allocatable :: path
      character(len=16) :: identity = ''        !! of the case
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
      integer :: place

      self%saved_s = wall_seconds()
      call read_whole_file(self%path, text)
      if (.not. allocated(text)) return
      if (len(text) < len(heading(self)) + 8) return
      if (text(:len(heading(self))) /= heading(self)) return
      if (checksum(text(:len(text) - 8)) /= text(len(text) - 7:)) return
      place = len(heading(self)) + 1
      if (len(text) - 8 - place + 1 /= len(packed(march, self%seconds_before))) return
      call unpack_march(text(place:len(text) - 8), march, self%seconds_before)
   end subroutine load

   !> Remember a march; from time to time also in the file.
   subroutine keep(self, march)
      class(checkpoint_t), intent(inout) :: self
      type(march_t), intent(in) :: march
      self%kept = march
      self%is_kept = .true.
      if (wall_seconds() - self%saved_s >= self%interval_s) call self%save()
   end subroutine keep

   !> Write what was remembered last. A checkpoint that cannot be written is said and costs time only.
   subroutine save_kept(self)
      class(checkpoint_t), intent(inout) :: self
      character(len=:), allocatable :: text
      integer :: status

      self%saved_s = wall_seconds()
      if (.not. self%is_kept) return
      text = heading(self)//packed(self%kept, self%seconds_before + self%saved_s - self%start_s)
      call replace_file(self%path, text//checksum(text), status)
      self%is_kept = status /= 0
      if (status /= 0) write (error_unit, '(a)') 'checkpoint '//self%path//' not written: '//reason_text(status)
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

   !> The bytes of everything that the next steps depend on. The steady state and `share` are not among them:
   !> they follow from the case.
   function packed(march, seconds) result(text)
      type(march_t), intent(in) :: march
      real(dp), intent(in) :: seconds   !! wall time of the case so far
      character(len=:), allocatable :: text

      associate (r => march%result, past => march%past, given => march%given, rescue => march%rescue)
         text = reals([seconds, march%approach, past%before%delta, past%earlier%delta, past%earliest%delta, &
                       r%worst_residual, r%worst_load_error, given%load%carried, given%load%force, rescue%thinnest]) &
                //integers([r%steps, r%nonlinear_steps, r%linear_steps, r%factorisations, &
                            rescue%steps_left, rescue%rung, rescue%rescued]) &
                //reals(r%time)//reals(r%central_film)//reals(r%approach) &
                //reals(flat(past%before%p))//reals(flat(past%before%h)) &
                //reals(flat(past%earlier%p))//reals(flat(past%earliest%p)) &
                //reals(reshape(march%history, [size(march%history)])) &
                //reals(flat(given%transport%carried))
         if (allocated(given%rough)) then
            text = text//reals(flat(given%rough))
         else                            ! before the first step
            text = text//reals(0*flat(given%transport%carried))
         end if
      end associate
   end function packed

   pure function reals(values) result(text)
      real(dp), intent(in) :: values(:)
      character(len=bytes_of_real*size(values)) :: text
      text = transfer(values, text)
   end function reals

   pure function integers(values) result(text)
      integer, intent(in) :: values(:)
      character(len=bytes_of_integer*size(values)) :: text
      text = transfer(values, text)
   end function integers

   pure function flat(values) result(list)
      real(dp), intent(in) :: values(:, :)
      real(dp) :: list(size(values))
      list = reshape(values, [size(values)])
   end function flat

   !> The opposite of `packed`, into a march of the same shape.
   subroutine unpack_march(text, march, seconds)
      character(len=*), intent(in) :: text
      type(march_t), intent(inout) :: march
      real(dp), intent(out) :: seconds
      real(dp) :: numbers(12)
      integer :: counts(7), place

      place = 0
      associate (r => march%result, past => march%past, given => march%given, rescue => march%rescue)
         call take(numbers)
         seconds = numbers(1)
         march%approach = numbers(2:4)
         past%before%delta = numbers(5)
         past%earlier%delta = numbers(6)
         past%earliest%delta = numbers(7)
         r%worst_residual = numbers(8)
         r%worst_load_error = numbers(9)
         given%load%carried = numbers(10)
         given%load%force = numbers(11)
         rescue%thinnest = numbers(12)
         counts = transfer(text(place + 1:place + size(counts)*bytes_of_integer), counts)
         place = place + size(counts)*bytes_of_integer
         r%steps = counts(1)
         r%nonlinear_steps = counts(2)
         r%linear_steps = counts(3)
         r%factorisations = counts(4)
         rescue%steps_left = counts(5)
         rescue%rung = counts(6)
         rescue%rescued = counts(7)
         call take(r%time)
         call take(r%central_film)
         call take(r%approach)
         call take_plane(past%before%p)
         call take_plane(past%before%h)
         call take_plane(past%earlier%p)
         call take_plane(past%earliest%p)
         block
            real(dp) :: list(size(march%history))
            call take(list)
            march%history = reshape(list, shape(march%history))
         end block
         if (.not. allocated(given%rough)) allocate (given%rough, mold=given%transport%carried)
         call take_plane(given%transport%carried)
         call take_plane(given%rough)
      end associate

   contains

      subroutine take(values)
         real(dp), intent(inout) :: values(:)
         values = transfer(text(place + 1:place + bytes_of_real*size(values)), values)
         place = place + bytes_of_real*size(values)
      end subroutine take

      subroutine take_plane(values)
         real(dp), intent(inout) :: values(:, :)
         real(dp) :: list(size(values))
         call take(list)
         values = reshape(list, shape(values))
      end subroutine take_plane

   end subroutine unpack_march

end module ehlwave_checkpoint_file
