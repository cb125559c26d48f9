!> Shear stress of the oil at a solution, and the pressure gradients on which it depends.
module ehlwave_shear_stress
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_conditions, only: conditions_t
   use ehlwave_film_rules, only: across_film_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_state, only: state_t
   implicit none (type, external)
   private
   public :: friction_at, friction_of, friction_outside, knows_stress, mean_shear_stress, node_gradient, oil_of_row, &
      shear_stress, stress_at, thickest_oil

   real(dp), parameter, public :: least_pressure = 1e-12_dp   !! P of nodes that bear; solvers leave 1e-30 at some
                                                              !! cavitated nodes

contains

   !> dP/dX and kappa dP/dY at the nodes by central differences; 0 at the edges of the domain.
   pure subroutine node_gradient(grid, kappa, p, gx, gy)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa                       !! ellipticity a/b
      real(dp), intent(in) :: p(0:, 0:)                   !! P, (0:nx, 0:ny)
      real(dp), intent(out) :: gx(0:, 0:), gy(0:, 0:)     !! (0:nx, 0:ny)
      integer :: j

      gx = 0
      gy = 0
      do j = 0, grid%ny
         gx(1:grid%nx - 1, j) = (p(2:, j) - p(:grid%nx - 2, j))/(2*grid%hx)
         if (j >= grid%first_row .and. j <= grid%last_row) &
            gy(:, j) = kappa*(p(:, grid%above(j)) - p(:, grid%below(j)))/(2*grid%hy)
      end do
   end subroutine node_gradient

   !> The part of the friction coefficient, theory eq. (T2), that is borne where P is above a value, 0: all of it.
   real(dp) function friction_of(grid, stress, p, above)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: stress(0:, 0:)   !! tau/ph, (0:nx, 0:ny)
      real(dp), intent(in) :: p(0:, 0:)        !! P, (0:nx, 0:ny)
      real(dp), intent(in) :: above
      friction_of = load_factor*grid%integral(merge(stress, 0.0_dp, p > max(above, least_pressure)))
   end function friction_of

   !> All of it, of a solution.
   real(dp) function friction_at(problem, state)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      real(dp), allocatable, dimension(:, :) :: b, factor_x, factor_y, stress
      call shear_stress(problem, state, stress, b, factor_x, factor_y)
      friction_at = friction_of(problem%grid, stress, state%p, 0.0_dp)
   end function friction_at

   !> Largest viscosity over the ambient viscosity.
   real(dp) function thickest_oil(problem, state)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      real(dp), dimension(0:problem%grid%nx) :: drho, fluidity, rho
      type(across_film_t), allocatable :: across
      integer :: j
      thickest_oil = 0
      do j = 0, problem%grid%ny
         call oil_of_row(problem, state, j, rho, drho, fluidity, across)
         thickest_oil = max(thickest_oil, 1/minval(fluidity))
      end do
   end function thickest_oil

   !> Friction of the oil that floods the contact outside the domain, out to `times` its size, theory eq. (T11), from
   !> the far field without gradients. Dry edges reduce it in proportion.
   !>
   !> Oil downstream of X = 0, which the far field does not have, bears besides. Twice the domain had 1.17 to 1.27 times
   !> the friction that is upstream (23 random contacts, M = 9 to 640, D = 0.03 to 0.8, isoviscous and thinning).
   real(dp) function friction_outside(problem, state, times) result(friction)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      real(dp), intent(in) :: times
      type(across_film_t), allocatable :: across
      real(dp), allocatable, dimension(:) :: area, b, h, slope, stress, thickened
      real(dp), allocatable :: factor(:, :)
      real(dp), parameter :: with_downstream = 1.3_dp
      integer :: k

      friction = 0
      call problem%edges%film_outside(times, area, h, thickened)
      if (size(area) == 0) return
      allocate (b, slope, stress, mold=h)
      allocate (factor(2, size(h)))
      slope = 0
      if (allocated(problem%film_flow)) then
         if (allocated(problem%film_flow%limit)) then
            allocate (across)
            across%p = thickened/max(problem%rheology%thickening(), tiny(1.0_dp))
         end if
      end if
      call stress_in(problem, 1 - thickened, h, slope, slope, stress, b, factor, across)
      associate (edges => problem%edges)
         friction = with_downstream*load_factor*sum(area*stress)/edges%count() &
                    *count([(state%p(edges%i(k), edges%j(k)) > least_pressure, k=1, edges%count())])
      end associate
   end function friction_outside

   !> Mean of the shear stresses at the two surfaces along X, tau in Pa, (0:nx, 0:ny); unallocated where it is not
   !> known.
   subroutine mean_shear_stress(problem, state, stress_pa)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      real(dp), allocatable, intent(out) :: stress_pa(:, :)
      real(dp), allocatable, dimension(:, :) :: b, factor_x, factor_y

      if (.not. knows_stress(problem%conditions)) return
      call shear_stress(problem, state, stress_pa, b, factor_x, factor_y)
      stress_pa = stress_pa*problem%conditions%hertz_pressure_pa
   end subroutine mean_shear_stress

   !> Whether stresses are known: friction needs E' and ph besides the dimensionless numbers.
   pure logical function knows_stress(conditions)
      type(conditions_t), intent(in) :: conditions
      knows_stress = conditions%data%reduced_modulus_pa > 0 .and. conditions%hertz_pressure_pa > 0
   end function knows_stress

   !> Stress tau/ph, theory eq. (T1), B and tangent factors (S13) at all nodes:
   !>
   !>     tau/ph = (K ph/E') sigma_m/N0,   K = 1 of a line;   Newtonian: sigma_m/N0 = (lambdabar/3) (S - 1) eta/H, as
   !>     sigma_m = B.
   !>
   !> B and factors of a Newtonian oil are left 0.
   subroutine shear_stress(problem, state, stress, b, factor_x, factor_y)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      real(dp), allocatable, dimension(:, :), intent(out) :: stress, b, factor_x, factor_y   !! (0:nx, 0:ny)
      real(dp), allocatable, dimension(:, :) :: gx, gy

      associate (grid => problem%grid, c => problem%conditions, p => state%p)
         call grid%new_field(stress)
         call grid%new_field(b)
         call grid%new_field(factor_x)
         call grid%new_field(factor_y)
         allocate (gx, gy, mold=stress)
         if (.not. problem%rheology%is_newtonian()) call node_gradient(grid, c%elliptic%kappa, p, gx, gy)
         call stress_at(problem, state, gx, gy, stress, b, factor_x, factor_y)
      end associate
   end subroutine shear_stress

   !> Stress, B and factors under given pressure gradients dP/dX and kappa dP/dY.
   subroutine stress_at(problem, state, gx, gy, stress, b, factor_x, factor_y)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      real(dp), intent(in), dimension(0:, 0:) :: gx, gy
      real(dp), intent(inout) :: stress(0:, 0:)
      real(dp), intent(inout), dimension(0:, 0:), optional :: b, factor_x, factor_y
      real(dp), dimension(0:problem%grid%nx) :: drho, fluidity, rho, speed
      type(across_film_t), allocatable :: across
      real(dp) :: factor(2, 0:problem%grid%nx)
      integer :: j

      do j = 0, problem%grid%ny
         call oil_of_row(problem, state, j, rho, drho, fluidity, across)
         call stress_in(problem, fluidity, state%h(:, j), gx(:, j), gy(:, j), stress(:, j), speed, factor, across)
         if (present(b)) b(:, j) = speed
         if (present(factor_x)) factor_x(:, j) = factor(1, :)
         if (present(factor_y)) factor_y(:, j) = factor(2, :)
      end do
   end subroutine stress_at

   !> Stress at places with a fluidity and a film.
   subroutine stress_in(problem, fluidity, h, gx, gy, stress, b, factor, across)
      type(contact_problem_t), intent(in) :: problem
      real(dp), intent(in) :: fluidity(:), h(:), gx(:), gy(:)
      real(dp), intent(out) :: stress(:), b(:), factor(:, :)   !! tau/ph, B, tangent factors (2, places)
      type(across_film_t), allocatable, intent(in) :: across
      real(dp) :: scale

      b = 0
      factor = 0
      associate (c => problem%conditions)
         scale = c%elliptic%k*c%hertz_pressure_pa/c%data%reduced_modulus_pa
         if (.not. problem%rheology%is_newtonian()) then
            call problem%film_flow%mean_stress(fluidity, h, gx, gy, stress, b, factor, across)
            stress = scale/problem%film_flow%n0*stress
         else
            stress = scale*c%lambdabar/3*(c%slip_parameter - 1)/(fluidity*h)
         end if
      end associate
   end subroutine stress_in

   !> Density, its slope and fluidity at the nodes of a row, and the variation across the film there.
   pure subroutine oil_of_row(problem, state, j, rho, drho, fluidity, across)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      integer, intent(in) :: j
      real(dp), intent(out), dimension(0:) :: rho, drho, fluidity   !! (0:nx)
      type(across_film_t), allocatable, intent(out) :: across
      real(dp) :: dln_eta(0:problem%grid%nx)
      integer :: n

      n = problem%grid%nx + 1
      if (allocated(problem%heat)) then
         call problem%rheology%evaluate(n, state%p(:, j), rho, drho, fluidity, dln_eta, problem%heat%mean_rise(:, j))
      else
         call problem%rheology%evaluate(n, state%p(:, j), rho, drho, fluidity, dln_eta)
      end if
      if (.not. allocated(problem%film_flow)) return
      if (.not. (allocated(problem%heat) .or. allocated(problem%film_flow%limit))) return
      allocate (across)
      if (allocated(problem%heat)) call problem%heat%take_row(across, j)
      if (allocated(problem%film_flow%limit)) across%p = state%p(:, j)
   end subroutine oil_of_row

end module ehlwave_shear_stress
