!> Quantities of sensitivities, see `ehlwave_quantities`: derivatives by every input, `sensitivity_RESULT_KEY`.
module ehlwave_sensitivity_quantities
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t, gradient_t, gradients, of_central_film, of_friction, &
      of_marched_phase, of_marched_ratio, of_mean_film, of_minimum_film, of_phase, of_ratio, &
      of_rolling_coefficient, of_rolling_force, of_share, of_speed
   use ehlwave_case_variables, only: variable_names
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_quantity, only: quantity_list_t
   implicit none (type, external)
   private
   public :: add_sensitivities, sensitivity_name

   character(len=*), parameter :: result_names(gradients) = [character(len=30) :: 'central_film', 'minimum_film', &
      'friction_coefficient', 'rolling_resistance_coefficient', 'rolling_resistance', 'harmonic_ratio', &
      'harmonic_phase', 'touching_share', 'mean_speed', 'amplitude_ratio_fit', 'phase_fit', 'mean_film']

contains

   !> Derivatives by all variables and by two properties of the oil, where they were asked for.
   subroutine add_sensitivities(list, case, result)
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      type(case_result_t), intent(in) :: result
      integer :: n

      call add_by_oil(list, case, result)
      call list%add('sensitivity_solves', 'transposed linear solves of the derivatives: one for a result of the '// &
         'contact, a complex and two real ones for the response', result%transposed_solves, &
         exists=case%sensitivities)
      call list%add('sensitivity_work_units', 'counted work units of one of them, on average', work_units(result), &
         exists=case%sensitivities)
      if (.not. case%sensitivities) return
      associate (names => variable_names(case))
         do n = 1, size(names)
            if (allocated(result%by_key)) then
               call add_gradient(list, case, of_known_results(result%by_key(n), result))
            else
               call add_gradient(list, case, gradient_t(name=names(n)))
            end if
         end do
      end associate
   end subroutine add_sensitivities

   !> Work of a transposed solve in the unit of the counted work; NaN without solves.
   pure real(dp) function work_units(result)
      type(case_result_t), intent(in) :: result
      work_units = no_value
      if (result%transposed_solves > 0 .and. result%all_work > 0) work_units = &
         result%transposed_work/result%transposed_solves*result%total_work_units/result%all_work
   end function work_units

   !> Leave out variables of results that are not given.
   pure function of_known_results(gradient, result) result(known)
      type(gradient_t), intent(in) :: gradient
      type(case_result_t), intent(in) :: result
      type(gradient_t) :: known
      known = gradient
      if (.not. ieee_is_finite(result%shear%friction_coefficient)) known%of(of_friction) = no_value
      if (.not. ieee_is_finite(result%rolling%coefficient)) &
         known%of([of_rolling_coefficient, of_rolling_force]) = no_value
   end function of_known_results

   !> Name of a derivative.
   pure function sensitivity_name(of, key) result(name)
      integer, intent(in) :: of                !! result
      character(len=*), intent(in) :: key
      character(len=:), allocatable :: name
      name = 'sensitivity_'//trim(result_names(of))//'_'//trim(key)
   end function sensitivity_name

   !> Derivatives of all results by one key.
   subroutine add_gradient(list, case, gradient)
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      type(gradient_t), intent(in) :: gradient

      call put(of_central_film, film_name('H(0,0)'), .true.)
      call put(of_minimum_film, film_name('smallest film'), .true.)
      call put(of_friction, 'ln friction_coefficient', .true.)
      call put(of_rolling_coefficient, 'ln rolling_resistance_coefficient', .true.)
      call put(of_rolling_force, 'ln rolling_resistance', case%is_dimensional)
      call put(of_ratio, 'ln harmonic_ratio', case%responds())
      call put(of_phase, 'harmonic_phase', case%responds())
      call put(of_marched_ratio, 'ln amplitude_ratio_fit', case%repeats())
      call put(of_marched_phase, 'phase_fit', case%repeats())
      call put(of_mean_film, film_name('mean film'), case%repeats())
      associate (touching => case%effects%touching%data)
         call put(of_share, 'ln touching_share', touching%is_given() .and. .not. touching%seeks_speed())
         call put(of_speed, 'ln mean_speed_m_per_s', touching%seeks_speed())
      end associate

   contains

      subroutine put(of, text, exists)
         integer, intent(in) :: of
         character(len=*), intent(in) :: text
         logical, intent(in) :: exists
         call list%add(sensitivity_name(of, gradient%name), 'd '//text//'/d ln '//trim(gradient%name)// &
            ', other keys the same', gradient%of(of), exists=exists)
      end subroutine put

      !> Films are in metres where the contact is.
      pure function film_name(film) result(text)
         character(len=*), intent(in) :: film
         character(len=:), allocatable :: text
         text = 'ln '//film//trim(merge(' in metres    ', ' in units of c', case%is_dimensional))
      end function film_name

   end subroutine add_gradient

   !> Derivatives by ln(eta/eta0) at all pressures and by the stress of the flow law.
   subroutine add_by_oil(list, case, result)
      type(quantity_list_t), intent(inout) :: list
      type(case_t), intent(in) :: case
      type(case_result_t), intent(in) :: result
      character(len=*), parameter :: by(2) = [character(len=6) :: 'alpha', 'stress'], &
                                     of(2) = [character(len=31) :: 'alpha', 'the stress of the flow law']
      integer :: x

      do x = 1, size(by)
         associate (r => result%by_oil(x))
            call list%add('film_sensitivity_'//trim(by(x)), 'd ln H(0,0) of the smooth contact/d ln '//trim(of(x)), &
               r%film, exists=case%sensitivities)
            call list%add('response_sensitivity_'//trim(by(x)), 'd ln harmonic_ratio/d ln '//trim(of(x)), &
               r%response, exists=case%sensitivities)
            call list%add('response_real_by_'//trim(by(x)), 'd harmonic_real/d ln '//trim(of(x)), r%response_real, &
               exists=case%sensitivities)
            call list%add('response_imaginary_by_'//trim(by(x)), 'd harmonic_imaginary/d ln '//trim(of(x)), &
               r%response_imaginary, exists=case%sensitivities)
         end associate
      end do
   end subroutine add_by_oil

end module ehlwave_sensitivity_quantities
