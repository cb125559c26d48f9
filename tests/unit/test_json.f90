!> The JSON writer, against text written by hand from RFC 8259.
program test_json
   use, intrinsic :: ieee_arithmetic, only: ieee_negative_inf, ieee_positive_inf, ieee_quiet_nan, ieee_value
   use ehlwave_json, only: list_json, real_json, string_json
   use ehlwave_kinds, only: dp
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_quantity_output, only: json_object
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call write_members()
   call write_reals()
   call write_text()
   call test%finish()

contains

   subroutine write_members()
      type(quantity_list_t) :: list
      call test%check_equal(json_object(list), '{}', 'empty object')
      call list%add('n', '', -5)
      call test%check_equal(json_object(list), '{"n": -5}', 'integer')
      call list%add('is_on', '', .true.)
      call list%add('is_off', '', .false.)
      call list%add('name', '', 'two words ')
      call list%add('x', '', 0.5_dp)
      call list%add('absent', '', 0.5_dp, exists=.false.)
      call list%add('a"b', '', 1)
      call test%check_equal(json_object(list), '{"n": -5, "is_on": true, "is_off": false, '// &
                            '"name": "two words ", "x": 0.5, "a\"b": 1}', 'all kinds, in order; names are escaped')
   end subroutine write_members

   subroutine write_reals()
      real(dp), parameter :: hard(8) = [0.1_dp, 1/3.0_dp, 0.1_dp + 0.2_dp, 1.0e22_dp, huge(1.0_dp), &
                                        tiny(1.0_dp), -123456789.123456789_dp, 2.0_dp**53]
      character(len=:), allocatable :: text
      real(dp) :: back, nan
      integer :: i

      nan = ieee_value(nan, ieee_quiet_nan)
      call test%check_equal(real_json(0.1_dp), '0.1', 'short form of 0.1')
      call test%check_equal(real_json(-2.0_dp), '-2', 'whole number')
      call test%check_equal(real_json(1.0e-30_dp), '1e-30', 'small number')
      call test%check_equal(real_json(0.1_dp + 0.2_dp), '0.30000000000000004', 'a number that needs 17 digits')
      call test%check_equal(real_json(-0.0_dp), '-0', 'negative zero')
      call test%check_equal(real_json(5.0e-324_dp), '4.9406564584124654e-324', 'smallest number')
      do i = 1, size(hard)
         text = real_json(hard(i))
         read (text, *) back
         call test%check_close(back, hard(i), 'lossless '//text, absolute=0.0_dp)
         call test%check(verify(text(1:1), '0123456789-') == 0 .and. index(text, '+') == 0, 'form of '//text)
      end do
      call test%check_equal(real_json(nan), 'null', 'NaN')
      call test%check_equal(real_json(ieee_value(nan, ieee_positive_inf)), 'null', 'infinity')
      call test%check_equal(real_json(ieee_value(nan, ieee_negative_inf)), 'null', 'minus infinity')
      call test%check_equal(list_json([1.0_dp, nan, 2.5_dp])//list_json([real(dp) ::]), '[1, null, 2.5][]', 'lists')
   end subroutine write_reals

   subroutine write_text()
      character(len=1), parameter :: bad = char(255)
      character(len=*), parameter :: e_acute = char(195)//char(169), euro = char(226)//char(130)//char(172)
      character(len=*), parameter :: clef = char(240)//char(157)//char(132)//char(158)
      character(len=*), parameter :: ends = char(194)//char(128)//char(194)//char(191)// &
                                     char(226)//char(128)//char(128)//char(239)//char(191)//char(191)

      call test%check_equal(escaped(''), '', 'empty text')
      call test%check_equal(escaped('say "a\b" it''s a/b'), 'say \"a\\b\" it''s a/b', 'quotes and backslash')
      call test%check_equal(escaped(achar(8)//achar(9)//achar(10)//achar(12)//achar(13)), '\b\t\n\f\r', 'short escapes')
      call test%check_equal(escaped(achar(0)//achar(1)//achar(27)//achar(31)//achar(127)), &
                            '\u0000\u0001\u001b\u001f\u007f', 'control characters')
      call test%check_equal(escaped(e_acute//euro//clef), e_acute//euro//clef, 'UTF-8 is kept')
      call test%check_equal(escaped(ends), ends, 'first and last continuation bytes')
      call test%check_equal(escaped('a'//bad//'b'), 'a\ufffdb', 'byte that is not UTF-8')
      call test%check_equal(escaped(char(233)//'t'), '\ufffdt', 'Latin-1')
      call test%check_equal(escaped('a'//e_acute(1:1)), 'a\ufffd', 'character cut off at the end')
      call test%check_equal(escaped(euro(1:2)//'x'), '\ufffd\ufffdx', 'character cut off in the middle')
      call test%check_equal(escaped(char(192)//char(175)), '\ufffd\ufffd', 'overlong form of 2 bytes')
      call test%check_equal(escaped(char(224)//char(128)//char(175)), '\ufffd\ufffd\ufffd', 'overlong form of 3 bytes')
      call test%check_equal(escaped(char(237)//char(160)//char(128)), '\ufffd\ufffd\ufffd', 'surrogate')
      call test%check_equal(escaped(char(244)//char(144)//char(128)//char(128)), repeat('\ufffd', 4), 'beyond Unicode')
      call test%check_equal(escaped(char(240)//char(128)//char(128)//char(128)), repeat('\ufffd', 4), &
                            'overlong form of 4 bytes')
   end subroutine write_text

   function escaped(value) result(text)
      character(len=*), intent(in) :: value
      character(len=:), allocatable :: text
      text = string_json(value)
      text = text(2:len(text) - 1)
   end function escaped

end program test_json
