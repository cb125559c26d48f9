!> An input file in Fortran namelist format: its groups and keys, their lines, known and unknown.
!>
!> This reader exists because compilers report nearly all mistakes as 'End of file' and accept NaN, 1d400, empty
!> values and doubled keys. Use: `load`, then `value_of` or `values_of` for every key, then `check_all_used`. The
!> requested keys are the known keys; no other list is needed. With `error` allocated these procedures do nothing,
!> so that a single check at the end is enough. Names do not depend on case.
module ehlwave_namelist
   use ehlwave_errors, only: error_t, raise
   use ehlwave_identity_index, only: identity_length
   use ehlwave_namelist_known, only: known_names_t
   use ehlwave_namelist_scanner, only: contents_t, key_identity, scan_namelist, value_t
   use ehlwave_namelist_tokens, only: line_prefix
   use ehlwave_text, only: lower_case, shown, to_text
   use ehlwave_text_file, only: read_text
   implicit none (type, external)
   private

   type, public :: namelist_t
      character(len=:), allocatable :: path
      character(len=:), allocatable :: text   !! the file, byte by byte
      type(contents_t), private :: contents
      type(known_names_t), private :: known
   contains
      procedure :: load
      procedure :: load_text
      procedure :: place
      procedure :: has_group
      procedure :: check_all_used
      procedure :: values_of, value_of
      procedure :: refuse
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
      type(contents_t) :: contents

      if (allocated(error)) return
      call scan_namelist(path, text, contents, error)
      if (allocated(error)) return
      self%path = trim(path)
      self%text = text
      self%contents = contents
      self%known = known_names_t()
   end subroutine load_text

   !> `FILE:LINE: ` of a key, else of its group, or `FILE: `; for messages of the caller.
   function place(self, group, key) result(prefix)
      class(namelist_t), intent(in) :: self
      character(len=*), intent(in) :: group, key
      character(len=:), allocatable :: prefix
      integer :: i

      prefix = self%path//': '
      i = self%contents%group_place(group)
      if (i > 0) prefix = line_prefix(self%path, self%contents%groups(i)%line)
      i = self%contents%entry_place(key_identity(group, key))
      if (i > 0) prefix = line_prefix(self%path, self%contents%entries(i)%line)
   end function place

   !> Whether the file has a group.
   logical function has_group(self, group)
      class(namelist_t), intent(in) :: self
      character(len=*), intent(in) :: group
      has_group = self%contents%group_place(group) > 0
   end function has_group

   !> Refuse the first group or key of the file that nobody asked for. Call it after all others.
   subroutine check_all_used(self, error)
      class(namelist_t), intent(in) :: self
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: problem
      integer :: i

      if (allocated(error)) return
      do i = 1, self%contents%n_groups
         associate (group => self%contents%groups(i))
            problem = self%known%group_problem(group%name)
            if (problem /= '') call raise(error, line_prefix(self%path, group%line)//problem)
         end associate
         if (allocated(error)) return
      end do
      do i = 1, self%contents%n_entries
         associate (entry => self%contents%entries(i))
            problem = self%known%key_problem(entry%group, entry%key)
            if (problem /= '') call raise(error, line_prefix(self%path, entry%line)//problem)
         end associate
         if (allocated(error)) return
      end do
   end subroutine check_all_used

   !> Values of a key as written; unallocated when it is absent or `error` is allocated.
   subroutine values_of(self, group, key, items, error)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group, key
      type(value_t), allocatable, intent(out) :: items(:)
      type(error_t), allocatable, intent(in) :: error
      character(len=identity_length) :: identity
      integer :: i
      if (allocated(error)) return
      identity = key_identity(group, key)
      call self%known%learn(identity, group, key)
      i = self%contents%entry_place(identity)
      if (i > 0) items = self%contents%values(self%contents%entries(i)%first:self%contents%entries(i)%last)
   end subroutine values_of

   !> As `values_of`; a list is refused.
   subroutine value_of(self, group, key, item, error)
      class(namelist_t), intent(inout) :: self
      character(len=*), intent(in) :: group, key
      type(value_t), allocatable, intent(out) :: item
      type(error_t), allocatable, intent(inout) :: error
      type(value_t), allocatable :: items(:)
      character(len=:), allocatable :: problem

      call self%values_of(group, key, items, error)
      if (.not. allocated(items)) return
      if (size(items) > 1) then
         problem = to_text(size(items))//' values ('//shown(items(1)%text)//', '//shown(items(2)%text)// &
                   trim(merge(', ...', '     ', size(items) > 2))//') where one is needed: write one, with a point '// &
                   'as decimal mark, and ''='' after each key'
         call self%refuse(group, key, problem, error)
      else
         item = items(1)
      end if
   end subroutine value_of

   !> Raise an error about a key, if there is a problem with it.
   subroutine refuse(self, group, key, problem, error, line)
      class(namelist_t), intent(in) :: self
      character(len=*), intent(in) :: group, key
      character(len=:), allocatable, intent(in) :: problem   !! unallocated: none
      type(error_t), allocatable, intent(inout) :: error
      integer, intent(in), optional :: line                  !! line of the value; without, the line of the key is named
      character(len=:), allocatable :: where

      if (.not. allocated(problem)) return
      where = self%place(group, key)
      if (present(line)) where = line_prefix(self%path, line)
      call raise(error, where//'key '''//trim(lower_case(key))//''' in &'//trim(lower_case(group))//': '//problem)
   end subroutine refuse

end module ehlwave_namelist
