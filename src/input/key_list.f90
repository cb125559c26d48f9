!> The keys of a case as a list: to look one up by name, to walk through them without a case, to know the defaults.
module ehlwave_key_list
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_key, only: key_t, key_value_t, key_visitor_t, most_keys, value_text
   use ehlwave_case_keys, only: visit_case_keys
   implicit none (type, external)
   private
   public :: case_key_list, find_key, is_default, key_value

   !> A table of keys with the values of one case.
   type, extends(key_visitor_t), public :: key_list_t
      type(key_t), allocatable :: keys(:)
      type(key_value_t), allocatable :: values(:)
   contains
      procedure :: visit => collect
   end type key_list_t

   !> The value of one key.
   type, extends(key_visitor_t) :: getter_t
      integer :: number = 0
      type(key_value_t) :: value
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

   !> Value that a case has for the key of a number; without a case the default.
   function key_value(number, case) result(value)
      integer, intent(in) :: number
      type(case_t), intent(in), optional :: case
      type(key_value_t) :: value
      type(case_t) :: copy
      type(getter_t) :: getter
      if (present(case)) copy = case
      getter%number = number
      call visit_case_keys(copy, getter)
      value = getter%value
   end function key_value

   subroutine get(self, key, value)
      class(getter_t), intent(inout) :: self
      type(key_t), intent(in) :: key
      type(key_value_t), intent(inout) :: value
      if (key%number == self%number) self%value = value
   end subroutine get

   !> Whether a value is the default of its key.
   logical function is_default(key, value)
      type(key_t), intent(in) :: key
      type(key_value_t), intent(in) :: value
      is_default = value_text(value) == value_text(key_value(key%number))
   end function is_default

end module ehlwave_key_list
