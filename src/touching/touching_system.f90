!> The linear system of a step of Newton's method for a contact whose surfaces may touch, by products with the
!> deformation.
!>
!> Unknowns, with q the change of P + C and the sets held: the change of P at all nodes, or of theta where the film is
!> cavitated; q of nodes where solids bear; Delta; ln(speed) where the share is given. Rows: the oil, the gap where
!> solids bear, the load, the share.
module ehlwave_touching_system
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_deformation, only: deformation_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_real_gmres, only: linear_system_t
   use ehlwave_touching_change, only: touching_change_t
   use ehlwave_touching_equations, only: touching_equations_t
   use ehlwave_touching_factors, only: touching_factors_t
   use ehlwave_touching_oil_change, only: touching_oil_change_t
   use ehlwave_touching_oil_links, only: subtract_links
   use ehlwave_touching_state, only: touching_law_t, touching_state_t
   use ehlwave_touching_unknowns, only: borders, touching_unknowns_t
   use ehlwave_work_unit, only: real_weights
   implicit none (type, external)
   private

   type, extends(linear_system_t), public :: touching_system_t
      type(touching_unknowns_t) :: unknowns
      type(touching_factors_t) :: factors
      class(deformation_t), pointer :: deformation => null()      !! borrowed for the length of a solve,
      type(touching_equations_t), pointer :: equations => null()  !! all three
      type(touching_state_t), pointer :: state => null()
      type(grid_t) :: grid
      type(touching_law_t) :: law
      type(touching_oil_change_t) :: oil
      logical :: is_steady = .true., seeks_speed = .false.
      real(dp), allocatable :: by_speed(:, :)                     !! of the rows of the oil
      real(dp), allocatable :: q(:, :), dh(:, :), dr(:, :), work(:, :)
      real(dp), allocatable :: column(:, :)                       !! (n, borders) inverse of their columns
      real(dp) :: schur(borders, borders) = 0                     !! rows of the borders without the fields
      ! Deformation of these columns; of the last preconditioned vector, whose product GMRES asks for next
      real(dp), allocatable :: deformed(:, :, :), ahead(:, :)
      logical, private :: is_ahead = .false.
   contains
      procedure :: init
      procedure :: pose
      procedure :: release
      procedure :: multiply
      procedure :: precondition
      procedure :: is_spent
      procedure :: count => count_work
   end type touching_system_t

