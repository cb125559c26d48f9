!> A step of a recorded march with waves everywhere: its data and the solutions that its differences in time take.
module ehlwave_marched_step
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_contact_variant, only: contact_variable_t
   use ehlwave_given, only: given_t
   use ehlwave_kinds, only: dp
   use ehlwave_march_recording, only: march_recording_t
   use ehlwave_march_settings, only: march_settings_t
   use ehlwave_state, only: new_state, state_t
   use ehlwave_time_history, only: time_history_t
   use ehlwave_transport, only: characteristic_transport
   implicit none (type, external)
   private

   integer, parameter :: approaches = 3         !! earlier approaches in the equation of motion

   type, public :: marched_step_t
      type(march_settings_t) :: settings
      type(given_t) :: given
      type(state_t), allocatable :: states(:)   !! the solution and those before, (0:steps_back)
      integer :: steps_back = 0
      integer, private :: step = huge(1)
      type(time_history_t), private :: history
      real(dp), allocatable, private :: smooth(:, :, :)   ! H without waves, (0:nx, 0:ny, 0:steps_back)
   contains
      procedure :: init
      procedure :: load
      procedure :: vary
   end type marched_step_t

contains

   !> A march about a steady state.
   subroutine init(self, problem, settings, recording, steady)
      class(marched_step_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(march_settings_t), intent(in) :: settings
      type(march_recording_t), intent(in) :: recording
      type(state_t), intent(in) :: steady
      integer :: l

      self%settings = settings
      associate (grid => problem%grid, transport => self%given%transport)
         transport = characteristic_transport(grid, settings%cells_per_step, settings%steps_per_cell)
         self%steps_back = max(approaches, transport%history_length())
         if (allocated(self%states)) deallocate (self%states, self%smooth)
         allocate (self%states(0:self%steps_back))
         do l = 0, self%steps_back
            self%states(l) = new_state(grid)
         end do
         allocate (self%smooth(0:grid%nx, 0:grid%ny, 0:self%steps_back))
         self%given%load = settings%balance(grid, settings%force)
      end associate
      self%step = huge(self%step)
      call self%history%begin(problem, self%given, steady)
   end subroutine init

   !> Step k, which comes before the step loaded last, and goes on to the states that both have.
   subroutine load(self, problem, recording, k)
      class(marched_step_t), intent(inout) :: self
      type(contact_problem_t), intent(inout) :: problem
      type(march_recording_t), intent(in) :: recording
      integer, intent(in) :: k                  !! may be 0 or less: the march repeats
      integer :: first, l

      first = max(0, self%steps_back + 1 - min(self%step - k, self%steps_back + 1))
      self%states(:first - 1) = self%states(self%steps_back + 1 - first:)
      self%smooth(:, :, :first - 1) = self%smooth(:, :, self%steps_back + 1 - first:)
      do l = first, self%steps_back
         call recording%look_up(k - l, self%states(l)%p, self%states(l)%delta)
         call problem%smooth_film(self%states(l)%p, self%states(l)%delta, self%smooth(:, :, l))
      end do
      self%step = k
      call pose(self, problem, recording, 0.0_dp)
   end subroutine load

   !> States and data of the step, at times later by a shift.
   subroutine pose(self, problem, recording, shift)
      class(marched_step_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(march_recording_t), intent(in) :: recording
      real(dp), intent(in) :: shift
      real(dp), allocatable :: rough(:, :)
      real(dp) :: time
      integer :: l

      associate (grid => problem%grid, k => self%step)
         do l = self%steps_back, 0, -1
            time = recording%time + (k - l - recording%last)*self%settings%time_step(grid) + shift
            rough = self%settings%surfaces%rough_of_waves(grid%x, grid%y, time, self%settings%film)
            self%states(l)%h = self%smooth(:, :, l) + rough
         end do
         call self%given%set_rough(rough)
         call self%history%take(problem, self%states(1:))
         call self%history%carry(grid, self%given)
      end associate
   end subroutine pose

   !> A step with another input and the same pressures.
   subroutine vary(self, problem, base, variable, k, film_slope, recording, steady)
      class(marched_step_t), intent(inout) :: self
      type(contact_problem_t), intent(inout) :: problem      !! of the variant
      type(marched_step_t), intent(in) :: base
      type(contact_variable_t), intent(in) :: variable
      integer, intent(in) :: k                               !! variant
      real(dp), intent(in) :: film_slope                     !! d ln of the steady H(0,0)/dx
      type(march_recording_t), intent(in) :: recording
      type(state_t), intent(in) :: steady                    !! of the variant, with the same pressure
      type(march_settings_t) :: settings
      integer :: l

      associate (variant => variable%variants(k), main => base%settings%surfaces%main)
         settings = base%settings
         settings%surfaces%list = variant%waves
         settings%film = base%settings%film*exp(variant%place*film_slope)
         settings%natural_frequency = variant%natural_frequency
         call self%init(problem, settings, recording, steady)
         self%step = base%step
         self%states = base%states
         self%smooth = base%smooth
         if (variable%changes_kernel) then
            do l = 0, self%steps_back
               call problem%smooth_film(self%states(l)%p, self%states(l)%delta, self%smooth(:, :, l))
            end do
         end if
         associate (wave => variant%waves(main), own => base%settings%surfaces%list(main))
            call pose(self, problem, recording, wave%start/wave%slip - own%start/own%slip)
         end associate
      end associate
   end subroutine vary

end module ehlwave_marched_step
