!> The linear system of the response to a small wave.
module ehlwave_harmonic_system
   use ehlwave_complex_gmres, only: linear_system_t
   use ehlwave_full_multigrid, only: level_t
   use ehlwave_grid, only: grid_t
   use ehlwave_harmonic_cycle, only: cycle_level_t, cycle_pressure
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   implicit none (type, external)
   private

   !> Unknowns: amplitude of the change of P at all nodes (0 on the boundary), then that of Delta; one vector of
   !> length n = (nx+1)(ny+1) + 1. The last row is that of the load.
   type, extends(linear_system_t), public :: harmonic_system_t
      integer :: n = 0
      type(cycle_level_t), allocatable :: levels(:)      !! equations, coarsest grid first; the system is that of the last
      complex(dp), private :: inertia = 0                ! weight of Delta in the load row
      complex(dp), allocatable, private :: column(:, :)  ! M^(-1) of the Delta column
      complex(dp), private :: schur = 1                  ! load row after elimination of P
      complex(dp), allocatable, private :: change(:, :)
   contains
      procedure :: init
      procedure :: set_frequency
      procedure :: gap_change
      procedure :: multiply
      procedure :: precondition
   end type harmonic_system_t

contains

   !> Linearise about the steady state of the finest of `levels`, which must stay.
   subroutine init(self, levels)
      class(harmonic_system_t), intent(inout) :: self
      type(level_t), intent(in), target :: levels(:)   !! coarsest first
      integer :: l, n

      n = size(levels)
      if (allocated(self%levels)) deallocate (self%levels, self%column, self%change)
      allocate (self%levels(n))
      do l = n, 1, -1
         call self%levels(l)%init(levels(l)%problem)
         if (l == n) then
            call self%levels(l)%linearise(levels(l)%state)
         else
            call self%levels(l)%inject_from(self%levels(l + 1))
         end if
      end do
      associate (nx => levels(n)%problem%grid%nx, ny => levels(n)%problem%grid%ny)
         self%n = (nx + 1)*(ny + 1) + 1
         allocate (self%column(0:nx, 0:ny), self%change(0:nx, 0:ny), source=(0.0_dp, 0.0_dp))
      end associate
   end subroutine init

   !> Operator and preconditioner for one frequency.
   subroutine set_frequency(self, frequency, dt, inertia)
      class(harmonic_system_t), intent(inout) :: self
      real(dp), intent(in) :: frequency       !! w in units of 1/T
      real(dp), intent(in) :: dt              !! step along the characteristic: hX of the finest grid
      complex(dp), intent(in) :: inertia      !! weight of Delta in the load row, 0: force balance
      integer :: l

      do l = 1, size(self%levels)
         call self%levels(l)%set_frequency(frequency, dt)
      end do
      self%inertia = inertia

      ! Delta column: J (0, 1), then its image under M^(-1), and the Schur complement of the load row
      associate (finest => self%levels(size(self%levels)))
         self%column = 0
         self%change = -1
         call finest%residual_change(self%column, self%change, finest%field)
         call cycle_pressure(self%levels)
         self%column = finest%field
         self%schur = inertia - load_change(finest%problem%grid, self%column)
         if (.not. abs(self%schur) > 0) self%schur = 1
      end associate
   end subroutine set_frequency

   !> Right side for a pattern g added to the gap: minus the change of the weighted residuals.
   subroutine gap_change(self, g, b)
      class(harmonic_system_t), intent(inout) :: self
      complex(dp), intent(in) :: g(0:, 0:)                      !! (0:nx, 0:ny)
      complex(dp), intent(out), contiguous, target :: b(:)      !! (n)
      complex(dp), pointer, contiguous :: dr(:, :)

      associate (finest => self%levels(size(self%levels)))
         dr(0:ubound(g, 1), 0:ubound(g, 2)) => b(:self%n - 1)
         self%change = 0
         call finest%residual_change(self%change, g, dr)
         dr = -dr
         b(self%n) = 0
      end associate
   end subroutine gap_change

   !> y = A x: film change by FFT, linearised Reynolds equation, load row.
   subroutine multiply(self, x, y)
      class(harmonic_system_t), intent(inout) :: self
      complex(dp), intent(in), contiguous, target :: x(:)
      complex(dp), intent(out), contiguous, target :: y(:)
      complex(dp), pointer, contiguous :: dr(:, :), q(:, :)

      associate (finest => self%levels(size(self%levels)), grid => self%levels(size(self%levels))%problem%grid, n => self%n)
         q(0:grid%nx, 0:grid%ny) => x(:n - 1)
         dr(0:grid%nx, 0:grid%ny) => y(:n - 1)
         call finest%film_change(q, x(n), self%change)
         call finest%residual_change(q, self%change, dr)
         y(n) = load_change(grid, q) + self%inertia*x(n)
      end associate
   end subroutine multiply

   !> y = M^(-1) x with the load row eliminated.
   subroutine precondition(self, x, y)
      class(harmonic_system_t), intent(inout) :: self
      complex(dp), intent(in), contiguous, target :: x(:)
      complex(dp), intent(out), contiguous, target :: y(:)
      complex(dp), pointer, contiguous :: q(:, :), r(:, :)

      associate (finest => self%levels(size(self%levels)), grid => self%levels(size(self%levels))%problem%grid, n => self%n)
         r(0:grid%nx, 0:grid%ny) => x(:n - 1)
         q(0:grid%nx, 0:grid%ny) => y(:n - 1)
         finest%field = r
         call cycle_pressure(self%levels)
         y(n) = (x(n) - load_change(grid, finest%field))/self%schur
         q = finest%field - y(n)*self%column
      end associate
   end subroutine precondition

   !> (3/(2 pi)) int of a change of pressure.
   pure complex(dp) function load_change(grid, q)
      type(grid_t), intent(in) :: grid
      complex(dp), intent(in) :: q(0:, 0:)   !! (0:nx, 0:ny)
      integer :: j
      load_change = 0
      do j = 0, grid%ny
         load_change = load_change + grid%weight(j)*sum(q(:, j))
      end do
      load_change = load_factor*grid%hx*grid%hy*load_change
   end function load_change

end module ehlwave_harmonic_system
