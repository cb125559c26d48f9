!> Response of a steady contact to small harmonic waviness: one linear system, theory eq. (W2), no time stepping.
module ehlwave_harmonic_response
   use ehlwave_assertions, only: assert, checks
   use ehlwave_complex_gmres, only: gmres_t
   use ehlwave_complex_linearised_contact, only: linearised_contact_t
   use ehlwave_cycle_settings, only: response_cycle
   use ehlwave_given, only: given_t, steady_given
   use ehlwave_grid, only: grid_t
   use ehlwave_hierarchy, only: level_t, work_of
   use ehlwave_kinds, only: dp, pi
   use ehlwave_load_balance, only: harmonic_inertia
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged, status_not_finite, status_stalled
   use ehlwave_steady_tangent, only: steady_tangent_t, tangent_change_t
   use ehlwave_transport, only: harmonic_wedge
   use ehlwave_two_waves, only: wave_medium_t
   use ehlwave_wave_medium, only: take_media
   use ehlwave_waviness, only: waviness_t
   implicit none (type, external)
   private

   !> Of the linear residual: 1e-4 leaves up to 0.3 % where Ad/Ai is a few per cent (2e-4 of Ai), 1e-5 a tenth of that
   !> for one or two steps more.
   real(dp), parameter :: response_tolerance = 1e-5_dp

   !> The response to a pattern of amplitude A, to first order in A. The pattern is the real part of, theory eq. (W1),
   !>
   !>     A exp(i (kx X - w T)) cos(ky Y)   or   A exp(i (kx X + ky Y - w T))  (oblique),    w = kx S,
   !>
   !> a crest at the origin at T = 0, and P changes by the real part of A p exp(-i w T), likewise H and Delta. The
   !> change of the mean film is of second order in A and not part of this.
   type, public :: harmonic_response_t
      integer :: status = status_stalled             !! converged, stalled or not finite
      complex(dp) :: film = 0                        !! amplitude of H(0,0) over A; its modulus is Ad/Ai
      complex(dp) :: pressure = 0                    !! amplitude of P(0,0) over A
      complex(dp) :: approach = 0                    !! amplitude of Delta over A
      integer :: linear_steps = 0                    !! GMRES steps
      real(dp) :: reduction = 0                      !! of the linear residual
      complex(dp), allocatable :: p(:, :), h(:, :)   !! amplitudes of P and H over A, (0:nx, 0:ny)
   contains
      procedure :: add_to
   end type harmonic_response_t

   !> The contact linearised about a steady state, for changes of one frequency at a time.
   type, public :: harmonic_solver_t
      real(dp) :: tolerance = response_tolerance   !! of the linear residual
      type(linearised_contact_t) :: linear
      class(steady_tangent_t), allocatable :: tangent   !! for real changes that do not turn, see `find_tangent`
      real(dp), private :: tangent_work = 0            ! operations that it took, if a response found it
      type(gmres_t), private :: gmres
      real(dp), private :: frequency = 0           ! of the operator
      logical, private :: is_real = .false.        ! what is asked for: a real change that does not turn
      logical, private :: has_factors = .false.    ! of the frequency
   contains
      procedure :: init
      procedure :: find_tangent
      procedure :: count_tangent
      procedure :: drop
      procedure :: set_frequency
      procedure :: respond
      procedure :: respond_to
   end type harmonic_solver_t

