!> The linear system of one Newton step, its FFT products and its preconditioner.
module ehlwave_newton_system
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_kernel, only: cell_influence
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_near_stencil, only: near_stencil_t, new_near_stencil
   use ehlwave_real_gmres, only: linear_system_t
   use ehlwave_real_ilu, only: ilu_t, new_ilu
   use ehlwave_reynolds, only: diagonal_scale, flow_t, new_flow, reynolds_jacobian
   use ehlwave_smooth_share, only: set_smooth_share
   use ehlwave_transfer, only: inject, prolong, restrict
   use ehlwave_transport, only: implicit_part, transport_t
   implicit none (type, external)
   private

   !> Unknowns: change of P at all nodes (0 on the boundary), then the change of Delta; one vector of
   !> length n = (nx+1)(ny+1) + 1. Rows are weighted by |A_ii|^(-1/4), between mass (power 0) and pressure
   !> (power -1): measured over powers 0 to -1, this takes the fewest Newton and GMRES steps.
   !> A cavitated node has the row  change of P = -P.
   type, extends(linear_system_t), public :: newton_system_t
      integer :: n = 0
      type(contact_problem_t), pointer :: problem => null()
      type(newton_system_t), pointer :: coarser => null()   !! system of the next coarser grid, if there is one
      type(transport_t) :: transport                        !! terms at the present time
      type(flow_t) :: flow                                  !! coefficients at the present iterate
      real(dp), pointer, contiguous :: p(:, :) => null()    !! pressure of the present iterate
      real(dp), allocatable :: scale(:, :)                  !! 1/|A_ii|, 0 on the boundary
      real(dp), allocatable :: row_scale(:, :)              !! weight of each Reynolds row, 0 on the boundary
      real(dp), allocatable, private :: smooth_share(:, :)  ! of the residual, left to the coarser grid
      logical, allocatable :: is_cavitated(:, :)
      type(near_stencil_t), private :: stencil
      type(ilu_t), private :: ilu
      real(dp), allocatable, private :: dh(:, :), work(:, :), line(:, :), packed(:, :)
      real(dp), allocatable, private :: guess(:), defect(:), rhs(:) ! of a cycle
      real(dp), allocatable, private :: p_own(:, :)         ! pressure of a coarser system
      real(dp), allocatable, private :: column(:)           ! M^(-1) of the Delta column
      real(dp), private :: schur = 1                        ! load row after elimination of P
      real(dp) :: self_influence = 0
      logical :: is_coarse = .false.                        !! serves as preconditioner of a finer system only
   contains
      procedure :: init
      procedure :: set_scale
      procedure :: factorise
      procedure :: multiply
      procedure :: precondition
   end type newton_system_t

   integer, parameter :: largest_reach = 8   !! cells of the near stencil, keeps memory bounded
   ! Measured over 0 to 1 on 257^2 to 1025^2: least GMRES steps for steady states and time steps alike.
   real(dp), parameter :: near_taper = 0.5_dp

