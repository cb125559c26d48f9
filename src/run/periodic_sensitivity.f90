!> Derivatives of a periodic state: Ad/Ai, its phase and the mean film by all variables, theory eq. (W20).
module ehlwave_periodic_sensitivity
   use ehlwave_amplitude, only: fitted_mean
   use ehlwave_case_account, only: add_warning
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t, of_central_film, of_marched_phase, of_marched_ratio, of_mean_film
   use ehlwave_case_variables, only: case_variables
   use ehlwave_conditions, only: conditions_t
   use ehlwave_contact_variant, only: contact_variable_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_march_case, only: march_settings
   use ehlwave_march_gradient, only: march_gradient_t
   use ehlwave_march_recording, only: march_recording_t
   use ehlwave_overtones, only: resolved_periods
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_settling, only: wave_parts
   use ehlwave_shared_steady, only: adjoint_tolerance, shared_steady_t
   use ehlwave_surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: find_periodic_sensitivities

   integer, parameter :: of(3) = [of_marched_ratio, of_marched_phase, of_mean_film]

contains

   !> Derivatives by all variables of the steady state, whose derivatives are known; they stay NaN if a step fails.
   subroutine find_periodic_sensitivities(case, plan, steady, recording, result)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(shared_steady_t), intent(inout) :: steady
      type(march_recording_t), intent(in) :: recording
      type(case_result_t), intent(inout) :: result           !! with the last period of the recorded march
      type(contact_variable_t), allocatable :: variables(:)
      type(march_gradient_t) :: gradient
      type(surfaces_t) :: surfaces
      real(dp), allocatable :: film_slopes(:), weights(:, :)
      real(dp) :: values(size(of)), slopes(size(of))
      integer :: k, n, shift

      if (recording%last < plan%steps .or. .not. allocated(result%by_key)) return
      allocate (variables, source=case_variables(case))
      allocate (film_slopes(size(variables)), source=no_value)
      do n = 1, size(variables)
         if (.not. allocated(variables(n)%variants)) cycle
         associate (variants => variables(n)%variants)
            film_slopes(n) = result%by_key(n)%of(of_central_film) - &
                             sum(variants%weight*log([(length(variants(k)%conditions), k=1, size(variants))]))
         end associate
      end do
      weights = film_weights(plan, result)
      ! steps of the samples less steps of the march, which began later
      associate (times => sample_times(plan, plan%surfaces))
         shift = nint((recording%time - times(size(times)))/plan%dt) + plan%steps - recording%last
      end associate
      call gradient%find(steady%multigrid%levels, march_settings(case, plan, result%central_film), recording, &
                         steady%response%tangent%state, variables, film_slopes, &
                         plan%first_sample - shift, weights, adjoint_tolerance(case))
      result%transposed_solves = result%transposed_solves + gradient%solves
      result%transposed_work = result%transposed_work + gradient%work
      if (.not. gradient%is_found) then
         call add_warning(result, 'no sensitivities of the periodic state: a transposed step did not converge, or '// &
            'their weights do not fade')
         return
      end if
      do n = 1, size(variables)
         if (.not. allocated(variables(n)%variants)) cycle
         slopes = gradient%change(:, n)
         do k = 1, size(variables(n)%variants)
            associate (variant => variables(n)%variants(k))
               surfaces = plan%surfaces
               surfaces%list = variant%waves
               values = values_of(plan, surfaces, result, result%central_film*exp(variant%place*film_slopes(n)), &
                                  length(variant%conditions))
               slopes = slopes + variant%weight*values
            end associate
         end do
         result%by_key(n)%of(of) = slopes
      end do
   end subroutine find_periodic_sensitivities

   !> Unit of H, m; 1 without dimensions.
   elemental real(dp) function length(conditions)
      type(conditions_t), intent(in) :: conditions
      length = 1
      if (conditions%has_dimensions) length = conditions%c_m
   end function length

   !> Times of the samples, with the pattern's crest at X = 0 at T = 0.
   pure function sample_times(plan, surfaces) result(times)
      type(case_plan_t), intent(in) :: plan
      type(surfaces_t), intent(in) :: surfaces
      real(dp) :: times(plan%steps - plan%first_sample + 1)
      integer :: k
      associate (main => surfaces%list(surfaces%main))
         times = [(k*plan%dt + main%start/main%slip, k=plan%first_sample, plan%steps)]
      end associate
   end function sample_times

   !> ln(Ad/Ai), its phase and ln(mean film) of the measured samples with other surfaces.
   function values_of(plan, surfaces, result, film, length) result(values)
      type(case_plan_t), intent(in) :: plan
      type(surfaces_t), intent(in) :: surfaces
      type(case_result_t), intent(in) :: result
      real(dp), intent(in) :: film, length               !! smooth H(0,0), unit of H
      real(dp) :: values(size(of))
      complex(dp) :: parts(size(surfaces%list))
      real(dp), dimension(plan%steps - plan%first_sample + 1) :: samples, times

      times = sample_times(plan, surfaces)
      samples = result%film_history
      associate (main => surfaces%main)
         parts = wave_parts(surfaces, film, times, samples)
         values(1) = log(abs(parts(main))/surfaces%list(main)%amplitude(film))
         values(2) = atan2(aimag(parts(main)), real(parts(main), dp))
         values(3) = log(length*fitted_mean(times(2:), samples(2:), resolved_periods(surfaces, plan%dt)))
      end associate
   end function values_of

   !> Derivatives of the results by H(0,0) at the samples: wave and mean are linear in the samples.
   function film_weights(plan, result) result(weights)
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result
      real(dp) :: weights(size(of), plan%first_sample:plan%steps)
      complex(dp) :: parts(size(plan%surfaces%list)), whole(size(plan%surfaces%list))
      real(dp), dimension(plan%steps - plan%first_sample + 1) :: sample, samples, times
      real(dp), allocatable :: periods(:)
      integer :: k

      weights = 0
      times = sample_times(plan, plan%surfaces)
      samples = result%film_history
      periods = resolved_periods(plan%surfaces, plan%dt)
      associate (surfaces => plan%surfaces, main => plan%surfaces%main, film => result%central_film)
         whole = wave_parts(surfaces, film, times, samples)
         do k = plan%first_sample, plan%steps
            sample = 0
            sample(k - plan%first_sample + 1) = 1
            parts = wave_parts(surfaces, film, times, sample)/whole
            weights(1, k) = real(parts(main), dp)
            weights(2, k) = aimag(parts(main))
            weights(3, k) = fitted_mean(times(2:), sample(2:), periods)/ &
                            fitted_mean(times(2:), samples(2:), periods)
         end do
      end associate
   end function film_weights

end module ehlwave_periodic_sensitivity
