!> Contacts and fields that several tests use.
module sample_contact
   use ehlwave_conditions, only: conditions_from_moes, conditions_t
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_density_law, only: density_law_t
   use ehlwave_errors, only: error_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_given, only: given_t, steady_given
   use ehlwave_grid, only: grid_t, new_grid
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_oil, only: oil_t
   use ehlwave_rheology, only: new_rheology, rheology_t
   use ehlwave_solve_report, only: solve_limits_t
   use ehlwave_solver_choice, only: init_multigrid, method_t
   use ehlwave_state, only: state_t
   use ehlwave_transport, only: characteristic_transport
   use ehlwave_viscosity_law, only: viscosity_law_t
   implicit none (type, external)
   private
   public :: make_contact, make_level, make_conditions, make_rheology, rheology_of, make_multigrid, &
      solve_sample, start_time_step, bump_pressure, noise

contains

   !> Conditions for L = 12.05 and the default lubricant.
   function make_conditions(m, d) result(conditions)
      real(dp), intent(in) :: m, d
      type(conditions_t) :: conditions
      type(error_t), allocatable :: error
      call conditions_from_moes(m, 12.05_dp, d, 2.2e-8_dp, conditions, error)
      if (allocated(error)) error stop 'make_conditions: '//error%message
   end function make_conditions

   !> A contact with the default lubricant or another viscosity law.
   function make_rheology(conditions, viscosity_law) result(rheology)
      type(conditions_t), intent(in) :: conditions
      character(len=*), intent(in), optional :: viscosity_law
      type(rheology_t) :: rheology
      type(oil_t) :: oil
      if (present(viscosity_law)) oil%viscosity_law = viscosity_law
      rheology = rheology_of(oil, conditions%hertz_pressure_pa)
   end function make_rheology

   !> The laws of an oil at a Hertz pressure.
   function rheology_of(oil, hertz_pressure_pa) result(rheology)
      type(oil_t), intent(in) :: oil
      real(dp), intent(in) :: hertz_pressure_pa
      type(rheology_t) :: rheology
      class(viscosity_law_t), allocatable :: viscosity
      class(density_law_t), allocatable :: density
      type(error_t), allocatable :: error
      call oil%make_viscosity(viscosity, error)
      if (allocated(error)) error stop 'rheology_of: '//error%message
      call oil%make_density(density)
      rheology = new_rheology(viscosity, density, hertz_pressure_pa)
   end function rheology_of

   !> The steady contact M = 100, D = 0.35 on 48 x 48 cells.
   subroutine solve_sample(multigrid, is_half, is_fitted)
      type(full_multigrid_t), intent(inout) :: multigrid
      logical, intent(in) :: is_half
      logical, intent(in), optional :: is_fitted   !! scheme; absent: averaged
      call make_multigrid(multigrid, 100.0_dp, 0.35_dp, 48, is_half, is_fitted=is_fitted)
      call multigrid%solve(solve_limits_t(tolerance=1e-9_dp), 1e-3_dp)
   end subroutine solve_sample

   !> Data of the step that follows a state at rest, with a wave in the gap.
   subroutine start_time_step(problem, state, given)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      type(given_t), intent(inout) :: given
      real(dp), allocatable :: history(:, :, :)
      allocate (history(0:problem%grid%nx, 0:problem%grid%ny, 2))
      history = spread(problem%rheology%density(state%p)*state%h, 3, 2)
      given%transport = characteristic_transport(problem%grid, 1, 1)
      call given%transport%carry(problem%grid, history)
      call given%set_rough(0.02_dp*spread(cos(8*problem%grid%x), 2, problem%grid%ny + 1))
   end subroutine start_time_step

   !> Steady contact on the default domain.
   subroutine make_contact(problem, m, d, cells_x, cells_y, is_half, viscosity_law)
      type(contact_problem_t), intent(inout) :: problem
      real(dp), intent(in) :: m, d
      integer, intent(in) :: cells_x, cells_y
      logical, intent(in) :: is_half
      character(len=*), intent(in), optional :: viscosity_law
      type(conditions_t) :: conditions

      conditions = make_conditions(m, d)
      call problem%init(new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells_x, cells_y, is_half), conditions, &
                        make_rheology(conditions, viscosity_law))
   end subroutine make_contact

   !> A separate level with that contact, and the data of its steady state.
   subroutine make_level(level, m, d, cells, is_half)
      type(level_t), intent(inout) :: level
      real(dp), intent(in) :: m, d
      integer, intent(in) :: cells   !! in both directions
      logical, intent(in) :: is_half
      call make_contact(level%problem, m, d, cells, cells, is_half)
      level%given = steady_given(level%problem%grid)
   end subroutine make_level

   !> A hierarchy of steady contacts on the default domain, `cells` in both directions, and its solvers.
   subroutine make_multigrid(multigrid, m, d, cells, is_half, method, is_fitted)
      type(full_multigrid_t), intent(inout) :: multigrid
      real(dp), intent(in) :: m, d
      integer, intent(in) :: cells
      logical, intent(in) :: is_half
      type(method_t), intent(in), optional :: method
      logical, intent(in), optional :: is_fitted
      type(conditions_t) :: conditions
      type(grid_t) :: grid
      type(method_t) :: chosen

      if (present(method)) chosen = method
      conditions = make_conditions(m, d)
      grid = new_grid(-2.5_dp, 1.5_dp, 2.0_dp, cells, cells, is_half)
      if (present(is_fitted)) grid%is_fitted = is_fitted
      call init_multigrid(multigrid, conditions, make_rheology(conditions), grid, chosen)
   end subroutine make_multigrid

   !> A pressure that is positive inside, zero on the outer boundary, even in Y, without symmetry in X.
   pure function bump_pressure(grid) result(p)
      type(grid_t), intent(in) :: grid
      real(dp) :: p(0:grid%nx, 0:grid%ny)
      real(dp) :: width
      integer :: i, j

      p = 0
      width = maxval(abs(grid%y))
      do j = grid%first_row, grid%last_row
         do i = 1, grid%nx - 1
            p(i, j) = (1 + 0.3_dp*sin(3*grid%x(i)))*exp(-2*grid%x(i)**2)*(1 - (grid%y(j)/width)**2) + 0.01_dp
         end do
      end do
   end function bump_pressure

   !> Repeatable numbers between -1 and 1.
   pure elemental real(dp) function noise(i, j)
      integer, intent(in) :: i, j
      noise = modulo(sin(12.9898_dp*i + 78.233_dp*j)*43758.5453_dp, 2.0_dp) - 1
   end function noise

end module sample_contact
