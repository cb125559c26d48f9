!> The unknowns of a contact whose surfaces may touch, and the law of the solids' pressure.
module ehlwave_touching_state
   use ehlwave_conditions, only: conditions_t
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp, pi
   use ehlwave_touching_data, only: soft, touching_data_t
   use ehlwave_waviness, only: waviness_t
   implicit none (type, external)
   private
   public :: hertz_state, new_touching_law, prolonged, rough_at_rest, still_state

   !> Theory eq. (Z3): solids bear where the gap is the boundary film, or below it by the logarithm of their pressure.
   type, public :: touching_law_t
      real(dp) :: film = 0                         !! H_b
      logical :: is_soft = .false.
      real(dp) :: softness = 0, stress = 1         !! sigma/c, C_0/ph
   contains
      procedure :: excess
      procedure :: first_pressure
      procedure :: touches
   end type touching_law_t

   !> All arrays (0:nx, 0:ny).
   type, public :: touching_state_t
      real(dp), allocatable :: p(:, :)             !! pressure of the oil
      real(dp), allocatable :: theta(:, :)         !! share of the gap that oil fills, 1 where it is not cavitated
      real(dp), allocatable :: c(:, :)             !! pressure of the solids
      real(dp), allocatable :: h(:, :)             !! film that the oil has
      real(dp) :: delta = 0                        !! mutual approach
      real(dp) :: speed = 0                        !! mean speed, m/s
      logical, allocatable :: is_touching(:, :), is_cavitated(:, :)
   contains
      procedure :: run_dry
      procedure :: move_on
      procedure, private :: keep_to_sets
   end type touching_state_t

   real(dp), parameter :: steepest = 60            !! largest logarithm of C/C_0 of a first guess: far beyond solutions
   real(dp), parameter :: faint = 25               !! softnesses above the boundary film beyond which C counts as 0

