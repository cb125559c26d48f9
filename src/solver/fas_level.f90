!> Full approximation scheme (FAS) on a level: the coarse problem of a fine state, and the correction from its
!> solution.
module ehlwave_fas_level
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_equations, only: equations_t
   use ehlwave_kinds, only: dp
   use ehlwave_given, only: given_t
   use ehlwave_line_relaxation, only: line_relaxation_t
   use ehlwave_real_transfer, only: full_weighting => restrict, inject, prolong
   use ehlwave_state, only: new_state, state_t
   use ehlwave_step_limit, only: step_limit_t
   use ehlwave_threads, only: is_shared
   use ehlwave_transport, only: implicit_part
   implicit none (type, external)
   private

   !> Data of a cycle on a level. Only coarse levels have a `given`: the finest takes it from the hierarchy's level.
   type, public :: fas_level_t
      type(given_t) :: given                       !! by the next finer level, see `restrict`
      type(equations_t) :: equations
      type(state_t) :: state                       !! present iterate
      type(state_t) :: restricted                  !! on coarse levels: as restricted from the finer level
      type(state_t), private :: next               !! after a sweep or correction; then the previous value
      type(line_relaxation_t), private :: relaxation
   contains
      procedure :: init
      procedure :: evaluate
      procedure :: relax
      procedure :: restrict
      procedure :: correct
   end type fas_level_t

contains

   !> Work space for a problem.
   subroutine init(self, problem)
      class(fas_level_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      call self%equations%init(problem)
      call self%relaxation%init(problem)
      self%state = new_state(problem%grid)
      self%next = new_state(problem%grid)
   end subroutine init

   !> Evaluate the equations at the state, whose film belongs to its pressure.
   subroutine evaluate(self, problem, given)
      class(fas_level_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(given_t), intent(in) :: given
      call self%equations%evaluate(problem, given, self%state)
   end subroutine evaluate

   !> Sweeps from an evaluated state to an evaluated state.
   subroutine relax(self, problem, given, sweeps)
      class(fas_level_t), intent(inout) :: self
      type(contact_problem_t), intent(inout) :: problem
      type(given_t), intent(in) :: given
      integer, intent(in) :: sweeps
      integer :: n
      do n = 1, sweeps
         call self%relaxation%relax(problem, given, self%equations, self%state, self%next)
         call self%evaluate(problem, given)
      end do
   end subroutine relax

   !> Pose the equations of this level, theory eq. (M2), so that their solution is the injected fine state when that
   !> solves the fine equations. The state is the injected one on return, and evaluated.
   !>
   !> Right sides use the given terms: film equation in the roughness, Reynolds equation in the carried terms, load
   !> balance in its carried term:
   !>
   !>     H_c = I H_f + K_c(P_c - I P_f) - (Delta_c - Delta_f)
   !>     R_c(P_c, H_c) = R_c(I P_f, I H_f) - I R_f
   !>     load_c(P_c, Delta_c) = load_c(I P_f, Delta_f) - load_f(P_f, Delta_f)
   !>
   !> R_f is restricted by full weighting of the nodes that are not cavitated, by injection to cavitated nodes.
   subroutine restrict(self, problem, fine, fine_given)
      class(fas_level_t), intent(inout) :: self
      type(contact_problem_t), intent(inout) :: problem     !! problem of this level
      type(fas_level_t), intent(in) :: fine                 !! evaluated
      type(given_t), intent(in) :: fine_given               !! with this
      real(dp), allocatable :: rough(:, :), weighted(:, :), dropped(:, :)
      integer :: j

      associate (grid => problem%grid, given => self%given, state => self%state, r => fine%equations%residual)
         call inject(grid, fine%state%p, state%p)
         call inject(grid, fine%state%h, state%h)
         state%delta = fine%state%delta
         allocate (rough, weighted, mold=state%p)
         call problem%deformation%apply(state%p, rough)
         !$omp parallel do schedule(static) if (is_shared(size(rough)))
         do j = 0, grid%ny
            rough(:, j) = state%h(:, j) + state%delta - problem%smooth_gap(j) - rough(:, j)
         end do
         call given%set_rough(rough)
         given%edge_rough = problem%edges%rough_from(fine%equations%edges, fine_given, grid%row_ratio)
         given%transport%wedge_t = implicit_part(fine_given%transport, grid)
         if (allocated(given%transport%carried)) deallocate (given%transport%carried)
         call self%evaluate(problem, given)
         allocate (dropped, mold=r)
         !$omp parallel do schedule(static) if (is_shared(size(r)))
         do j = 0, ubound(r, 2)
            dropped(:, j) = merge(0.0_dp, r(:, j), fine%equations%is_cavitated(:, j))
         end do
         call full_weighting(grid, dropped, weighted)
         allocate (given%transport%carried, mold=state%p)
         !$omp parallel do schedule(static) if (is_shared(size(weighted)))
         do j = 0, grid%ny
            where (fine%equations%is_cavitated(::2, j*grid%row_ratio)) weighted(:, j) = r(::2, j*grid%row_ratio)
            given%transport%carried(:, j) = self%equations%residual(:, j) - weighted(:, j)
         end do
         call self%evaluate(problem, given)

         given%load = fine_given%load
         given%load%carried = 0
         given%load%carried = fine%equations%load_residual(fine_given, fine%state) &
                              - self%equations%load_residual(given, state)
         self%restricted = state
      end associate
   end subroutine restrict

   !> Add the change of the coarse state to the state of this level, where there is pressure, and evaluate; no pressure
   !> falls below zero.
   subroutine correct(self, problem, given, coarse)
      class(fas_level_t), intent(inout) :: self
      type(contact_problem_t), intent(inout) :: problem     !! problem of this level
      type(given_t), intent(in) :: given                    !! to it
      type(fas_level_t), intent(in) :: coarse               !! solved
      type(step_limit_t) :: limit
      integer :: j

      associate (state => self%state, next => self%next)
         call prolong(coarse%equations%mesh%grid, coarse%state%p - coarse%restricted%p, next%p)
         !$omp parallel do schedule(static) if (is_shared(size(state%p)))
         do j = 0, problem%grid%ny
            where (self%equations%scale(:, j) > 0 .and. .not. self%equations%is_cavitated(:, j))
               next%p(:, j) = max(0.0_dp, state%p(:, j) + limit%bounded(next%p(:, j)))
            elsewhere
               next%p(:, j) = state%p(:, j)
            end where
         end do
         next%delta = state%delta + coarse%state%delta - coarse%restricted%delta
         call problem%film(given, next%p, next%delta, next%h)
         call limit%shorten(state, next)
         call state%exchange(next)
      end associate
      call self%evaluate(problem, given)
   end subroutine correct

end module ehlwave_fas_level
