!> The grids of one contact, with all that belongs to each.
module ehlwave_hierarchy
   use ehlwave_conditions, only: conditions_t
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_deformation_mlmi, only: deformation_mlmi_t
   use ehlwave_formula, only: moes_film_formula
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_real_transfer, only: interpolate
   use ehlwave_rheology, only: rheology_t
   use ehlwave_solve_report, only: solve_report_t
   use ehlwave_state, only: new_state, state_t
   implicit none (type, external)
   private
   public :: hertz_guess

   !> One level: its problem, its unknowns and what the last solve of it came to.
   type, public :: level_t
      type(contact_problem_t) :: problem
      type(state_t) :: state
      type(solve_report_t) :: report
      real(dp) :: central_film = 0, minimum_film = 0   !! of its own steady solution, NaN where it did not converge
   end type level_t

   !> It owns the levels, and solvers work on those of the hierarchy that is given to them. FFTW ties the deformation of a
   !> level to its place in memory: a hierarchy is not to be copied.
   type, public :: hierarchy_t
      type(level_t), allocatable :: levels(:)   !! level 1 is the coarsest
   contains
      procedure :: build
      procedure :: start_level
      procedure :: work
   end type hierarchy_t

   integer, parameter :: fewest_cells = 24   !! along X or over the whole width, on the coarsest grid

contains

   !> Levels down from the finest grid, cells halved as long as they are even and enough.
   subroutine build(self, conditions, rheology, finest, deformation)
      class(hierarchy_t), intent(inout) :: self
      type(conditions_t), intent(in) :: conditions
      type(rheology_t), intent(in) :: rheology
      type(grid_t), intent(in) :: finest
      character(len=*), intent(in) :: deformation   !! 'fft' or 'mlmi'
      type(grid_t) :: grid
      integer :: l, n

      grid = finest
      n = 1
      do while (grid%can_coarsen(fewest_cells))
         grid = grid%coarser()
         n = n + 1
      end do
      if (allocated(self%levels)) deallocate (self%levels)
      allocate (self%levels(n))
      grid = finest
      do l = n, 1, -1
         associate (level => self%levels(l))
            if (deformation == 'mlmi') allocate (deformation_mlmi_t :: level%problem%deformation)
            call level%problem%init(grid, conditions, rheology)
            level%state = new_state(grid)
         end associate
         if (l > 1) grid = grid%coarser()
      end do
   end subroutine build

   !> Operations done so far on all of its grids, see `ehlwave_work_unit`.
   pure real(dp) function work(self)
      class(hierarchy_t), intent(in) :: self
      integer :: l
      work = 0
      do l = 1, size(self%levels)
         work = work + self%levels(l)%problem%deformation%work
      end do
   end function work

   !> First guess of a level: the solution of the next coarser one, on the coarsest that of Hertz.
   subroutine start_level(self, l)
      class(hierarchy_t), intent(inout) :: self
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

end module ehlwave_hierarchy
