!> Data written to an HDF5 file come back bit for bit with their units and names, and no failure goes unnoticed.
program test_hdf5_file
   use ehlwave_errors, only: error_t
   use ehlwave_hdf5_file, only: hdf5_file_t
   use ehlwave_kinds, only: dp
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_quantity_output, only: write_quantities
   use hdf5_readback, only: attribute_of, numbers_of, text_of
   use testing, only: test_t
   implicit none (type, external)

   character(len=*), parameter :: path = 'test_hdf5_file.h5'
   type(test_t) :: test

   call check_round_trip()
   call check_long_dataset()
   call check_quantities()
   call check_failures()
   call test%finish()

contains

   subroutine check_round_trip()
      type(hdf5_file_t) :: file
      type(error_t), allocatable :: error
      real(dp) :: plane(3, 2)

      plane = reshape([0.1_dp, 1/3.0_dp, -7e-300_dp, 4.0_dp, 5.0_dp, 1e300_dp], [3, 2])
      call file%create(path, error)
      call test%check_no_error(error, 'create')
      call file%attribute('title', 'a text ')
      call file%attribute('empty', '')
      call file%write('x', plane(:, 1), 'm', 'place')
      call file%dimension('x')
      call file%write('y', [1, -2], '1', 'number')
      call file%dimension('y')
      call file%write('plane', plane, 'Pa', 'pressure', 'x', 'y')
      call file%write('one', plane(2, 1), 's', 'time')
      call file%write('words', [character(len=6) :: 'a', 'longer'], '', 'some words', 'y')
      call test%check(file%has('one'), 'a dataset that was written')
      call test%check(.not. file%has('two'), 'a dataset that was not')
      call file%finish(error)
      call test%check_no_error(error, 'finish')

      call test%check_close(numbers_of(path, 'plane'), reshape(plane, [6]), 'plane', relative=0.0_dp)
      call test%check_close(numbers_of(path, 'one'), plane(2:2, 1), 'one number', relative=0.0_dp)
      call test%check_close(numbers_of(path, 'y'), [1.0_dp, -2.0_dp], 'whole numbers', relative=0.0_dp)
      call test%check_equal(text_of(path, 'words', 1), 'a', 'short text')
      call test%check_equal(text_of(path, 'words', 2), 'longer', 'long text')
      call test%check_equal(attribute_of(path, 'plane', 'units'), 'Pa', 'units')
      call test%check_equal(attribute_of(path, 'plane', 'long_name'), 'pressure', 'long name')
      call test%check_equal(attribute_of(path, 'words', 'units'), '?', 'no units of a text')
      call test%check_equal(attribute_of(path, 'x', 'NAME'), 'x', 'a scale has its name')
      call test%check_equal(attribute_of(path, '/', 'title'), 'a text', 'attribute')
      call test%check_equal(attribute_of(path, '/', 'empty'), '', 'empty attribute')
   end subroutine check_round_trip

   !> Long datasets are compressed, which must not change them.
   subroutine check_long_dataset()
      integer, parameter :: n = 40000
      type(hdf5_file_t) :: file
      type(error_t), allocatable :: error
      real(dp), allocatable :: values(:)
      integer :: i
      allocate (values, source=[(sin(1.0_dp*i), i=1, n)])
      call file%create(path, error)
      call file%write('long', values, '1', 'many numbers')
      call file%finish(error)
      call test%check_close(numbers_of(path, 'long'), values, 'long dataset', relative=0.0_dp)
   end subroutine check_long_dataset

   subroutine check_quantities()
      type(quantity_list_t) :: list
      type(hdf5_file_t) :: file
      type(error_t), allocatable :: error
      call list%add('film', 'film thickness', 0.1_dp, unit='um')
      call list%add('count', 'how many', 3)
      call list%add('is_good', 'whether it is', .true.)
      call list%add('name', 'what it is called', 'abc')
      call list%add('absent', 'what others have', 1.0_dp, exists=.false.)
      call file%create(path, error)
      call write_quantities(file, list)
      call file%finish(error)
      call test%check_no_error(error, 'quantities')
      call test%check_close(numbers_of(path, 'film'), [0.1_dp], 'real', relative=0.0_dp)
      call test%check_equal(attribute_of(path, 'film', 'units'), 'um', 'unit of a quantity')
      call test%check_equal(attribute_of(path, 'film', 'long_name'), 'film thickness', 'long name of a quantity')
      call test%check_close(numbers_of(path, 'count'), [3.0_dp], 'whole number', relative=0.0_dp)
      call test%check_close(numbers_of(path, 'is_good'), [1.0_dp], 'truth', relative=0.0_dp)
      call test%check_equal(attribute_of(path, '/', 'name'), 'abc', 'a text is an attribute')
      call test%check_equal(size(numbers_of(path, 'absent')), 0, 'what does not exist is not written')
   end subroutine check_quantities

   subroutine check_failures()
      type(hdf5_file_t) :: file
      type(error_t), allocatable :: error

      call file%create(path, error)
      call file%write('twice', 1.0_dp, '1', 'a number')
      call file%write('twice', 2.0_dp, '1', 'another of its name')
      call file%finish(error)
      call test%check_error(error, path, 'a name given twice')
      call test%check_close(numbers_of(path, 'film'), [0.1_dp], 'the file before is still there', relative=0.0_dp)

      call file%create(path, error)
      call file%dimension('nowhere')
      call file%finish(error)
      call test%check_error(error, path, 'a scale that is not there')

      call file%create('no-such-folder/file.h5', error)
      call file%write('one', 1.0_dp, '1', 'a number')
      call file%finish(error)
      call test%check_error(error, 'no-such-folder', 'no folder')
   end subroutine check_failures

end program test_hdf5_file
