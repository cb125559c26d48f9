!> The linear system of the response to a small wave, its FFT products and its multigrid preconditioner.
module ehlwave_harmonic_system
   use ehlwave_complex_gmres, only: complex_system_t
   use ehlwave_complex_ilu, only: complex_ilu_t, new_complex_ilu
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_grid, only: grid_t
   use ehlwave_harmonic_operator, only: harmonic_jacobian, harmonic_lines, harmonic_scale, harmonic_transport, &
      harmonic_transport_t
   use ehlwave_kernel, only: cell_influence
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
      type(contact_problem_t), pointer :: problem => null()
      type(harmonic_system_t), pointer :: coarser => null()  !! system of the next coarser grid, if there is one
      type(harmonic_transport_t) :: transport
      type(flow_t) :: flow                               !! coefficients at the steady state
      real(dp), allocatable :: p(:, :)                   !! its pressure
      real(dp), allocatable :: row_scale(:, :)           !! weight of each row, 0 off the unknown nodes
      logical, allocatable :: is_cavitated(:, :)
      complex(dp) :: inertia = 0                         !! weight of Delta in the load row
      real(dp), allocatable, private :: influence(:, :)  ! of a cell at an offset
      type(complex_ilu_t), private :: ilu
      integer, private :: reach_x = 2, reach_y = 1
      real(dp), allocatable, private :: part(:, :), part_film(:, :)
      complex(dp), allocatable, private :: dh(:, :), work(:, :), packed(:, :)
      complex(dp), allocatable, private :: guess(:), defect(:), rhs(:) ! of a cycle
      complex(dp), allocatable, private :: column(:)     ! M^(-1) of the Delta column
      complex(dp), private :: schur = 1                  ! load row after elimination of P
      logical :: is_coarse = .false.                     !! serves as preconditioner of a finer system only
   contains
      procedure :: init
      procedure :: linearise
      procedure :: set_frequency
      procedure :: film_change
      procedure :: multiply
      procedure :: gap_change
      procedure :: precondition
   end type harmonic_system_t

   integer, parameter :: largest_reach = 8   !! cells of the near stencil, keeps memory bounded

