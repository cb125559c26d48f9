!> A march of surfaces that touch as checkpoints keep it.
module ehlwave_touching_march_state
   use ehlwave_byte_stream, only: bytes_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_kinds, only: dp
   use ehlwave_march_keeper, only: kept_march_t
   use ehlwave_touching_account_result, only: touching_values_t
   use ehlwave_touching_equations, only: touching_past_t
   use ehlwave_touching_newton, only: touching_solver_t
   use ehlwave_touching_state, only: touching_state_t
   implicit none (type, external)
   private

   !> All values that the next step depends on, and the account of the steps so far.
   type, extends(kept_march_t), public :: touching_march_t
      integer :: steps = 0                               !! taken so far
      type(touching_values_t) :: values                  !! sums over the time that is measured
      integer, private :: nonlinear_steps = 0, linear_steps = 0
      real(dp), private :: residual = 0, load_error = 0, work = 0
      type(touching_state_t), private :: state
      type(touching_past_t), private :: past
      real(dp), allocatable, private :: rough(:, :)
      real(dp), allocatable, private :: history(:, :)    ! (steps, quantities)
   contains
      procedure :: gather
      procedure :: restore
      procedure :: pass
   end type touching_march_t

contains

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
                                [size(result%film_history), 6])
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

      call bytes%count(self%steps)
      call bytes%count(self%nonlinear_steps)
      call bytes%count(self%linear_steps)
      call bytes%numbers(self%residual)
      call bytes%numbers(self%load_error)
      call bytes%numbers(self%work)
      call bytes%numbers(self%values%share)
      call bytes%numbers(self%values%area)
      call bytes%numbers(self%values%friction_oil)
      call bytes%numbers(self%values%speed)
      call bytes%numbers(self%values%mean_film)
      call bytes%numbers(self%values%max_contact_pressure)
      call bytes%numbers(self%values%max_total_pressure)
      call bytes%numbers(self%state%p)
      call bytes%numbers(self%state%theta)
      call bytes%numbers(self%state%c)
      call bytes%numbers(self%state%h)
      call bytes%numbers(self%state%delta)
      call bytes%numbers(self%state%speed)
      call bytes%flags(self%state%is_touching)
      call bytes%flags(self%state%is_cavitated)
      call bytes%numbers(self%past%f)
      call bytes%numbers(self%past%passed)
      call bytes%numbers(self%rough)
      call bytes%numbers(self%history)
   end subroutine pass

end module ehlwave_touching_march_state
