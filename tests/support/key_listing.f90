!> Lists the values that the keys of case files have: for each path of standard input a line of output, either
!>
!>     refused MESSAGE
!>     read KEY VALUE ...
!>
!> with the keys that the file gives, in the order of the table. Numbers are their bits, words are hexadecimal.
program key_listing
   use, intrinsic :: iso_fortran_env, only: output_unit
   use ehlwave_case_input, only: case_input_t
   use ehlwave_case_key, only: key_value_t, word_kind
   use ehlwave_case_keys, only: case_key_list
   use ehlwave_errors, only: error_t
   use ehlwave_key_list, only: key_list_t
   use ehlwave_kinds, only: i8
   use ehlwave_namelist, only: namelist_t
   use listing, only: hexadecimal, list_paths
   implicit none (type, external)

   call list_paths(list_file)

contains

   subroutine list_file(path)
      character(len=*), intent(in) :: path
      type(namelist_t) :: file
      type(key_list_t) :: list
      type(error_t), allocatable :: error
      type(case_input_t) :: input
      integer :: k

      call file%load(path, error)
      call input%read(file, error)
      call file%check_all_used(error)
      if (allocated(error)) then
         write (output_unit, '(a)') 'refused '//error%message
         return
      end if
      list = case_key_list(input%case)
      write (output_unit, '(a)', advance='no') 'read'
      do k = 1, list%count
         if (input%is_given(k)) write (output_unit, '(a)', advance='no') ' '//trim(list%keys(k)%name)//' '// &
            listed(list%values(k))
      end do
      write (output_unit, '(a)') ''
   end subroutine list_file

   function listed(value) result(text)
      type(key_value_t), intent(in) :: value
      character(len=:), allocatable :: text
      if (value%kind == word_kind) then
         text = 'x'//hexadecimal(value%word)
      else
         allocate (character(len=16) :: text)
         write (text, '(z16.16)') transfer(value%number, 1_i8)
      end if
   end function listed

end program key_listing
