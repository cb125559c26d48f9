!> Flow of a generalised Newtonian oil across the film under a pressure gradient and sliding, with all its derivatives.
!>
!> The shear stress varies linearly across the film: sigma(zeta) = sigma_m + zeta Sigma, -1 <= zeta <= 1, in units of
!> tau0, with Sigma = N0 H g, g = (dP/dX, kappa dP/dY). The mean stress sigma_m follows from the sliding speed,
!>
!>     1/2 integral s(|sigma|) sigma dzeta = B e_x,        B = (lambdabar N0/6) 2 (S - 1) eta/H,
!>
!> theory eq. (S3), two equations that are the gradient of a convex function, and the flow is (S4)
!>
!>     Qhat = (H^2/(eta lambdabar)) (3/(2 N0)) integral zeta s sigma dzeta      -> (H^3/(eta lambdabar)) g as tau0 ->
!>     inf.
module ehlwave_film_flow
   use ehlwave_film_rules, only: across_film_t, film_rules_t, most_rules, slight_rule
   use ehlwave_film_stress, only: film_stress_t
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_flow_values, only: flow_values, take_flow, take_limit
   use ehlwave_kinds, only: dp
   use ehlwave_shear_limit, only: shear_limit_t
   use ehlwave_shear_moments, only: block_size
   implicit none (type, external)
   private
   public :: new_film_flow

   real(dp), parameter :: largest_rate = 1e100_dp      ! largest |B|: exp(230)

   !> The flow of an oil across the film of a contact, at any place.
   type, public :: film_flow_t
      class(flow_law_t), allocatable :: law
      type(film_rules_t) :: rules                 !! rules of integrals across the film; `set_levels` for warm oils
      real(dp) :: n0 = 0                          !! N0 = c ph/(2 a tau0)
      real(dp) :: lambdabar = 0                   !! dimensionless speed
      real(dp), private :: rate = 0               ! B H/eta
      type(shear_limit_t), allocatable :: limit   !! limit of the stress, if any
   contains
      procedure :: has_moments
      procedure :: evaluate
      procedure :: mean_stress
      procedure, private :: sort
      procedure, private :: load
   end type film_flow_t

