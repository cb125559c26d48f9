!> The plan of one case, made before it runs: what is computed, on which grid, in how many steps, and why.
module ehlwave_case_plan
   use ehlwave_case_input, only: case_conditions, case_t
   use ehlwave_conditions, only: conditions_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   use ehlwave_resolution, only: fewest_points_per_wave, inlet_length, judge_resolution, resolution_t, wanted_inlet, &
      wanted_points_per_wave
   use ehlwave_rheology, only: density_constant, density_dowson_higginson, new_rheology, rheology_t, &
      viscosity_barus, viscosity_constant, viscosity_roelands
   use ehlwave_text, only: to_text
   use ehlwave_waviness, only: new_waviness, no_waviness, waviness_t
   implicit none (type, external)
   private
   public :: make_plan

   integer, parameter, public :: run_smooth = 1      !! steady state of smooth surfaces only
   integer, parameter, public :: run_standing = 2    !! steady states of a pattern that stands still
   integer, parameter, public :: run_march = 3       !! march in time
   integer, parameter, public :: run_harmonic = 4    !! linear response only

   type, public :: case_plan_t
      type(conditions_t) :: conditions
      type(rheology_t) :: rheology
      type(waviness_t) :: waviness
      integer :: kind = run_smooth
      logical :: responds = .false.                  !! the linear response is computed
      logical :: is_half = .true.                    !! only Y >= 0 is computed
      integer :: cells_x = 0, cells_y = 0            !! of the whole domain
      character(len=:), allocatable :: grid_reason
      real(dp) :: hx = 0, hy = 0
      integer :: cells_per_step = 1, steps_per_cell = 1
      real(dp) :: dt = 0                             !! time step, 0 without march
      integer :: steps = 0                           !! time steps
      integer :: first_sample = 0                    !! step from which the amplitude is measured
      integer :: phases = 0                          !! steady solutions of a standing pattern
      type(resolution_t) :: resolution
      real(dp) :: cost = 0                           !! expected effort, node updates of the finest grid
   end type case_plan_t

   integer, parameter :: grid_sizes(15) = [64, 96, 128, 192, 256, 384, 512, 768, 1024, 1536, 2048, 3072, 4096, 6144, 8192]
   integer, parameter :: most_steps = 1000000
   real(dp), parameter :: outlet_end = 1             !! X of the outlet end of the Hertzian contact

