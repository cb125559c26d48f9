!> Known groups and keys, and advice about unknown names.
module ehlwave_namelist_known
   use ehlwave_identity_index, only: identity_index_t, identity_length
   use ehlwave_namelist_scanner, only: key_identity, name_length
   use ehlwave_spelling, only: nearest_word
   use ehlwave_text, only: lower_case, to_text
   implicit none (type, external)
   private
   public :: known_names_t

   integer, parameter :: longest_list = 30   !! names that a message lists
   integer, parameter :: usual_number = 128  ! of keys

   type :: known_names_t
      character(len=name_length), allocatable, private :: groups(:), keys(:)   ! (:index%count) names, lower case
      type(identity_index_t), private :: index                                !! index of both, in order of request
   contains
      procedure :: learn
      procedure :: group_problem
      procedure :: key_problem
   end type known_names_t

contains

   !> Note a key and its group.
   subroutine learn(self, identity, group, key)
      class(known_names_t), intent(inout) :: self
      character(len=identity_length), intent(in) :: identity   !! identity of both, see `key_identity`
      character(len=*), intent(in) :: group, key
      integer :: before, i

      if (.not. allocated(self%keys)) allocate (self%groups(usual_number), self%keys(usual_number))
      before = self%index%count
      call self%index%add(identity, i)
      if (i <= before) return
      if (i > size(self%keys)) then
         self%groups = [self%groups, self%groups]
         self%keys = [self%keys, self%keys]
      end if
      self%groups(i) = lower_case(group)
      self%keys(i) = lower_case(key)
   end subroutine learn

   !> Empty for a known group; otherwise the problem and the change needed.
   pure function group_problem(self, group) result(problem)
      class(known_names_t), intent(in) :: self
      character(len=name_length), intent(in) :: group
      character(len=:), allocatable :: problem
      character(len=name_length), allocatable :: groups(:)

      allocate (groups(0))
      if (allocated(self%groups)) groups = self%groups(:self%index%count)
      problem = ''
      if (.not. any(groups == group)) problem = 'unknown group &'//trim(group)//': '// &
         advice(group, groups, '&', 'groups')
   end function group_problem

   !> Empty for a known key of a known group; otherwise the problem and the change needed.
   function key_problem(self, group, key) result(problem)
      class(known_names_t), intent(in) :: self
      character(len=name_length), intent(in) :: group, key   !! the group is known
      character(len=:), allocatable :: problem
      integer :: i, known

      problem = ''
      known = self%index%count
      if (self%index%find(key_identity(group, key)) > 0) return
      do i = 1, known
         if (self%keys(i) == key) problem = problem//' or &'//trim(self%groups(i))
      end do
      if (problem /= '') then
         problem = 'it belongs to '//problem(5:)//', move it there'
      else
         problem = advice(key, pack(self%keys(:known), self%groups(:known) == group), '', 'keys')
      end if
      problem = 'unknown key '''//trim(key)//''' in &'//trim(group)//': '//problem
   end function key_problem

   !> 'did you mean', or all known names when none is near; of a long list their number and the option that prints it.
   pure function advice(name, known, mark, what) result(text)
      character(len=*), intent(in) :: name
      character(len=name_length), intent(in) :: known(:)   !! may hold a name several times
      character(len=*), intent(in) :: mark, what           !! before each name; 'groups' or 'keys'
      character(len=:), allocatable :: text
      integer :: i, count

      i = nearest_word(name, known)
      if (i > 0) then
         text = 'did you mean '''//mark//trim(known(i))//'''?'
         return
      end if
      text = ''
      count = 0
      do i = 1, size(known)
         if (any(known(:i - 1) == known(i))) cycle
         text = text//', '//mark//trim(known(i))
         count = count + 1
      end do
      if (count > longest_list) then
         text = 'none of the '//to_text(count)//' known '//what//' is like it; --keys prints them'
      else
         text = 'the known '//what//' are '//text(3:)
      end if
   end function advice

end module ehlwave_namelist_known
