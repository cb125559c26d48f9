!> The list of effects in the plan of a case. A new effect is a component and a line of `effect`.
module ehlwave_effects_plan
   use ehlwave_bare_plan, only: bare_plan_t
   use ehlwave_case_definition, only: case_t
   use ehlwave_effect_plan, only: effect_plan_t
   use ehlwave_effects_keys, only: effect_count
   use ehlwave_error_parts, only: error_parts_t
   use ehlwave_errors, only: error_t
   use ehlwave_heat_plan, only: heat_plan_t
   use ehlwave_kinds, only: dp
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_second_surface_plan, only: second_surface_plan_t
   use ehlwave_starvation_plan, only: starvation_plan_t
   use ehlwave_touching_plan, only: touching_plan_t
   implicit none (type, external)
   private
   public :: error_name, error_help

   type, public :: effects_plan_t
      type(heat_plan_t) :: heat
      type(touching_plan_t) :: touching
      type(second_surface_plan_t) :: second
      type(starvation_plan_t) :: starvation
   contains
      procedure :: effect
      procedure :: complete
      procedure :: check_data
      procedure :: check
      procedure :: make
      procedure :: are_even
      procedure :: are_first_order
      procedure :: limit_mesh
      procedure :: judge
      procedure :: expect_ratio_error
      procedure :: multiply_cost
      procedure :: delay
      procedure :: check_run
      procedure :: print
      procedure :: add_quantities
   end type effects_plan_t

