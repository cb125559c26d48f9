!> Friction by another growth of the pressure spike: any law of the oil, also one that the program does not know.
module added_law
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   !> Shear rate = (tau0/eta) (1 + |sigma|^2)^2 sigma: a power law of the exponent 1/5 under large stresses.
   type, extends(flow_law_t), public :: quintic_law_t
   contains
      procedure :: shear_factor
      procedure :: first_stress
      procedure :: largest_variation
   end type quintic_law_t

contains

   pure subroutine shear_factor(self, n, stress2, s, slope)
      class(quintic_law_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: stress2(n)
      real(dp), intent(out) :: s(n), slope(n)
      s = (1 + stress2)**2
      slope = 2*(1 + stress2)
   end subroutine shear_factor

   pure subroutine first_stress(self, n, rate, stress)
      class(quintic_law_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: rate(n)
      real(dp), intent(out) :: stress(n)
      stress = min(rate, rate**0.2_dp)
      if (self%is_newtonian) stress = rate
   end subroutine first_stress

   elemental real(dp) function largest_variation(self, points)
      class(quintic_law_t), intent(in) :: self
      integer, intent(in) :: points
      largest_variation = merge(0.1_dp*points, huge(1.0_dp), .not. self%is_newtonian)
   end function largest_variation

end module added_law

program test_friction_error
   use added_law, only: quintic_law_t
   use ehlwave_eyring_law, only: eyring_law_t
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_friction_error, only: spike_growth
   use ehlwave_given, only: steady_given
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_shear_stress, only: friction_at
   use ehlwave_state, only: new_state
   use sample_contact, only: bump_pressure, make_level
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test
   real(dp) :: newtonian, quintic, eyring

   newtonian = growth_with()
   quintic = growth_with(quintic_law_t())
   eyring = growth_with(eyring_law_t())
   call test%check(newtonian > 0.05_dp, 'a Newtonian oil')
   call test%check(quintic > 0 .and. quintic < 0.5_dp*newtonian, 'an added law whose stress grows with a power of the viscosity')
   call test%check(eyring > 0 .and. eyring < 0.5_dp*newtonian, 'a law whose stress grows with the logarithm')
   call test%finish()

contains

   !> Change of the friction of a bump of pressure, S = 1.5.
   real(dp) function growth_with(law) result(growth)
      class(flow_law_t), intent(in), optional :: law
      type(level_t) :: level(1)

      call make_level(level(1), 100.0_dp, 1.0_dp, 32, .true.)
      associate (problem => level(1)%problem)
         problem%conditions%slip_parameter = 1.5_dp
         problem%conditions%data%reduced_modulus_pa = 2.26e11_dp
         if (present(law)) then
            call problem%rheology%use_flow(law, 2.26e11_dp*5e6_dp)
            problem%film_flow = problem%rheology%film_flow(problem%conditions%elliptic%k, problem%conditions%lambdabar, 1.5_dp)
         end if
         level(1)%state = new_state(problem%grid)
         level(1)%state%p(:, :) = bump_pressure(problem%grid)
         level(1)%state%delta = 0.5_dp
         call problem%film(steady_given(problem%grid), level(1)%state%p, level(1)%state%delta, level(1)%state%h)
         growth = spike_growth(level, friction_at(problem, level(1)%state))
      end associate
   end function growth_with

end program test_friction_error
