!> Typed access to an input file in Fortran namelist format.
!>
!> The reader is our own because a compiler's reports nearly all mistakes as 'End of file' and lets NaN,
!> 1d400, empty values and doubled keys pass. Use: `load`, then `get` and `get_list` for every key there
!> is, then `check_all_used`. The keys asked for are the keys known; no other list is needed. All of
!> these do nothing when `error` is already allocated, so that one check after the last is enough.
!> A key that is absent leaves the value, the default, as it was. Names do not depend on case.
module ehlwave_namelist
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_namelist_entries, only: namelist_entries_t
   use ehlwave_namelist_scanner, only: value_t
   use ehlwave_namelist_values, only: check_bounds, read_value
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: namelist_t

   type, extends(namelist_entries_t) :: namelist_t
   contains
      generic :: get => get_real, get_integer, get_logical, get_text
      procedure :: get_fixed
      generic :: get_list => get_reals, get_texts
      procedure, private :: get_real, get_integer, get_logical, get_text, get_reals, get_texts
      procedure, private :: read_real, read_text
   end type namelist_t

contains

   !> Real number; a whole number is accepted.
   subroutine get_real(self, group, key, value, error, minimum, maximum, above, below)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group, key
      real(dp), intent(inout) :: value
      type(error_t), allocatable, intent(inout) :: error
      real(dp), intent(in), optional :: minimum, maximum   !! allowed themselves
      real(dp), intent(in), optional :: above, below       !! not allowed themselves
      type(value_t), allocatable :: item
      real(dp) :: candidate

      call self%value_of(group, key, item, error)
      if (.not. allocated(item)) return
      call self%read_real(group, key, item, candidate, error, minimum, maximum, above, below)
      if (.not. allocated(error)) value = candidate
   end subroutine get_real

   !> Whole number.
   subroutine get_integer(self, group, key, value, error, minimum, maximum, above, below)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group, key
      integer, intent(inout) :: value
      type(error_t), allocatable, intent(inout) :: error
      integer, intent(in), optional :: minimum, maximum    !! allowed themselves
      integer, intent(in), optional :: above, below        !! not allowed themselves
      real(dp), allocatable :: low, high, over, under      ! unallocated: absent
      type(value_t), allocatable :: item
      character(len=:), allocatable :: problem
      integer :: candidate

      call self%value_of(group, key, item, error)
      if (.not. allocated(item)) return
      if (present(minimum)) low = minimum
      if (present(maximum)) high = maximum
      if (present(above)) over = above
      if (present(below)) under = below
      call read_value(item, candidate, problem)
      if (.not. allocated(problem)) call check_bounds(item, real(candidate, dp), problem, low, high, over, under)
      call self%refuse(group, key, problem, error, item%line)
      if (.not. allocated(error)) value = candidate
   end subroutine get_integer

   !> true or false.
   subroutine get_logical(self, group, key, value, error)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group, key
      logical, intent(inout) :: value
      type(error_t), allocatable, intent(inout) :: error
      type(value_t), allocatable :: item
      character(len=:), allocatable :: problem
      logical :: candidate

      call self%value_of(group, key, item, error)
      if (.not. allocated(item)) return
      call read_value(item, candidate, problem)
      call self%refuse(group, key, problem, error, item%line)
      if (.not. allocated(error)) value = candidate
   end subroutine get_logical

   !> Text in quotes.
   subroutine get_text(self, group, key, value, error, choices)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group, key
      character(len=:), allocatable, intent(inout) :: value   !! with `choices`: the choice in lower case
      type(error_t), allocatable, intent(inout) :: error
      character(len=*), intent(in), optional :: choices(:)    !! the only texts allowed, in any case
      type(value_t), allocatable :: item
      character(len=:), allocatable :: candidate

      call self%value_of(group, key, item, error)
      if (.not. allocated(item)) return
      call self%read_text(group, key, item, candidate, error, choices)
      if (.not. allocated(error)) call move_alloc(candidate, value)
   end subroutine get_text

   !> As `get`, for text of fixed length, which the standard does not let share that name.
   subroutine get_fixed(self, group, key, value, error, choices)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group, key
      character(len=*), intent(inout) :: value                !! text that is longer is refused
      type(error_t), allocatable, intent(inout) :: error
      character(len=*), intent(in), optional :: choices(:)
      character(len=:), allocatable :: candidate, problem

      call self%get(group, key, candidate, error, choices)
      if (.not. allocated(candidate)) return
      if (len_trim(candidate) > len(value)) problem = 'text of '//to_text(len_trim(candidate))//' characters: write '// &
                                                      to_text(len(value))//' at most'
      call self%refuse(group, key, problem, error)
      if (.not. allocated(error)) value = candidate
   end subroutine get_fixed

   !> One or more real numbers.
   subroutine get_reals(self, group, key, value, error, minimum, maximum, above, below)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group, key
      real(dp), allocatable, intent(inout) :: value(:)
      type(error_t), allocatable, intent(inout) :: error
      real(dp), intent(in), optional :: minimum, maximum, above, below   !! for each, as in `get`
      type(value_t), allocatable :: items(:)
      real(dp), allocatable :: candidate(:)
      integer :: i

      call self%values_of(group, key, items, error)
      if (.not. allocated(items)) return
      allocate (candidate(size(items)))
      do i = 1, size(items)
         call self%read_real(group, key, items(i), candidate(i), error, minimum, maximum, above, below)
         if (allocated(error)) return
      end do
      call move_alloc(candidate, value)
   end subroutine get_reals

   !> One or more texts, all of the length of the longest.
   subroutine get_texts(self, group, key, value, error, choices)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group, key
      character(len=:), allocatable, intent(inout) :: value(:)
      type(error_t), allocatable, intent(inout) :: error
      character(len=*), intent(in), optional :: choices(:)    !! for each, as in `get`
      type(value_t), allocatable :: items(:)
      character(len=:), allocatable :: one
      integer :: i, longest

      call self%values_of(group, key, items, error)
      if (.not. allocated(items)) return
      longest = 0
      do i = 1, size(items)
         call self%read_text(group, key, items(i), one, error, choices)
         if (allocated(error)) return
         longest = max(longest, len(one))
         call move_alloc(one, items(i)%text)
      end do
      if (allocated(value)) deallocate (value)
      allocate (character(len=longest) :: value(size(items)))
      do i = 1, size(items)
         value(i) = items(i)%text
      end do
   end subroutine get_texts

   !> A value as a real number inside its bounds.
   subroutine read_real(self, group, key, item, value, error, minimum, maximum, above, below)
      class(namelist_t), intent(in) :: self
      character(len=*), intent(in) :: group, key
      type(value_t), intent(in) :: item
      real(dp), intent(out) :: value
      type(error_t), allocatable, intent(inout) :: error
      real(dp), intent(in), optional :: minimum, maximum, above, below
      character(len=:), allocatable :: problem

      call read_value(item, value, problem)
      if (.not. allocated(problem)) call check_bounds(item, value, problem, minimum, maximum, above, below)
      call self%refuse(group, key, problem, error, item%line)
   end subroutine read_real

   !> A value as text, one of the choices if there are any.
   subroutine read_text(self, group, key, item, value, error, choices)
      class(namelist_t), intent(in) :: self
      character(len=*), intent(in) :: group, key
      type(value_t), intent(in) :: item
      character(len=:), allocatable, intent(out) :: value
      type(error_t), allocatable, intent(inout) :: error
      character(len=*), intent(in), optional :: choices(:)
      character(len=:), allocatable :: problem

      call read_value(item, value, problem, choices)
      call self%refuse(group, key, problem, error, item%line)
   end subroutine read_text

end module ehlwave_namelist
