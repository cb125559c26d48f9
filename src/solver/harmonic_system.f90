!> The linear system of the response to a small wave, its FFT products and its multigrid preconditioner.
module ehlwave_harmonic_system
   use ehlwave_complex_band, only: complex_band_t, new_complex_band
   use ehlwave_complex_gmres, only: complex_system_t
   use ehlwave_complex_ilu, only: complex_ilu_t, new_complex_ilu
   use ehlwave_complex_transfer, only: interpolate_complex, prolong_complex, restrict_complex
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_harmonic_operator, only: harmonic_jacobian, harmonic_scale, harmonic_transport, harmonic_transport_t
   use ehlwave_harmonic_stencil, only: harmonic_stencil_t, new_harmonic_stencil
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_reynolds, only: diagonal_scale, flow_t, new_flow, reynolds_residual
   use ehlwave_state, only: state_t
   use ehlwave_transfer, only: inject
   use ehlwave_transport, only: steady_transport
   implicit none (type, external)
   private

   !> Unknowns: amplitude of the change of P at all nodes (0 on the boundary), then that of Delta; one vector of
   !> length n = (nx+1)(ny+1) + 1. Rows are weighted by |A_ii|^(-1/4), as in Newton's system. A node that is
   !> cavitated in the steady state keeps P = 0.
   type, extends(complex_system_t), public :: harmonic_system_t
      integer :: n = 0
      type(contact_problem_t), pointer :: problem => null()  !! grid, deformation, conditions
      type(harmonic_system_t), pointer :: coarser => null()  !! system of the next coarser grid, if there is one
      type(flow_t) :: flow                               !! coefficients at the steady state
      real(dp), allocatable :: p(:, :)                   !! its pressure
      logical, allocatable :: is_cavitated(:, :)
      type(harmonic_transport_t) :: transport            !! wedge and squeeze at the present frequency
      real(dp), allocatable :: row_scale(:, :)           !! weight of each row, 0 off the unknown nodes
      real(dp), allocatable, private :: filter(:, :)     ! of line contacts: see remove_smooth_part
      complex(dp), private :: inertia = 0                ! weight of Delta in the load row
      type(harmonic_stencil_t), private :: stencil
      type(complex_ilu_t), private :: ilu                ! of elliptical contacts,
      type(complex_band_t), private :: band              ! of line contacts
      real(dp), allocatable, private :: part(:, :), part_film(:, :)
      complex(dp), allocatable, private :: dh(:, :), change(:, :), work(:, :), packed(:, :)
      complex(dp), allocatable, private :: guess(:), rhs(:) ! of a cycle
      complex(dp), allocatable, private :: column(:)     ! M^(-1) of the Delta column
      complex(dp), private :: schur = 1                  ! load row after elimination of P
   contains
      procedure :: init
      procedure :: linearise
      procedure :: set_frequency
      procedure :: film_change
      procedure :: gap_change
      procedure :: multiply
      procedure :: precondition
   end type harmonic_system_t

   integer, parameter :: largest_reach = 8   !! cells of the near stencil, keeps memory bounded
   real(dp), parameter :: largest_filter = 0.8_dp
   real(dp), parameter :: diagonal_shift(4) = [0.0_dp, 0.1_dp, 0.3_dp, 1.0_dp]   !! of the incomplete factors, tried in turn

