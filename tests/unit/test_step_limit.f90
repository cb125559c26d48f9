program test_step_limit
   use ehlwave_kinds, only: dp
   use ehlwave_state, only: state_t
   use ehlwave_step_limit, only: step_limit_t
   use testing, only: test_t
   implicit none (type, external)

   type(test_t) :: test
   type(step_limit_t) :: limit
   type(state_t) :: before, state

   before = of(0.5_dp, 1.0_dp, 2.0_dp)
   state = of(0.6_dp, 0.2_dp, 2.1_dp)
   call limit%shorten(before, state)
   call test%check_close([state%p(0, 0), state%h(0, 0), state%delta], [0.6_dp, 0.2_dp, 2.1_dp], 'a small step is taken', &
                         absolute=0.0_dp)
   state = of(1.1_dp, 0.8_dp, 3.0_dp)
   call limit%shorten(before, state)
   call test%check_close([state%p(0, 0), state%h(0, 0), state%delta], [0.8_dp, 0.9_dp, 2.5_dp], 'a jump of pressure', &
                         relative=1e-14_dp)
   state = of(0.5_dp, -0.8_dp, 3.0_dp)
   call limit%shorten(before, state)
   call test%check_close([state%p(0, 0), state%h(0, 0), state%delta], [0.5_dp, 0.1_dp, 2.5_dp], 'a film that would close', &
                         relative=1e-14_dp)
   state = of(0.5_dp + 1.2_dp, 0.1_dp - 0.9_dp, 6.0_dp)
   call limit%shorten(before, state)
   call test%check_close([state%p(0, 0), state%h(0, 0), state%delta], [0.8_dp, 0.55_dp, 3.0_dp], 'both', relative=1e-14_dp)
   call test%check_close(limit%bounded([0.2_dp, -0.2_dp, 1.5_dp, -1.5_dp]), [0.2_dp, -0.2_dp, 0.3_dp, -0.3_dp], &
                         'nodes on their own', absolute=0.0_dp)
   limit = step_limit_t(largest_change=0.05_dp, smallest_film_factor=0.5_dp)
   call test%check_close([limit%of_pressure(reshape([0.01_dp, -0.2_dp], [2, 1])), limit%of_pressure(reshape([0.05_dp], [1, 1]))], &
                         [0.25_dp, 1.0_dp], 'shorter steps: pressure', relative=1e-14_dp)
   call test%check_close([limit%of_film(reshape([1.0_dp, 2.0_dp], [2, 1]), reshape([-0.4_dp, -4.0_dp], [2, 1]))], [0.25_dp], &
                         'and film', relative=1e-14_dp)
   call test%finish()

contains

   function of(p, h, delta) result(state)
      real(dp), intent(in) :: p, h, delta
      type(state_t) :: state
      allocate (state%p(0:1, 0:0), state%h(0:1, 0:0))
      state%p(:, 0) = [p, 0.0_dp]
      state%h(:, 0) = [h, 1.0_dp]
      state%delta = delta
   end function of

end program test_step_limit
