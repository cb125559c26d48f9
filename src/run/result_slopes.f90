!> Results of the smooth contact, and their derivatives by P and H at the nodes.
module ehlwave_result_slopes
   use ehlwave_bare_result, only: of_central_film, of_friction, of_minimum_film, of_rolling_coefficient, &
      of_rolling_force
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_friction_slope, only: friction_slope
   use ehlwave_grid, only: centre_nodes
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_load_balance, only: load_factor
   use ehlwave_rolling_result, only: rolling_coefficient
   use ehlwave_shear_stress, only: friction_at, friction_of, knows_stress, shear_stress
   use ehlwave_state, only: state_t
   implicit none (type, external)
   private
   public :: centre_slope, result_slope, take_results

   integer, parameter, public :: smooth_results = of_rolling_force   !! the first of all results

contains

   !> Logarithms of the results of a state beside the base: films in metres where lengths are known, else in units of c.
   !> NaN: no such result.
   subroutine take_results(problem, state, base, values)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state, base          !! node of the smallest film and cavitated
                                                        !! nodes of the base
      real(dp), intent(out) :: values(:)
      real(dp), allocatable, dimension(:, :) :: b, factor_x, factor_y, stress
      real(dp) :: friction, length
      integer :: thinnest(2)

      length = 1
      if (problem%conditions%has_dimensions) length = problem%conditions%c_m
      thinnest = minloc(base%h) - 1
      values(of_central_film) = log(length*problem%grid%value_at_centre(state%h))
      values(of_minimum_film) = log(length*state%h(thinnest(1), thinnest(2)))
      friction = 0
      if (knows_stress(problem%conditions)) then
         call shear_stress(problem, state, stress, b, factor_x, factor_y)
         friction = friction_of(problem%grid, stress, base%p, 0.0_dp)
      end if
      values(of_friction) = ln_modulus(friction)
      values(of_rolling_coefficient) = ln_modulus(rolling_coefficient(problem, state))
      associate (data => problem%conditions%data)
         values(of_rolling_force) = values(of_rolling_coefficient) + ln_modulus(max(data%load_n, data%load_n_per_m))
      end associate
   end subroutine take_results

   !> NaN for 0 and NaN.
   elemental real(dp) function ln_modulus(value)
      real(dp), intent(in) :: value
      ln_modulus = no_value
      if (abs(value) > 0) ln_modulus = log(abs(value))
   end function ln_modulus

   !> Derivatives of the logarithm of a result by P and H at the nodes, (0:nx, 0:ny).
   subroutine result_slope(problem, state, of, by_p, by_h)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      integer, intent(in) :: of
      real(dp), allocatable, dimension(:, :), intent(out) :: by_p, by_h
      integer :: j, thinnest(2)

      associate (grid => problem%grid)
         call grid%new_field(by_p)
         call grid%new_field(by_h)
         select case (of)
         case (of_central_film)
            call add_centre(problem, 1/grid%value_at_centre(state%h), by_h)
         case (of_minimum_film)
            thinnest = minloc(state%h) - 1
            by_h(thinnest(1), thinnest(2)) = 1/state%h(thinnest(1), thinnest(2))
         case (of_friction)
            call friction_slope(problem, state, by_p, by_h)
            by_p = by_p/friction_at(problem, state)
            by_h = by_h/friction_at(problem, state)
         case (of_rolling_coefficient, of_rolling_force)   ! the load and oil outside the domain are given
            do j = 0, grid%ny
               by_p(:, j) = -load_factor*grid%hx*grid%hy*grid%weight(j)*grid%x/ &
                            (2*problem%conditions%radius_over_a()*rolling_coefficient(problem, state))
            end do
         end select
      end associate
   end subroutine result_slope

   !> rho H at the centre and its derivatives.
   subroutine centre_slope(problem, state, oil, by_p, by_h)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      real(dp), intent(out) :: oil
      real(dp), allocatable, dimension(:, :), intent(out) :: by_p, by_h
      real(dp), dimension(0:problem%grid%nx) :: rho, drho, fluidity, dln_eta
      integer :: j, n

      associate (grid => problem%grid)
         oil = grid%value_at_centre(problem%rheology%density(state%p)*state%h)
         call grid%new_field(by_p)
         call grid%new_field(by_h)
         call add_centre(problem, 1.0_dp, by_h)
         by_p = by_h
         n = grid%nx + 1
         do j = 0, grid%ny
            call problem%rheology%evaluate(n, state%p(:, j), rho, drho, fluidity, dln_eta)
            by_p(:, j) = by_p(:, j)*drho*state%h(:, j)
            by_h(:, j) = by_h(:, j)*rho
         end do
      end associate
   end subroutine centre_slope

   !> Add the weights of the nodes in the value at the centre.
   subroutine add_centre(problem, factor, field)
      type(contact_problem_t), intent(in) :: problem
      real(dp), intent(in) :: factor
      real(dp), intent(inout) :: field(0:, 0:)
      integer :: k, node(2, centre_nodes)
      real(dp) :: weight(centre_nodes)

      call problem%grid%centre_weights(node, weight)
      do k = 1, size(weight)
         if (abs(weight(k)) > 0) field(node(1, k), node(2, k)) = field(node(1, k), node(2, k)) + factor*weight(k)
      end do
   end subroutine add_centre

end module ehlwave_result_slopes
