!> Rows of a CSV file of cases.
module ehlwave_case_row
   use ehlwave_case_input, only: case_input_t
   use ehlwave_case_key, only: key_t, key_value_t, number_kind, whole_kind, word_kind
   use ehlwave_csv, only: csv_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   use ehlwave_key_bounds, only: read_key, says_none, says_nothing => is_none
   use ehlwave_key_list, only: find_key, key_list_t
   use ehlwave_namelist_scanner, only: value_t
   use ehlwave_namelist_values, only: read_value
   use ehlwave_spelling, only: nearest_word
   use ehlwave_sweep_keys, only: f_v_key
   use ehlwave_text, only: shown, to_text
   implicit none (type, external)
   private
   public :: find_columns, set_row

contains

   !> Number of the key of each column, 0: f_v. Fails on columns that are none, or of keys that cannot vary.
   subroutine find_columns(table, list, columns, error)
      type(csv_t), intent(in) :: table
      type(key_list_t), intent(in) :: list
      integer, allocatable, intent(out) :: columns(:)
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: problem
      integer :: i, near

      if (allocated(error)) return
      allocate (columns(size(table%names)), source=0)
      do i = 1, size(columns)
         if (table%names(i) == f_v_key%name) cycle
         columns(i) = find_key(list%keys, trim(table%names(i)))
         if (columns(i) > 0) then
            if (list%keys(columns(i))%can_vary) cycle
            problem = 'this key cannot vary in a sweep: remove it'
         else
            problem = 'unknown: columns are named as the keys of a case, or f_v (ehlwave-sweep --keys lists them)'
            near = nearest_word(table%names(i), list%keys(:list%count)%name)
            if (index(table%names(i), ';') > 0) problem = 'columns are separated by commas: write , for ;'
            if (near > 0) problem = "unknown: did you mean '"//trim(list%keys(near)%name)//"'?"
         end if
         call raise(error, table%path//": column '"//shown(trim(table%names(i)))//"': "//problem)
         return
      end do
   end subroutine find_columns

   !> Give the values of a row to a case. An empty cell keeps the value of the case groups. 0 in a key without default
   !> (a wavelength, an end time) means none. Any other value of such a key must apply to the row. Keys that need a
   !> value in every row (cells_y beside line contacts) are ignored where they do not apply.
   subroutine set_row(table, row, list, columns, input, error)
      type(csv_t), intent(in) :: table
      integer, intent(in) :: row
      type(key_list_t), intent(in) :: list             !! keys with their defaults
      integer, intent(in) :: columns(:)
      type(case_input_t), intent(inout) :: input
      type(error_t), allocatable, intent(inout) :: error
      type(key_value_t) :: f_v, values(size(columns))
      type(value_t) :: item
      logical :: is_none(size(columns)), is_set(size(columns))
      integer :: i

      is_set = .false.
      is_none = .false.
      do i = 1, size(columns)
         if (allocated(error)) return
         item%text = table%cell(i, row)
         if (item%text == '') cycle
         if (columns(i) == 0) then
            call read_cell(table, row, i, f_v_key, item, key_value_t(kind=number_kind), f_v, is_none(i), error)
            input%f_v = f_v%number
         else
            is_set(i) = .true.
            call read_cell(table, row, i, list%keys(columns(i)), item, list%values(columns(i)), values(i), is_none(i), &
               error)
         end if
      end do
      if (allocated(error)) return
      call input%set(pack(columns, is_set), pack(values, is_set))
      input%is_given(pack(columns, is_set .and. is_none)) = .false.
      do i = 1, size(columns)
         if (is_set(i)) input%may_idle(columns(i)) = .not. says_nothing(list%values(columns(i)), &
            list%values(columns(i)))
      end do
      if (.not. input%f_v > 0) return
      i = find_key(list%keys, 'wavelength_over_a')
      if (any(columns == i .and. is_set .and. .not. is_none)) call raise(error, table%path//':'// &
         to_text(table%line(row))//': gives wavelength_over_a and f_v: give one of the two')
      input%may_idle(i) = .false.
   end subroutine set_row

   !> Value of a cell. Words need no quotes in a table, and a whole number may be written as 64.0.
   subroutine read_cell(table, row, column, key, item, default, value, is_none, error)
      type(csv_t), intent(in) :: table
      integer, intent(in) :: row, column
      type(key_t), intent(in) :: key
      type(value_t), intent(inout) :: item
      type(key_value_t), intent(in) :: default
      type(key_value_t), intent(inout) :: value
      logical, intent(out) :: is_none                  !! the cell means none
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: problem
      real(dp) :: number

      item%is_quoted = key%kind == word_kind
      is_none = says_none(key, item, default)
      value = default
      if (is_none) return
      if (key%kind == whole_kind) then
         call read_value(item, number, problem)
         if (.not. allocated(problem) .and. abs(number) < 1e9_dp) then
            if (abs(number - nint(number)) <= 0) item%text = to_text(nint(number))
         end if
         if (allocated(problem)) deallocate (problem)
      end if
      call read_key(key, item, value, problem)
      if (allocated(problem)) call raise(error, table%place(column, row)//problem)
   end subroutine read_cell

end module ehlwave_case_row
