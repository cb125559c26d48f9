!> The stress across the film of a generalised Newtonian oil: its mean from the sliding speed, and the flow.
!>
!> With the moments a_k and the dyads T_k of `ehlwave_shear_moments` everything is algebra:
!>
!>     rate  1/2 integral s sigma dzeta      = a_0 sigma_m + a_1 Sigma
!>     flow  1/2 integral zeta s sigma dzeta = a_1 sigma_m + a_2 Sigma
!>
!> with T_0, T_1 the derivatives of the rate by sigma_m and Sigma, T_1, T_2 the derivatives of the flow: theory eq.
!> (S11).
module ehlwave_film_stress
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_gauss_legendre, only: gauss_rule_t
   use ehlwave_kinds, only: dp
   use ehlwave_shear_moments, only: block_size, dyads, film_block_t, integrate_by, moments_t
   use ehlwave_stress_guess, only: guess_stress, guess_uneven_stress
   implicit none (type, external)
   private

   integer, parameter :: most_steps = 60  ! Newton's method needs at most 15 for |B| to 1e6, |Sigma| to 60
   ! Last step, which is still made: the error left is its square, times the stress where that is small
   real(dp), parameter :: newton_tolerance = 1e-6_dp

   !> A block with the flow at its places.
   type, extends(film_block_t), public :: film_stress_t
      real(dp) :: flow(block_size, 2)                !! 1/2 integral zeta s sigma dzeta
      real(dp) :: flow_by_b(block_size, 2)           !! its derivative by B, sigma_m following
      real(dp) :: flow_by_sigma(block_size, 2, 2)    !! by Sigma, sigma_m following
      real(dp) :: flow_by_limit(block_size, 2)       !! by 1/sigma_L^2, where the stress is limited
   contains
      procedure :: solve
   end type film_stress_t

