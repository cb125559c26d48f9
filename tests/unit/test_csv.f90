!> The reader of comma-separated tables.
program test_csv
   use ehlwave_csv, only: csv_t, read_csv
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
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
   call check_numbers()
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
      real(dp) :: value
      call write_file('# comment'//lf//' Load , "Name"'//cr//lf//lf//'1.5e2, ''x'''//cr//lf//'-3,y')
      call read_csv(path, table, error)
      call test%check_no_error(error, 'good file')
      if (allocated(error)) return
      call test%check_equal(trim(table%names(1))//'|'//trim(table%names(2)), 'load|name', 'names')
      call test%check_equal(trim(table%cells(2, 1))//trim(table%cells(2, 2)), 'xy', 'text cells, no line end at the end')
      call test%check(all(table%line == [4, 5]), 'line numbers')
      call table%real_value(1, 1, value, error)
      call test%check_close(value, 150.0_dp, 'number', relative=0.0_dp)
      call table%real_value(1, 2, value, error)
      call test%check_close(value, -3.0_dp, 'negative number', relative=0.0_dp)
      call test%check_no_error(error, 'numbers')
   end subroutine check_good

   subroutine check_bad(text, needle, what)
      character(len=*), intent(in) :: text, needle, what
      type(csv_t) :: table
      type(error_t), allocatable :: error
      call write_file(text)
      call read_csv(path, table, error)
      call test%check_error(error, needle, what)
   end subroutine check_bad

   subroutine check_numbers()
      character(len=8), parameter :: wrong(8) = [character(len=8) :: 'nan', 'inf', '1.2.3', '', '1 2', '--3', 'e', '1e999']
      type(csv_t) :: table
      type(error_t), allocatable :: error
      real(dp) :: value
      integer :: i
      do i = 1, size(wrong)
         call write_file('a,b'//lf//'1,1'//lf//'1,'//trim(wrong(i))//lf)
         if (allocated(error)) deallocate (error)
         call read_csv(path, table, error)
         call test%check_no_error(error, 'table')
         value = 7
         call table%real_value(2, 2, value, error)
         call test%check_error(error, path//':3: column b', 'not a number: '//wrong(i))
         call test%check_close(value, 7.0_dp, 'value untouched', relative=0.0_dp)
      end do
   end subroutine check_numbers

end program test_csv
