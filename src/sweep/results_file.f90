!> HDF5 file of a sweep: one row per case over the dimension `case`, whatever its status.
!>
!> The rows are made from the sweep file (what each case is) and from the store (what it came to). Every column that
!> a record of the store has becomes a dataset, without being named here.
module ehlwave_results_file
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_quiet_nan, ieee_value
   use ehlwave_case_account, only: blank_result
   use ehlwave_case_json, only: result_json
   use ehlwave_case_table, only: sweep_t
   use ehlwave_case_text, only: effective_input, effective_length, text_identity
   use ehlwave_column_names, only: describe_column
   use ehlwave_errors, only: error_t, raise
   use ehlwave_field_file, only: write_provenance
   use ehlwave_hdf5_file, only: hdf5_file_t
   use ehlwave_json, only: json_t
   use ehlwave_json_reader, only: json_number, json_string, split_list
   use ehlwave_kinds, only: dp
   use ehlwave_status, only: status_name, status_pending
   use ehlwave_store_contents, only: add_layout, contents_t, element, run_element
   use ehlwave_text_difference, only: text_from_difference
   implicit none (type, external)
   private
   public :: write_results

   integer, parameter :: longest_text = 4096      !! of a column; what is longer is cut

   !> What of the header of a log goes into the rows of its cases.
   character(len=*), parameter :: run_columns(8) = [character(len=16) :: 'run', 'job', 'program_version', 'git_revision', &
                                                   'compiler', 'compiler_flags', 'library_versions', 'mpi_library']

