!> Tables of measured viscosities: validation, and the curves through them.
module ehlwave_viscosity_table
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   use ehlwave_monotone_curve, only: monotone_curve_t, new_monotone_curve
   use ehlwave_number_table, only: number_table_t
   use ehlwave_text, only: shown, to_text
   implicit none (type, external)
   private
   public :: read_curves

   character(len=*), parameter, public :: pressure = 'pressure_pa', temperature = 'temperature_k'
   character(len=*), parameter :: viscosity = 'viscosity_pa_s'
   real(dp), parameter :: coldest_k = 200, hottest_k = 700       ! range of a table: others are not in kelvin
   real(dp), parameter :: ambient_limit_pa = 5e6_dp              ! largest value of the first pressure
   real(dp), parameter :: reach_pa = 5e7_dp                      ! least last pressure: others are not in pascals
   integer, parameter :: fewest = 4                              ! pressures of a temperature

contains

   !> Temperatures of a table, rising, and the curves of ln(eta/Pa s) over p at them. Columns: pressure_pa,
   !> viscosity_pa_s and, for several temperatures, temperature_k. Fails on others, and on values that cannot be
   !> viscosities of a liquid.
   pure subroutine read_curves(table, list, curves, error)
      type(number_table_t), intent(in) :: table
      real(dp), allocatable, intent(out) :: list(:)                  !! K; 0: not given by the table
      type(monotone_curve_t), allocatable, intent(out) :: curves(:)
      type(error_t), allocatable, intent(inout) :: error
      real(dp), allocatable :: of_row(:)
      integer :: k

      call check_columns(table, error)
      if (.not. allocated(error)) call check_values(table, error)
      if (allocated(error)) return
      allocate (of_row(size(table%line)), source=0.0_dp)
      if (table%column(temperature) > 0) of_row = table%values(:, table%column(temperature))
      call list_temperatures(of_row, list)
      allocate (curves(size(list)))
      do k = 1, size(list)
         call make_curve(table, pack([(k, k=1, size(of_row))], abs(of_row - list(k)) <= 0), curves(k), error)
         if (allocated(error)) return
      end do
   end subroutine read_curves

   !> Refuse a table that lacks a column or has an unknown one.
   pure subroutine check_columns(table, error)
      type(number_table_t), intent(in) :: table
      type(error_t), allocatable, intent(inout) :: error
      character(len=*), parameter :: columns = ': the columns are '//pressure//', '//viscosity// &
                                               ' and, of more than one temperature, '//temperature
      character(len=:), allocatable :: missing
      integer :: i

      do i = 1, size(table%names)
         if (any(table%names(i) == [character(len=len(viscosity)) :: pressure, temperature, viscosity])) cycle
         call raise(error, table%path//": column '"//shown(trim(table%names(i)))//"' is unknown"//columns)
         return
      end do
      missing = ''
      if (table%column(viscosity) == 0) missing = viscosity
      if (table%column(pressure) == 0) missing = pressure
      if (missing /= '') call raise(error, table%path//': has no column '//missing//columns)
   end subroutine check_columns

   !> Refuse a row with a value outside the range of its column.
   pure subroutine check_values(table, error)
      type(number_table_t), intent(in) :: table
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: reason
      real(dp) :: value
      integer :: column, row

      do row = 1, size(table%line)
         do column = 1, size(table%names)
            value = table%values(row, column)
            reason = ''
            select case (table%names(column))
            case (viscosity)
               if (.not. value > 0) reason = 'is not above 0'
            case (pressure)
               if (.not. value >= 0) reason = 'is below 0'
            case (temperature)
               if (value < coldest_k .or. value > hottest_k) &
                  reason = 'is not from '//to_text(coldest_k)//' to '//to_text(hottest_k)//': write kelvin'
            end select
            if (reason == '') cycle
            call raise(error, table%place(row)//trim(table%names(column))//' = '//to_text(value, 6)//' '//reason)
            return
         end do
      end do
   end subroutine check_values

   !> The temperatures that occur, each once, rising.
   pure subroutine list_temperatures(of_row, list)
      real(dp), intent(in) :: of_row(:)
      real(dp), allocatable, intent(out) :: list(:)
      allocate (list(1), source=minval(of_row))
      do while (any(of_row > list(size(list))))
         list = [list, minval(of_row, mask=of_row > list(size(list)))]
      end do
   end subroutine list_temperatures

   !> Curve at one temperature. Viscosity must rise with pressure, from near ambient pressure on.
   pure subroutine make_curve(table, rows, curve, error)
      type(number_table_t), intent(in) :: table
      integer, intent(in) :: rows(:)              !! rows of the temperature
      type(monotone_curve_t), intent(out) :: curve
      type(error_t), allocatable, intent(inout) :: error
      integer :: i, n

      n = size(rows)
      associate (p => table%values(rows, table%column(pressure)), eta => table%values(rows, table%column(viscosity)))
         if (n < fewest) then
            call raise(error, table%place(rows(n))//'only '//to_text(n)//' pressures of this temperature: give at '// &
                       'least '//to_text(fewest)//' (rows of one temperature have the same '//temperature//')')
         else if (p(1) > ambient_limit_pa) then
            call raise(error, table%place(rows(1))//'the first '//pressure//' is '//to_text(p(1), 6)//', above '// &
                       to_text(ambient_limit_pa, 6)//': add the viscosity at ambient pressure (0, or 1e5)')
         end if
         do i = 2, n
            if (allocated(error)) return
            if (p(i) <= p(i - 1)) then
               call raise(error, table%place(rows(i))//pressure//' = '//to_text(p(i), 6)//' does not rise after '// &
                          to_text(p(i - 1), 6)//': sort the rows of each temperature, each pressure once')
            else if (eta(i) <= eta(i - 1)) then
               call raise(error, table%place(rows(i))//viscosity//' = '//to_text(eta(i), 6)//' does not rise after '// &
                          to_text(eta(i - 1), 6)//': viscosity rises with pressure')
            end if
         end do
         if (allocated(error)) return
         if (p(n) < reach_pa) call raise(error, table%place(rows(n))//'the last '//pressure//' is '// &
                                         to_text(p(n), 6)//', below '//to_text(reach_pa, 6)// &
                                         ': write pascals, or measure farther')
         curve = new_monotone_curve(p, log(eta))
      end associate
   end subroutine make_curve

end module ehlwave_viscosity_table