contains

   !> Plan of a completed case. Fails when the case asks for something that cannot be run.
   subroutine make_plan(case, plan, error)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(out) :: plan
      type(error_t), allocatable, intent(inout) :: error
      type(case_t) :: copy
      real(dp) :: kappa

      copy = case
      call case_conditions(copy, plan%conditions, error)
      if (allocated(error)) return
      kappa = plan%conditions%elliptic%kappa
      plan%rheology = new_rheology(viscosity_number(case), density_number(case, plan%conditions), &
                                   plan%conditions%alphabar, case%roelands_index, plan%conditions%hertz_pressure_pa)
      plan%waviness = no_waviness()
      if (case%orientation /= 'none') &
         plan%waviness = new_waviness(case%wavelength_x_over_a, kappa*case%wavelength_y_over_a, case%oblique, &
                                      case%x_min, case%slip_parameter)
      plan%is_half = case%domain == 'auto' .and. plan%waviness%is_symmetric()
      call choose_grid(case, plan)

      plan%responds = plan%waviness%is_present .and. case%response /= 'transient'
      if (plan%responds .and. case%response == 'harmonic') then
         plan%kind = run_harmonic
         plan%steps_per_cell = nint(1/min(1.0_dp, case%time_step_over_cell))
      else if (plan%waviness%moves() .or. case%end_time > 0) then
         call plan_march(case, plan, error)
      else if (plan%waviness%is_present) then
         plan%kind = run_standing
         plan%phases = merge(8, 2, plan%waviness%wavelength_x > 0)
      end if
      if (allocated(error)) return
      plan%resolution = judge_resolution(plan%conditions, plan%waviness, plan%hx, plan%hy, plan%dt)
      plan%cost = real(plan%cells_x, dp)*plan%cells_y*(15 + 6*plan%phases + 4*plan%steps + merge(8, 0, plan%responds))
      if (plan%is_half) plan%cost = 0.5_dp*plan%cost
   end subroutine make_plan

   pure integer function viscosity_number(case)
      type(case_t), intent(in) :: case
      select case (case%viscosity_law)
      case ('barus'); viscosity_number = viscosity_barus
      case ('isoviscous'); viscosity_number = viscosity_constant
      case default; viscosity_number = viscosity_roelands
      end select
   end function viscosity_number

   !> With L = 0 the pressure in pascal is unknown and the density law has nothing to work on.
   pure integer function density_number(case, conditions)
      type(case_t), intent(in) :: case
      type(conditions_t), intent(in) :: conditions
      density_number = density_dowson_higginson
      if (case%density_law == 'incompressible' .or. conditions%hertz_pressure_pa <= 0) density_number = density_constant
   end function density_number

   !> Cells as asked, or the smallest of a list of sizes that resolves inlet sweep and waves.
   subroutine choose_grid(case, plan)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(inout) :: plan
      real(dp) :: length_x, length_y, wanted_x, wanted_y
      character(len=:), allocatable :: why_x, why_y

      length_x = case%x_max - case%x_min
      length_y = 2*case%y_max
      plan%cells_x = case%cells_x
      why_x = 'asked for'
      if (plan%cells_x == 0) then
         wanted_x = length_x*inlet_length(plan%conditions)**(-1)/wanted_inlet
         why_x = 'for hX sqrt(gamma M/L) <= '//to_text(wanted_inlet, 2)
         if (plan%waviness%wavelength_x > 0) then
            if (wanted_points_per_wave*length_x*max(1.0_dp, plan%waviness%slip)/plan%waviness%wavelength_x > wanted_x) then
               wanted_x = wanted_points_per_wave*length_x*max(1.0_dp, plan%waviness%slip)/plan%waviness%wavelength_x
               why_x = 'for '//to_text(wanted_points_per_wave, 3)//' points per wave'
            end if
         end if
         plan%cells_x = smallest_size(wanted_x, case%largest_cells)
         if (plan%cells_x < wanted_x) why_x = why_x//', limited'
      end if
      plan%cells_y = case%cells_y
      why_y = 'asked for'
      if (plan%cells_y == 0) then
         wanted_y = 0.5_dp*plan%cells_x*length_y/length_x
         why_y = 'for hY <= 2 hX'
         if (plan%waviness%wavelength_y > 0) then
            if (wanted_points_per_wave*length_y/plan%waviness%wavelength_y > wanted_y) then
               wanted_y = wanted_points_per_wave*length_y/plan%waviness%wavelength_y
               why_y = 'for '//to_text(wanted_points_per_wave, 3)//' points per wave'
            end if
         end if
         plan%cells_y = smallest_size(wanted_y, case%largest_cells)
         if (plan%cells_y < wanted_y) why_y = why_y//', limited'
      end if
      plan%grid_reason = 'X: '//why_x//'; Y: '//why_y
      plan%hx = length_x/plan%cells_x
      plan%hy = length_y/plan%cells_y
   end subroutine choose_grid

   pure integer function smallest_size(wanted, largest)
      real(dp), intent(in) :: wanted
      integer, intent(in) :: largest
      integer :: i
      do i = 1, size(grid_sizes)
         smallest_size = grid_sizes(i)
         if (smallest_size >= wanted*(1 - 1e-9_dp) .or. smallest_size >= largest) exit
      end do
   end function smallest_size

   !> Steps until the slower of the surface pattern (speed S) and of the pattern in the lubricant (speed 1) has
   !> passed the outlet end, `settling_periods` more (measured: long waves, lambda = 2 a, are 2 per cent off in the
   !> first period and below 0.1 per cent in the second), then one period. An `end_time` overrides this.
   subroutine plan_march(case, plan, error)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(inout) :: plan
      type(error_t), allocatable, intent(inout) :: error
      real(dp) :: settled, total

      plan%kind = run_march
      if (case%time_step_over_cell >= 1) then
         plan%cells_per_step = nint(case%time_step_over_cell)
      else
         plan%steps_per_cell = nint(1/case%time_step_over_cell)
      end if
      plan%dt = plan%hx*plan%cells_per_step/plan%steps_per_cell
      if (plan%waviness%moves()) then
         settled = (outlet_end - case%x_min)/min(1.0_dp, plan%waviness%slip) &
                   + case%settling_periods*plan%waviness%period()
         total = settled + plan%waviness%period()
         if (case%end_time > 0) then
            total = case%end_time
            settled = max(0.0_dp, total - plan%waviness%period())
         end if
      else
         settled = case%end_time
         total = case%end_time
      end if
      if (total/plan%dt > most_steps) then
         call raise(error, 'the case needs '//to_text(total/plan%dt, 3)//' time steps, more than '// &
                    to_text(most_steps)//': with slip_parameter near 0 the pattern hardly moves; use 0 for a pattern '// &
                    'that stands still, or set &dynamics end_time')
         return
      end if
      plan%steps = ceiling(total/plan%dt - 1e-9_dp)
      plan%first_sample = ceiling(settled/plan%dt - 1e-9_dp)
   end subroutine plan_march

end module ehlwave_case_plan
