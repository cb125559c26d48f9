!> Append-only records: incomplete or damaged records are skipped, all others are read.
program test_record_file
   use ehlwave_errors, only: error_t
   use ehlwave_posix, only: checksum, remove_file
   use ehlwave_kinds, only: i8
   use ehlwave_record_file, only: record_writer_t
   use ehlwave_record_reader, only: next_record, record_reader_t
   use ehlwave_text, only: to_text
   use ehlwave_text_file, only: read_whole_file
   use testing, only: test_t
   implicit none (type, external)

   character(len=*), parameter :: path = 'test_record_file.log'
   character(len=5), parameter :: texts(4) = ['case ', 'a b c', '[1,2]', '"x"  ']
   type(test_t) :: test
   character(len=:), allocatable :: text

   call test%check_equal(checksum('123456789'), 'cbf43926', 'check value of CRC-32')
   call test%check_equal(checksum(''), '00000000', 'CRC-32 of nothing')
   call write_records()
   call read_whole_file(path, text)
   call test%check(allocated(text), 'the file can be read')
   call test%check_equal(good_records(text), 4, 'all records')
   call check_cut_at_every_byte()
   call check_every_damaged_byte()
   call check_existing_file()
   call check_long_file()
   call test%finish()

contains

   subroutine write_records()
      type(record_writer_t) :: writer
      type(error_t), allocatable :: error
      integer :: i, status
      call remove_file(path, status)
      call writer%create(path, error)
      do i = 1, size(texts)
         call writer%append(texts(i), error)
      end do
      call writer%close(error)
      call test%check_no_error(error, 'write')
   end subroutine write_records

   !> Number of good records; each must have been written.
   integer function good_records(file) result(number)
      character(len=*), intent(in) :: file
      integer(i8) :: first, last, position
      integer :: bad
      number = 0
      bad = 0
      position = 1
      do
         call next_record(file, position, first, last, bad)
         if (last == 0) exit
         number = number + 1
         if (.not. any(texts == file(first:last))) call test%check(.false., 'a record that was never written: '//file(first:last))
      end do
   end function good_records

   !> A writer killed after any byte, and a second writer that continues.
   subroutine check_cut_at_every_byte()
      integer :: ends(4), i, n
      n = 0
      do i = 1, len(text)
         if (text(i:i) /= new_line('a')) cycle
         n = n + 1
         ends(n) = i
      end do
      do i = 0, len(text)
         call test%check_equal(good_records(text(:i)), count(ends <= i), 'cut after byte '//to_text(i))
         call test%check_equal(good_records(text(:i)//new_line('a')//text), 4 + count(ends - 1 <= i), &
                               'cut after byte '//to_text(i)//', then more')
      end do
   end subroutine check_cut_at_every_byte

   subroutine check_every_damaged_byte()
      character(len=:), allocatable :: damaged
      integer :: good, i
      do i = 1, len(text)
         damaged = text
         damaged(i:i) = achar(ieor(iachar(text(i:i)), 1))
         good = good_records(damaged)
         ! the end of a line can be found from its length; the last line may be cut off
         call test%check_equal(good, merge(4, 3, text(i:i) == new_line('a') .and. i < len(text)), 'damaged byte '//to_text(i))
      end do
   end subroutine check_every_damaged_byte

   subroutine check_existing_file()
      type(record_writer_t) :: writer
      type(error_t), allocatable :: error
      call writer%create(path, error)
      call test%check_error(error, path, 'a file that exists is not written')
   end subroutine check_existing_file

   !> A file is read in pieces; records can be longer than one, and an endless line is skipped.
   subroutine check_long_file()
      integer, parameter :: lengths(6) = [3, 5000000, 17, 9000000, 4194304, 1]
      type(record_writer_t) :: writer
      type(record_reader_t) :: reader
      type(error_t), allocatable :: error
      integer(i8) :: first, last
      integer :: bad, i, status
      call remove_file(path, status)
      call writer%create(path, error)
      do i = 1, size(lengths)
         call writer%append(repeat(achar(96 + i), lengths(i)), error)
      end do
      call writer%close(error)
      call execute_command_line("head -c 70000000 /dev/zero >> "//path//" && printf '\n352441c2 3 abc\n00000000' >> "//path)
      bad = 0
      call reader%open(path, error)
      do i = 1, size(lengths)
         call reader%next(first, last, bad, error)
         call test%check_equal(int(last - first + 1), lengths(i), 'length of a long record')
         if (last > 0) call test%check(reader%text(first:first) == achar(96 + i), 'its text')
      end do
      call reader%next(first, last, bad, error)
      call test%check_equal(reader%text(first:last), 'abc', 'after a line without end')
      call reader%next(first, last, bad, error)
      call test%check(last == 0, 'that was all')
      call reader%close()
      call test%check_no_error(error, 'a long file')
      call test%check_equal(bad, 2, 'the endless line and the one that was cut off')
      call remove_file(path, status)
   end subroutine check_long_file

end program test_record_file
