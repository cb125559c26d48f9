!> Full approximation scheme (FAS): the coarse problem of a fine state, and the correction from its solution.
module ehlwave_fas_transfer
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_kinds, only: dp
   use ehlwave_line_relaxation, only: line_relaxation_t
   use ehlwave_state, only: state_t
   use ehlwave_step_limit, only: limit_step
   use ehlwave_transfer, only: full_weighting => restrict, inject, prolong
   use ehlwave_transport, only: implicit_part
   implicit none (type, external)
   private
   public :: restrict, correct

contains

   !> Coarse problem whose solution is the injected fine state when that state solves the fine problem.
   !>
   !> Right sides go where the problem has room for them: that of the film equation into the roughness, that of
   !> Reynolds into the carried terms, that of the load balance into its carried term:
   !>
   !>     H_c = I H_f + K_c(P_c - I P_f) - (Delta_c - Delta_f)
   !>     R_c(P_c, H_c) = R_c(I P_f, I H_f) - I R_f
   !>     load_c(P_c, Delta_c) = load_c(I P_f, Delta_f) - load_f(P_f, Delta_f)
   !>
   !> R_f is restricted by full weighting of the nodes that are not cavitated, by injection to cavitated ones.
   subroutine restrict(fine, fine_state, fine_relaxation, coarse, coarse_state, coarse_relaxation)
      type(contact_problem_t), intent(in) :: fine
      type(state_t), intent(in) :: fine_state
      type(line_relaxation_t), intent(in) :: fine_relaxation          !! evaluated at the fine state
      type(contact_problem_t), intent(inout) :: coarse
      type(state_t), intent(inout) :: coarse_state                    !! the injected state on return
      type(line_relaxation_t), intent(inout) :: coarse_relaxation     !! evaluated at it on return
      real(dp), allocatable :: weighted(:, :), dropped(:, :)
      integer :: i, j

      associate (grid => coarse%grid, r => fine_relaxation%residual)
         coarse%transport = implicit_part(fine%transport, grid)
         allocate (coarse%transport%carried(0:grid%nx, 0:grid%ny), source=0.0_dp)
         call inject(grid, fine_state%p, coarse_state%p)
         coarse_state%delta = fine_state%delta
         if (.not. allocated(coarse%rough)) allocate (coarse%rough(0:grid%nx, 0:grid%ny))
         call coarse%deformation%apply(coarse_state%p, coarse%rough)
         call inject(grid, fine_state%h, coarse_state%h)
         coarse%rough = coarse_state%h + coarse_state%delta - coarse%smooth_gap - coarse%rough

         call coarse_relaxation%evaluate(coarse, coarse_state)
         allocate (weighted(0:grid%nx, 0:grid%ny), dropped(0:fine%grid%nx, 0:fine%grid%ny))
         dropped = merge(0.0_dp, r, fine_relaxation%is_cavitated)
         call full_weighting(grid, dropped, weighted)
         do j = 0, grid%ny
            do i = 0, grid%nx
               if (fine_relaxation%is_cavitated(2*i, 2*j)) weighted(i, j) = r(2*i, 2*j)
            end do
         end do
         coarse%transport%carried = coarse_relaxation%residual - weighted
         call coarse_relaxation%evaluate(coarse, coarse_state)

         coarse%load = fine%load
         coarse%load%carried = 0
         coarse%load%carried = fine%load%residual(fine%grid%integral(fine_state%p), fine_state%delta) &
                               - coarse%load%residual(grid%integral(coarse_state%p), coarse_state%delta)
      end associate
   end subroutine restrict

   !> Add the change of the coarse state to the fine one, where there is pressure; no pressure falls below zero.
   subroutine correct(coarse, before, after, fine, is_cavitated, state)
      type(contact_problem_t), intent(in) :: coarse
      type(state_t), intent(in) :: before, after          !! coarse states as restricted and as solved
      type(contact_problem_t), intent(inout) :: fine
      logical, intent(in) :: is_cavitated(0:, 0:)         !! fine nodes that keep their pressure
      type(state_t), intent(inout) :: state
      real(dp), allocatable :: change(:, :)
      type(state_t) :: before_step

      before_step = state
      allocate (change, mold=state%p)
      call prolong(coarse%grid, after%p - before%p, change)
      where (.not. is_cavitated) state%p = max(0.0_dp, state%p + change)
      state%p(0, :) = 0
      state%p(fine%grid%nx, :) = 0
      state%p(:, fine%grid%ny) = 0
      if (fine%grid%first_row > 0) state%p(:, 0) = 0
      state%delta = state%delta + after%delta - before%delta
      call fine%film(state%p, state%delta, state%h)
      call limit_step(before_step, state)
   end subroutine correct

end module ehlwave_fas_transfer
