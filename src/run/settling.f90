!> Waves at the contact centre from period to period, and the error of Ad/Ai by its unsettled part.
module ehlwave_settling
   use ehlwave_amplitude, only: fit_misfit, fitted_harmonic, fitted_harmonics, fitted_mean
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_kinds, only: dp, no_value, pi
   use ehlwave_march_result, only: march_result_t
   use ehlwave_overtones, only: resolved_periods
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_surfaces, only: surfaces_t
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: left_to_come, settling_error, unrest_text, wave_parts

   real(dp), parameter :: settling_share = 0.5_dp   !! share of the change from period to period that is still to come
   real(dp), parameter :: largest_series = 20       !! changes of which a geometric series is taken to consist
   real(dp), parameter :: safety = 2                !! safety factor on the rest
   real(dp), parameter :: largest_error = 100        !! reported where the amplitude is unknown
   real(dp), parameter :: quiet = 0.05_dp           !! error by the unsettled part that needs no warning

contains

   !> Relative error of the amplitude in the last period. `change_in_a_period` gives the settling of waves alone. Where
   !> the layer of oil or the load changes besides, or the contact may swing, see `left_to_come`; before the inlet can
   !> have followed a change of the layer the error is unknown.
   real(dp) function settling_error(case, plan, history, result) result(error)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(march_result_t), intent(in) :: history
      type(case_result_t), intent(in) :: result  !! with the data of the last period
      complex(dp), allocatable :: parts(:, :)
      real(dp), allocatable :: means(:), misfits(:), periods(:)
      integer :: before, n

      error = change_in_a_period(case, plan, history, result)
      if (.not. is_moved_besides(case)) return
      associate (surfaces => plan%surfaces)
         periods = resolved_periods(surfaces, plan%dt)
         allocate (parts(size(surfaces%list), 0), means(0), misfits(0))
         do n = 2, 0, -1
            before = n*nint(surfaces%longest_period()/plan%dt)
            if (plan%first_sample < before) cycle
            associate (time => history%time(plan%first_sample - before:history%steps - before), &
                       film => history%central_film(plan%first_sample - before:history%steps - before))
               parts = reshape([parts, wave_parts(surfaces, result%central_film, time, film)], &
                               [size(parts, 1), size(parts, 2) + 1])
               means = [means, fitted_mean(time, film, periods)]
               misfits = [misfits, fit_misfit(time, film, periods)]
            end associate
         end do
      end associate
      error = maxval([(left_to_come(parts(n, :), means, misfits), n=1, size(parts, 1))])
      if (plan%first_sample*plan%dt < plan%rest) error = largest_error
   end function settling_error

   !> Whether more than the waves moves the film.
   logical function is_moved_besides(case)
      type(case_t), intent(in) :: case
      is_moved_besides = case%effects%changing() /= '' .or. abs(case%load_factor - 1) > 0 .or. &
                         case%load_balance == 'equation_of_motion'
   end function is_moved_besides

   !> The rest of the change of an amplitude, over its final value, by the last three periods: wave, mean film and
   !> misfit. As a contact settles or swings, the changes d of the complex wave are a geometric series of the ratio q =
   !> d2/d1, and the rest is d2 q/(1 - q). A drift of the mean enters the fit of a wave with 1/pi of it. With two
   !> periods there is no ratio, with one the rest is unknown. In 162 results of 54 random marches (changes of the
   !> layer, load steps, contacts that swing; 16 cells per a; the planned end and early ends) the estimate covered the
   !> distance to the settled Ad/Ai, apart from the position of samples in a period.
   pure real(dp) function left_to_come(parts, means, misfits) result(error)
      complex(dp), intent(in) :: parts(:)             !! parts of the wave, one per period, in order
      real(dp), intent(in) :: means(:), misfits(:)    !! means of the film in the same periods
      complex(dp) :: changes(size(parts) - 1)
      real(dp) :: left, series
      integer :: n

      n = size(parts)
      error = largest_error
      if (n < 2) return
      changes = parts(2:) - parts(:n - 1)
      series = 1
      if (n > 2) series = abs(changes(n - 1))/max(abs(changes(n - 2) - changes(n - 1)), tiny(series))
      left = max(abs(changes(n - 1))*min(max(settling_share, series), largest_series), &
                 abs(means(n) - means(n - 1))/pi, sqrt(2.0_dp)*abs(misfits(n) - misfits(n - 1)))
      left = safety*left
      error = left/max(abs(parts(n)) - left, left/largest_error)
   end function left_to_come

   !> A warning where the film has not settled; '' where it has.
   function unrest_text(case, plan, error) result(text)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      real(dp), intent(in) :: error             !! result of `settling_error`
      character(len=:), allocatable :: text
      text = ''
      if (.not. is_moved_besides(case) .or. error <= quiet) return
      if (plan%first_sample*plan%dt < plan%rest) then
         text = 'the film may still change: the inlet may follow the change of its layer until T = '// &
            to_text(plan%rest, 4)//'; take a later end_time'
      else
         text = 'the film still changes, and not by the waves alone'
         if (error < 1) text = text//', which may leave '//to_text(100*error, 2)//' % in Ad/Ai'
         if (error >= 1) text = text//': Ad/Ai does not describe the waves'
         text = text//'; take '//trim(merge('a later end_time     ', 'more settling_periods', case%end_time > 0))
      end if
   end function unrest_text

   !> Relative error of the amplitude in the last period, by its change since the period before; 0 without one.
   !> Measured from rest after `settling_periods` = 1: 0.02 to 0.8 of the change is still to come, most where it is
   !> small. With fewer, all of the change is counted: the period before contains the time before the waves, and the
   !> equation of motion continues to swing (M = 47, Omega = 3.5: 5 per cent off with none).
   real(dp) function change_in_a_period(case, plan, history, result) result(change)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(march_result_t), intent(in) :: history
      type(case_result_t), intent(in) :: result  !! with the data of the last period
      complex(dp) :: parts(size(plan%surfaces%list))
      real(dp) :: ratios(size(plan%surfaces%list))
      integer :: first, last, n

      change = 0
      associate (surfaces => plan%surfaces, longest => plan%surfaces%longest_period())
         first = plan%first_sample - nint(longest/plan%dt)
         last = plan%first_sample + nint((surfaces%window() - longest)/plan%dt)
         if (first < 0) return
         parts = wave_parts(surfaces, result%central_film, history%time(first:last), history%central_film(first:last))
         ratios = result%ratios(size(ratios))
         change = maxval([(abs(abs(parts(n))/(ratios(n)*surfaces%list(n)%amplitude(result%central_film)) - 1), &
                           n=1, size(parts))])
      end associate
      if (case%settling_periods >= 1 .and. .not. case%end_time > 0) change = settling_share*change
   end function change_in_a_period

   !> The wave of each surface in the film at the centre, as by `fitted_harmonic`, beside the overtones of two. Two
   !> waves of equal frequency cannot be separated there: they have their shares of a single pattern, else it is NaN.
   pure function wave_parts(surfaces, central_film, time, film) result(parts)
      type(surfaces_t), intent(in) :: surfaces        !! surfaces that move
      real(dp), intent(in) :: central_film            !! smooth H(0,0)
      real(dp), intent(in) :: time(:), film(:)        !! H(0,0) at T
      complex(dp) :: parts(size(surfaces%list))
      complex(dp), allocatable :: waves(:)
      real(dp) :: amplitudes(size(surfaces%list))
      integer :: n

      associate (list => surfaces%list)
         if (surfaces%are_apart()) then
            waves = fitted_harmonics(time, film, resolved_periods(surfaces, time(2) - time(1)))
            parts = waves(:size(list))
         else
            amplitudes = [(list(n)%amplitude(central_film), n=1, size(list))]
            parts = (no_value, no_value)
            if (surfaces%are_one()) &
               parts = fitted_harmonic(time, film, list(1)%period())*amplitudes/sum(amplitudes)
         end if
      end associate
   end function wave_parts

end module ehlwave_settling
