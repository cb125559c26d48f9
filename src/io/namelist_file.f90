!> Typed access to an input file in Fortran namelist format.
!>
!> The reader is our own because a compiler's reports nearly all mistakes as 'End of file' and lets NaN,
!> 1d400, empty values and doubled keys pass. Use: `load`, then `get` and `get_list` for every key there
!> is, then `check_all_used`. The keys asked for are the keys known; no other list is needed. All of
!> these do nothing when `error` is already allocated, so that one check after the last is enough.
!> A key that is absent leaves the value, the default, as it was. Names do not depend on case.
module ehlwave_namelist
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   use ehlwave_namelist_known, only: known_names_t
   use ehlwave_namelist_scanner, only: entry_t, group_t, scan_namelist, value_t
   use ehlwave_namelist_tokens, only: line_prefix
   use ehlwave_namelist_values, only: check_bounds, read_value
   use ehlwave_text, only: lower_case, to_text
   use ehlwave_text_file, only: read_text
   implicit none (type, external)
   private
   public :: namelist_t

   type :: namelist_t
      character(len=:), allocatable :: path
      character(len=:), allocatable :: text   !! the file, byte by byte
      type(group_t), allocatable, private :: groups(:)
      type(entry_t), allocatable, private :: entries(:)
      type(value_t), allocatable, private :: values(:)
      type(known_names_t), private :: known
   contains
      procedure :: load
      procedure :: load_text
      generic :: get => get_real, get_integer, get_logical, get_text
      procedure :: get_fixed
      generic :: get_list => get_reals, get_texts
      procedure :: has, has_group
      procedure :: place
      procedure :: check_all_used
      procedure, private :: get_real, get_integer, get_logical, get_text, get_reals, get_texts
      procedure, private :: find, find_one, refuse
      procedure, private :: real_value, text_value
   end type namelist_t

