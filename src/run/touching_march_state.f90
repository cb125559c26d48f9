!> A march of surfaces that touch as checkpoints keep it.
module ehlwave_touching_march_state
   use ehlwave_byte_stream, only: bytes_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_march_keeper, only: kept_march_t
   use ehlwave_touching_account_result, only: touching_values_t
   use ehlwave_touching_equations, only: touching_past_t
   use ehlwave_touching_newton, only: touching_solver_t
   use ehlwave_touching_state, only: still_state, touching_state_t
   implicit none (type, external)
   private

   integer, parameter, public :: most_meshes = 3         !! of a case: its own, and wider ones
   integer, parameter :: histories = 6                   !! quantities of each step

   !> All values that the next step depends on, and the account of the steps so far.
   type, extends(kept_march_t), public :: touching_march_t
      type(touching_values_t) :: meshes(most_meshes)     !! results of the meshes that are done, the finest first
      type(touching_state_t) :: steady                   !! smooth surfaces on this mesh, from which the march begins
      integer :: steps = 0                               !! taken so far
      type(touching_values_t) :: values                  !! sums over the time that is measured
      integer, private :: nonlinear_steps = 0, linear_steps = 0
      real(dp), private :: residual = 0, load_error = 0, work = 0
      type(touching_state_t), private :: state
      type(touching_past_t), private :: past
      real(dp), allocatable, private :: rough(:, :)
      real(dp), allocatable, private :: history(:, :)    ! (steps, quantities)
   contains
      procedure :: make_room
      procedure :: gather
      procedure :: restore
      procedure :: pass
   end type touching_march_t

contains

   !> Room for the march of a mesh, so that it can be taken from a checkpoint.
   subroutine make_room(self, grid, steps, steps_per_cell)
      class(touching_march_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: steps               !! of the whole march
      integer, intent(in) :: steps_per_cell

      self%steps = 0
      self%steady = still_state(grid)
      self%state = self%steady
      self%rough = self%steady%p
      if (allocated(self%past%f)) deallocate (self%past%f, self%past%passed)
      allocate (self%past%f(0:grid%nx, 0:grid%ny, steps_per_cell), source=0.0_dp)
      allocate (self%past%passed, source=self%past%f)
      self%history = reshape([real(dp) ::], [steps, histories], pad=[0.0_dp])
   end subroutine make_room

   !> Take the values after some steps from a solver, its state and the account.
   subroutine gather(self, steps, solver, state, result)
      class(touching_march_t), intent(inout) :: self
      integer, intent(in) :: steps
      type(touching_solver_t), intent(in) :: solver
      type(touching_state_t), intent(in) :: state
      type(case_result_t), intent(in) :: result

      self%steps = steps
      self%state = state
      self%past = solver%past
      self%rough = solver%given%rough
      self%work = solver%work()
      self%nonlinear_steps = result%nonlinear_steps
      self%linear_steps = result%linear_steps
      self%residual = result%residual
      self%load_error = result%load_error
      associate (account => result%effects%touching%account)
         self%history = reshape([result%film_history, result%approach_history, account%share_history, &
                                 account%area_history, account%friction_history, account%mean_film_history], &
                                [size(result%film_history), histories])
      end associate
   end subroutine gather

   !> Set a solver, its state and the account to the values of the march.
   subroutine restore(self, solver, state, result)
      class(touching_march_t), intent(in) :: self
      type(touching_solver_t), intent(inout) :: solver
      type(touching_state_t), intent(inout) :: state
      type(case_result_t), intent(inout) :: result

      state = self%state
      solver%past = self%past
      call solver%given%set_rough(self%rough)
      solver%problem%deformation%work = self%work
      result%nonlinear_steps = self%nonlinear_steps
      result%linear_steps = self%linear_steps
      result%residual = self%residual
      result%load_error = self%load_error
      result%film_history = self%history(:, 1)
      result%approach_history = self%history(:, 2)
      associate (account => result%effects%touching%account)
         account%share_history = self%history(:, 3)
         account%area_history = self%history(:, 4)
         account%friction_history = self%history(:, 5)
         account%mean_film_history = self%history(:, 6)
      end associate
   end subroutine restore

   !> Pass all values, for checkpoints.
   subroutine pass(self, bytes)
      class(touching_march_t), intent(inout) :: self
      type(bytes_t), intent(inout) :: bytes
      integer :: n

      do n = 1, most_meshes
         call pass_values(self%meshes(n), bytes)
      end do
      call pass_state(self%steady, bytes)
      call bytes%count(self%steps)
      call bytes%count(self%nonlinear_steps)
      call bytes%count(self%linear_steps)
      call bytes%numbers(self%residual)
      call bytes%numbers(self%load_error)
      call bytes%numbers(self%work)
      call pass_values(self%values, bytes)
      call pass_state(self%state, bytes)
      call bytes%numbers(self%past%f)
      call bytes%numbers(self%past%passed)
      call bytes%numbers(self%rough)
      call bytes%numbers(self%history)
   end subroutine pass

   subroutine pass_values(values, bytes)
      type(touching_values_t), intent(inout) :: values
      type(bytes_t), intent(inout) :: bytes
      call bytes%numbers(values%share)
      call bytes%numbers(values%area)
      call bytes%numbers(values%friction_oil)
      call bytes%numbers(values%speed)
      call bytes%numbers(values%mean_film)
      call bytes%numbers(values%max_contact_pressure)
      call bytes%numbers(values%max_total_pressure)
   end subroutine pass_values

   subroutine pass_state(state, bytes)
      type(touching_state_t), intent(inout) :: state
      type(bytes_t), intent(inout) :: bytes
      call bytes%numbers(state%p)
      call bytes%numbers(state%theta)
      call bytes%numbers(state%c)
      call bytes%numbers(state%h)
      call bytes%numbers(state%delta)
      call bytes%numbers(state%speed)
      call bytes%flags(state%is_touching)
      call bytes%flags(state%is_cavitated)
   end subroutine pass_state

end module ehlwave_touching_march_state