contains

   !> sigma_m by Newton, theory eq. (S3); the flow (S4) and its derivatives, to second order by the last step.
   !> Fluidities, or moments, and the limit are set before by who has them.
   pure subroutine solve(self, law, rule, is_slight, sigma, b)
      class(film_stress_t), intent(inout) :: self
      class(flow_law_t), intent(in) :: law
      type(gauss_rule_t), intent(in) :: rule
      logical, intent(in) :: is_slight      !! whether stresses are so small that B itself is a good first guess of them
      real(dp), intent(in) :: sigma(:, :)   !! Sigma, (places, 2), at most block_size of them
      real(dp), intent(in) :: b(:)          !! B, (places)
      type(moments_t) :: moments
      real(dp) :: change(block_size, 2), t0(block_size, 3)
      real(dp), dimension(block_size) :: length2, range2, stress2
      integer :: i, step

      self%n = size(b)
      self%sigma(:self%n, :) = sigma
      self%b(:self%n) = b
      self%points = 0
      if (allocated(self%moments)) then
         call solve_newtonian(self)
         return
      end if
      self%mean(:self%n, 1) = b
      self%mean(:self%n, 2) = 0
      if (allocated(self%fluidity) .or. allocated(self%limit)) then
         if (.not. all(abs(b) <= 0)) call guess_uneven_stress(self, law, rule)
      else if (.not. (is_slight .or. all(abs(b) <= 0))) then
         call guess_stress(self, law, rule)
      end if
      do step = 1, most_steps
         call integrate_by(self, law, rule, moments)
         call newton_step(self, moments, change, t0)
         do i = 1, self%n
            stress2(i) = self%mean(i, 1)**2 + self%mean(i, 2)**2
            range2(i) = 1
            if (law%is_power) range2(i) = max(1.0_dp, stress2(i))
            stress2(i) = stress2(i) + self%sigma(i, 1)**2 + self%sigma(i, 2)**2
            length2(i) = change(i, 1)**2 + change(i, 2)**2
         end do
         associate (n => self%n)
            if (all(length2(:n)*min(1.0_dp, sqrt(stress2(:n))) <= newton_tolerance**2*range2(:n)) &
                .and. is_exact(self, moments)) exit
         end associate
         do i = 1, self%n
            self%mean(i, :) = self%mean(i, :) + min(1.0_dp, sqrt(range2(i)/max(length2(i), tiny(length2))))*change(i, :)
         end do
      end do
      call finish(self, moments, change, t0)
   end subroutine solve

   !> Stress of a warm Newtonian oil, whose rate is linear in the stress: T_k = a_k I.
   pure subroutine solve_newtonian(self)
      class(film_stress_t), intent(inout) :: self
      real(dp) :: share, slope
      integer :: i

      self%points = self%n
      associate (a => self%moments, s => self%sigma)
         do i = 1, self%n
            share = a(i, 1)/a(i, 0)
            slope = a(i, 2) - a(i, 1)*share
            self%mean(i, 1) = self%b(i)/a(i, 0) - share*s(i, 1)
            self%mean(i, 2) = -share*s(i, 2)
            self%flow(i, 1) = share*self%b(i) + slope*s(i, 1)
            self%flow(i, 2) = slope*s(i, 2)
            self%flow_by_b(i, 1) = share
            self%flow_by_b(i, 2) = 0
            self%flow_by_sigma(i, 1, 1) = slope
            self%flow_by_sigma(i, 2, 1) = 0
            self%flow_by_sigma(i, 1, 2) = 0
            self%flow_by_sigma(i, 2, 2) = slope
         end do
      end associate
   end subroutine solve_newtonian

   !> Whether the rate is B where the stress is limited: there it hardly depends on it.
   pure logical function is_exact(self, moments)
      class(film_stress_t), intent(in) :: self
      type(moments_t), intent(in) :: moments
      integer :: i
      is_exact = .true.
      if (.not. allocated(self%limit)) return
      associate (m => self%mean, s => self%sigma, a => moments%a, b => self%b)
         do i = 1, self%n
            is_exact = is_exact .and. abs(b(i) - a(i, 0)*m(i, 1) - a(i, 1)*s(i, 1)) <= &
                       newton_tolerance*max(abs(b(i)), a(i, 0)*abs(m(i, 1)), abs(a(i, 1)*s(i, 1)))
         end do
      end associate
   end function is_exact

   !> T_0^(-1) (B e_x - rate).
   pure subroutine newton_step(self, moments, change, t)
      class(film_stress_t), intent(in) :: self
      type(moments_t), intent(in) :: moments
      real(dp), intent(out) :: change(block_size, 2)   !! change of sigma_m
      real(dp), intent(out) :: t(block_size, 3)        !! T_0
      real(dp) :: inverse, left_x, left_y
      integer :: i

      call dyads(self, moments, 0, t)
      associate (m => self%mean, s => self%sigma, a => moments%a)
         do i = 1, self%n
            left_x = self%b(i) - a(i, 0)*m(i, 1) - a(i, 1)*s(i, 1)
            left_y = -a(i, 0)*m(i, 2) - a(i, 1)*s(i, 2)
            inverse = 1/(t(i, 1)*t(i, 3) - t(i, 2)**2)
            change(i, 1) = (t(i, 3)*left_x - t(i, 2)*left_y)*inverse
            change(i, 2) = (t(i, 1)*left_y - t(i, 2)*left_x)*inverse
         end do
      end associate
   end subroutine newton_step

   !> Flow and its derivatives from the moments at the last sigma_m and the last step.
   pure subroutine finish(self, moments, change, t0)
      class(film_stress_t), intent(inout) :: self
      type(moments_t), intent(in) :: moments
      real(dp), intent(in) :: change(block_size, 2), t0(block_size, 3)
      real(dp), dimension(block_size, 3) :: t1, t2
      real(dp) :: inverse, xx, xy, yx, yy
      integer :: i

      call dyads(self, moments, 1, t1)
      call dyads(self, moments, 2, t2)
      associate (m => self%mean, s => self%sigma, a => moments%a)
         do i = 1, self%n
            inverse = 1/(t0(i, 1)*t0(i, 3) - t0(i, 2)**2)
            xx = (t0(i, 3)*t1(i, 1) - t0(i, 2)*t1(i, 2))*inverse      ! T_0^(-1) T_1
            yx = (t0(i, 1)*t1(i, 2) - t0(i, 2)*t1(i, 1))*inverse
            xy = (t0(i, 3)*t1(i, 2) - t0(i, 2)*t1(i, 3))*inverse
            yy = (t0(i, 1)*t1(i, 3) - t0(i, 2)*t1(i, 2))*inverse
            self%flow_by_b(i, 1) = xx
            self%flow_by_b(i, 2) = xy
            self%flow_by_sigma(i, 1, 1) = t2(i, 1) - t1(i, 1)*xx - t1(i, 2)*yx
            self%flow_by_sigma(i, 2, 1) = t2(i, 2) - t1(i, 2)*xx - t1(i, 3)*yx
            self%flow_by_sigma(i, 1, 2) = self%flow_by_sigma(i, 2, 1)
            self%flow_by_sigma(i, 2, 2) = t2(i, 3) - t1(i, 2)*xy - t1(i, 3)*yy
            self%flow(i, 1) = a(i, 1)*m(i, 1) + a(i, 2)*s(i, 1) + change(i, 1)*t1(i, 1) + change(i, 2)*t1(i, 2)
            self%flow(i, 2) = a(i, 1)*m(i, 2) + a(i, 2)*s(i, 2) + change(i, 1)*t1(i, 2) + change(i, 2)*t1(i, 3)
            if (allocated(self%limit)) call limit_flow(self, moments, i, [xx, xy], [yx, yy])
            self%mean(i, 1) = m(i, 1) + change(i, 1)
            self%mean(i, 2) = m(i, 2) + change(i, 2)
         end do
      end associate
   end subroutine finish

   !> Derivative of the flow of a place by 1/sigma_L^2, sigma_m following: the derivative at fixed stress less T_1
   !> T_0^(-1) times the derivative of the rate.
   pure subroutine limit_flow(self, moments, i, first, second)
      class(film_stress_t), intent(inout) :: self
      type(moments_t), intent(in) :: moments
      integer, intent(in) :: i
      real(dp), intent(in) :: first(2), second(2)   !! rows of T_0^(-1) T_1
      real(dp) :: rate(2)
      integer :: j
      associate (c => moments%by_limit, m => self%mean, s => self%sigma)
         rate = c(i, 0)*m(i, :) + c(i, 1)*s(i, :)
         self%flow_by_limit(i, :) = c(i, 1)*m(i, :) + c(i, 2)*s(i, :) - first*rate(1) - second*rate(2)
         do j = 1, 2
            self%flow_by_sigma(i, :, j) = self%flow_by_sigma(i, :, j) &
               + 2*self%by_sigma2(i)*s(i, j)*self%flow_by_limit(i, :)
         end do
      end associate
   end subroutine limit_flow

end module ehlwave_film_stress
