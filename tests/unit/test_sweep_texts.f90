!> Small texts of a sweep: differences of inputs, times, the index of identities.
program test_sweep_texts
   use ehlwave_errors, only: error_t
   use ehlwave_identity_index, only: identity_index_t
   use ehlwave_kinds, only: dp
   use ehlwave_text_difference, only: text_difference, text_from_difference
   use ehlwave_time_text, only: read_time
   use testing, only: test_t
   implicit none (type, external)

   character(len=*), parameter :: lf = new_line('a')
   type(test_t) :: test

   call check_difference('a = 1'//lf//'b: 2'//lf//'c'//lf, 'a = 1'//lf//'b: 3'//lf//'c'//lf, '2:b: 3'//lf)
   call check_difference('a'//lf//'b'//lf, 'a'//lf//'b'//lf, '')
   call check_difference('a'//lf//'b'//lf, 'x'//lf//'y'//lf, '1:x'//lf//'2:y'//lf)
   call check_difference('a'//lf//'b'//lf, 'a'//lf, '=a'//lf)
   call check_difference('a'//lf, 'a'//lf//'b'//lf, '=a'//lf//'b'//lf)
   call check_difference('', 'a'//lf, '=a'//lf)
   call check_time('90', 90.0_dp)
   call check_time('0.5', 0.5_dp)
   call check_time('1:30', 90.0_dp)
   call check_time('2:00:05', 7205.0_dp)
   call check_time('1-02:00:00', 93600.0_dp)
   call check_bad_time('')
   call check_bad_time('0')
   call check_bad_time('an hour')
   call check_bad_time('1:2:3:4')
   call check_bad_time('1-2:3')
   call check_bad_time('1:')
   call check_index()
   call test%finish()

contains

   subroutine check_difference(base, text, expected)
      character(len=*), intent(in) :: base, text, expected
      call test%check_equal(text_difference(base, text), expected, 'difference')
      call test%check_equal(text_from_difference(base, text_difference(base, text)), text, 'and back')
   end subroutine check_difference

   subroutine check_time(text, expected)
      character(len=*), intent(in) :: text
      real(dp), intent(in) :: expected
      type(error_t), allocatable :: error
      real(dp) :: seconds
      call read_time(text, '--time-limit', seconds, error)
      call test%check_no_error(error, text)
      call test%check_close(seconds, expected, text, relative=0.0_dp)
   end subroutine check_time

   subroutine check_bad_time(text)
      character(len=*), intent(in) :: text
      type(error_t), allocatable :: error
      real(dp) :: seconds
      call read_time(text, '--time-limit', seconds, error)
      call test%check_error(error, '--time-limit', 'bad time '//text)
   end subroutine check_bad_time

   subroutine check_index()
      integer, parameter :: n = 5000
      type(identity_index_t) :: index
      character(len=16) :: identity
      integer :: again, i, place, wrong
      call test%check_equal(index%find('0000000000000000'), 0, 'nothing in an empty index')
      wrong = 0
      do i = 1, n
         write (identity, '(z16.16)') i*7919
         call index%add(identity, place)
         call index%add(identity, again)
         if (place /= i .or. again /= i) wrong = wrong + 1
      end do
      do i = 1, n
         write (identity, '(z16.16)') i*7919
         if (index%find(identity) /= i) wrong = wrong + 1
         write (identity, '(z16.16)') i*7919 + 1
         if (index%find(identity) /= 0) wrong = wrong + 1
      end do
      call test%check_equal(wrong, 0, 'wrong places')
      call test%check_equal(index%count, n, 'count')
   end subroutine check_index

end program test_sweep_texts
