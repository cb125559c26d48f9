!> Velocity of the oil and heat that it makes, at levels across the film of each node.
module ehlwave_film_shear
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_film_levels, only: film_levels_t, integrate_levels, most_levels
   use ehlwave_film_rules, only: across_film_t
   use ehlwave_heat_data, only: heat_scales_t
   use ehlwave_kinds, only: dp
   use ehlwave_shear_stress, only: least_pressure, node_gradient, oil_of_row
   use ehlwave_state, only: state_t
   implicit none (type, external)
   private
   public :: new_film_shear, shear_film

   !> All arrays (0:levels, 0:nx, 0:ny) or (0:nx, 0:ny).
   type, public :: film_shear_t
      real(dp), allocatable :: u(:, :, :), v(:, :, :)   !! rho H times velocity along X and along Y over ubar
      real(dp), allocatable :: made(:, :, :, :)         !! (0:levels, 4, 0:nx, 0:ny), see below
      real(dp), allocatable :: shear_heat(:, :)         !! heat of shear alone, integrated across the film
      real(dp), allocatable :: pressure_heat(:, :)      !! heat of compression
   end type film_shear_t

   !> Columns of `made`: the source of heat of shear and of compression, K, and its change with the rise under a
   !> given sliding speed, theory eq. (D10): by the own rise of a level, by the stress, and the stress by all rises.
   integer, parameter, public :: made_heat = 1, made_by_own = 2, made_by_stress = 3, made_stress_by_rise = 4

   !> P from which on all of the film is sheared: nodes at its edge would switch their heat on and off.
   real(dp), parameter :: full_pressure = 1e-4_dp

   !> State of a node.
   type :: node_t
      real(dp) :: h, fluidity, gx, gy, b
      real(dp) :: mean(2), sigma(2), flow(2)            ! stresses, 1/2 integral zeta s sigma dzeta
      real(dp) :: growth                                ! dP/dT
   end type node_t

