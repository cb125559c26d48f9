!> Surfaces that may touch, in the plan of a case: required data, and inputs that contradict them.
module ehlwave_touching_plan
   use ehlwave_bare_plan, only: bare_plan_t
   use ehlwave_case_definition, only: case_t
   use ehlwave_effect_plan, only: effect_plan_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   use ehlwave_roughness, only: roughness_t
   use ehlwave_text, only: to_text
   use ehlwave_touching_data, only: soft
   implicit none (type, external)
   private

   ! Cost of time steps over steps of a full film, which rises with the number of nodes, since more of them begin to
   ! touch in a step. Work over plan: 0.5 to 1.4 in 5 marches of lines (192 cells), 0.5 to 1.8 in 10 of balls (32 x 32
   ! and 48 x 48 cells), 1.2 to 1.3 in a pair of maps on 64 x 64 to 256 x 256
   real(dp), parameter :: line_cost = 2, cost = 2.7_dp, usual_cells = 48.0_dp**2, cost_growth = 0.2_dp
   ! Memory of the larger systems, bytes per cell: pairs of maps on 64 x 64 to 256 x 256 cells, within an eighth
   real(dp), parameter :: memory = 1800

   type, extends(effect_plan_t), public :: touching_plan_t
      logical :: is_given = .false.
      real(dp) :: cost = 1
   contains
      procedure :: make
      procedure :: judge
      procedure :: multiply_cost
      procedure, nopass :: complete
      procedure, nopass :: check_data
      procedure, nopass :: check
   end type touching_plan_t

contains

   !> Take the fitted scheme, which has a third of the error of the averaged one in the speed of a share.
   subroutine complete(case)
      type(case_t), intent(inout) :: case
      if (case%effects%touching%is_given() .and. case%scheme == 'auto') case%scheme = 'fitted'
   end subroutine complete

   subroutine make(self, case, plan, error)
      class(touching_plan_t), intent(inout) :: self
      type(case_t), intent(in) :: case
      class(bare_plan_t), intent(inout) :: plan
      type(error_t), allocatable, intent(inout) :: error
      self%is_given = case%effects%touching%is_given()
   end subroutine make

   !> Cost and memory on the grid that is chosen.
   subroutine judge(self, plan)
      class(touching_plan_t), intent(inout) :: self
      class(bare_plan_t), intent(inout) :: plan
      if (.not. self%is_given) return
      self%cost = line_cost
      if (plan%conditions%is_line()) return
      self%cost = cost*(real(plan%cells_x, dp)*plan%cells_y/usual_cells)**cost_growth
      plan%bytes_of_effects = plan%bytes_of_effects + memory
   end subroutine judge

   subroutine multiply_cost(self, steady, step)
      class(touching_plan_t), intent(in) :: self
      real(dp), intent(inout) :: steady, step
      if (self%is_given) step = self%cost*step
   end subroutine multiply_cost

   !> Refuse data that are not complete.
   subroutine check_data(case, error)
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error)) return
      associate (touching => case%effects%touching%data)
         if (touching%share > 0 .and. .not. touching%is_given()) then
            call raise(error, '&touching film_m is missing: write the boundary film at which solids begin to bear')
         else if (touching%is_given() .and. touching%law == soft .and. &
                  .not. min(touching%softness_m, touching%stress_pa) > 0) then
            call raise(error, "&touching law = 'soft' needs softness_m and stress_pa: write both, or law = 'hard'")
         end if
      end associate
   end subroutine check_data

   !> Refuse inputs for which touching is not built.
   subroutine check(case, error)
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error) .or. .not. case%effects%touching%is_given()) return
      if (.not. case%is_dimensional) then
         call raise(error, '&touching film_m holds metres: give &conditions by dimensional data (radius_x_m, '// &
            '...) in '// &
            'place of load_parameter_m, lubricant_parameter_l and radius_ratio_d')
      else if (case%is_rough() .and. .not. case%moves() .and. minval(amplitude(case%surfaces())) <= 0) then
         call refuse('&waviness amplitude_over_film', 'takes waves at rest whose height is known: give amplitude_m')
      else if (case%effects%heat%is_given()) then
         call refuse('&heat is given', 'is isothermal, as the heat of sliding solids is not built: remove &heat. '// &
            'contact_temperature_rise_k estimates the rise of the oil by the friction of oil and solids')
      else if (case%effects%starvation%is_given() .or. case%effects%starvation%oil_profile /= '') then
         call refuse('&inlet gives less oil than fills the gap', 'balances oil from a full gap at the edge '// &
            'of the domain on: remove oil_over_flooded, oil_layer_m and oil_profile, or compute the starved film '// &
            'without &touching: surfaces touch where minimum_film falls to film_m')
      else if (case%is_rough() .and. case%response /= 'transient') then
         call refuse("&waviness response = '"//trim(case%response)//"'", 'is not linear: '// &
            "use response = 'transient', whose march becomes periodic (&dynamics end_time for a longer one)")
      else if (case%method == 'fas' .or. case%method == 'petsc') then
         call refuse("&solver method = '"//trim(case%method)//"'", &
            "is solved by Newton's method: use 'auto' or 'newton'")
      else if (case%accuracy > 0) then
         call refuse('&solver accuracy', 'states its errors by the mesh and chooses none: remove accuracy and '// &
            'give cells')
      else if (case%sensitivities .and. case%marches()) then
         call refuse('&output sensitivities', 'has none of marches: remove the key, or let the rough surface rest')
      else if (case%time_step_over_cell > 1 .or. .not. case%time_step_over_cell > 0) then
         call refuse('&solver time_step_over_cell', 'follows the oil from node to node: use 1, 0.5, 0.25, ...')
      else if (case%effects%touching%data%seeks_speed() .and. case%marches()) then
         call refuse('&touching share', 'finds a speed in steady states only: remove share, or let the rough '// &
            'surface '// &
            'rest (slip_parameter = 0)')
      end if

   contains

      subroutine refuse(given, instead)
         character(len=*), intent(in) :: given, instead
         call raise(error, given//', and &touching '//instead)
      end subroutine refuse

   end subroutine check

   !> The amplitude of waves that are given by it, else 0; of no waves infinite.
   elemental real(dp) function amplitude(roughness)
      type(roughness_t), intent(in) :: roughness
      amplitude = huge(amplitude)
      if (roughness%is_wavy()) amplitude = roughness%amplitude_m
   end function amplitude

end module ehlwave_touching_plan
