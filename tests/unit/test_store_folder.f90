!> Folders that are stores, and folders left alone because they are none.
program test_store_folder
   use ehlwave_errors, only: error_t
   use ehlwave_posix, only: make_folder, replace_file
   use ehlwave_store_folder, only: check_store, refuse_inside_store, take_folder
   use ehlwave_store_names, only: log_name, newest_defaults, store_path
   use ehlwave_store_removal, only: discard_store
   use testing, only: test_t
   implicit none (type, external)

   character(len=*), parameter :: folder = 'test_store_folder.store', file = folder//'/notes'
   type(test_t) :: test

   call execute_command_line('rm -rf '//folder)
   call check_names()
   call check_file()
   call check_foreign_folder()
   call check_life()
   call check_foreign_parts()
   call check_other_format()
   call test%finish()

contains

   subroutine check_names()
      call test%check_equal(store_path('out/results.h5'), 'out/results.store', 'of a results file')
      call test%check_equal(store_path('results'), 'results.store', 'of another name')
      call test%check_equal(store_path('results.store'), 'results.store', 'of a store')
      call test%check_equal(store_path('results.store/'), 'results.store', 'of a store with a slash')
      call test%check_equal(log_name(12, 3), '000012-000003.log', 'log')
   end subroutine check_names

   subroutine check_file()
      type(error_t), allocatable :: error
      character(len=:), allocatable :: warning
      integer :: status
      call replace_file(folder, 'a file', status)
      call take_folder(folder, newest_defaults, warning, error)
      call test%check_error(error, 'is not a folder', 'a file in place of a store')
      call execute_command_line('rm -rf '//folder)
   end subroutine check_file

   subroutine check_foreign_folder()
      type(error_t), allocatable :: error
      character(len=:), allocatable :: warning
      integer :: status
      logical :: is_there
      call make_folder(folder, status)
      call replace_file(file, 'of somebody else', status)
      call take_folder(folder, newest_defaults, warning, error)
      call test%check_error(error, 'not the store of a sweep', 'the folder of somebody else')
      deallocate (error)
      call discard_store(folder, error)
      call test%check_error(error, 'not the store of a sweep', 'it is not removed')
      inquire (file=file, exist=is_there)
      call test%check(is_there, 'what is in it stays')
      call execute_command_line('rm -rf '//folder)
   end subroutine check_foreign_folder

   subroutine check_life()
      type(error_t), allocatable :: error
      character(len=:), allocatable :: warning
      logical :: is_there
      call check_store(folder, is_there, error)
      call test%check(.not. is_there .and. .not. allocated(error), 'nothing')
      call take_folder(folder, newest_defaults, warning, error)
      call test%check_no_error(error, 'a new store')
      call check_store(folder, is_there, error)
      call test%check(is_there .and. .not. allocated(error), 'a store')
      call refuse_inside_store(folder//'/r.h5', error)
      call test%check_error(error, 'is the store of a sweep', 'results in a store')
      deallocate (error)
      call refuse_inside_store(folder//'/fields/../fields/r.h5', error)
      call test%check_error(error, 'is the store of a sweep', 'results in a folder of a store')
      deallocate (error)
      call refuse_inside_store('r.h5', error)
      call test%check_no_error(error, 'results beside a store')
      call discard_store(folder, error)
      call test%check_no_error(error, 'discard')
      call check_store(folder, is_there, error)
      call test%check(.not. is_there, 'nothing again')
      call take_folder('no-such-folder/a.store', newest_defaults, warning, error)
      call test%check_error(error, 'cannot write', 'in a folder that is not there')
   end subroutine check_life

   !> Foreign files in a store, and links in place of its parts, stay untouched.
   subroutine check_foreign_parts()
      character(len=*), parameter :: other = 'test_store_folder.other', identity = '0123456789ABCDEF'
      type(error_t), allocatable :: error
      character(len=:), allocatable :: warning
      integer :: status
      logical :: is_there

      call take_folder(folder, newest_defaults, warning, error)
      call replace_file(folder//'/fields/mine.h5', 'kept', status)
      call replace_file(folder//'/fields/'//identity//'.h5', 'ours', status)
      call discard_store(folder, error)
      call test%check_error(error, "holds 'mine.h5'", 'a file of somebody among the fields')
      deallocate (error)
      inquire (file=folder//'/fields/'//identity//'.h5', exist=is_there)
      call test%check(is_there, 'nothing is removed')
      call execute_command_line('rm -rf '//other//' && mkdir '//other//' && mv '//folder//'/fields/* '//other//' && rmdir '// &
                                folder//'/fields && ln -s ../'//other//' '//folder//'/fields')
      call discard_store(folder, error)
      call test%check_error(error, 'is a link', 'fields elsewhere')
      deallocate (error)
      call take_folder(folder, newest_defaults, warning, error)
      call test%check_error(error, 'is a link', 'nor is it gone on with')
      deallocate (error)
      inquire (file=other//'/'//identity//'.h5', exist=is_there)
      call test%check(is_there, 'what a link leads to stays')
      call execute_command_line('rm -rf '//other//' '//folder)
   end subroutine check_foreign_parts

   subroutine check_other_format()
      type(error_t), allocatable :: error
      character(len=:), allocatable :: warning
      integer :: status
      logical :: is_there
      call take_folder(folder, newest_defaults, warning, error)
      call replace_file(folder//'/store', 'ehlwave-store 99'//new_line('a'), status)
      call check_store(folder, is_there, error)
      call test%check_error(error, 'ehlwave-store 99', 'a store of another format')
      call execute_command_line('rm -rf '//folder)
   end subroutine check_other_format

end program test_store_folder
