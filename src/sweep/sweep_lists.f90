!> Lists of the &sweep group and all their combinations.
module ehlwave_sweep_lists
   use ehlwave_case_input, only: case_input_t
   use ehlwave_case_key, only: key_length, key_t, key_value_t, value_text
   use ehlwave_errors, only: error_t, raise
   use ehlwave_identity_index, only: identity_index_t, text_identity
   use ehlwave_kinds, only: dp
   use ehlwave_key_bounds, only: read_key
   use ehlwave_key_list, only: find_key, key_list_t
   use ehlwave_namelist, only: namelist_t
   use ehlwave_namelist_scanner, only: value_t
   use ehlwave_sweep_cases, only: refuse_too_many
   use ehlwave_sweep_keys, only: f_v_key, sweep_group
   implicit none (type, external)
   private
   public :: read_lists

   !> Values of a key.
   type :: list_t
      integer :: key = 0                             ! number of the key, 0: f_v
      type(key_value_t), allocatable :: values(:)
   end type list_t

   !> The combinations, in order.
   type, public :: sweep_lists_t
      integer, allocatable :: keys(:)                !! numbers of the keys that have a list, f_v excepted
      logical :: has_f_v = .false.
      type(list_t), allocatable, private :: lists(:) ! the fastest-varying key last
      integer, allocatable, private :: at(:)         ! place in each list
   contains
      procedure :: combinations
      procedure :: next
      procedure :: put
   end type sweep_lists_t

   !> These vary fastest, the last most; all others slower, in the order of the table.
   character(len=key_length), parameter :: fast(5) = [character(len=key_length) :: 'radius_ratio_d', &
      'lubricant_parameter_l', 'load_parameter_m', 'orientation', 'wavelength_over_a']

contains

   !> Read the lists of all keys of a table, and f_v. Fails on values that a key refuses, on keys that cannot vary, and
   !> on more combinations than a sweep may have.
   subroutine read_lists(file, table, self, error)
      type(namelist_t), intent(inout) :: file
      type(key_list_t), intent(in) :: table          !! with the defaults
      type(sweep_lists_t), intent(out) :: self
      type(error_t), allocatable, intent(inout) :: error
      integer :: i, order(table%count), quick(size(fast))

      quick = [(find_key(table%keys, fast(i)), i=1, size(fast))]
      order = [pack([(i, i=1, table%count)], [(all(quick /= i), i=1, table%count)]), quick]
      allocate (self%lists(0))
      do i = 1, size(order)
         call read_list(file, table%keys(order(i)), order(i), self%lists, error)
      end do
      self%keys = self%lists%key
      call read_list(file, f_v_key, 0, self%lists, error)
      if (allocated(error)) return
      self%has_f_v = size(self%lists) > size(self%keys)
      if (self%has_f_v .and. any(self%keys == quick(size(quick)))) then
         call raise(error, file%place(sweep_group, 'f_v')// &
            '&sweep gives wavelength_over_a and f_v: give one of the two')
         return
      end if
      call refuse_too_many(file%place(sweep_group, '')//'the lists of &sweep have ', self%combinations(), &
         ' combinations', error)
   end subroutine read_lists

   !> Append the list of a key, if the file has it. Repeated values count once.
   subroutine read_list(file, key, number, lists, error)
      type(namelist_t), intent(inout) :: file
      type(key_t), intent(in) :: key
      integer, intent(in) :: number
      type(list_t), allocatable, intent(inout) :: lists(:)
      type(error_t), allocatable, intent(inout) :: error
      type(value_t), allocatable :: items(:)
      type(list_t) :: list
      character(len=:), allocatable :: problem
      type(identity_index_t) :: known
      type(key_value_t) :: value
      integer :: i, place

      call file%values_of(sweep_group, key%name, items, error)
      if (.not. allocated(items)) return
      if (.not. key%can_vary) problem = 'this key cannot vary in a sweep: remove it'
      call file%refuse(sweep_group, key%name, problem, error)
      list%key = number
      allocate (list%values(size(items)))
      do i = 1, size(items)
         if (allocated(error)) return
         call read_key(key, items(i), value, problem)
         call file%refuse(sweep_group, key%name, problem, error, items(i)%line)
         if (allocated(error)) return
         call known%add(text_identity(value_text(value)), place)
         list%values(place) = value
      end do
      list%values = list%values(:known%count)
      lists = [lists, list]
   end subroutine read_list

   !> Number of combinations.
   pure real(dp) function combinations(self)
      class(sweep_lists_t), intent(in) :: self
      integer :: i
      combinations = product([(real(size(self%lists(i)%values), dp), i=1, size(self%lists))])
   end function combinations

   !> Go to the next combination, at first to the first; false at the end. Without lists there is a single combination.
   logical function next(self)
      class(sweep_lists_t), intent(inout) :: self
      integer :: i

      next = .true.
      if (.not. allocated(self%at)) then
         allocate (self%at(size(self%lists)), source=1)
         return
      end if
      do i = size(self%at), 1, -1
         self%at(i) = self%at(i) + 1
         if (self%at(i) <= size(self%lists(i)%values)) return
         self%at(i) = 1
      end do
      next = .false.
   end function next

   !> Give the values of the combination to a case.
   subroutine put(self, input)
      class(sweep_lists_t), intent(in) :: self
      type(case_input_t), intent(inout) :: input
      type(key_value_t) :: values(size(self%keys))
      integer :: i

      do i = 1, size(self%keys)
         values(i) = self%lists(i)%values(self%at(i))
      end do
      call input%set(self%keys, values)
      if (self%has_f_v) input%f_v = self%lists(size(self%lists))%values(self%at(size(self%at)))%number
   end subroutine put

end module ehlwave_sweep_lists
