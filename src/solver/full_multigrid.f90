!> Full multigrid (FMG): solve on the coarsest grid, interpolate, solve on the next finer one, and so on.
module ehlwave_full_multigrid
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use ehlwave_conditions, only: conditions_t
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_deformation_choice, only: chosen_deformation
   use ehlwave_deformation_mlmi, only: deformation_mlmi_t
   use ehlwave_fas_multigrid, only: fas_t
   use ehlwave_formula, only: moes_film_formula
   use ehlwave_grid, only: grid_t, new_grid, new_line_grid
   use ehlwave_kinds, only: dp
   use ehlwave_level_solver, only: level_solver_t, solve_limits_t, solve_report_t
   use ehlwave_newton, only: newton_t
   use ehlwave_petsc_solver, only: petsc_solver_t
   use ehlwave_rheology, only: rheology_t
   use ehlwave_state, only: new_state, state_t
   use ehlwave_status, only: status_converged
   use ehlwave_transfer, only: interpolate
   implicit none (type, external)
   private

   !> One level: its problem, its solver, its unknowns. Level 1 is the coarsest.
   type, public :: level_t
      type(contact_problem_t) :: problem
      class(level_solver_t), allocatable :: solver
      type(state_t) :: state
      type(solve_report_t) :: report
      real(dp) :: central_film = 0, minimum_film = 0   !! of its own steady solution, NaN where it did not converge
   end type level_t

   !> Hierarchy of grids of one contact. Its solvers point at each other and at their problems: declare it a
   !> target, pass it by reference, do not copy it.
   type, public :: full_multigrid_t
      type(level_t), allocatable :: levels(:)
   contains
      procedure :: init
      procedure :: solve
      procedure :: start_level
   end type full_multigrid_t

   integer, parameter :: fewest_cells = 24   !! along X or over the whole width, on the coarsest grid

