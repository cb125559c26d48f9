!> A contact with less oil than it could take, in the plan of a case: theory eq. (C3) to (C8).
module ehlwave_starvation_plan
   use ehlwave_bare_plan, only: bare_plan_t, run_march
   use ehlwave_case_definition, only: case_t
   use ehlwave_conditions, only: conditions_t
   use ehlwave_effect_plan, only: effect_plan_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_formula, only: expected_film
   use ehlwave_inlet_oil, only: inlet_oil_t
   use ehlwave_kinds, only: dp
   use ehlwave_layer_change_plan, only: change_times, measured_share
   use ehlwave_oil_offer_plan, only: check_inlet, expected_oil, narrow_lane_text, read_oil
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_resolution, only: add_reason
   use ehlwave_text, only: harmless, to_text
   implicit none (type, external)
   private
   public :: expected_meniscus_error

   !> Largest hX over the distance from the contact's edge to the meniscus that resolves its answer to waves: Ad/Ai is
   !> then 8 per cent off, with 0.44 40 per cent (M = 100, D = 1, r = 0.5). The film needs no such grid: with 0.7 to 1.2
   !> R is 2 per cent off, for the less oil there is the less the inlet decides.
   real(dp), parameter :: coarsest_meniscus = 0.25_dp
   real(dp), parameter :: share_of_meniscus = 0.5_dp !! share of the accuracy for the meniscus
   real(dp), parameter :: meniscus_factor = 0.35_dp  !! see expected_meniscus_error
   real(dp), parameter :: steady_cost = 2.7_dp       !! cost of a steady state over the flooded state
                                                     !! on the way; measured: 2 to 4
   real(dp), parameter :: step_cost = 1.3_dp         !! cost of a time step without patches

   type, extends(effect_plan_t), public :: starvation_plan_t
      type(inlet_oil_t) :: oil           !! offered, where it is less than floods the contact
      real(dp) :: before_change = 0  !! oil at Y = 0 before a change of the layer, over the flow of the flooded contact
      real(dp) :: distance = 0           !! expected distance of the meniscus from the contact; 0: flooded
      real(dp) :: resolution = 0         !! hX over it, 0: flooded
   contains
      procedure, nopass :: check => check_inlet
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
   end type starvation_plan_t