contains

   !> Write all rows. The file appears under its name only when it is complete.
   !> Fails when it cannot be written, or when a record does not belong to the case whose identity it has.
   subroutine write_results(path, sweep_text, sweep, contents, error)
      character(len=*), intent(in) :: path
      character(len=*), intent(in) :: sweep_text       !! the sweep file as it was
      type(sweep_t), intent(in) :: sweep
      type(contents_t), intent(inout) :: contents      !! gets the columns of a case that has not run, if missing
      type(error_t), allocatable, intent(inout) :: error
      type(hdf5_file_t) :: file
      type(json_t) :: blank
      integer :: place(size(sweep%cases))              ! in the contents; 0: not there
      integer :: i, layout, n

      n = size(sweep%cases)
      blank = result_json(sweep%cases(1), sweep%plans(1), blank_result(sweep%cases(1), sweep%plans(1)))
      call add_layout(blank%column_list(), contents, layout)
      do i = 1, n
         place(i) = contents%index%find(sweep%identity(i))
      end do
      call check_inputs(contents, place, error)
      if (allocated(error)) return
      call file%create(path, error)
      if (allocated(error)) return
      call file%attribute('', 'title', 'ehlwave: amplitude reduction of waviness in EHL contacts')
      call file%attribute('', 'format', 'ehlwave-results')
      call file%attribute('', 'format_version', 1)
      call write_provenance(file)
      call file%attribute('', 'sweep_input', sweep_text)
      call file%write('case', [(i, i=1, n)], '', '1', 'number of the case in the sweep')
      call file%dimension('case')
      call write_inputs(file, sweep, contents, place)
      call write_status(file, sweep, contents, place)
      call write_outcomes(file, contents, place)
      call write_runs(file, contents, place)
      call file%finish(error)
   end subroutine write_results

   !> The effective input that a record holds must have the identity of its case.
   subroutine check_inputs(contents, place, error)
      type(contents_t), intent(in) :: contents
      integer, intent(in) :: place(:)
      type(error_t), allocatable, intent(inout) :: error
      integer :: i
      do i = 1, size(place)
         if (place(i) == 0) cycle
         if (text_identity(stored_input(contents, place(i))) == contents%cases(place(i))%identity) cycle
         call raise(error, 'the store has a record of case '//contents%cases(place(i))%identity//' with the input of '// &
                    'another case: keep the store for inspection and name another results file')
         return
      end do
   end subroutine check_inputs

   !> Effective input of a stored case.
   function stored_input(contents, place) result(text)
      type(contents_t), intent(in) :: contents
      integer, intent(in) :: place
      character(len=:), allocatable :: text
      associate (record => contents%cases(place))
         text = ''
         if (allocated(contents%logs(record%log)%base_input)) text = text_from_difference( &
            contents%logs(record%log)%base_input, &
            json_string(element(contents%layouts(record%layout), record, 'effective_input')))
      end associate
   end function stored_input

   !> Columns that follow from the sweep file alone; pending cases have them, too.
   subroutine write_inputs(file, sweep, contents, place)
      type(hdf5_file_t), intent(inout) :: file
      type(sweep_t), intent(in) :: sweep
      type(contents_t), intent(in) :: contents
      integer, intent(in) :: place(:)
      character(len=effective_length), allocatable :: inputs(:)
      logical :: is_resolved(size(place))
      integer :: i

      call file%write('case_id', sweep%identity, 'case', '', 'identity of the effective input')
      associate (cases => sweep%cases, plans => sweep%plans)
         call file%write('orientation', cases%orientation, 'case', '', 'orientation of the waviness')
         call reals('load_parameter_m', plans%conditions%m, 'Moes load parameter M')
         call reals('lubricant_parameter_l', plans%conditions%l, 'Moes lubricant parameter L')
         call reals('radius_ratio_d', plans%conditions%d, 'D = Rx/Ry')
         call reals('slip_parameter', cases%slip_parameter, 'speed of the wavy surface over the mean speed')
         call reals('wavelength_over_a', cases%wavelength_over_a, 'shorter wavelength over a, 0: smooth')
         call reals('wavelength_x_over_a', cases%wavelength_x_over_a, 'lambda_x/a, 0: no variation along x')
         call reals('wavelength_y_over_a', cases%wavelength_y_over_a, 'lambda_y/a, 0: no variation along y')
         call file%write('response', cases%response, 'case', '', 'transient, harmonic (small waves) or both')
         call reals('amplitude_over_film', cases%amplitude_over_film, 'Ai over the smooth central film')
         call reals('kappa', plans%conditions%elliptic%kappa, 'ellipticity a/b')
         call reals('gamma', plans%conditions%gamma, 'pressure factor of the ellipticity')
         call reals('alphabar', plans%conditions%alphabar, 'alpha ph')
         call reals('lambdabar', plans%conditions%lambdabar, 'dimensionless speed parameter')
         call file%write('cells_x', plans%cells_x, 'case', '1', 'cells along X')
         call file%write('cells_y', plans%cells_y, 'case', '1', 'cells along Y, whole domain')
         call reals('points_per_wave_x', plans%resolution%points_x, 'mesh sizes per wave along X')
         call reals('points_per_wave_y', plans%resolution%points_y, 'mesh sizes per wave along Y')
         call file%write('deformation', plans%deformation, 'case', '', 'fft or mlmi on the finest grid')
         call reals('inlet_resolution', plans%resolution%inlet, 'hX over the length of the inlet pressure sweep')
         call reals('inlet_gap_over_film', plans%resolution%inlet_gap, 'gap at x_min over the film of the formula')
         is_resolved = plans%resolution%is_resolved
         do i = 1, size(place)            ! only a case that has run shows whether its surfaces touch
            if (place(i) == 0) cycle
            associate (record => contents%cases(place(i)))
               is_resolved(i) = is_resolved(i) .and. &
                  json_number(element(contents%layouts(record%layout), record, 'is_resolved')) > 0.5_dp
            end associate
         end do
         call file%write('is_resolved', merge(1, 0, is_resolved), 'case', '1', '1 when the grid resolves the case')
         allocate (inputs(size(cases)))
         do i = 1, size(cases)
            inputs(i) = effective_input(cases(i))
         end do
         call file%write('effective_input', inputs, 'case', '', 'case file that reproduces the case')
      end associate

   contains

      subroutine reals(name, values, long_name)
         character(len=*), intent(in) :: name, long_name
         real(dp), intent(in) :: values(:)
         call file%write(name, values, 'case', '1', long_name)
      end subroutine reals

   end subroutine write_inputs

   subroutine write_status(file, sweep, contents, place)
      type(hdf5_file_t), intent(inout) :: file
      type(sweep_t), intent(in) :: sweep
      type(contents_t), intent(in) :: contents
      integer, intent(in) :: place(:)
      character(len=16) :: status(size(place))
      character(len=256) :: message(size(place))
      integer :: i
      status = status_name(status_pending)
      message = ''
      do i = 1, size(place)
         if (place(i) == 0) then
            if (.not. sweep%plans(i)%resolution%is_resolved) message(i) = sweep%plans(i)%resolution%reason
            cycle
         end if
         associate (record => contents%cases(place(i)))
            status(i) = json_string(element(contents%layouts(record%layout), record, 'status'))
            message(i) = json_string(element(contents%layouts(record%layout), record, 'message'))
         end associate
      end do
      call file%write('status', status, 'case', '', 'outcome')
      call file%write('message', message, 'case', '', 'why a case did not converge or is not resolved')
   end subroutine write_status

   !> A dataset for every column of the records that `write_inputs` and `write_status` have not written.
   subroutine write_outcomes(file, contents, place)
      type(hdf5_file_t), intent(inout) :: file
      type(contents_t), intent(in) :: contents
      integer, intent(in) :: place(:)
      character(len=:), allocatable :: name
      integer :: column(size(contents%layouts))   ! of the present name, in each layout
      integer :: k, l, other

      do l = 1, size(contents%layouts)
         do k = 1, size(contents%layouts(l)%names)
            name = trim(contents%layouts(l)%names(k))
            if (file%has(name)) cycle
            do other = 1, size(contents%layouts)
               column(other) = findloc(contents%layouts(other)%names, contents%layouts(l)%names(k), 1)
            end do
            call write_column(file, contents, place, column, name, trim(contents%layouts(l)%kinds(k)))
         end do
      end do
   end subroutine write_outcomes

   !> One column, whatever its kind. Missing: NaN, -1, empty.
   subroutine write_column(file, contents, place, column, name, kind)
      type(hdf5_file_t), intent(inout) :: file
      type(contents_t), intent(in) :: contents
      integer, intent(in) :: place(:), column(:)
      character(len=*), intent(in) :: name, kind
      character(len=:), allocatable :: units, long_name, value
      real(dp), allocatable :: numbers(:), lists(:, :)
      integer, allocatable :: first(:), last(:)
      integer :: i, k, longest

      call describe_column(name, units, long_name)
      select case (kind)
      case ('real', 'integer', 'logical')
         allocate (numbers(size(place)), source=ieee_value(1.0_dp, ieee_quiet_nan))
         do i = 1, size(place)
            numbers(i) = json_number(value_of(i))
         end do
         if (kind == 'real') then
            call file%write(name, numbers, 'case', units, long_name)
         else
            where (.not. ieee_is_finite(numbers)) numbers = -1
            call file%write(name, nint(numbers), 'case', units, long_name)
         end if
      case ('list')
         longest = 0
         do i = 1, size(place)
            call split_list(value_of(i), first, last)
            longest = max(longest, size(first))
         end do
         if (longest == 0) return
         allocate (lists(longest, size(place)), source=ieee_value(1.0_dp, ieee_quiet_nan))
         do i = 1, size(place)
            value = value_of(i)
            call split_list(value, first, last)
            do k = 1, size(first)
               lists(k, i) = json_number(value(first(k):last(k)))
            end do
         end do
         call file%write(name//'_entry', [(k, k=1, longest)], '', '1', 'place in '//long_name)
         call file%dimension(name//'_entry')
         call file%write(name, lists, name//'_entry', 'case', units, long_name)
      case default
         longest = 1
         do i = 1, size(place)
            longest = max(longest, min(longest_text, len(value_of(i))))
         end do
         call write_texts(longest)
      end select

   contains

      subroutine write_texts(length)
         integer, intent(in) :: length
         character(len=length) :: texts(size(place))
         integer :: n
         do n = 1, size(place)
            texts(n) = json_string(value_of(n))
         end do
         call file%write(name, texts, 'case', '', long_name)
      end subroutine write_texts

      !> JSON of this column for a case of the sweep; empty when there is none.
      function value_of(case) result(text)
         integer, intent(in) :: case
         character(len=:), allocatable :: text
         text = ''
         if (place(case) == 0) return
         associate (record => contents%cases(place(case)))
            if (column(record%layout) == 0) return
            text = record%text(record%first(column(record%layout)):record%last(column(record%layout)))
         end associate
      end function value_of

   end subroutine write_column

   !> Which run of which build made each row.
   subroutine write_runs(file, contents, place)
      type(hdf5_file_t), intent(inout) :: file
      type(contents_t), intent(in) :: contents
      integer, intent(in) :: place(:)
      character(len=longest_text), allocatable :: of_log(:)
      character(len=:), allocatable :: units, long_name
      integer :: i, k, log, longest

      allocate (of_log(size(contents%logs)))
      do k = 1, size(run_columns)
         call describe_column(trim(run_columns(k)), units, long_name)
         if (run_columns(k) == 'run') then
            call file%write('run', [(run_of(i), i=1, size(place))], 'case', units, long_name)
            cycle
         end if
         longest = 1
         do log = 1, size(contents%logs)
            of_log(log) = json_string(run_element(contents%logs(log), trim(run_columns(k))))
            longest = max(longest, len_trim(of_log(log)))
         end do
         call write_texts(trim(run_columns(k)), longest)
      end do

   contains

      subroutine write_texts(name, length)
         character(len=*), intent(in) :: name
         integer, intent(in) :: length
         character(len=length) :: texts(size(place))
         integer :: n
         texts = ''
         do n = 1, size(place)
            if (place(n) > 0) texts(n) = of_log(contents%cases(place(n))%log)
         end do
         call file%write(name, texts, 'case', '', long_name)
      end subroutine write_texts

      pure integer function run_of(case)
         integer, intent(in) :: case
         run_of = -1
         if (place(case) > 0) run_of = contents%cases(place(case))%run
      end function run_of

   end subroutine write_runs

end module ehlwave_results_file
