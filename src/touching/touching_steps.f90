!> Steps of Newton's method for a contact whose surfaces may touch: their length, and the sets after them.
module ehlwave_touching_steps
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_given, only: given_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_touching_change, only: touching_change_t
   use ehlwave_touching_state, only: touching_law_t, touching_state_t
   implicit none (type, external)
   private
   public :: touch_first

   real(dp), parameter :: largest_change_p = 0.3_dp      !! of P in a step; where solids bear it holds node by node
   real(dp), parameter :: largest_marched_p = 1          !! of P in a step of a march where no solids bear
   real(dp), parameter :: largest_change_speed = 0.3_dp  !! of ln(speed)
   real(dp), parameter :: largest_change_c = 2           !! of ln(C), soft law
   real(dp), parameter :: least_gap = 0.5_dp             !! gap over the boundary film at which solids may leave
   integer, parameter :: most_halvings = 3               !! parts 1/2, 1/3, 1/4 of steps where sets return

   !> Account of the steps of a solve.
   type, public :: touching_steps_t
      logical :: are_settled = .false.           !! whether the last step left all sets unchanged
      integer, private :: returns = 0            !! steps in a row after which the sets were those before the last
      logical, allocatable, private :: last(:, :), before(:, :)   !! sets, (nodes, touching or cavitated)
   contains
      procedure :: take
   end type touching_steps_t

contains

   !> Let the solids touch where the film is thinnest, so that there is a node to bear the share.
   subroutine touch_first(state)
      type(touching_state_t), intent(inout) :: state
      integer :: node(2)
      associate (n => shape(state%h))
         node = minloc(state%h(1:n(1) - 2, :)) + [0, -1]
      end associate
      state%is_touching(node(1), node(2)) = .true.
      state%c(node(1), node(2)) = 1e-3_dp
   end subroutine touch_first

   !> Take a limited step and choose the sets anew, theory section 8.2. Steps after which two sets alternate are cut.
   subroutine take(self, problem, law, given, marches, change, gap, state)
      class(touching_steps_t), intent(inout) :: self
      type(contact_problem_t), intent(inout) :: problem
      type(touching_law_t), intent(in) :: law
      type(given_t), intent(in) :: given
      logical, intent(in) :: marches
      type(touching_change_t), intent(in) :: change
      real(dp), intent(inout), contiguous :: gap(0:, 0:)  !! work space
      type(touching_state_t), intent(inout) :: state
      logical, allocatable :: leaves(:, :), sets(:, :)
      real(dp) :: part

      part = length_of(marches, state, change)/(1 + self%returns)
      call change_pressures(law, marches, part, change, state, leaves)
      state%delta = state%delta + part*change%delta
      state%speed = state%speed*exp(part*change%ln_speed)
      call problem%film(given, max(state%p, 0.0_dp) + state%c, state%delta, gap)
      if (.not. law%is_soft) leaves = leaves .and. (gap > least_gap*law%film .or. .not. marches)
      call choose_sets(problem%grid, law, gap, leaves, state)
      sets = reshape([state%is_touching, state%is_cavitated], [size(state%p), 2])
      self%are_settled = .false.
      if (allocated(self%last)) self%are_settled = all(sets .eqv. self%last)
      if (self%are_settled .or. .not. allocated(self%before)) then
         self%returns = 0
      else if (marches .and. all(sets .eqv. self%before)) then
         self%returns = min(self%returns + 1, most_halvings)
      else
         self%returns = 0
      end if
      call move_alloc(self%last, self%before)
      call move_alloc(sets, self%last)
   end subroutine take

   !> Part of a change that is taken, in a march: the oil's pressure where no solids bear changes within a limit, and no
   !> further than to 0. In steady states a narrower limit holds everywhere.
   pure real(dp) function length_of(marches, state, change) result(part)
      logical, intent(in) :: marches
      type(touching_state_t), intent(in) :: state
      type(touching_change_t), intent(in) :: change
      real(dp) :: over
      if (marches) then
         over = maxval(max(change%p, min(state%p, -change%p)), mask=.not. (state%is_cavitated .or. state%is_touching)) &
                /largest_marched_p
      else
         over = maxval(abs(change%p), mask=.not. state%is_cavitated)/largest_change_p
      end if
      part = 1/max(1.0_dp, over, abs(change%ln_speed)/largest_change_speed)
   end function length_of

   !> Change P, theta and C. Where hard solids leave in a march, the oil takes over all the pressure: so the gap is not
   !> disturbed. In steady states of thin films the oil would be left with far too much pressure.
   pure subroutine change_pressures(law, marches, part, change, state, leaves)
      type(touching_law_t), intent(in) :: law
      logical, intent(in) :: marches
      real(dp), intent(in) :: part
      type(touching_change_t), intent(in) :: change
      type(touching_state_t), intent(inout) :: state
      logical, allocatable, intent(out) :: leaves(:, :)
      real(dp), allocatable :: total(:, :)

      total = state%p + state%c + part*(change%c + merge(0.0_dp, change%p, state%is_cavitated))
      where (state%is_cavitated)
         state%theta = state%theta + part*change%p
      elsewhere (state%is_touching)
         state%p = state%p + max(-largest_change_p, min(largest_change_p, part*change%p))
      elsewhere
         state%p = state%p + part*change%p
      end where
      if (law%is_soft) then
         where (state%is_touching) &
            state%c = state%c*exp(max(-largest_change_c, min(largest_change_c, part*change%c/state%c)))
         return
      end if
      leaves = state%is_touching .and. state%c + part*change%c <= 0
      state%c = total - state%p
      if (marches) where (leaves .and. .not. state%is_cavitated) state%p = max(total, 0.0_dp)
      where (leaves .or. .not. state%is_touching) state%c = 0
   end subroutine change_pressures

   !> Solids leave where C < 0 and bear where the gap is below the boundary film. The film breaks where P < 0 and is
   !> full where theta > 1.
   pure subroutine choose_sets(grid, law, gap, leaves, state)
      type(grid_t), intent(in) :: grid
      type(touching_law_t), intent(in) :: law
      real(dp), intent(in) :: gap(0:, 0:)
      logical, allocatable, intent(in) :: leaves(:, :)     !! hard solids that C < 0 lets go
      type(touching_state_t), intent(inout) :: state
      logical, dimension(0:grid%nx, 0:grid%ny) :: bears, breaks, is_unknown

      is_unknown = .false.
      is_unknown(1:grid%nx - 1, grid%first_row:grid%last_row) = .true.
      breaks = is_unknown .and. merge(state%theta <= 1, state%p < 0, state%is_cavitated)
      bears = is_unknown .and. law%touches(gap)
      if (law%is_soft) then
         where (bears .and. .not. state%is_touching) state%c = law%first_pressure(gap)
      else
         bears = is_unknown .and. merge(.not. leaves, bears, state%is_touching)
      end if
      state%is_touching = bears
      state%is_cavitated = breaks
      where (.not. bears) state%c = 0
      where (breaks .or. state%p < 0) state%p = 0
      where (.not. breaks) state%theta = 1
   end subroutine choose_sets

end module ehlwave_touching_steps
