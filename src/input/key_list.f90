!> A list of keys with their values: made from a table of keys, looked up by name, written back to the case.
module ehlwave_key_list
   use ehlwave_case_key, only: choice_length, key_length, key_t, key_value_t, most_keys, number_kind, truth_kind, &
      whole_kind, word_kind
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: find_key

   !> A table is a procedure that calls `begin`, `enter` for every group, and `see` for every key with the component
   !> that holds its value. That makes the list; with `gives_back` it gives the values of a list made before to the
   !> components.
   type, public :: key_list_t
      integer :: count = 0                           !! keys seen
      type(key_t), allocatable :: keys(:)            !! at least `count`
      type(key_value_t), allocatable :: values(:)
      logical :: gives_back = .false.
      integer, allocatable :: given_back(:)          !! numbers of keys to give back; not allocated: all
      logical :: has_keys = .true.                   !! false: makes values only, which costs a fraction
      type(key_t) :: common                          !! holds for all keys that follow in the group: applies, is_late,
                                                     !! ...
      character(len=choice_length), private :: group = ''
      character(len=256), private :: group_help = ''
   contains
      procedure :: begin
      procedure :: enter
      procedure :: see
      procedure :: add
   end type key_list_t

contains

   !> A table begins.
   subroutine begin(self)
      class(key_list_t), intent(inout) :: self
      self%count = 0
      if (self%gives_back) return
      if (.not. allocated(self%values)) allocate (self%values(most_keys))
      if (self%has_keys .and. .not. allocated(self%keys)) allocate (self%keys(most_keys))
   end subroutine begin

   !> The keys of a group follow.
   subroutine enter(self, group, help)
      class(key_list_t), intent(inout) :: self
      character(len=*), intent(in) :: group, help
      if (self%gives_back) return
      self%group = group
      self%group_help = help
      self%common = key_t()
   end subroutine enter

   !> A key of the table: a number, a whole number, a truth or a word.
   subroutine see(self, component, key)
      class(key_list_t), intent(inout) :: self
      class(*), intent(inout) :: component
      type(key_t), intent(in) :: key
      type(key_value_t) :: value

      if (self%gives_back) then
         self%count = self%count + 1
         if (allocated(self%given_back)) then
            if (.not. any(self%given_back == self%count)) return
         end if
         value = self%values(self%count)
      end if
      select type (component)
      type is (real(dp))
         value%kind = number_kind
         if (self%gives_back) component = value%number
         value%number = component
      type is (integer)
         value%kind = whole_kind
         if (self%gives_back) component = nint(value%number)
         value%number = component
      type is (logical)
         value%kind = truth_kind
         if (self%gives_back) component = value%number > 0
         value%number = merge(1, 0, component)
      type is (character(len=*))
         value%kind = word_kind
         if (self%gives_back) component = value%word
         value%word = trim(component)
      end select
      if (.not. self%gives_back) call self%add(key, value)
   end subroutine see

   !> Append a key of the group, with the common properties.
   subroutine add(self, key, value)
      class(key_list_t), intent(inout) :: self
      type(key_t), intent(in) :: key
      type(key_value_t), intent(in) :: value

      self%count = self%count + 1
      self%values(self%count) = value
      if (.not. self%has_keys) return
      self%keys(self%count) = key
      associate (new => self%keys(self%count), common => self%common)
         new%kind = value%kind
         new%group = self%group
         new%group_help = self%group_help
         new%applies = key%applies .and. common%applies
         new%counts = key%counts .and. common%counts
         new%is_effort = key%is_effort .or. common%is_effort
         if (key%when(1:1) == ' ') new%when = common%when
         new%is_written = key%is_written .and. common%is_written
         new%is_late = key%is_late .or. common%is_late
      end associate
   end subroutine add

   !> Number of a key in a list, 0 when it has no key of this name.
   pure integer function find_key(keys, name)
      type(key_t), intent(in) :: keys(:)
      character(len=*), intent(in) :: name
      character(len=key_length) :: wanted                !! texts of equal length are compared fastest
      find_key = 0
      if (len_trim(name) > key_length) return
      wanted = name
      do find_key = size(keys), 1, -1
         if (keys(find_key)%name == wanted) return
      end do
   end function find_key

end module ehlwave_key_list
