!> The input of one case: values as the user gives them, and which keys were given.
module ehlwave_case_input
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_key, only: key_t, key_value_t, key_visitor_t, most_keys
   use ehlwave_case_keys, only: visit_case_keys
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_key_bounds, only: read_key
   use ehlwave_namelist, only: namelist_t
   use ehlwave_namelist_scanner, only: value_t
   implicit none (type, external)
   private

   !> A case as it is given, still to be completed.
   type, public :: case_input_t
      type(case_t) :: case
      logical :: is_given(most_keys) = .false.     !! by number of the key
      logical :: may_idle(most_keys) = .false.     !! given for many cases: left out where it does not apply
      real(dp) :: f_v = 0                          !! f(r) V asked for in place of a wavelength; 0: none
   contains
      procedure :: set
   end type case_input_t

   !> Reads the groups of a table of keys from a file.
   type, extends(key_visitor_t), public :: key_reader_t
      type(namelist_t) :: file                     !! loaded
      logical :: is_given(most_keys) = .false.
      type(error_t), allocatable :: error
   contains
      procedure :: visit => read_from_file
   end type key_reader_t

   !> Puts values into a case.
   type, extends(key_visitor_t) :: setter_t
      logical :: is_set(most_keys) = .false.
      type(key_value_t) :: values(most_keys)
   contains
      procedure :: visit => put
   end type setter_t

contains

   !> A key of the table: what the file has for it, else its value stays.
   subroutine read_from_file(self, key, value)
      class(key_reader_t), intent(inout) :: self
      type(key_t), intent(in) :: key
      type(key_value_t), intent(inout) :: value
      type(value_t), allocatable :: item
      character(len=:), allocatable :: problem

      call self%file%value_of(key%group, key%name, item, self%error)
      if (.not. allocated(item)) return
      call read_key(key, item, value, problem)
      call self%file%refuse(key%group, key%name, problem, self%error, item%line)
      self%is_given(key%number) = .true.
   end subroutine read_from_file

   !> Give values to some keys.
   subroutine set(self, numbers, values)
      class(case_input_t), intent(inout) :: self
      integer, intent(in) :: numbers(:)              !! of the keys
      type(key_value_t), intent(in) :: values(:)     !! one for each
      type(setter_t) :: setter
      integer :: i

      if (size(numbers) == 0) return
      do i = 1, size(numbers)
         setter%is_set(numbers(i)) = .true.
         setter%values(numbers(i)) = values(i)
      end do
      call visit_case_keys(self%case, setter)
      self%is_given = self%is_given .or. setter%is_set
   end subroutine set

   subroutine put(self, key, value)
      class(setter_t), intent(inout) :: self
      type(key_t), intent(in) :: key
      type(key_value_t), intent(inout) :: value
      if (self%is_set(key%number)) value = self%values(key%number)
   end subroutine put

end module ehlwave_case_input
