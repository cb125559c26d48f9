!> Rules of Gauss for integrals across the film of an oil: how many points each place needs, and the places by rule.
!>
!> The need grows with the change of the stress across the film, which the flow law judges, with the range of the
!> fluidity of a warm oil, and near a limit of the stress. Measured, the flow is exact to 1e-6 where the oil is warm;
!> the flow law keeps the error of integrals below 1e-12 of them.
module ehlwave_film_rules
   use ehlwave_film_levels, only: level_weights_t, new_level_weights
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_gauss_legendre, only: gauss_rule_t, new_gauss_rule
   use ehlwave_kinds, only: dp
   use ehlwave_shear_limit, only: shear_limit_t
   implicit none (type, external)
   private

   integer, parameter :: rule_points(*) = [2, 4, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256]   ! across the film
   integer, parameter, public :: most_rules = size(rule_points)
   integer, parameter, public :: slight_rule = 2     !! rule of two pairs with four points: for places where the oil
                                                     !! hardly thins,
   real(dp), parameter :: slight_stress = 0.03_dp      ! with |Sigma| + |B| up to this

   !> Properties of places besides viscosity, film and gradients, and those that differ across the film.
   type, public :: across_film_t
      real(dp), allocatable :: ln_fluidity(:, :)   !! (0:levels, n) of an oil that is warm: ln of its fluidity at each
                                                   !! level over that given
      real(dp), allocatable :: p(:)                !! P, (n), where the stress is limited
      real(dp), allocatable :: range(:)            !! (n) of `ln_fluidity` across the film, given with it
      real(dp), allocatable :: moments(:, :)       !! (0:2, n) values of `moments_of` in place of `ln_fluidity`
   end type across_film_t

   ! Points across the film by the range of ln(fluidity)
   real(dp), parameter :: warm_range(*) = [0.1_dp, 0.8_dp, 2.5_dp, 8.0_dp]
   integer, parameter :: warm_rule(*) = [3, 4, 5, 6, 7]
   real(dp), parameter :: limited_variation(*) = [0.003_dp, 0.02_dp, 0.1_dp]   ! |Sigma|/sigma_L
   integer, parameter :: limited_rule(*) = [5, 7, 9, 11]

   !> The rules of an oil, from few points to many.
   type, public :: film_rules_t
      type(gauss_rule_t), allocatable :: rule(:)
      real(dp), allocatable, private :: reach(:)         ! largest |Sigma| of each rule but the last
      type(level_weights_t), allocatable :: to_rule(:)   !! weights from the levels to each rule, for a warm oil
   contains
      procedure :: set_rules
      procedure :: set_levels
      procedure :: moments_of
      procedure :: order_places
   end type film_rules_t

contains

   !> Rules for a flow law.
   pure subroutine set_rules(self, law)
      class(film_rules_t), intent(inout) :: self
      class(flow_law_t), intent(in) :: law
      integer :: i

      self%reach = law%largest_variation(rule_points(:size(rule_points) - 1))
      allocate (self%rule(min(size(rule_points), max(maxval(limited_rule), 1 + count(self%reach < huge(1.0_dp))))))
      do i = 1, size(self%rule)
         self%rule(i) = new_gauss_rule(rule_points(i))
      end do
   end subroutine set_rules

   !> Be ready for fluidities at levels across the film, `across_film_t`.
   pure subroutine set_levels(self, n)
      class(film_rules_t), intent(inout) :: self
      integer, intent(in) :: n                 !! intervals between them
      integer :: k
      if (allocated(self%to_rule)) deallocate (self%to_rule)
      allocate (self%to_rule(size(self%rule)))
      do k = 1, size(self%rule)
         self%to_rule(k) = new_level_weights(n, self%rule(k)%node)
      end do
   end subroutine set_levels

   !> 1/2 integral zeta^k f dzeta of the fluidity f across the film over the given fluidity, k = 0 to 2. Warm
   !> Newtonian oils need only these. Call after `set_levels`.
   pure subroutine moments_of(self, ln_fluidity, range, moments)
      class(film_rules_t), intent(in) :: self
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

   !> Moments at one place.
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

   !> Places sorted by the rule that each needs.
   pure subroutine order_places(self, variation, rate, limit, order, first, across)
      class(film_rules_t), intent(in) :: self
      real(dp), intent(in) :: variation(:), rate(:)           !! |Sigma| and B of each place, (n)
      type(shear_limit_t), allocatable, intent(in) :: limit   !! limit of the stress, if any
      integer, intent(out) :: order(:)                       !! places, sorted by rule, (n)
      integer, intent(out) :: first(:)                       !! start of each rule in it; then n + 1
      type(across_film_t), intent(in), optional :: across
      integer :: i, k, needed(size(variation)), place(size(rule_points) + 1)

      needed = 1
      do k = 1, size(self%reach)
         if (.not. any(variation > self%reach(k))) exit
         where (variation > self%reach(k)) needed = k + 1
      end do
      where (needed == slight_rule .and. variation + abs(rate) > slight_stress) needed = slight_rule + 1
      if (present(across)) needed = max(needed, rule_across(across, variation, limit))
      first = 0
      do i = 1, size(variation)
         first(needed(i)) = first(needed(i)) + 1
      end do
      first(size(first)) = size(variation) + 1
      do k = size(rule_points), 1, -1
         first(k) = first(k + 1) - first(k)
      end do
      place = first
      do i = 1, size(variation)
         order(place(needed(i))) = i
         place(needed(i)) = place(needed(i)) + 1
      end do
   end subroutine order_places

   !> Rule of integration that each place needs, by the variation across its film.
   pure function rule_across(across, variation, limit) result(needed)
      type(across_film_t), intent(in) :: across
      real(dp), intent(in) :: variation(:)     !! |Sigma|
      type(shear_limit_t), allocatable, intent(in) :: limit
      integer :: needed(size(variation))
      real(dp) :: by_p, by_sigma2, inverse
      integer :: i

      needed = 1
      if (allocated(across%ln_fluidity)) then
         do i = 1, size(needed)
            if (across%range(i) > 0) needed(i) = warm_rule(1 + count(across%range(i) > warm_range))
         end do
      end if
      if (.not. allocated(limit)) return
      do i = 1, size(needed)
         call limit%inverse_square(across%p(i), variation(i)**2, inverse, by_p, by_sigma2)
         needed(i) = max(needed(i), limited_rule(1 + count(variation(i)*sqrt(inverse) > limited_variation)))
      end do
   end function rule_across

end module ehlwave_film_rules
