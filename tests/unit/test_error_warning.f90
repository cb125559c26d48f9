!> Large errors of results make a warning, whatever the result is.
program test_error_warning
   use ehlwave_error_warning, only: error_warning, largest_error
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_quantity, only: quantity_list_t
   use testing, only: test_t
   implicit none (type, external)

   character(len=*), parameter :: advice = '; use more cells (&grid) or an accuracy (&solver)'
   type(quantity_list_t) :: list
   type(test_t) :: test

   call list%add('a_error', '', largest_error, error_of='a')
   call list%add('b_error', '', no_value, error_of='b')
   call list%add('c', '', 1e3_dp)
   call list%add('d_error', '', 2.0_dp, error_of='d', exists=.false.)
   call test%check_equal(error_warning(list), '', 'nothing is known badly')
   call list%add('b_error_in_all', '', 1.7_dp, error_of='b')
   call test%check_equal(error_warning(list), 'large errors: b 170 %'//advice, 'one of two errors')
   call list%add('b_again', '', 1.7_dp, error_of='b')
   call list%add('e_error', '', 0.451_dp, error_of='e')
   call test%check_equal(error_warning(list), 'large errors: b 170 %, e 45 %'//advice, 'each once')
   call list%add('e_more', '', 0.52_dp, error_of='e')
   call test%check_equal(error_warning(list), 'large errors: b 170 %, e 52 %'//advice, 'the largest of each')
   call test%finish()
end program test_error_warning
