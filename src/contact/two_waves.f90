!> The two waves of which the film of a wavy contact under slip consists.
!>
!> Where a pattern exp(i (kx X + ky Y - w T)), w = kx S, slides through the contact, the film over Ai is
!>
!>     a exp(i (kx X - w T)) + c exp(i (psi X - w T)):
!>
!> the attenuated wave moves with the surface, the complementary one is launched by the inlet and moves with the oil
!> (Greenwood and Morales-Espejel 1994; Hooke 2006). With the state of the contact centre, and where the pressure
!> gradient is small beside the effect of sliding on viscosity, the linear Reynolds equation gives a and psi in closed
!> form. The wave launched by the inlet, c, has no formula.
module ehlwave_two_waves
   use ehlwave_kinds, only: dp, no_value
   implicit none (type, external)
   private
   public :: fit_two_waves

   complex(dp), parameter :: i_unit = (0, 1)

   !> State of the contact that a small wave meets, taken as uniform.
   type, public :: wave_medium_t
      real(dp) :: rho = 1               !! rho/rho0
      real(dp) :: drho = 0              !! d rho/dP
      real(dp) :: h = 1                 !! H
      real(dp) :: eps(2) = 1            !! rho H^3/(eta lambdabar) times the tangent factor, along X and along Y
      real(dp) :: kappa = 1             !! ellipticity; of a line contact, whose Y is in units of a, 1
      real(dp) :: k = 1                 !! complete elliptic integral K; of a line contact 1
   contains
      procedure :: attenuated
      procedure :: complementary_number
      procedure, private :: deflection
   end type wave_medium_t

   complex(dp), parameter :: no_number = (no_value, no_value)

   !> The two waves of a film, amplitudes over Ai. All NaN where they cannot be separated, as near S = 1.
   type, public :: two_waves_t
      complex(dp) :: attenuated = no_number      !! a
      complex(dp) :: complementary = no_number   !! c
      complex(dp) :: psi = no_number             !! from the film; NaN where c is lost in the residual
      real(dp) :: misfit = no_value              !! rms of the residual
   end type two_waves_t

   integer, parameter :: newton_steps = 20, fit_steps = 20
   ! Step of psi, after which the next is negligible: the method is quadratic
   real(dp), parameter :: newton_step = 1e-7_dp
   real(dp), parameter :: smallest_step = 1e-3_dp
   real(dp), parameter :: least_signal = 3      ! |c| over the misfit from which psi can be seen
   ! Least 1 - |correlation|^2: errors of the film grow 10 times in a and c
   real(dp), parameter :: least_difference = 0.01_dp

