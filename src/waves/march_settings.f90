!> Settings of a march in time.
module ehlwave_march_settings
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: equation_of_motion, force_balance, load_balance_t
   use ehlwave_surfaces, only: surfaces_t
   implicit none (type, external)
   private

   type, public :: march_settings_t
      type(surfaces_t) :: surfaces
      real(dp) :: film = 0                     !! smooth H(0,0)
      integer :: steps = 0                     !! number of time steps
      integer :: cells_per_step = 1            !! dT = hX cells_per_step/steps_per_cell, at least one of them 1
      integer :: steps_per_cell = 1
      real(dp) :: natural_frequency = 0        !! Omega of the equation of motion; 0: force balance
      real(dp) :: force = 1                    !! load from T > 0 on, over the steady load
      ! the oil offered changes by a factor at the inlet edge from a time on, for so long (0: to the end)
      real(dp) :: oil_factor = 1, oil_change_start = 0, oil_change_length = 0
   contains
      procedure :: time_step
      procedure :: balance
      procedure :: repeat_time
      procedure :: amplitude
      procedure :: oil_share
   end type march_settings_t

   integer, parameter :: most_periods = 4              !! after which a solution is taken to repeat
   real(dp), parameter :: many_steps = 24  !! steps of a period: six points interpolate 1e-5 of a wave between
                                                       !! them
   real(dp), parameter :: whole = 1e-3_dp              !! share of a step

contains

   !> dT on a grid.
   pure real(dp) function time_step(self, grid)
      class(march_settings_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      time_step = grid%hx*self%cells_per_step/self%steps_per_cell
   end function time_step

   !> Balance of a time step on a grid: the equation of motion where a natural frequency is given.
   pure function balance(self, grid, force) result(load)
      class(march_settings_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: force            !! load over the nominal load
      type(load_balance_t) :: load
      load = force_balance(force)
      if (self%natural_frequency > 0) load = equation_of_motion(force, self%natural_frequency, self%time_step(grid))
   end function balance

   !> The smallest amplitude of the patterns, in units of c.
   pure real(dp) function amplitude(self)
      class(march_settings_t), intent(in) :: self
      amplitude = self%surfaces%smallest_amplitude(self%film)
   end function amplitude

   !> Oil offered at time t over the steady supply.
   pure real(dp) function oil_share(self, t) result(share)
      class(march_settings_t), intent(in) :: self
      real(dp), intent(in) :: t
      share = 1
      if (t <= self%oil_change_start) return
      if (self%oil_change_length > 0 .and. t > self%oil_change_start + self%oil_change_length) return
      share = self%oil_factor
   end function oil_share

   !> Time after which a periodic solution repeats at a step of the march, or nearly so: the multiple of the period
   !> nearest to whole steps. Long periods are interpolated between steps.
   pure real(dp) function repeat_time(self, grid)
      class(march_settings_t), intent(in) :: self
      type(grid_t), intent(in) :: grid       !! grid of the march
      real(dp) :: steps(most_periods)
      integer :: n

      steps = self%surfaces%repeat_period()/self%time_step(grid)*[(n, n=1, most_periods)]
      n = 1
      if (steps(1) < many_steps) n = minloc(nint(abs(steps - nint(steps))/whole), 1)
      repeat_time = n*self%surfaces%repeat_period()
   end function repeat_time

end module ehlwave_march_settings