contains

   !> Hierarchy down from the finest grid, cells halved as long as they are even and enough.
   subroutine init(self, conditions, rheology, x_min, x_max, y_max, cells_x, cells_y, is_half, &
                   method, deformation, cycle)
      class(full_multigrid_t), intent(inout), target :: self
      type(conditions_t), intent(in) :: conditions
      type(rheology_t), intent(in) :: rheology
      real(dp), intent(in) :: x_min, x_max, y_max   !! domain in X and Y
      integer, intent(in) :: cells_x, cells_y       !! cells of the finest grid over the whole domain
      logical, intent(in) :: is_half                !! store Y >= 0 only; y_max, cells_y and this are not of line contacts
      character(len=*), intent(in) :: method        !! 'newton', 'fas', or 'petsc' for the finest level
      character(len=*), intent(in) :: deformation   !! 'fft', 'mlmi' or 'auto', level by level
      character(len=*), intent(in), optional :: cycle   !! of FAS: 'v', 'w' or 'f'
      integer :: l, n
      type(grid_t) :: grid

      n = level_count(cells_x, cells_y, is_half)
      if (conditions%is_line()) n = level_count(cells_x, cells_x, .false.)
      allocate (self%levels(n))
      do l = 1, n
         associate (level => self%levels(l))
            if (chosen_deformation(deformation, cells_x/2**(n - l), cells_y/2**(n - l), is_half, &
                                   conditions%elliptic%kappa) == 'mlmi') &
               allocate (deformation_mlmi_t :: level%problem%deformation)
            if (conditions%is_line()) then
               grid = new_line_grid(x_min, x_max, cells_x/2**(n - l))
            else
               grid = new_grid(x_min, x_max, y_max, cells_x/2**(n - l), cells_y/2**(n - l), is_half)
            end if
            call level%problem%init(grid, conditions, rheology)
            level%state = new_state(level%problem%grid)
            if (method == 'petsc' .and. l == n) then
               allocate (petsc_solver_t :: level%solver)
            else if (method == 'fas') then
               allocate (fas_t :: level%solver)
            else
               allocate (newton_t :: level%solver)
            end if
            call level%solver%init(level%problem)
            if (l > 1) call connect_levels(level%solver, self%levels(l - 1)%solver)
            associate (solver => level%solver)
               select type (solver)
               type is (fas_t)
                  if (present(cycle)) solver%cycle = cycle(1:1)
               end select
            end associate
         end associate
      end do
   end subroutine init

   !> Let a solver use that of the next coarser level: Newton's method in its preconditioner, FAS for its coarse problem.
   subroutine connect_levels(solver, coarser)
      class(level_solver_t), intent(inout) :: solver
      class(level_solver_t), intent(in), target :: coarser
      select type (solver)
      type is (newton_t)
         select type (coarser)
         type is (newton_t)
            solver%coarser => coarser
         end select
      type is (fas_t)
         select type (coarser)
         type is (fas_t)
            solver%coarser => coarser
         end select
      end select
   end subroutine connect_levels

   !> Number of levels: both directions are halved together.
   pure integer function level_count(cells_x, cells_y, is_half)
      integer, intent(in) :: cells_x, cells_y
      logical, intent(in) :: is_half
      integer :: nx, ny, multiple
      nx = cells_x
      ny = cells_y
      multiple = merge(4, 2, is_half)   ! a half domain needs an even count on the coarse grid too
      level_count = 1
      do while (modulo(nx, 2) == 0 .and. modulo(ny, multiple) == 0 .and. min(nx, ny)/2 >= fewest_cells)
         nx = nx/2
         ny = ny/2
         level_count = level_count + 1
      end do
   end function level_count

   !> Steady solution on the finest level, from a Hertz guess on the coarsest.
   !>
   !> A level that does not converge hands on what it has if that is finite: coarse grids may be too coarse
   !> for the case. Only the report of the finest level counts.
   subroutine solve(self, limits, coarse_tolerance)
      class(full_multigrid_t), intent(inout) :: self
      type(solve_limits_t), intent(in) :: limits        !! for the finest level
      real(dp), intent(in) :: coarse_tolerance          !! for the others
      type(solve_limits_t) :: coarse_limits
      integer :: l, n

      n = size(self%levels)
      coarse_limits = limits
      coarse_limits%tolerance = max(limits%tolerance, coarse_tolerance)
      do l = 1, n
         associate (level => self%levels(l))
            call self%start_level(l)
            if (l == n) then
               call level%solver%solve(level%problem, level%state, limits, level%report)
            else
               call level%solver%solve(level%problem, level%state, coarse_limits, level%report)
               if (level%report%status /= status_converged) call hertz_guess(level%problem, level%state)
            end if
            level%central_film = ieee_value(1.0_dp, ieee_quiet_nan)
            level%minimum_film = level%central_film
            if (level%report%status == status_converged) then
               level%central_film = level%problem%grid%value_at_centre(level%state%h)
               level%minimum_film = minval(level%state%h)
            end if
         end associate
      end do
   end subroutine solve

   !> First guess of a level: the solution of the next coarser one, on the coarsest that of Hertz.
   subroutine start_level(self, l)
      class(full_multigrid_t), intent(inout) :: self
      integer, intent(in) :: l

      associate (level => self%levels(l))
         if (l == 1) then
            call hertz_guess(level%problem, level%state)
         else
            call interpolate(self%levels(l - 1)%problem%grid, level%problem%grid, &
                             self%levels(l - 1)%state%p, level%state%p)
            level%state%p = max(level%state%p, 0.0_dp)
            level%state%delta = self%levels(l - 1)%state%delta
         end if
      end associate
   end subroutine start_level

   !> Hertz pressure, and the approach that leaves the formula's central film thickness.
   subroutine hertz_guess(problem, state)
      type(contact_problem_t), intent(inout) :: problem
      type(state_t), intent(inout) :: state
      integer :: j

      associate (grid => problem%grid)
         do j = 0, grid%ny
            state%p(:, j) = sqrt(max(0.0_dp, 1 - grid%x**2 - grid%y(j)**2))
         end do
         call problem%deformation%apply(state%p, state%h)
         state%delta = grid%value_at_centre(state%h) &
                       - moes_film_formula(problem%conditions)/problem%conditions%moes_film_factor
      end associate
   end subroutine hertz_guess

end module ehlwave_full_multigrid
