!> The equations of a march at the samples of one period, and their linear system: values of earlier times are those of the same
!> period, by trigonometric interpolation, so that what solves them is what the march comes to.
module ehlwave_periodic_system
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_deformation, only: deformation_t
   use ehlwave_equations, only: equations_t
   use ehlwave_grid, only: grid_t
   use ehlwave_harmonic_response, only: harmonic_solver_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: equation_of_motion, force_balance, harmonic_inertia, load_balance_t
   use ehlwave_phase_samples, only: phase_samples_t
   use ehlwave_cycle_settings, only: newton_cycle
   use ehlwave_real_gmres, only: linear_system_t
   use ehlwave_real_linearised_contact, only: linearised_contact_t, set_wedge
   use ehlwave_real_wedge, only: wedge_t
   use ehlwave_reynolds, only: reynolds_change
   use ehlwave_state, only: state_t
   use ehlwave_steady_tangent, only: steady_tangent_t
   use ehlwave_transport, only: characteristic_transport, implicit_part, transport_t
   use ehlwave_work_unit, only: evaluation_operations, weights => real_weights
   implicit none (type, external)
   private

   !> One of the samples.
   type, public :: sample_t
      type(equations_t) :: equations               !! evaluated at its state
      real(dp), allocatable :: row_scale(:, :)     !! weight of each Reynolds row, 0 off the unknown nodes
      type(linearised_contact_t) :: linear         !! on this grid alone, for its factors
      type(transport_t) :: change                  !! what a change of the period changes in the carried terms
      type(load_balance_t) :: load_change          !! and in those of the load balance
   end type sample_t

   !> Unknowns: of one sample after the other the change of P at all nodes, then that of Delta. Rows are those of Newton's method
   !> in a time step. The preconditioner answers each frequency by itself, with the multigrid cycles of the linear response and of
   !> the steady state about the smooth contact, then what they leave by factors of each sample (`factorise`). A node that is
   !> cavitated in the smooth contact or in the sample, but not in both, has the residual that its diagonal makes of the
   !> pressure, or the reverse.
   type, extends(linear_system_t), public :: periodic_system_t
      integer :: n = 0, n_one = 0                        !! unknowns, and those of one sample
      type(phase_samples_t) :: phases
      type(sample_t), allocatable :: samples(:)
      type(steady_tangent_t) :: mean                     !! operator of what does not change in time
      type(harmonic_solver_t), allocatable :: waves(:)   !! (harmonics) operators of their frequencies
      real(dp), allocatable, private :: delay(:, :, :)   ! (sample, of sample, n) weights of the values n time steps before
      type(wedge_t), private :: wedge                    ! wedge and squeeze at the present time
      class(deformation_t), pointer, private :: deformation => null()   ! borrowed for the length of a solve
      real(dp), allocatable, private :: still(:, :)      ! (n_one, sample) share of the factors of a sample, see `factorise`
      real(dp), allocatable, private :: rest(:), local(:)
      real(dp), allocatable, private :: field(:, :, :), film(:, :, :)   ! (0:nx, 0:ny, sample)
   contains
      procedure :: init
      procedure :: borrow
      procedure :: release
      procedure :: evaluate
      procedure :: right_side
      procedure :: multiply
      procedure :: precondition
      procedure :: factorise
   end type periodic_system_t

   real(dp), parameter :: spread_weight = 300   !! measured: fewest GMRES steps between 30 and 300, 3 takes a third more
   integer, parameter :: delay_operations = 4   !! a node, for each sample and earlier time that is interpolated

