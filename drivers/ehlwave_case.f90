!> ehlwave-case: solve one contact.
program ehlwave_case
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use ehlwave_arguments, only: arguments_t, read_arguments
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_file, only: read_case
   use ehlwave_case_plan, only: case_plan_t, make_plan
   use ehlwave_case_report, only: print_plan, print_result
   use ehlwave_case_result, only: case_result_t
   use ehlwave_errors, only: error_t
   use ehlwave_field_file, only: check_writable, write_case_file
   use ehlwave_key_reference, only: case_key_reference
   use ehlwave_log, only: log_monitor_t
   use ehlwave_petsc_library, only: finish_petsc
   use ehlwave_provenance_list, only: print_version
   use ehlwave_quantities, only: add_plan, add_result
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_quantity_output, only: json_object
   use ehlwave_refined_case, only: run_refined_case
   use ehlwave_status, only: is_success
   implicit none (type, external)

   character(len=*), parameter :: usage(18) = [character(len=96) :: &
      'Usage: ehlwave-case INPUT.nml [--plan] [--json] [--output FILE.h5] [--quiet]', &
      '', &
      'Solves one elastohydrodynamic contact, smooth or wavy, described by a namelist file.', &
      '', &
      '  --plan           say what would be computed, on which grid and why; compute nothing', &
      '  --json           last line of the output: plan or result as one JSON object', &
      '  --output FILE    write result, history at the contact centre and fields to an HDF5 file', &
      '  --quiet          no progress lines', &
      '  --keys           all keys of an input, with defaults and meaning', &
      '  --version        version of the program; --verbose: with build, libraries, processor', &
      '  --help           this text', &
      '', &
      'Exit status: 0 converged (or unresolved, flagged in the result); 1 not converged, or inaccurate;', &
      '             2 bad input or usage; 3 output file could not be written', &
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
   integer :: i

   call read_arguments(['--plan   ', '--json   ', '--quiet  ', '--keys   ', '--help   ', '--version', '--verbose'], &
                       ['--output'], arguments, error)
   if (allocated(error)) call fail(error%message//'; see ehlwave-case --help', 2)
   if (arguments%has('--help')) then
      write (output_unit, '(a)') (trim(usage(i)), i=1, size(usage))
      stop 0, quiet=.true.
   else if (arguments%has('--keys')) then
      write (output_unit, '(a)', advance='no') case_key_reference(is_markdown=.false.)
      stop 0, quiet=.true.
   else if (arguments%has('--version')) then
      call print_version(output_unit, arguments%has('--verbose'))
      stop 0, quiet=.true.
   end if
   if (size(arguments%files) /= 1) call fail('give one input file; see ehlwave-case --help', 2)

   call read_case(trim(arguments%files(1)), case, error)
   if (.not. allocated(error)) call make_plan(case, plan, error)
   if (allocated(error)) call fail(error%message, 2)
   if (arguments%has('--output')) then
      case%fields = .true.
      call check_writable(arguments%value('--output'), error)
      if (allocated(error)) call fail(error%message, 2)
   end if

   call print_plan(output_unit, case, plan)
   if (arguments%has('--plan')) then
      if (arguments%has('--json')) then
         call add_plan(quantities, case, plan)
         write (output_unit, '(a)') json_object(quantities)
      end if
      stop 0, quiet=.true.
   end if

   monitor%is_quiet = arguments%has('--quiet')
   flush (output_unit)
   call run_refined_case(case, plan, monitor, result)
   call finish_petsc()
   call print_result(output_unit, case, plan, result)
   if (arguments%has('--output')) then
      call write_case_file(arguments%value('--output'), case, plan, result, error)
      if (allocated(error)) write (error_unit, '(a)') 'ehlwave-case: '//error%message
   end if
   if (arguments%has('--json')) then
      call add_result(quantities, case, plan, result)
      write (output_unit, '(a)') json_object(quantities)
   end if
   flush (output_unit)
   if (allocated(error)) stop 3, quiet=.true.
   if (.not. is_success(result%status)) stop 1, quiet=.true.
   stop 0, quiet=.true.

contains

   subroutine fail(message, code)
      character(len=*), intent(in) :: message
      integer, intent(in) :: code
      write (error_unit, '(a)') 'ehlwave-case: '//message
      stop code, quiet=.true.
   end subroutine fail

end program ehlwave_case
