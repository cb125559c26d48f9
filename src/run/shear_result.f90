!> Shear of the oil in a solution: stress, friction, and estimates of heat and stress limit, which are not modelled.
module ehlwave_shear_result
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
   use ehlwave_conditions, only: conditions_t
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_inlet_law, only: inlet_t
   use ehlwave_kinds, only: dp, no_value, pi
   use ehlwave_shear_stress, only: friction_of, knows_stress, least_pressure, shear_stress, thickest_oil
   use ehlwave_state, only: state_t
   use ehlwave_text, only: to_text
   use ehlwave_thermal_estimate, only: film_rise_k, surface_rise_k, thermal_data_t, warm_inlet, warm_inlet_t
   implicit none (type, external)
   private
   public :: is_impossible

   !> Unknown values are NaN: friction without E' or pressure, temperatures without lengths.
   type, public :: shear_result_t
      real(dp) :: friction_coefficient = no_value   !! above 0 where surface 1, the wavy surface, is faster
      real(dp) :: dropped = no_value                !! friction coefficient that no oil has, and that is not given
      real(dp) :: thickest = no_value               !! largest viscosity over the ambient viscosity there
      real(dp) :: cancellation = 1                  !! friction by stresses of equal sign, over it
      real(dp) :: largest_b = no_value              !! largest |B| where P > 0; NaN of a Newtonian oil
      real(dp) :: tangent_factor(2) = no_value      !! at the centre, along X and along Y; 1 of a Newtonian oil
      real(dp) :: share_beyond_limit = no_value     !! share of the load where |tau| is above its limit
      type(warm_inlet_t) :: inlet                   !! estimated effect of its own shear on the inlet
      real(dp) :: contact_rise_k = no_value         !! estimated temperature rise of the oil in the contact
   contains
      procedure :: take
      procedure :: warning
      procedure :: drop_impossible
      procedure :: estimate_temperatures
   end type shear_result_t

   real(dp), parameter :: usual_limit = 0.08_dp     !! largest |tau|/p that oils bear
   real(dp), parameter :: most_friction = 1         !! friction coefficient above that of any oil
   real(dp), parameter :: much_load = 0.01_dp       ! least share beyond the limit,
   real(dp), parameter :: thin_film = 0.98_dp       ! least film factor of the inlet,
   real(dp), parameter :: warm_contact_k = 10       ! viscosity falls by a third: reason for a warning

