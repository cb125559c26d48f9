!> Case files: read, checked, completed.
module ehlwave_case_file
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_input, only: case_input_t, key_reader_t
   use ehlwave_case_keys, only: visit_case_keys
   use ehlwave_errors, only: error_t
   use ehlwave_input_completion, only: complete_input
   use ehlwave_key_list, only: case_key_list
   implicit none (type, external)
   private
   public :: case_from_text, read_case

contains

   !> Read a case file, refuse what is unknown, missing or meaningless.
   subroutine read_case(path, case, error)
      character(len=*), intent(in) :: path
      type(case_t), intent(out) :: case
      type(error_t), allocatable, intent(out) :: error
      type(key_reader_t) :: reader

      call reader%file%load(path, error)
      if (.not. allocated(error)) call read_groups(reader, path//': ', case, error)
   end subroutine read_case

   !> The case that an effective input describes.
   subroutine case_from_text(text, case, error)
      character(len=*), intent(in) :: text
      type(case_t), intent(out) :: case
      type(error_t), allocatable, intent(out) :: error
      type(key_reader_t) :: reader

      call reader%file%load_text('case', text, error)
      if (.not. allocated(error)) call read_groups(reader, '', case, error)
   end subroutine case_from_text

   subroutine read_groups(reader, place, case, error)
      type(key_reader_t), intent(inout) :: reader
      character(len=*), intent(in) :: place          !! begins messages about several keys
      type(case_t), intent(inout) :: case
      type(error_t), allocatable, intent(inout) :: error
      type(case_input_t) :: input

      call visit_case_keys(input%case, reader)
      call reader%file%check_all_used(reader%error)
      if (allocated(reader%error)) then
         call move_alloc(reader%error, error)
         return
      end if
      input%is_given = reader%is_given
      call complete_input(input, case_key_list(), place, error)
      case = input%case
   end subroutine read_groups

end module ehlwave_case_file
