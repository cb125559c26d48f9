!> ehlwave-case: solve one contact.
program ehlwave_case
   use, intrinsic :: iso_fortran_env, only: output_unit
   use ehlwave_arguments, only: arguments_t, read_arguments
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_file, only: read_case
   use ehlwave_case_files, only: paths_read
   use ehlwave_case_plan, only: make_plan
   use ehlwave_case_result, only: case_result_t
   use ehlwave_errors, only: error_t
   use ehlwave_field_file, only: write_case_file
   use ehlwave_key_json, only: case_key_json
   use ehlwave_key_reference, only: case_key_reference
   use ehlwave_log, only: log_monitor_t
   use ehlwave_memory_plan, only: memory_shortage
   use ehlwave_output_path, only: check_output_path
   use ehlwave_petsc_library, only: finish_petsc
   use ehlwave_plan_report, only: print_plan
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_process, only: end_program, ignore_write_signals
   use ehlwave_provenance, only: git_revision, program_version
   use ehlwave_provenance_list, only: version_text
   use ehlwave_input_quantities, only: add_plan
   use ehlwave_quantities, only: add_result
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_quantity_output, only: json_object
   use ehlwave_refined_case, only: run_refined_case
   use ehlwave_result_report, only: print_result
   use ehlwave_status, only: is_success
   use ehlwave_store_folder, only: refuse_inside_store
   use ehlwave_terminal, only: complain, print_last
   use ehlwave_threads, only: take_threads, thread_count, threads_notice, wait_briefly
   implicit none (type, external)

   character(len=*), parameter :: usage(19) = [character(len=120) :: &
      'Usage: ehlwave-case INPUT.nml [--plan] [--json] [--output FILE.h5 [--overwrite]] [--quiet]', &
      '', &
      'Solves one elastohydrodynamic contact, smooth or wavy, described by a namelist file.', &
      '', &
      '  --plan           print the plan: grid, steps and reasons; compute nothing', &
      '  --json           last line of the output: plan or result as one JSON object', &
      '  --output FILE    write result, history at the contact centre and fields to an HDF5 file', &
      '  --overwrite      even where FILE exists and is no result of ehlwave-case', &
      '  --quiet          no progress lines', &
      '  --keys           all keys of an input, with defaults and meaning; --json: as one JSON object', &
      '  --version        version of the program; --verbose: with build, libraries, processor', &
      '  --help           this text', &
      '', &
      'Exit status: 0 converged (or unresolved, flagged in the result); 1 not converged, or inaccurate;', &
      '             2 bad input or usage; 3 output could not be written; 4 too little memory or processor time', &
      '', &
      'A minimal input:   &conditions load_parameter_m = 100, lubricant_parameter_l = 12.05,', &
      '                   radius_ratio_d = 1 /', &
      'All keys are described in inputs/README.md.']

   type(arguments_t) :: arguments
   type(case_t) :: case
   type(case_plan_t) :: plan
   type(case_result_t) :: result
   type(error_t), allocatable :: error
   type(log_monitor_t) :: monitor
   type(quantity_list_t) :: quantities
   character(len=:), allocatable :: notice, shortage
   integer :: i
   logical :: is_written

   call ignore_write_signals()
   call read_arguments(['--plan     ', '--json     ', '--overwrite', '--quiet    ', '--keys     ', '--help     ', &
                        '--version  ', '--verbose  '], ['--output'], arguments, error)
   if (allocated(error)) call fail(error%message//'; see ehlwave-case --help', 2)
   if (arguments%has('--help')) then
      write (output_unit, '(a)') (trim(usage(i)), i=1, size(usage) - 1)
      call finish(trim(usage(size(usage))), 0)
   else if (arguments%has('--keys') .and. arguments%has('--json')) then
      call finish(case_key_json(), 0)
   else if (arguments%has('--keys')) then
      call finish(case_key_reference(is_markdown=.false.), 0)
   else if (arguments%has('--version')) then
      call finish(version_text(arguments%has('--verbose')), 0)
   end if
   if (size(arguments%files) /= 1) call fail('give one input file; see ehlwave-case --help', 2)

   call read_case(trim(arguments%files(1)), case, error)
   if (.not. allocated(error)) then
      notice = threads_notice(case%threads)
      call take_threads(case%threads)
      if (thread_count() > 1) call wait_briefly()
      call make_plan(case, plan, error)
      plan%threads = thread_count()
   end if
   if (allocated(error)) call fail(error%message, 2)
   if (arguments%has('--output')) then
      case%fields = .true.
      call refuse_inside_store(arguments%value('--output'), error)
      call check_output_path(arguments%value('--output'), [character(len=len(arguments%files)) :: arguments%files(1), &
                                                           paths_read(plan%files)], arguments%has('--overwrite'), &
                             error, format='ehlwave-case')
      if (allocated(error)) call fail(error%message, 2)
   end if

   if (notice /= '') call complain('ehlwave-case', notice)
   call print_plan(output_unit, case, plan)
   if (arguments%has('--plan')) then
      call add_plan(quantities, case, plan)
      call conclude(0)
   end if
   shortage = memory_shortage(plan)
   if (shortage /= '') call fail(shortage, 4)

   monitor%is_quiet = arguments%has('--quiet')
   flush (output_unit)
   call run_refined_case(case, plan, monitor, result)
   call finish_petsc()
   call print_result(output_unit, case, plan, result)
   if (arguments%has('--output')) then
      call write_case_file(arguments%value('--output'), case, plan, result, error)
      if (allocated(error)) call complain('ehlwave-case', error%message)
   end if
   call add_result(quantities, case, plan, result)
   call conclude(merge(3, merge(0, 1, is_success(result%status)), allocated(error)))

contains

   !> Last line: the quantities as JSON if requested, else the provenance of the program.
   subroutine conclude(code)
      integer, intent(in) :: code
      if (arguments%has('--json')) then
         call finish(json_object(quantities), code)
      else
         call finish('Program      ehlwave '//program_version//' '//git_revision, code)
      end if
   end subroutine conclude

   !> Print the last line and end, with status 3 if the output could not be written.
   subroutine finish(line, code)
      character(len=*), intent(in) :: line
      integer, intent(in) :: code
      call print_last(line, is_written)
      if (.not. is_written) call fail('standard output could not be written', 3)
      call end_program(code)
   end subroutine finish

   subroutine fail(message, code)
      character(len=*), intent(in) :: message
      integer, intent(in) :: code
      call complain('ehlwave-case', message)
      call end_program(code)
   end subroutine fail

end program ehlwave_case
