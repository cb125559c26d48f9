!> The reader of comma-separated tables.
program test_csv
   use ehlwave_csv, only: csv_t, read_csv
   use ehlwave_errors, only: error_t
   use testing, only: test_t
   implicit none (type, external)

   character(len=*), parameter :: path = 'test_csv.csv', lf = new_line('a'), cr = achar(13)
   type(test_t) :: test

   call check_good()
   call check_bad('a,b'//lf//'1,2'//lf//'3'//lf, path//':3: 1 values', 'short row')
   call check_bad('a,b'//lf//'1,2,3'//lf, path//':2: 3 values', 'long row')
   call check_bad('a,b'//lf, 'no rows', 'header only')
   call check_bad('# nothing'//lf, 'no rows', 'comments only')
   call check_bad('a'//lf//repeat('x', 65)//lf, path//':2:', 'long value')
   call check_bad('', 'empty', 'empty file')
   call check_wide()
   call test%finish()

contains

   subroutine write_file(text)
      character(len=*), intent(in) :: text
      integer :: unit
      open (newunit=unit, file=path, access='stream', form='unformatted', status='replace')
      write (unit) text
      close (unit)
   end subroutine write_file

   subroutine check_good()
      type(csv_t) :: table
      type(error_t), allocatable :: error
      call write_file('# comment'//lf//' Load , "Name"'//cr//lf//lf//'1.5e2, ''x'''//cr//lf//'-3,y')
      call read_csv(path, table, error)
      call test%check_no_error(error, 'good file')
      if (allocated(error)) return
      call test%check_equal(trim(table%names(1))//'|'//trim(table%names(2)), 'load|name', 'names')
      call test%check_equal(table%cell(2, 1)//table%cell(2, 2), 'xy', 'text cells, no line end at the end')
      call test%check(all(table%line == [4, 5]), 'line numbers')
      call test%check_equal(table%cell(1, 1)//table%cell(1, 2), '1.5e2-3', 'numbers as written')
   end subroutine check_good

   subroutine check_bad(text, needle, what)
      character(len=*), intent(in) :: text, needle, what
      type(csv_t) :: table
      type(error_t), allocatable :: error
      call write_file(text)
      call read_csv(path, table, error)
      call test%check_error(error, needle, what)
   end subroutine check_bad

   !> Exports of a spreadsheet: a byte order mark, many columns.
   subroutine check_wide()
      integer, parameter :: n = 50000
      type(csv_t) :: table
      type(error_t), allocatable :: error
      character(len=:), allocatable :: header
      integer :: i
      allocate (character(len=8*n) :: header)
      do i = 1, n
         write (header(8*i - 7:8*i), '(a,i6.6,a)') 'c', i, ','
      end do
      call write_file(char(239)//char(187)//char(191)//header(:8*n - 1)//lf//repeat('7,', n - 1)//'8'//lf)
      call read_csv(path, table, error)
      call test%check_no_error(error, 'wide file')
      call test%check_equal(trim(table%names(1))//trim(table%names(n)), 'c000001c050000', 'names behind a byte order mark')
      call test%check_equal(trim(table%cell(n - 1, 1))//trim(table%cell(n, 1)), '78', 'last cells')
      call write_file(header//'c000077'//lf//repeat('7,', n)//'8'//lf)
      call read_csv(path, table, error)
      call test%check_error(error, path//":1: column 'c000077' is given twice", 'doubled name')
   end subroutine check_wide

end program test_csv
