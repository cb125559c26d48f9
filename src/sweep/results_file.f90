!> HDF5 file of a sweep: a row per case over the dimension `case`, whatever its status.
!>
!> The rows are made from the sweep file (inputs) and from the store (results). Only the columns of `run_columns` are
!> named here. The others come from the table of quantities and the records.
module ehlwave_results_file
   use ehlwave_case_account, only: blank_result
   use ehlwave_case_keys, only: list_case_keys
   use ehlwave_case_record, only: make_record
   use ehlwave_errors, only: error_t
   use ehlwave_field_file, only: write_provenance
   use ehlwave_hdf5_file, only: hdf5_file_t
   use ehlwave_key_list, only: key_list_t
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_input_quantities, only: add_case, add_key
   use ehlwave_quantity, only: quantity_list_t, quantity_t
   use ehlwave_quantity_output, only: json_columns, take_json
   use ehlwave_results_column, only: column_t
   use ehlwave_status, only: status_name, status_pending
   use ehlwave_store, only: store_t
   use ehlwave_store_contents, only: add_layout, contents_t, stored_case_t
   use ehlwave_sweep_cases, only: sweep_t
   implicit none (type, external)
   private
   public :: write_results

   !> Keys that have a column in every file, besides those that vary and those that the table of quantities has.
   character(len=*), parameter :: always_shown(2) = [character(len=19) :: 'wavelength_over_a', 'amplitude_over_film']

   !> Items of the header of a log that go into the rows of its cases.
   character(len=*), parameter :: run_columns(10) = [character(len=16) :: 'run', 'job', 'program_version', &
      'git_revision', 'compiler', 'compiler_flags', 'build_type', 'library_versions', 'mpi_library', 'processor']