contains

   !> Effect number k, in the order of `effects_keys`.
   function effect(self, k) result(one)
      class(effects_plan_t), target :: self
      integer, intent(in) :: k
      class(effect_plan_t), pointer :: one
      select case (k)
      case (1); one => self%heat
      case (2); one => self%touching
      case (3); one => self%second
      case default; one => self%starvation
      end select
   end function effect

   !> Name of the part of errors by effect number k, as in film_error_NAME; '': none.
   function error_name(k) result(name)
      integer, intent(in) :: k
      character(len=:), allocatable :: name
      type(effects_plan_t), target :: effects
      class(effect_plan_t), pointer :: one
      one => effects%effect(k)
      name = one%error_name()
   end function error_name

   !> Source of the part, as in "the same by ...".
   function error_help(k) result(help)
      integer, intent(in) :: k
      character(len=:), allocatable :: help
      type(effects_plan_t), target :: effects
      class(effect_plan_t), pointer :: one
      one => effects%effect(k)
      help = one%error_help()
   end function error_help

   !> Give other parts of a case their data from its effects.
   subroutine complete(self, case)
      class(effects_plan_t), intent(in), target :: self
      type(case_t), intent(inout) :: case
      class(effect_plan_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         call one%complete(case)
      end do
   end subroutine complete

   !> Refuse data of the effects that are not complete, before the case is completed.
   subroutine check_data(self, case, error)
      class(effects_plan_t), intent(in), target :: self
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error
      class(effect_plan_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         if (.not. allocated(error)) call one%check_data(case, error)
      end do
   end subroutine check_data

   !> Refuse an input that contradicts an effect.
   subroutine check(self, case, error)
      class(effects_plan_t), intent(in), target :: self
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error
      class(effect_plan_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         if (.not. allocated(error)) call one%check(case, error)
      end do
   end subroutine check

   !> Make the effects of a case, before the grid is chosen.
   subroutine make(self, case, plan, error)
      class(effects_plan_t), intent(inout), target :: self
      type(case_t), intent(in) :: case
      class(bare_plan_t), intent(inout) :: plan
      type(error_t), allocatable, intent(inout) :: error
      class(effect_plan_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         if (.not. allocated(error)) call one%make(case, plan, error)
      end do
   end subroutine make

   !> Whether all effects are even in Y.
   logical function are_even(self)
      class(effects_plan_t), intent(in), target :: self
      class(effect_plan_t), pointer :: one
      integer :: k
      are_even = .true.
      do k = 1, effect_count
         one => self%effect(k)
         are_even = are_even .and. one%is_even()
      end do
   end function are_even

   !> Whether errors by the mesh are of first order for an effect.
   logical function are_first_order(self)
      class(effects_plan_t), intent(in), target :: self
      class(effect_plan_t), pointer :: one
      integer :: k
      are_first_order = .false.
      do k = 1, effect_count
         one => self%effect(k)
         are_first_order = are_first_order .or. one%is_first_order()
      end do
   end function are_first_order

   !> The largest hX of a chosen grid that the effects allow, and the reason for people.
   subroutine limit_mesh(self, accuracy, surfaces_are_rough, mesh, reason)
      class(effects_plan_t), intent(in), target :: self
      real(dp), intent(in) :: accuracy               !! 0: none
      logical, intent(in) :: surfaces_are_rough
      real(dp), intent(out) :: mesh
      character(len=:), allocatable, intent(out) :: reason
      class(effect_plan_t), pointer :: one
      integer :: k
      mesh = huge(mesh)
      reason = ''
      do k = 1, effect_count
         one => self%effect(k)
         call one%limit_mesh(accuracy, surfaces_are_rough, mesh, reason)
      end do
   end subroutine limit_mesh

   !> Note in the plan's resolution any scale of the effects that the grid does not resolve.
   subroutine judge(self, plan)
      class(effects_plan_t), intent(inout), target :: self
      class(bare_plan_t), intent(inout) :: plan
      class(effect_plan_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         call one%judge(plan)
      end do
   end subroutine judge

   !> Parts of the error of Ad/Ai to expect by the effects.
   subroutine expect_ratio_error(self, parts)
      class(effects_plan_t), intent(in), target :: self
      type(error_parts_t), intent(inout) :: parts
      class(effect_plan_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         parts%by_effect(k) = one%expect_ratio_error()
      end do
   end subroutine expect_ratio_error

   !> Multiply the cost of steady states and of time steps by the cost factors of the effects.
   subroutine multiply_cost(self, steady, step)
      class(effects_plan_t), intent(in), target :: self
      real(dp), intent(inout) :: steady, step
      class(effect_plan_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         call one%multiply_cost(steady, step)
      end do
   end subroutine multiply_cost

   !> Delay the times T at which all changes have passed a place, and from which on they should no longer move the film.
   subroutine delay(self, case, plan, place, passed, rest)
      class(effects_plan_t), intent(in), target :: self
      type(case_t), intent(in) :: case
      class(bare_plan_t), intent(in) :: plan
      real(dp), intent(in) :: place                  !! X
      real(dp), intent(inout) :: passed, rest
      class(effect_plan_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         call one%delay(case, plan, place, passed, rest)
      end do
   end subroutine delay

   !> Refuse an effect that the run does not show.
   subroutine check_run(self, case, kind, end_time, error)
      class(effects_plan_t), intent(in), target :: self
      type(case_t), intent(in) :: case
      integer, intent(in) :: kind                    !! kind of run, see `bare_plan`
      real(dp), intent(in) :: end_time               !! T to which is marched
      type(error_t), allocatable, intent(inout) :: error
      class(effect_plan_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         if (.not. allocated(error)) call one%check_run(case, kind, end_time, error)
      end do
   end subroutine check_run

   !> Print a line for each effect of the case.
   subroutine print(self, unit, case, plan)
      class(effects_plan_t), intent(in), target :: self
      integer, intent(in) :: unit
      type(case_t), intent(in) :: case
      class(bare_plan_t), intent(in) :: plan
      class(effect_plan_t), pointer :: one
      character(len=:), allocatable :: text
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         text = one%line(case, plan)
         if (text /= '') write (unit, '(a)') text
      end do
   end subroutine print

   !> Add the quantities of the plan.
   subroutine add_quantities(self, list)
      class(effects_plan_t), intent(in), target :: self
      type(quantity_list_t), intent(inout) :: list
      class(effect_plan_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         call one%add_quantities(list)
      end do
   end subroutine add_quantities

end module ehlwave_effects_plan
