!> Reads files that a fuzzer has made: for each line "KIND PATH" of standard input, or once for these two arguments, a
!> line of output.
!>
!>     case     a case file, completed and planned
!>     sweep    a sweep file, with all its cases
!>     store    the folder of a store
!>     surface  a measured surface
program fuzz_target
   use, intrinsic :: ieee_exceptions, only: ieee_set_halting_mode, ieee_usual
   use, intrinsic :: iso_fortran_env, only: input_unit, output_unit
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_file, only: read_case
   use ehlwave_case_plan, only: make_plan
   use ehlwave_case_text, only: input_identity
   use ehlwave_case_table, only: read_sweep
   use ehlwave_errors, only: error_t
   use ehlwave_json_reader, only: json_number, split_list
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_store_contents, only: contents_t, read_store
   use ehlwave_surface_file, only: read_surface_file
   use ehlwave_sweep_cases, only: sweep_t
   use ehlwave_text, only: shown, to_text
   implicit none (type, external)

   character(len=4096) :: line
   character(len=16) :: kind
   integer :: blank, io

   call ieee_set_halting_mode(ieee_usual, .false.)   ! inputs hold infinities and NaN, which debug builds are to refuse, too
   if (command_argument_count() == 2) then
      call get_command_argument(1, kind)
      call get_command_argument(2, line)
      call visit(trim(kind), trim(line))
      stop
   end if
   do
      read (input_unit, '(a)', iostat=io) line
      if (io /= 0) exit
      blank = index(line, ' ')
      call visit(line(:blank - 1), trim(line(blank + 1:)))
   end do

contains

   subroutine visit(kind, path)
      character(len=*), intent(in) :: kind, path
      type(error_t), allocatable :: error
      character(len=:), allocatable :: found

      found = ''
      select case (kind)
      case ('case'); call visit_case(path, found, error)
      case ('sweep'); call visit_sweep(path, found, error)
      case ('store'); call visit_store(path, found, error)
      case ('surface'); call visit_surface(path, found, error)
      case default; found = 'unknown kind'
      end select
      if (allocated(error)) found = 'refused '//shown(error%message, 300)
      write (output_unit, '(a)') found
      flush (output_unit)
   end subroutine visit

   subroutine visit_case(path, found, error)
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(out) :: found
      type(error_t), allocatable, intent(inout) :: error
      type(case_t) :: case
      type(case_plan_t) :: plan
      call read_case(path, case, error)
      if (.not. allocated(error)) call make_plan(case, plan, error)
      found = 'case of '//to_text(plan%cells_x)//' cells'
   end subroutine visit_case

   subroutine visit_sweep(path, found, error)
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(out) :: found
      type(error_t), allocatable, intent(inout) :: error
      type(sweep_t) :: sweep
      call read_sweep(path, sweep, error)
      if (.not. allocated(error)) found = to_text(size(sweep%cases))//' cases, first with '//sweep%variation(1)
   end subroutine visit_sweep

   !> All values of all cases are looked at.
   subroutine visit_store(path, found, error)
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(out) :: found
      type(error_t), allocatable, intent(inout) :: error
      type(contents_t) :: contents
      character(len=:), allocatable :: value
      integer, allocatable :: first(:), last(:)
      real(dp) :: number
      integer :: i, k, values

      call read_store(path, input_identity, contents, error)
      if (allocated(error)) return
      values = 0
      do i = 1, contents%count
         associate (layout => contents%layouts(contents%cases(i)%layout))
            do k = 1, size(layout%names)
               value = contents%value(i, trim(layout%names(k)))
               call split_list(value, first, last)
               number = json_number(value)
               values = values + merge(1, size(first), number < 0)
            end do
         end associate
         value = contents%input(i)//contents%logs(contents%cases(i)%log)%build()
         values = values + len(value) + contents%deaths(contents%cases(i)%identity)
      end do
      found = to_text(contents%count)//' cases, '//to_text(contents%bad_lines)//' bad lines, '//to_text(values)
   end subroutine visit_store

   subroutine visit_surface(path, found, error)
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(out) :: found
      type(error_t), allocatable, intent(inout) :: error
      real(dp), allocatable :: height(:, :)
      real(dp) :: step_x, step_y
      call read_surface_file(path, height, step_x, step_y, error)
      if (.not. allocated(error)) found = to_text(size(height))//' points, steps '//to_text(step_x)//' '//to_text(step_y)
   end subroutine visit_surface

end program fuzz_target
