!> The input of a case: values as given by the user, and the given keys.
module ehlwave_case_input
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_key, only: key_length, key_t, key_value_t, most_keys
   use ehlwave_case_keys, only: list_case_keys, take_values
   use ehlwave_effects_keys, only: effect_count
   use ehlwave_errors, only: error_t, raise
   use ehlwave_key_bounds, only: read_key
   use ehlwave_key_list, only: find_key, key_list_t
   use ehlwave_kinds, only: dp
   use ehlwave_namelist, only: namelist_t
   use ehlwave_namelist_scanner, only: value_t
   implicit none (type, external)
   private
   public :: read_keys

   character(len=*), parameter :: former_limit = 'limiting_stress_over_pressure'   !! a key of before version 2

   !> A case as it is given, still to be completed.
   type, public :: case_input_t
      type(case_t) :: case
      logical :: is_given(most_keys) = .false.     !! by number of the key
      logical :: may_idle(most_keys) = .false.     !! given for many cases: left out where it does not apply
      real(dp) :: f_v = 0                          !! f(r) V asked for in place of a wavelength; 0: none
   contains
      procedure :: read => read_groups
      procedure :: set
   end type case_input_t

contains

   !> Values for the keys of a list from a file; those that it does not give stay. Fails on values that a key refuses.
   subroutine read_keys(file, list, is_given, error)
      type(namelist_t), intent(inout) :: file        !! loaded
      type(key_list_t), intent(inout) :: list
      logical, intent(inout) :: is_given(:)          !! by number of the key
      type(error_t), allocatable, intent(inout) :: error
      type(value_t), allocatable :: item
      character(len=:), allocatable :: problem
      character(len=key_length) :: name
      integer :: k

      do k = 1, list%count
         associate (key => list%keys(k))
            name = key%name
            call file%value_of(key%group, name, item, error)
            if (key%short /= '' .and. file%has_group(key%group)) call take_short(file, key, name, item, error)
            if (.not. allocated(item)) cycle
            call read_key(key, item, list%values(k), problem)
            call file%refuse(key%group, name, problem, error, item%line)
            is_given(k) = .true.
         end associate
      end do
   end subroutine read_keys

   !> The value of a key by its short name, where the file has that in place of the whole name.
   subroutine take_short(file, key, name, item, error)
      type(namelist_t), intent(inout) :: file
      type(key_t), intent(in) :: key
      character(len=*), intent(inout) :: name        !! name in the file
      type(value_t), allocatable, intent(inout) :: item   !! by the whole name, if any
      type(error_t), allocatable, intent(inout) :: error
      type(value_t), allocatable :: short
      character(len=:), allocatable :: problem

      call file%value_of(key%group, key%short, short, error)
      if (.not. allocated(short)) return
      if (allocated(item)) then
         problem = 'is the same key as '//trim(key%name)//': give one of the two'
         call file%refuse(key%group, key%short, problem, error, short%line)
      end if
      name = key%short
      call move_alloc(short, item)
   end subroutine take_short

   !> The keys that the groups of a case give in a file.
   subroutine read_groups(self, file, error)
      class(case_input_t), intent(inout) :: self
      type(namelist_t), intent(inout) :: file        !! loaded
      type(error_t), allocatable, intent(inout) :: error
      type(key_list_t), save :: list
      type(value_t), allocatable :: item
      character(len=:), allocatable :: group, problem
      integer :: k, n

      call list_case_keys(self%case, list)
      call read_keys(file, list, self%is_given, error)
      call file%value_of('lubricant', former_limit, item, error)
      if (allocated(item)) then
         problem = 'is replaced by shear_limit_over_pressure, which limits the stress in the equations: write that'
         call file%refuse('lubricant', former_limit, problem, error, item%line)
      end if
      call take_values(list, self%case)
      do k = 1, effect_count
         n = find_key(list%keys(:list%count), self%case%effects%mandatory_key(k))
         if (n == 0) cycle
         group = trim(list%keys(n)%group)
         if (any(self%is_given(:list%count) .and. list%keys(:list%count)%group == group)) cycle
         if (.not. allocated(error) .and. file%has_group(group)) call raise(error, file%place(group, '')//'&'// &
            group//' needs '//trim(list%keys(n)%name)//': give it, or remove the group')
      end do
   end subroutine read_groups

   !> Give values to some keys.
   subroutine set(self, numbers, values)
      class(case_input_t), intent(inout) :: self
      integer, intent(in) :: numbers(:)              !! numbers of the keys
      type(key_value_t), intent(in) :: values(:)     !! one per key
      type(key_list_t) :: list

      allocate (list%values(most_keys))
      list%values(numbers) = values
      list%given_back = numbers
      call take_values(list, self%case)
      self%is_given(numbers) = .true.
   end subroutine set

end module ehlwave_case_input