contains

   !> The law in units of a contact.
   pure function new_touching_law(data, conditions) result(self)
      type(touching_data_t), intent(in) :: data
      type(conditions_t), intent(in) :: conditions
      type(touching_law_t) :: self
      self%film = data%film_m/conditions%c_m
      self%is_soft = data%law == soft
      if (.not. self%is_soft) return
      self%softness = data%softness_m/conditions%c_m
      self%stress = data%stress_pa/conditions%hertz_pressure_pa
   end function new_touching_law

   !> Gap above the gap that the solids' pressure asks for.
   elemental real(dp) function excess(self, gap, c)
      class(touching_law_t), intent(in) :: self
      real(dp), intent(in) :: gap, c
      excess = gap - self%film
      if (self%is_soft) excess = excess + self%softness*log(c/self%stress)
   end function excess

   !> Pressure of soft solids at a gap, for a node where they did not bear; limited where the law would overflow.
   elemental real(dp) function first_pressure(self, gap)
      class(touching_law_t), intent(in) :: self
      real(dp), intent(in) :: gap
      first_pressure = self%stress*exp(min(steepest, (self%film - gap)/self%softness))
   end function first_pressure

   !> Whether solids bear at a gap, for a node where they did not.
   elemental logical function touches(self, gap)
      class(touching_law_t), intent(in) :: self
      real(dp), intent(in) :: gap
      touches = gap < self%film
      if (self%is_soft) touches = gap < self%film + faint*self%softness
   end function touches

   !> Waves that stand still: the smallest gap at X = 0 for a phase of 0.
   function rough_at_rest(waves, phase_deg, grid) result(rough)
      type(waviness_t), intent(in) :: waves(:)     !! of the surfaces, with known amplitudes
      real(dp), intent(in) :: phase_deg            !! of the first
      type(grid_t), intent(in) :: grid
      real(dp), allocatable :: rough(:, :)
      real(dp) :: phase
      integer :: n
      call grid%new_field(rough)
      do n = 1, size(waves)
         phase = pi + merge(phase_deg*pi/180, 0.0_dp, n == 1)
         rough = rough + waves(n)%amplitude(0.0_dp)*waves(n)%shape_fixed(grid%x, grid%y, phase)
      end do
   end function rough_at_rest

   !> A full film under the Hertz pressure, whose smallest thickness is at least twice the boundary film.
   subroutine hertz_state(problem, film, rough, state)
      type(contact_problem_t), intent(inout) :: problem
      real(dp), intent(in) :: film                 !! thickness to begin with
      real(dp), intent(in) :: rough(0:, 0:)        !! Rough, (0:nx, 0:ny)
      type(touching_state_t), intent(out) :: state
      integer :: j

      state = still_state(problem%grid)
      do j = 0, problem%grid%ny
         state%p(:, j) = sqrt(max(0.0_dp, 1 - problem%grid%x**2 - &
                                  merge(0.0_dp, problem%grid%y(j)**2, problem%grid%is_line)))
      end do
      call problem%smooth_film(state%p, 0.0_dp, state%h)
      state%h = state%h + rough
      state%delta = minval(state%h) - film
      state%h = state%h - state%delta
      state%speed = problem%conditions%data%mean_speed_m_per_s
   end subroutine hertz_state

   !> Let the solids bear all the pressure.
   subroutine run_dry(self)
      class(touching_state_t), intent(inout) :: self
      self%is_touching = self%p > 0
      self%c = self%p
      self%p = 0
   end subroutine run_dry

   !> First guess of the state after a step of one cell: differences from a steady state move a cell with the oil.
   pure subroutine move_on(self, steady)
      class(touching_state_t), intent(inout) :: self
      class(touching_state_t), intent(in) :: steady
      integer :: j, last

      last = ubound(self%p, 1) - 1
      do j = 0, ubound(self%p, 2)
         self%p(1:last, j) = max(0.0_dp, self%p(:last - 1, j) + rises(steady%p(:last, j)))
         self%c(1:last, j) = max(0.0_dp, self%c(:last - 1, j) + rises(steady%c(:last, j)))
         self%theta(1:last, j) = max(0.0_dp, min(1.0_dp, self%theta(:last - 1, j) + rises(steady%theta(:last, j))))
         self%is_touching(1:last, j) = self%is_touching(:last - 1, j) .neqv. changes(steady%is_touching(:last, j))
         ! the outlet stays, though its edge may be a few nodes from the steady edge
         self%is_cavitated(1:last, j) = merge(self%is_cavitated(1:last, j), self%is_cavitated(:last - 1, j), &
                                              steady%is_cavitated(1:last, j))
      end do
      self%is_touching = self%is_touching .and. self%c > 0
      call self%keep_to_sets()

   contains

      !> Differences to the node upstream.
      pure function rises(line) result(values)
         real(dp), intent(in) :: line(0:)
         real(dp) :: values(ubound(line, 1))
         values = line(1:) - line(:ubound(line, 1) - 1)
      end function rises

      !> Whether a node and the node upstream are in different sets.
      pure function changes(line) result(values)
         logical, intent(in) :: line(0:)
         logical :: values(ubound(line, 1))
         values = line(1:) .neqv. line(:ubound(line, 1) - 1)
      end function changes

   end subroutine move_on

   !> C only where solids bear, P only where the gap is full.
   pure subroutine keep_to_sets(self)
      class(touching_state_t), intent(inout) :: self
      where (.not. self%is_touching) self%c = 0
      where (self%is_cavitated)
         self%p = 0
      elsewhere
         self%theta = 1
      end where
   end subroutine keep_to_sets

   !> A full gap of no height, without pressure.
   function still_state(grid) result(state)
      type(grid_t), intent(in) :: grid
      type(touching_state_t) :: state
      call grid%new_field(state%p)
      call grid%new_field(state%c)
      call grid%new_field(state%h)
      call grid%new_field(state%theta)
      state%theta = 1
      allocate (state%is_touching(0:grid%nx, 0:grid%ny), state%is_cavitated(0:grid%nx, 0:grid%ny), source=.false.)
   end function still_state

   !> A state on the grid with twice as many cells: linear in between, touching or cavitated where both neighbours are.
   function prolonged(coarse, grid) result(fine)
      type(touching_state_t), intent(in) :: coarse
      type(grid_t), intent(in) :: grid             !! of the result
      type(touching_state_t) :: fine

      fine = still_state(grid)
      fine%p = between(coarse%p)
      fine%c = between(coarse%c)
      fine%h = between(coarse%h)
      fine%theta = between(coarse%theta)
      fine%is_touching = between(merge(1.0_dp, 0.0_dp, coarse%is_touching)) > 0.9_dp
      fine%is_cavitated = between(merge(1.0_dp, 0.0_dp, coarse%is_cavitated)) > 0.9_dp
      call fine%keep_to_sets()
      fine%delta = coarse%delta
      fine%speed = coarse%speed

   contains

      function between(field) result(values)
         real(dp), intent(in) :: field(0:, 0:)
         real(dp), allocatable :: values(:, :), rows(:, :)
         integer :: i, j
         allocate (values(0:grid%nx, 0:grid%ny), rows(0:grid%nx, 0:ubound(field, 2)))
         do i = 0, grid%nx
            rows(i, :) = 0.5_dp*(field(i/2, :) + field((i + 1)/2, :))
         end do
         do j = 0, grid%ny
            values(:, j) = 0.5_dp*(rows(:, j/grid%row_ratio) + rows(:, (j + grid%row_ratio - 1)/grid%row_ratio))
         end do
      end function between

   end function prolonged

end module ehlwave_touching_state
