!> Values as written in an input file, turned into numbers, logicals and text.
!>
!> Each procedure leaves `problem` unallocated on success; otherwise it holds the problem and the correct form, and
!> the value returned must not be used.
module ehlwave_namelist_values
   use ehlwave_kinds, only: dp, i8
   use ehlwave_namelist_scanner, only: value_t
   use ehlwave_text, only: lower_case, shown, to_text
   implicit none (type, external)
   private
   public :: read_value

   character(len=*), parameter :: digits = '0123456789'

   interface read_value
      module procedure :: read_real, read_integer, read_logical, read_text_value
   end interface read_value

contains

   !> Decimal number with or without exponent (e or d), 0 or from 1e-307 to below 1e308 in size. The limits
   !> are applied to the text, so that no number is ever converted that overflows or underflows: builds
   !> that trap floating-point exceptions give the same message.
   pure subroutine read_real(item, value, problem)
      type(value_t), intent(in) :: item
      real(dp), intent(out) :: value
      character(len=:), allocatable, intent(out) :: problem
      integer :: power

      value = 0
      if (item%is_quoted .or. .not. is_real(item%text)) then
         problem = misfit(item, 'a number such as 1.5 or 2e-3')
         return
      end if
      if (scan(item%text(:mantissa_end(item%text)), '123456789') == 0) return
      power = decimal_power(item%text)
      if (power > 307) then
         problem = shown(item%text)//' is too large: write a number below 1e308'
      else if (power < -307) then
         problem = shown(item%text)//' is too small: write 0 or a number from 1e-307'
      else
         read (item%text, *) value
      end if
   end subroutine read_real

   !> Whole number, written without decimal point or exponent.
   pure subroutine read_integer(item, value, problem)
      type(value_t), intent(in) :: item
      integer, intent(out) :: value
      character(len=:), allocatable, intent(out) :: problem
      integer(i8) :: long
      integer :: io

      value = 0
      if (item%is_quoted .or. .not. is_integer(item%text)) then
         problem = misfit(item, 'a whole number such as 4, without decimal point or exponent')
         return
      end if
      read (item%text, *, iostat=io) long
      if (io == 0) then
         if (abs(long) <= huge(value)) then
            value = int(long)
            return
         end if
      end if
      problem = shown(item%text)//' is too large for a whole number here: write one from -'//to_text(huge(value))// &
                ' to '//to_text(huge(value))
   end subroutine read_integer

   !> true, false, t, f, with or without dots around.
   pure subroutine read_logical(item, value, problem)
      type(value_t), intent(in) :: item
      logical, intent(out) :: value
      character(len=:), allocatable, intent(out) :: problem

      value = .false.
      if (item%is_quoted) problem = misfit(item, 'true or false')
      select case (lower_case(item%text))
      case ('true', 't', '.true.', '.t.'); value = .true.
      case ('false', 'f', '.false.', '.f.'); value = .false.
      case default; problem = misfit(item, 'true or false')
      end select
   end subroutine read_logical

   !> Text in quotes.
   pure subroutine read_text_value(item, value, problem)
      type(value_t), intent(in) :: item
      character(len=:), allocatable, intent(out) :: value
      character(len=:), allocatable, intent(out) :: problem

      value = item%text
      if (.not. item%is_quoted) problem = shown(item%text)//' is not in quotes: write '''//shown(item%text)//''''
   end subroutine read_text_value

   pure function misfit(item, wanted) result(problem)
      type(value_t), intent(in) :: item
      character(len=*), intent(in) :: wanted
      character(len=:), allocatable :: problem
      if (item%is_quoted) then
         problem = ''''//shown(item%text)//''' in quotes is text: write '//wanted//', without quotes'
      else
         problem = ''''//shown(item%text)//''' does not fit: write '//wanted
      end if
   end function misfit

   !> [sign] digits
   pure logical function is_integer(text)
      character(len=*), intent(in) :: text
      is_integer = len(text) > sign_length(text) .and. verify(text(sign_length(text) + 1:), digits) == 0
   end function is_integer

   !> [sign] digits with at most one point, then an optional exponent
   pure logical function is_real(text)
      character(len=*), intent(in) :: text
      associate (mantissa => text(sign_length(text) + 1:mantissa_end(text)), exponent => text(mantissa_end(text) + 2:))
         is_real = scan(mantissa, digits) > 0 .and. verify(mantissa, digits//'.') == 0 .and. &
                   index(mantissa, '.') == index(mantissa, '.', back=.true.) .and. &
                   (mantissa_end(text) == len(text) .or. is_integer(exponent))
      end associate
   end function is_real

   pure integer function sign_length(text)
      character(len=*), intent(in) :: text
      sign_length = merge(1, 0, scan(text, '+-') == 1)
   end function sign_length

   !> Power of ten of the first digit that is not 0, of a text that `is_real` and not 0; limited to a million.
   pure integer function decimal_power(text)
      character(len=*), intent(in) :: text
      integer, parameter :: limit = 1000000
      integer :: first, point, last, power

      last = mantissa_end(text)
      first = scan(text(:last), '123456789')
      point = scan(text(:last)//'.', '.')
      decimal_power = point - first
      if (point > first) decimal_power = decimal_power - 1
      if (last == len(text)) return
      power = limit
      associate (exponent => text(last + 2:))
         if (verify(exponent, '+-0') == 0) return
         if (len(exponent) - verify(exponent, '+-0') < 6) read (exponent(verify(exponent, '+-0'):), *) power
         if (exponent(1:1) == '-') power = -power
      end associate
      decimal_power = max(-limit, min(limit, decimal_power + power))
   end function decimal_power

   !> Length of the part before the exponent.
   pure integer function mantissa_end(text)
      character(len=*), intent(in) :: text
      mantissa_end = scan(text//'e', 'eEdD') - 1
   end function mantissa_end

end module ehlwave_namelist_values