contains

   !> Work space for a problem's grid.
   subroutine init(self, problem)
      class(harmonic_system_t), intent(inout) :: self
      type(contact_problem_t), intent(in), target :: problem
      real(dp) :: aspect
      integer :: i, j, rows

      self%problem => problem
      associate (grid => problem%grid, elliptic => problem%conditions%elliptic)
         self%n = (grid%nx + 1)*(grid%ny + 1) + 1
         aspect = grid%hy/(elliptic%kappa*grid%hx)       ! the pattern is isotropic in metres
         self%reach_x = max(2, min(largest_reach, nint(aspect)))
         self%reach_y = min(largest_reach, max(1, nint(1/aspect)))
         allocate (self%influence(-self%reach_x - 2:self%reach_x + 2, -self%reach_y - 1:self%reach_y + 1))
         do j = -self%reach_y - 1, self%reach_y + 1
            do i = -self%reach_x - 2, self%reach_x + 2
               self%influence(i, j) = cell_influence(i*grid%hx, j*grid%hy, grid%hx, grid%hy, elliptic%kappa, elliptic%k)
            end do
         end do
         rows = grid%ny - grid%first_row
         self%ilu = new_complex_ilu(rows, grid%nx - 1, self%reach_y, self%reach_x)
         self%flow = new_flow(grid)
         allocate (self%p(0:grid%nx, 0:grid%ny), self%row_scale(0:grid%nx, 0:grid%ny), &
                   self%part(0:grid%nx, 0:grid%ny), self%part_film(0:grid%nx, 0:grid%ny), source=0.0_dp)
         allocate (self%dh(0:grid%nx, 0:grid%ny), self%work(0:grid%nx, 0:grid%ny), &
                   self%packed(rows, grid%nx - 1), source=(0.0_dp, 0.0_dp))
         allocate (self%is_cavitated(0:grid%nx, 0:grid%ny), source=.false.)
         allocate (self%guess(self%n), self%defect(self%n), self%rhs(self%n), self%column(self%n), &
                   source=(0.0_dp, 0.0_dp))
      end associate
   end subroutine init

   !> Linearise about a steady state of smooth surfaces; coarser systems take their coefficients from this one.
   recursive subroutine linearise(self, state)
      class(harmonic_system_t), intent(inout) :: self
      type(state_t), intent(in) :: state
      real(dp), allocatable :: r(:, :), scale(:, :)
      type(harmonic_system_t), pointer :: coarse, fine

      associate (grid => self%problem%grid, problem => self%problem, kappa => self%problem%conditions%elliptic%kappa)
         allocate (r(0:grid%nx, 0:grid%ny), scale(0:grid%nx, 0:grid%ny))
         self%p = state%p
         call problem%film(state%p, state%delta, self%part_film)
         call self%flow%evaluate(problem%rheology, problem%conditions%lambdabar, self%p, self%part_film)
         call reynolds_residual(grid, steady_transport(grid), kappa, self%flow, self%p, r)
         call diagonal_scale(grid, steady_transport(grid), kappa, self%influence(0, 0), self%flow, scale)
         self%is_cavitated = scale > 0 .and. self%p + scale*r <= 0
      end associate
      if (.not. associated(self%coarser)) return
      call restrict_coefficients(self%p, self%flow, self%is_cavitated, self%coarser)
      coarse => self%coarser
      do while (associated(coarse%coarser))
         fine => coarse
         coarse => coarse%coarser
         call restrict_coefficients(fine%p, fine%flow, fine%is_cavitated, coarse)
      end do
   end subroutine linearise

   !> Coefficients, pressure and active set of a coarser grid by injection.
   subroutine restrict_coefficients(p, flow, is_cavitated, coarse)
      real(dp), intent(in) :: p(0:, 0:)
      type(flow_t), intent(in) :: flow
      logical, intent(in) :: is_cavitated(0:, 0:)
      type(harmonic_system_t), intent(inout) :: coarse
      coarse%is_coarse = .true.
      call inject(p, coarse%p)
      call inject(flow%f, coarse%flow%f)
      call inject(flow%eps, coarse%flow%eps)
      call inject(flow%f_p, coarse%flow%f_p)
      call inject(flow%f_h, coarse%flow%f_h)
      call inject(flow%eps_p, coarse%flow%eps_p)
      call inject(flow%eps_h, coarse%flow%eps_h)
      coarse%is_cavitated = is_cavitated(::2, ::2)
   end subroutine restrict_coefficients

   !> Operator and preconditioner for one frequency.
   recursive subroutine set_frequency(self, frequency, dt, inertia)
      class(harmonic_system_t), intent(inout), target :: self
      real(dp), intent(in) :: frequency       !! w in units of 1/T
      real(dp), intent(in) :: dt              !! time step: hX of the finest grid
      complex(dp), intent(in) :: inertia      !! weight of Delta in the load row, 0: force balance
      complex(dp), allocatable :: rows(:, :), unit(:)
      integer :: i, j

      self%inertia = inertia
      associate (grid => self%problem%grid, kappa => self%problem%conditions%elliptic%kappa)
         self%transport = harmonic_transport(grid, frequency, dt)
         call harmonic_scale(grid, self%transport, kappa, self%influence(0, 0), self%flow, self%row_scale)
         self%row_scale = sqrt(sqrt(self%row_scale))
         allocate (rows(size(self%packed, 1), self%ilu%entries))
         do i = 1, grid%nx - 1
            call harmonic_lines(grid, self%transport, kappa, self%flow, self%p, self%influence, i, rows)
            do j = grid%first_row, grid%ny - 1
               if (self%is_cavitated(i, j)) then
                  rows(j - grid%first_row + 1, :) = 0
                  rows(j - grid%first_row + 1, self%ilu%lower + 1) = 1
               else
                  rows(j - grid%first_row + 1, :) = self%row_scale(i, j)*rows(j - grid%first_row + 1, :)
               end if
            end do
            call self%ilu%set_line(i, rows)
         end do
      end associate
      call self%ilu%factorise()
      if (associated(self%coarser)) call self%coarser%set_frequency(frequency, dt, inertia)
      if (self%is_coarse) return

      ! Delta column: J (0, 1), then its image under M^(-1), and the Schur complement of the load row
      allocate (unit(self%n), source=(0.0_dp, 0.0_dp))
      unit(self%n) = 1
      call self%multiply(unit, self%column)
      self%column(self%n) = 0
      call cycle_pressure(self, self%column)
      self%schur = inertia - load_change(self, self%column)
      if (.not. abs(self%schur) > 0) self%schur = 1
   end subroutine set_frequency

   !> dh = deformation under q minus the approach: real and imaginary part one after the other.
   subroutine film_change(self, q, delta, dh)
      class(harmonic_system_t), intent(inout) :: self
      complex(dp), intent(in) :: q(0:, 0:)       !! (0:nx, 0:ny)
      complex(dp), intent(in) :: delta
      complex(dp), intent(out) :: dh(0:, 0:)     !! (0:nx, 0:ny)
      self%part = real(q, dp)
      call self%problem%deformation%apply(self%part, self%part_film)
      dh = self%part_film - delta
      self%part = aimag(q)
      call self%problem%deformation%apply(self%part, self%part_film)
      dh = dh + cmplx(0, self%part_film, dp)
   end subroutine film_change

   !> y = A x: film change by FFT, linearised Reynolds equation, load row.
   subroutine multiply(self, x, y)
      class(harmonic_system_t), intent(inout) :: self
      complex(dp), intent(in), contiguous, target :: x(:)
      complex(dp), intent(out), contiguous, target :: y(:)
      complex(dp), pointer, contiguous :: q(:, :), dr(:, :)
      integer :: i, j

      associate (grid => self%problem%grid, n => self%n)
         q(0:grid%nx, 0:grid%ny) => x(:n - 1)
         dr(0:grid%nx, 0:grid%ny) => y(:n - 1)
         call self%film_change(q, x(n), self%dh)
         call harmonic_jacobian(grid, self%transport, self%problem%conditions%elliptic%kappa, self%flow, &
                                self%p, q, self%dh, dr, self%work)
         do j = 0, grid%ny
            do i = 0, grid%nx
               dr(i, j) = merge(q(i, j), self%row_scale(i, j)*dr(i, j), self%is_cavitated(i, j))
            end do
         end do
         y(n) = load_change(self, x) + self%inertia*x(n)
      end associate
   end subroutine multiply

   !> Right side for a pattern g added to the gap: minus the change of the weighted residuals.
   subroutine gap_change(self, g, b)
      class(harmonic_system_t), intent(inout) :: self
      complex(dp), intent(in) :: g(0:, 0:)                            !! (0:nx, 0:ny)
      complex(dp), intent(out), contiguous, target :: b(:)            !! (n)
      complex(dp), pointer, contiguous :: dr(:, :)
      complex(dp), allocatable :: zero(:, :)

      associate (grid => self%problem%grid)
         allocate (zero(0:grid%nx, 0:grid%ny), source=(0.0_dp, 0.0_dp))
         dr(0:grid%nx, 0:grid%ny) => b(:self%n - 1)
         call harmonic_jacobian(grid, self%transport, self%problem%conditions%elliptic%kappa, self%flow, &
                                self%p, zero, g, dr, self%work)
         where (self%is_cavitated)
            dr = 0
         elsewhere
            dr = -self%row_scale*dr
         end where
         b(self%n) = 0
      end associate
   end subroutine gap_change

   !> y = M^(-1) x with the load row eliminated.
   subroutine precondition(self, x, y)
      class(harmonic_system_t), intent(inout) :: self
      complex(dp), intent(in), contiguous, target :: x(:)
      complex(dp), intent(out), contiguous, target :: y(:)
      complex(dp) :: change

      y = x
      call cycle_pressure(self, y)
      y(self%n) = 0
      change = (x(self%n) - load_change(self, y))/self%schur
      y = y - change*self%column
      y(self%n) = change
   end subroutine precondition

   !> One multigrid cycle for the pressure part of v, in place: correction from the coarser grid, then the factors
   !> of this one on what is left.
   recursive subroutine cycle_pressure(self, v)
      class(harmonic_system_t), intent(inout), target :: self
      complex(dp), intent(inout), contiguous, target :: v(:)   !! right side in weighted rows, then change of P
      complex(dp), pointer, contiguous :: field(:, :), fine(:, :), coarse_field(:, :)
      type(harmonic_system_t), pointer :: coarser

      if (.not. associated(self%coarser)) then
         call solve_pressure(self, v)
         return
      end if
      associate (grid => self%problem%grid, coarse => self%coarser%problem%grid, n => self%n)
         coarser => self%coarser
         field(0:grid%nx, 0:grid%ny) => v(:n - 1)
         fine(0:grid%nx, 0:grid%ny) => self%guess(:n - 1)
         self%work = 0
         where (self%row_scale > 0 .and. .not. self%is_cavitated) self%work = field/self%row_scale
         coarse_field(0:coarse%nx, 0:coarse%ny) => coarser%rhs(:coarser%n - 1)
         call restrict(coarse, self%work, coarse_field)
         where (coarser%is_cavitated)
            coarse_field = 0
         elsewhere
            coarse_field = coarse_field*coarser%row_scale
         end where
         coarser%rhs(coarser%n) = 0
         call cycle_pressure(coarser, coarser%rhs)
         call prolong(coarse, coarse_field, fine)
         where (self%is_cavitated .or. .not. self%row_scale > 0) fine = 0
         self%guess(n) = 0
         call self%multiply(self%guess, self%defect)
         v = v - self%defect
         call solve_pressure(self, v)
         v = v + self%guess
      end associate
   end subroutine cycle_pressure

   !> Pressure part of v solved in place with the factors.
   subroutine solve_pressure(self, v)
      class(harmonic_system_t), intent(inout) :: self
      complex(dp), intent(inout), contiguous, target :: v(:)
      complex(dp), pointer, contiguous :: field(:, :)
      integer :: low

      associate (grid => self%problem%grid)
         field(0:grid%nx, 0:grid%ny) => v(:self%n - 1)
         low = grid%first_row
         self%packed = transpose(field(1:grid%nx - 1, low:grid%ny - 1))
         call self%ilu%solve(self%packed)
         field = 0
         field(1:grid%nx - 1, low:grid%ny - 1) = transpose(self%packed)
         v(self%n) = 0
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

   !> As `restrict` of the transfers, for complex values.
   pure subroutine restrict(coarse, value_fine, value_coarse)
      type(grid_t), intent(in) :: coarse
      complex(dp), intent(in) :: value_fine(0:, 0:)
      complex(dp), intent(out) :: value_coarse(0:, 0:)
      complex(dp) :: row(0:2*coarse%nx)
      integer :: i, j
      value_coarse = 0
      do j = coarse%first_row, coarse%ny - 1
         row = 0.25_dp*(value_fine(:, abs(2*j - 1)) + 2*value_fine(:, 2*j) + value_fine(:, 2*j + 1))
         do i = 1, coarse%nx - 1
            value_coarse(i, j) = 0.25_dp*(row(2*i - 1) + 2*row(2*i) + row(2*i + 1))
         end do
      end do
   end subroutine restrict

   !> As `prolong` of the transfers, for complex values.
   pure subroutine prolong(coarse, value_coarse, value_fine)
      type(grid_t), intent(in) :: coarse
      complex(dp), intent(in) :: value_coarse(0:, 0:)
      complex(dp), intent(out) :: value_fine(0:, 0:)
      integer :: i, j
      do j = 0, coarse%ny
         do i = 0, coarse%nx - 1
            value_fine(2*i, 2*j) = value_coarse(i, j)
            value_fine(2*i + 1, 2*j) = 0.5_dp*(value_coarse(i, j) + value_coarse(i + 1, j))
         end do
         value_fine(2*coarse%nx, 2*j) = value_coarse(coarse%nx, j)
      end do
      do j = 0, coarse%ny - 1
         value_fine(:, 2*j + 1) = 0.5_dp*(value_fine(:, 2*j) + value_fine(:, 2*j + 2))
      end do
   end subroutine prolong

end module ehlwave_harmonic_system