contains

   pure function new_film_shear(levels, nx, ny) result(self)
      integer, intent(in) :: levels, nx, ny
      type(film_shear_t) :: self
      allocate (self%u(0:levels, 0:nx, 0:ny), source=0.0_dp)
      allocate (self%v, source=self%u)
      allocate (self%made(0:levels, 4, 0:nx, 0:ny), source=0.0_dp)
      allocate (self%shear_heat(0:nx, 0:ny), source=0.0_dp)
      allocate (self%pressure_heat, source=self%shear_heat)
   end function new_film_shear

   !> Sources for a state of a warm problem. Cavitated film has no shear.
   pure subroutine shear_film(self, problem, state, levels, scales, by_time)
      class(film_shear_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      type(film_levels_t), intent(in) :: levels
      type(heat_scales_t), intent(in) :: scales
      real(dp), intent(in), optional :: by_time(0:, 0:)   !! dP/dT, (0:nx, 0:ny); absent: 0
      type(across_film_t), allocatable :: across
      real(dp), dimension(0:problem%grid%nx) :: b, drho, fluidity, rho, sigma_x, sigma_y
      real(dp) :: factor(2, 0:problem%grid%nx), flow(2, 0:problem%grid%nx)
      real(dp), allocatable, dimension(:, :) :: gx, gy
      real(dp) :: growth
      integer :: i, j

      growth = 0
      allocate (gx, gy, mold=state%p)
      associate (grid => problem%grid, film => problem%film_flow, p => state%p, h => state%h, &
                 kappa => problem%conditions%elliptic%kappa)
         call node_gradient(grid, kappa, p, gx, gy)
         do j = 0, grid%ny
            call oil_of_row(problem, state, j, rho, drho, fluidity, across)
            call film%mean_stress(fluidity, h(:, j), gx(:, j), gy(:, j), sigma_x, b, factor, across, sigma_y, flow)
            do i = 0, grid%nx
               if (present(by_time)) growth = by_time(i, j)
               if (p(i, j) > least_pressure) then
                  call shear_node(self, problem, levels, scales, &
                     node_t(h(i, j), fluidity(i), gx(i, j), gy(i, j), b(i), [sigma_x(i), sigma_y(i)], &
                            film%n0*h(i, j)*[gx(i, j), gy(i, j)], flow(:, i), growth), p(i, j), i, j)
               else
                  self%u(:, i, j) = surface_speeds(problem, levels)
                  self%v(:, i, j) = 0
                  self%made(:, :, i, j) = 0
                  self%shear_heat(i, j) = 0
                  self%pressure_heat(i, j) = 0
               end if
               self%u(:, i, j) = rho(i)*h(i, j)*self%u(:, i, j)
               self%v(:, i, j) = rho(i)*h(i, j)*self%v(:, i, j)
            end do
         end do
      end associate
   end subroutine shear_film

   !> Velocity that the surfaces alone would give.
   pure function surface_speeds(problem, levels) result(u)
      type(contact_problem_t), intent(in) :: problem
      type(film_levels_t), intent(in) :: levels
      real(dp) :: u(0:levels%n)
      associate (s => problem%conditions%slip_parameter)
         u = 2 - s + 2*(s - 1)*levels%zeta
      end associate
   end function surface_speeds

   !> Source at a node. The velocity is the integral of the rate of shear; the remaining difference between the
   !> surfaces is spread evenly. The heat of shear has the exact integral, sigma_m B + Sigma flow.
   pure subroutine shear_node(self, problem, levels, scales, node, p, i, j)
      type(film_shear_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(film_levels_t), intent(in) :: levels
      type(heat_scales_t), intent(in) :: scales
      type(node_t), intent(in) :: node
      real(dp), intent(in) :: p
      integer, intent(in) :: i, j
      real(dp), parameter :: largest_correction = 4
      real(dp), dimension(0:most_levels) :: compression, heat, s, sigma_x, slope, stress2, u, v   ! (0:n) of each
      real(dp) :: by_p, by_sigma2, inverse, made, rate, scale, share, stiffness, total, w, w_slope
      integer :: k

      associate (film => problem%film_flow, n => levels%n, zeta => levels%zeta, theta => problem%heat%rise(:, i, j), &
                 slip => problem%conditions%slip_parameter)
         do k = 0, n
            sigma_x(k) = node%mean(1) + (2*zeta(k) - 1)*node%sigma(1)
            v(k) = node%mean(2) + (2*zeta(k) - 1)*node%sigma(2)
            stress2(k) = max(sigma_x(k)**2 + v(k)**2, tiny(stress2))
         end do
         call film%law%shear_factor(n + 1, stress2, s, slope)
         if (allocated(film%limit)) then
            call film%limit%inverse_square(p, sum(node%sigma**2), inverse, by_p, by_sigma2)
            do k = 0, n
               call film%limit%factor(stress2(k)*inverse, w, w_slope)
               slope(k) = slope(k)*w + s(k)*w_slope*inverse
               s(k) = s(k)*w
            end do
         end if
         do k = 0, n                          ! fluidity of the oil at the local temperature
            w = exp(problem%heat%ln_fluidity(k, i, j))
            s(k) = s(k)*w
            slope(k) = slope(k)*w
            compression(k) = s(k)*sigma_x(k)
            v(k) = s(k)*v(k)
         end do
         rate = 6*node%h*node%fluidity/(film%lambdabar*film%n0)
         call integrate_levels(n, compression, u)
         call integrate_levels(n, v, compression)
         share = slip - (2 - slip + rate*u(n))
         scale = 0.5_dp*scales%work*node%h/film%n0*rate*min(1.0_dp, p/full_pressure)
         total = 0
         do k = 0, n
            u(k) = 2 - slip + rate*u(k) + share*zeta(k)
            v(k) = rate*(compression(k) - compression(n)*zeta(k))
            heat(k) = s(k)*stress2(k)
            total = total + levels%heat_weight(k)*heat(k)
         end do
         made = node%mean(1)*node%b + dot_product(node%sigma, node%flow)
         share = made/max(total, tiny(share))
         scale = scale*min(max(share, 1/largest_correction), largest_correction)
         call compress(problem, scales, node, p, theta, u, v, compression)
         self%shear_heat(i, j) = 0
         self%pressure_heat(i, j) = 0
         stiffness = 0                        ! d B/d sigma_m
         do k = 0, n
            heat(k) = scale*heat(k)
            self%u(k, i, j) = u(k)
            self%v(k, i, j) = v(k)
            self%made(k, made_heat, i, j) = heat(k) + compression(k)
            self%shear_heat(i, j) = self%shear_heat(i, j) + levels%heat_weight(k)*heat(k)
            self%pressure_heat(i, j) = self%pressure_heat(i, j) + levels%heat_weight(k)*compression(k)
            stiffness = stiffness + levels%weight(k)*(s(k) + 2*slope(k)*sigma_x(k)**2)
         end do

         ! Share of the heat by which sliding is relieved
         share = min(max(node%mean(1)*node%b/made, 0.0_dp), 1.0_dp)
         do k = 0, n
            self%made(k, made_by_own, i, j) = share*heat(k)*problem%heat%thinning(k, i, j)
            self%made(k, made_by_stress, i, j) = share*heat(k)*2*(1 + slope(k)*stress2(k)/s(k))*sigma_x(k) &
                                                 /(stress2(k)*stiffness)
            self%made(k, made_stress_by_rise, i, j) = levels%weight(k)*s(k)*sigma_x(k)*problem%heat%thinning(k, i, j)
         end do
      end associate
   end subroutine shear_node

   !> Heat of compression at the levels of a node.
   pure subroutine compress(problem, scales, node, p, theta, u, v, heat)
      type(contact_problem_t), intent(in) :: problem
      type(heat_scales_t), intent(in) :: scales
      type(node_t), intent(in) :: node
      real(dp), intent(in) :: p
      real(dp), intent(in), contiguous :: theta(0:)           !! rises, (0:levels)
      real(dp), intent(in), contiguous :: u(0:), v(0:)        !! velocities
      real(dp), intent(inout), contiguous :: heat(0:)
      real(dp), dimension(0:most_levels) :: at, expansion
      real(dp) :: unit
      integer :: k

      at = p
      call problem%rheology%expansivity(size(theta), at, theta, expansion)
      unit = scales%work*node%h**2
      do k = 0, ubound(theta, 1)
         heat(k) = unit*(scales%temperature_k + theta(k))*expansion(k)*(u(k)*node%gx + v(k)*node%gy &
            + node%growth)
      end do
   end subroutine compress

end module ehlwave_film_shear
