!> Rows of a results file: stored values bit for bit, the inputs of a case that has not run, units and long names.
program test_sweep_results
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use ehlwave_case_account, only: blank_result
   use ehlwave_case_input, only: case_input_t
   use ehlwave_case_key, only: most_keys
   use ehlwave_case_keys, only: default_keys
   use ehlwave_case_record, only: store_result
   use ehlwave_case_result, only: case_result_t
   use ehlwave_case_text, only: effective_input, input_identity
   use ehlwave_errors, only: error_t
   use ehlwave_hdf5_file, only: hdf5_file_t
   use ehlwave_json, only: string_json
   use ehlwave_kinds, only: dp
   use ehlwave_key_list, only: find_key, key_list_t
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_record_file, only: record_writer_t
   use ehlwave_results_column, only: column_t
   use ehlwave_results_file, only: write_results
   use ehlwave_status, only: status_stalled
   use ehlwave_store, only: prepare_store, store_t
   use ehlwave_store_contents, only: contents_t, read_store
   use ehlwave_store_names, only: log_name
   use ehlwave_sweep_cases, only: sweep_t
   use hdf5_readback, only: attribute_of, numbers_of, text_of
   use testing, only: test_t
   implicit none (type, external)

   character(len=*), parameter :: path = 'test_sweep_results.h5', folder = 'test_sweep_results.store', lf = new_line('a')
   real(dp), parameter :: history(2) = [1.0_dp, 0.1_dp]
   type(test_t) :: test
   type(sweep_t) :: sweep
   type(case_result_t) :: result

   call execute_command_line('rm -rf '//folder)
   call make_sweep()
   call store_second()
   call write_file()
   call check_inputs()
   call check_outcomes()
   call check_descriptions()
   call check_partial_columns()
   call check_older_store()
   call check_foreign_record()
   call test%finish()

contains

   subroutine make_sweep()
      type(case_input_t) :: input
      type(key_list_t) :: keys
      type(error_t), allocatable :: error
      logical :: is_moes(most_keys)
      integer :: i
      keys = default_keys()
      is_moes = .false.
      is_moes(:keys%count) = [(any(keys%keys(i)%name == [character(len=21) :: 'load_parameter_m', 'lubricant_parameter_l', &
                                                         'radius_ratio_d']), i=1, keys%count)]
      call sweep%begin(most=5, skips_unresolved=.false.)
      call sweep%vary([find_key(keys%keys, 'method'), find_key(keys%keys, 'tolerance')], has_f_v=.false.)
      do i = 1, 3
         input = case_input_t()
         input%is_given = is_moes
         input%case%load_parameter_m = 100*i
         input%case%lubricant_parameter_l = 12.05_dp
         input%case%radius_ratio_d = 1
         input%case%cells_x = 64
         if (i == 2) input%case%method = 'fas'
         input%case%tolerance = 1e-5_dp/i
         input%case%cells_y = 32
         call sweep%add(input, keys, '', error)
         call test%check_no_error(error, 'case')
      end do
      call sweep%finish()
   end subroutine make_sweep

   !> Case 2 has run and failed.
   subroutine store_second()
      type(store_t) :: store
      type(error_t), allocatable :: error
      character(len=:), allocatable :: warning
      store%host = 'here'
      call prepare_store(folder, store, warning, error)
      result = blank_result(sweep%cases(2), sweep%plans(2))
      result%status = status_stalled
      result%message = 'steady state stalled'
      result%is_resolved = .false.
      result%central_film = 1/3.0_dp
      result%nonlinear_steps = 7
      result%residual_history = history
      result%seconds = 0.25_dp
      call store_result(sweep%cases(2), sweep%plans(2), effective_input(sweep%cases(2)), result, 'some time', store, error)
      call store%close(error)
      call test%check_no_error(error, 'store')
   end subroutine store_second

   subroutine write_file()
      type(contents_t) :: contents
      type(error_t), allocatable :: error
      call read_store(folder, input_identity, contents, error)
      call write_results(path, '&sweep /'//lf, sweep, contents, error)
      call test%check_no_error(error, 'results file')
   end subroutine write_file

   subroutine check_inputs()
      call test%check_close(numbers_of(path, 'case'), [1.0_dp, 2.0_dp, 3.0_dp], 'numbers', relative=0.0_dp)
      call test%check_close(numbers_of(path, 'load_parameter_m'), [100.0_dp, 200.0_dp, 300.0_dp], 'M', relative=0.0_dp)
      call test%check_close(numbers_of(path, 'cells_y'), [32.0_dp, 32.0_dp, 32.0_dp], 'cells', relative=0.0_dp)
      call test%check_close(numbers_of(path, 'lambdabar'), sweep%plans%conditions%lambdabar, 'lambdabar', relative=0.0_dp)
      call test%check_equal(text_of(path, 'case_id', 3), sweep%identity(3), 'identity')
      call test%check_equal(text_of(path, 'orientation', 1), 'none', 'a word')
      call test%check_equal(text_of(path, 'method', 2)//' '//text_of(path, 'method', 3), 'fas newton', 'a word that varies')
      call test%check_close(numbers_of(path, 'tolerance'), sweep%cases%tolerance, 'a number that varies', relative=0.0_dp)
      call test%check_equal(size(numbers_of(path, 'step_tolerance')), 0, 'no column of what does not vary')
      call test%check_equal(text_of(path, 'effective_input', 2), effective_input(sweep%cases(2)), 'effective input')
      call test%check_equal(attribute_of(path, '/', 'format'), 'ehlwave-results', 'format')
   end subroutine check_inputs

   !> A case has run, two have not.
   subroutine check_outcomes()
      call test%check_equal(text_of(path, 'status', 1)//' '//text_of(path, 'status', 2), 'pending stalled', 'status')
      call test%check_equal(text_of(path, 'message', 2), result%message, 'message')
      associate (film => numbers_of(path, 'central_film'))
         call test%check_equal(size(film), 3, 'films')
         if (size(film) /= 3) return
         call test%check(ieee_is_nan(film(1)) .and. ieee_is_nan(film(3)), 'no film of cases that have not run')
         call test%check_close(film(2), 1/3.0_dp, 'film', relative=0.0_dp)
      end associate
      call test%check_close(numbers_of(path, 'nonlinear_steps'), [-1.0_dp, 7.0_dp, -1.0_dp], 'whole numbers', relative=0.0_dp)
      call test%check_close(numbers_of(path, 'is_resolved'), &
                            [merge(1.0_dp, 0.0_dp, sweep%plans(1)%resolution%is_resolved), 0.0_dp, &
                             merge(1.0_dp, 0.0_dp, sweep%plans(3)%resolution%is_resolved)], 'is_resolved', relative=0.0_dp)
      associate (lists => numbers_of(path, 'residual_history'))
         call test%check_equal(size(lists), 6, 'a list for each case')
         if (size(lists) /= 6) return
         call test%check_close(lists(3:4), history, 'list of the case that has one', relative=0.0_dp)
         call test%check(all(ieee_is_nan(lists([1, 2, 5, 6]))), 'nothing in the others')
      end associate
      call test%check_close(numbers_of(path, 'run'), [-1.0_dp, 1.0_dp, -1.0_dp], 'run', relative=0.0_dp)
      call test%check_equal(text_of(path, 'host', 2), 'here', 'host')
      call test%check_equal(text_of(path, 'host', 1), '', 'no host')
      call test%check_equal(size(numbers_of(path, 'central_film_um')), 0, 'no film in um without dimensions')
   end subroutine check_outcomes

   subroutine check_descriptions()
      call test%check_equal(attribute_of(path, 'phase_fit', 'units'), 'rad', 'unit')
      call test%check_equal(attribute_of(path, 'seconds', 'units'), 's', 'unit of the time')
      call test%check_equal(attribute_of(path, 'central_film', 'units'), '1', 'unit of a plain number')
      call test%check_equal(attribute_of(path, 'central_film', 'long_name'), 'smooth central film thickness H(0,0)', 'long name')
      call test%check_equal(attribute_of(path, 'run', 'long_name'), &
                            'run of the program, counted from 1 in its store; -1: not run', 'long name of the run')
   end subroutine check_descriptions

   !> Quantities of a single case out of three, and a quantity of none.
   subroutine check_partial_columns()
      character(len=*), parameter :: partial = 'test_sweep_results_partial.h5'
      type(hdf5_file_t) :: file
      type(quantity_list_t) :: list
      type(column_t) :: column
      type(error_t), allocatable :: error
      logical, allocatable :: unknown
      integer :: k
      call list%add('length', 'a length', 0.5_dp, unit='m')
      call list%add('steps', 'a number of steps', 4)
      call list%add('word', 'a word', 'here')
      call list%add('nobody', 'what no case has', 1.0_dp, exists=.false.)
      call list%add_truth('touch', 'what is not known', unknown)
      call file%create(partial, error)
      call file%write('case', [1, 2, 3], '1', 'number')
      call file%dimension('case')
      do k = 1, list%count
         call column%init(list%items(k), cases=3)
         call column%set(2, list%items(k))
         call column%write(file)
      end do
      call file%finish(error)
      call test%check_no_error(error, 'columns')
      associate (length => numbers_of(partial, 'length'))
         call test%check_close(length(2:2), [0.5_dp], 'a number', relative=0.0_dp)
         call test%check(all(ieee_is_nan(length([1, 3]))), 'NaN elsewhere')
      end associate
      call test%check_close(numbers_of(partial, 'steps'), [-1.0_dp, 4.0_dp, -1.0_dp], 'whole number', relative=0.0_dp)
      call test%check_close(numbers_of(partial, 'touch'), [-1.0_dp, -1.0_dp, -1.0_dp], 'a truth that is not known', relative=0.0_dp)
      call test%check_equal(text_of(partial, 'word', 1)//text_of(partial, 'word', 2), 'here', 'text')
      call test%check_equal(size(numbers_of(partial, 'nobody')), 0, 'a column that no case has is left out')
   end subroutine check_partial_columns

   !> A record of another version, with an unknown quantity and without known quantities.
   subroutine check_older_store()
      type(record_writer_t) :: writer
      type(error_t), allocatable :: error
      call writer%create(folder//'/records/'//log_name(2, 0), error)
      call writer%append('run [[["run","integer"],["rank","integer"],["program_version","text"]],[2,0,"0.0.1"]]', error)
      call writer%append('input ['//string_json(effective_input(sweep%cases(3)))//']', error)
      call writer%append('columns [["case_id","text"],["status","text"],["seconds","real"],["old_number","real"],'// &
                         '["effective_input","text"]]', error)
      call writer%append('case ["'//sweep%identity(3)//'","converged",0.5,0.1,""]', error)
      call writer%close(error)
      call write_file()
      call test%check_equal(text_of(path, 'status', 3), 'converged', 'status of another version')
      call test%check_equal(text_of(path, 'program_version', 3), '0.0.1', 'its version')
      call test%check_equal(attribute_of(path, 'old_number', 'long_name'), 'old_number', 'an unknown quantity has its name')
      associate (old => numbers_of(path, 'old_number'), film => numbers_of(path, 'central_film'))
         call test%check_close(old(3:3), [0.1_dp], 'its value', relative=0.0_dp)
         call test%check(ieee_is_nan(old(2)), 'the others have none')
         call test%check(ieee_is_nan(film(3)), 'what it lacks is missing')
      end associate
   end subroutine check_older_store

   !> A record with the input of another case is rejected; the case counts as not run.
   subroutine check_foreign_record()
      type(record_writer_t) :: writer
      type(contents_t) :: contents
      type(error_t), allocatable :: error
      call writer%create(folder//'/records/'//log_name(3, 0), error)
      call writer%append('run [[["run","integer"],["rank","integer"]],[3,0]]', error)
      call writer%append('input ['//string_json(effective_input(sweep%cases(2)))//']', error)
      call writer%append('columns [["case_id","text"],["status","text"],["effective_input","text"]]', error)
      call writer%append('case ["'//sweep%identity(1)//'","converged",""]', error)
      call writer%close(error)
      call read_store(folder, input_identity, contents, error)
      call write_results(path, '&sweep /'//lf, sweep, contents, error)
      call test%check_no_error(error, 'a record with the input of another case')
      call test%check_equal(contents%index%find(sweep%identity(1)), 0, 'it is not believed')
      call test%check_equal(text_of(path, 'status', 1), 'pending', 'the case has not run')
   end subroutine check_foreign_record

end program test_sweep_results