contains

   !> Account of a steady solution, theory eq. (T2): with tau the mean of the shear stresses at the two surfaces along
   !> X,
   !>
   !>     friction coefficient = (3/(2 pi)) int tau/ph dX dY over P > 0,  of a line (2/pi) int tau/ph dX.
   subroutine take(self, problem, state, stress)
      class(shear_result_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      real(dp), allocatable, intent(out) :: stress(:, :)        !! tau/ph, (0:nx, 0:ny); unallocated where unknown
      real(dp), allocatable, dimension(:, :) :: b, factor_x, factor_y

      self%tangent_factor = 1
      if (problem%rheology%is_newtonian() .and. .not. knows_stress(problem%conditions)) return
      call shear_stress(problem, state, stress, b, factor_x, factor_y)
      associate (grid => problem%grid, c => problem%conditions)
         if (.not. problem%rheology%is_newtonian()) then
            self%largest_b = maxval(abs(b), mask=state%p > least_pressure)
            self%tangent_factor = [grid%value_at_centre(factor_x), grid%value_at_centre(factor_y)]
         end if
         if (.not. knows_stress(c)) return
         self%friction_coefficient = friction_of(grid, stress, state%p, 0.0_dp)
         if (abs(self%friction_coefficient) > 0) self%cancellation = &
            friction_of(grid, abs(stress), state%p, 0.0_dp)/abs(self%friction_coefficient)
         self%share_beyond_limit = &
            grid%integral(merge(state%p, 0.0_dp, abs(stress) > usual_limit*state%p)) &
            /grid%integral(state%p)
         call self%drop_impossible(problem, state)
         if (c%has_dimensions) call self%estimate_temperatures(c, grid%value_at_centre(state%h))
      end associate
   end subroutine take

   !> Temperature rises of the oil: in the inlet, and in the contact under its mean stress.
   subroutine estimate_temperatures(self, conditions, central_film)
      class(shear_result_t), intent(inout) :: self
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: central_film   !! H(0,0)
      type(thermal_data_t) :: thermal
      type(inlet_t) :: contact
      real(dp) :: stress_pa

      associate (data => conditions%data, ph => conditions%hertz_pressure_pa, u => conditions%data%mean_speed_m_per_s, &
                 s => conditions%slip_parameter)
         contact%loading = thermal%viscosity_decay_per_k*data%viscosity_pa_s*u**2/thermal%oil_conductivity_w_per_m_k
         contact%slide_roll = 2*abs(s - 1)
         contact%wall = thermal%oil_conductivity_w_per_m_k/(central_film*conditions%c_m)*sqrt(conditions%a_m/u) &
                        /thermal%solid_effusivity
         contact%film = central_film
         contact%m = conditions%m
         contact%l = conditions%l
         contact%d = conditions%d
         self%inlet = warm_inlet(thermal, contact, ph/data%reduced_modulus_pa)
         ! times mean pressure
         stress_pa = abs(self%friction_coefficient)*ph*merge(pi/4, 2/3.0_dp, conditions%is_line())
         self%contact_rise_k = film_rise_k(thermal, stress_pa, 2*abs(s - 1)*u, central_film*conditions%c_m) &
                               + surface_rise_k(thermal, stress_pa, s*u, (2 - s)*u, conditions%a_m)
      end associate
   end subroutine estimate_temperatures

   !> Whether no oil has a friction coefficient. Also for viscosities above 1e12 Pa s, at which oils are glass: their
   !> friction under any measurable sliding is above the limit.
   elemental logical function is_impossible(friction)
      real(dp), intent(in) :: friction
      is_impossible = .false.
      if (.not. ieee_is_nan(friction)) is_impossible = abs(friction) > most_friction
   end function is_impossible

   !> Drop a friction coefficient that no oil has.
   subroutine drop_impossible(self, problem, state)
      class(shear_result_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state

      self%dropped = no_value
      if (.not. is_impossible(self%friction_coefficient)) return
      self%dropped = self%friction_coefficient
      self%thickest = thickest_oil(problem, state)
      self%friction_coefficient = no_value
   end subroutine drop_impossible

   !> Effects that the model leaves out and that matter here; '' where none does.
   function warning(self, is_limited, is_warm) result(text)
      class(shear_result_t), intent(in) :: self
      logical, intent(in) :: is_limited, is_warm   !! whether the model has that
      character(len=:), allocatable :: text

      text = ''
      if (is_impossible(self%dropped)) then
         text = '; no friction coefficient is given: the oil would have '//to_text(self%dropped, 2)// &
            ', and no oil bears a shear stress above its pressure. Its viscosity reaches '// &
            to_text(self%thickest, 2)//" times the ambient viscosity: use flow_law = 'eyring' or "// &
            'shear_limit_over_pressure'
      else if (.not. is_limited .and. is_above(self%share_beyond_limit, much_load)) then
         text = '; the shear stress is above '//to_text(usual_limit, 3)//' of the pressure where '// &
            to_text(100*self%share_beyond_limit, 2)//' % of the load is borne, and no limit is modelled '// &
            '(shear_limit_over_pressure): friction is too high'
      end if
      if (.not. is_warm .and. is_above(1 - self%inlet%film_factor, 1 - thin_film)) text = text//'; '//inlet_text(self)
      if (.not. is_warm .and. is_above(self%contact_rise_k, warm_contact_k)) text = text// &
         '; the oil in the contact would warm by about '// &
         to_text(self%contact_rise_k, 2)//' K, and the model is isothermal: friction is too high'
      text = text(min(3, len(text) + 1):)
   end function warning

   !> Warning of a warm inlet.
   function inlet_text(self) result(text)
      class(shear_result_t), intent(in) :: self
      character(len=:), allocatable :: rise, text, thinner
      associate (inlet => self%inlet)
         rise = to_text(inlet%rise_k, 2)//' K, which makes the film '
         thinner = to_text(100*(1 - inlet%film_factor), 2)//' % thinner'
         if (ieee_is_finite(inlet%error)) then
            text = 'the inlet would warm by about '//rise//thinner//' (within '//to_text(100*inlet%error, 2)//' %)'
         else
            text = 'the inlet would warm by at most about '//rise//'up to '//thinner//' (a rough upper estimate)'
         end if
      end associate
      text = text//', and the model is isothermal: &heat computes it'
   end function inlet_text

   !> Whether a value is there and above a limit.
   pure logical function is_above(value, limit)
      real(dp), intent(in) :: value, limit
      is_above = ieee_is_finite(value)
      if (is_above) is_above = value > limit
   end function is_above

end module ehlwave_shear_result
