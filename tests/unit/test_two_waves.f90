!> Attenuated and complementary wave: closed forms and the split of a film.
program test_two_waves
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_kinds, only: dp
   use ehlwave_two_waves, only: fit_two_waves, two_waves_t, wave_medium_t
   use testing, only: test_t
   implicit none (type, external)

   complex(dp), parameter :: i_unit = (0, 1)
   ! close to a contact with M = 100, L = 12.05 and a Ree-Eyring oil under slip
   type(wave_medium_t), parameter :: medium = wave_medium_t(rho=1.17_dp, drho=0.08_dp, h=0.14_dp, eps=[4e-3_dp, 5e-4_dp], &
                                                             kappa=0.7_dp, k=1.8_dp)
   type(test_t) :: test

   call check_attenuated()
   call check_hooke()
   call check_psi()
   call check_split()
   call check_not_split()
   call test%finish()

contains

   !> Change of mass of the attenuated wave, with the pressure that follows from a = 1 + W p.
   subroutine check_attenuated()
      real(dp), parameter :: kx = 9, ky = 5, slip = 1.4_dp
      complex(dp) :: a, p
      real(dp) :: deflection

      a = medium%attenuated(kx, ky, slip)
      deflection = 2/(medium%k*sqrt(kx**2 + (medium%kappa*ky)**2))
      p = (a - 1)/deflection
      associate (flow => (medium%eps(1)*kx**2 + medium%eps(2)*(medium%kappa*ky)**2)*p, &
                 carried => i_unit*kx*(1 - slip)*(medium%rho*a + medium%drho*medium%h*p))
         call test%check(abs(flow + carried) <= 1e-14_dp*abs(flow), 'mass of the attenuated wave')
      end associate
      call test%check_close(abs(medium%attenuated(kx, 0.0_dp, 1.0_dp) - 1), 0.0_dp, 'pure rolling', relative=0.0_dp)
      call test%check_close(abs(medium%attenuated(kx, ky, 2 - slip) - conjg(a)), 0.0_dp, 'S and 2 - S', absolute=1e-15_dp)
   end subroutine check_attenuated

   !> Incompressible oil far in the Eyring regime, tangent factor B: neither viscosity nor speed nor slip changes a (Hooke).
   subroutine check_hooke()
      real(dp), parameter :: n0 = 3, h = 0.2_dp, kx = 12
      real(dp) :: eta, lambdabar, slip
      type(wave_medium_t) :: oil
      complex(dp) :: a(3)
      integer :: n

      do n = 1, 3
         eta = 1e3_dp*10**n
         lambdabar = 0.1_dp/n
         slip = 1 + 0.2_dp*n
         associate (factor => lambdabar*n0/3*(slip - 1)*eta/h)
            oil = wave_medium_t(h=h, eps=h**3/(eta*lambdabar)*factor)
         end associate
         a(n) = oil%attenuated(kx, 0.0_dp, slip)
      end do
      call test%check(maxval(abs(a - a(1))) <= 1e-14_dp, 'a is that of the stress alone')
   end subroutine check_hooke

   !> The wave number is a root with Im psi > 0, and w where little flows.
   subroutine check_psi()
      real(dp), parameter :: waves(4) = [3.0_dp, 6.0_dp, 12.0_dp, 24.0_dp], across(2) = [0.0_dp, 5.0_dp]
      ! no oil lets a hundred times as much through across sliding as along
      type(wave_medium_t), parameter :: odd = wave_medium_t(rho=1.17_dp, drho=0.08_dp, h=0.14_dp, eps=[1e-2_dp, 1.0_dp], &
                                                            kappa=1.0_dp, k=1.8_dp)
      type(wave_medium_t) :: stiff
      complex(dp) :: flow, psi
      integer :: i, j

      do i = 1, size(waves)
         do j = 1, size(across)
            psi = medium%complementary_number(waves(i), across(j))
            flow = medium%eps(1)*psi**2 + medium%eps(2)*(medium%kappa*across(j))**2
            associate (carried => i_unit*(psi - waves(i))*(medium%drho*medium%h &
                                                           + medium%rho*2/(medium%k*sqrt(psi**2 + (medium%kappa*across(j))**2))))
               call test%check(abs(flow + carried) <= 1e-9_dp*abs(flow), 'root for psi')
            end associate
            call test%check(aimag(psi) > 0, 'the wave fades along X')
         end do
      end do
      stiff = medium
      stiff%eps = 1e-12_dp
      call test%check_close(abs(stiff%complementary_number(6.0_dp, 0.0_dp) - 6), 0.0_dp, 'little flow', absolute=1e-8_dp)
      psi = odd%complementary_number(40.0_dp, 3.0_dp)
      call test%check(.not. (ieee_is_finite(psi%re) .or. ieee_is_finite(psi%im)), 'no wave number where it is lost')
   end subroutine check_psi

   !> Two waves in, two waves out; something else beside them is left.
   subroutine check_split()
      complex(dp), parameter :: a = (0.4_dp, -0.3_dp), c = (0.1_dp, 0.15_dp), psi = (8.0_dp, 1.5_dp)
      real(dp), parameter :: kx = 6
      complex(dp) :: h(33), shape(33, 2)
      real(dp) :: x(33)
      type(two_waves_t) :: fit
      integer :: i

      x = [(i/32.0_dp - 0.5_dp, i=0, 32)]
      shape(:, 1) = 1 + (0.1_dp, 0.2_dp)*x
      shape(:, 2) = 1 - 0.1_dp*x
      h = a*shape(:, 1)*exp(i_unit*kx*x) + c*shape(:, 2)*exp(i_unit*psi*x)
      fit = fit_two_waves(x, h, kx, psi, shape)
      call test%check(abs(fit%attenuated - a) + abs(fit%complementary - c) <= 1e-12_dp, 'amplitudes')
      call test%check(abs(fit%psi - psi) <= 1e-8_dp, 'wave number')
      call test%check(fit%misfit <= 1e-14_dp, 'nothing is left')
      h = a*exp(i_unit*kx*x) + (1e-3_dp*c)*exp(i_unit*psi*x) + 0.02_dp*exp(i_unit*30*x)
      shape = 1
      fit = fit_two_waves(x, h, kx, psi, shape)
      call test%check_close(fit%misfit, 0.02_dp, 'misfit', relative=0.05_dp)
      call test%check(.not. ieee_is_finite(abs(fit%psi)), 'no wave number of a wave that cannot be seen')
   end subroutine check_split

   subroutine check_not_split()
      complex(dp), parameter :: even(33, 2) = 1
      real(dp) :: x(33)
      type(two_waves_t) :: fit
      integer :: i
      x = [(i/32.0_dp - 0.5_dp, i=0, 32)]
      fit = fit_two_waves(x, exp(i_unit*6*x), 6.0_dp, (6.02_dp, 0.01_dp), even)
      call test%check(.not. ieee_is_finite(fit%misfit) .and. .not. ieee_is_finite(abs(fit%attenuated)), 'too alike')
   end subroutine check_not_split

end program test_two_waves
