!> Nonlinear elimination of the steep end of the pressure (Lanzkron, Rose and Wilkes 1996).
!>
!> Waves move the steep end of the pressure. The first guess is then off by a factor in the viscosity, at a hundred
!> nodes of ten thousands. Newton's method on the whole would take three or four steps for these nodes alone. In a patch
!> that holds them they take a few steps, each for a few per cent of the cost. All else is held.
module ehlwave_patch_solver
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_equations, only: equations_t
   use ehlwave_given, only: given_t, steady_given
   use ehlwave_grid, only: grid_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_local_solver, only: local_solver_t
   use ehlwave_newton, only: newton_t
   use ehlwave_patch, only: cut, patch_grid
   use ehlwave_solve_report, only: mass_gain, solve_limits_t, solve_report_t
   use ehlwave_state, only: state_t
   use ehlwave_threads, only: is_shared
   implicit none (type, external)
   private

   !> The patch of the last solve: its size alone is of use to the next.
   type, extends(local_solver_t), public :: patch_solver_t
      type(level_t), allocatable, private :: patch(:)   ! single
      type(newton_t), private :: newton
   contains
      procedure :: improve_part
   end type patch_solver_t

   real(dp), parameter :: quiet_share = 0.03_dp  !! share of the largest residual: nodes below do not call for a patch
   ! Largest share of the nodes of the whole. A front of waves at the steep end leaves a large residual along the end:
   ! there larger patches save Newton steps of the whole, but on coarse grids, where they cost as much: steady states of
   ! M = 60 to 108 took a quarter more work on 64 x 64 cells.
   real(dp), parameter :: largest_patch(2) = [0.2_dp, 0.5_dp]   !! residuals below `large`, and above
   real(dp), parameter :: large = 0.03_dp
   integer, parameter :: fewest_nodes = 4000        !! of a grid with larger patches
   integer, parameter :: margin = 4                 !! nodes around those that call for it
   integer, parameter :: size_step = 8              !! patches have multiples of so many cells, so that few sizes occur
   integer, parameter :: most_steps = 6
   real(dp), parameter :: enough = 0.3_dp           !! residual in the patch over the residual outside

contains

   !> See the interface. The choice depends on the state alone.
   subroutine improve_part(self, problem, given, equations, limits, state, p)
      class(patch_solver_t), intent(inout) :: self
      type(contact_problem_t), intent(inout) :: problem
      type(given_t), intent(in) :: given
      type(equations_t), intent(in) :: equations
      type(solve_limits_t), intent(in) :: limits
      type(state_t), intent(in) :: state
      real(dp), allocatable, intent(out) :: p(:, :)
      type(grid_t) :: grid
      type(solve_limits_t) :: patch_limits
      type(solve_report_t) :: report
      integer :: first(2), last(2)
      real(dp) :: quiet

      if (problem%grid%is_line) return
      patch_limits = limits
      patch_limits%largest_steps = most_steps
      patch_limits%keeps_factors = .false.     ! in steep films a step changes too much
      patch_limits%film_unit = problem%grid%value_at_centre(state%h)
      call find(problem%grid, equations, state, patch_limits, first, last, quiet)
      if (any(last <= first)) return
      patch_limits%tolerance = enough*max(limits%tolerance, quiet)
      grid = patch_grid(problem%grid, first, last)
      call make_room(self, problem, grid)
      associate (patch => self%patch(1))
         patch%problem%deformation%work = 0
         call cut(problem, given, equations, state, grid, first, patch)
         call self%newton%improve(self%patch, patch%given, patch%state, patch_limits, report)
         problem%deformation%work = problem%deformation%work + patch%problem%deformation%work
         if (.not. report%residual < 0.5_dp*report%history(1)) return
         p = state%p
         p(first(1):last(1), first(2):last(2)) = patch%state%p
      end associate
   end subroutine improve_part

   !> Work space for patches of a size, on this level of the grids, where the last does not fit.
   subroutine make_room(self, problem, grid)
      class(patch_solver_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(grid_t), intent(in) :: grid

      if (.not. allocated(self%patch)) allocate (self%patch(1))
      associate (patch => self%patch(1))
         associate (last => patch%problem%grid)
            if (last%nx == grid%nx .and. last%ny == grid%ny .and. (last%is_half .eqv. grid%is_half) .and. &
                all(abs([last%hx - grid%hx, last%hy - grid%hy]) <= 0)) return
         end associate
         call patch%problem%lay_out(grid, problem%conditions)
         call patch%problem%take_oil(problem)
         patch%given = steady_given(grid)
         call self%newton%init_levels(self%patch)
      end associate
   end subroutine make_room

   !> The patch: all nodes whose residual is not small against the largest one, and some around. None (last = first)
   !> where a patch does not pay.
   subroutine find(grid, equations, state, limits, first, last, quiet)
      type(grid_t), intent(in) :: grid
      type(equations_t), intent(in) :: equations
      type(state_t), intent(in) :: state
      type(solve_limits_t), intent(in) :: limits
      integer, intent(out) :: first(2), last(2)   !! nodes: i and j
      real(dp), intent(out) :: quiet              !! largest residual outside
      real(dp) :: gain(0:grid%nx, 0:grid%ny), largest(0:grid%ny), bound
      integer :: i, j

      !$omp parallel do schedule(static) if (is_shared(size(gain)))
      do j = 0, grid%ny
         gain(:, j) = merge(0.0_dp, mass_gain(equations%residual(:, j), grid%hx, state%h(:, j), limits%film_unit), &
                            equations%is_cavitated(:, j))
         largest(j) = maxval(gain(:, j))
      end do
      first = 0
      last = 0
      quiet = 0
      if (maxval(largest) <= limits%tolerance) return
      bound = max(limits%tolerance, quiet_share*maxval(largest))
      first = [grid%nx, grid%ny]
      do j = 0, grid%ny
         if (.not. largest(j) > bound) cycle
         do i = 0, grid%nx
            if (.not. gain(i, j) > bound) cycle
            first = min(first, [i, j])
            last = max(last, [i, j])
         end do
      end do
      call widen(grid%nx, first(1), last(1))
      call widen(grid%ny, first(2), last(2))
      if (product(real(last - first, dp)) > merge(largest_patch(2), largest_patch(1), maxval(largest) > large .and. &
          grid%nx*grid%ny > fewest_nodes)*grid%nx*grid%ny) last = first
      do j = first(2) + 1, last(2) - 1
         largest(j) = max(maxval(gain(:first(1), j)), maxval(gain(last(1):, j)))
      end do
      quiet = maxval(largest)
   end subroutine find

   !> Widen a range of nodes by the margin and to a multiple of `size_step` cells, within 0..n.
   pure subroutine widen(n, first, last)
      integer, intent(in) :: n
      integer, intent(inout) :: first, last
      integer :: length

      first = max(0, first - margin)
      last = min(n, last + margin)
      if (first <= margin) first = 0
      length = min(n, size_step*((last - first + size_step - 1)/size_step))
      last = min(n, first + length)
      first = last - length
   end subroutine widen

end module ehlwave_patch_solver
