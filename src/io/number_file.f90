!> Tables of numbers from comma-separated files.
module ehlwave_number_file
   use ehlwave_csv, only: csv_t, read_csv
   use ehlwave_errors, only: error_t, raise
   use ehlwave_namelist_scanner, only: value_t
   use ehlwave_namelist_values, only: read_value
   use ehlwave_number_table, only: number_table_t
   implicit none (type, external)
   private
   public :: read_number_table

contains

   !> Read a table whose columns all hold numbers. Fails on a file that is no such table; the error names the line.
   subroutine read_number_table(path, table, error)
      character(len=*), intent(in) :: path
      type(number_table_t), intent(out) :: table
      type(error_t), allocatable, intent(inout) :: error
      type(csv_t) :: text
      character(len=:), allocatable :: problem
      integer :: column, row

      call read_csv(path, text, error)
      if (allocated(error)) return
      allocate (table%values(size(text%line), size(text%names)))
      do row = 1, size(text%line)
         do column = 1, size(text%names)
            call read_value(value_t(text=text%cell(column, row)), table%values(row, column), problem)
            if (.not. allocated(problem)) cycle
            call raise(error, text%place(column, row)//problem)
            return
         end do
      end do
      table%path = path
      table%names = text%names
      table%line = text%line
   end subroutine read_number_table

end module ehlwave_number_file
