!> The sensitivities of a case for people.
module ehlwave_sensitivity_report
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_case_result, only: case_result_t, of_central_film, of_friction, of_marched_ratio, of_mean_film, &
      of_minimum_film, of_ratio, of_rolling_coefficient, of_share, of_speed
   use ehlwave_kinds, only: dp
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: print_sensitivities

   real(dp), parameter :: least = 0.005_dp    !! smaller ones are left out
   integer, parameter :: shown(9) = [of_central_film, of_minimum_film, of_friction, of_rolling_coefficient, of_ratio, &
                                     of_share, of_speed, of_marched_ratio, of_mean_film]
   character(len=*), parameter :: names(size(shown)) = [character(len=18) :: 'H(0,0)', 'smallest film', 'friction', &
      'rolling resistance', 'Ad/Ai', 'share of solids', 'mean speed', 'Ad/Ai', 'mean film']
   integer, parameter :: in_a_line = 4

contains

   !> The powers of the inputs with which results grow.
   subroutine print_sensitivities(unit, result)
      integer, intent(in) :: unit
      type(case_result_t), intent(in) :: result
      integer :: i

      call print_by_oil(unit, result)
      if (.not. allocated(result%by_key)) return
      do i = 1, size(shown)
         call print_result(unit, trim(names(i)), result, shown(i))
      end do
   end subroutine print_sensitivities

   !> The keys of one result, the most important ones first.
   subroutine print_result(unit, name, result, of)
      integer, intent(in) :: unit
      character(len=*), intent(in) :: name
      type(case_result_t), intent(in) :: result
      integer, intent(in) :: of
      real(dp) :: values(size(result%by_key))
      character(len=:), allocatable :: line
      integer :: k, n

      values = result%by_key%of(of)
      line = 'Sensitivity  '//name//' goes with'
      n = 0
      do while (any(abs(values) >= least))
         k = maxloc(abs(values), 1, mask=ieee_is_finite(values))
         if (n > 0 .and. modulo(n, in_a_line) == 0) then
            write (unit, '(a)') line//','
            line = repeat(' ', 12)
         else if (n > 0) then
            line = line//','
         end if
         line = line//' '//trim(result%by_key(k)%name)//'^'//to_text(values(k), 3)
         values(k) = 0
         n = n + 1
      end do
      if (n > 0) write (unit, '(a)') line
   end subroutine print_result

   !> Powers of ln(eta/eta0) and of the stress of the flow law.
   subroutine print_by_oil(unit, result)
      integer, intent(in) :: unit
      type(case_result_t), intent(in) :: result
      character(len=6), parameter :: by(2) = [character(len=6) :: 'alpha', 'stress']
      character(len=:), allocatable :: response
      integer :: x

      do x = 1, size(by)
         associate (r => result%by_oil(x))
            response = ''
            if (ieee_is_finite(r%response)) response = ', Ad/Ai with '//to_text(r%response, 4)
            if (ieee_is_finite(r%film)) write (unit, '(a)') 'Sensitivity  H(0,0) goes with the power '// &
               to_text(r%film, 4)//' of '//trim(by(x))//response
         end associate
      end do
   end subroutine print_by_oil

end module ehlwave_sensitivity_report