contains

   !> Equations of waves of one frequency about the steady state of the finest of `levels`, of smooth surfaces.
   subroutine init(self, levels, phases, frequency, natural_frequency, steps_per_cell)
      class(periodic_system_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)
      type(phase_samples_t), intent(in) :: phases
      real(dp), intent(in) :: frequency              !! w in units of 1/T
      real(dp), intent(in) :: natural_frequency      !! Omega of the equation of motion; 0: force balance
      integer, intent(in) :: steps_per_cell          !! m for dT = hX/m
      complex(dp) :: inertia
      real(dp) :: dt
      integer :: k, m, n

      self%phases = phases
      allocate (self%samples(phases%n), self%waves(phases%harmonics))
      associate (problem => levels(size(levels))%problem, grid => levels(size(levels))%problem%grid)
         dt = grid%hx/steps_per_cell
         self%n_one = (grid%nx + 1)*(grid%ny + 1) + 1
         self%n = phases%n*self%n_one
         allocate (self%field(0:grid%nx, 0:grid%ny, phases%n), self%film(0:grid%nx, 0:grid%ny, phases%n))
         allocate (self%still(self%n_one, phases%n), source=0.0_dp)
         allocate (self%rest(self%n), self%local(self%n_one))
         do k = 1, phases%n
            associate (sample => self%samples(k))
               call sample%equations%init(problem)
               sample%change = characteristic_transport(grid, 1, steps_per_cell)
               sample%load_change = force_balance(1.0_dp)
               if (natural_frequency > 0) sample%load_change = equation_of_motion(1.0_dp, natural_frequency, dt)
               sample%equations%given%transport = sample%change
               sample%equations%given%load = sample%load_change
               sample%load_change%force = 0
               allocate (sample%row_scale(0:grid%nx, 0:grid%ny))
               call sample%linear%init(levels(size(levels):), newton_cycle)
               call sample%linear%start(1)
               sample%linear%levels(1)%equations%given%transport = sample%change
               call set_wedge(sample%linear)
            end associate
         end do
         associate (transport => self%samples(1)%change)
            self%wedge = implicit_part(transport, grid)
            allocate (self%delay(phases%n, phases%n, transport%history_length()))
         end associate
         do n = 1, size(self%delay, 3)
            self%delay(:, :, n) = phases%delayed(n*frequency*dt)
         end do
         call self%mean%init(levels)
         do m = 1, phases%harmonics
            call self%waves(m)%init(levels)
         end do
         call self%borrow(levels)
         call self%mean%linear%factorise(1)
         do m = 1, phases%harmonics
            inertia = 0
            if (natural_frequency > 0) inertia = harmonic_inertia(natural_frequency, dt, m*frequency)
            call self%waves(m)%set_frequency(m*frequency, inertia)
            call self%waves(m)%linear%factorise(1)
         end do
      end associate
      call self%release()
   end subroutine init

   !> Factors of each sample at the state last evaluated. They answer what the frequencies leave, where Poiseuille flow spreads a change
   !> rather than the film carries it along, in the sample or in the smooth contact: 1 - 1/(1 + weight eps/(hX K0)), K0 the deformation
   !> under a cell of unit pressure. The steep end of the pressure moves with the waves: there the smooth contact knows nothing of
   !> the viscosity.
   subroutine factorise(self)
      class(periodic_system_t), intent(inout) :: self
      real(dp), allocatable :: spread(:, :)
      integer :: k

      associate (smooth => self%mean%linear%levels(self%mean%linear%finest)%equations)
         do k = 1, self%phases%n
            associate (sample => self%samples(k), level => self%samples(k)%linear%levels(1))
               level%equations%flow = sample%equations%flow
               level%equations%is_cavitated = sample%equations%is_cavitated
               level%equations%scale = sample%equations%scale
               level%row_scale = sample%row_scale
               call sample%linear%make_near()
               spread = spread_weight*max(level%equations%flow%mobility(), smooth%flow%mobility())/ &
                        (smooth%mesh%grid%hx*smooth%self_influence)
               self%still(:self%n_one - 1, k) = reshape(spread/(1 + spread), [self%n_one - 1])
            end associate
         end do
      end associate
   end subroutine factorise

   !> Use the deformation of the levels of `init`, which must stay until `release`.
   subroutine borrow(self, levels)
      class(periodic_system_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)
      integer :: m
      self%deformation => levels(size(levels))%problem%deformation
      call self%mean%linear%borrow(levels)
      do m = 1, size(self%samples)
         call self%samples(m)%linear%borrow(levels(size(levels):))
      end do
      do m = 1, size(self%waves)
         call self%waves(m)%linear%borrow(levels)
      end do
   end subroutine borrow

   !> Give it back.
   subroutine release(self)
      class(periodic_system_t), intent(inout) :: self
      integer :: m
      nullify (self%deformation)
      call self%mean%linear%release()
      do m = 1, size(self%waves)
         call self%waves(m)%linear%release()
      end do
   end subroutine release

   !> Evaluate the equations of all samples at their states, whose films belong to their pressures.
   subroutine evaluate(self, problem, states)
      class(periodic_system_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: states(:)
      integer :: j, k

      do k = 1, self%phases%n
         self%field(:, :, k) = problem%rheology%density(states(k)%p)*states(k)%h
      end do
      do k = 1, self%phases%n
         associate (sample => self%samples(k), equations => self%samples(k)%equations)
            do j = 0, problem%grid%ny
               call equations%given%transport%carry_row(problem%grid, j, earlier(self, self%field(:, j, :), k))
            end do
            call equations%given%load%carry(earlier_approach(self, [(states(j)%delta, j=1, self%phases%n)], k))
            call equations%evaluate(problem, states(k))
            sample%row_scale = sqrt(sqrt(equations%scale))
         end associate
      end do
      call count_work(self, evaluation_operations + delay_operations*size(self%delay, 3)*self%phases%n)
   end subroutine evaluate

   !> Values of earlier times on one row, from those of all samples there.
   pure function earlier(self, row, k) result(history)
      type(periodic_system_t), intent(in) :: self
      real(dp), intent(in) :: row(0:, :)               !! (0:nx, sample)
      integer, intent(in) :: k                         !! sample whose past is wanted
      real(dp) :: history(0:ubound(row, 1), size(self%delay, 3))
      integer :: i, j, n
      history = 0
      do n = 1, size(history, 2)
         do j = 1, size(row, 2)
            do i = 0, ubound(row, 1)
               history(i, n) = history(i, n) + self%delay(k, j, n)*row(i, j)
            end do
         end do
      end do
   end function earlier

   !> Delta of the three time steps before; with force balance nobody asks for them.
   pure function earlier_approach(self, approach, k) result(history)
      type(periodic_system_t), intent(in) :: self
      real(dp), intent(in) :: approach(:)              !! of all samples
      integer, intent(in) :: k
      real(dp) :: history(3)
      integer :: n
      history = approach(k)
      do n = 1, min(3, size(self%delay, 3))
         history(n) = sum(self%delay(k, :, n)*approach)
      end do
   end function earlier_approach

   !> Right side of Newton's method at the states last evaluated.
   subroutine right_side(self, states, b)
      class(periodic_system_t), intent(in) :: self
      type(state_t), intent(in) :: states(:)
      real(dp), intent(out), contiguous, target :: b(:)   !! (n)
      real(dp), pointer, contiguous :: r(:, :)
      integer :: e, k

      do k = 1, self%phases%n
         associate (sample => self%samples(k), equations => self%samples(k)%equations, grid => self%samples(k)%equations%mesh%grid)
            r(0:grid%nx, 0:grid%ny) => b((k - 1)*self%n_one + 1:k*self%n_one - 1)
            r = merge(-states(k)%p, -sample%row_scale*equations%residual, equations%is_cavitated)
            do e = 1, equations%edges%count()
               r(equations%edges%i(e), equations%edges%j(e)) = -equations%edge_excess(e)
            end do
            b(k*self%n_one) = -equations%load_residual(states(k))
         end associate
      end do
   end subroutine right_side

   !> y = A x: linearised equations of all samples at their own states.
   subroutine multiply(self, x, y)
      class(periodic_system_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      real(dp), pointer, contiguous :: dr(:, :), q(:, :)
      real(dp) :: approach(self%phases%n)
      integer :: e, j, k

      approach = x(self%n_one::self%n_one)
      do k = 1, self%phases%n
         associate (grid => self%samples(k)%equations%mesh%grid, flow => self%samples(k)%equations%flow)
            q(0:grid%nx, 0:grid%ny) => x((k - 1)*self%n_one + 1:k*self%n_one - 1)
            call self%deformation%apply(q, self%film(:, :, k))
            self%film(:, :, k) = self%film(:, :, k) - approach(k)
            self%field(:, :, k) = flow%f_p*q + flow%rho*self%film(:, :, k)
         end associate
      end do
      do k = 1, self%phases%n
         associate (sample => self%samples(k), equations => self%samples(k)%equations, grid => self%samples(k)%equations%mesh%grid)
            q(0:grid%nx, 0:grid%ny) => x((k - 1)*self%n_one + 1:k*self%n_one - 1)
            dr(0:grid%nx, 0:grid%ny) => y((k - 1)*self%n_one + 1:k*self%n_one - 1)
            call reynolds_change(equations%mesh, self%wedge, equations%flow, q, self%film(:, :, k), dr)
            do j = 0, grid%ny
               call sample%change%carry_row(grid, j, earlier(self, self%field(:, j, :), k))
            end do
            dr = merge(q, sample%row_scale*(dr - sample%change%carried), equations%is_cavitated)
            do e = 1, equations%edges%count()
               associate (at => [equations%edges%i(e), equations%edges%j(e)])
                  dr(at(1), at(2)) = q(at(1), at(2)) + equations%edge_slope(e)*self%film(at(1), at(2), k)
               end associate
            end do
            call sample%load_change%carry(earlier_approach(self, approach, k))
            y(k*self%n_one) = sample%load_change%residual(grid%integral(q), approach(k))
         end associate
      end do
      call count_work(self, weights%product + delay_operations*size(self%delay, 3)*self%phases%n)
   end subroutine multiply

   !> y = M^(-1) x, frequency by frequency.
   subroutine precondition(self, x, y)
      class(periodic_system_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      real(dp), pointer, contiguous :: of(:, :)
      complex(dp), allocatable, target :: b(:), z(:)
      real(dp), allocatable, target :: b0(:), to(:, :), z0(:)
      integer :: k, m

      of(1:self%n_one, 1:self%phases%n) => y
      call plain_residuals(self, x, y)
      allocate (b(self%n_one), z(self%n_one), z0(self%n_one))
      ! the mean
      b0 = sum(of, 2)/self%phases%n
      associate (linear => self%mean%linear, level => self%mean%linear%levels(self%mean%linear%finest))
         b0(:self%n_one - 1) = b0(:self%n_one - 1)*reshape(wave_rows(level%row_scale, level%equations), [self%n_one - 1])
         call linear%precondition(b0, z0)
      end associate
      to = spread(z0, 2, self%phases%n)
      do m = 1, self%phases%harmonics
         b = 0
         do k = 1, self%phases%n
            b = b + (2*conjg(self%phases%factor(k, m))/self%phases%n)*of(:, k)
         end do
         associate (linear => self%waves(m)%linear, level => self%waves(m)%linear%levels(self%waves(m)%linear%finest))
            b(:self%n_one - 1) = b(:self%n_one - 1)*reshape(wave_rows(level%row_scale, level%equations), [self%n_one - 1])
            call linear%precondition(b, z)
         end associate
         do k = 1, self%phases%n
            to(:, k) = to(:, k) + real(z*self%phases%factor(k, m), dp)
         end do
      end do
      of = to
      do k = 1, self%phases%n
         associate (equations => self%samples(k)%equations, first => (k - 1)*self%n_one, n => self%n_one - 1)
            where (reshape(equations%is_cavitated, [n])) y(first + 1:first + n) = x(first + 1:first + n)
         end associate
      end do
      call count_work(self, delay_operations*self%phases%n)
      call self%multiply(y, self%rest)
      self%rest = x - self%rest
      do k = 1, self%phases%n
         associate (part => self%rest((k - 1)*self%n_one + 1:k*self%n_one))
            part = part*self%still(:, k)
            call self%samples(k)%linear%answer_near(part, self%local)
            y((k - 1)*self%n_one + 1:k*self%n_one) = y((k - 1)*self%n_one + 1:k*self%n_one) + self%still(:, k)*self%local
         end associate
      end do
   end subroutine precondition

   !> Factors of the rows of the smooth contact at one frequency: their weights, 1 where a row is not one of Reynolds' equation.
   pure function wave_rows(row_scale, equations) result(rows)
      real(dp), intent(in) :: row_scale(0:, 0:)
      type(equations_t), intent(in) :: equations
      real(dp), allocatable :: rows(:, :)
      rows = merge(row_scale, 1.0_dp, row_scale > 0 .and. .not. equations%is_cavitated)
   end function wave_rows

   !> Residuals without weights, as the rows of the smooth contact take them.
   subroutine plain_residuals(self, x, y)
      class(periodic_system_t), intent(in) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      real(dp), pointer, contiguous :: r(:, :), plain(:, :)
      integer :: i, j, k

      associate (smooth => self%mean%linear%levels(self%mean%linear%finest)%equations)
         do k = 1, self%phases%n
            associate (sample => self%samples(k), equations => self%samples(k)%equations, &
                       grid => self%samples(k)%equations%mesh%grid)
               r(0:grid%nx, 0:grid%ny) => x((k - 1)*self%n_one + 1:k*self%n_one - 1)
               plain(0:grid%nx, 0:grid%ny) => y((k - 1)*self%n_one + 1:k*self%n_one - 1)
               plain = r
               y(k*self%n_one) = x(k*self%n_one)
               do j = 0, grid%ny
                  do i = 0, grid%nx
                     if (.not. sample%row_scale(i, j) > 0) cycle
                     if (equations%is_cavitated(i, j)) then
                        if (.not. smooth%is_cavitated(i, j)) plain(i, j) = -r(i, j)/equations%scale(i, j)
                     else
                        plain(i, j) = r(i, j)/sample%row_scale(i, j)
                        if (smooth%is_cavitated(i, j)) plain(i, j) = -equations%scale(i, j)*plain(i, j)
                     end if
                  end do
               end do
            end associate
         end do
      end associate
   end subroutine plain_residuals

   !> Add so many operations for each node of each sample.
   subroutine count_work(self, operations)
      type(periodic_system_t), intent(inout) :: self
      integer, intent(in) :: operations
      if (associated(self%deformation)) self%deformation%work = self%deformation%work + real(operations, dp)*self%n
   end subroutine count_work

end module ehlwave_periodic_system
