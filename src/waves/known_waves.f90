!> Waves in a contact before a march: the periodic solution to second order in their amplitude, and the correction that
!> the march on a coarser grid found.
module ehlwave_known_waves
   use ehlwave_grid, only: grid_t
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_harmonic_solver, only: harmonic_solver_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_lagrange, only: lagrange_weights
   use ehlwave_mean_film, only: find_mean_change, mean_change_t
   use ehlwave_neighbour_range, only: held_at_steep_end
   use ehlwave_real_transfer, only: interpolate
   use ehlwave_second_harmonic, only: find_second_harmonic
   use ehlwave_state, only: new_state, state_t
   use ehlwave_status, only: status_converged
   use ehlwave_steady_tangent, only: steady_tangent_t
   use ehlwave_surfaces, only: surfaces_t
   implicit none (type, external)
   private

   !> Waves of a surface, of amplitude A.
   type :: surface_waves_t
      real(dp) :: frequency = 0                        ! w in units of 1/T
      real(dp) :: amplitude = 0                        ! A in units of c
      type(harmonic_response_t) :: turning(2)          ! the two harmonics, to waves of amplitude 1
   end type surface_waves_t

   !> Waves of amplitude A about the steady state u0 of smooth surfaces, everywhere and for ever, theory eq. (W9):
   !>
   !>     u(T) = u0 + A^2 u20 + Re(A u1 exp(-i w T)) + Re(A^2 u22 exp(-2 i w T)),     u = P, H, Delta,
   !>
   !> with the linear response u1, the change of the mean u20 and the second harmonic u22. They satisfy the time
   !> differences of a march with dT = hX or a whole part of it: a march that starts in these waves has nothing to
   !> settle at first and second order. Waves of two surfaces add up; their second-order interaction is left to the
   !> march.
   type, public :: known_waves_t
      integer :: linear_steps = 0                      !! GMRES steps
      type(state_t), private :: smooth                 ! without waves
      type(state_t), private :: still                  ! stationary part
      type(surface_waves_t), allocatable, private :: waves(:)   ! waves of each surface
      type(state_t), private :: rest(3)                ! corrections from a coarser grid, see `take_rest`
      real(dp), private :: rest_time = 0, rest_step = 1
      logical, private :: has_rest = .false.
   contains
      procedure :: find
      procedure :: take_rest
      procedure :: state_at
      procedure :: limit
      procedure, private :: to_second_order
   end type known_waves_t

   real(dp), parameter :: thinnest = 0.1_dp   !! share of the smooth film, where waves would leave less

contains

   !> Find them about the steady state of the finest of `levels`. Without the first order nothing is found; missing
   !> parts of the second order are left out.
   subroutine find(self, levels, surfaces, film, natural_frequency, steps_per_cell, is_found)
      class(known_waves_t), intent(out) :: self
      type(level_t), intent(inout), target :: levels(:)   !! coarsest first
      type(surfaces_t), intent(in) :: surfaces            !! surfaces that move
      real(dp), intent(in) :: film                        !! smooth H(0,0) by which their amplitudes are known
      real(dp), intent(in) :: natural_frequency           !! Omega of the equation of motion; 0: force balance
      integer, intent(in) :: steps_per_cell               !! m for dT = hX/m
      logical, intent(out) :: is_found
      class(harmonic_solver_t), allocatable :: solver
      class(steady_tangent_t), allocatable :: tangent
      type(mean_change_t) :: mean
      integer :: n

      allocate (solver, tangent, self%waves(size(surfaces%list)))
      call solver%init(levels)
      do n = 1, size(self%waves)
         associate (waves => self%waves(n), first => self%waves(n)%turning(1), second => self%waves(n)%turning(2))
            waves%frequency = surfaces%list(n)%frequency()
            waves%amplitude = surfaces%list(n)%amplitude(film)
            call solver%respond(levels, surfaces%list(n), natural_frequency, steps_per_cell, first)
            self%linear_steps = self%linear_steps + first%linear_steps
            is_found = first%status == status_converged
            if (.not. is_found) return
            call find_second_harmonic(solver, levels, first, waves%frequency, natural_frequency, steps_per_cell, second)
            self%linear_steps = self%linear_steps + second%linear_steps
         end associate
      end do
      deallocate (solver)
      call tangent%init(levels)
      self%smooth = levels(size(levels))%state
      self%still = self%smooth
      do n = 1, size(self%waves)
         call find_mean_change(tangent, levels, self%waves(n)%turning(1), surfaces%list(n), self%waves(n)%amplitude, &
                               mean)
         self%linear_steps = self%linear_steps + mean%linear_steps
         if (mean%status == status_converged) call self%still%add(mean%state, 1.0_dp)
      end do
   end subroutine find

   !> State at T; with the correction of `take_rest`, near its time.
   pure function state_at(self, t) result(state)
      class(known_waves_t), intent(in) :: self
      real(dp), intent(in) :: t
      type(state_t) :: state
      real(dp) :: weights(3)
      integer :: m

      state = self%to_second_order(t)
      if (self%has_rest) then
         weights = lagrange_weights(size(weights), (self%rest_time - t)/self%rest_step)
         do m = 1, 3
            call state%add(self%rest(m), weights(m))
         end do
      end if
      call self%limit(state)
   end function state_at

   !> Limit a state near these waves to physical values: where the smooth pressure ends, P stays in the range of its
   !> smooth neighbours.
   pure subroutine limit(self, state)
      class(known_waves_t), intent(in) :: self
      type(state_t), intent(inout) :: state
      integer :: i, j

      do j = 0, ubound(state%p, 2)
         do i = 1, ubound(state%p, 1) - 1
            state%p(i, j) = held_at_steep_end(state%p(i, j), self%smooth%p, i, j)
         end do
      end do
      state%p = max(state%p, 0.0_dp)
      state%h = max(state%h, thinnest*self%smooth%h)
   end subroutine limit

   !> The expansion above at T. P may be negative where the film is about to cavitate.
   pure function to_second_order(self, t) result(state)
      class(known_waves_t), intent(in) :: self
      real(dp), intent(in) :: t
      type(state_t) :: state
      integer :: m, n

      state = self%still
      do n = 1, size(self%waves)
         associate (waves => self%waves(n))
            do m = 1, 2
               if (waves%turning(m)%status == status_converged) &
                  call waves%turning(m)%add_to(state, waves%amplitude**m*exp(cmplx(0, -m*waves%frequency*t, dp)))
            end do
         end associate
      end do
   end function to_second_order

   !> Take from the last three solutions of a march on the grid with half as many cells the difference from the waves
   !> known there to second order.
   subroutine take_rest(self, fine, coarse_grid, coarse, last, t, dt)
      class(known_waves_t), intent(inout) :: self
      type(grid_t), intent(in) :: fine, coarse_grid
      type(known_waves_t), intent(in) :: coarse          !! those waves
      type(state_t), intent(in) :: last(3)               !! solutions there at T, T - dT, T - 2 dT
      real(dp), intent(in) :: t, dt
      type(state_t) :: known
      integer :: n

      do n = 1, 3
         known = coarse%to_second_order(t - (n - 1)*dt)
         self%rest(n) = new_state(fine)
         call interpolate(coarse_grid, fine, last(n)%p - known%p, self%rest(n)%p)
         call interpolate(coarse_grid, fine, last(n)%h - known%h, self%rest(n)%h)
         self%rest(n)%delta = last(n)%delta - known%delta
      end do
      self%rest_time = t
      self%rest_step = dt
      self%has_rest = .true.
   end subroutine take_rest

end module ehlwave_known_waves