contains

   !> Read and split a file. Fails when it cannot be read or breaks the format; then nothing changes.
   subroutine load(self, path, error)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: text

      if (allocated(error)) return
      call read_text(path, text, error)
      if (allocated(error)) return
      call self%load_text(path, text, error)
   end subroutine load

   !> Split a text that is at hand already. Fails when it breaks the format; then nothing changes.
   subroutine load_text(self, path, text, error)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: path   !! where the text is from, for messages
      character(len=*), intent(in) :: text
      type(error_t), allocatable, intent(inout) :: error
      type(group_t), allocatable :: groups(:)
      type(entry_t), allocatable :: entries(:)
      type(value_t), allocatable :: values(:)

      if (allocated(error)) return
      call scan_namelist(path, text, groups, entries, values, error)
      if (allocated(error)) return
      self%path = trim(path)
      self%text = text
      call move_alloc(groups, self%groups)
      call move_alloc(entries, self%entries)
      call move_alloc(values, self%values)
      self%known = known_names_t()
   end subroutine load_text

   !> Real number; a whole number is accepted.
   subroutine get_real(self, group, key, value, error, minimum, maximum, above, below)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group, key
      real(dp), intent(inout) :: value
      type(error_t), allocatable, intent(inout) :: error
      real(dp), intent(in), optional :: minimum, maximum   !! allowed themselves
      real(dp), intent(in), optional :: above, below       !! not allowed themselves
      real(dp) :: candidate
      integer :: i

      call self%find_one(group, key, i, error)
      if (i == 0) return
      call self%real_value(self%entries(i), self%entries(i)%first, candidate, error, minimum, maximum, above, below)
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
      character(len=:), allocatable :: problem
      integer :: i, candidate

      call self%find_one(group, key, i, error)
      if (i == 0) return
      associate (item => self%values(self%entries(i)%first))
         call read_value(item, candidate, problem)
         if (.not. allocated(problem)) then
            if (present(minimum)) low = minimum
            if (present(maximum)) high = maximum
            if (present(above)) over = above
            if (present(below)) under = below
            call check_bounds(item, real(candidate, dp), problem, low, high, over, under)
         end if
         if (allocated(problem)) then
            call self%refuse(self%entries(i), item%line, problem, error)
         else
            value = candidate
         end if
      end associate
   end subroutine get_integer

   !> true or false.
   subroutine get_logical(self, group, key, value, error)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group, key
      logical, intent(inout) :: value
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: problem
      logical :: candidate
      integer :: i

      call self%find_one(group, key, i, error)
      if (i == 0) return
      associate (item => self%values(self%entries(i)%first))
         call read_value(item, candidate, problem)
         if (allocated(problem)) then
            call self%refuse(self%entries(i), item%line, problem, error)
         else
            value = candidate
         end if
      end associate
   end subroutine get_logical

   !> Text in quotes.
   subroutine get_text(self, group, key, value, error, choices)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group, key
      character(len=:), allocatable, intent(inout) :: value   !! with `choices`: the choice in lower case
      type(error_t), allocatable, intent(inout) :: error
      character(len=*), intent(in), optional :: choices(:)    !! the only texts allowed, in any case
      character(len=:), allocatable :: candidate
      integer :: i

      call self%find_one(group, key, i, error)
      if (i == 0) return
      call self%text_value(self%entries(i), self%entries(i)%first, candidate, error, choices)
      if (.not. allocated(error)) call move_alloc(candidate, value)
   end subroutine get_text

   !> As `get`, for text of fixed length, which the standard does not let share that name.
   subroutine get_fixed(self, group, key, value, error, choices)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group, key
      character(len=*), intent(inout) :: value                !! text that is longer is refused
      type(error_t), allocatable, intent(inout) :: error
      character(len=*), intent(in), optional :: choices(:)
      character(len=:), allocatable :: candidate
      integer :: i

      call self%find_one(group, key, i, error)
      if (i == 0) return
      call self%text_value(self%entries(i), self%entries(i)%first, candidate, error, choices)
      if (allocated(error)) return
      if (len_trim(candidate) > len(value)) then
         call self%refuse(self%entries(i), self%entries(i)%line, 'text of '//to_text(len_trim(candidate))// &
                          ' characters: write '//to_text(len(value))//' at most', error)
      else
         value = candidate
      end if
   end subroutine get_fixed

   !> One or more real numbers.
   subroutine get_reals(self, group, key, value, error, minimum, maximum, above, below)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group, key
      real(dp), allocatable, intent(inout) :: value(:)
      type(error_t), allocatable, intent(inout) :: error
      real(dp), intent(in), optional :: minimum, maximum, above, below   !! for each, as in `get`
      real(dp), allocatable :: candidate(:)
      integer :: i, j

      call self%find(group, key, i, error)
      if (i == 0) return
      associate (found => self%entries(i))
         allocate (candidate(found%last - found%first + 1))
         do j = 1, size(candidate)
            call self%real_value(found, found%first + j - 1, candidate(j), error, minimum, maximum, above, below)
            if (allocated(error)) return
         end do
      end associate
      call move_alloc(candidate, value)
   end subroutine get_reals

   !> One or more texts, all of the length of the longest.
   subroutine get_texts(self, group, key, value, error, choices)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group, key
      character(len=:), allocatable, intent(inout) :: value(:)
      type(error_t), allocatable, intent(inout) :: error
      character(len=*), intent(in), optional :: choices(:)    !! for each, as in `get`
      character(len=:), allocatable :: one
      integer :: i, j, longest

      call self%find(group, key, i, error)
      if (i == 0) return
      associate (found => self%entries(i))
         longest = 0
         do j = found%first, found%last
            call self%text_value(found, j, one, error, choices)
            if (allocated(error)) return
            longest = max(longest, len(one))
         end do
         if (allocated(value)) deallocate (value)
         allocate (character(len=longest) :: value(found%last - found%first + 1))
         do j = found%first, found%last
            call self%text_value(found, j, one, error, choices)
            value(j - found%first + 1) = one
         end do
      end associate
   end subroutine get_texts

   !> Whether the file gives a key; the key counts as known afterwards. Give the call a statement of its
   !> own: beside '.and.' or '.or.' a compiler may leave it out, and then the key stays unknown.
   logical function has(self, group, key)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group, key
      type(error_t), allocatable :: error
      integer :: i
      call self%find(group, key, i, error)
      has = i > 0
   end function has

   !> Whether the file has a group; the group counts as known afterwards. A statement of its own, as `has`.
   logical function has_group(self, group)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group
      call self%known%learn(group)
      has_group = .false.
      if (allocated(self%groups)) has_group = any(self%groups%name == lower_case(group))
   end function has_group

   !> `FILE:LINE: ` of a key, else of its group, or `FILE: `; for messages of the caller.
   function place(self, group, key) result(prefix)
      class(namelist_t), intent(in) :: self
      character(len=*), intent(in) :: group, key
      character(len=:), allocatable :: prefix
      integer :: i

      prefix = self%path//': '
      do i = 1, size(self%groups)
         if (self%groups(i)%name == lower_case(group)) prefix = line_prefix(self%path, self%groups(i)%line)
      end do
      do i = 1, size(self%entries)
         if (self%entries(i)%group == lower_case(group) .and. self%entries(i)%key == lower_case(key)) &
            prefix = line_prefix(self%path, self%entries(i)%line)
      end do
   end function place

   !> Refuse the first group or key of the file that nobody asked for. Call it after all others.
   subroutine check_all_used(self, error)
      class(namelist_t), intent(in) :: self
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: problem
      integer :: i

      if (allocated(error) .or. .not. allocated(self%entries)) return
      do i = 1, size(self%groups)
         problem = self%known%group_problem(self%groups(i)%name)
         if (problem == '') cycle
         call raise(error, line_prefix(self%path, self%groups(i)%line)//problem)
         return
      end do
      do i = 1, size(self%entries)
         problem = self%known%key_problem(self%entries(i)%group, self%entries(i)%key)
         if (problem == '') cycle
         call raise(error, line_prefix(self%path, self%entries(i)%line)//problem)
         return
      end do
   end subroutine check_all_used

   !> Index of an entry, 0 when it is absent or `error` is allocated.
   subroutine find(self, group, key, i, error)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group, key
      integer, intent(out) :: i
      type(error_t), allocatable, intent(in) :: error

      i = 0
      if (allocated(error)) return
      call self%known%learn(group, key)
      if (.not. allocated(self%entries)) return
      do i = size(self%entries), 1, -1
         if (self%entries(i)%group == lower_case(group) .and. self%entries(i)%key == lower_case(key)) return
      end do
   end subroutine find

   !> As `find`; a list is refused.
   subroutine find_one(self, group, key, i, error)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group, key
      integer, intent(out) :: i
      type(error_t), allocatable, intent(inout) :: error
      integer :: n

      call self%find(group, key, i, error)
      if (i == 0) return
      associate (found => self%entries(i))
         n = found%last - found%first + 1
         if (n > 1) then
            call self%refuse(found, found%line, to_text(n)//' values ('//self%values(found%first)%text//', '// &
                             self%values(found%first + 1)%text//trim(merge(', ...', '     ', n > 2))//') where one is '// &
                             'needed: write one, with a point as decimal mark, and ''='' after each key', error)
            i = 0
         end if
      end associate
   end subroutine find_one

   !> Value number `j` as a real number inside its bounds.
   subroutine real_value(self, found, j, value, error, minimum, maximum, above, below)
      class(namelist_t), intent(in) :: self
      type(entry_t), intent(in) :: found
      integer, intent(in) :: j
      real(dp), intent(out) :: value
      type(error_t), allocatable, intent(inout) :: error
      real(dp), intent(in), optional :: minimum, maximum, above, below
      character(len=:), allocatable :: problem

      call read_value(self%values(j), value, problem)
      if (.not. allocated(problem)) call check_bounds(self%values(j), value, problem, minimum, maximum, above, below)
      if (allocated(problem)) call self%refuse(found, self%values(j)%line, problem, error)
   end subroutine real_value

   !> Value number `j` as text, one of the choices if there are any.
   subroutine text_value(self, found, j, value, error, choices)
      class(namelist_t), intent(in) :: self
      type(entry_t), intent(in) :: found
      integer, intent(in) :: j
      character(len=:), allocatable, intent(out) :: value
      type(error_t), allocatable, intent(inout) :: error
      character(len=*), intent(in), optional :: choices(:)
      character(len=:), allocatable :: problem

      call read_value(self%values(j), value, problem, choices)
      if (allocated(problem)) call self%refuse(found, self%values(j)%line, problem, error)
   end subroutine text_value

   !> Raise an error about a key.
   subroutine refuse(self, found, line, problem, error)
      class(namelist_t), intent(in) :: self
      type(entry_t), intent(in) :: found
      integer, intent(in) :: line
      character(len=*), intent(in) :: problem
      type(error_t), allocatable, intent(inout) :: error
      call raise(error, line_prefix(self%path, line)//'key '''//trim(found%key)//''' in &'//trim(found%group)// &
                 ': '//problem)
   end subroutine refuse

end module ehlwave_namelist
