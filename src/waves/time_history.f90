!> Terms that differences in time take from the steps before, of the oil theory eq. (D5), (D8).
module ehlwave_time_history
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_equations, only: equations_t
   use ehlwave_given, only: given_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_state, only: state_t
   use ehlwave_threads, only: is_shared
   use ehlwave_transport, only: steady_transport, transport_t
   implicit none (type, external)
   private

   !> Latest first.
   type, public :: time_history_t
      real(dp), allocatable :: f(:, :, :)      !! rho H of the steps before, (0:nx, 0:ny, steps); of a starved contact
                                               !! the data of `carry_content`
      real(dp) :: approach(3) = 0              !! Delta of the steps before
      !> Steady difference of the mesh less long steps, for the steady film, (0:nx, 0:ny), theory eq. (D14);
      !> not allocated for steps of at most one cell
      real(dp), allocatable, private :: steady_defect(:, :)
   contains
      procedure :: begin
      procedure :: take
      procedure :: remember
      procedure :: carry
   end type time_history_t

contains

   !> Begin the history of a contact at rest.
   subroutine begin(self, problem, given, state)
      class(time_history_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(given_t), intent(in) :: given         !! with the transport of the march
      type(state_t), intent(in) :: state
      integer :: n

      if (allocated(self%f)) deallocate (self%f)
      allocate (self%f(0:problem%grid%nx, 0:problem%grid%ny, given%transport%history_length()))
      do n = 1, size(self%f, 3)
         call self%remember(problem, given, state)
      end do
      self%approach = state%delta
      if (allocated(self%steady_defect)) deallocate (self%steady_defect)
      if (given%transport%cells_per_step > 1 .and. .not. allocated(given%supply)) &
         self%steady_defect = defect_of(problem%grid, given%transport, self%f)
   end subroutine begin

   !> Steady difference of the mesh less the difference along the characteristic, both of a film that does not change:
   !> theory eq. (D14).
   pure function defect_of(grid, transport, history) result(defect)
      type(grid_t), intent(in) :: grid
      type(transport_t), intent(in) :: transport   !! of the march
      real(dp), intent(in) :: history(0:, 0:, :)   !! f of the steady state, (0:nx, 0:ny, n)
      real(dp) :: defect(0:grid%nx, 0:grid%ny)
      type(transport_t) :: marched, steady
      real(dp), dimension(0:grid%nx) :: of_march, of_steady
      integer :: j

      marched = transport
      steady = steady_transport(grid)
      do j = 0, grid%ny
         call marched%carry_row(grid, j, history(:, j, :))
         of_march = -marched%carried(:, j)
         of_steady = 0
         call marched%subtract(grid%nx, history(:, j, 1), of_march)
         call steady%subtract(grid%nx, history(:, j, 1), of_steady)
         defect(:, j) = of_march - of_steady
      end do
      defect(0, :) = 0
      defect(grid%nx, :) = 0
   end function defect_of

   !> Take the history of a contact through several states.
   subroutine take(self, problem, states)
      class(time_history_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: states(:)     !! the latest first; at least 3, and as many as `f` has
      integer :: n
      do n = 1, size(self%f, 3)
         self%f(:, :, n) = problem%density(states(n)%p)*states(n)%h
      end do
      self%approach = states(1:3)%delta
   end subroutine take

   !> Put the solution of a step at the head.
   subroutine remember(self, problem, given, state)
      class(time_history_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      type(given_t), intent(in) :: given         !! to the solution
      type(state_t), intent(in) :: state
      type(equations_t) :: equations
      integer :: j, n, steps

      associate (history => self%f)
         steps = size(history, 3)
         if (allocated(given%supply)) steps = steps/2
         !$omp parallel do private(n) schedule(static) if (is_shared(size(state%p)))
         do j = 0, ubound(history, 2)
            do n = size(history, 3), 2, -1
               if (n /= steps + 1) history(:, j, n) = history(:, j, n - 1)
            end do
         end do
         if (allocated(given%supply)) then
            call equations%init(problem)
            call equations%evaluate(problem, given, state)
            call equations%content%history_of(equations%flow%rho*state%h, history(:, :, 1), history(:, :, steps + 1))
         else
            history(:, :, 1) = problem%density(state%p)*state%h
         end if
      end associate
      self%approach = [state%delta, self%approach(1:2)]
   end subroutine remember

   !> Terms of earlier times of the next step.
   subroutine carry(self, grid, given)
      class(time_history_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      type(given_t), intent(inout) :: given
      if (allocated(given%supply)) then
         call given%transport%carry_content(grid, self%f)
      else
         call given%transport%carry(grid, self%f)
         if (allocated(self%steady_defect)) given%transport%carried = given%transport%carried + self%steady_defect
      end if
      call given%load%carry(self%approach)
   end subroutine carry

end module ehlwave_time_history
