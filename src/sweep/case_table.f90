!> Reads a sweep file: its cases are the combinations of lists, or the rows of a CSV file.
module ehlwave_case_table
   use ehlwave_case_input, only: case_input_t, read_keys
   use ehlwave_case_key, only: is_same, most_keys
   use ehlwave_case_keys, only: case_key_list, case_values, default_keys
   use ehlwave_case_row, only: find_columns, set_row
   use ehlwave_csv, only: csv_t, read_csv
   use ehlwave_errors, only: error_t, raise
   use ehlwave_key_bounds, only: is_none
   use ehlwave_key_list, only: find_key, key_list_t
   use ehlwave_kinds, only: dp
   use ehlwave_namelist, only: namelist_t
   use ehlwave_store_names, only: newest_defaults, store_path
   use ehlwave_sweep_cases, only: refuse_too_many, sweep_t
   use ehlwave_sweep_defaults, only: choose_defaults, edges_of_old_stores
   use ehlwave_sweep_keys, only: sweep_group, sweep_settings_t, visit_sweep_keys
   use ehlwave_sweep_lists, only: read_lists, sweep_lists_t
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: read_output_name, read_sweep

contains

   !> Read a sweep file. Its cases have the defaults that its store was begun with. Fails when it, its CSV file or any
   !> of its cases is not right.
   subroutine read_sweep(path, sweep, error, output, begins_anew)
      character(len=*), intent(in) :: path
      type(sweep_t), intent(out) :: sweep
      type(error_t), allocatable, intent(out) :: error
      character(len=*), intent(in), optional :: output   !! results file, in place of the sweep file's
      logical, intent(in), optional :: begins_anew       !! the store, if any, will be dropped
      type(namelist_t) :: file
      type(sweep_settings_t) :: settings
      type(case_input_t) :: base
      type(key_list_t) :: table
      type(sweep_lists_t) :: lists
      type(csv_t) :: rows
      integer, allocatable :: columns(:)
      character(len=:), allocatable :: found
      logical :: goes_on, is_old

      call file%load(path, error)
      call read_settings(file, settings, error)
      sweep%output = trim(settings%output)
      if (present(output)) sweep%output = output
      goes_on = .true.
      if (present(begins_anew)) goes_on = .not. begins_anew
      sweep%defaults = newest_defaults
      found = ''
      if (goes_on) call choose_defaults(store_path(sweep%output), sweep%defaults, found, error)
      is_old = sweep%defaults == 0
      if (is_old) base%case%edges = edges_of_old_stores
      call base%read(file, error)
      table = default_keys()
      call read_lists(file, table, lists, error)
      call file%check_all_used(error)
      if (allocated(error)) return
      if (settings%case_file /= '' .and. (size(lists%keys) > 0 .or. lists%has_f_v)) then
         call raise(error, file%place(sweep_group, 'case_file')// &
            '&sweep gives case_file and lists: give one of the two')
         return
      end if
      base%may_idle = base%is_given
      sweep%limits = settings%limits
      sweep%limits%threads = base%case%threads
      sweep%files = [character(len=max(len(path), len_trim(settings%case_file))) :: path, settings%case_file]
      if (settings%case_file /= '') then
         call read_csv(trim(settings%case_file), rows, error)
         if (.not. allocated(error)) call refuse_too_many(rows%path//': has ', real(size(rows%line), dp), ' rows', &
            error)
         call find_columns(rows, table, columns, error)
         if (allocated(error)) return
         call sweep%begin(size(rows%line), settings%unresolved == 'skip')
         call add_rows(rows, columns, file, base, table, sweep, error)
      else
         call sweep%begin(nint(lists%combinations()), settings%unresolved == 'skip')
         call add_product(file, base, table, lists, sweep, error)
      end if
      if (allocated(error)) return
      call sweep%finish()
      sweep%notice = sweep%notice//found
      if (is_old .and. any(sweep%cases%edges == edges_of_old_stores) .and. .not. says(base, table, sweep, 'edges')) &
         sweep%notice = sweep%notice//"NOTICE: the store of "//sweep%output//" was begun when edges were '"// &
         edges_of_old_stores//"' by default: its cases keep this; &grid edges in the sweep file overrides it"// &
         new_line('a')
      if (size(sweep%cases) == 0) call raise(error, path//': no cases are left to run'// &
         merge(' (all are unresolved)', '                     ', sweep%skipped > 0))
   end subroutine read_sweep

   !> Whether a sweep file gives a key, by a group, a list or a column.
   pure logical function says(base, table, sweep, name)
      type(case_input_t), intent(in) :: base
      type(key_list_t), intent(in) :: table
      type(sweep_t), intent(in) :: sweep
      character(len=*), intent(in) :: name
      integer :: key
      key = find_key(table%keys, name)
      says = base%is_given(key) .or. sweep%varies(key)
   end function says

   !> The results file that a sweep file names.
   subroutine read_output_name(path, output, error)
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(out) :: output
      type(error_t), allocatable, intent(inout) :: error
      type(namelist_t) :: file
      type(sweep_settings_t) :: settings
      call file%load(path, error)
      call read_settings(file, settings, error)
      output = trim(settings%output)
   end subroutine read_output_name

   !> The settings of the sweep itself in a sweep file.
   subroutine read_settings(file, settings, error)
      type(namelist_t), intent(inout) :: file
      type(sweep_settings_t), intent(inout) :: settings
      type(error_t), allocatable, intent(inout) :: error
      type(key_list_t) :: list
      logical :: is_given(most_keys)
      call visit_sweep_keys(settings, list)
      call read_keys(file, list, is_given, error)
      list%gives_back = .true.
      call visit_sweep_keys(settings, list)
   end subroutine read_settings

   !> Every combination of the lists; a list replaces the value in the group of its key.
   subroutine add_product(file, base, table, lists, sweep, error)
      type(namelist_t), intent(in) :: file
      type(case_input_t), intent(inout) :: base
      type(key_list_t), intent(in) :: table
      type(sweep_lists_t), intent(inout) :: lists
      type(sweep_t), intent(inout) :: sweep
      type(error_t), allocatable, intent(inout) :: error
      type(case_input_t) :: input
      logical :: is_used(most_keys)

      call sweep%vary(lists%keys, lists%has_f_v)
      call note_replaced(file, base, table, sweep)
      base%may_idle(lists%keys) = .true.
      if (lists%has_f_v) base%may_idle(find_key(table%keys, 'wavelength_over_a')) = .true.
      is_used = .false.
      do while (lists%next())
         input = base
         call lists%put(input)
         call sweep%add(input, table, file%path//': ', error)
         if (allocated(error)) return
         is_used = is_used .or. input%is_given
      end do
      base%is_given(lists%keys) = .true.
      if (lists%has_f_v .and. .not. is_used(find_key(table%keys, 'wavelength_over_a'))) then
         call raise(error, file%place(sweep_group, 'f_v')//"key 'f_v' in &"//sweep_group//': belongs to '// &
                    trim(table%keys(find_key(table%keys, 'wavelength_over_a'))%when)//', which none of the cases '// &
                    'has: remove it, or set what it belongs to')
      else
         call refuse_idle(file, base, table, lists%keys, is_used, error)
      end if
   end subroutine add_product

   !> A case per row of a CSV file; its columns replace the values in the groups of their keys.
   subroutine add_rows(rows, columns, file, base, table, sweep, error)
      type(csv_t), intent(in) :: rows
      integer, intent(in) :: columns(:)                !! number of the key of each column, 0: f_v
      type(namelist_t), intent(in) :: file
      type(case_input_t), intent(in) :: base
      type(key_list_t), intent(in) :: table
      type(sweep_t), intent(inout) :: sweep
      type(error_t), allocatable, intent(inout) :: error
      type(case_input_t) :: input
      type(key_list_t) :: given
      logical :: is_said(most_keys), is_used(most_keys)   ! used: a row differs from the default
      integer, allocatable :: doubtful(:)                 ! keys of columns that may count nowhere
      integer :: row

      call sweep%vary(pack(columns, columns > 0), any(columns == 0))
      doubtful = pack(columns, columns > 0)
      doubtful = pack(doubtful, .not. (table%keys(doubtful)%counts .or. table%keys(doubtful)%is_effort))
      call note_replaced(file, base, table, sweep)
      is_said = .false.
      is_used = .false.
      do row = 1, size(rows%line)
         input = base
         call set_row(rows, row, table, columns, input, error)
         if (.not. all(is_said(doubtful))) then
            given = case_values(input%case)
            is_said(doubtful) = is_said(doubtful) .or. .not. is_same(given%values(doubtful), table%values(doubtful))
         end if
         call sweep%add(input, table, rows%path//':'//to_text(rows%line(row))//': ', error)
         if (allocated(error)) return
         is_used = is_used .or. input%is_given
      end do
      call refuse_idle_column(rows, table, pack(doubtful, is_said(doubtful) .and. .not. is_used(doubtful)), error)
      is_used(pack(columns, columns > 0)) = .true.
      call refuse_idle(file, base, table, [integer ::], is_used, error)
   end subroutine add_rows

   !> Report keys of the case groups that have no effect, since lists or columns take their place.
   subroutine note_replaced(file, base, table, sweep)
      type(namelist_t), intent(in) :: file
      type(case_input_t), intent(in) :: base
      type(key_list_t), intent(in) :: table
      type(sweep_t), intent(inout) :: sweep
      integer :: i

      sweep%notice = ''
      do i = 1, table%count
         if (.not. (base%is_given(i) .and. any(sweep%varied == i))) cycle
         associate (key => table%keys(i))
            sweep%notice = sweep%notice//'NOTICE: '//file%place(trim(key%group), trim(key%name))//trim(key%name)// &
               ' of &'//trim(key%group)//' gives way to the values that the sweep lists for it'//new_line('a')
         end associate
      end do
   end subroutine note_replaced

   !> Refuse a column whose values count in none of the rows.
   subroutine refuse_idle_column(rows, table, idle, error)
      type(csv_t), intent(in) :: rows
      type(key_list_t), intent(in) :: table
      integer, intent(in) :: idle(:)                   !! numbers of the keys of such columns
      type(error_t), allocatable, intent(inout) :: error

      if (size(idle) == 0) return
      associate (key => table%keys(idle(1)))
         call raise(error, rows%path//": column '"//trim(key%name)//"': belongs to "//trim(key%when)// &
                    ', which none of the rows has: remove it, or set what it belongs to')
      end associate
   end subroutine refuse_idle_column

   !> Refuse a key that is given, differs from the default and applies to no case.
   subroutine refuse_idle(file, base, table, listed, is_used, error)
      type(namelist_t), intent(in) :: file
      type(case_input_t), intent(in) :: base
      type(key_list_t), intent(in) :: table            !! with the defaults
      integer, intent(in) :: listed(:)                 !! numbers of the keys that have lists
      logical, intent(in) :: is_used(:)
      type(error_t), allocatable, intent(inout) :: error
      type(key_list_t) :: given
      character(len=:), allocatable :: group, name
      integer :: i

      given = case_key_list(base%case)
      do i = 1, table%count
         if (is_used(i) .or. .not. base%is_given(i)) cycle
         group = trim(table%keys(i)%group)
         if (any(listed == i)) then
            group = sweep_group
         else if (is_none(given%values(i), table%values(i))) then
            cycle
         else if (.not. table%keys(i)%counts .and. is_same(given%values(i), table%values(i))) then
            cycle                                      ! the default, which is in use all the same
         end if
         name = trim(table%keys(i)%name)
         call raise(error, file%place(group, name)//"key '"//name//"' in &"//group//': belongs to '// &
                    trim(table%keys(i)%when)//', which none of the cases has: remove it, or set '// &
                    'what it belongs to')
         return
      end do
   end subroutine refuse_idle

end module ehlwave_case_table
