!> The list of cases in a store comes back; without a list there is an error.
program test_sweep_case_list
   use ehlwave_case_list, only: case_list_t, variation_length
   use ehlwave_cost_model, only: feature_count
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_posix, only: make_folder, replace_file
   use ehlwave_text_file, only: read_whole_file
   use testing, only: test_t
   implicit none (type, external)

   character(len=*), parameter :: folder = 'test_sweep_case_list.tmp'
   type(test_t) :: test
   type(case_list_t) :: back, list
   type(error_t), allocatable :: error
   character(len=:), allocatable :: text
   integer :: k, status

   call execute_command_line('rm -rf '//folder)
   call make_folder(folder, status)
   call back%read(folder, error)
   call test%check_error(error, 'no list of cases yet', 'nothing there')
   deallocate (error)

   list%identity = ['00000000000000A1', 'FFFFFFFFFFFFFFB2']
   list%features = reshape([(-1.5_dp**k, k=1, 2*feature_count)], [feature_count, 2])
   list%variation = [character(len=variation_length) :: 'method = ''fas''', '']
   call list%write(folder, error)
   call test%check_no_error(error, 'write')
   call back%read(folder, error)
   call test%check_no_error(error, 'read')
   call test%check(all(back%identity == list%identity), 'identities')
   call test%check(all(back%variation == list%variation), 'what varies')
   call test%check_close(reshape(back%features, [2*feature_count]), reshape(list%features, [2*feature_count]), 'features', &
                         relative=1e-5_dp)

   call read_whole_file(folder//'/cases', text)
   call test%check_equal(index(text, new_line('a')), 16 + 13*feature_count + 1 + len('method = ''fas''') + 1, 'length of a line')
   text(20:20) = '?'
   call replace_file(folder//'/cases', text, status)
   back = case_list_t()
   call back%read(folder, error)
   call test%check_close(sum(abs(back%features(:, 1))), 0.0_dp, 'features that cannot be read are 0', absolute=0.0_dp)
   call test%check_close(back%features(:, 2), list%features(:, 2), 'those of the others stay', relative=1e-5_dp)

   call replace_file(folder//'/cases', text(:len(text) - 20), status)
   back = case_list_t()
   call back%read(folder, error)
   call test%check_error(error, 'is not whole', 'a list that is cut short')
   deallocate (error)

   text = repeat('0', 16)//repeat('  1.00000E+00', feature_count)//new_line('a')
   call replace_file(folder//'/cases', text, status)
   back = case_list_t()
   call back%read(folder, error)
   call test%check_equal(trim(back%variation(1)), '', 'a list without what varies')

   call list%write('no-such-folder', error)
   call test%check_error(error, 'cannot write', 'no folder')
   call test%finish()

end program test_sweep_case_list
