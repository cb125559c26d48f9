!> The oil as it was at the time before, whose heat a march in time goes on from: theory eq. (T9).
module ehlwave_earlier_oil
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_kinds, only: dp
   use ehlwave_state, only: state_t
   implicit none (type, external)
   private

   !> Oil at the time before.
   type, public :: earlier_t
      real(dp) :: dt = 0                                       !! time since, in units of a/ubar
      real(dp), allocatable :: f(:, :), p(:, :), rise(:, :, :) !! rho H, P and K, all nodes
      real(dp), allocatable :: before(:, :, :)                 !! K, as long before that
   contains
      procedure :: begin
      procedure :: pass
   end type earlier_t

contains

   !> From a steady state on, in steps of dT.
   pure subroutine begin(self, problem, state, dt)
      class(earlier_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem   !! with its temperatures
      type(state_t), intent(in) :: state
      real(dp), intent(in) :: dt
      self%dt = dt
      call take_oil(self, problem, state)
      self%before = self%rise
   end subroutine begin

   !> Make the present oil the oil of the earlier time.
   pure subroutine pass(self, problem, state)
      class(earlier_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem   !! with its temperatures
      type(state_t), intent(in) :: state
      call move_alloc(self%rise, self%before)
      call take_oil(self, problem, state)
   end subroutine pass

   !> The oil as it is now.
   pure subroutine take_oil(earlier, problem, state)
      class(earlier_t), intent(inout) :: earlier
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      earlier%p = state%p
      if (.not. allocated(earlier%f)) allocate (earlier%f, mold=state%p)
      earlier%f(:, :) = problem%density(state%p)*state%h
      earlier%rise = problem%heat%rise
   end subroutine take_oil

end module ehlwave_earlier_oil
