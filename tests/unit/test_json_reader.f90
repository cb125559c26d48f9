!> Lists as the JSON writer makes them are read back, numbers bit for bit.
program test_json_reader
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
   use ehlwave_json, only: json_t
   use ehlwave_json_reader, only: json_number, json_string, split_list
   use ehlwave_kinds, only: dp, i8
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test

   call check_round_trip()
   call check_numbers()
   call check_not_a_list()
   call test%finish()

contains

   subroutine check_round_trip()
      character(len=*), parameter :: odd = 'a "quoted", [list] \ {and}'//new_line('a')//achar(9)//achar(1)//' end'
      type(json_t) :: json
      character(len=:), allocatable :: text
      integer, allocatable :: first(:), last(:)
      integer :: i

      call json%add('text', odd)
      call json%add('real', 0.1_dp)
      call json%add_list('list', [1.0_dp, 2.5_dp])
      call json%add('nan', ieee_value(1.0_dp, ieee_quiet_nan))
      call json%add('empty', '')
      call json%add('logical', .true.)
      text = json%column_list()
      call split_list(text, first, last)
      call test%check_equal(size(first), 6, 'columns')
      call test%check_equal(text(first(3):last(3)), '["list","list"]', 'a column')
      text = json%value_list()
      call split_list(text, first, last)
      call test%check_equal(size(first), 6, 'values')
      if (size(first) /= 6) return
      call test%check_equal(json_string(text(first(1):last(1))), odd, 'text')
      call test%check_close(json_number(text(first(2):last(2))), 0.1_dp, 'real', relative=0.0_dp)
      call test%check(ieee_is_nan(json_number(text(first(4):last(4)))), 'NaN')
      call test%check_equal(json_string(text(first(5):last(5))), '', 'empty text')
      call test%check_close(json_number(text(first(6):last(6))), 1.0_dp, 'logical', relative=0.0_dp)
      associate (list => text(first(3):last(3)))
         call split_list(list, first, last)
         call test%check_close([(json_number(list(first(i):last(i))), i=1, size(first))], [1.0_dp, 2.5_dp], 'list', &
                               relative=0.0_dp)
      end associate
   end subroutine check_round_trip

   subroutine check_numbers()
      type(json_t) :: json
      character(len=:), allocatable :: text
      real(dp) :: back, numbers(2), value
      integer :: i, wrong

      wrong = 0
      do i = 1, 20000
         call random_number(numbers)
         value = (numbers(1) - 0.5_dp)*10.0_dp**(600*numbers(2) - 300)
         json = json_t()
         call json%add('value', value)
         text = json%value_list()
         back = json_number(text(2:len(text) - 1))
         if (transfer(back, 0_i8) /= transfer(value, 0_i8)) wrong = wrong + 1
      end do
      call test%check_equal(wrong, 0, 'numbers that do not come back bit for bit')
   end subroutine check_numbers

   subroutine check_not_a_list()
      character(len=6), parameter :: bad(4) = [character(len=6) :: '', '[1,2', '["a]', '1,2]']
      integer, allocatable :: first(:), last(:)
      integer :: i
      do i = 1, size(bad)
         call split_list(trim(bad(i)), first, last)
         call test%check_equal(size(first), 0, 'not a list: '//bad(i))
      end do
      call split_list('[]', first, last)
      call test%check_equal(size(first), 0, 'empty list')
   end subroutine check_not_a_list

end program test_json_reader
