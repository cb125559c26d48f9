!> A first guess of the mean stress across the film, from which Newton starts: `ehlwave_film_stress`.
module ehlwave_stress_guess
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_gauss_legendre, only: gauss_rule_t
   use ehlwave_kinds, only: dp
   use ehlwave_shear_moments, only: block_size, film_block_t, integrate, integrate_by, moments_t
   implicit none (type, external)
   private
   public :: guess_stress, guess_uneven_stress

   ! |Sigma| up to which a few points across the film make a guess
   real(dp), parameter :: small_variation = 2.5_dp
   ! Rules of Gauss for that: the positive nodes, and half their weights
   real(dp), parameter :: node_of_two(1) = 1/sqrt(3.0_dp), half_weight_of_two(1) = 0.5_dp
   real(dp), parameter :: nodes_of_four(2) = sqrt([3 - sqrt(4.8_dp), 3 + sqrt(4.8_dp)]/7), &
                          half_weights_of_four(2) = (18 + [1, -1]*sqrt(30.0_dp))/72

contains

   !> sigma_m of an oil uniform across the film. First the value for B alone. Then -a_1 Sigma_y/a_0 across sliding,
   !> which leaves no rate there. Along sliding, the stress for B over the excess rate. Both treat the shape of s as
   !> fixed: exact for Ree-Eyring without gradient across sliding. Where Sigma is small fewer points across the film
   !> give the rate: an error of fourth or eighth order.
   pure subroutine guess_stress(self, law, rule)
      class(film_block_t), intent(inout) :: self   !! gets sigma_m of its places
      class(flow_law_t), intent(in) :: law
      type(gauss_rule_t), intent(in) :: rule
      type(moments_t) :: moments
      real(dp) :: across, found, rate(block_size), stress(block_size)
      integer :: i

      associate (n => self%n, m => self%mean, s => self%sigma, a => moments%a, e => moments%e)
         rate(:n) = max(abs(self%b(:n)), tiny(rate))
         call law%first_stress(n, rate, stress)
         m(:n, 1) = sign(stress(:n), self%b(:n))
         if (rule%n == 2) return                    ! no variation to speak of
         if (rule%n == 4) then
            call integrate(self, law, node_of_two, half_weight_of_two, moments)
         else if (maxval(s(:n, 1)**2 + s(:n, 2)**2) <= small_variation**2) then
            call integrate(self, law, nodes_of_four, half_weights_of_four, moments)
         else
            call integrate_by(self, law, rule, moments)
         end if
         do i = 1, n
            across = -s(i, 2)*a(i, 1)/a(i, 0)
            found = a(i, 0)*m(i, 1) + a(i, 1)*s(i, 1) + 0.5_dp*across**2*(e(i, 0)*m(i, 1) + e(i, 1)*s(i, 1)) &
                    + across*s(i, 2)*(e(i, 1)*m(i, 1) + e(i, 2)*s(i, 1))
            m(i, 2) = across
            rate(i) = max(rate(i)*self%b(i)/found, tiny(rate))
         end do
         call law%first_stress(n, rate, stress)
         m(:n, 1) = sign(stress(:n), self%b(:n))
      end associate
   end subroutine guess_stress

   !> sigma_m of an oil that is warm or whose stress is limited: the value for B over the mean fluidity, then reduced
   !> by the limit. Newton's method solves for ln(rate) against y = -ln(1 - sigma/sigma_L). Along X alone: the other
   !> component stays.
   pure subroutine guess_uneven_stress(self, law, rule)
      class(film_block_t), intent(inout) :: self   !! gets sigma_m along X of its places
      class(flow_law_t), intent(in) :: law
      type(gauss_rule_t), intent(in) :: rule
      integer, parameter :: steps = 8
      real(dp), dimension(block_size) :: largest, rate, s, slope, stress, y
      real(dp) :: share, w, w_slope
      integer :: i, step

      associate (n => self%n)
         rate(:n) = max(abs(self%b(:n)), tiny(rate))
         if (allocated(self%fluidity)) rate(:n) = rate(:n)/(0.5_dp*matmul(self%fluidity(:n, :rule%n), rule%weight))
         call law%first_stress(n, rate, stress)
         if (allocated(self%limit)) then
            do i = 1, n
               largest(i) = 1/sqrt(self%inverse_square(i))
               y(i) = min(stress(i)/largest(i), 0.5_dp)
            end do
            do step = 1, steps
               do i = 1, n
                  stress(i) = largest(i)*(1 - exp(-y(i)))
               end do
               call law%shear_factor(n, stress(:n)**2, s, slope)
               do i = 1, n
                  share = 1 - exp(-y(i))
                  call self%limit%factor(share**2, w, w_slope)
                  y(i) = max(0.5_dp*y(i), y(i) - log(s(i)*w*stress(i)/rate(i))/(exp(-y(i))* &
                     (1/share + 2*slope(i)/s(i)*share*largest(i)**2 + 2*share*w_slope/w)))
               end do
            end do
         end if
         self%mean(:n, 1) = sign(stress(:n), self%b(:n))
      end associate
   end subroutine guess_uneven_stress

end module ehlwave_stress_guess
