!> One row of a CSV file of cases.
module ehlwave_case_row
   use ehlwave_case_definition, only: case_t, orientations
   use ehlwave_csv, only: cell_length, csv_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   use ehlwave_text, only: lower_case, to_text
   implicit none (type, external)
   private
   public :: set_row

contains

   !> Override what a case has by the values of a row. Fails on unknown columns and values that do not fit.
   subroutine set_row(table, row, case, f_v, error)
      type(csv_t), intent(in) :: table
      integer, intent(in) :: row
      type(case_t), intent(inout) :: case
      real(dp), intent(out) :: f_v                 !! f(r) V asked for in place of a wavelength, 0: none
      type(error_t), allocatable, intent(inout) :: error
      integer :: column

      f_v = 0
      do column = 1, size(table%names)
         call set_cell(table, column, row, case, f_v, error)
      end do
   end subroutine set_row

   subroutine set_cell(table, column, row, case, f_v, error)
      type(csv_t), intent(in) :: table
      integer, intent(in) :: column, row
      type(case_t), intent(inout) :: case
      real(dp), intent(inout) :: f_v
      type(error_t), allocatable, intent(inout) :: error
      character(len=cell_length) :: word
      real(dp) :: number

      if (allocated(error)) return
      number = 0
      if (table%names(column) == 'orientation') then
         word = lower_case(table%cells(column, row))
         if (.not. any(orientations == word)) then
            call raise(error, table%place(column, row)//"'"//trim(table%cells(column, row))//"' is not one of none, "// &
                       'transverse, isotropic, longitudinal, custom')
            return
         end if
         case%orientation = trim(word)
         return
      end if
      call table%real_value(column, row, number, error)
      select case (table%names(column))
      case ('load_parameter_m'); case%load_parameter_m = number
      case ('lubricant_parameter_l'); case%lubricant_parameter_l = number
      case ('radius_ratio_d'); case%radius_ratio_d = number
      case ('slip_parameter'); case%slip_parameter = number
      case ('wavelength_over_a'); case%wavelength_over_a = number
      case ('wavelength_x_over_a'); case%wavelength_x_over_a = number
      case ('wavelength_y_over_a'); case%wavelength_y_over_a = number
      case ('f_v'); f_v = number
      case ('amplitude_over_film'); case%amplitude_over_film = number
      case ('cells_x'); case%cells_x = nint(min(number, 1e6_dp))
      case ('cells_y'); case%cells_y = nint(min(number, 1e6_dp))
      case default
         call raise(error, table%path//": unknown column '"//trim(table%names(column))//"': columns may be "// &
                    'load_parameter_m, lubricant_parameter_l, radius_ratio_d, slip_parameter, orientation, '// &
                    'wavelength_over_a, wavelength_x_over_a, wavelength_y_over_a, f_v, amplitude_over_film, cells_x, cells_y')
      end select
      if (allocated(error)) return
      if (number < 0) then
         call raise(error, table%place(column, row)//to_text(number, 6)//' must not be negative')
      else if (table%names(column)(1:6) == 'cells_' .and. abs(number - nint(min(number, 1e6_dp))) > 0) then
         call raise(error, table%place(column, row)//to_text(number, 6)//' must be a whole number')
      end if
   end subroutine set_cell

end module ehlwave_case_row