contains

   !> Work space for a problem's grid.
   subroutine init(self, problem)
      class(newton_system_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      integer :: rows

      associate (grid => problem%grid, elliptic => problem%conditions%elliptic)
         self%n = (grid%nx + 1)*(grid%ny + 1) + 1
         self%flow = new_flow(grid)
         self%stencil = new_near_stencil(grid, elliptic%kappa, elliptic%k, largest_reach, near_taper)
         rows = grid%ny - grid%first_row
         self%ilu = new_ilu(rows, grid%nx - 1, self%stencil%reach_y, self%stencil%reach_x)
         self%self_influence = cell_influence(0.0_dp, 0.0_dp, grid%hx, grid%hy, elliptic%kappa, elliptic%k)
         allocate (self%scale(0:grid%nx, 0:grid%ny), self%row_scale(0:grid%nx, 0:grid%ny), self%dh(0:grid%nx, 0:grid%ny), &
                   self%smooth_share(0:grid%nx, 0:grid%ny), self%work(0:grid%nx, 0:grid%ny), source=0.0_dp)
         allocate (self%is_cavitated(0:grid%nx, 0:grid%ny), source=.false.)
         allocate (self%line(grid%nx - 1, self%stencil%entries), self%packed(rows, grid%nx - 1), source=0.0_dp)
         allocate (self%column(self%n), self%guess(self%n), self%defect(self%n), self%rhs(self%n), source=0.0_dp)
      end associate
   end subroutine init

   !> Row scale and share of the smooth residual at the present iterate.
   subroutine set_scale(self)
      class(newton_system_t), intent(inout) :: self
      call diagonal_scale(self%problem%grid, self%transport, self%problem%conditions%elliptic%kappa, &
                          self%self_influence, self%flow, self%scale)
      self%row_scale = sqrt(sqrt(self%scale))
      call set_smooth_share(self%scale, self%transport%w0, self%flow%f_h, self%self_influence, self%smooth_share)
   end subroutine set_scale

   !> Preconditioner at the present iterate: ILU(0), in flow order, of local terms and near deformation,
   !> its diagonal enlarged by `shift` times itself.
   recursive subroutine factorise(self, shift)
      class(newton_system_t), intent(inout), target :: self
      real(dp), intent(in) :: shift
      integer :: centre, i, j

      centre = self%stencil%entry_at(0, 0)
      associate (grid => self%problem%grid, kappa => self%problem%conditions%elliptic%kappa, line => self%line)
         do j = grid%first_row, grid%ny - 1
            call self%stencil%fill_line(grid, self%transport, kappa, self%flow, self%p, j, line)
            line(:, centre) = (1 + shift)*line(:, centre)
            do i = 1, grid%nx - 1
               if (self%is_cavitated(i, j)) then
                  line(i, :) = 0
                  line(i, centre) = 1/self%row_scale(i, j)
               end if
               call self%ilu%set_row(j - grid%first_row + 1, i, self%row_scale(i, j)*line(i, :))
            end do
         end do
      end associate
      call self%ilu%factorise()
      if (associated(self%coarser)) then
         call restrict_system(self, self%coarser)
         call self%coarser%factorise(shift)
      end if
      if (self%is_coarse) return

      ! Delta column: J (0, 1), then its image under M^(-1), and the Schur complement of the load row
      self%guess = 0
      self%dh = -1
      call multiply_reynolds(self, self%guess, self%column)
      self%column(self%n) = 0
      call cycle_pressure(self, self%column)
      self%schur = self%problem%load%inertia - load_change(self, self%column)
      if (.not. abs(self%schur) > 0) self%schur = 1
   end subroutine factorise

   !> y = A x: film change by FFT, Jacobian of Reynolds, load row.
   subroutine multiply(self, x, y)
      class(newton_system_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      real(dp), pointer, contiguous :: dp_(:, :)

      associate (grid => self%problem%grid, n => self%n)
         dp_(0:grid%nx, 0:grid%ny) => x(:n - 1)
         call self%problem%deformation%apply(dp_, self%dh)
         self%dh = self%dh - x(n)
         call multiply_reynolds(self, x, y)
         y(n) = load_change(self, x) + self%problem%load%inertia*x(n)
      end associate
   end subroutine multiply

   !> Reynolds rows of A x for a change of film that stands in `dh`; y(n) is left alone.
   subroutine multiply_reynolds(self, x, y)
      class(newton_system_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(inout), contiguous, target :: y(:)
      real(dp), pointer, contiguous :: dp_(:, :), dr(:, :)
      integer :: i, j

      associate (grid => self%problem%grid, n => self%n)
         dp_(0:grid%nx, 0:grid%ny) => x(:n - 1)
         dr(0:grid%nx, 0:grid%ny) => y(:n - 1)
         call reynolds_jacobian(grid, self%transport, self%problem%conditions%elliptic%kappa, self%flow, &
                                self%p, dp_, self%dh, dr, self%work)
         do j = 0, grid%ny
            do i = 0, grid%nx
               dr(i, j) = merge(dp_(i, j), self%row_scale(i, j)*dr(i, j), self%is_cavitated(i, j))
            end do
         end do
      end associate
   end subroutine multiply_reynolds

   !> y = M^(-1) x with the load row eliminated.
   subroutine precondition(self, x, y)
      class(newton_system_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      real(dp) :: change

      y = x
      call cycle_pressure(self, y)
      y(self%n) = 0
      change = (x(self%n) - load_change(self, y))/self%schur
      y = y - change*self%column
      y(self%n) = change
   end subroutine precondition

   !> Linearised problem of the coarser grid: coefficients, pressure and active set by injection.
   subroutine restrict_system(self, coarser)
      class(newton_system_t), intent(inout) :: self
      type(newton_system_t), intent(inout), target :: coarser

      associate (coarse => coarser%problem%grid)
         coarser%is_coarse = .true.
         coarser%transport = implicit_part(self%transport, coarse)
         if (.not. allocated(coarser%p_own)) allocate (coarser%p_own(0:coarse%nx, 0:coarse%ny))
         call inject(coarse, self%p, coarser%p_own)
         coarser%p => coarser%p_own
         call coarser%flow%inject_from(self%flow, coarse)
         coarser%is_cavitated = self%is_cavitated(::2, ::coarse%row_ratio)
         call coarser%set_scale()
      end associate
   end subroutine restrict_system

   !> One multigrid cycle for the pressure part of v, in place: correction from the coarser grid, then the factors
   !> of this one on what is left. The correction is smooth, so its film is interpolated from the coarser grid, where
   !> a convolution costs a quarter.
   recursive subroutine cycle_pressure(self, v)
      class(newton_system_t), intent(inout), target :: self
      real(dp), intent(inout), contiguous, target :: v(:)   !! right side in scaled rows, then change of P
      real(dp), pointer, contiguous :: field(:, :), fine(:, :), coarse_field(:, :)
      type(newton_system_t), pointer :: coarser

      if (.not. associated(self%coarser)) then
         call solve_pressure(self, v)
         return
      end if
      associate (grid => self%problem%grid, coarse => self%coarser%problem%grid, n => self%n)
         coarser => self%coarser
         field(0:grid%nx, 0:grid%ny) => v(:n - 1)
         fine(0:grid%nx, 0:grid%ny) => self%guess(:n - 1)
         coarse_field(0:coarse%nx, 0:coarse%ny) => coarser%rhs(:coarser%n - 1)
         self%work = 0
         where (self%row_scale > 0 .and. .not. self%is_cavitated) self%work = field/self%row_scale
         call restrict(coarse, self%work, coarse_field)
         where (coarser%is_cavitated)
            coarse_field = 0
         elsewhere
            coarse_field = coarse_field*coarser%row_scale
         end where
         coarser%rhs(coarser%n) = 0
         call cycle_pressure(coarser, coarser%rhs)
         call prolong(coarse, coarse_field, fine)
         where (self%is_cavitated) fine = 0
         fine(0, :) = 0
         fine(grid%nx, :) = 0
         fine(:, grid%ny) = 0
         if (grid%first_row > 0) fine(:, 0) = 0
         self%guess(n) = 0
         call coarser%problem%deformation%apply(coarse_field, coarser%dh)
         call prolong(coarse, coarser%dh, self%dh)
         self%defect(n) = 0
         call multiply_reynolds(self, self%guess, self%defect)
         v = v - self%defect
         call restrict(coarse, field, coarse_field)         ! the smooth part: see `smooth_share`
         call prolong(coarse, coarse_field, self%work)
         where (.not. self%is_cavitated) field = field - self%smooth_share*self%work
         call solve_pressure(self, v)
         v = v + self%guess
      end associate
   end subroutine cycle_pressure

   !> Pressure part of v solved in place with the factors.
   subroutine solve_pressure(self, v)
      class(newton_system_t), intent(inout) :: self
      real(dp), intent(inout), contiguous, target :: v(:)
      real(dp), pointer, contiguous :: field(:, :)
      integer :: i, j, low

      associate (grid => self%problem%grid)
         field(0:grid%nx, 0:grid%ny) => v(:self%n - 1)
         low = grid%first_row - 1
         do i = 1, grid%nx - 1
            do j = 1, size(self%packed, 1)
               self%packed(j, i) = field(i, j + low)
            end do
         end do
         call self%ilu%solve(self%packed)
         field = 0
         do j = 1, size(self%packed, 1)
            do i = 1, grid%nx - 1
               field(i, j + low) = self%packed(j, i)
            end do
         end do
      end associate
   end subroutine solve_pressure

   !> (3/(2 pi)) int of the pressure part of v.
   real(dp) function load_change(self, v)
      class(newton_system_t), intent(in) :: self
      real(dp), intent(in), contiguous, target :: v(:)
      real(dp), pointer, contiguous :: field(:, :)
      field(0:self%problem%grid%nx, 0:self%problem%grid%ny) => v(:self%n - 1)
      load_change = load_factor*self%problem%grid%integral(field)
   end function load_change

end module ehlwave_newton_system
