!> Reads a sweep file: its cases are the cross product of lists, or the rows of a CSV file.
module ehlwave_case_table
   use ehlwave_case_completion, only: case_conditions
   use ehlwave_case_definition, only: case_t, name_length, orientations
   use ehlwave_case_input, only: read_case_groups
   use ehlwave_case_row, only: set_row
   use ehlwave_case_terms, only: case_limits_t
   use ehlwave_conditions, only: conditions_t
   use ehlwave_csv, only: csv_t, read_csv
   use ehlwave_errors, only: error_t, raise
   use ehlwave_formula, only: anisotropy_factor, wave_parameter_v
   use ehlwave_kinds, only: dp
   use ehlwave_namelist, only: namelist_t
   use ehlwave_sweep_cases, only: sweep_t
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: read_output_name, read_sweep
   character(len=*), parameter :: usual_output = 'results.h5'

   !> Lists of the &sweep group.
   type :: lists_t
      real(dp), allocatable :: m(:), l(:), d(:), wavelength(:), f_v(:)
      character(len=:), allocatable :: orientation(:)
      character(len=:), allocatable :: case_file, output, unresolved
      type(case_limits_t) :: limits
   end type lists_t

contains

   !> Read a sweep file. Fails when it, its CSV file or any of its cases is not right.
   subroutine read_sweep(path, sweep, error)
      character(len=*), intent(in) :: path
      type(sweep_t), intent(out) :: sweep
      type(error_t), allocatable, intent(out) :: error
      type(namelist_t) :: file
      type(lists_t) :: lists
      type(case_t) :: base

      call file%load(path, error)
      call read_lists(file, lists, error)
      call read_case_groups(file, base, error)
      call file%check_all_used(error)
      if (allocated(error)) return
      if (len_trim(base%surface_file) > 0) then
         call raise(error, file%place('surface', 'file')//'a sweep measures amplitudes of waves and a surface has none: '// &
                    'run it by ehlwave-case')
         return
      end if
      if (base%has_data .and. (allocated(lists%m) .or. allocated(lists%l) .or. allocated(lists%d))) then
         call raise(error, file%place('conditions', 'radius_x_m')//'&conditions gives dimensional data (radius_x_m, ...) '// &
                    'and &sweep gives load_parameter_m, lubricant_parameter_l or radius_ratio_d: give one of the two')
         return
      end if
      ! what is said about Y may be for the elliptical contacts of a sweep that has line contacts too
      if (allocated(lists%d)) then
         if (any(lists%d > 0)) base%across = ''
      else if (len(lists%case_file) > 0) then
         base%across = ''
      end if
      call sweep%begin(skips_unresolved=lists%unresolved == 'skip')
      sweep%output = lists%output
      sweep%limits = lists%limits
      if (len(lists%case_file) > 0) then
         if (allocated(lists%m) .or. allocated(lists%l) .or. allocated(lists%d) .or. allocated(lists%wavelength) .or. &
             allocated(lists%f_v) .or. allocated(lists%orientation)) then
            call raise(error, file%place('sweep', 'case_file')//'&sweep gives case_file and lists: give one of the two')
            return
         end if
         call add_rows(lists%case_file, base, sweep, error)
      else
         call add_product(path, base, lists, sweep, error)
      end if
      if (allocated(error)) return
      call sweep%finish()
      if (size(sweep%cases) == 0) call raise(error, path//': no cases are left to run'// &
         merge(' (all are unresolved)', '                     ', sweep%skipped > 0))
   end subroutine read_sweep

   !> The results file that a sweep file names.
   subroutine read_output_name(path, output, error)
      character(len=*), intent(in) :: path
      character(len=:), allocatable, intent(out) :: output
      type(error_t), allocatable, intent(inout) :: error
      type(namelist_t) :: file
      output = usual_output
      call file%load(path, error)
      call file%get('sweep', 'output', output, error)
   end subroutine read_output_name

   subroutine read_lists(file, lists, error)
      type(namelist_t), intent(inout) :: file
      type(lists_t), intent(inout) :: lists
      type(error_t), allocatable, intent(inout) :: error
      character(len=*), parameter :: group = 'sweep'

      lists%case_file = ''
      lists%output = usual_output
      lists%unresolved = 'run'
      call file%get_list(group, 'load_parameter_m', lists%m, error, above=0.0_dp)
      call file%get_list(group, 'lubricant_parameter_l', lists%l, error, minimum=0.0_dp)
      call file%get_list(group, 'radius_ratio_d', lists%d, error, minimum=0.0_dp)
      call file%get_list(group, 'wavelength_over_a', lists%wavelength, error, above=0.0_dp)
      call file%get_list(group, 'f_v', lists%f_v, error, above=0.0_dp)
      call file%get_list(group, 'orientation', lists%orientation, error, orientations)
      call file%get(group, 'case_file', lists%case_file, error)
      call file%get(group, 'output', lists%output, error)
      call file%get(group, 'largest_case_seconds', lists%limits%largest_case_seconds, error, above=0.0_dp)
      call file%get(group, 'checkpoint_seconds', lists%limits%checkpoint_seconds, error, minimum=0.0_dp)
      call file%get(group, 'unresolved', lists%unresolved, error, [character(len=4) :: 'run', 'skip'])
      if (allocated(error)) return
      if (allocated(lists%wavelength) .and. allocated(lists%f_v)) &
         call raise(error, file%place(group, 'f_v')//'&sweep gives wavelength_over_a and f_v: give one of the two')
   end subroutine read_lists

   !> Every combination of the lists; a list that is absent stands for the value of the case groups.
   subroutine add_product(path, base, lists, sweep, error)
      character(len=*), intent(in) :: path
      type(case_t), intent(in) :: base
      type(lists_t), intent(in) :: lists
      type(sweep_t), intent(inout) :: sweep
      type(error_t), allocatable, intent(inout) :: error
      type(case_t) :: case
      real(dp), allocatable :: m(:), l(:), d(:), wave(:)
      character(len=name_length), allocatable :: orientation(:)
      integer :: im, il, id, iw, io

      call list_or(lists%m, base%load_parameter_m, m)
      call list_or(lists%l, base%lubricant_parameter_l, l)
      call list_or(lists%d, base%radius_ratio_d, d)
      call list_or(lists%wavelength, base%wavelength_over_a, wave)
      if (allocated(lists%f_v)) call list_or(lists%f_v, 0.0_dp, wave)
      if (allocated(lists%orientation)) then
         allocate (orientation(size(lists%orientation)))
         orientation = lists%orientation
      else
         allocate (orientation(1), source=base%orientation)
      end if
      do id = 1, size(d)
         do il = 1, size(l)
            do im = 1, size(m)
               do io = 1, size(orientation)
                  do iw = 1, size(wave)
                     case = base
                     case%load_parameter_m = m(im)
                     case%lubricant_parameter_l = l(il)
                     case%radius_ratio_d = d(id)
                     case%orientation = orientation(io)
                     case%wavelength_over_a = 0
                     if (orientation(io) /= 'none' .and. orientation(io) /= 'custom') then
                        case%wavelength_over_a = wave(iw)
                        if (allocated(lists%f_v)) call set_f_v(case, wave(iw), error)
                     end if
                     call sweep%add(case, path//': ', error)
                     if (allocated(error)) return
                  end do
               end do
            end do
         end do
      end do
   end subroutine add_product

   pure subroutine list_or(list, value, values)
      real(dp), intent(in), allocatable :: list(:)
      real(dp), intent(in) :: value
      real(dp), allocatable, intent(out) :: values(:)
      if (allocated(list)) then
         allocate (values, source=list)
      else
         allocate (values(1), source=value)
      end if
   end subroutine list_or

   !> Wavelength for which f(r) V has a value.
   subroutine set_f_v(case, f_v, error)
      type(case_t), intent(inout) :: case
      real(dp), intent(in) :: f_v
      type(error_t), allocatable, intent(inout) :: error
      type(conditions_t) :: conditions
      real(dp) :: factor

      call case_conditions(case, conditions, error)
      if (allocated(error)) return
      factor = anisotropy_factor(merge(0.0_dp, 1.0_dp, case%orientation == 'longitudinal'), &
                                 merge(0.0_dp, 1.0_dp, case%orientation == 'transverse'))
      case%wavelength_over_a = f_v/(factor*wave_parameter_v(conditions, 1.0_dp))
   end subroutine set_f_v

   !> One case for each row of a CSV file; its columns override the case groups.
   subroutine add_rows(path, base, sweep, error)
      character(len=*), intent(in) :: path
      type(case_t), intent(in) :: base
      type(sweep_t), intent(inout) :: sweep
      type(error_t), allocatable, intent(inout) :: error
      type(csv_t) :: table
      type(case_t) :: case
      real(dp) :: f_v
      integer :: row

      call read_csv(path, table, error)
      if (allocated(error)) return
      do row = 1, size(table%line)
         case = base
         call set_row(table, row, case, f_v, error)
         if (.not. allocated(error) .and. f_v > 0) call set_f_v(case, f_v, error)
         call sweep%add(case, path//':'//to_text(table%line(row))//': ', error)
         if (allocated(error)) return
      end do
   end subroutine add_rows

end module ehlwave_case_table
