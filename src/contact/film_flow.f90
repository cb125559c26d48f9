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
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_film_levels, only: level_weights_t, new_level_weights
   use ehlwave_gauss_legendre, only: gauss_rule_t, new_gauss_rule
   use ehlwave_kinds, only: dp
   use ehlwave_film_stress, only: block_size, film_stress_t
   use ehlwave_shear_limit, only: shear_limit_t
   implicit none (type, external)
   private
   public :: new_film_flow

   integer, parameter :: rule_points(*) = [2, 4, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256]   ! across the film
   integer, parameter :: slight_rule = 2               ! of two with four points: for places where the oil hardly thins,
   real(dp), parameter :: slight_stress = 0.03_dp      ! with |Sigma| + |B| up to this
   real(dp), parameter :: largest_rate = 1e100_dp      ! of |B|: exp(230)

   integer, parameter, public :: along_x = 1, along_y = 2   !! components of the flow
   integer, parameter, public :: flow_values = 6            !! what `evaluate` returns of a place:
   integer, parameter, public :: flow_q = 1                 !! Qhat,
   integer, parameter, public :: flow_by_ln_eta = 2         !! its derivatives by ln(eta), H, g_x and g_y
   integer, parameter, public :: flow_by_h = 3
   integer, parameter, public :: flow_by_gx = 4
   integer, parameter, public :: flow_by_gy = 5
   integer, parameter, public :: flow_by_p = 6              !! and by P, which limits the stress

   !> Properties of places besides viscosity, film and gradients, and those that differ across the film.
   type, public :: across_film_t
      real(dp), allocatable :: ln_fluidity(:, :)   !! (0:levels, n) of an oil that is warm: ln of its fluidity at each
                                                   !! level over that given
      real(dp), allocatable :: p(:)                !! P, (n), where the stress is limited
      real(dp), allocatable :: range(:)            !! (n) of `ln_fluidity` across the film, given with it
      real(dp), allocatable :: moments(:, :)       !! (0:2, n) those of `moments_of` in place of `ln_fluidity`
   end type across_film_t

   ! Points across the film by the range of ln(fluidity): measured, the flow is exact to 1e-6
   real(dp), parameter :: warm_range(*) = [0.1_dp, 0.8_dp, 2.5_dp, 8.0_dp]
   integer, parameter :: warm_rule(*) = [3, 4, 5, 6, 7]
   real(dp), parameter :: limited_variation(*) = [0.003_dp, 0.02_dp, 0.1_dp]   ! |Sigma|/sigma_L
   integer, parameter :: limited_rule(*) = [5, 7, 9, 11]

   type, public :: film_flow_t
      class(flow_law_t), allocatable :: law
      real(dp) :: n0 = 0                          !! N0 = c ph/(2 a tau0)
      real(dp) :: lambdabar = 0                   !! dimensionless speed
      real(dp), private :: rate = 0               ! B H/eta
      type(gauss_rule_t), allocatable, private :: rule(:)
      real(dp), allocatable, private :: reach(:)  ! largest |Sigma| of each rule but the last
      type(shear_limit_t), allocatable :: limit   !! of the stress, if there is one
      type(level_weights_t), allocatable, private :: to_rule(:)   ! of an oil that is warm, from the levels to each rule
   contains
      procedure :: set_levels
      procedure :: has_moments
      procedure :: moments_of
      procedure :: evaluate
      procedure :: mean_stress
      procedure, private :: sort
      procedure, private :: load
      procedure, private :: rule_across
   end type film_flow_t

