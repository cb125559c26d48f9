!> Groups and keys somebody asked for, and advice about those nobody did.
module ehlwave_namelist_known
   use ehlwave_identity_index, only: identity_index_t, text_identity
   use ehlwave_namelist_scanner, only: name_length
   use ehlwave_spelling, only: nearest_word
   use ehlwave_text, only: lower_case
   implicit none (type, external)
   private
   public :: known_names_t

   type :: name_t
      character(len=name_length) :: group = '', key = ''   !! lower case; blank key: the group alone
   end type name_t

   type :: known_names_t
      type(name_t), allocatable, private :: names(:)       !! in the order of asking
      type(identity_index_t), private :: index
   contains
      procedure :: learn
      procedure :: group_problem
      procedure :: key_problem
   end type known_names_t

contains

   !> Note a group, or a key and its group.
   subroutine learn(self, group, key)
      class(known_names_t), intent(inout) :: self
      character(len=*), intent(in) :: group
      character(len=*), intent(in), optional :: key
      type(name_t) :: new
      integer :: i

      new%group = lower_case(group)
      if (present(key)) new%key = lower_case(key)
      if (.not. allocated(self%names)) allocate (self%names(0))
      call self%index%add(text_identity(trim(new%group)//' '//trim(new%key)), i)
      if (i > size(self%names)) self%names = [self%names, new]
   end subroutine learn

   !> Empty for a known group; otherwise what is wrong and what to change.
   pure function group_problem(self, group) result(problem)
      class(known_names_t), intent(in) :: self
      character(len=name_length), intent(in) :: group
      character(len=:), allocatable :: problem
      character(len=name_length), allocatable :: groups(:)

      allocate (groups(0))
      if (allocated(self%names)) groups = self%names%group
      problem = ''
      if (any(groups == group)) return
      problem = 'unknown group &'//trim(group)//': '//advice(group, groups, '&', 'groups')
   end function group_problem

   !> Empty for a known key of a known group; otherwise what is wrong and what to change.
   function key_problem(self, group, key) result(problem)
      class(known_names_t), intent(in) :: self
      character(len=name_length), intent(in) :: group, key   !! the group is known
      character(len=:), allocatable :: problem
      character(len=name_length), allocatable :: groups(:), keys(:)
      integer :: i

      problem = ''
      if (self%index%find(text_identity(trim(group)//' '//trim(key))) > 0) return
      groups = self%names%group
      keys = self%names%key
      do i = 1, size(keys)
         if (keys(i) == key) problem = problem//' or &'//trim(groups(i))
      end do
      if (problem /= '') then
         problem = 'it belongs to '//problem(5:)//', move it there'
      else
         problem = advice(key, pack(keys, groups == group .and. keys /= ''), '', 'keys')
      end if
      problem = 'unknown key '''//trim(key)//''' in &'//trim(group)//': '//problem
   end function key_problem

   !> 'did you mean', or all known names when none is near.
   pure function advice(name, known, mark, what) result(text)
      character(len=*), intent(in) :: name
      character(len=name_length), intent(in) :: known(:)   !! may hold a name several times
      character(len=*), intent(in) :: mark, what           !! before each name; 'groups' or 'keys'
      character(len=:), allocatable :: text
      integer :: i

      i = nearest_word(name, known)
      if (i > 0) then
         text = 'did you mean '''//mark//trim(known(i))//'''?'
         return
      end if
      text = ''
      do i = 1, size(known)
         if (any(known(:i - 1) == known(i))) cycle
         text = text//', '//mark//trim(known(i))
      end do
      if (text == '') then
         text = 'no '//what//' are known here, remove it'
      else
         text = 'the known '//what//' are '//text(3:)
      end if
   end function advice

end module ehlwave_namelist_known
