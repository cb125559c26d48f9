!> The grids of a contact, with all data of each.
module ehlwave_hierarchy
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_assertions, only: assert, checks
   use ehlwave_conditions, only: conditions_t
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_deformation_mlmi, only: deformation_mlmi_t
   use ehlwave_formula, only: expected_film
   use ehlwave_given, only: given_t, steady_given
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_real_transfer, only: inject, interpolate
   use ehlwave_rheology, only: rheology_t
   use ehlwave_solve_report, only: solve_report_t
   use ehlwave_state, only: new_state, state_t
   implicit none (type, external)
   private
   public :: hertz_guess, level_count, work_of

   !> A level: its problem, the data of its solution, its unknowns and the outcome of its last solve.
   type, public :: level_t
      type(contact_problem_t) :: problem
      type(given_t) :: given       !! the steady state of smooth surfaces at first; a time march gives more
      type(state_t) :: state
      type(solve_report_t) :: report
      real(dp) :: central_film = no_value, minimum_film = no_value   !! films of its steady solution; NaN: none for this
                                                                     !! contact
   contains
      procedure :: has_film
   end type level_t

   !> The hierarchy owns the levels; solvers work on the hierarchy passed to them. FFTW ties the deformation of a level
   !> to its place in memory: do not copy a hierarchy.
   type, public :: hierarchy_t
      type(level_t), allocatable :: levels(:)   !! level 1 is the coarsest
      character(len=4), private :: deformation = ''
   contains
      procedure :: build
      procedure :: set_conditions
      procedure :: start_level
      procedure :: start_from_finer
      procedure :: take_film
      procedure :: work
   end type hierarchy_t

   integer, parameter :: fewest_cells = 24   !! along X or over the whole width, on the coarsest grid

contains

   !> Grids down from a finest one: cells are halved as long as they are even and enough.
   pure integer function level_count(finest)
      type(grid_t), intent(in) :: finest
      type(grid_t) :: grid
      grid = finest
      level_count = 1
      do while (grid%can_coarsen(fewest_cells))
         grid = grid%coarser()
         level_count = level_count + 1
      end do
   end function level_count

   !> All levels down from the finest grid. The deformations of former levels serve on the same grids.
   subroutine build(self, conditions, rheology, finest, deformation)
      class(hierarchy_t), intent(inout) :: self
      type(conditions_t), intent(in) :: conditions
      type(rheology_t), intent(in) :: rheology
      type(grid_t), intent(in) :: finest
      character(len=*), intent(in) :: deformation   !! 'fft' or 'mlmi'
      type(level_t), allocatable :: former(:)
      type(grid_t) :: grid
      integer :: l, n

      if (checks) call assert(any(deformation == ['fft ', 'mlmi']), 'hierarchy%build: deformation is fft or mlmi')
      n = level_count(finest)
      call move_alloc(self%levels, former)
      allocate (self%levels(n))
      if (allocated(former)) then
         do l = 1, merge(n, 0, n == size(former) .and. deformation == self%deformation .and. &
                         (finest%is_line .eqv. former(1)%problem%grid%is_line))
            call move_alloc(former(l)%problem%deformation, self%levels(l)%problem%deformation)
            self%levels(l)%problem%deformation%work = 0
         end do
         deallocate (former)
      end if
      self%deformation = deformation
      grid = finest
      do l = n, 1, -1
         associate (level => self%levels(l))
            if (deformation == 'mlmi' .and. .not. allocated(level%problem%deformation)) &
               allocate (deformation_mlmi_t :: level%problem%deformation)
            call level%problem%init(grid, conditions, rheology)
            level%given = steady_given(grid)
            level%state = new_state(grid)
         end associate
         if (l > 1) grid = grid%coarser()
      end do
   end subroutine build

   !> Give all levels other conditions of a contact with the same ratio of radii, and the oil under them. The films of
   !> the levels belong to the former contact and are dropped.
   subroutine set_conditions(self, conditions, rheology)
      class(hierarchy_t), intent(inout) :: self
      type(conditions_t), intent(in) :: conditions
      type(rheology_t), intent(in) :: rheology
      integer :: l
      do l = 1, size(self%levels)
         call self%levels(l)%problem%set_conditions(conditions, rheology)
         self%levels(l)%central_film = no_value
         self%levels(l)%minimum_film = no_value
      end do
   end subroutine set_conditions

   !> Keep the films of a level, whose state solves its problem.
   subroutine take_film(self, l)
      class(hierarchy_t), intent(inout) :: self
      integer, intent(in) :: l
      associate (level => self%levels(l))
         level%central_film = level%problem%grid%value_at_centre(level%state%h)
         level%minimum_film = minval(level%state%h)
      end associate
   end subroutine take_film

   !> Whether a level has the films of a steady solution of this contact.
   elemental logical function has_film(self)
      class(level_t), intent(in) :: self
      has_film = ieee_is_finite(self%central_film)
   end function has_film

   !> Operations done so far on all of its grids, see `ehlwave_work_unit`.
   pure real(dp) function work(self)
      class(hierarchy_t), intent(in) :: self
      work = work_of(self%levels)
   end function work

   !> Work of some levels.
   pure real(dp) function work_of(levels)
      type(level_t), intent(in) :: levels(:)
      integer :: l
      work_of = 0
      do l = 1, size(levels)
         work_of = work_of + levels(l)%problem%deformation%work
      end do
   end function work_of

   !> First guess of a level: the solution of the next coarser level, on the coarsest the Hertz solution.
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

   !> First guess of a level below the finest: the solution of the next finer level.
   subroutine start_from_finer(self, l)
      class(hierarchy_t), intent(inout) :: self
      integer, intent(in) :: l
      associate (level => self%levels(l), finer => self%levels(l + 1))
         call inject(level%problem%grid, finer%state%p, level%state%p)
         level%state%delta = finer%state%delta
      end associate
   end subroutine start_from_finer

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
                       - expected_film(problem%conditions)
      end associate
   end subroutine hertz_guess

end module ehlwave_hierarchy