contains

   !> Write all rows. The file appears under its name only when it is complete.
   !> Fails when it cannot be written.
   subroutine write_results(path, sweep_text, sweep, contents, error)
      character(len=*), intent(in) :: path
      character(len=*), intent(in) :: sweep_text       !! the sweep file as it was
      type(sweep_t), intent(in) :: sweep
      type(contents_t), intent(inout) :: contents      !! gets the columns of a case that has not run, if missing
      type(error_t), allocatable, intent(inout) :: error
      type(hdf5_file_t) :: file
      type(store_t) :: no_store
      type(quantity_list_t) :: table                   ! all quantities that a record can have
      integer :: place(size(sweep%cases))              ! in the contents; 0: not there
      integer :: i, layout, n

      n = size(sweep%cases)
      call make_record(sweep%cases(1), sweep%plans(1), sweep%identity(1), &
                       blank_result(sweep%cases(1), sweep%plans(1)), no_store, '', '', table)
      call add_layout(json_columns(table), contents, layout)
      do i = 1, n
         place(i) = contents%index%find(sweep%identity(i))
      end do
      call file%create(path, error)
      if (allocated(error)) return
      call file%attribute('title', 'ehlwave: amplitude reduction of waviness in EHL contacts')
      call file%attribute('format', 'ehlwave-results')
      call file%attribute('format_version', 1)
      call write_provenance(file)
      call file%attribute('sweep_input', sweep_text)
      call file%write('case', [(i, i=1, n)], '1', 'number of the case in the sweep')
      call file%dimension('case')
      call write_inputs(file, sweep, contents, place)
      call write_outcomes(file, sweep, contents, place, table)
      call write_runs(file, contents, place)
      call file%finish(error)
   end subroutine write_results

   !> Columns that follow from the sweep file; pending cases have them, too. For a finished case they come from its
   !> record: another version may have planned it otherwise, or an accuracy may have needed finer grids.
   subroutine write_inputs(file, sweep, contents, place)
      type(hdf5_file_t), intent(inout) :: file
      type(sweep_t), intent(in) :: sweep
      type(contents_t), intent(in) :: contents
      integer, intent(in) :: place(:)
      type(column_t), allocatable :: columns(:)
      type(quantity_list_t) :: inputs
      integer, allocatable :: number(:, :)        ! number of a column, in each layout; 0: absent
      integer :: i, k, l, own                     ! own: number of the effective input, which a record has in short
      logical :: has_all

      inputs = input_row(sweep, 1)
      own = inputs%find('effective_input')
      allocate (columns(inputs%count), number(inputs%count, size(contents%layouts)))
      do k = 1, size(columns)
         call columns(k)%init(inputs%items(k), size(sweep%cases))
         do l = 1, size(contents%layouts)
            number(k, l) = findloc(contents%layouts(l)%names == inputs%items(k)%name, .true., 1)
         end do
      end do
      do i = 1, size(sweep%cases)
         has_all = .false.
         if (place(i) > 0) has_all = contents%logs(contents%cases(place(i))%log)%is_by_this_build
         if (has_all) then
            inputs%items(own)%text = sweep%input(i)
            call take_inputs(contents%cases(place(i)), number, own, inputs, has_all)
         end if
         if (.not. has_all) then
            inputs = input_row(sweep, i)
            if (place(i) > 0) call take_inputs(contents%cases(place(i)), number, own, inputs, has_all)
         end if
         do k = 1, size(columns)
            call columns(k)%set(i, inputs%items(k))
         end do
      end do
      do k = 1, size(columns)
         call columns(k)%write(file)
      end do
   end subroutine write_inputs

   !> The values of a record that have the kind of the column; an empty text counts as missing. A record of this build
   !> that has all values that `inputs` have, and no others, needs nothing of the plan.
   subroutine take_inputs(record, number, own, inputs, has_all)
      type(stored_case_t), intent(in) :: record
      integer, intent(in) :: number(:, :), own      !! as in `write_inputs`
      type(quantity_list_t), intent(inout) :: inputs
      logical, intent(out) :: has_all
      character(len=:), allocatable :: text
      integer :: k

      has_all = .true.
      do k = 1, size(number, 1)
         if (k == own) cycle
         text = record%element(number(k, record%layout))
         associate (input => inputs%items(k))
            if (text /= '' .and. text /= '""' .and. ((index(text, '"') > 0) .eqv. (input%kind == 'text'))) then
               call take_json(text, input)
               has_all = has_all .and. input%exists
            else if (input%exists) then
               if (text == '""' .and. input%kind == 'text') then
                  has_all = has_all .and. input%text == ''
               else
                  has_all = .false.
               end if
            end if
         end associate
      end do
   end subroutine take_inputs

   !> Inputs of a case, from the sweep file and the plan, varying keys included. Choices of the plan have the name of
   !> the key.
   function input_row(sweep, case) result(row)
      type(sweep_t), intent(in) :: sweep
      integer, intent(in) :: case
      type(quantity_list_t) :: row
      type(key_list_t), save :: keys
      integer :: i

      call list_case_keys(sweep%cases(case), keys)
      call add_case(row, sweep%cases(case), keys, sweep%plans(case), sweep%identity(case))
      do i = 1, keys%count
         associate (name => keys%keys(i)%name)
            if (.not. (any(always_shown == name) .or. sweep%varies(i))) cycle
            if (row%find(trim(name)) == 0) call add_key(row, keys, trim(name))
         end associate
      end do
      call row%add('effective_input', 'case file that reproduces the case', sweep%input(case))
   end function input_row

   !> Every column of the records that the file has not yet, described as in the table of quantities. Some are made at
   !> once: the records of a large sweep are read from memory once for all of them.
   subroutine write_outcomes(file, sweep, contents, place, table)
      type(hdf5_file_t), intent(inout) :: file
      type(sweep_t), intent(in) :: sweep
      type(contents_t), intent(in) :: contents
      integer, intent(in) :: place(:)
      type(quantity_list_t), intent(in) :: table
      integer, parameter :: at_once = 16
      type(column_t) :: columns(at_once)
      type(quantity_t) :: quantities(at_once)
      integer :: number(at_once, size(contents%layouts))   ! numbers of the present columns, in each layout
      integer :: j, k, l, n, other

      n = 0
      do l = 1, size(contents%layouts)
         associate (layout => contents%layouts(l))
            do k = 1, size(layout%names)
               if (file%has(trim(layout%names(k))) .or. any([(quantities(j)%name == layout%names(k), j=1, n)])) cycle
               n = n + 1
               quantities(n) = described(table, trim(layout%names(k)), layout%kinds(k))
               do other = 1, size(contents%layouts)
                  number(n, other) = findloc(contents%layouts(other)%names, layout%names(k), 1)
               end do
               if (n == at_once) call write_columns()
            end do
         end associate
      end do
      call write_columns()

   contains

      subroutine write_columns()
         integer :: i

         do j = 1, n
            call columns(j)%init(quantities(j), size(place))
         end do
         do i = 1, size(place)
            do j = 1, n
               if (place(i) > 0) then
                  associate (record => contents%cases(place(i)))
                     call take_json(record%element(number(j, record%layout)), quantities(j))
                  end associate
               else
                  call take_pending(sweep%plans(i), quantities(j))
               end if
               call columns(j)%set(i, quantities(j))
            end do
         end do
         do j = 1, n
            call columns(j)%write(file)
         end do
         n = 0
      end subroutine write_columns

   end subroutine write_outcomes

   !> A column as the table describes it; a column of another version, absent from the table, keeps its name.
   function described(table, name, kind) result(quantity)
      type(quantity_list_t), intent(in) :: table
      character(len=*), intent(in) :: name, kind
      type(quantity_t) :: quantity
      if (table%find(name) > 0) then
         quantity = table%items(table%find(name))
      else
         quantity%name = name
         quantity%long_name = name
         quantity%unit = '1'
      end if
      quantity%kind = kind
      quantity%exists = .true.
   end function described

   !> The outcome of a case that has not run.
   subroutine take_pending(plan, quantity)
      type(case_plan_t), intent(in) :: plan
      type(quantity_t), intent(inout) :: quantity
      call take_json('', quantity)
      if (quantity%name == 'status') quantity%text = status_name(status_pending)
      if (quantity%name == 'message') quantity%text = plan%resolution%reason
      if (quantity%name == 'is_resolved') quantity%number = merge(1, 0, plan%resolution%is_resolved)
   end subroutine take_pending

   !> Which run of which build made each row.
   subroutine write_runs(file, contents, place)
      type(hdf5_file_t), intent(inout) :: file
      type(contents_t), intent(in) :: contents
      integer, intent(in) :: place(:)
      type(store_t) :: no_store
      type(quantity_list_t) :: header
      type(quantity_t) :: quantity
      type(column_t) :: column
      character(len=:), allocatable :: text
      integer :: i, k

      header = no_store%header()
      do k = 1, header%count
         quantity = header%items(k)
         if (.not. any(run_columns == quantity%name)) cycle
         call column%init(quantity, size(place))
         do i = 1, size(place)
            text = ''
            if (place(i) > 0) text = contents%logs(contents%cases(place(i))%log)%element(quantity%name)
            call take_json(text, quantity)
            call column%set(i, quantity)
         end do
         call column%write(file)
      end do
   end subroutine write_runs

end module ehlwave_results_file
