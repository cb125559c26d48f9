!> The keys of a case as a list: to look one up by name, to walk through them without a case, to know the defaults.
module ehlwave_key_list
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_key, only: key_t, key_value_t, key_visitor_t, most_keys
   use ehlwave_case_keys, only: visit_case_keys
   implicit none (type, external)
   private
   public :: case_key_list, default_values, find_key

   !> A table of keys with the values of one case.
   type, extends(key_visitor_t), public :: key_list_t
      type(key_t), allocatable :: keys(:)
      type(key_value_t), allocatable :: values(:)
   contains
      procedure :: visit => collect
   end type key_list_t

   !> Values alone.
   type, extends(key_visitor_t) :: getter_t
      type(key_value_t) :: values(most_keys)
   contains
      procedure :: visit => get
   end type getter_t

contains

   !> All keys of a case with their values, without a case with their defaults.
   function case_key_list(case) result(list)
      type(case_t), intent(in), optional :: case
      type(key_list_t) :: list
      type(case_t) :: copy
      if (present(case)) copy = case
      call visit_case_keys(copy, list)
      list%keys = list%keys(:list%count)
      list%values = list%values(:list%count)
   end function case_key_list

   subroutine collect(self, key, value)
      class(key_list_t), intent(inout) :: self
      type(key_t), intent(in) :: key
      type(key_value_t), intent(inout) :: value
      if (.not. allocated(self%keys)) allocate (self%keys(most_keys), self%values(most_keys))
      self%keys(key%number) = key
      self%values(key%number) = value
   end subroutine collect

   !> Number of a key in a list, 0 when it has no key of this name.
   pure integer function find_key(keys, name)
      type(key_t), intent(in) :: keys(:)
      character(len=*), intent(in) :: name
      do find_key = size(keys), 1, -1
         if (keys(find_key)%name == name) return
      end do
   end function find_key

   !> The defaults of all keys, in the order of the table.
   subroutine default_values(values)
      type(key_value_t), allocatable, intent(out) :: values(:)
      type(case_t) :: usual
      type(getter_t) :: getter
      call visit_case_keys(usual, getter)
      values = getter%values(:getter%count)
   end subroutine default_values

   subroutine get(self, key, value)
      class(getter_t), intent(inout) :: self
      type(key_t), intent(in) :: key
      type(key_value_t), intent(inout) :: value
      self%values(key%number) = value
   end subroutine get

end module ehlwave_key_list