contains

   !> Work space for a problem's grid.
   subroutine init(self, problem)
      class(harmonic_system_t), intent(inout) :: self
      type(contact_problem_t), intent(in), target :: problem
      complex(dp), parameter :: zero = (0.0_dp, 0.0_dp)
      integer :: rows

      self%problem => problem
      associate (nx => problem%grid%nx, ny => problem%grid%ny, elliptic => problem%conditions%elliptic)
         self%n = (nx + 1)*(ny + 1) + 1
         self%stencil = new_harmonic_stencil(problem%grid, elliptic%kappa, elliptic%k, largest_reach)
         rows = ny - problem%grid%first_row
         if (problem%grid%is_line) then
            self%band = new_complex_band(nx - 1, self%stencil%reach_x)
         else
            self%ilu = new_complex_ilu(rows, nx - 1, self%stencil%reach_y, self%stencil%reach_x)
         end if
         self%flow = new_flow(problem%grid)
         allocate (self%p(0:nx, 0:ny), self%row_scale(0:nx, 0:ny), self%part(0:nx, 0:ny), self%part_film(0:nx, 0:ny), &
                   source=0.0_dp)
         allocate (self%dh(0:nx, 0:ny), self%change(0:nx, 0:ny), self%work(0:nx, 0:ny), self%packed(rows, nx - 1), &
                   source=zero)
         allocate (self%is_cavitated(0:nx, 0:ny), source=.false.)
         allocate (self%guess(self%n), self%rhs(self%n), self%column(self%n), source=zero)
      end associate
   end subroutine init

   !> Linearise about a steady state of smooth surfaces; coarser systems take their coefficients from this one.
   subroutine linearise(self, state)
      class(harmonic_system_t), intent(inout), target :: self
      type(state_t), intent(in) :: state
      class(harmonic_system_t), pointer :: fine

      associate (grid => self%problem%grid, problem => self%problem, kappa => self%problem%conditions%elliptic%kappa)
         self%p = state%p
         call problem%film(state%p, state%delta, self%part_film)
         call self%flow%evaluate(problem%rheology, problem%conditions%lambdabar, self%p, self%part_film)
         call reynolds_residual(grid, steady_transport(grid), kappa, self%flow, self%p, self%part)
         call diagonal_scale(grid, steady_transport(grid), kappa, self%stencil%self_influence, self%flow, self%part_film)
         self%is_cavitated = self%part_film > 0 .and. self%p + self%part_film*self%part <= 0
      end associate
      fine => self
      do while (associated(fine%coarser))
         associate (coarse => fine%coarser)
            call inject(coarse%problem%grid, fine%p, coarse%p)
            call coarse%flow%inject_from(fine%flow, coarse%problem%grid)
            coarse%is_cavitated = fine%is_cavitated(::2, ::coarse%problem%grid%row_ratio)
         end associate
         fine => fine%coarser
      end do
   end subroutine linearise

   !> Operator and preconditioner for one frequency.
   subroutine set_frequency(self, frequency, dt, inertia)
      class(harmonic_system_t), intent(inout), target :: self
      real(dp), intent(in) :: frequency       !! w in units of 1/T
      real(dp), intent(in) :: dt              !! step along the characteristic: hX of the finest grid
      complex(dp), intent(in) :: inertia      !! weight of Delta in the load row, 0: force balance
      class(harmonic_system_t), pointer :: system

      system => self
      do
         system%inertia = inertia
         call factorise(system, frequency, dt)
         if (.not. associated(system%coarser)) exit
         system => system%coarser
      end do

      ! Delta column: J (0, 1), then its image under M^(-1), and the Schur complement of the load row
      self%rhs = 0
      self%rhs(self%n) = 1
      call self%multiply(self%rhs, self%column)
      self%column(self%n) = 0
      call cycle_pressure(self, self%column)
      self%schur = inertia - load_change(self, self%column)
      if (.not. abs(self%schur) > 0) self%schur = 1
   end subroutine set_frequency

   !> Transport, row weights and incomplete factors, in flow order, of local terms and near deformation. Where the factors
   !> blow up (waves of few points across a slender contact), the diagonal is shifted (Manteuffel 1980) until they do not.
   subroutine factorise(self, frequency, dt)
      class(harmonic_system_t), intent(inout) :: self
      real(dp), intent(in) :: frequency, dt
      integer :: attempt

      associate (grid => self%problem%grid, kappa => self%problem%conditions%elliptic%kappa)
         self%transport = harmonic_transport(grid, frequency, dt)
         call harmonic_scale(grid, self%transport, kappa, self%stencil%self_influence, self%flow, self%row_scale)
         if (grid%is_line) call set_filter(self)
         self%row_scale = sqrt(sqrt(self%row_scale))
      end associate
      if (self%problem%grid%is_line) then
         call fill_matrix(self, 0.0_dp)
         call self%band%factorise()
         return
      end if
      do attempt = 1, size(diagonal_shift)
         call fill_matrix(self, diagonal_shift(attempt))
         call self%ilu%factorise()
         if (self%ilu%is_bounded()) exit
      end do
   end subroutine factorise

   !> Weighted local terms and near deformation, for the factors to take their place. The diagonal gets `shift` of itself
   !> besides; a cavitated node has the row of the identity.
   subroutine fill_matrix(self, shift)
      class(harmonic_system_t), intent(inout) :: self
      real(dp), intent(in) :: shift
      complex(dp), allocatable :: rows(:, :)
      integer :: diagonal, i, j, k, row

      diagonal = (2*self%stencil%reach_x + 1)*(2*self%stencil%reach_y + 1)/2 + 1
      allocate (rows(size(self%packed, 1), 2*diagonal - 1))
      associate (grid => self%problem%grid, kappa => self%problem%conditions%elliptic%kappa)
         do i = 1, grid%nx - 1
            call self%stencil%fill_lines(grid, self%transport, kappa, self%flow, self%p, i, rows)
            do k = 1, size(rows, 2)
               do j = 1, size(rows, 1)
                  row = j - 1 + grid%first_row
                  rows(j, k) = rows(j, k)*self%row_scale(i, row)
                  if (self%is_cavitated(i, row)) rows(j, k) = merge(1, 0, k == diagonal)
               end do
            end do
            rows(:, diagonal) = (1 + shift)*rows(:, diagonal)
            if (grid%is_line) then
               self%band%a(:, i) = rows(1, :)
            else
               call self%ilu%set_line(i, rows)
            end if
         end do
      end associate
   end subroutine fill_matrix

   !> Change of the film: deformation under q minus the approach, real and imaginary part one after the other. A
   !> field without imaginary part (w = 0) costs one convolution, any other two.
   subroutine film_change(self, q, delta, dh)
      class(harmonic_system_t), intent(inout) :: self
      complex(dp), intent(in) :: q(0:, 0:)       !! change of P, (0:nx, 0:ny)
      complex(dp), intent(in) :: delta           !! change of Delta
      complex(dp), intent(out) :: dh(0:, 0:)     !! change of H, (0:nx, 0:ny)
      self%part = real(q, dp)
      call self%problem%deformation%apply(self%part, self%part_film)
      dh = self%part_film - delta
      self%part = aimag(q)
      if (.not. any(abs(self%part) > 0)) return
      call self%problem%deformation%apply(self%part, self%part_film)
      dh = dh + cmplx(0, self%part_film, dp)
   end subroutine film_change

   !> Right side for a pattern g added to the gap: minus the change of the weighted residuals.
   subroutine gap_change(self, g, b)
      class(harmonic_system_t), intent(inout) :: self
      complex(dp), intent(in) :: g(0:, 0:)                      !! (0:nx, 0:ny)
      complex(dp), intent(out), contiguous, target :: b(:)      !! (n)
      complex(dp), pointer, contiguous :: dr(:, :)

      associate (grid => self%problem%grid)
         dr(0:grid%nx, 0:grid%ny) => b(:self%n - 1)
         self%change = 0
         call change_residual(self, self%change, g, dr)
         dr = -dr
         b(self%n) = 0
      end associate
   end subroutine gap_change

   !> y = A x: film change by FFT, linearised Reynolds equation, load row.
   subroutine multiply(self, x, y)
      class(harmonic_system_t), intent(inout) :: self
      complex(dp), intent(in), contiguous, target :: x(:)
      complex(dp), intent(out), contiguous, target :: y(:)
      complex(dp), pointer, contiguous :: q(:, :), dr(:, :)

      associate (grid => self%problem%grid, n => self%n)
         q(0:grid%nx, 0:grid%ny) => x(:n - 1)
         dr(0:grid%nx, 0:grid%ny) => y(:n - 1)
         call self%film_change(q, x(n), self%dh)
         call change_residual(self, q, self%dh, dr)
         y(n) = load_change(self, x) + self%inertia*x(n)
      end associate
   end subroutine multiply

   !> Weighted change of the residuals for changes q of P and dh of H; q itself at cavitated nodes.
   subroutine change_residual(self, q, dh, dr)
      class(harmonic_system_t), intent(inout) :: self
      complex(dp), intent(in) :: q(0:, 0:), dh(0:, 0:)
      complex(dp), intent(out) :: dr(0:, 0:)
      integer :: i, j

      call harmonic_jacobian(self%problem%grid, self%transport, self%problem%conditions%elliptic%kappa, self%flow, &
                             self%p, q, dh, dr)
      do j = 0, self%problem%grid%ny
         do i = 0, self%problem%grid%nx
            dr(i, j) = merge(q(i, j), self%row_scale(i, j)*dr(i, j), self%is_cavitated(i, j))
         end do
      end do
   end subroutine change_residual

   !> y = M^(-1) x with the load row eliminated.
   subroutine precondition(self, x, y)
      class(harmonic_system_t), intent(inout) :: self
      complex(dp), intent(in), contiguous, target :: x(:)
      complex(dp), intent(out), contiguous, target :: y(:)
      complex(dp) :: change

      y = x
      call cycle_pressure(self, y)
      change = (x(self%n) - load_change(self, y))/self%schur
      y = y - change*self%column
      y(self%n) = change
   end subroutine precondition

   !> One multigrid cycle for the pressure part of v, in place: correction from the coarser grid, then the factors
   !> of this one on what is left. The film change that goes with a correction is interpolated from the coarser grid
   !> too, in place of a convolution on this one (measured: at most one GMRES step more, a fifth less time).
   recursive subroutine cycle_pressure(self, v)
      class(harmonic_system_t), intent(inout), target :: self
      complex(dp), intent(inout), contiguous, target :: v(:)   !! right side in weighted rows, then change of P
      complex(dp), pointer, contiguous :: field(:, :), fine(:, :), coarse_field(:, :)
      type(harmonic_system_t), pointer :: coarser

      coarser => self%coarser
      if (.not. associated(coarser)) then
         call solve_pressure(self, v)
         return
      end if
      associate (grid => self%problem%grid, coarse => coarser%problem%grid)
         field(0:grid%nx, 0:grid%ny) => v(:self%n - 1)
         fine(0:grid%nx, 0:grid%ny) => self%guess(:self%n - 1)
         coarse_field(0:coarse%nx, 0:coarse%ny) => coarser%rhs(:coarser%n - 1)
         self%work = 0
         where (self%row_scale > 0 .and. .not. self%is_cavitated) self%work = field/self%row_scale
         call restrict_complex(coarse, self%work, coarse_field)
         where (coarser%is_cavitated)
            coarse_field = 0
         elsewhere
            coarse_field = coarse_field*coarser%row_scale
         end where
         call cycle_pressure(coarser, coarser%rhs)
         call prolong_complex(coarse, coarse_field, fine)
         where (self%is_cavitated .or. .not. self%row_scale > 0) fine = 0
         call coarser%film_change(coarse_field, (0.0_dp, 0.0_dp), coarser%dh)
         call interpolate_complex(coarse, grid, coarser%dh, self%dh)
         call change_residual(self, fine, self%dh, self%change)
         field = field - self%change
         if (grid%is_line) call remove_smooth_part(self, v)
         call solve_pressure(self, v)
         field = field + fine
      end associate
   end subroutine cycle_pressure

   !> Filter of a line contact, from the scale 1/|A_ii| in `row_scale`.
   subroutine set_filter(self)
      class(harmonic_system_t), intent(inout) :: self
      integer :: i, j
      if (.not. allocated(self%filter)) allocate (self%filter, mold=self%row_scale)
      do j = 0, self%problem%grid%ny
         do i = 0, self%problem%grid%nx
            self%filter(i, j) = largest_filter*sqrt(self%row_scale(i, j)*abs(self%transport%w0(i))*self%flow%f_h(i, j) &
                                                    *self%stencil%self_influence)
         end do
      end do
   end subroutine set_filter

   !> Take from a residual most of what the coarser grid can represent, as Newton's system does and for the same reason.
   !> The pressure of a line acts over longer distances than that of a cell. Measured (M = 100, L = 11, 8192 cells): 16
   !> and 18 GMRES steps for waves of 2 a and a/4, without this 31 and 33; elliptical contacts do without.
   subroutine remove_smooth_part(self, v)
      class(harmonic_system_t), intent(inout), target :: self
      complex(dp), intent(inout), contiguous, target :: v(:)
      complex(dp), pointer, contiguous :: field(:, :), coarse_field(:, :)

      associate (grid => self%problem%grid, coarse => self%coarser%problem%grid)
         field(0:grid%nx, 0:grid%ny) => v(:self%n - 1)
         coarse_field(0:coarse%nx, 0:coarse%ny) => self%coarser%guess(:self%coarser%n - 1)
         call restrict_complex(coarse, field, coarse_field)
         call prolong_complex(coarse, coarse_field, self%work)
         where (.not. self%is_cavitated) field = field - self%filter*self%work
      end associate
   end subroutine remove_smooth_part

   !> Pressure part of v solved in place with the factors; the last entry of v becomes zero.
   subroutine solve_pressure(self, v)
      class(harmonic_system_t), intent(inout) :: self
      complex(dp), intent(inout), contiguous, target :: v(:)
      complex(dp), pointer, contiguous :: field(:, :)

      associate (grid => self%problem%grid, low => self%problem%grid%first_row)
         field(0:grid%nx, 0:grid%ny) => v(:self%n - 1)
         self%packed = transpose(field(1:grid%nx - 1, low:grid%ny - 1))
         if (grid%is_line) then
            call self%band%solve(self%packed(1, :))
         else
            call self%ilu%solve(self%packed)
         end if
         v = 0
         field(1:grid%nx - 1, low:grid%ny - 1) = transpose(self%packed)
      end associate
   end subroutine solve_pressure

   !> (3/(2 pi)) int of the pressure part of v.
   complex(dp) function load_change(self, v)
      class(harmonic_system_t), intent(in) :: self
      complex(dp), intent(in), contiguous, target :: v(:)
      complex(dp), pointer, contiguous :: field(:, :)
      integer :: j
      associate (grid => self%problem%grid)
         field(0:grid%nx, 0:grid%ny) => v(:self%n - 1)
         load_change = 0
         do j = 0, grid%ny
            load_change = load_change + grid%weight(j)*sum(field(:, j))
         end do
         load_change = load_factor*grid%hx*grid%hy*load_change
      end associate
   end function load_change

end module ehlwave_harmonic_system
