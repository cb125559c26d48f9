!> How the oil of a solution shears: stress, friction, and estimates of what the model leaves out.
module ehlwave_shear_result
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_conditions, only: conditions_t
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_kinds, only: dp, no_value, pi
   use ehlwave_load_balance, only: load_factor
   use ehlwave_state, only: state_t
   use ehlwave_text, only: to_text
   use ehlwave_thermal_estimate, only: film_rise_k, inlet_film_factor, inlet_rise_k, surface_rise_k, thermal_data_t
   implicit none (type, external)
   private
   public :: friction_above, mean_shear_stress

   !> What is not known is NaN: friction without E' or pressure, temperatures without lengths.
   type, public :: shear_result_t
      real(dp) :: friction_coefficient = no_value   !! above 0 where surface 1, the wavy one, is the faster one
      real(dp) :: largest_b = no_value              !! largest |B| where P > 0; NaN of a Newtonian oil
      real(dp) :: tangent_factor(2) = no_value      !! at the centre, along X and along Y; 1 of a Newtonian oil
      real(dp) :: share_beyond_limit = no_value     !! of the load, borne where |tau| is above its limit
      real(dp) :: inlet_rise_k = no_value, contact_rise_k = no_value   !! estimated temperature rises
      real(dp) :: inlet_film_factor = no_value      !! film with a warm inlet over the isothermal one, estimated
   contains
      procedure :: take
      procedure :: warning
      procedure, private :: estimate_temperatures
   end type shear_result_t

   real(dp), parameter :: least_pressure = 1e-12_dp ! P of nodes that bear; solvers leave 1e-30 at some cavitated ones
   real(dp), parameter :: much_load = 0.01_dp       ! of a share beyond the limit,
   real(dp), parameter :: thin_film = 0.95_dp       ! of the factor of the inlet,
   real(dp), parameter :: warm_contact_k = 10       ! viscosity falls by a third: what makes a warning

