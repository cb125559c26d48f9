!> HDF5 file of a sweep: one row per case over the dimension `case`, whatever its status.
!>
!> The rows are made from the sweep file (what each case is) and from the store (what it came to).
module ehlwave_results_file
   use ehlwave_case_account, only: blank_result
   use ehlwave_case_json, only: result_json
   use ehlwave_case_text, only: effective_input, effective_length, text_identity
   use ehlwave_errors, only: error_t, raise
   use ehlwave_field_file, only: write_provenance
   use ehlwave_hdf5_file, only: hdf5_file_t
   use ehlwave_json, only: json_t
   use ehlwave_json_reader, only: json_number, json_string
   use ehlwave_kinds, only: dp
   use ehlwave_results_columns, only: write_outcomes, write_runs
   use ehlwave_status, only: status_name, status_pending
   use ehlwave_store_contents, only: add_layout, contents_t
   use ehlwave_sweep_cases, only: sweep_t
   use ehlwave_text_difference, only: text_from_difference
   implicit none (type, external)
   private
   public :: write_results

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
      text = ''
      associate (log => contents%logs(contents%cases(place)%log))
         if (allocated(log%base_input)) &
            text = text_from_difference(log%base_input, json_string(contents%value(place, 'effective_input')))
      end associate
   end function stored_input

   !> Columns that follow from the sweep file; pending cases have them, too.
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
            is_resolved(i) = is_resolved(i) .and. json_number(contents%value(place(i), 'is_resolved')) > 0.5_dp
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
         status(i) = json_string(contents%value(place(i), 'status'))
         message(i) = json_string(contents%value(place(i), 'message'))
      end do
      call file%write('status', status, 'case', '', 'outcome')
      call file%write('message', message, 'case', '', 'why a case did not converge or is not resolved')
   end subroutine write_status

end module ehlwave_results_file