contains

   subroutine make(self, case, plan, error)
      class(starvation_plan_t), intent(inout) :: self
      type(case_t), intent(in) :: case
      class(bare_plan_t), intent(inout) :: plan
      type(error_t), allocatable, intent(inout) :: error
      call read_oil(case%effects%starvation, plan%conditions, self%oil, plan%files, error)
      if (allocated(error) .or. .not. self%oil%is_short()) return
      self%before_change = expected_oil(self%oil, plan%conditions, plan%rheology)
      self%distance = meniscus_distance(plan%conditions, measured_share(case)*self%before_change)
   end subroutine make

   !> Distance in X from the edge of the contact to the meniscus at Y = 0 to expect: 2 H^(2/3) r^1.6 with H of the
   !> flooded film. Measured on 144 contacts of the stability map, r = 0.3 to 1.2: right within a factor of 2.5.
   pure real(dp) function meniscus_distance(conditions, oil)
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: oil     !! r, offered oil over the flow of the flooded contact
      meniscus_distance = 2*expected_film(conditions)**(2/3.0_dp)*oil**1.6_dp
   end function meniscus_distance

   logical function is_even(self)
      class(starvation_plan_t), intent(in) :: self
      is_even = self%oil%is_even()
   end function is_even

   logical function is_first_order(self)
      class(starvation_plan_t), intent(in) :: self
      is_first_order = self%oil%is_short()
   end function is_first_order

   subroutine limit_mesh(self, accuracy, surfaces_are_rough, mesh, reason)
      class(starvation_plan_t), intent(in) :: self
      real(dp), intent(in) :: accuracy
      logical, intent(in) :: surfaces_are_rough
      real(dp), intent(inout) :: mesh
      character(len=:), allocatable, intent(inout) :: reason
      real(dp) :: largest
      if (.not. (self%distance > 0 .and. surfaces_are_rough)) return
      largest = coarsest_meniscus*self%distance
      if (accuracy > 0) largest = min(largest, share_of_meniscus*accuracy*self%distance/meniscus_factor)
      if (largest >= mesh) return
      mesh = largest
      reason = 'for the meniscus, hX <= '//to_text(mesh, 2)
   end subroutine limit_mesh

   subroutine judge(self, plan)
      class(starvation_plan_t), intent(inout) :: self
      class(bare_plan_t), intent(inout) :: plan
      if (self%distance > 0) self%resolution = plan%hx/self%distance
      if (self%resolution > coarsest_meniscus .and. plan%surfaces%is_rough()) call add_reason(plan%resolution%reason, &
         'waves move the meniscus, which is about '//to_text(self%distance, 2)//' a ahead of the contact: '// &
         'use hX <= '//to_text(coarsest_meniscus*self%distance, 2))
      if (.not. plan%conditions%is_line()) &
         call add_reason(plan%resolution%reason, narrow_lane_text(self%oil, plan%y_max, plan%hy))
      plan%resolution%is_resolved = len(plan%resolution%reason) == 0
   end subroutine judge

   pure function error_name() result(name)
      character(len=:), allocatable :: name
      name = 'meniscus'
   end function error_name

   pure function error_help() result(help)
      character(len=:), allocatable :: help
      help = 'the meniscus of a contact with too little oil'
   end function error_help

   real(dp) function expect_ratio_error(self) result(error)
      class(starvation_plan_t), intent(in) :: self
      error = expected_meniscus_error(self%resolution)
   end function expect_ratio_error

   !> Relative error of Ad/Ai of a contact with too little oil by the meniscus, theory eq. (C8), of first order:
   !> c hX/(its distance from the contact). A response resolves the meniscus to a cell. As the mesh is refined and
   !> nodes pass by it, Ad/Ai goes up and down.
   pure real(dp) function expected_meniscus_error(hx_over_distance)
      real(dp), intent(in) :: hx_over_distance   !! 0 of flooded contacts
      expected_meniscus_error = meniscus_factor*hx_over_distance
   end function expected_meniscus_error

   subroutine multiply_cost(self, steady, step)
      class(starvation_plan_t), intent(in) :: self
      real(dp), intent(inout) :: steady, step
      if (.not. self%oil%is_short()) return
      steady = steady_cost*steady
      step = step_cost*step
   end subroutine multiply_cost

   subroutine delay(self, case, plan, place, passed, rest)
      class(starvation_plan_t), intent(in) :: self
      type(case_t), intent(in) :: case
      class(bare_plan_t), intent(in) :: plan
      real(dp), intent(in) :: place
      real(dp), intent(inout) :: passed, rest
      real(dp) :: change_passed, change_rest, oil
      associate (keys => case%effects%starvation)
         if (.not. keys%layer_changes()) return
         oil = self%before_change*max(1.0_dp, keys%oil_change_factor)
         call change_times(keys, plan%conditions, meniscus_distance(plan%conditions, oil), plan%x_min, place, &
                           change_passed, change_rest)
      end associate
      passed = max(passed, change_passed)
      rest = max(rest, change_rest)
   end subroutine delay

   subroutine check_run(case, kind, end_time, error)
      type(case_t), intent(in) :: case
      integer, intent(in) :: kind
      real(dp), intent(in) :: end_time
      type(error_t), allocatable, intent(inout) :: error
      associate (keys => case%effects%starvation)
         if (.not. keys%layer_changes()) return
         if (kind /= run_march) then
            call raise(error, '&inlet oil_change_factor: give &dynamics end_time, to which is marched: no waves move')
         else if (keys%oil_change_start >= end_time) then
            call raise(error, '&inlet oil_change_start = '//to_text(keys%oil_change_start, 6)//' is not before the '// &
                       'end of the march, T = '//to_text(end_time, 6)//': the layer would never change; start '// &
                       'earlier'//trim(merge(', or give a later &dynamics end_time', repeat(' ', 36), &
                       case%end_time > 0)))
         end if
      end associate
   end subroutine check_run

   function line(self, case, plan) result(text)
      class(starvation_plan_t), intent(in) :: self
      type(case_t), intent(in) :: case
      class(bare_plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      text = ''
      if (.not. self%oil%is_short()) return
      associate (keys => case%effects%starvation)
         if (keys%oil_layer_m > 0) then
            text = 'layers of oil of '//to_text(keys%oil_layer_m*1e6_dp, 5)//' um together'
         else
            text = to_text(keys%oil_over_flooded, 5)//' of the oil that the flooded contact passes'
         end if
         if (keys%oil_profile /= '') text = text//', across by '//harmless(trim(keys%oil_profile))
         if (abs(keys%oil_change_factor - 1) > 0) text = text//'; changes by '//to_text(keys%oil_change_factor, 4)// &
            ' at T = '//to_text(keys%oil_change_start, 4)
      end associate
      if (plan%rest > 0) text = text//'; the film should have followed at T = '//to_text(plan%rest, 4)
      text = 'Inlet        starved: '//text
   end function line

   subroutine add_quantities(self, list)
      class(starvation_plan_t), intent(in) :: self
      type(quantity_list_t), intent(inout) :: list
      call list%add('meniscus_resolution', &
         'hX over the expected distance of the meniscus from the contact, 0: flooded', self%resolution)
   end subroutine add_quantities

end module ehlwave_starvation_plan
