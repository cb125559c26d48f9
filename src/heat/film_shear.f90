!> Velocity of the oil and heat that it makes, at levels across the film of each node.
module ehlwave_film_shear
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_film_flow, only: across_film_t
   use ehlwave_film_levels, only: film_levels_t
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
      real(dp), allocatable :: source(:, :, :)          !! heat of shear and of compression, K
      real(dp), allocatable :: shear_heat(:, :)         !! that of shear alone, integrated across the film
      real(dp), allocatable :: pressure_heat(:, :)      !! that of compression
      real(dp), allocatable :: relief(:, :)             !! -d ln(source)/dT by shear under a given sliding speed, 1/K
   end type film_shear_t

   !> State of one node.
   type :: node_t
      real(dp) :: h, fluidity, gx, gy, b
      real(dp) :: mean(2), sigma(2), flow(2)            ! stresses, 1/2 integral zeta s sigma dzeta
   end type node_t

contains

   pure function new_film_shear(levels, nx, ny) result(self)
      integer, intent(in) :: levels, nx, ny
      type(film_shear_t) :: self
      allocate (self%u(0:levels, 0:nx, 0:ny), source=0.0_dp)
      allocate (self%v, self%source, source=self%u)
      allocate (self%shear_heat(0:nx, 0:ny), source=0.0_dp)
      allocate (self%pressure_heat, self%relief, source=self%shear_heat)
   end function new_film_shear

   !> Those of a state of a problem that is warm. Where the film is cavitated nothing is sheared.
   pure subroutine shear_film(self, problem, state, levels, scales)
      class(film_shear_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state
      type(film_levels_t), intent(in) :: levels
      type(heat_scales_t), intent(in) :: scales
      type(across_film_t), allocatable :: across
      real(dp), dimension(0:problem%grid%nx) :: b, fluidity, rho, sigma_x, sigma_y
      real(dp) :: factor(2, 0:problem%grid%nx), flow(2, 0:problem%grid%nx)
      real(dp), allocatable, dimension(:, :) :: gx, gy
      integer :: i, j

      allocate (gx, gy, mold=state%p)
      associate (grid => problem%grid, film => problem%film_flow, p => state%p, h => state%h)
         call node_gradient(grid, problem%conditions%elliptic%kappa, p, gx, gy)
         do j = 0, grid%ny
            call oil_of_row(problem, state, j, rho, fluidity, across)
            call film%mean_stress(fluidity, h(:, j), gx(:, j), gy(:, j), sigma_x, b, factor, across, sigma_y, flow)
            do i = 0, grid%nx
               if (p(i, j) > least_pressure) then
                  call shear_node(self, problem, levels, scales, &
                     node_t(h(i, j), fluidity(i), gx(i, j), gy(i, j), b(i), [sigma_x(i), sigma_y(i)], &
                            film%n0*h(i, j)*[gx(i, j), gy(i, j)], flow(:, i)), p(i, j), i, j)
               else
                  self%u(:, i, j) = surface_speeds(problem, levels)
                  self%v(:, i, j) = 0
                  self%source(:, i, j) = 0
                  self%shear_heat(i, j) = 0
                  self%pressure_heat(i, j) = 0
                  self%relief(i, j) = 0
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

   !> One node. The velocity is the integral of the rate of shear; what the levels leave of the difference between the
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
      real(dp), dimension(0:levels%n) :: at, compression, expansion, fluidity, heat, s, slope, stress2, u, v
      real(dp) :: sigma(0:levels%n, 2), by_p, by_sigma2, inverse, rate, share, total, w, w_slope
      real(dp) :: by_k(0:levels%n), exponent(0:levels%n)
      integer :: k

      associate (film => problem%film_flow, n => levels%n, theta => problem%heat%rise(:, i, j), &
                 slip => problem%conditions%slip_parameter)
         do k = 0, n
            sigma(k, :) = node%mean + (2*levels%zeta(k) - 1)*node%sigma
            stress2(k) = sum(sigma(k, :)**2)
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
         fluidity = exp(problem%heat%ln_fluidity(:, i, j))
         s = s*fluidity
         rate = 6*node%h*node%fluidity/(film%lambdabar*film%n0)
         u = 2 - slip + rate*levels%running_integral(s*sigma(:, 1))
         v = rate*levels%running_integral(s*sigma(:, 2))
         u = u + (slip - u(n))*levels%zeta
         v = v - v(n)*levels%zeta
         heat = s*stress2
         total = node%mean(1)*node%b + dot_product(node%sigma, node%flow)
         share = total/max(dot_product(levels%weight, heat), tiny(share))
         heat = heat*min(max(share, 1/largest_correction), largest_correction)
         heat = heat*(0.5_dp*scales%work*node%h/film%n0*rate)

         at = p
         call problem%rheology%expansivity(n + 1, at, theta, expansion)
         compression = scales%work*node%h**2*(scales%temperature_k + theta)*expansion*(u*node%gx + v*node%gy)
         self%u(:, i, j) = u
         self%v(:, i, j) = v
         self%source(:, i, j) = heat + compression
         self%shear_heat(i, j) = dot_product(levels%weight, heat)
         self%pressure_heat(i, j) = dot_product(levels%weight, compression)

         call problem%rheology%ln_viscosity(n + 1, at, theta, exponent, by_k)
         share = dot_product(levels%weight, s + 2*slope*fluidity*sigma(:, 1)**2)      ! d B/d sigma_m
         self%relief(i, j) = 0
         if (abs(node%mean(1)) > 0) self%relief(i, j) = node%b/(node%mean(1)*share)* &
            max(0.0_dp, -dot_product(levels%weight, by_k))*node%mean(1)*node%b/total* &
            self%shear_heat(i, j)/max(self%shear_heat(i, j) + abs(self%pressure_heat(i, j)), tiny(share))
         self%relief(i, j) = max(self%relief(i, j), 0.0_dp)
      end associate
   end subroutine shear_node

end module ehlwave_film_shear
