!> Result of a case as text for people.
module ehlwave_result_report
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_effect_result, only: after_film, after_friction, after_waves
   use ehlwave_error_account, only: error_asked_for, errors_text, validity_text
   use ehlwave_harmonic_result, only: harmonic_result_t
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_sensitivity_report, only: print_sensitivities
   use ehlwave_status, only: is_solved, status_name
   use ehlwave_text, only: to_text
   use ehlwave_threads, only: thread_count
   implicit none (type, external)
   private
   public :: print_result

contains

   !> The result, to a unit.
   subroutine print_result(unit, case, plan, result)
      integer, intent(in) :: unit
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result
      real(dp) :: ratios(2)

      write (unit, '(a)') 'Status       '//status_name(result%status)
      if (len(result%message) > 0) write (unit, '(a)') '             '//result%message
      if (result%rung /= 'direct') write (unit, '(a)') 'Rescue       '//trim(result%rung)//', '// &
         to_text(result%rescued_solutions)//' solutions rescued'
      if (ieee_is_finite(result%central_film)) call print_smooth_film()
      call result%effects%print(after_film, unit, plan)
      call print_shear()
      if (plan%surfaces%is_measured() .and. is_solved(result%status)) then
         if (plan%first_sample < result%time_steps) write (unit, &
            '(a)') 'Rough film   h(0,0) while the surface passes: mean '// &
            to_text(result%mean_film*plan%conditions%c_m*1e6_dp, 5)//', lowest '// &
            to_text(minval(result%film_history(plan%first_sample + 1:))*plan%conditions%c_m*1e6_dp, 5)//', highest '// &
            to_text(maxval(result%film_history(plan%first_sample + 1:))*plan%conditions%c_m*1e6_dp, 5)//' um'
      else if (plan%surfaces%is_rough() .and. is_solved(result%status)) then
         if (ieee_is_finite(result%amplitude_ratio)) write (unit, '(a)') 'Amplitude    Ad/Ai = '// &
            to_text(result%amplitude_ratio, 5)//' (samples), '// &
            to_text(result%amplitude_ratio_fit, 5)//' (harmonic fit)'//formula()
         ratios = result%ratios(2)
         if (case%is_pair() .and. any(ieee_is_finite(ratios))) write (unit, '(a)') 'Amplitudes   Ad/Ai = '// &
            shown(ratios(1))//' of surface 1, '//shown(ratios(2))//' of surface 2 (harmonic fit)'
         if (plan%responds) call print_response('Response     Ad/Ai = ', result%harmonic)
         if (plan%responds .and. case%is_pair()) call print_response('  surface 2  Ad/Ai = ', &
            result%effects%second%surface%harmonic)
         call result%effects%print(after_waves, unit, plan)
         if (ieee_is_finite(result%v)) write (unit, '(a)') '             f(r) V = '// &
            to_text(result%f_r*result%v, 5)//', f(r) V2 = '//to_text(result%f_r*result%v2, 5)//', f(r) = '// &
            to_text(result%f_r, 5)
      end if
      call print_sensitivities(unit, result)
      if (ieee_is_finite(result%central_film_error)) write (unit, &
         '(a)') 'Estimated    relative errors: H(0,0) by the grid '// &
         to_text(result%central_film_error, 2)//', smallest H '//to_text(result%minimum_film_error, 2)// &
         friction_error()//rolling_error()// &
         trim(merge(' (from a model)', '               ', result%film_error_basis == 'model'))// &
         amplitude_error()
      if (plan%surfaces%is_rough() .and. ieee_is_finite(result%ratio_errors%mesh)) then
         write (unit, '(a)') '             of Ad/Ai in all '//to_text(result%error_estimate, 2)//': '// &
            errors_text(result%ratio_errors)
      else if (ieee_is_finite(result%film_errors%mesh)) then
         write (unit, '(a)') '             of H(0,0) in all '// &
            to_text(error_asked_for(case, result%film_errors), 2)//': '//errors_text(result%film_errors)
      end if
      write (unit, '(a)') 'Validity     '//validity_text(case, plan, result%warning)
      write (unit, '(a)') 'Errors       mass residual '//to_text(result%residual, 3)//', load error '// &
         to_text(result%load_error, 3)
      write (unit, '(a)') 'Effort       '//to_text(result%seconds, 4)//' s, '// &
         to_text(result%counted_work_units, 4)//' work units, '//to_text(result%time_steps)//' time steps, '// &
         iterations()//' on the finest grid, '//threads()//to_text(result%peak_memory_mib, 4)//' MiB'

   contains

      !> How many share the case, where several do.
      function threads() result(text)
         character(len=:), allocatable :: text
         text = ''
         if (thread_count() > 1) text = to_text(thread_count())//' threads, '
      end function threads

      !> Ad/Ai by the formula, which holds for pure rolling.
      function formula() result(text)
         character(len=:), allocatable :: text
         text = ''
         if (.not. abs(plan%conditions%slip_parameter - 1) > 0 .and. ieee_is_finite(result%v)) &
            text = '; formula '//to_text(result%formula_ratio, 5)
      end function formula

      function iterations() result(text)
         character(len=:), allocatable :: text
         if (case%method == 'fas') then
            text = to_text(result%nonlinear_steps)//' cycles and '//to_text(result%linear_steps)//' sweeps'
         else
            text = to_text(result%nonlinear_steps)//' Newton and '//to_text(result%linear_steps)//' GMRES steps'
         end if
      end function iterations

      !> A ratio, or that there is none.
      function shown(ratio) result(text)
         real(dp), intent(in) :: ratio
         character(len=:), allocatable :: text
         text = 'none'
         if (ieee_is_finite(ratio)) text = to_text(ratio, 5)
      end function shown

      function friction_error() result(text)
         character(len=:), allocatable :: text
         text = ''
         if (ieee_is_finite(result%friction_error)) then
            text = ', friction '//to_text(result%friction_error, 2)
         else if (case%effects%are_warm() .and. ieee_is_finite(result%shear%friction_coefficient)) then
            text = ', friction not known'
         end if
      end function friction_error

      function rolling_error() result(text)
         character(len=:), allocatable :: text
         text = ''
         if (ieee_is_finite(result%rolling%coefficient)) &
            text = ', rolling resistance '//to_text(result%rolling%error, 2)
      end function rolling_error

      function amplitude_error() result(text)
         character(len=:), allocatable :: text
         text = ''
         if (ieee_is_finite(result%amplitude_ratio_error)) text = ', Ad/Ai '// &
            to_text(result%amplitude_ratio_error, 2)// &
            trim(merge(' (from coarser grids)', ' (from a model)      ', result%amplitude_error_basis == 'coarse_grid'))
      end function amplitude_error

      subroutine print_response(head, r)
         character(len=*), intent(in) :: head
         type(harmonic_result_t), intent(in) :: r
         write (unit, '(a)') head//to_text(r%ratio, 5)// &
            ' (small waves, no change of the mean film), phase '//to_text(r%phase, 4)//' rad'//formula()
         if (ieee_is_finite(r%extrapolated)) write (unit, '(a)') '             extrapolated to mesh size 0: '// &
            to_text(r%extrapolated, 5)//', estimated discretisation error '//to_text(100*r%error, 2)//' %'
         if (ieee_is_finite(r%waves%centre%fit%misfit)) write (unit, '(a)') '             with the surface: '// &
            to_text(abs(r%waves%centre%fit%attenuated), 4)//' of Ai, with the oil: '// &
            to_text(abs(r%waves%centre%fit%complementary), 4)//' of Ai, misfit '//to_text(r%waves%centre%fit%misfit, 2)
         write (unit, '(a)') '             '//to_text(r%linear_steps)//' GMRES steps, '// &
            to_text(r%counted_work_units, 4)//' work units'
      end subroutine print_response

      subroutine print_shear()
         character(len=:), allocatable :: contact
         associate (r => result%shear)
            if (ieee_is_finite(r%friction_coefficient)) write (unit, '(a)') 'Friction     coefficient '// &
               to_text(r%friction_coefficient, 5)//largest_b()
            if (ieee_is_finite(result%rolling%coefficient)) call print_rolling()
            call result%effects%print(after_friction, unit, plan)
            if (ieee_is_finite(r%inlet%rise_k) .and. .not. case%effects%are_warm()) then
               contact = ''
               if (ieee_is_finite(r%contact_rise_k)) contact = ', contact '//to_text(r%contact_rise_k, 2)//' K'
               write (unit, '(a)') '             estimated temperature rise: inlet '//to_text(r%inlet%rise_k, 2)// &
                  ' K'//contact//' (the model is isothermal)'
            end if
         end associate
         if (result%warning /= '') write (unit, '(a)') 'Warning      '//result%warning
      end subroutine print_shear

      subroutine print_rolling()
         character(len=:), allocatable :: outside
         outside = ''
         associate (r => result%rolling, c => plan%conditions)
            if (r%share_outside > 0) &
               outside = ', '//to_text(100*r%share_outside, 2)//' % of it by oil outside the domain'
            write (unit, '(a)') 'Rolling      resistance coefficient '//to_text(r%coefficient, 5)//outside
            if (c%has_dimensions) write (unit, '(a)') '             force '//to_text(r%force(c), 4)// &
               trim(merge(' N/m', ' N  ', c%is_line()))//' at each surface, moment '//to_text(r%moment(c), 4)// &
               trim(merge(' N  ', ' N m', c%is_line()))//' about the contact centre, power '//to_text(r%power(c), 4)// &
               trim(merge(' W/m', ' W  ', c%is_line()))
         end associate
      end subroutine print_rolling

      function largest_b() result(text)
         character(len=:), allocatable :: text
         associate (r => result%shear)
            text = ''
            if (case%oil%is_newtonian()) text = ' (Newtonian oil)'
            if (ieee_is_finite(r%largest_b)) text = '; shear by sliding up to '//to_text(r%largest_b, 3)// &
               ' times the stress of the oil; small pressure gradients at the centre drive '// &
               to_text(r%tangent_factor(1), 4)//' (X) and '//to_text(r%tangent_factor(2), 4)// &
               ' (Y) times the flow of a Newtonian oil'
         end associate
      end function largest_b

      subroutine print_smooth_film()
         write (unit, '(a)') 'Smooth film  H(0,0) = '//to_text(result%central_film, 6)//', smallest H = '// &
            to_text(result%minimum_film, 6)//', Moes H(0,0) = '//to_text(result%central_film_moes, 6)// &
            ', largest P = '//to_text(result%max_pressure, 6)
         if (plan%conditions%has_dimensions) write (unit, '(a)') '             h(0,0) = '// &
            to_text(result%central_film*plan%conditions%c_m*1e6_dp, 5)//' um, smallest h = '// &
            to_text(result%minimum_film*plan%conditions%c_m*1e6_dp, 5)//' um'
      end subroutine print_smooth_film

   end subroutine print_result

end module ehlwave_result_report
