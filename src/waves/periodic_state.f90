!> The periodic state of a contact with moving waves: what a march comes to, without the march.
module ehlwave_periodic_state
   use ehlwave_bent_step, only: bend
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp, pi
   use ehlwave_mean_film, only: find_mean_change, mean_change_t
   use ehlwave_periodic_system, only: periodic_system_t
   use ehlwave_phase_samples, only: new_phase_samples, phase_samples_t
   use ehlwave_real_gmres, only: gmres_t
   use ehlwave_real_transfer, only: interpolate
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_state, only: new_state, state_t
   use ehlwave_status, only: status_converged, status_diverged, status_stalled
   use ehlwave_step_limit, only: step_limit_t
   use ehlwave_waviness, only: waviness_t
   implicit none (type, external)
   private

   !> States at the phases of one period of the pattern: A Re(g exp(-i phi)), phi = w T, a crest at the origin at phi = 0.
   type, public :: periodic_state_t
      type(phase_samples_t) :: phases
      type(state_t), allocatable :: states(:)       !! (phases%n)
      type(solve_report_t) :: report                !! the worst of the states, steps of the finest grid
   contains
      procedure :: find
   end type periodic_state_t

   !> The waves.
   type, public :: periodic_settings_t
      type(waviness_t) :: waviness                  !! that moves
      real(dp) :: amplitude = 0                     !! A in units of c
      real(dp) :: natural_frequency = 0             !! Omega of the equation of motion; 0: force balance
      integer :: steps_per_cell = 1                 !! m for dT = hX/m
      integer :: harmonics = 3
   end type periodic_settings_t

   real(dp), parameter :: loosest = 0.1_dp          !! linear tolerance far from the solution
   real(dp), parameter :: last_step_share = 0.3_dp  !! of the tolerance, left by the linear solver in the last step
   real(dp), parameter :: lowest_pressure = -0.02_dp   !! of an iterate; solutions are clipped at 0
   real(dp), parameter :: coarse_tolerance = 1e-3_dp   !! of the levels below the finest
   real(dp), parameter :: fewest_points = 8            !! mesh sizes on a wave
   integer, parameter :: largest_newton = 12
   integer, parameter :: largest_krylov = 40
   real(dp), parameter :: poor_reduction = 0.3_dp      !! of the linear residual within so many steps: then it is given up

