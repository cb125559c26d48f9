!> The files that a case reads: tables of numbers, the list of files, their digests.
program test_case_files
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_keys, only: case_key_list
   use ehlwave_case_files, only: case_file_t, case_files, file_changed_since, file_digests, note_digest, paths_read
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_number_file, only: read_number_table
   use ehlwave_number_table, only: number_table_t
   use testing, only: test_t
   implicit none (type, external)

   character(len=*), parameter :: path = 'test_case_files.csv', lf = new_line('a')
   type(test_t) :: test

   call check_table()
   call check_refusals()
   call check_files()
   call test%finish()

contains

   subroutine write_file(text)
      character(len=*), intent(in) :: text
      integer :: unit
      open (newunit=unit, file=path, access='stream', form='unformatted', status='replace')
      write (unit) text
      close (unit)
   end subroutine write_file

   !> Numbers by name and line; their digest ignores comments and spelling.
   subroutine check_table()
      type(number_table_t) :: other, same, table
      type(error_t), allocatable :: error

      call test%check(.not. table%is_from(path), 'nothing is read yet')
      call write_file('# oil'//lf//'Pressure_Pa,b'//lf//'1e5,2'//lf//lf//'-3.5d0,0'//lf)
      call read_number_table(path, table, error)
      call test%check_no_error(error, 'good file')
      call test%check(table%is_from(path) .and. .not. table%is_from(path//'x'), 'its name is kept')
      call test%check(all([table%column('pressure_pa'), table%column('b'), table%column('c')] == [1, 2, 0]), &
                      'columns by name')
      call test%check_close(reshape(table%values, [4]), [1e5_dp, -3.5_dp, 2.0_dp, 0.0_dp], 'values', absolute=0.0_dp)
      call test%check_equal(table%place(2), path//':5: ', 'place of a row')
      call write_file('pressure_pa,b'//lf//'100000.0,2.0'//lf//'-3.5,0'//lf)
      call read_number_table(path, same, error)
      call test%check_equal(same%digest(), table%digest(), 'digest of the same numbers')
      call write_file('pressure_pa,b'//lf//'100000.0,2.0'//lf//'-3.5,1e-300'//lf)
      call read_number_table(path, other, error)
      call test%check(other%digest() /= table%digest(), 'digest of others')
   end subroutine check_table

   subroutine check_refusals()
      call refuse('a,b'//lf//'1,2'//lf//'1,two'//lf, path//':3: column b: ')
      call refuse('a,b'//lf//'1,'//lf, path//':2: column b: ')
      call refuse('a,b'//lf//'1,nan'//lf, path//':2: column b: ')
      call refuse('a,b'//lf//'1e999,1'//lf, path//':2: column a: 1e999 is too large')
   end subroutine check_refusals

   subroutine refuse(text, needle)
      character(len=*), intent(in) :: text, needle
      type(number_table_t) :: table
      type(error_t), allocatable :: error
      call write_file(text)
      call read_number_table(path, table, error)
      call test%check_error(error, needle, needle)
   end subroutine refuse

   !> Every file that a key names, with its path where the case reads it.
   subroutine check_files()
      type(case_t) :: case
      type(case_file_t), allocatable :: files(:)
      character(len=:), allocatable :: before, paths(:)
      integer :: i, surface

      allocate (files, source=case_files(case_key_list(case)))
      call test%check(all([(files(i)%path == '', i=1, size(files))]), 'the usual case reads none')
      case%surface_file = 's.h5'
      files = case_files(case_key_list(case))
      surface = findloc(files%name == 'surface', .true., 1)
      call test%check(surface > 0, 'a measured surface is a file')
      if (surface == 0) return
      call test%check_equal(files(surface)%path//' '//files(surface)%key, 's.h5 &surface file', 'path and key')
      call note_digest(files, 's.h5', '0123456789abcdef')
      call test%check_equal(count(files%digest == '0123456789abcdef'), 1, 'the digest of one file')
      call test%check_equal(files(surface)%digest, '0123456789abcdef', 'noted where it belongs')
      call test%check_equal(file_changed_since(files, file_digests(files)), 0, 'no file has changed')
      before = file_digests(files)
      do i = 1, size(files)
         files(i)%digest(16:16) = 'x'
         call test%check_equal(file_changed_since(files, before), i, 'a file that has changed')
         call test%check(file_digests(files) /= before, 'as the digests of all show')
         files(i)%digest = before(16*(i - 1) + 1:16*i)
      end do
      paths = paths_read(files)
      call test%check(size(paths) == 1, 'one file is read')
      if (size(paths) == 1) call test%check_equal(paths(1), 's.h5', 'its path')
   end subroutine check_files

end program test_case_files
