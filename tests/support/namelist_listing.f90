!> Lists the entries that the namelist reader finds in files: for each path of standard input a line of output, either
!>
!>     refused MESSAGE
!>     read & GROUP LINE = KEY LINE w|q LINE TEXT REAL WHOLE TRUTH ...
!>
!> with '&' before each group, '=' before each key and 'w' or 'q' (in quotes) before each value. Texts are
!> hexadecimal; numbers are their bits, and '-' where the value has another kind.
program namelist_listing
   use, intrinsic :: iso_fortran_env, only: output_unit
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp, i8
   use ehlwave_namelist_scanner, only: contents_t, scan_namelist, value_t
   use ehlwave_namelist_values, only: read_value
   use ehlwave_text, only: to_text
   use ehlwave_text_file, only: read_text
   use listing, only: hexadecimal, list_paths
   implicit none (type, external)

   call list_paths(list_file)

contains

   subroutine list_file(path)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: text
      type(contents_t) :: contents
      type(error_t), allocatable :: error
      integer :: i, k, group

      call read_text(path, text, error)
      if (.not. allocated(error)) call scan_namelist(path, text, contents, error)
      if (allocated(error)) then
         write (output_unit, '(a)') 'refused '//error%message
         return
      end if
      write (output_unit, '(a)', advance='no') 'read'
      k = 1
      do group = 1, contents%n_groups
         write (output_unit, '(a)', advance='no') ' & '//trim(contents%groups(group)%name)//' '// &
            to_text(contents%groups(group)%line)
         do while (k <= contents%n_entries)
            if (contents%entries(k)%group /= contents%groups(group)%name) exit
            write (output_unit, '(a)', advance='no') ' = '//trim(contents%entries(k)%key)//' '// &
               to_text(contents%entries(k)%line)
            do i = contents%entries(k)%first, contents%entries(k)%last
               write (output_unit, '(a)', advance='no') listed(contents%values(i))
            end do
            k = k + 1
         end do
      end do
      write (output_unit, '(a)') ''
   end subroutine list_file

   !> A value of each kind.
   function listed(value) result(line)
      type(value_t), intent(in) :: value
      character(len=:), allocatable :: line
      character(len=:), allocatable :: problem
      character(len=16) :: bits
      real(dp) :: number
      integer :: whole
      logical :: truth

      line = ' '//merge('q', 'w', value%is_quoted)//' '//to_text(value%line)//' x'//hexadecimal(value%text)
      call read_value(value, number, problem)
      bits = '-'
      if (.not. allocated(problem)) write (bits, '(z16.16)') transfer(number, 1_i8)
      line = line//' '//trim(bits)
      call read_value(value, whole, problem)
      if (allocated(problem)) then
         line = line//' -'
      else
         line = line//' '//to_text(whole)
      end if
      call read_value(value, truth, problem)
      if (allocated(problem)) then
         line = line//' -'
      else
         line = line//' '//merge('t', 'f', truth)
      end if
   end function listed

end program namelist_listing
