!> Continuation from a solved problem to an unsolved problem, and its paths in M and L and in the stress of the flow
!> law.
module ehlwave_continuation
   use ehlwave_conditions, only: conditions_from_moes, conditions_t
   use ehlwave_errors, only: error_t
   use ehlwave_hierarchy, only: hierarchy_t
   use ehlwave_kinds, only: dp
   use ehlwave_rheology, only: rheology_t
   implicit none (type, external)
   private

   real(dp), parameter :: load_ratio = 4       !! M of a case over M of its neighbour at distance 1
   real(dp), parameter :: viscous_ratio = 2    !! ratio of L, from distance 2 on
   real(dp), parameter :: stress_ratio = 100   !! stress of the flow law of the neighbour at distance 0 over the stress
                                               !! of a
                                               !! case
   real(dp), parameter :: smallest_step = 0.02_dp

   !> Place on a path from 0 (solved) to 1 (target), with steps that grow and shrink.
   type, public :: adaptive_path_t
      real(dp) :: place = 0                    !! where to solve next
      real(dp), private :: solved = 0          ! the farthest place that was solved
      real(dp), private :: step = 0.5_dp
   contains
      procedure :: advance
      procedure :: is_at_end
      procedure :: can_retry
   end type adaptive_path_t

   !> A contact with smaller M, and smaller L if it is farther away, with the same D; or the same contact with an oil
   !> that is more nearly Newtonian.
   type, public :: neighbour_t
      type(conditions_t), private :: goal
      type(rheology_t), private :: goal_rheology
      real(dp), private :: m = 0, l = 0, stress = 1   ! stress of the flow law over the case's
   contains
      procedure :: choose
      procedure :: impose
   end type neighbour_t

contains

   !> Choose the next place: farther on after a success, nearer after a failure.
   pure subroutine advance(self, is_solved)
      class(adaptive_path_t), intent(inout) :: self
      logical, intent(in) :: is_solved   !! whether the solve at `place` succeeded
      if (is_solved) then
         if (self%place > 0) self%step = 2*self%step
         self%solved = self%place
      else
         self%step = 0.5_dp*min(self%step, 1 - self%solved)
      end if
      self%place = min(1.0_dp, self%solved + self%step)
      if (1 - self%place < 0.5_dp*smallest_step) self%place = 1
   end subroutine advance

   pure logical function is_at_end(self)
      class(adaptive_path_t), intent(in) :: self
      is_at_end = self%place >= 1
   end function is_at_end

   !> Whether a shorter step than the failed step is worth a try.
   pure logical function can_retry(self)
      class(adaptive_path_t), intent(in) :: self
      can_retry = self%place > self%solved .and. 0.5_dp*min(self%step, 1 - self%solved) >= smallest_step
   end function can_retry

   !> Neighbour of the contact of a hierarchy: M/4, (M/16, L/2), (M/64, L/4), ... At distance 0 that with the other oil.
   subroutine choose(self, hierarchy, distance)
      class(neighbour_t), intent(inout) :: self
      type(hierarchy_t), intent(in) :: hierarchy
      integer, intent(in) :: distance   !! 1, 2, ..., of oils that are not Newtonian 0, too
      associate (problem => hierarchy%levels(1)%problem)
         self%goal = problem%conditions
         self%goal_rheology = problem%rheology
      end associate
      self%m = self%goal%m/load_ratio**distance
      self%l = self%goal%l/viscous_ratio**max(0, distance - 1)
      self%stress = merge(stress_ratio, 1.0_dp, distance == 0)
   end subroutine choose

   !> Give all levels the contact at a place between the neighbour (0) and the case itself (1, to the last digit):
   !> M and the stress geometrically, L linearly in between. Grids and kernels stay, since they depend on D only.
   subroutine impose(self, hierarchy, place)
      class(neighbour_t), intent(in) :: self
      type(hierarchy_t), intent(inout) :: hierarchy
      real(dp), intent(in) :: place
      type(conditions_t) :: conditions
      type(error_t), allocatable :: error
      type(rheology_t) :: rheology

      conditions = self%goal
      rheology = self%goal_rheology
      if (place < 1) then
         call conditions_from_moes(self%m*(self%goal%m/self%m)**place, self%l + (self%goal%l - self%l)*place, &
                                   self%goal%d, self%goal%alpha_per_pa, conditions, error)
         if (allocated(error)) return   ! impossible: M and L lie in the accepted range
         conditions%slip_parameter = self%goal%slip_parameter
         rheology = self%goal_rheology%at_pressure(conditions%hertz_pressure_pa)
         rheology = rheology%with_stress(self%stress**(1 - place))
      end if
      call hierarchy%set_conditions(conditions, rheology)
   end subroutine impose

end module ehlwave_continuation