contains

   !> Add the real part of `factor` times the response, the factor A exp(-i w T) for a pattern of amplitude A at T.
   pure subroutine add_to(self, state, factor)
      class(harmonic_response_t), intent(in) :: self
      type(state_t), intent(inout) :: state
      complex(dp), intent(in) :: factor
      state%p = state%p + real(factor*self%p, dp)
      state%h = state%h + real(factor*self%h, dp)
      state%delta = state%delta + real(factor*self%approach, dp)
   end subroutine add_to

   !> Linearise about the steady state of the finest of `levels`, of smooth surfaces; coarser ones about their own, as
   !> far as they have one that is like it. What the finest grid leaves at their nodes is no state of theirs: of a spike
   !> of two nodes across it takes one or none. Book, 2048^2: 25 GMRES steps in place of 48.
   subroutine init(self, levels)
      class(harmonic_solver_t), intent(inout) :: self
      type(level_t), intent(inout) :: levels(:)   !! coarsest first
      type(given_t) :: given
      type(state_t) :: state
      integer :: l, n

      n = size(levels)
      self%has_factors = .false.
      call self%linear%init(levels, response_cycle)
      call self%linear%start(n)
      do l = n, 1, -1
         if (l < n) then
            if (.not. is_like(levels(l), levels(n))) exit
            self%linear%levels(l)%has_own_state = .true.
         end if
         state = levels(l)%state
         associate (problem => levels(l)%problem, equations => self%linear%levels(l)%equations)
            given = steady_given(problem%grid, levels(l)%given%supply)
            call problem%film(given, state%p, state%delta, state%h)
            call equations%evaluate(problem, given, state)
         end associate
      end do
   end subroutine init

   !> Whether a coarser level has a solution of the same case that resolves it. Levels of a heavy load do not: M =
   !> 10,000, 1024^2, with their states: 22 GMRES steps in place of 14.
   pure logical function is_like(coarse, fine)
      type(level_t), intent(in) :: coarse, fine
      real(dp), parameter :: largest_change = 0.05_dp   ! of H(0,0)
      is_like = .false.
      if (allocated(fine%given%supply) .or. allocated(fine%problem%heat)) return
      if (.not. (coarse%has_film() .and. fine%has_film())) return
      is_like = abs(coarse%central_film/fine%central_film - 1) < largest_change
   end function is_like

   !> Have the real linear system about the same state; it stays until it is deallocated.
   subroutine find_tangent(self, levels)
      class(harmonic_solver_t), intent(inout) :: self
      type(level_t), intent(inout) :: levels(:)   !! those of `init`, which may come later
      if (allocated(self%tangent)) return
      allocate (self%tangent)
      call self%tangent%init(levels)
   end subroutine find_tangent

   !> Give back what the next response makes anew, `init` being called again.
   subroutine drop(self)
      class(harmonic_solver_t), intent(inout) :: self
      if (allocated(self%linear%levels)) deallocate (self%linear%levels)
      self%has_factors = .false.
   end subroutine drop

   !> The same for a response, which counts the work of a tangent that an earlier one found: counts do not depend on
   !> their order.
   subroutine count_tangent(self, levels)
      class(harmonic_solver_t), intent(inout) :: self
      type(level_t), intent(inout) :: levels(:)
      real(dp) :: work_before

      if (allocated(self%tangent)) then
         associate (deformation => levels(size(levels))%problem%deformation)
            deformation%work = deformation%work + self%tangent_work
         end associate
      else
         work_before = work_of(levels)
         call self%find_tangent(levels)
         self%tangent_work = work_of(levels) - work_before
      end if
   end subroutine count_tangent

   !> Operator for changes of one frequency, and its factors unless they are there. Those of a real change that does not
   !> turn are the tangent's.
   subroutine set_frequency(self, levels, frequency, inertia, is_real, along)
      class(harmonic_solver_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)   !! those of `init`
      real(dp), intent(in) :: frequency       !! w in units of 1/T
      complex(dp), intent(in) :: inertia      !! weight of Delta in the load row, 0: force balance
      logical, intent(in) :: is_real
      real(dp), intent(in), optional :: along !! wave number along a line contact, 1/a; absent: 0
      real(dp) :: wanted
      integer :: l

      self%is_real = is_real
      wanted = 0
      if (present(along)) wanted = along
      associate (linear => self%linear)
         if (abs(wanted - linear%along) > 0) then
            self%has_factors = .false.
            call linear%set_along(wanted, flow_along(levels(linear%finest)))
         end if
         call linear%borrow(levels)
         if (self%has_factors .and. abs(frequency - self%frequency) <= 0 .and. abs(inertia - linear%inertia) <= 0) then
            if (.not. is_real) call linear%count_factors()
         else
            do l = 1, linear%finest
               linear%levels(l)%wedge = harmonic_wedge(linear%levels(l)%equations%mesh%grid, frequency, &
                                                       linear%levels(linear%finest)%equations%mesh%grid%hx)
            end do
            linear%inertia = inertia
            call linear%weigh(linear%finest)
            if (.not. is_real) call linear%factorise(1)
            self%frequency = frequency
            self%has_factors = .not. is_real
         end if
         call linear%release()
      end associate
   end subroutine set_frequency

   !> Flow along Y over the pressure gradient there, at each node: theory eq. (W16).
   function flow_along(level) result(mobility)
      type(level_t), intent(in) :: level         !! with its steady state
      real(dp), allocatable :: mobility(:, :)    !! (0:nx, 0:ny), 0 at both ends
      type(wave_medium_t), allocatable :: medium(:, :)
      integer :: i

      associate (grid => level%problem%grid)
         allocate (mobility(0:grid%nx, 0:grid%ny), source=0.0_dp)
         allocate (medium(0:grid%ny, 1:grid%nx - 1))
         call take_media(level%problem, level%state, 1, medium)
         do i = 1, grid%nx - 1
            mobility(i, :) = medium(:, i)%eps(2)
         end do
      end associate
   end function flow_along

   !> Response to one pattern. It depends on nothing but the steady state and the pattern: factors of the one before are
   !> used again where its frequency is the same. Of a pattern that varies along Y only all is real.
   subroutine respond(self, levels, waviness, natural_frequency, steps_per_cell, response)
      class(harmonic_solver_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)   !! those of `init`: their deformation is used
      type(waviness_t), intent(in) :: waviness
      real(dp), intent(in) :: natural_frequency      !! Omega of the equation of motion; 0: force balance
      integer, intent(in) :: steps_per_cell          !! m for dT = hX/m: enters through the equation of motion only
      type(harmonic_response_t), intent(out) :: response
      complex(dp), allocatable, target :: b(:)
      complex(dp), allocatable :: g(:, :)
      complex(dp), pointer, contiguous :: dr(:, :)
      complex(dp) :: inertia
      real(dp) :: along, frequency
      integer :: k

      associate (linear => self%linear, grid => self%linear%levels(self%linear%finest)%equations%mesh%grid)
         allocate (b(linear%n), g(0:grid%nx, 0:grid%ny))
         g = waviness%amplitude_at(grid%x, grid%y)
         frequency = waviness%frequency()
         inertia = 0
         if (natural_frequency > 0) inertia = harmonic_inertia(natural_frequency, grid%hx/steps_per_cell, frequency)
         if (waviness%is_longitudinal()) call self%count_tangent(levels)
         along = 0
         if (grid%is_line .and. waviness%wavelength_y > 0) along = 2*pi/waviness%wavelength_y
         call self%set_frequency(levels, frequency, inertia, waviness%is_longitudinal(), along)
         dr(0:grid%nx, 0:grid%ny) => b(:linear%n - 1)
         call linear%gap_change(g, dr)
         associate (edges => linear%levels(linear%finest)%equations%edges)
            do k = 1, edges%count()
               dr(edges%i(k), edges%j(k)) = 0   ! the far field does not see the waves
            end do
         end associate
         dr = -dr
         b(linear%n) = 0
         call self%respond_to(levels, b, response)
         response%h = response%h + g
         response%film = at_centre(grid, response%h)
      end associate
   end subroutine respond

   !> Response of another right side, with the operator of the pattern that was the last.
   subroutine respond_to(self, levels, b, response)
      class(harmonic_solver_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)   !! those of `init`
      complex(dp), intent(in), contiguous :: b(:)         !! weighted change of the residuals, 0 at cavitated nodes
      type(harmonic_response_t), intent(out) :: response
      complex(dp), allocatable, target :: x(:)
      complex(dp), pointer, contiguous :: q(:, :)

      if (checks) call assert(size(b) == self%linear%n .and. self%tolerance > 0, &
                              'respond_to: a right side of its system')
      associate (linear => self%linear, grid => self%linear%levels(self%linear%finest)%equations%mesh%grid)
         if (self%is_real) then
            call respond_really(self, levels, real(b, dp), response)
            return
         end if
         allocate (x(linear%n), response%p(0:grid%nx, 0:grid%ny), response%h(0:grid%nx, 0:grid%ny))
         call linear%borrow(levels)
         call self%gmres%solve(linear, b, x, self%tolerance)
         response%linear_steps = self%gmres%steps
         response%reduction = self%gmres%reduction
         if (self%gmres%steps == 0) then
            response%status = status_not_finite
         else if (self%gmres%reduction <= self%tolerance) then
            response%status = status_converged
         end if
         q(0:grid%nx, 0:grid%ny) => x(:linear%n - 1)
         response%p = q
         response%pressure = at_centre(grid, response%p)
         response%approach = x(linear%n)
         call linear%film_change(response%p, response%approach, response%h)
         call linear%release()
         response%film = at_centre(grid, response%h)
      end associate
   end subroutine respond_to

   !> Response of a real right side that does not turn.
   subroutine respond_really(self, levels, b, response)
      class(harmonic_solver_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)
      real(dp), intent(in), contiguous :: b(:)
      type(harmonic_response_t), intent(inout) :: response
      type(tangent_change_t) :: change

      call self%tangent%solve(levels, b, self%tolerance, change)
      response%status = change%status
      response%linear_steps = change%linear_steps
      response%reduction = change%reduction
      response%p = change%state%p
      response%h = change%state%h
      response%approach = change%state%delta
      associate (grid => levels(size(levels))%problem%grid)
         response%film = at_centre(grid, response%h)
         response%pressure = at_centre(grid, response%p)
      end associate
   end subroutine respond_really

   !> Value of a complex field at X = Y = 0.
   pure complex(dp) function at_centre(grid, field)
      type(grid_t), intent(in) :: grid
      complex(dp), intent(in) :: field(0:, 0:)
      at_centre = cmplx(grid%value_at_centre(real(field, dp)), grid%value_at_centre(aimag(field)), dp)
   end function at_centre

end module ehlwave_harmonic_response
