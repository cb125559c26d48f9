!> Lists as the JSON writer makes them are read back, numbers bit for bit.
program test_json_reader
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use ehlwave_json, only: real_json
   use ehlwave_json_reader, only: json_number, json_string, split_list
   use ehlwave_kinds, only: dp, i8, no_value
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_quantity_output, only: json_columns, json_values
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
      type(quantity_list_t) :: list
      character(len=:), allocatable :: text
      integer, allocatable :: first(:), last(:)
      real(dp), allocatable :: two(:)
      integer :: i

      allocate (two, source=[1.0_dp, 2.5_dp])
      call list%add('text', '', odd)
      call list%add('real', '', 0.1_dp)
      call list%add_list('list', '', two)
      call list%add('nan', '', no_value)
      call list%add('empty', '', '')
      call list%add('logical', '', .true.)
      text = json_columns(list)
      call split_list(text, first, last)
      call test%check_equal(size(first), 6, 'columns')
      call test%check_equal(text(first(3):last(3)), '["list","list"]', 'a column')
      text = json_values(list)
      call split_list(text, first, last)
      call test%check_equal(size(first), 6, 'values')
      if (size(first) /= 6) return
      call test%check_equal(json_string(text(first(1):last(1))), odd, 'text')
      call test%check_close(json_number(text(first(2):last(2))), 0.1_dp, 'real', relative=0.0_dp)
      call test%check(ieee_is_nan(json_number(text(first(4):last(4)))), 'NaN')
      call test%check_equal(json_string(text(first(5):last(5))), '', 'empty text')
      call test%check_close(json_number(text(first(6):last(6))), 1.0_dp, 'logical', relative=0.0_dp)
      associate (numbers => text(first(3):last(3)))
         call split_list(numbers, first, last)
         call test%check_close([(json_number(numbers(first(i):last(i))), i=1, size(first))], [1.0_dp, 2.5_dp], 'list', &
                               relative=0.0_dp)
      end associate
   end subroutine check_round_trip

   subroutine check_numbers()
      real(dp) :: back, numbers(2), value
      integer :: i, wrong

      wrong = 0
      do i = 1, 20000
         call random_number(numbers)
         value = (numbers(1) - 0.5_dp)*10.0_dp**(600*numbers(2) - 300)
         back = json_number(real_json(value))
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
