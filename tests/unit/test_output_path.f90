!> Names under which results can be written, and those that are refused before anything is computed.
program test_output_path
   use ehlwave_errors, only: error_t
   use ehlwave_output_path, only: check_output_path
   use ehlwave_posix, only: file_kind, kind_file, kind_link, kind_other, replace_file
   use testing, only: test_t
   implicit none (type, external)

   character(len=*), parameter :: folder = 'test_output_path.tmp'
   type(test_t) :: test
   integer :: status

   call execute_command_line('rm -rf '//folder//' && mkdir '//folder//' && cd '//folder//' && mkfifo pipe && echo kept >'// &
                             ' victim &&'// &
                             ' ln -s victim link && ln -s nowhere dangling && : > empty.h5 && echo data > data.h5 &&'// &
                             ' ln data.h5 twin.h5 &&'// &
                             ' mkdir sub && ln -s ../data.h5 sub/link.nml && ln -s victim new.h5.part && : > '// &
                             'left.h5.part-abcdefgh && : > other.h5.part-abcdefgh && : > left.h5.part-HOLIDAYS')
   call execute_command_line('printf ''\211HDF\r\n\032\n torn'' > '//folder//'/torn.h5')
   call accept(folder//'/new.h5')
   call accept(folder//'/left.h5')
   call check_left('left.h5.part-abc*', 0, 'what a dead process left of this file is removed')
   call check_left('left.h5.part-HOL*', 1, 'what it cannot have left stays')
   call check_left('other.h5.part-*', 1, 'what is of another file stays')
   call refuse(folder//'/pipe', 'not a regular file')
   call test%check_equal(file_kind(folder//'/pipe'), kind_other, 'the pipe is still there')
   call refuse('/dev/null', 'not a regular file')
   call refuse(folder//'/link', 'it is a link')
   call refuse(folder//'/dangling', 'it is a link')
   call refuse(folder, 'it is a folder')
   call refuse(folder//'/', 'names no file')
   call refuse('  ', 'names no file')
   call refuse(folder//'/empty.h5', 'no result of ehlwave')
   call refuse(folder//'/data.h5', 'no result of ehlwave')
   call accept(folder//'/data.h5', overwrites=.true.)
   call refuse(folder//'/torn.h5', 'it is a damaged HDF5 file')
   call accept(folder//'/torn.h5', has_store=.true.)
   call accept(folder//'/torn.h5', overwrites=.true.)
   call refuse_beside_store(folder//'/data.h5')
   call refuse(folder//'/data.h5', 'which the run reads', input=folder//'/data.h5')
   call refuse(folder//'/data.h5', 'which the run reads', input=folder//'/sub/../data.h5')
   call refuse(folder//'/data.h5', 'which the run reads', input=folder//'/sub/link.nml')
   call refuse(folder//'/data.h5', 'which the run reads', input=folder//'/twin.h5')
   call refuse(folder//'/new', 'ends in .h5')
   call refuse(folder//'/new.csv', 'ends in .h5')
   call refuse(folder//'/new.H5', 'ends in .h5')
   call refuse(folder//'/.h5', 'ends in .h5')
   call refuse('no-such-folder/file.h5', 'cannot write')
   call refuse(folder//'/'//repeat('x', 250), 'cannot write')
   call replace_file(folder//'/new.h5', 'results', status)
   call test%check_equal(status, 0, 'a file beside a link of the old name of temporary files')
   call test%check_equal(file_kind(folder//'/new.h5'), kind_file, 'it is a regular file')
   call test%check_equal(file_kind(folder//'/new.h5.part'), kind_link, 'the link stays')
   call execute_command_line('grep -q kept '//folder//'/victim', exitstat=status)
   call test%check_equal(status, 0, 'what it leads to stays')
   call check_left('new.h5.part-*', 0, 'nothing is left')
   call test%finish()

contains

   subroutine accept(path, overwrites, has_store)
      character(len=*), intent(in) :: path
      logical, intent(in), optional :: overwrites, has_store
      type(error_t), allocatable :: error
      call check_output_path(path, [character(len=1) ::], present(overwrites), error, has_store=has_store)
      call test%check_no_error(error, path)
   end subroutine accept

   !> Overwriting is asked for where there is an input: that is refused all the same.
   subroutine refuse(path, needle, input)
      character(len=*), intent(in) :: path, needle
      character(len=*), intent(in), optional :: input
      type(error_t), allocatable :: error
      if (present(input)) then
         call check_output_path(path, [input], .true., error)
      else
         call check_output_path(path, [character(len=1) ::], .false., error)
      end if
      call test%check_error(error, needle, path)
   end subroutine refuse

   !> A file of somebody else is not replaced for the sake of a store.
   subroutine refuse_beside_store(path)
      character(len=*), intent(in) :: path
      type(error_t), allocatable :: error
      call check_output_path(path, [character(len=1) ::], .false., error, has_store=.true.)
      call test%check_error(error, 'no result of ehlwave', path)
   end subroutine refuse_beside_store

   subroutine check_left(pattern, expected, what)
      character(len=*), intent(in) :: pattern, what
      integer, intent(in) :: expected
      integer :: found
      call execute_command_line('exit $(ls '//folder//'/'//pattern//' 2>/dev/null | wc -l)', exitstat=found)
      call test%check_equal(found, expected, what)
   end subroutine check_left

end program test_output_path
