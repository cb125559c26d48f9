!> Numbers to text and back.
program test_text
   use ehlwave_kinds, only: dp, i8
   use ehlwave_text, only: lower_case, number_of, to_text
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_forms()
   call check_round_trip()
   call test%finish()

contains

   subroutine check_forms()
      call test%check_equal(to_text(0.1_dp, 6), '0.1', 'short')
      call test%check_equal(to_text(0.0_dp), '0', 'zero')
      call test%check_equal(number_of(1, 'case')//', '//number_of(12, 'rank'), '1 case, 12 ranks', 'singular and plural')
      call test%check_equal(to_text(-0.25_dp, 6), '-0.25', 'negative fraction')
      call test%check_equal(to_text(100.0_dp), '100', 'whole')
      call test%check_equal(to_text(1234567.0_dp, 3), '1.23e6', 'exponent')
      call test%check_equal(to_text(2.2e-8_dp, 5), '2.2e-8', 'small')
      call test%check_equal(to_text(1.5e-300_dp, 5), '1.5e-300', 'three digits of exponent')
      call test%check_equal(to_text(0.99999_dp, 3), '1', 'rounds up to a whole')
      call test%check_equal(to_text(-7), '-7', 'integer')
      call test%check_equal(to_text(123456789012_i8), '123456789012', 'long')
      call test%check_equal(to_text(.true.)//to_text(.false.), 'truefalse', 'logical')
      call test%check_equal(lower_case('RoElands_1'), 'roelands_1', 'lower case')
   end subroutine check_forms

   !> 17 digits are lossless.
   subroutine check_round_trip()
      real(dp), parameter :: hard(10) = [1/3.0_dp, 0.1_dp, 0.1_dp + 0.2_dp, 1e22_dp, 9007199254740993.0_dp, huge(1.0_dp), &
                                         tiny(1.0_dp), -acos(-1.0_dp), 1e-4_dp, 9.9999999999999995e-5_dp]
      real(dp) :: back, value
      character(len=:), allocatable :: text
      integer :: i
      logical :: is_exact

      is_exact = .true.
      do i = 1, 10000
         value = sin(real(i, dp))*10.0_dp**(modulo(7*i, 40) - 20)
         text = to_text(value)
         read (text, *) back
         is_exact = is_exact .and. abs(back - value) <= 0
      end do
      call test%check(is_exact, 'ten thousand numbers')
      do i = 1, size(hard)
         text = to_text(hard(i))
         read (text, *) back
         call test%check(abs(back - hard(i)) <= 0, 'round trip of '//text)
      end do
   end subroutine check_round_trip

end program test_text
