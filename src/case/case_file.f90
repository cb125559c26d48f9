!> Case files: read, checked, completed.
module ehlwave_case_file
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_input, only: case_input_t
   use ehlwave_case_keys, only: default_keys
   use ehlwave_errors, only: error_t
   use ehlwave_input_completion, only: complete_input
   use ehlwave_namelist, only: namelist_t
   implicit none (type, external)
   private
   public :: case_from_text, read_case

contains

   !> Read a case file, refuse unknown, missing or meaningless keys.
   subroutine read_case(path, case, error)
      character(len=*), intent(in) :: path
      type(case_t), intent(out) :: case
      type(error_t), allocatable, intent(out) :: error
      type(namelist_t) :: file

      call file%load(path, error)
      call read_groups(file, path//': ', case, error)
   end subroutine read_case

   !> The case that an effective input describes.
   subroutine case_from_text(text, case, error)
      character(len=*), intent(in) :: text
      type(case_t), intent(out) :: case
      type(error_t), allocatable, intent(out) :: error
      type(namelist_t) :: file

      call file%load_text('case', text, error)
      call read_groups(file, '', case, error)
   end subroutine case_from_text

   subroutine read_groups(file, place, case, error)
      type(namelist_t), intent(inout) :: file
      character(len=*), intent(in) :: place          !! begins messages about several keys
      type(case_t), intent(inout) :: case
      type(error_t), allocatable, intent(inout) :: error
      type(case_input_t) :: input

      call input%read(file, error)
      call file%check_all_used(error)
      call complete_input(input, default_keys(), place, error)
      case = input%case
   end subroutine read_groups

end module ehlwave_case_file
