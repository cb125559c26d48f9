!> A small table from a comma-separated file: a line of column names, then rows of values.
module ehlwave_csv
   use ehlwave_errors, only: error_t, raise
   use ehlwave_identity_index, only: identity_index_t, text_identity
   use ehlwave_text, only: lower_case, next_line, shown, to_text
   use ehlwave_text_file, only: read_text
   implicit none (type, external)
   private
   public :: parse_csv, read_csv

   integer, parameter, public :: cell_length = 64
   character(len=*), parameter :: byte_order_mark = char(239)//char(187)//char(191)   ! as spreadsheets write it

   !> Column k of row i is the part k + (i - 1)*columns of the text.
   type, public :: csv_t
      character(len=:), allocatable :: path
      character(len=cell_length), allocatable :: names(:)      !! (columns), lower case
      integer, allocatable :: line(:)                          !! (rows) line number in the file
      character(len=:), allocatable, private :: text
      integer, allocatable, private :: first(:), last(:)       ! ends of each cell in the text; the arrays may be longer
      integer, private :: count = 0                            ! number of cells
   contains
      procedure :: cell
      procedure :: place
      procedure, private :: split
      procedure, private :: take
   end type csv_t

contains

   !> Read a file. Empty lines, lines that begin with # and a byte order mark are skipped; quotes around values are
   !> dropped.
   !> Fails on an unreadable file, on rows of another length than the header, and on values that are too long.
   subroutine read_csv(path, table, error)
      character(len=*), intent(in) :: path
      type(csv_t), intent(out) :: table
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: text

      if (allocated(error)) return
      call read_text(path, text, error)
      if (.not. allocated(error)) call parse_csv(path, text, table, error)
   end subroutine read_csv

   !> Parse a table from a text in memory.
   subroutine parse_csv(path, text, table, error)
      character(len=*), intent(in) :: path   !! where the text is from, for messages
      character(len=*), intent(in) :: text
      type(csv_t), intent(out) :: table
      type(error_t), allocatable, intent(inout) :: error
      integer :: begin, cells, first, i, last, number

      table%path = path
      table%text = text
      do i = 1, len(table%text)
         if (table%text(i:i) == achar(13) .or. table%text(i:i) == achar(9)) table%text(i:i) = ' '
      end do
      allocate (table%line(0), table%first(64), table%last(64))
      number = 0
      last = -1
      if (index(table%text, byte_order_mark) == 1) table%text(:len(byte_order_mark)) = ''
      do while (next_line(table%text, first, last))
         number = number + 1
         begin = first + verify(table%text(first:last), ' ') - 1
         if (begin < first) cycle
         if (table%text(begin:begin) == '#') cycle
         cells = table%count
         call table%split(first, last, error)
         if (allocated(error)) then
            error%message = path//':'//to_text(number)//': '//error%message
         else if (.not. allocated(table%names)) then
            call take_names(table, number, error)
         else if (table%count - cells /= size(table%names)) then
            call raise(error, path//':'//to_text(number)//': '//to_text(table%count - cells)// &
               ' values where the header has '//to_text(size(table%names))//' columns')
         else
            if (table%count > size(table%names)*size(table%line)) table%line = [table%line, table%line, number]
            table%line(table%count/size(table%names)) = number
         end if
         if (allocated(error)) return
      end do
      if (table%count > 0) table%line = table%line(:table%count/size(table%names))
      if (size(table%line) == 0) call raise(error, path//': no rows: give a line of column names and at least one row')
   end subroutine parse_csv

   !> The cells so far are the names of the columns.
   subroutine take_names(table, number, error)
      type(csv_t), intent(inout) :: table
      integer, intent(in) :: number   !! line of the header
      type(error_t), allocatable, intent(inout) :: error
      type(identity_index_t) :: known
      integer :: i, place
      allocate (table%names(table%count))
      do i = 1, size(table%names)
         table%names(i) = lower_case(table%text(table%first(i):table%last(i)))
         call known%add(text_identity(trim(table%names(i))), place)
         if (place == i) cycle
         call raise(error, table%path//':'//to_text(number)//": column '"//shown(trim(table%names(i)))// &
            "' is given twice")
         return
      end do
      table%count = 0
   end subroutine take_names

   !> Take the cells of the line text(first:last).
   subroutine split(self, first, last, error)
      class(csv_t), intent(inout) :: self
      integer, intent(in) :: first, last
      type(error_t), allocatable, intent(inout) :: error
      integer :: at, i
      at = first
      do i = first, last + 1
         if (i <= last) then
            if (self%text(i:i) /= ',') cycle
         end if
         call self%take(at, i - 1, error)
         if (allocated(error)) return
         at = i + 1
      end do
   end subroutine split

   !> Take the cell text(first:last), without blanks and quotes around it.
   subroutine take(self, first, last, error)
      class(csv_t), intent(inout) :: self
      integer, intent(in) :: first, last
      type(error_t), allocatable, intent(inout) :: error
      integer :: a, b

      b = first + len_trim(self%text(first:last)) - 1
      a = first + max(1, verify(self%text(first:b), ' ')) - 1
      if (b > a) then
         if (scan(self%text(a:a), '"''') == 1 .and. self%text(a:a) == self%text(b:b)) then
            a = a + 1
            b = b - 1
         end if
      end if
      if (b - a + 1 > cell_length) call raise(error, 'value longer than '//to_text(cell_length)//' characters')
      if (self%count == size(self%first)) then
         self%first = [self%first, self%first]   ! room for as many again
         self%last = [self%last, self%last]
      end if
      self%count = self%count + 1
      self%first(self%count) = a
      self%last(self%count) = b
   end subroutine take

   !> Value as written, without blanks and quotes around it.
   function cell(self, column, row)
      class(csv_t), intent(in) :: self
      integer, intent(in) :: column, row
      character(len=:), allocatable :: cell
      integer :: i
      i = column + (row - 1)*size(self%names)
      cell = trim(self%text(self%first(i):self%last(i)))
   end function cell

   !> `FILE:LINE: column NAME: ` for messages.
   function place(self, column, row)
      class(csv_t), intent(in) :: self
      integer, intent(in) :: column, row
      character(len=:), allocatable :: place
      place = self%path//':'//to_text(self%line(row))//': column '//trim(self%names(column))//': '
   end function place

end module ehlwave_csv
