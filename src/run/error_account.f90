!> The error of a result, part by part.
module ehlwave_error_account
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_accuracy_model, only: expected_step_error
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_lubricant, only: extrapolation_text
   use ehlwave_case_result, only: case_result_t
   use ehlwave_effects_keys, only: effect_count
   use ehlwave_effects_plan, only: error_name
   use ehlwave_error_factors, only: by_domain, central_film, response
   use ehlwave_error_parts, only: error_parts_t
   use ehlwave_kinds, only: dp
   use ehlwave_linear_range, only: is_beyond_linear, linear_limit_text
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_roughness, only: roughness_t
   use ehlwave_surface_result, only: surface_result_t
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: error_asked_for, errors_text, take_errors, validity_text

contains

   !> Combine the errors of film and Ad/Ai, and their sum for the main quantity.
   subroutine take_errors(case, plan, result)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(inout) :: result

      result%film_errors = error_parts_t(mesh=result%central_film_error, &
                                         domain=merge(plan%film_domain_error, result%film_domain_error, &
                                                      case%edges == 'truncated'), &
                                         algebraic=case%tolerance)
      result%minimum_film_error = result%minimum_film_error + case%tolerance
      if (any(ieee_is_finite(result%ratios(2)))) then
         result%ratio_errors = errors_in_time(case, plan, result)
      else if (ieee_is_finite(result%harmonic%ratio)) then
         result%ratio_errors = error_parts_t(mesh=result%response_error(), domain=domain_part(case, plan, result), &
                                             algebraic=case%response_tolerance)
      end if
      call result%effects%add_errors(case, plan, result%film_errors, result%ratio_errors)
      result%error_estimate = error_asked_for(case, merge(result%ratio_errors, result%film_errors, case%has_ratio()))
   end subroutine take_errors

   !> Errors of Ad/Ai of waves in time, or of a standing pattern.
   function errors_in_time(case, plan, result) result(parts)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in), target :: result
      type(error_parts_t) :: parts
      type(surface_result_t), pointer :: surface
      real(dp) :: difference
      integer :: n

      parts = plan%expected
      parts%domain = domain_part(case, plan, result)
      parts%settling = result%settling
      if (plan%steps > 0) parts%algebraic = expected_step_error(case%step_tolerance)
      if (result%amplitude_error_basis /= '') &
         parts%mesh = max(0.0_dp, result%amplitude_ratio_error - parts%algebraic - parts%time)
      if (case%effects%changing() == '') then        ! else the response is that before
         do n = 1, 2
            surface => result%surface(n)
            difference = abs(surface%amplitude_ratio_fit/surface%harmonic%ratio - 1)
            if (ieee_is_finite(difference)) parts%amplitude = max(difference, merge(parts%amplitude, 0.0_dp, n > 1))
         end do
      end if
      parts%amplitude = max(parts%amplitude, result%overtone_error)
   end function errors_in_time

   !> Error of Ad/Ai by the edges of the domain. Waves that keep their amplitude hardly feel the inlet: the part by
   !> waves beyond flooded edges, besides the part by the film, counts in proportion to the amplitude that they lose.
   pure real(dp) function domain_part(case, plan, result) result(error)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result
      real(dp), parameter :: least = 0.02_dp         ! share that counts in any case
      real(dp) :: films(2), ratios(4)                ! errors by the film: planned, and of the result

      error = plan%domain_error
      if (case%edges /= 'flooded') return
      ratios = [result%harmonic%ratio, result%effects%second%surface%harmonic%ratio, result%ratios(2)]
      films = [plan%film_domain_error, result%film_domain_error]*by_domain(response)/by_domain(central_film)
      error = films(2) + max(least, 1 - minval(ratios, mask=ieee_is_finite(ratios)))*max(0.0_dp, error - films(1))
   end function domain_part

   !> The sum, without the domain where its edges are truncated: that is the problem as it was asked for.
   pure real(dp) function error_asked_for(case, parts) result(error)
      type(case_t), intent(in) :: case
      type(error_parts_t), intent(in) :: parts
      type(error_parts_t) :: counted
      counted = parts
      if (case%edges == 'truncated') counted%domain = 0
      error = counted%total()
   end function error_asked_for

   !> The parts for people.
   function errors_text(parts) result(text)
      type(error_parts_t), intent(in) :: parts
      character(len=:), allocatable :: text
      integer :: k
      text = 'mesh '//to_text(parts%mesh, 2)
      do k = 1, effect_count
         if (parts%by_effect(k) > 0) text = text//', '//error_name(k)//' '//to_text(parts%by_effect(k), 2)
      end do
      text = text//', domain '//to_text(parts%domain, 2)
      if (parts%time > 0) text = text//', time steps '//to_text(parts%time, 2)
      if (parts%amplitude > 0) text = text//', amplitude '//to_text(parts%amplitude, 2)
      if (parts%settling > 0) text = text//', settling '//to_text(parts%settling, 2)
      text = text//', tolerances '//to_text(parts%algebraic, 2)
   end function errors_text

   !> A line on the validity of a result: edges, linear range, warnings.
   function validity_text(case, plan, warning) result(text)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      character(len=*), intent(in), optional :: warning   !! warning of the result
      character(len=:), allocatable :: ahead, text
      type(roughness_t) :: both(2)

      text = 'edges '//trim(case%edges)
      if (case%edges == 'truncated') text = text//' (P = 0, film '//to_text(100*plan%film_domain_error, 2)// &
         ' % too thin)'
      if (case%has_linear_range()) then
         text = text//'; waves respond linearly up to Ai = '//linear_limit_text(case)
         if (is_beyond_linear(case)) then
            both = case%surfaces()
            text = text//', asked for '//to_text(100*both(1)%amplitude_over_film, 3)//' %'
            if (both(2)%is_rough()) text = text//' and '//to_text(100*both(2)%amplitude_over_film, 3)//' %'
         end if
      end if
      if (.not. plan%resolution%is_resolved) text = text//'; not resolved'
      if (present(warning)) then
         ahead = warning
      else
         ahead = extrapolation_text(case, plan%rheology, 1.0_dp)   ! under the Hertz pressure
      end if
      if (ahead /= '') text = text//'; '//ahead
   end function validity_text

end module ehlwave_error_account
