!> A physical effect in the plan of a case: checks, and requirements on grid, time steps and work.
!>
!> An effect overrides the procedures that concern it; the procedures here do nothing.
module ehlwave_effect_plan
   use ehlwave_bare_plan, only: bare_plan_t
   use ehlwave_case_definition, only: case_t
   use ehlwave_error_parts, only: error_parts_t
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_quantity, only: quantity_list_t
   implicit none (type, external)
   private

   type, abstract, public :: effect_plan_t
   contains
      procedure, nopass :: complete
      procedure, nopass :: check_data
      procedure, nopass :: check
      procedure :: make
      procedure :: is_even
      procedure :: is_first_order
      procedure :: limit_mesh
      procedure :: judge
      procedure, nopass :: error_name
      procedure, nopass :: error_help
      procedure :: expect_ratio_error
      procedure :: multiply_cost
      procedure :: delay
      procedure, nopass :: check_run
      procedure :: line
      procedure :: add_quantities
   end type effect_plan_t

contains

   !> Give other parts of a case their data from the effect.
   subroutine complete(case)
      type(case_t), intent(inout) :: case
   end subroutine complete

   !> Refuse data of the effect that are not complete, before the case is completed.
   subroutine check_data(case, error)
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error
   end subroutine check_data

   !> Refuse an input that contradicts the effect.
   subroutine check(case, error)
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error
   end subroutine check

   !> Make the effect of a case; may note digests of files in the plan. The grid is not known yet.
   subroutine make(self, case, plan, error)
      class(effect_plan_t), intent(inout) :: self
      type(case_t), intent(in) :: case
      class(bare_plan_t), intent(inout) :: plan
      type(error_t), allocatable, intent(inout) :: error
   end subroutine make

   !> Whether the effect is even in Y.
   logical function is_even(self)
      class(effect_plan_t), intent(in) :: self
      is_even = .true.
   end function is_even

   !> Whether errors by the mesh are of first order.
   logical function is_first_order(self)
      class(effect_plan_t), intent(in) :: self
      is_first_order = .false.
   end function is_first_order

   !> Reduce the largest hX of a chosen grid, with the reason for people.
   subroutine limit_mesh(self, accuracy, surfaces_are_rough, mesh, reason)
      class(effect_plan_t), intent(in) :: self
      real(dp), intent(in) :: accuracy               !! 0: none
      logical, intent(in) :: surfaces_are_rough
      real(dp), intent(inout) :: mesh
      character(len=:), allocatable, intent(inout) :: reason
   end subroutine limit_mesh

   !> Note in the plan's resolution any unresolved scale of the chosen grid.
   subroutine judge(self, plan)
      class(effect_plan_t), intent(inout) :: self
      class(bare_plan_t), intent(inout) :: plan
   end subroutine judge

   !> Name of the part of errors by the effect, as in film_error_NAME; '': it has none.
   pure function error_name() result(name)
      character(len=:), allocatable :: name
      name = ''
   end function error_name

   !> Source of the part, as in "the same by ...".
   pure function error_help() result(help)
      character(len=:), allocatable :: help
      help = ''
   end function error_help

   !> Relative error of Ad/Ai to expect by the effect, of first order in the mesh size.
   real(dp) function expect_ratio_error(self) result(error)
      class(effect_plan_t), intent(in) :: self
      error = 0
   end function expect_ratio_error

   !> Multiply the cost of steady states and of time steps.
   subroutine multiply_cost(self, steady, step)
      class(effect_plan_t), intent(in) :: self
      real(dp), intent(inout) :: steady, step
   end subroutine multiply_cost

   !> Delay the times T at which all changes have passed a place, and from which on they should no longer move the film.
   subroutine delay(self, case, plan, place, passed, rest)
      class(effect_plan_t), intent(in) :: self
      type(case_t), intent(in) :: case
      class(bare_plan_t), intent(in) :: plan
      real(dp), intent(in) :: place                  !! X
      real(dp), intent(inout) :: passed, rest
   end subroutine delay

   !> Refuse an effect that the run does not show.
   subroutine check_run(case, kind, end_time, error)
      type(case_t), intent(in) :: case
      integer, intent(in) :: kind                    !! kind of run, see `bare_plan`
      real(dp), intent(in) :: end_time               !! T to which is marched
      type(error_t), allocatable, intent(inout) :: error
   end subroutine check_run

   !> Line of the plan for people, '' without the effect.
   function line(self, case, plan) result(text)
      class(effect_plan_t), intent(in) :: self
      type(case_t), intent(in) :: case
      class(bare_plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      text = ''
   end function line

   !> Add the quantities of the plan.
   subroutine add_quantities(self, list)
      class(effect_plan_t), intent(in) :: self
      type(quantity_list_t), intent(inout) :: list
   end subroutine add_quantities

end module ehlwave_effect_plan