contains

   !> Deflection under a unit pressure exp(i (kx X + ky Y)), theory eq. (W5): W = 2/(K (kx^2 + kappa^2 ky^2)^(1/2)), of
   !> a line 2/|kx|.
   pure complex(dp) function deflection(self, kx, ky)
      class(wave_medium_t), intent(in) :: self
      complex(dp), intent(in) :: kx     !! wave number along X, 1/a
      real(dp), intent(in) :: ky        !! wave number along Y, 1/b
      deflection = 2/(self%k*sqrt(kx**2 + (self%kappa*ky)**2))
   end function deflection

   !> Attenuated wave over Ai, theory eq. (S5). From the change of mass
   !> (kx - w)(rho' H p + rho h) = i (eps_x kx^2 + eps_y kappa^2 ky^2) p and h = 1 + W p,
   !>
   !>     a = 1/(1 + i (1 - S) kx rho W/(eps_x kx^2 + eps_y kappa^2 ky^2 + i (1 - S) kx rho' H)).
   pure complex(dp) function attenuated(self, kx, ky, slip)
      class(wave_medium_t), intent(in) :: self
      real(dp), intent(in) :: kx, ky    !! wave numbers, 1/a and 1/b
      real(dp), intent(in) :: slip      !! S
      complex(dp) :: rate
      rate = i_unit*(1 - slip)*kx
      attenuated = 1/(1 + rate*self%rho*self%deflection(cmplx(kx, 0, dp), ky) &
                      /(self%eps(1)*kx**2 + self%eps(2)*(self%kappa*ky)**2 + rate*self%drho*self%h))
   end function attenuated

   !> Wave number of the complementary wave along X, theory eq. (S6): of
   !>
   !>     eps_x psi^2 + eps_y kappa^2 ky^2 + i (psi - w)(rho W(psi) + rho' H) = 0
   !>
   !> the only root in the first quadrant; w where no pressure drives a flow. Over rho W |k| and times
   !> s = (psi^2 + kappa^2 ky^2)^(1/2) it reads
   !>
   !>     (e_x psi^2 + e_y kappa^2 ky^2 + i q (psi - w)) s + i (psi - w) = 0.
   !>
   !> With s of psi = w this is a quadratic equation, from whose root Newton's method starts, as in the Python package
   !> (contact/medium.py). NaN where it does not converge, or to another root.
   pure complex(dp) function complementary_number(self, frequency, ky) result(psi)
      class(wave_medium_t), intent(in) :: self
      real(dp), intent(in) :: frequency !! w = kx S, not 0
      real(dp), intent(in) :: ky        !! wave number along Y, 1/b
      complex(dp) :: change, flow, q, s, still
      real(dp) :: across, e_x, stiffness
      integer :: n

      across = (self%kappa*ky)**2
      stiffness = 2*self%rho/self%k
      e_x = self%eps(1)/stiffness
      q = i_unit*self%drho*self%h/stiffness
      still = self%eps(2)*across/stiffness - q*frequency
      s = sqrt(frequency**2 + across)
      psi = smaller_root(e_x*s, q*s + i_unit, still*s - i_unit*frequency)
      do n = 1, newton_steps
         s = sqrt(psi**2 + across)
         flow = (e_x*psi + q)*psi + still
         change = (flow*s + i_unit*(psi - frequency))/((2*e_x*psi + q)*s + flow*psi/s + i_unit)
         psi = psi - change
         if (abs(change) <= newton_step*abs(psi)) exit
      end do
      if (.not. (abs(change) <= newton_step*abs(psi) .and. min(psi%re, psi%im) > -newton_step*abs(psi))) psi = no_number
   end function complementary_number

   !> The root of smaller size of square psi^2 + middle psi + rest = 0.
   pure complex(dp) function smaller_root(square, middle, rest)
      complex(dp), intent(in) :: square, middle, rest
      complex(dp) :: root
      root = sqrt(middle**2 - 4*square*rest)
      if (real(conjg(middle)*root, dp) < 0) root = -root
      smaller_root = -2*rest/(middle + root)
   end function smaller_root

   !> Both waves in a film amplitude h over Ai at places x: a and c by least squares with the wave number psi given,
   !> then the psi that best describes the rest.(A fit of all three at once fails: psi and c then absorb the change of
   !> the larger wave along the contact.) `shape` is a(x)/a(0) and c(x)/c(0): the attenuated wave is in balance with
   !> the oil where it is, the complementary one keeps its share of a film that flows through.
   pure function fit_two_waves(x, h, kx, psi, shape) result(fit)
      real(dp), intent(in) :: x(:)            !! X, at least 3
      complex(dp), intent(in) :: h(:)         !! amplitude of H over Ai there
      real(dp), intent(in) :: kx              !! wave number of the pattern, 1/a
      complex(dp), intent(in) :: psi          !! wave number of the complementary wave, 1/a
      complex(dp), intent(in) :: shape(:, :)  !! shapes of the attenuated and the complementary wave at x
      type(two_waves_t) :: fit
      complex(dp) :: amplitude(2), wave(size(x), 2)

      wave(:, 1) = shape(:, 1)*exp(i_unit*kx*x)
      wave(:, 2) = shape(:, 2)*exp(i_unit*psi*x)
      if (.not. 1 - abs(dot_product(wave(:, 1), wave(:, 2)))**2/(sum(abs(wave(:, 1))**2)*sum(abs(wave(:, 2))**2)) &
          >= least_difference) return
      call least_squares(wave, h, amplitude, fit%misfit)
      fit%attenuated = amplitude(1)
      fit%complementary = amplitude(2)
      if (abs(amplitude(2)) >= least_signal*fit%misfit) &
         fit%psi = fitted_number(x, (h - amplitude(1)*wave(:, 1))/shape(:, 2), psi)
   end function fit_two_waves

   !> Wave number of the single wave nearest to h, by Gauss-Newton steps that are halved until the residual falls.
   pure complex(dp) function fitted_number(x, h, start) result(psi)
      real(dp), intent(in) :: x(:)
      complex(dp), intent(in) :: h(:)
      complex(dp), intent(in) :: start      !! first guess
      complex(dp) :: change(2), wave(size(x), 2)
      real(dp) :: left, least, step
      integer :: n

      psi = start
      least = huge(least)
      change = 0
      do n = 1, fit_steps
         step = 1
         do
            wave(:, 1) = exp(i_unit*(psi + step*change(2))*x)
            call least_squares(wave(:, :1), h, change(:1), left)
            if (left < least) exit
            step = step/2
            if (step < smallest_step) return
         end do
         psi = psi + step*change(2)
         least = left
         wave(:, 2) = i_unit*change(1)*x*wave(:, 1)
         call least_squares(wave, h, change, left)
      end do
   end function fitted_number

   !> Coefficients of few columns that come nearest to b, by modified Gram-Schmidt orthogonalisation.
   pure subroutine least_squares(columns, b, coefficient, misfit)
      complex(dp), intent(in) :: columns(:, :), b(:)   !! (m, n), (m)
      complex(dp), intent(out) :: coefficient(:)       !! (n)
      real(dp), intent(out) :: misfit                  !! rms of the residual
      complex(dp) :: left(size(b)), q(size(b), size(columns, 2)), r(size(columns, 2), size(columns, 2))
      integer :: i, j

      q = columns
      left = b
      do j = 1, size(q, 2)
         r(j, j) = norm2(abs(q(:, j)))
         q(:, j) = q(:, j)/r(j, j)
         do i = j + 1, size(q, 2)
            r(j, i) = dot_product(q(:, j), q(:, i))
            q(:, i) = q(:, i) - r(j, i)*q(:, j)
         end do
         coefficient(j) = dot_product(q(:, j), left)
         left = left - coefficient(j)*q(:, j)
      end do
      misfit = norm2(abs(left))/sqrt(real(size(b), dp))
      do j = size(q, 2), 1, -1
         coefficient(j) = (coefficient(j) - sum(r(j, j + 1:)*coefficient(j + 1:)))/r(j, j)
      end do
   end subroutine least_squares

end module ehlwave_two_waves