contains

   !> From the coarsest of the levels that resolves the waves to the finest. All levels have their steady states of smooth surfaces.
   subroutine find(self, levels, settings, limits)
      class(periodic_state_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)
      type(periodic_settings_t), intent(in) :: settings
      type(solve_limits_t), intent(in) :: limits
      type(periodic_system_t), allocatable :: system
      type(solve_limits_t) :: coarse
      real(dp) :: frequency
      integer :: first, l

      self%phases = new_phase_samples(settings%harmonics)
      frequency = 2*pi*settings%waviness%slip/settings%waviness%wavelength_x
      coarse = limits
      coarse%tolerance = max(limits%tolerance, coarse_tolerance)
      first = first_level(levels, settings%waviness)
      do l = first, size(levels)
         if (allocated(system)) deallocate (system)
         allocate (system)
         call system%init(levels(:l), self%phases, frequency, settings%natural_frequency, settings%steps_per_cell)
         if (l == first) then
            call guess(self, system, levels(:l), settings)
         else
            call refine(self, levels(l - 1), levels(l))
         end if
         if (l == size(levels)) coarse = limits
         call solve(self, system, levels(:l), settings, coarse)
         if (self%report%status /= status_converged) return
      end do
   end subroutine find

   !> The coarsest level with a steady state that has enough points on a wave.
   pure integer function first_level(levels, waviness) result(first)
      type(level_t), intent(in) :: levels(:)
      type(waviness_t), intent(in) :: waviness
      do first = 1, size(levels) - 1
         associate (grid => levels(first)%problem%grid)
            if (waviness%wavelength_x < fewest_points*grid%hx) cycle
            if (waviness%wavelength_y > 0 .and. waviness%wavelength_y < fewest_points*grid%hy) cycle
            if (levels(first)%report%status == status_converged) return
         end associate
      end do
   end function first_level

   !> First guess: smooth contact, linear response and change of the mean.
   subroutine guess(self, system, levels, settings)
      class(periodic_state_t), intent(inout) :: self
      type(periodic_system_t), intent(inout) :: system
      type(level_t), intent(inout), target :: levels(:)
      type(periodic_settings_t), intent(in) :: settings
      type(harmonic_response_t) :: response
      type(mean_change_t) :: mean
      complex(dp) :: factor
      integer :: k

      call system%waves(1)%respond(levels, settings%waviness, settings%natural_frequency, settings%steps_per_cell, response)
      call find_mean_change(system%mean, levels, response, settings%waviness, settings%amplitude, mean)
      if (allocated(self%states)) deallocate (self%states)
      allocate (self%states(self%phases%n))
      do k = 1, self%phases%n
         associate (state => self%states(k))
            factor = settings%amplitude*self%phases%factor(k, 1)
            state = levels(size(levels))%state
            if (response%status == status_converged) then
               state%p = state%p + real(factor*response%p, dp)
               state%delta = state%delta + real(factor*response%approach, dp)
            end if
            if (mean%status == status_converged) then
               state%p = state%p + mean%state%p
               state%delta = state%delta + mean%state%delta
            end if
            state%p = max(0.0_dp, state%p)
         end associate
      end do
   end subroutine guess

   !> First guess from the states of the next coarser level.
   subroutine refine(self, coarse, fine)
      class(periodic_state_t), intent(inout) :: self
      type(level_t), intent(in) :: coarse, fine
      type(state_t) :: state
      integer :: k
      do k = 1, self%phases%n
         state = new_state(fine%problem%grid)
         call interpolate(coarse%problem%grid, fine%problem%grid, self%states(k)%p, state%p)
         state%p = max(0.0_dp, state%p)
         state%delta = self%states(k)%delta
         self%states(k) = state
      end do
   end subroutine refine

   !> Newton's method for all samples at once, from the states of `guess`; GMRES over the whole period.
   subroutine solve(self, system, levels, settings, limits)
      class(periodic_state_t), intent(inout) :: self
      type(periodic_system_t), intent(inout) :: system   !! of these levels and waves
      type(level_t), intent(inout), target :: levels(:)
      type(periodic_settings_t), intent(in) :: settings
      type(solve_limits_t), intent(in) :: limits
      type(gmres_t) :: gmres
      real(dp), allocatable, target :: b(:), change(:)
      real(dp) :: forcing, ratio, worth, worth_before
      integer :: k, step

      allocate (b(system%n), change(system%n))
      gmres%largest_steps = largest_krylov
      self%report = solve_report_t()
      forcing = loosest
      worth_before = 0
      call system%borrow(levels)
      associate (problem => levels(size(levels))%problem)
         do k = 1, self%phases%n
            associate (given => system%samples(k)%equations%given)
               given%rough = settings%amplitude* &
                             settings%waviness%shape_fixed(problem%grid%x, problem%grid%y, -2*pi*(k - 1)/self%phases%n)
               call problem%film_of_guess(given, self%states(k))
            end associate
         end do
         do step = 0, largest_newton
            call system%evaluate(problem, self%states)
            call judge(self, system, limits%tolerance)
            call system%right_side(self%states, b)
            worth = sqrt(sum(b**2))
            if (self%report%status /= status_stalled .or. step == largest_newton) exit
            if (step > 0) then
               ratio = worth/worth_before
               forcing = merge(0.3_dp*forcing, min(loosest, 0.5_dp*ratio**1.5_dp), ratio > 0.5_dp)
            end if
            forcing = min(loosest, max(forcing, last_step_share*limits%tolerance/self%report%residual))
            worth_before = worth
            call system%factorise()
            call gmres%solve(system, b, change, forcing)
            self%report%linear_steps = self%report%linear_steps + gmres%steps
            self%report%nonlinear_steps = step + 1
            if (gmres%reduction > max(forcing, poor_reduction)) exit
            if (gmres%steps == 0 .or. .not. take_step(self, system, levels(size(levels)), change)) then
               self%report%status = status_diverged
               exit
            end if
         end do
      end associate
      if (self%report%status == status_converged) then
         do k = 1, self%phases%n
            self%states(k)%p = max(self%states(k)%p, 0.0_dp)
         end do
      end if
      call system%release()
   end subroutine solve

   !> The worst of all states.
   subroutine judge(self, system, tolerance)
      type(periodic_state_t), intent(inout) :: self
      type(periodic_system_t), intent(in) :: system
      real(dp), intent(in) :: tolerance
      type(solve_report_t) :: report
      integer :: k

      associate (worst => self%report)
         worst%status = status_converged
         worst%residual = 0
         worst%complementarity = 0
         worst%load_error = 0
         do k = 1, self%phases%n
            call report%judge(system%samples(k)%equations, self%states(k), tolerance)
            worst%residual = max(worst%residual, report%residual)
            worst%complementarity = max(worst%complementarity, report%complementarity)
            worst%load_error = max(worst%load_error, report%load_error)
            if (report%status /= status_converged) worst%status = report%status
         end do
      end associate
   end subroutine judge

   !> Step along `change`, one share of it for all samples that keeps pressures and films within their limits.
   logical function take_step(self, system, level, change) result(has_moved)
      type(periodic_state_t), intent(inout) :: self
      type(periodic_system_t), intent(in) :: system
      type(level_t), intent(inout) :: level
      real(dp), intent(inout), contiguous, target :: change(:)   !! bent on return
      real(dp), pointer, contiguous :: q(:, :)
      type(state_t), allocatable :: before(:)
      type(step_limit_t) :: limit
      real(dp) :: share, step
      integer :: k

      before = self%states
      step = 1
      do k = 1, self%phases%n
         step = min(step, limit%of_pressure(reshape(change((k - 1)*system%n_one + 1:k*system%n_one - 1), [system%n_one - 1, 1])))
      end do
      share = 1
      do k = 1, self%phases%n
         associate (state => self%states(k), grid => level%problem%grid)
            q(0:grid%nx, 0:grid%ny) => change((k - 1)*system%n_one + 1:k*system%n_one - 1)
            call bend(system%samples(k)%equations, step, q)
            state%p = max(state%p + q, lowest_pressure)
            state%delta = state%delta + step*change(k*system%n_one)
            call level%problem%film_of(system%samples(k)%equations%given, state%p, state%delta, state%h)
            share = min(share, limit%of_film(before(k)%h, state%h - before(k)%h))
         end associate
      end do
      has_moved = share > 0
      if (share >= 1) return
      do k = 1, self%phases%n
         associate (state => self%states(k))
            state%p = before(k)%p + share*(state%p - before(k)%p)
            state%h = before(k)%h + share*(state%h - before(k)%h)
            state%delta = before(k)%delta + share*(state%delta - before(k)%delta)
         end associate
      end do
   end function take_step

end module ehlwave_periodic_state
