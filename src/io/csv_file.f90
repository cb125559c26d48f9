!> A small table from a comma-separated file: a line of column names, then rows of values.
module ehlwave_csv
   use ehlwave_errors, only: error_t, raise
   use ehlwave_identity_index, only: identity_index_t, text_identity
   use ehlwave_text, only: count_lines, lower_case, next_line, shown, to_text
   use ehlwave_text_file, only: read_text
   implicit none (type, external)
   private
   public :: read_csv

   integer, parameter, public :: cell_length = 64
   character(len=*), parameter :: byte_order_mark = char(239)//char(187)//char(191)   ! as spreadsheets write it

   type, public :: csv_t
      character(len=:), allocatable :: path
      character(len=cell_length), allocatable :: names(:)      !! (columns), lower case
      character(len=cell_length), allocatable :: cells(:, :)   !! (columns, rows)
      integer, allocatable :: line(:)                          !! (rows) line number in the file
   contains
      procedure :: place
   end type csv_t

contains

   !> Read a file. Empty lines, lines that begin with # and a byte order mark are skipped; quotes around values are
   !> dropped.
   !> Fails on an unreadable file, on rows of another length than the header, and on values that are too long.
   subroutine read_csv(path, table, error)
      character(len=*), intent(in) :: path
      type(csv_t), intent(out) :: table
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: text, line
      character(len=cell_length), allocatable :: values(:)
      integer :: first, last, number, rows

      if (allocated(error)) return
      call read_text(path, text, error)
      if (allocated(error)) return
      table%path = path
      allocate (table%line(count_lines(text)))
      rows = 0
      number = 0
      last = -1
      if (index(text, byte_order_mark) == 1) last = 2
      do while (next_line(text, first, last))
         line = without_return(text(first:last))
         number = number + 1
         if (len_trim(line) == 0) cycle
         if (line(1:1) == '#') cycle
         call split(line, values, error)
         if (allocated(error)) then
            error%message = path//':'//to_text(number)//': '//error%message
            return
         end if
         if (.not. allocated(table%names)) then
            table%names = lower_case(values)
            allocate (table%cells(size(values), size(table%line)))
            call refuse_doubled_names(table, number, error)
            if (allocated(error)) return
         else if (size(values) /= size(table%names)) then
            call raise(error, path//':'//to_text(number)//': '//to_text(size(values))//' values where the header has '// &
                       to_text(size(table%names))//' columns')
            return
         else
            rows = rows + 1
            table%cells(:, rows) = values
            table%line(rows) = number
         end if
      end do
      table%line = table%line(:rows)
      if (allocated(table%cells)) table%cells = table%cells(:, :rows)
      if (rows == 0) call raise(error, path//': no rows: give a line of column names and at least one row')
   end subroutine read_csv

   subroutine refuse_doubled_names(table, number, error)
      type(csv_t), intent(in) :: table
      integer, intent(in) :: number   !! line of the header
      type(error_t), allocatable, intent(inout) :: error
      type(identity_index_t) :: known
      integer :: i, place
      do i = 1, size(table%names)
         call known%add(text_identity(trim(table%names(i))), place)
         if (place == i) cycle
         call raise(error, table%path//':'//to_text(number)//": column '"//shown(trim(table%names(i)))//"' is given twice")
         return
      end do
   end subroutine refuse_doubled_names

   pure function without_return(line) result(clean)
      character(len=*), intent(in) :: line
      character(len=:), allocatable :: clean
      integer :: i
      clean = line
      do i = 1, len(clean)
         if (clean(i:i) == achar(13) .or. clean(i:i) == achar(9)) clean(i:i) = ' '
      end do
      clean = trim(adjustl(clean))
   end function without_return

   subroutine split(line, values, error)
      character(len=*), intent(in) :: line
      character(len=cell_length), allocatable, intent(out) :: values(:)
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: value
      integer :: comma, first, i
      allocate (values(1 + count([(line(i:i) == ',', i=1, len(line))])))
      first = 1
      do i = 1, size(values)
         comma = index(line(first:), ',')
         if (comma == 0) comma = len(line) - first + 2
         value = trim(adjustl(line(first:first + comma - 2)))
         if (len(value) >= 2) then
            if ((value(1:1) == '"' .or. value(1:1) == "'") .and. value(len(value):) == value(1:1)) &
               value = value(2:len(value) - 1)
         end if
         if (len(value) > cell_length) call raise(error, 'value longer than '//to_text(cell_length)//' characters')
         if (allocated(error)) return
         values(i) = value
         first = first + comma
      end do
   end subroutine split

   !> `FILE:LINE: column NAME: ` for messages.
   function place(self, column, row)
      class(csv_t), intent(in) :: self
      integer, intent(in) :: column, row
      character(len=:), allocatable :: place
      place = self%path//':'//to_text(self%line(row))//': column '//trim(self%names(column))//': '
   end function place

end module ehlwave_csv