contains

   !> Work space for a problem.
   subroutine init(self, problem)
      class(touching_system_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem

      self%grid = problem%grid
      call self%factors%init(problem)
      call self%unknowns%init(problem%grid)
      call self%oil%init(problem%grid)
      associate (grid => problem%grid)
         call grid%new_field(self%q)
         call grid%new_field(self%dh)
         call grid%new_field(self%dr)
         call grid%new_field(self%work)
         call grid%new_field(self%by_speed)
         call grid%new_field(self%ahead)
         if (allocated(self%deformed)) deallocate (self%deformed)
         allocate (self%deformed(0:grid%nx, 0:grid%ny, borders), source=0.0_dp)
      end associate
   end subroutine init

   !> Take a state at which the equations were linearised, and make the factors, or keep those of the state before.
   subroutine pose(self, problem, law, equations, is_steady, state, sides, keeps_factors)
      class(touching_system_t), intent(inout) :: self
      type(contact_problem_t), intent(in), target :: problem
      type(touching_law_t), intent(in) :: law
      type(touching_equations_t), intent(in), target :: equations
      logical, intent(in) :: is_steady
      type(touching_state_t), intent(in), target :: state
      type(touching_change_t), intent(in) :: sides
      logical, intent(in), optional :: keeps_factors     !! of the same sets; absent: no

      self%deformation => problem%deformation
      self%equations => equations
      self%state => state
      self%law = law
      self%is_steady = is_steady
      self%seeks_speed = sides%seeks_speed
      if (self%seeks_speed) self%by_speed = sides%by_speed
      self%is_ahead = .false.
      if (present(keeps_factors)) then
         if (keeps_factors) return
      end if
      call self%unknowns%choose(self%grid, law%is_soft, state)
      call self%factors%make(self%grid, equations, law, state)
      call self%count(real_weights%factor*self%factors%entries)
      call eliminate_borders(self)
   end subroutine pose

   !> The inverse of the columns of Delta and ln(speed), and their rows after elimination of the fields.
   subroutine eliminate_borders(self)
      class(touching_system_t), intent(inout) :: self
      real(dp), allocatable :: x(:), y(:)
      integer :: b

      if (allocated(self%column)) deallocate (self%column)
      allocate (self%column(self%unknowns%n, borders), x(self%unknowns%n), y(self%unknowns%n), source=0.0_dp)
      do b = 1, merge(borders, 1, self%seeks_speed)
         x = 0
         x(self%unknowns%n - borders + b) = 1
         call multiply(self, x, y)
         y(self%unknowns%n - 1:) = 0
         call invert_fields(self, y, self%column(:, b))
         self%schur(:, b) = -border_rows(self, self%column(:, b))
         call self%deformation%apply(self%q, self%deformed(:, :, b))
      end do
      if (self%seeks_speed) return
      self%schur(:, borders) = [0, 1]
      self%deformed(:, :, borders) = 0
   end subroutine eliminate_borders

   !> Load and share of changes.
   function border_rows(self, x) result(rows)
      class(touching_system_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp) :: rows(borders)
      real(dp), pointer, contiguous :: u(:, :)
      integer :: k
      real(dp) :: share

      u(0:self%grid%nx, 0:self%grid%ny) => x(:size(self%q))
      call self%unknowns%spread_q(x, self%q)
      rows = 0
      rows(1) = load_factor*self%grid%integral(self%q)
      if (.not. self%seeks_speed) return
      share = 0
      do k = 1, size(self%unknowns%node, 2)
         associate (i => self%unknowns%node(1, k), j => self%unknowns%node(2, k))
            share = share + self%grid%weight(j)*(self%q(i, j) - merge(u(i, j), 0.0_dp, self%unknowns%is_full(i, j)))
         end associate
      end do
      rows(2) = load_factor*self%grid%hx*self%grid%hy*share
   end function border_rows

   !> y = A x.
   subroutine multiply(self, x, y)
      class(touching_system_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      real(dp), pointer, contiguous :: u(:, :), r(:, :)
      integer :: k

      associate (grid => self%grid, n => self%unknowns%n)
         u(0:grid%nx, 0:grid%ny) => x(:size(self%q))
         r(0:grid%nx, 0:grid%ny) => y(:size(self%q))
         y(n - 1:) = border_rows(self, x)      ! with q of x
         if (.not. self%seeks_speed) y(n) = x(n)
         if (self%is_ahead) then
            self%dh = self%ahead - x(n - 1)
         else
            call self%deformation%apply(self%q, self%dh)
            self%dh = self%dh - x(n - 1)
         end if
         self%is_ahead = .false.
         call self%count(real_weights%product)
         do k = 1, size(self%unknowns%node, 2)
            associate (i => self%unknowns%node(1, k), j => self%unknowns%node(2, k))
               y(size(self%q) + k) = self%dh(i, j)
               if (self%law%is_soft) y(size(self%q) + k) = y(size(self%q) + k) + self%law%softness/self%state%c(i, j) &
                  *(self%q(i, j) - merge(u(i, j), 0.0_dp, self%unknowns%is_full(i, j)))
            end associate
         end do
         where (.not. self%unknowns%is_free) self%dh = 0
         call self%oil%evaluate(self%unknowns, self%equations, self%state%theta, self%is_steady, u, self%dh, r)
         if (self%seeks_speed) r = r + x(n)*self%by_speed
         r = self%unknowns%weight*r
      end associate
   end subroutine multiply

   !> y = M^(-1) x.
   subroutine precondition(self, x, y)
      class(touching_system_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      real(dp) :: determinant, right(borders), z(borders)

      associate (n => self%unknowns%n, a => self%schur)
         call invert_fields(self, x, y)
         right = x(n - 1:) - border_rows(self, y)
         determinant = a(1, 1)*a(2, 2) - a(1, 2)*a(2, 1)
         z = 0
         if (abs(determinant) > 0) &
            z = [a(2, 2)*right(1) - a(1, 2)*right(2), a(1, 1)*right(2) - a(2, 1)*right(1)]/determinant
         y = y - z(1)*self%column(:, 1)
         if (self%seeks_speed) y = y - z(2)*self%column(:, 2)
         y(n - 1:) = z
         self%is_ahead = size(self%unknowns%node, 2) > 0
         if (self%is_ahead) self%ahead = self%ahead - z(1)*self%deformed(:, :, 1) - z(2)*self%deformed(:, :, 2)
      end associate
   end subroutine precondition

   !> Approximate inverse for the fields alone.
   subroutine invert_fields(self, x, y)
      class(touching_system_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      real(dp), pointer, contiguous :: r(:, :), u(:, :)
      integer :: k

      associate (grid => self%grid, nodes => size(self%q))
         r(0:grid%nx, 0:grid%ny) => x(:nodes)
         self%dr(:, :) = r
         where (self%unknowns%weight > 0) self%dr = r/self%unknowns%weight
         self%work = self%dr
         do k = 1, size(self%unknowns%node, 2)
            self%work(self%unknowns%node(1, k), self%unknowns%node(2, k)) = x(nodes + k)
         end do
         call self%factors%solve(grid, self%state, self%work, self%q)
         self%deformation%work = self%deformation%work + self%factors%operations
         call self%count(real_weights%solve*self%factors%entries + real_weights%cycle)
         u(0:grid%nx, 0:grid%ny) => y(:nodes)
         u = self%q
         do k = 1, size(self%unknowns%node, 2)
            associate (i => self%unknowns%node(1, k), j => self%unknowns%node(2, k))
               y(nodes + k) = self%q(i, j)
               u(i, j) = 0
            end associate
         end do
         y(self%unknowns%n - 1:) = 0
         if (size(self%unknowns%node, 2) > 0) call follow_oil(self, u)
      end associate
   end subroutine invert_fields

   !> Changes of the oil where solids bear, after the changes elsewhere.
   subroutine follow_oil(self, u)
      class(touching_system_t), intent(inout) :: self
      real(dp), intent(inout), contiguous :: u(0:, 0:)   !! changes elsewhere, 0 there
      integer :: k

      self%q = merge(self%q, 0.0_dp, self%unknowns%is_full .or. self%state%is_touching)
      call self%deformation%apply(self%q, self%dh)
      self%ahead = self%dh
      self%work = 0
      do k = 1, size(self%unknowns%node, 2)
         associate (i => self%unknowns%node(1, k), j => self%unknowns%node(2, k))
            self%work(i, j) = self%dr(i, j)
         end associate
      end do
      call subtract_links(self%unknowns, self%equations, self%grid%is_line, self%dh, u, self%work)
      call self%factors%oil%solve(self%grid, self%work, is_transposed=.false.)
      do k = 1, size(self%unknowns%node, 2)
         associate (i => self%unknowns%node(1, k), j => self%unknowns%node(2, k))
            u(i, j) = self%work(i, j)
         end associate
      end do
   end subroutine follow_oil

   !> Add so many operations for each node to the work done on the grid.
   subroutine count_work(self, operations)
      class(touching_system_t), intent(inout) :: self
      integer, intent(in) :: operations
      self%deformation%work = self%deformation%work + real(operations, dp)*size(self%q)
   end subroutine count_work

   !> Give back the problem, the equations and the state.
   subroutine release(self)
      class(touching_system_t), intent(inout) :: self
      nullify (self%deformation, self%equations, self%state)
   end subroutine release

   pure logical function is_spent(self)
      class(touching_system_t), intent(in) :: self
      is_spent = self%unknowns%n < 0
   end function is_spent

end module ehlwave_touching_system
