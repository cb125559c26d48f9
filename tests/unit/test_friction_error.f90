!> Friction by the growth of the pressure spike between its nodes: any law of the oil, also one that the program does not know.
program test_friction_error
   use added_law, only: cubic_law_t
   use ehlwave_eyring_law, only: eyring_law_t
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_film_errors, only: spike_growth
   use ehlwave_given, only: steady_given
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_shear_stress, only: friction_at
   use ehlwave_state, only: new_state
   use sample_contact, only: bump_pressure, make_level
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test
   real(dp) :: newtonian, cubic, eyring

   newtonian = growth_with()
   cubic = growth_with(cubic_law_t())
   eyring = growth_with(eyring_law_t())
   call test%check(newtonian > 0.05_dp, 'a Newtonian oil')
   call test%check(cubic > 0 .and. cubic < 0.5_dp*newtonian, 'an added law whose stress grows with a power of the viscosity')
   call test%check(eyring > 0 .and. eyring < 0.5_dp*newtonian, 'a law whose stress grows with the logarithm')
   call test%finish()

contains

   !> Change of the friction of a bump of pressure, S = 1.5.
   real(dp) function growth_with(law) result(growth)
      class(flow_law_t), intent(in), optional :: law
      type(level_t) :: level

      call make_level(level, 100.0_dp, 1.0_dp, 32, .true.)
      associate (problem => level%problem)
         problem%conditions%slip_parameter = 1.5_dp
         problem%conditions%data%reduced_modulus_pa = 2.26e11_dp
         if (present(law)) then
            call problem%rheology%use_flow(law, 2.26e11_dp*5e6_dp)
            problem%film_flow = problem%rheology%film_flow(problem%conditions%elliptic%k, problem%conditions%lambdabar, 1.5_dp)
         end if
         level%state = new_state(problem%grid)
         level%state%p(:, :) = bump_pressure(problem%grid)
         level%state%delta = 0.5_dp
         call problem%film(steady_given(problem%grid), level%state%p, level%state%delta, level%state%h)
         growth = spike_growth(level, friction_at(problem, level%state))
      end associate
   end function growth_with

end program test_friction_error