contains

   !> Account of a steady solution: with tau the mean of the shear stresses at the two surfaces along X,
   !>
   !>     friction coefficient = (3/(2 pi)) int tau/ph dX dY over P > 0,  of a line (2/pi) int tau/ph dX.
   subroutine take(self, problem, state, limiting_stress_over_pressure)
      class(shear_result_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      real(dp), intent(in) :: limiting_stress_over_pressure     !! largest |tau|/p that an oil bears
      real(dp), allocatable, dimension(:, :) :: b, factor_x, factor_y, stress

      self%tangent_factor = 1
      if (.not. (allocated(problem%film_flow) .or. knows_stress(problem%conditions))) return
      call shear(problem, state, stress, b, factor_x, factor_y)
      associate (grid => problem%grid, c => problem%conditions)
         if (allocated(problem%film_flow)) then
            self%largest_b = maxval(abs(b), mask=state%p > least_pressure)
            self%tangent_factor = [grid%value_at_centre(factor_x), grid%value_at_centre(factor_y)]
         end if
         if (.not. knows_stress(c)) return
         self%friction_coefficient = load_factor*grid%integral(merge(stress, 0.0_dp, state%p > least_pressure))
         self%share_beyond_limit = grid%integral(merge(state%p, 0.0_dp, &
                                                       abs(stress) > limiting_stress_over_pressure*state%p))/grid%integral(state%p)
         if (c%has_dimensions) call self%estimate_temperatures(c, grid%value_at_centre(state%h))
      end associate
   end subroutine take

   !> The part of the friction coefficient that is borne above a pressure P, 0: all of it; where stresses are known.
   real(dp) function friction_above(problem, state, p)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      real(dp), intent(in) :: p
      real(dp), allocatable, dimension(:, :) :: b, factor_x, factor_y, stress

      call shear(problem, state, stress, b, factor_x, factor_y)
      friction_above = load_factor*problem%grid%integral(merge(stress, 0.0_dp, state%p > max(p, least_pressure)))
   end function friction_above

   !> Mean of the shear stresses at the two surfaces along X, tau in Pa, (0:nx, 0:ny); unallocated where it is not known.
   subroutine mean_shear_stress(problem, state, stress_pa)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      real(dp), allocatable, intent(out) :: stress_pa(:, :)
      real(dp), allocatable, dimension(:, :) :: b, factor_x, factor_y

      if (.not. knows_stress(problem%conditions)) return
      call shear(problem, state, stress_pa, b, factor_x, factor_y)
      stress_pa = stress_pa*problem%conditions%hertz_pressure_pa
   end subroutine mean_shear_stress

   !> Whether stresses are known: friction needs E' and ph besides the dimensionless numbers.
   pure logical function knows_stress(conditions)
      type(conditions_t), intent(in) :: conditions
      knows_stress = conditions%data%reduced_modulus_pa > 0 .and. conditions%hertz_pressure_pa > 0
   end function knows_stress

   !> Stress tau/ph, B and tangent factors at all nodes, pressure gradients by central differences:
   !>
   !>     tau/ph = (K ph/E') sigma_m/N0,   K = 1 of a line;   Newtonian: sigma_m/N0 = (lambdabar/3) (S - 1) eta/H, as sigma_m = B.
   !>
   !> B and factors of a Newtonian oil are left 0.
   subroutine shear(problem, state, stress, b, factor_x, factor_y)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      real(dp), allocatable, dimension(:, :), intent(out) :: stress, b, factor_x, factor_y   !! (0:nx, 0:ny)
      real(dp), dimension(0:problem%grid%nx) :: drho, dln_eta, fluidity, gx, gy, rho
      real(dp) :: factor(2, 0:problem%grid%nx), scale
      integer :: j

      associate (grid => problem%grid, c => problem%conditions, p => state%p, h => state%h)
         allocate (stress(0:grid%nx, 0:grid%ny), source=0.0_dp)
         b = stress
         factor_x = stress
         factor_y = stress
         scale = c%elliptic%k*c%hertz_pressure_pa/c%data%reduced_modulus_pa
         gx = 0
         do j = 0, grid%ny
            call problem%rheology%evaluate(grid%nx + 1, p(:, j), rho, drho, fluidity, dln_eta)
            if (allocated(problem%film_flow)) then
               gx(1:grid%nx - 1) = (p(2:, j) - p(:grid%nx - 2, j))/(2*grid%hx)
               gy = 0
               if (j >= grid%first_row .and. j <= grid%last_row) &
                  gy = c%elliptic%kappa*(p(:, grid%above(j)) - p(:, grid%below(j)))/(2*grid%hy)
               call problem%film_flow%mean_stress(fluidity, h(:, j), gx, gy, stress(:, j), b(:, j), factor)
               factor_x(:, j) = factor(1, :)
               factor_y(:, j) = factor(2, :)
               stress(:, j) = scale/problem%film_flow%n0*stress(:, j)
            else
               stress(:, j) = scale*c%lambdabar/3*(c%slip_parameter - 1)/(fluidity*h(:, j))
            end if
         end do
      end associate
   end subroutine shear

   !> Temperature rises of the oil: in the inlet, and in the contact under its mean stress.
   subroutine estimate_temperatures(self, conditions, central_film)
      class(shear_result_t), intent(inout) :: self
      type(conditions_t), intent(in) :: conditions
      real(dp), intent(in) :: central_film   !! H(0,0)
      type(thermal_data_t) :: thermal
      real(dp) :: stress_pa

      associate (data => conditions%data, ph => conditions%hertz_pressure_pa, u => conditions%data%mean_speed_m_per_s, &
                 s => conditions%slip_parameter)
         self%inlet_film_factor = inlet_film_factor(thermal, data%viscosity_pa_s, u, 2*abs(s - 1), &
                                                    ph/data%reduced_modulus_pa)
         self%inlet_rise_k = inlet_rise_k(thermal, self%inlet_film_factor)
         stress_pa = abs(self%friction_coefficient)*ph*merge(pi/4, 2/3.0_dp, conditions%is_line())   ! times mean pressure
         self%contact_rise_k = film_rise_k(thermal, stress_pa, 2*abs(s - 1)*u, central_film*conditions%c_m) &
                               + surface_rise_k(thermal, stress_pa, s*u, (2 - s)*u, conditions%a_m)
      end associate
   end subroutine estimate_temperatures

   !> What the model leaves out and matters here, '' where nothing does.
   function warning(self, limiting_stress_over_pressure) result(text)
      class(shear_result_t), intent(in) :: self
      real(dp), intent(in) :: limiting_stress_over_pressure
      character(len=:), allocatable :: text

      text = ''
      if (is_above(self%share_beyond_limit, much_load)) text = '; the shear stress is above '// &
         to_text(limiting_stress_over_pressure, 3)//' of the pressure where '//to_text(100*self%share_beyond_limit, 2)// &
         ' % of the load is borne, and no limit is modelled: friction is too high'
      if (is_above(1 - self%inlet_film_factor, 1 - thin_film)) text = text//'; the inlet would warm by about '// &
         to_text(self%inlet_rise_k, 2)//' K, which makes the film '//to_text(100*(1 - self%inlet_film_factor), 2)// &
         ' % thinner, and the model is isothermal'
      if (is_above(self%contact_rise_k, warm_contact_k)) text = text//'; the oil in the contact would warm by about '// &
         to_text(self%contact_rise_k, 2)//' K, and the model is isothermal: friction is too high'
      text = text(min(3, len(text) + 1):)
   end function warning

   !> Whether a value is there and above a limit.
   pure logical function is_above(value, limit)
      real(dp), intent(in) :: value, limit
      is_above = ieee_is_finite(value)
      if (is_above) is_above = value > limit
   end function is_above

end module ehlwave_shear_result