contains

   !> Flow between surfaces with slip parameter S = u1/ubar.
   pure function new_film_flow(law, n0, lambdabar, slip_parameter) result(self)
      class(flow_law_t), intent(in) :: law
      real(dp), intent(in) :: n0               !! N0 = c ph/(2 a tau0) > 0
      real(dp), intent(in) :: lambdabar        !! dimensionless speed
      real(dp), intent(in) :: slip_parameter   !! S
      type(film_flow_t) :: self

      allocate (self%law, source=law)
      self%n0 = n0
      self%lambdabar = lambdabar
      self%rate = lambdabar*n0/3*(slip_parameter - 1)
      call self%rules%set_rules(law)
   end function new_film_flow

   !> Whether moments are all that counts of fluidities across the film.
   pure logical function has_moments(self)
      class(film_flow_t), intent(in) :: self
      has_moments = self%law%is_newtonian .and. .not. allocated(self%limit)
   end function has_moments

   !> One component of Qhat and its derivatives at n places, theory eq. (S4).
   pure subroutine evaluate(self, component, fluidity, h, gx, gy, flow, points, across)
      class(film_flow_t), intent(in) :: self
      integer, intent(in) :: component          !! `along_x` or `along_y`
      real(dp), intent(in) :: fluidity(:)       !! eta0/eta, (n)
      real(dp), intent(in) :: h(:)              !! H > 0, (n)
      real(dp), intent(in) :: gx(:), gy(:)      !! dP/dX and kappa dP/dY, (n)
      real(dp), intent(out) :: flow(:, :)       !! (flow_values, n), see `ehlwave_flow_values`
      integer, intent(out), optional :: points  !! across the film at which the oil was asked, in all: the cost
      type(across_film_t), intent(in), optional :: across
      type(film_stress_t) :: stress
      integer :: first(most_rules + 1), j, k, last, order(size(h)), start
      real(dp), dimension(size(h)) :: b, fluid, film   ! in that order
      real(dp) :: block(block_size, flow_values), sigma(size(h), 2)

      call self%sort(fluidity, h, gx, gy, order, first, sigma, b, across)
      fluid = fluidity(order)
      film = h(order)
      if (present(points)) points = 0
      do k = 1, size(self%rules%rule)
         do start = first(k), first(k + 1) - 1, block_size
            last = min(start + block_size, first(k + 1)) - 1
            if (present(across)) call self%load(across, k, order(start:last), sigma(start:last, :), stress)
            call stress%solve(self%law, self%rules%rule(k), k == slight_rule, sigma(start:last, :), b(start:last))
            if (present(points)) points = points + stress%points
            call take_flow(component, stress, self%n0, self%lambdabar, fluid(start:last), film(start:last), block)
            if (present(across) .and. allocated(self%limit)) &
               call take_limit(component, stress, self%limit, across%p(order(start:last)), block)
            do j = start, last
               flow(:, order(j)) = block(j - start + 1, :)
            end do
         end do
      end do
   end subroutine evaluate

   !> Mean of the shear stresses at the two surfaces over tau0, B and the tangent factors: flow driven by a small
   !> pressure gradient along X and along Y, relative to a Newtonian oil.
   pure subroutine mean_stress(self, fluidity, h, gx, gy, sigma_x, b, factor, across, sigma_y, flow)
      class(film_flow_t), intent(in) :: self
      real(dp), intent(in) :: fluidity(:)         !! eta0/eta, (n)
      real(dp), intent(in) :: h(:)                !! H > 0, (n)
      real(dp), intent(in) :: gx(:), gy(:)        !! dP/dX and kappa dP/dY, (n)
      real(dp), intent(out) :: sigma_x(:)         !! sigma_m,x, (n)
      real(dp), intent(out) :: b(:)               !! B, (n)
      real(dp), intent(out) :: factor(:, :)       !! (2, n) along X, along Y
      type(across_film_t), intent(in), optional :: across
      real(dp), intent(out), optional :: sigma_y(:), flow(:, :)   !! sigma_m,y, (n); 1/2 integral zeta s sigma dzeta,
                                                                  !! (2, n)
      type(film_stress_t) :: stress
      integer :: first(most_rules + 1), k, last, order(size(h)), start
      real(dp) :: rate(size(h)), sigma(size(h), 2)

      call self%sort(fluidity, h, gx, gy, order, first, sigma, rate, across)
      b(order) = rate
      do k = 1, size(self%rules%rule)
         do start = first(k), first(k + 1) - 1, block_size
            last = min(start + block_size, first(k + 1)) - 1
            if (present(across)) call self%load(across, k, order(start:last), sigma(start:last, :), stress)
            call stress%solve(self%law, self%rules%rule(k), k == slight_rule, sigma(start:last, :), rate(start:last))
            if (present(sigma_y)) sigma_y(order(start:last)) = stress%mean(:stress%n, 2)
            if (present(flow)) flow(:, order(start:last)) = transpose(stress%flow(:stress%n, :))
            sigma_x(order(start:last)) = stress%mean(:stress%n, 1)
            factor(1, order(start:last)) = 3*stress%flow_by_sigma(:stress%n, 1, 1)
            factor(2, order(start:last)) = 3*stress%flow_by_sigma(:stress%n, 2, 2)
         end do
      end do
   end subroutine mean_stress

   !> Dimensionless stress variation and shear rate of places, sorted by the rule that each needs.
   pure subroutine sort(self, fluidity, h, gx, gy, order, first, sigma, b, across)
      class(film_flow_t), intent(in) :: self
      real(dp), intent(in) :: fluidity(:), h(:), gx(:), gy(:)
      integer, intent(out) :: order(size(h)), first(most_rules + 1)   !! see `order_places`
      real(dp), intent(out) :: sigma(size(h), 2), b(size(h))          !! Sigma and B, in that order
      type(across_film_t), intent(in), optional :: across
      real(dp), dimension(size(h)) :: rate, sigma_x, sigma_y, variation
      integer :: i

      do i = 1, size(h)
         sigma_x(i) = self%n0*h(i)*gx(i)
         sigma_y(i) = self%n0*h(i)*gy(i)
         rate(i) = sign(min(abs(self%rate)/(h(i)*max(fluidity(i), tiny(h))), largest_rate), self%rate)
         variation(i) = sqrt(sigma_x(i)**2 + sigma_y(i)**2)
      end do
      call self%rules%order_places(variation, rate, self%limit, order, first, across)
      sigma(:, 1) = sigma_x(order)
      sigma(:, 2) = sigma_y(order)
      b = rate(order)
   end subroutine sort

   !> Fluidity at the points across the film and limit of the stress at the places of a block. Where no place is uneven
   !> across, the block equals an isothermal oil's block bit for bit.
   pure subroutine load(self, across, rule, places, sigma, stress)
      class(film_flow_t), intent(in) :: self
      type(across_film_t), intent(in) :: across
      integer, intent(in) :: rule, places(:)
      real(dp), intent(in) :: sigma(:, :)           !! Sigma of the places
      type(film_stress_t), intent(inout) :: stress
      real(dp) :: by_p, value(block_size)
      integer :: i, j, k
      logical :: is_even

      if (allocated(across%moments)) then
         if (.not. allocated(stress%moments)) allocate (stress%moments(block_size, 0:2))
         do i = 1, size(places)
            stress%moments(i, :) = across%moments(:, places(i))
         end do
      else if (allocated(across%ln_fluidity)) then
         associate (to => self%rules%to_rule(rule), ln => across%ln_fluidity)
            is_even = .not. any(across%range(places) > 0)
            if (is_even .and. allocated(stress%fluidity)) deallocate (stress%fluidity)
            if (allocated(stress%fluidity)) then
               if (size(stress%fluidity, 2) < self%rules%rule(rule)%n) deallocate (stress%fluidity)
            end if
            if (.not. (is_even .or. allocated(stress%fluidity))) &
               allocate (stress%fluidity(block_size, self%rules%rule(rule)%n))
            do k = 1, merge(0, self%rules%rule(rule)%n, is_even)
               associate (l => lbound(ln, 1) + to%first(k), w => to%weight(:, k))
                  do i = 1, size(places)
                     j = places(i)
                     value(i) = w(1)*ln(l, j) + w(2)*ln(l + 1, j) + w(3)*ln(l + 2, j) + w(4)*ln(l + 3, j)
                  end do
                  do i = 1, size(places)
                     stress%fluidity(i, k) = exp(value(i))
                  end do
               end associate
            end do
         end associate
      end if
      if (.not. allocated(self%limit)) return
      if (.not. allocated(stress%limit)) stress%limit = self%limit
      do i = 1, size(places)
         call self%limit%inverse_square(across%p(places(i)), sum(sigma(i, :)**2), stress%inverse_square(i), by_p, &
                                        stress%by_sigma2(i))
      end do
   end subroutine load

end module ehlwave_film_flow
