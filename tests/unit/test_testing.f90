!> The test support itself: each check must fail when it should. Counts by hand, without the type under
!> test; `finish` is tried in processes of its own, which this program starts with a word as argument.
program test_testing
   use, intrinsic :: ieee_arithmetic, only: ieee_negative_inf, ieee_positive_inf, ieee_quiet_nan, ieee_value
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp, i8
   use testing, only: test_t
   implicit none (type, external)

   character(len=32) :: role
   integer :: wrong, made

   wrong = 0
   made = 0
   call get_command_argument(1, role)
   select case (role)
   case ('nothing', 'pass', 'fail', 'both')
      call finish_as(role)
   case default
      call try_conditions()
      call try_numbers()
      call try_tolerances()
      call try_lists()
      call try_equality()
      call try_errors()
      call try_reports()
      call try_finish()
      print '(i0,a,i0,a)', made - wrong, ' passed, ', wrong, ' failed'
      if (wrong > 0 .or. made == 0) error stop 1
   end select

contains

   subroutine try_conditions()
      type(test_t) :: t
      t%is_quiet = .true.
      call expect(t%passed == 0 .and. t%failed == 0, 'counts begin at 0')
      call t%check(.true., 'a')
      call expect(t%passed == 1 .and. t%failed == 0, 'true passes')
      call t%check(.false., 'a')
      call expect(t%passed == 1 .and. t%failed == 1, 'false fails')
   end subroutine try_conditions

   subroutine try_numbers()
      real(dp) :: nan, inf, minus
      nan = ieee_value(nan, ieee_quiet_nan)
      inf = ieee_value(inf, ieee_positive_inf)
      minus = ieee_value(inf, ieee_negative_inf)
      call expect(close(1.0_dp, 1.0_dp, absolute=0.0_dp), 'equal numbers are close')
      call expect(close(1.05_dp, 1.0_dp, absolute=0.1_dp), 'inside the absolute tolerance')
      call expect(.not. close(1.2_dp, 1.0_dp, absolute=0.1_dp), 'above the absolute tolerance')
      call expect(.not. close(0.8_dp, 1.0_dp, absolute=0.1_dp), 'below the absolute tolerance')
      call expect(close(105.0_dp, 100.0_dp, relative=0.1_dp), 'inside the relative tolerance')
      call expect(close(-105.0_dp, -100.0_dp, relative=0.1_dp), 'inside, negative')
      call expect(close(100.0_dp, 100.0_dp, relative=0.0_dp), 'equal numbers are close, relative')
      call expect(.not. close(120.0_dp, 100.0_dp, relative=0.1_dp), 'outside the relative tolerance')
      call expect(.not. close(105.0_dp, -100.0_dp, relative=0.1_dp), 'wrong sign')
      call expect(.not. close(1e-9_dp, 0.0_dp, relative=0.1_dp), 'a relative tolerance of 0 is 0')
      call expect(close(1e-9_dp, 0.0_dp, relative=0.1_dp, absolute=1e-8_dp), 'either tolerance will do')
      call expect(.not. close(nan, 1.0_dp, relative=1e9_dp, absolute=1e9_dp), 'NaN fails')
      call expect(.not. close(1.0_dp, nan, relative=1e9_dp, absolute=1e9_dp), 'expected NaN fails')
      call expect(.not. close(nan, nan, absolute=1.0_dp), 'NaN against NaN fails')
      call expect(.not. close(inf, 1.0_dp, relative=1.0_dp, absolute=1.0_dp), 'infinity fails')
      call expect(.not. close(1.0_dp, inf, relative=1.0_dp), 'expected infinity fails')
      call expect(.not. close(inf, inf, relative=1.0_dp, absolute=1.0_dp), 'infinity against itself fails')
      call expect(.not. close(minus, minus, relative=1.0_dp), 'minus infinity against itself fails')
   end subroutine try_numbers

   subroutine try_tolerances()
      real(dp) :: nan, inf
      nan = ieee_value(nan, ieee_quiet_nan)
      inf = ieee_value(inf, ieee_positive_inf)
      call expect(.not. close(1.0_dp, 1.0_dp), 'no tolerance fails')
      call expect(.not. close(1.0_dp, 1.0_dp, absolute=nan), 'NaN as absolute tolerance fails')
      call expect(.not. close(1.0_dp, 1.0_dp, relative=nan, absolute=1.0_dp), 'NaN as relative tolerance fails')
      call expect(.not. close(1.0_dp, 2.0_dp, absolute=inf), 'infinite absolute tolerance fails')
      call expect(.not. close(1.0_dp, 2.0_dp, relative=inf), 'infinite relative tolerance fails')
      call expect(.not. close(1.0_dp, 1.0_dp, absolute=-1.0_dp), 'negative absolute tolerance fails')
      call expect(.not. close(1.0_dp, 1.0_dp, relative=-1.0_dp, absolute=1.0_dp), 'negative relative tolerance fails')
   end subroutine try_tolerances

   subroutine try_lists()
      type(test_t) :: t
      real(dp) :: nan
      nan = ieee_value(nan, ieee_quiet_nan)
      t%is_quiet = .true.
      call t%check_close([1.0_dp, 2.0_dp], [1.0_dp, 2.01_dp], 'a', absolute=0.1_dp)
      call expect(t%passed == 1 .and. t%failed == 0, 'close lists count once')
      call t%check_close([1.0_dp, 2.0_dp], [1.0_dp, 3.0_dp], 'a', absolute=0.1_dp)
      call expect(t%failed == 1 .and. index(t%last_failure, 'got 2 in place 2') > 0, 'last number differs')
      call t%check_close([1.0_dp, nan], [1.0_dp, 2.0_dp], 'a', absolute=9.0_dp)
      call expect(t%failed == 2, 'NaN in a list')
      call t%check_close([1.0_dp, 2.0_dp], [1.0_dp], 'a', absolute=9.0_dp)
      call expect(t%failed == 3 .and. index(t%last_failure, 'got 2 numbers') > 0, 'longer list')
      call t%check_close([1.0_dp], [1.0_dp, 2.0_dp], 'a', absolute=9.0_dp)
      call expect(t%failed == 4, 'shorter list')
      call t%check_close([real(dp) ::], [real(dp) ::], 'a', absolute=9.0_dp)
      call expect(t%failed == 5 .and. t%passed == 1, 'empty lists')
   end subroutine try_lists

   subroutine try_equality()
      type(test_t) :: t
      t%is_quiet = .true.
      call t%check_equal(3, 3, 'a')
      call t%check_equal(9000000000_i8, 9000000000_i8, 'a')
      call t%check_equal('abc', 'abc', 'a')
      call t%check_equal('', '', 'a')
      call expect(t%passed == 4 .and. t%failed == 0, 'equal')
      call t%check_equal(3, 4, 'a')
      call expect(t%failed == 1, 'different integers')
      call t%check_equal(9000000000_i8, 9000000001_i8, 'a')
      call expect(t%failed == 2, 'different long integers')
      call t%check_equal('abc', 'abd', 'a')
      call expect(t%failed == 3, 'different texts')
      call t%check_equal('abc ', 'abc', 'a')
      call expect(t%failed == 4 .and. t%passed == 4, 'texts that differ by a trailing blank')
   end subroutine try_equality

   subroutine try_errors()
      type(test_t) :: t
      type(error_t), allocatable :: error
      t%is_quiet = .true.
      call t%check_error(error, 'load', 'a')
      call expect(t%failed == 1 .and. index(t%last_failure, 'got no error') > 0, 'missing error')
      call t%check_no_error(error, 'a')
      call expect(t%failed == 1 .and. t%passed == 1, 'no error where none should be')
      allocate (error)
      call t%check_error(error, 'load', 'a')
      call expect(t%failed == 2, 'error without a message')
      call raise(error, 'load must be positive')
      call t%check_error(error, 'load', 'a')
      call expect(t%failed == 2 .and. t%passed == 2, 'error with the needle')
      call t%check_error(error, 'speed', 'a')
      call expect(t%failed == 3 .and. index(t%last_failure, 'got error ''load must be positive''') > 0, 'other error')
      call t%check_error(error, '', 'a')
      call expect(t%failed == 4, 'an empty needle fails')
      call t%check_no_error(error, 'a')
      call expect(t%failed == 5 .and. index(t%last_failure, 'load must be positive') > 0, 'error where none should be')
   end subroutine try_errors

   subroutine try_reports()
      type(test_t) :: t
      t%is_quiet = .true.
      call t%check(.false., 'the lid is shut')
      call expect(t%last_failure == 'FAILED: the lid is shut: got false, expected true', 'report of a condition')
      call t%check_equal(3, 4, 'legs')
      call expect(t%last_failure == 'FAILED: legs: got 3, expected 4', 'report of integers')
      call t%check_equal('a', 'b', 'name')
      call expect(t%last_failure == 'FAILED: name: got ''a'', expected ''b''', 'report of texts')
      call t%check_close(1.5_dp, 1.0_dp, 'film', relative=0.01_dp, absolute=0.25_dp)
      call expect(t%last_failure == 'FAILED: film: got 1.5, expected 1 within 0.01 relative within 0.25 absolute', &
                  'report of numbers')
      call t%check_close(1.0_dp, 1.0_dp, 'film')
      call expect(index(t%last_failure, 'no tolerance given') > 0, 'report of a missing tolerance')
   end subroutine try_reports

   subroutine try_finish()
      call expect_end('nothing', .false., '0 passed, 0 failed')
      call expect_end('nothing', .false., 'FAILED: no check was made')
      call expect_end('pass', .true., '2 passed, 0 failed')
      call expect_end('fail', .false., '0 passed, 1 failed')
      call expect_end('fail', .false., 'FAILED: lid: got false, expected true')
      call expect_end('both', .false., '2 passed, 1 failed')
   end subroutine try_finish

   !> End of the process for that argument.
   subroutine finish_as(role)
      character(len=*), intent(in) :: role
      type(test_t) :: t
      if (role == 'pass' .or. role == 'both') call t%check(.true., 'shoe')
      if (role == 'pass' .or. role == 'both') call t%check(.true., 'hat')
      if (role == 'fail' .or. role == 'both') call t%check(.false., 'lid')
      call t%finish()
   end subroutine finish_as

   !> Start this program with an argument; check its end and a line that it prints.
   subroutine expect_end(role, is_success, line)
      character(len=*), intent(in) :: role, line
      logical, intent(in) :: is_success
      character(len=4096) :: self
      character(len=256) :: printed
      character(len=64) :: path
      integer(i8) :: ticks
      integer :: status, unit, io
      logical :: is_printed

      call get_command_argument(0, self)
      call system_clock(ticks)
      write (path, '(a,i0,a)') 'test_testing_', ticks, '.tmp'
      status = -1
      call execute_command_line('"'//trim(self)//'" '//role//' > '//trim(path)//' 2>&1', exitstat=status)
      call expect((status == 0) .eqv. is_success, role//': exit status')
      is_printed = .false.
      open (newunit=unit, file=path, status='old', action='read', iostat=io)
      do while (io == 0)
         read (unit, '(a)', iostat=io) printed
         if (io == 0 .and. printed == line) is_printed = .true.
      end do
      close (unit, status='delete')
      call expect(is_printed, role//': prints '//line)
   end subroutine expect_end

   logical function close(value, expected, relative, absolute)
      real(dp), intent(in) :: value, expected
      real(dp), intent(in), optional :: relative, absolute
      type(test_t) :: t
      t%is_quiet = .true.
      call t%check_close(value, expected, 'a', relative, absolute)
      close = t%passed == 1 .and. t%failed == 0
      if (t%passed + t%failed /= 1) call expect(.false., 'one check counts once')
   end function close

   subroutine expect(condition, what)
      logical, intent(in) :: condition
      character(len=*), intent(in) :: what
      made = made + 1
      if (condition) return
      wrong = wrong + 1
      print '(2a)', 'FAILED: ', what
   end subroutine expect

end program test_testing
