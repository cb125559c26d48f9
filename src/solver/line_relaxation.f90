!> Hybrid line relaxation of the contact problem, lines along X.
!>
!> Venner (1991); Venner and Lubrecht, Multilevel Methods in Lubrication (2000), chapter 6. The pressures of a line are
!> changed together, by changes of two kinds (`ehlwave_relaxation_change`) whose strengths are the unknowns of a linear
!> system (`ehlwave_line_system`). Each line sees the pressure changes of those before it (Gauss-Seidel), and their
!> deformation at the end of the sweep only (Jacobi). Threads make the matrix of a line and its factors, which do not
!> see the other lines, ahead of its turn.
module ehlwave_line_relaxation
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_equations, only: equations_t
   use ehlwave_given, only: given_t
   use ehlwave_kinds, only: dp
   use ehlwave_line_system, only: line_system_t, new_line_system
   use ehlwave_real_wedge, only: wedge_t
   use ehlwave_relaxation_change, only: new_relaxation_change, relaxation_change_t, single
   use ehlwave_state, only: state_t
   use ehlwave_step_limit, only: step_limit_t
   use ehlwave_threads, only: announce, await, is_shared, team_size, thread_count, thread_number
   use ehlwave_work_unit, only: relaxation_operations
   implicit none (type, external)
   private

   real(dp), parameter :: damping = 0.9_dp             ! factor of both kinds of change

   !> Lines that a thread takes at once. A line reads its neighbours: with single lines, each thread reads the whole
   !> grid. Steady state of M = 100, D = 1 on 1024^2 cells, two threads on an Intel Xeon, medians of 14 runs in turn:
   !> 0.89 s with 1 line, 0.78, 0.82, 0.86 s with 2, 4, 8.
   integer, parameter :: lines_at_once = 2

   type, public :: line_relaxation_t
      type(relaxation_change_t), private :: kinds               ! kinds of change
      real(dp), allocatable, private :: change(:, :)            ! change of P in this sweep
      type(line_system_t), allocatable, private :: line(:, :)   ! (lines at once, 0:threads-1)
   contains
      procedure :: init
      procedure :: relax
   end type line_relaxation_t

contains

   !> Work space for a problem's grid.
   subroutine init(self, problem)
      class(line_relaxation_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      integer :: i, j, threads

      self%kinds = new_relaxation_change(problem)
      call problem%grid%new_field(self%change)
      threads = merge(thread_count(), 1, is_shared(size(self%change)))
      allocate (self%line(merge(lines_at_once, 1, threads > 1), 0:threads - 1))
      do j = 0, threads - 1
         do i = 1, size(self%line, 1)
            self%line(i, j) = new_line_system(problem%grid%nx - 1, self%kinds%reach)
         end do
      end do
   end subroutine init

   !> One sweep over all lines; then the film of the new pressure.
   subroutine relax(self, problem, given, equations, state, next)
      class(line_relaxation_t), intent(inout) :: self
      type(contact_problem_t), intent(inout) :: problem
      type(given_t), intent(in) :: given
      type(equations_t), intent(in) :: equations      !! evaluated at the state
      type(state_t), intent(inout) :: state
      type(state_t), intent(inout) :: next            !! work space: the state before on return
      type(step_limit_t) :: limit
      integer :: done, i, j, width

      associate (grid => problem%grid, change => self%change)
         problem%deformation%work = problem%deformation%work + relaxation_operations*size(change) &
                                   + equations%flow%film_work()
         done = grid%first_row - 1
         width = size(self%line, 1)
         !$omp parallel num_threads(size(self%line, 2)) private(j)
         !$omp do schedule(static)
         do j = 0, grid%ny
            change(:, j) = 0
         end do
         !$omp end do
         do j = grid%first_row + width*thread_number(), grid%last_row, width*team_size()
            call relax_lines(self, given%transport, equations, state, [j, min(j + width - 1, grid%last_row)], done)
         end do
         !$omp end parallel
         !$omp parallel do private(i) schedule(static) if (is_shared(size(change)))
         do j = 0, grid%ny
            next%p(:, j) = state%p(:, j)
            if (j < grid%first_row .or. j > grid%last_row) cycle
            do i = 1, grid%nx - 1
               next%p(i, j) = max(0.0_dp, state%p(i, j) + limit%bounded(change(i, j)))
            end do
         end do
         next%delta = state%delta
         call problem%edges%impose(given, state%h, next%p)   ! from the film before the sweep
         call problem%film(given, next%p, next%delta, next%h)
         call limit%shorten(state, next)
         call state%exchange(next)
      end associate
   end subroutine relax

   !> Changes of some lines, in their turn.
   subroutine relax_lines(self, transport, equations, state, lines, done)
      class(line_relaxation_t), intent(inout) :: self
      class(wedge_t), intent(in) :: transport
      type(equations_t), intent(in) :: equations
      type(state_t), intent(in) :: state
      integer, intent(in) :: lines(2)           !! the first and the last
      integer, intent(inout) :: done            !! the last line that is done
      integer :: j

      associate (line => self%line(:, thread_number()), last => equations%mesh%grid%nx - 1)
         do j = lines(1), lines(2)
            associate (line => line(j - lines(1) + 1))
               line%band%n = last_wet(equations%is_cavitated(1:last, j))
               if (line%band%n == 0) cycle
               call line%set_up(self%kinds, transport, equations, j, line%band%n)
               call line%band%factorise()
            end associate
         end do
         call await(done, lines(1) - 1)
         do j = lines(1), lines(2)
            call change_line(self, line(j - lines(1) + 1), equations, state, j)
         end do
         call announce(done, lines(2))
      end associate
   end subroutine relax_lines

   !> Changes of a line whose matrix has been factorised.
   subroutine change_line(self, line, equations, state, j)
      class(line_relaxation_t), intent(inout) :: self
      type(line_system_t), intent(inout) :: line
      type(equations_t), intent(in) :: equations
      type(state_t), intent(in) :: state
      integer, intent(in) :: j
      real(dp) :: strength
      integer :: i, image, jm

      associate (grid => equations%mesh%grid, change => self%change, n => line%band%n)
         jm = grid%below(j)
         image = merge(2, 1, j == 1 .and. grid%is_half)      ! row 0 has row 1 on either side
         change(n + 1:grid%nx - 1, j) = -state%p(n + 1:grid%nx - 1, j)
         if (n > 0) then
            call line%set_right_side(equations, change, j, n)
            call line%band%solve(line%delta)
            do i = 1, n
               if (line%kind(i) == single) then
                  change(i, j) = change(i, j) + damping*line%delta(i)
               else
                  strength = damping*line%delta(i)
                  change(i, j) = change(i, j) + strength
                  change(i - 1, j) = change(i - 1, j) - self%kinds%share_x*strength
                  change(i + 1, j) = change(i + 1, j) - self%kinds%share_x*strength
                  change(i, j + 1) = change(i, j + 1) - self%kinds%share_y*strength
                  if (jm < j) change(i, jm) = change(i, jm) - image*self%kinds%share_y*strength
               end if
            end do
            change(0, j) = 0
            change(grid%nx, j) = 0
         end if
      end associate
   end subroutine change_line

   !> Number of nodes of a line up to the last that is not cavitated.
   pure integer function last_wet(is_cavitated)
      logical, intent(in) :: is_cavitated(:)
      do last_wet = size(is_cavitated), 1, -1
         if (.not. is_cavitated(last_wet)) exit
      end do
   end function last_wet

end module ehlwave_line_relaxation
