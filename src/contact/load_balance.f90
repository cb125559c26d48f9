!> The equation of the mutual approach: force balance or equation of motion, one form for both.
module ehlwave_load_balance
   use ehlwave_kinds, only: dp, pi
   implicit none (type, external)
   private
   public :: force_balance, equation_of_motion, harmonic_inertia, held_approach

   real(dp), parameter, public :: load_factor = 3/(2*pi)   !! makes the nominal load 1: 3/(2 pi) int P = 1

   real(dp), parameter :: earlier(3) = [-5.0_dp, 4.0_dp, -1.0_dp]   !! of Delta at T - dT, T - 2 dT, T - 3 dT
   real(dp), parameter :: immovable = 1e8_dp   !! inertia against which pressures move the approach by nothing that
                                               !! counts

   !> Discrete theory eq. (10) and (11):  inertia Delta + carried + (3/(2 pi)) int P dX dY - force = 0.
   type, public :: load_balance_t
      real(dp) :: inertia = 0             !! weight of Delta at the present time; 0: force balance
      real(dp) :: carried = 0             !! inertia terms of earlier times
      real(dp) :: force = 1               !! F(T)
      real(dp), private :: rate = 0       ! 1/(Omega dT)^2
   contains
      procedure :: residual
      procedure :: earlier_weights
      procedure :: carry
   end type load_balance_t

contains

   !> Quasi-static balance, theory eq. (11), under the relative load `force`.
   pure function force_balance(force) result(self)
      real(dp), intent(in) :: force   !! load over the nominal load
      type(load_balance_t) :: self
      self%force = force
   end function force_balance

   !> Balance of a part of a contact, which keeps the approach where it is. The part carries no share of the load that
   !> its error could be measured against: that is the nominal load.
   pure function held_approach(delta, pressure_integral) result(self)
      real(dp), intent(in) :: delta               !! Delta
      real(dp), intent(in) :: pressure_integral   !! int P dX dY over the part
      type(load_balance_t) :: self
      self%inertia = immovable
      self%carried = -immovable*delta + self%force - load_factor*pressure_integral
   end function held_approach

   !> Equation of motion, theory eq. (10), second-order backward difference in time, (D7):
   !>
   !>     (2 Delta_k - 5 Delta_(k-1) + 4 Delta_(k-2) - Delta_(k-3))/(Omega dT)^2
   pure function equation_of_motion(force, natural_frequency, dt) result(self)
      real(dp), intent(in) :: force               !! load over the nominal load
      real(dp), intent(in) :: natural_frequency   !! Omega
      real(dp), intent(in) :: dt                  !! dT
      type(load_balance_t) :: self
      self%force = force
      self%rate = 1/(natural_frequency*dt)**2
      self%inertia = 2*self%rate
   end function equation_of_motion

   !> Weight of Delta in the equation of motion for a change as exp(-i w T): the difference above with
   !> Delta_(k-l) = z^l Delta_k, z = exp(i w dT).
   pure complex(dp) function harmonic_inertia(natural_frequency, dt, frequency)
      real(dp), intent(in) :: natural_frequency   !! Omega
      real(dp), intent(in) :: dt                  !! dT
      real(dp), intent(in) :: frequency           !! w in units of 1/T
      complex(dp) :: z
      z = exp(cmplx(0, frequency*dt, dp))
      harmonic_inertia = (2 - 5*z + 4*z**2 - z**3)/(natural_frequency*dt)**2
   end function harmonic_inertia

   !> Set `carried` from Delta at T - dT, T - 2 dT, T - 3 dT.
   pure subroutine carry(self, history)
      class(load_balance_t), intent(inout) :: self
      real(dp), intent(in) :: history(3)
      self%carried = self%rate*(earlier(1)*history(1) + earlier(2)*history(2) + earlier(3)*history(3))
   end subroutine carry

   !> Derivatives of `carried` by Delta at T - dT, T - 2 dT, T - 3 dT.
   pure function earlier_weights(self) result(weights)
      class(load_balance_t), intent(in) :: self
      real(dp) :: weights(size(earlier))
      weights = self%rate*earlier
   end function earlier_weights

   !> Residual of the balance for a pressure integral and an approach.
   pure real(dp) function residual(self, pressure_integral, delta)
      class(load_balance_t), intent(in) :: self
      real(dp), intent(in) :: pressure_integral   !! int P dX dY
      real(dp), intent(in) :: delta
      residual = self%inertia*delta + self%carried + load_factor*pressure_integral - self%force
   end function residual

end module ehlwave_load_balance
