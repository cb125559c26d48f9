!> Counts checks and stops with an error after a failure.
!>
!>     type(test_t) :: test
!>     call test%check(n > 0, 'there are points')
!>     call test%check_close(h, 1.0_dp, 'film thickness', relative=1e-12_dp)
!>     call test%finish()
module testing
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use, intrinsic :: iso_fortran_env, only: output_unit
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp, i8
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: is_long, test_t

   type :: test_t
      integer :: passed = 0, failed = 0
      logical :: is_quiet = .false.                    !! do not print failures; for the test of this module
      character(len=:), allocatable :: last_failure    !! text printed last
   contains
      procedure :: check
      generic :: check_close => check_close_scalar, check_close_list
      generic :: check_equal => check_equal_integer, check_equal_long, check_equal_text
      procedure :: check_error
      procedure :: check_no_error
      procedure :: finish
      procedure, private :: check_close_scalar, check_close_list
      procedure, private :: check_equal_integer, check_equal_long, check_equal_text
      procedure, private :: compare
   end type test_t

contains

   !> scripts/test --long: more of the same, and larger grids.
   logical function is_long()
      character(len=1) :: value
      integer :: status
      call get_environment_variable('EHLWAVE_LONG_TESTS', value, status=status)
      is_long = status <= 0 .and. value /= '0'
   end function is_long

   !> A condition holds.
   subroutine check(self, condition, what)
      class(test_t), intent(inout) :: self
      logical, intent(in) :: condition
      character(len=*), intent(in) :: what
      call self%compare(condition, what, 'false', 'true')
   end subroutine check

   !> |value - expected| <= max(relative*|expected|, absolute). Fails on NaN, on infinities (also equal), without a
   !> tolerance and with a negative or infinite tolerance.
   subroutine check_close_scalar(self, value, expected, what, relative, absolute)
      class(test_t), intent(inout) :: self
      real(dp), intent(in) :: value, expected
      character(len=*), intent(in) :: what
      real(dp), intent(in), optional :: relative, absolute
      call self%compare(is_close(value, expected, relative, absolute), what, to_text(value), &
                        to_text(expected)//tolerance_text(relative, absolute))
   end subroutine check_close_scalar

   !> Check each of a list that is not empty as a number; counts as a single check.
   subroutine check_close_list(self, value, expected, what, relative, absolute)
      class(test_t), intent(inout) :: self
      real(dp), intent(in) :: value(:), expected(:)
      character(len=*), intent(in) :: what
      real(dp), intent(in), optional :: relative, absolute
      integer :: i

      if (size(value) /= size(expected) .or. size(expected) == 0) then
         call self%compare(.false., what, to_text(size(value))//' numbers', to_text(size(expected))// &
                           ' numbers, at least 1')
         return
      end if
      do i = 1, size(value)
         if (.not. is_close(value(i), expected(i), relative, absolute)) then
            call self%compare(.false., what, to_text(value(i))//' in place '//to_text(i), &
                              to_text(expected(i))//tolerance_text(relative, absolute))
            return
         end if
      end do
      call self%compare(.true., what, '', '')
   end subroutine check_close_list

   subroutine check_equal_integer(self, value, expected, what)
      class(test_t), intent(inout) :: self
      integer, intent(in) :: value, expected
      character(len=*), intent(in) :: what
      call self%compare(value == expected, what, to_text(value), to_text(expected))
   end subroutine check_equal_integer

   subroutine check_equal_long(self, value, expected, what)
      class(test_t), intent(inout) :: self
      integer(i8), intent(in) :: value, expected
      character(len=*), intent(in) :: what
      call self%compare(value == expected, what, to_text(value), to_text(expected))
   end subroutine check_equal_long

   !> Trailing blanks count.
   subroutine check_equal_text(self, value, expected, what)
      class(test_t), intent(inout) :: self
      character(len=*), intent(in) :: value, expected
      character(len=*), intent(in) :: what
      call self%compare(value == expected .and. len(value) == len(expected), what, &
                        ''''//value//'''', ''''//expected//'''')
   end subroutine check_equal_text

   !> There is an error and its message contains `needle`, which is not empty.
   subroutine check_error(self, error, needle, what)
      class(test_t), intent(inout) :: self
      type(error_t), allocatable, intent(in) :: error
      character(len=*), intent(in) :: needle
      character(len=*), intent(in) :: what
      character(len=:), allocatable :: message
      logical :: is_found

      message = 'no error'
      is_found = .false.
      if (allocated(error)) then
         message = 'an error without a message'
         if (allocated(error%message)) then
            message = 'error '''//error%message//''''
            is_found = len(needle) > 0 .and. index(error%message, needle) > 0
         end if
      end if
      call self%compare(is_found, what, message, 'an error with '''//needle//'''')
   end subroutine check_error

   !> There is no error.
   subroutine check_no_error(self, error, what)
      class(test_t), intent(inout) :: self
      type(error_t), allocatable, intent(in) :: error
      character(len=*), intent(in) :: what
      character(len=:), allocatable :: message

      message = 'an error'
      if (allocated(error)) then
         if (allocated(error%message)) message = 'error '''//error%message//''''
      end if
      call self%compare(.not. allocated(error), what, message, 'no error')
   end subroutine check_no_error

   !> Print the counts; stop with an error when a check failed or there was none.
   subroutine finish(self)
      class(test_t), intent(in) :: self
      write (output_unit, '(i0,a,i0,a)') self%passed, ' passed, ', self%failed, ' failed'
      if (self%passed + self%failed == 0) write (output_unit, '(a)') 'FAILED: no check was made'
      flush (output_unit)
      if (self%failed > 0 .or. self%passed == 0) error stop 1
   end subroutine finish

   !> Count a check and report it when it failed.
   subroutine compare(self, is_met, what, got, expected)
      class(test_t), intent(inout) :: self
      logical, intent(in) :: is_met
      character(len=*), intent(in) :: what, got, expected

      if (is_met) then
         self%passed = self%passed + 1
         return
      end if
      self%failed = self%failed + 1
      self%last_failure = 'FAILED: '//what//': got '//got//', expected '//expected
      if (.not. self%is_quiet) write (output_unit, '(a)') self%last_failure
   end subroutine compare

   pure logical function is_close(value, expected, relative, absolute)
      real(dp), intent(in) :: value, expected
      real(dp), intent(in), optional :: relative, absolute
      real(dp) :: tolerance

      is_close = .false.
      if (.not. (ieee_is_finite(value) .and. ieee_is_finite(expected))) return
      tolerance = -1
      if (present(relative)) then
         if (.not. ieee_is_finite(relative)) return
         if (relative < 0) return
         tolerance = relative*abs(expected)
      end if
      if (present(absolute)) then
         if (.not. ieee_is_finite(absolute)) return
         if (absolute < 0) return
         tolerance = max(tolerance, absolute)
      end if
      is_close = abs(value - expected) <= tolerance
   end function is_close

   pure function tolerance_text(relative, absolute) result(text)
      real(dp), intent(in), optional :: relative, absolute
      character(len=:), allocatable :: text
      text = ''
      if (present(relative)) text = text//' within '//to_text(relative, 3)//' relative'
      if (present(absolute)) text = text//' within '//to_text(absolute, 3)//' absolute'
      if (text == '') text = ' (no tolerance given)'
   end function tolerance_text

end module testing
