!> The periodic state of a case with moving waves, in place of a march.
module ehlwave_periodic_case
   use ehlwave_amplitude, only: sampled_amplitude
   use ehlwave_case_account, only: worse
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: case_plan_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_kinds, only: dp, pi
   use ehlwave_periodic_state, only: periodic_settings_t, periodic_state_t
   use ehlwave_shared_steady, only: shared_steady_t
   use ehlwave_solve_report, only: solve_limits_t
   use ehlwave_status, only: status_converged, status_name
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: find_periodic_state

   !> Harmonics of the state, by Ai over the film. M = 100, D = 1, 0.5 a, 129 x 129 nodes, Ai = 20 %: Ad/Ai = 0.9299 with one,
   !> 0.92768, 0.92771, 0.92771 with two, three and four.
   real(dp), parameter :: largest_of_two = 0.2_dp

contains

   !> Seek it, and take its film as that of a march. Where it is not found the result says so, and is otherwise as it was but for the
   !> effort.
   subroutine find_periodic_state(case, plan, steady, limits, result, is_found)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(shared_steady_t), intent(inout) :: steady      !! with a converged steady state
      type(solve_limits_t), intent(in) :: limits          !! of a time step
      type(case_result_t), intent(inout) :: result
      logical, intent(out) :: is_found
      type(periodic_settings_t) :: settings
      type(periodic_state_t) :: periodic
      real(dp) :: work_before

      settings%waviness = plan%waviness
      settings%amplitude = case%amplitude_over_film*result%central_film
      settings%natural_frequency = case%natural_frequency
      settings%steps_per_cell = plan%steps_per_cell
      settings%harmonics = merge(2, 3, case%amplitude_over_film <= largest_of_two*(1 + epsilon(1.0_dp)))
      work_before = steady%multigrid%work()
      call periodic%find(steady%multigrid%levels, settings, limits)
      result%work = result%work + steady%multigrid%work() - work_before
      result%nonlinear_steps = result%nonlinear_steps + periodic%report%nonlinear_steps
      result%linear_steps = result%linear_steps + periodic%report%linear_steps
      is_found = periodic%report%status == status_converged
      if (is_found) then
         call take_period(plan, settings%amplitude, periodic, steady, result)
         return
      end if
      if (len(result%warning) > 0) result%warning = result%warning//'; '
      result%warning = result%warning//'the periodic state was not found ('//status_name(periodic%report%status)// &
                       ', residual '//to_text(periodic%report%residual, 3)//'): marched in its place'
   end subroutine find_periodic_state

   !> Amplitude, phase and mean over the period, the film at its time steps; the finest level gets the first state.
   subroutine take_period(plan, amplitude, periodic, steady, result)
      type(case_plan_t), intent(in) :: plan
      real(dp), intent(in) :: amplitude                   !! Ai in units of c
      type(periodic_state_t), intent(in) :: periodic
      type(shared_steady_t), intent(inout) :: steady
      type(case_result_t), intent(inout) :: result
      real(dp) :: film(periodic%phases%n), approach(periodic%phases%n), period, phase
      complex(dp) :: wave
      integer :: k, steps

      associate (level => steady%multigrid%levels(size(steady%multigrid%levels)), phases => periodic%phases)
         film = [(level%problem%grid%value_at_centre(periodic%states(k)%h), k=1, phases%n)]
         approach = [(periodic%states(k)%delta, k=1, phases%n)]
         level%state = periodic%states(1)
         period = plan%waviness%period()
         steps = ceiling(period/plan%dt - 1e-9_dp)
         allocate (result%time(0:steps), result%film_history(0:steps), result%approach_history(0:steps))
         do k = 0, steps
            phase = 2*pi*k*plan%dt/period*sign(1.0_dp, plan%waviness%slip)
            result%time(k) = k*plan%dt
            result%film_history(k) = phases%value(film, phase)
            result%approach_history(k) = phases%value(approach, phase)
         end do
         wave = phases%harmonic(1, film)/amplitude
         result%amplitude_ratio = sampled_amplitude(result%film_history)/amplitude
         result%amplitude_ratio_fit = abs(wave)
         result%phase_fit = atan2(aimag(wave), real(wave, dp))
         result%mean_film = real(phases%harmonic(0, film), dp)
      end associate
      result%residual = worse(result%residual, periodic%report%residual)
      result%load_error = worse(result%load_error, periodic%report%load_error)
   end subroutine take_period

end module ehlwave_periodic_case