contains

   !> Flow between surfaces with slip parameter S = u1/ubar.
   pure function new_film_flow(law, n0, lambdabar, slip_parameter) result(self)
      class(flow_law_t), intent(in) :: law
      real(dp), intent(in) :: n0               !! N0 = c ph/(2 a tau0) > 0
      real(dp), intent(in) :: lambdabar        !! dimensionless speed
      real(dp), intent(in) :: slip_parameter   !! S
      type(film_flow_t) :: self
      integer :: i

      allocate (self%law, source=law)
      self%n0 = n0
      self%lambdabar = lambdabar
      self%rate = lambdabar*n0/3*(slip_parameter - 1)
      self%reach = law%largest_variation(rule_points(:size(rule_points) - 1))
      allocate (self%rule(min(size(rule_points), max(maxval(limited_rule), 1 + count(self%reach < huge(1.0_dp))))))
      do i = 1, size(self%rule)
         self%rule(i) = new_gauss_rule(rule_points(i))
      end do
   end function new_film_flow

   !> Be ready for fluidities at levels across the film.
   pure subroutine set_levels(self, n)
      class(film_flow_t), intent(inout) :: self
      integer, intent(in) :: n                 !! intervals between them
      integer :: k
      if (allocated(self%to_rule)) deallocate (self%to_rule)
      allocate (self%to_rule(size(self%rule)))
      do k = 1, size(self%rule)
         self%to_rule(k) = new_level_weights(n, self%rule(k)%node)
      end do
   end subroutine set_levels

   !> Whether moments are all that counts of fluidities across the film.
   pure logical function has_moments(self)
      class(film_flow_t), intent(in) :: self
      has_moments = self%law%is_newtonian .and. .not. allocated(self%limit)
   end function has_moments

   !> 1/2 integral zeta^k f dzeta of the fluidity f across the film over that given, k = 0 to 2.
   pure subroutine moments_of(self, ln_fluidity, range, moments)
      class(film_flow_t), intent(in) :: self
      real(dp), intent(in) :: ln_fluidity(0:, :)   !! (0:levels, n) of f
      real(dp), intent(in) :: range(:)             !! its range, (n)
      real(dp), intent(out) :: moments(0:, :)      !! (0:2, n)
      integer :: i, k
      do i = 1, size(range)
         if (range(i) > 0) then
            k = warm_rule(1 + count(range(i) > warm_range))
            call moments_by(self%rule(k), self%to_rule(k), ln_fluidity(:, i), moments(:, i))
         else
            moments(:, i) = [1.0_dp, 0.0_dp, 1/3.0_dp]
         end if
      end do
   end subroutine moments_of

   !> Those of one place.
   pure subroutine moments_by(rule, to, ln, moments)
      type(gauss_rule_t), intent(in) :: rule
      type(level_weights_t), intent(in) :: to
      real(dp), intent(in), contiguous :: ln(0:)
      real(dp), intent(out) :: moments(0:2)
      real(dp) :: fluidity(maxval(rule_points(:maxval(warm_rule))))
      integer :: k, l
      do k = 1, rule%n
         l = to%first(k)
         fluidity(k) = to%weight(1, k)*ln(l) + to%weight(2, k)*ln(l + 1) + to%weight(3, k)*ln(l + 2) &
                       + to%weight(4, k)*ln(l + 3)
      end do
      do k = 1, rule%n
         fluidity(k) = 0.5_dp*rule%weight(k)*exp(fluidity(k))
      end do
      moments = 0
      do k = 1, rule%n
         moments(0) = moments(0) + fluidity(k)
         moments(1) = moments(1) + rule%node(k)*fluidity(k)
         moments(2) = moments(2) + rule%node(k)**2*fluidity(k)
      end do
   end subroutine moments_by

   !> One component of Qhat and its derivatives at n places.
   pure subroutine evaluate(self, component, fluidity, h, gx, gy, flow, points, across)
      class(film_flow_t), intent(in) :: self
      integer, intent(in) :: component          !! along_x or along_y
      real(dp), intent(in) :: fluidity(:)       !! eta0/eta, (n)
      real(dp), intent(in) :: h(:)              !! H > 0, (n)
      real(dp), intent(in) :: gx(:), gy(:)      !! dP/dX and kappa dP/dY, (n)
      real(dp), intent(out) :: flow(:, :)       !! (flow_values, n)
      integer, intent(out), optional :: points  !! across the film at which the oil was asked, in all: the cost
      type(across_film_t), intent(in), optional :: across
      type(film_stress_t) :: stress
      integer :: first(size(rule_points) + 1), j, k, last, order(size(h)), start
      real(dp), dimension(size(h)) :: b, fluid, film   ! in that order
      real(dp) :: block(block_size, flow_values), sigma(size(h), 2)

      call self%sort(fluidity, h, gx, gy, order, first, sigma, b, across)
      fluid = fluidity(order)
      film = h(order)
      if (present(points)) points = 0
      do k = 1, size(self%rule)
         do start = first(k), first(k + 1) - 1, block_size
            last = min(start + block_size, first(k + 1)) - 1
            if (present(across)) call self%load(across, k, order(start:last), sigma(start:last, :), stress)
            call stress%solve(self%law, self%rule(k), k == slight_rule, sigma(start:last, :), b(start:last))
            if (present(points)) points = points + stress%points
            call unload(self, component, stress, fluid(start:last), film(start:last), block)
            if (present(across) .and. allocated(self%limit)) &
               call unload_limit(self, component, stress, across%p(order(start:last)), block)
            do j = start, last
               flow(:, order(j)) = block(j - start + 1, :)
            end do
         end do
      end do

   end subroutine evaluate

   !> Mean of the shear stresses at the two surfaces over tau0, B and the tangent factors: what a small pressure
   !> gradient drives along X and along Y over what it drives in a Newtonian oil.
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
      integer :: first(size(rule_points) + 1), k, last, order(size(h)), start
      real(dp) :: rate(size(h)), sigma(size(h), 2)

      call self%sort(fluidity, h, gx, gy, order, first, sigma, rate, across)
      b(order) = rate
      do k = 1, size(self%rule)
         do start = first(k), first(k + 1) - 1, block_size
            last = min(start + block_size, first(k + 1)) - 1
            if (present(across)) call self%load(across, k, order(start:last), sigma(start:last, :), stress)
            call stress%solve(self%law, self%rule(k), k == slight_rule, sigma(start:last, :), rate(start:last))
            if (present(sigma_y)) sigma_y(order(start:last)) = stress%mean(:stress%n, 2)
            if (present(flow)) flow(:, order(start:last)) = transpose(stress%flow(:stress%n, :))
            sigma_x(order(start:last)) = stress%mean(:stress%n, 1)
            factor(1, order(start:last)) = 3*stress%flow_by_sigma(:stress%n, 1, 1)
            factor(2, order(start:last)) = 3*stress%flow_by_sigma(:stress%n, 2, 2)
         end do
      end do
   end subroutine mean_stress

   !> Dimensionless stress variation and shear rate of places, sorted by the number of Gauss points that each needs.
   pure subroutine sort(self, fluidity, h, gx, gy, order, first, sigma, b, across)
      class(film_flow_t), intent(in) :: self
      real(dp), intent(in) :: fluidity(:), h(:), gx(:), gy(:)
      integer, intent(out) :: order(size(h))                   !! places, those of rule 1 first
      integer, intent(out) :: first(size(rule_points) + 1)     !! where those of each rule begin
      real(dp), intent(out) :: sigma(size(h), 2), b(size(h))   !! Sigma and B, in that order
      type(across_film_t), intent(in), optional :: across
      real(dp), dimension(size(h)) :: rate, sigma_x, sigma_y, variation
      integer :: i, k, needed(size(h)), place(size(rule_points) + 1)

      do i = 1, size(h)
         sigma_x(i) = self%n0*h(i)*gx(i)
         sigma_y(i) = self%n0*h(i)*gy(i)
         rate(i) = sign(min(abs(self%rate)/(h(i)*max(fluidity(i), tiny(h))), largest_rate), self%rate)
         variation(i) = sqrt(sigma_x(i)**2 + sigma_y(i)**2)
      end do
      needed = 1
      do k = 1, size(self%reach)
         if (.not. any(variation > self%reach(k))) exit
         where (variation > self%reach(k)) needed = k + 1
      end do
      where (needed == slight_rule .and. variation + abs(rate) > slight_stress) needed = slight_rule + 1
      if (present(across)) needed = max(needed, self%rule_across(across, variation))
      first = 0
      do i = 1, size(h)
         first(needed(i)) = first(needed(i)) + 1
      end do
      first(size(first)) = size(h) + 1
      do k = size(rule_points), 1, -1
         first(k) = first(k + 1) - first(k)
      end do
      place = first
      do i = 1, size(h)
         order(place(needed(i))) = i
         place(needed(i)) = place(needed(i)) + 1
      end do
      sigma(:, 1) = sigma_x(order)
      sigma(:, 2) = sigma_y(order)
      b = rate(order)
   end subroutine sort

   !> The rule that each place needs for what differs across its film.
   pure function rule_across(self, across, variation) result(needed)
      class(film_flow_t), intent(in) :: self
      type(across_film_t), intent(in) :: across
      real(dp), intent(in) :: variation(:)     !! |Sigma|
      integer :: needed(size(variation))
      real(dp) :: by_p, by_sigma2, inverse
      integer :: i

      needed = 1
      if (allocated(across%ln_fluidity)) then
         do i = 1, size(needed)
            if (across%range(i) > 0) needed(i) = warm_rule(1 + count(across%range(i) > warm_range))
         end do
      end if
      if (.not. allocated(self%limit)) return
      do i = 1, size(needed)
         call self%limit%inverse_square(across%p(i), variation(i)**2, inverse, by_p, by_sigma2)
         needed(i) = max(needed(i), limited_rule(1 + count(variation(i)*sqrt(inverse) > limited_variation)))
      end do
   end function rule_across

   !> Flow and its derivatives at the places of a block.
   pure subroutine unload(self, component, stress, fluidity, h, flow)
      class(film_flow_t), intent(in) :: self
      integer, intent(in) :: component                          !! along_x or along_y
      type(film_stress_t), intent(in) :: stress
      real(dp), intent(in) :: fluidity(stress%n), h(stress%n)
      real(dp), intent(out) :: flow(block_size, flow_values)
      real(dp) :: b_by_b, scale, unit
      integer :: j

      unit = 3/(self%lambdabar*self%n0)
      associate (s => stress, by_sigma => stress%flow_by_sigma)
         do j = 1, stress%n
            scale = unit*h(j)**2*fluidity(j)
            b_by_b = s%b(j)*s%flow_by_b(j, component)
            flow(j, flow_q) = scale*s%flow(j, component)
            flow(j, flow_by_ln_eta) = scale*(b_by_b - s%flow(j, component))
            flow(j, flow_by_h) = scale/h(j)*(2*s%flow(j, component) - b_by_b &
                                             + by_sigma(j, component, 1)*s%sigma(j, 1) &
                                             + by_sigma(j, component, 2)*s%sigma(j, 2))
            flow(j, flow_by_gx) = scale*self%n0*h(j)*by_sigma(j, component, 1)
            flow(j, flow_by_gy) = scale*self%n0*h(j)*by_sigma(j, component, 2)
            flow(j, flow_by_p) = merge(scale, 0.0_dp, allocated(self%limit))   ! a factor of it, see `unload_limit`
         end do
      end associate
   end subroutine unload

   !> Derivative by P of the flow at the places of a block, by the limit alone.
   pure subroutine unload_limit(self, component, stress, p, flow)
      class(film_flow_t), intent(in) :: self
      integer, intent(in) :: component
      type(film_stress_t), intent(in) :: stress
      real(dp), intent(in) :: p(stress%n)
      real(dp), intent(inout) :: flow(block_size, flow_values)
      real(dp) :: by_p, by_sigma2, inverse
      integer :: j
      do j = 1, stress%n
         call self%limit%inverse_square(p(j), sum(stress%sigma(j, :)**2), inverse, by_p, by_sigma2)
         flow(j, flow_by_p) = flow(j, flow_by_p)*stress%flow_by_limit(j, component)*by_p
      end do
   end subroutine unload_limit

   !> Fluidity at the points across the film and limit of the stress at the places of a block. Where no place is uneven
   !> across, the block is that of an isothermal oil, bit for bit.
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
         associate (to => self%to_rule(rule), ln => across%ln_fluidity)
            is_even = .not. any(across%range(places) > 0)
            if (is_even .and. allocated(stress%fluidity)) deallocate (stress%fluidity)
            if (allocated(stress%fluidity)) then
               if (size(stress%fluidity, 2) < self%rule(rule)%n) deallocate (stress%fluidity)
            end if
            if (.not. (is_even .or. allocated(stress%fluidity))) &
               allocate (stress%fluidity(block_size, self%rule(rule)%n))
            do k = 1, merge(0, self%rule(rule)%n, is_even)
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
