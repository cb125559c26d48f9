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
   use ehlwave_real_wedge, only: new_wedge, wedge_t
   use ehlwave_reynolds, only: reynolds_change
   use ehlwave_touching_change, only: touching_change_t
   use ehlwave_touching_equations, only: link_i, link_j, links, touching_equations_t
   use ehlwave_touching_factors, only: touching_factors_t
   use ehlwave_touching_state, only: touching_law_t, touching_state_t
   use ehlwave_work_unit, only: real_weights
   implicit none (type, external)
   private

   integer, parameter :: borders = 2    !! unknowns that are no fields: Delta, ln(speed)

   type, extends(linear_system_t), public :: touching_system_t
      integer :: n = 0                  !! unknowns
      type(touching_factors_t) :: factors
      class(deformation_t), pointer, private :: deformation => null()        ! borrowed for the length of a solve,
      type(touching_equations_t), pointer, private :: equations => null()    ! all three
      type(touching_state_t), pointer, private :: state => null()
      type(grid_t), private :: grid
      type(touching_law_t), private :: law
      type(wedge_t), private :: no_wedge
      logical, private :: is_steady = .true., seeks_speed = .false.
      integer, allocatable, private :: node(:, :)                            ! (2, nodes where solids bear)
      logical, allocatable, private :: is_free(:, :), is_full(:, :)          ! film that deforms; P that is unknown
      real(dp), allocatable, private :: weight(:, :), by_speed(:, :)         ! of the rows of the oil
      real(dp), allocatable, private :: q(:, :), dh(:, :), dr(:, :), work(:, :)
      real(dp), allocatable, private :: column(:, :)                         ! (n, borders) inverse of their columns
      real(dp), private :: schur(borders, borders) = 0
      ! Deformation of these columns; of the last preconditioned vector, whose product GMRES asks for next
      real(dp), allocatable, private :: deformed(:, :, :), ahead(:, :)
      logical, private :: is_ahead = .false.
   contains
      procedure :: init
      procedure :: pose
      procedure :: release
      procedure :: residuals
      procedure :: changes
      procedure :: multiply
      procedure :: precondition
      procedure :: is_spent
      procedure, private :: count => count_work
   end type touching_system_t

contains

   !> Work space for a problem.
   subroutine init(self, problem)
      class(touching_system_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem

      self%grid = problem%grid
      call self%factors%init(problem)
      self%no_wedge = new_wedge(problem%grid%nx)
      associate (grid => problem%grid)
         call grid%new_field(self%q)
         call grid%new_field(self%dh)
         call grid%new_field(self%dr)
         call grid%new_field(self%work)
         call grid%new_field(self%weight)
         call grid%new_field(self%by_speed)
         call grid%new_field(self%ahead)
         if (allocated(self%deformed)) deallocate (self%deformed)
         allocate (self%deformed(0:grid%nx, 0:grid%ny, borders), source=0.0_dp)
         if (allocated(self%is_free)) deallocate (self%is_free, self%is_full)
         allocate (self%is_free(0:grid%nx, 0:grid%ny), self%is_full(0:grid%nx, 0:grid%ny))
      end associate
   end subroutine init

   !> Take a state at which the equations were linearised, and make the factors.
   subroutine pose(self, problem, law, equations, is_steady, state, sides)
      class(touching_system_t), intent(inout) :: self
      type(contact_problem_t), intent(in), target :: problem
      type(touching_law_t), intent(in) :: law
      type(touching_equations_t), intent(in), target :: equations
      logical, intent(in) :: is_steady
      type(touching_state_t), intent(in), target :: state
      type(touching_change_t), intent(in) :: sides
      integer :: i, j, k

      self%deformation => problem%deformation
      self%equations => equations
      self%state => state
      self%law = law
      self%is_steady = is_steady
      self%seeks_speed = sides%seeks_speed
      if (self%seeks_speed) self%by_speed = sides%by_speed
      if (allocated(self%node)) deallocate (self%node)
      allocate (self%node(2, count(state%is_touching)))
      associate (grid => self%grid)
         k = 0
         do j = 0, grid%ny
            do i = 0, grid%nx
               if (.not. state%is_touching(i, j)) cycle
               k = k + 1
               self%node(:, k) = [i, j]
            end do
         end do
         self%n = size(state%p) + k + borders
         self%weight = 0
         self%weight(1:grid%nx - 1, grid%first_row:grid%last_row) = grid%hx
         self%is_free = law%is_soft .or. .not. state%is_touching
         self%is_full = .false.
         self%is_full(1:grid%nx - 1, grid%first_row:grid%last_row) = &
            .not. state%is_cavitated(1:grid%nx - 1, grid%first_row:grid%last_row)
      end associate
      call self%factors%make(self%grid, equations, law, state)
      call self%count(real_weights%factor*self%factors%entries)
      call eliminate_borders(self)
   end subroutine pose

   !> The inverse of the columns of Delta and ln(speed), and their rows after elimination of the fields.
   subroutine eliminate_borders(self)
      class(touching_system_t), intent(inout) :: self
      real(dp), allocatable :: x(:), y(:)
      integer :: b

      self%is_ahead = .false.
      if (allocated(self%column)) deallocate (self%column)
      allocate (self%column(self%n, borders), x(self%n), y(self%n))
      do b = 1, borders
         x = 0
         x(self%n - borders + b) = 1
         call multiply(self, x, y)
         y(self%n - 1:) = 0
         call invert_fields(self, y, self%column(:, b))
         self%schur(:, b) = merge(1, 0, b == borders .and. .not. self%seeks_speed)*[0, 1] &
                            - border_rows(self, self%column(:, b))
         call self%deformation%apply_single(self%q, self%deformed(:, :, b))
      end do
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
      call spread_q(self, x)
      rows = 0
      rows(1) = load_factor*self%grid%integral(self%q)
      if (.not. self%seeks_speed) return
      share = 0
      do k = 1, size(self%node, 2)
         associate (i => self%node(1, k), j => self%node(2, k))
            share = share + self%grid%weight(j)*(self%q(i, j) - merge(u(i, j), 0.0_dp, self%is_full(i, j)))
         end associate
      end do
      rows(2) = load_factor*self%grid%hx*self%grid%hy*share
   end function border_rows

   !> The field q of some unknowns.
   subroutine spread_q(self, x)
      class(touching_system_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), pointer, contiguous :: u(:, :)
      integer :: k
      u(0:self%grid%nx, 0:self%grid%ny) => x(:size(self%q))
      self%q = merge(u, 0.0_dp, self%is_full)
      do k = 1, size(self%node, 2)
         self%q(self%node(1, k), self%node(2, k)) = x(size(self%q) + k)
      end do
   end subroutine spread_q

   !> y = A x.
   subroutine multiply(self, x, y)
      class(touching_system_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      real(dp), pointer, contiguous :: u(:, :), r(:, :)
      integer :: k

      associate (grid => self%grid, n => self%n)
         u(0:grid%nx, 0:grid%ny) => x(:size(self%q))
         r(0:grid%nx, 0:grid%ny) => y(:size(self%q))
         y(n - 1:) = border_rows(self, x)      ! with q of x
         if (.not. self%seeks_speed) y(n) = x(n)
         if (self%is_ahead) then
            self%dh = self%ahead - x(n - 1)
         else
            call self%deformation%apply_single(self%q, self%dh)
            self%dh = self%dh - x(n - 1)
         end if
         self%is_ahead = .false.
         call self%count(real_weights%product)
         do k = 1, size(self%node, 2)
            associate (i => self%node(1, k), j => self%node(2, k))
               y(size(self%q) + k) = self%dh(i, j)
               if (self%law%is_soft) y(size(self%q) + k) = y(size(self%q) + k) + self%law%softness/self%state%c(i, j) &
                  *(self%q(i, j) - merge(u(i, j), 0.0_dp, self%is_full(i, j)))
            end associate
         end do
         where (.not. self%is_free) self%dh = 0
         call oil_change(self, u, r)
         if (self%seeks_speed) r = r + x(n)*self%by_speed
         r = self%weight*r
      end associate
   end subroutine multiply

   !> Change of the residuals of the oil with the film of `dh`.
   subroutine oil_change(self, u, r)
      class(touching_system_t), intent(inout) :: self
      real(dp), intent(in), contiguous :: u(0:, 0:)
      real(dp), intent(out), contiguous :: r(0:, 0:)
      real(dp), dimension(0:self%grid%nx) :: d_theta, df, passed
      integer :: i, j, nx

      nx = self%grid%nx
      self%work = merge(u, 0.0_dp, self%is_full)
      associate (equations => self%equations, theta => self%state%theta, hx => self%grid%hx)
         call reynolds_change(equations%mesh, self%no_wedge, equations%flow, self%work, self%dh, r)
         do j = self%grid%first_row, self%grid%last_row
            df = equations%flow%f_p(:, j)*self%work(:, j) + equations%flow%rho(:, j)*self%dh(:, j)
            d_theta = merge(0.0_dp, u(:, j), self%is_full(:, j))
            passed(0) = df(0)
            do i = 1, nx
               passed(i) = theta(i, j)*equations%own(i, j)*df(i) + equations%face(i, j)*d_theta(i)
               if (self%is_steady) passed(i) = passed(i) + theta(i, j)*equations%upstream(i, j)*df(i - 1)
            end do
            r(1, j) = r(1, j) - (theta(1, j)*df(1) + equations%flow%f(1, j)*d_theta(1))/hx
            r(2:nx - 1, j) = r(2:nx - 1, j) - passed(2:nx - 1)/hx
            if (.not. self%is_steady) cycle
            r(1:nx - 1, j) = r(1:nx - 1, j) + passed(0:nx - 2)/hx
         end do
      end associate
   end subroutine oil_change

   !> y = M^(-1) x.
   subroutine precondition(self, x, y)
      class(touching_system_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      real(dp) :: determinant, right(borders), z(borders)

      associate (n => self%n, a => self%schur)
         call invert_fields(self, x, y)
         right = x(n - 1:) - border_rows(self, y)
         determinant = a(1, 1)*a(2, 2) - a(1, 2)*a(2, 1)
         z = 0
         if (abs(determinant) > 0) &
            z = [a(2, 2)*right(1) - a(1, 2)*right(2), a(1, 1)*right(2) - a(2, 1)*right(1)]/determinant
         y = y - z(1)*self%column(:, 1)
         if (self%seeks_speed) y = y - z(2)*self%column(:, 2)
         y(n - 1:) = z
         self%is_ahead = size(self%node, 2) > 0
         if (self%is_ahead) self%ahead = self%ahead - z(1)*self%deformed(:, :, 1) - z(2)*self%deformed(:, :, 2)
      end associate
   end subroutine precondition

   !> Approximate inverse for the fields alone.
   subroutine invert_fields(self, x, y)
      class(touching_system_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      real(dp), pointer, contiguous :: u(:, :)
      integer :: k

      associate (grid => self%grid, nodes => size(self%q))
         self%dr(:, :) = reshape(x(:nodes), shape(self%dr))
         where (self%weight > 0) self%dr = self%dr/self%weight
         self%work = self%dr
         do k = 1, size(self%node, 2)
            self%work(self%node(1, k), self%node(2, k)) = x(nodes + k)
         end do
         call self%factors%solve(grid, self%state, self%work, self%q)
         self%deformation%work = self%deformation%work + self%factors%operations
         call self%count(real_weights%solve*self%factors%entries + real_weights%cycle)
         u(0:grid%nx, 0:grid%ny) => y(:nodes)
         u = self%q
         do k = 1, size(self%node, 2)
            associate (i => self%node(1, k), j => self%node(2, k))
               y(nodes + k) = self%q(i, j)
               u(i, j) = 0
            end associate
         end do
         y(self%n - 1:) = 0
         if (size(self%node, 2) > 0) call follow_oil(self, u)
      end associate
   end subroutine invert_fields

   !> Changes of the oil where solids bear, after the changes elsewhere.
   subroutine follow_oil(self, u)
      class(touching_system_t), intent(inout) :: self
      real(dp), intent(inout), contiguous :: u(0:, 0:)   !! changes elsewhere, 0 there
      integer :: k, l, m, n

      self%q = merge(self%q, 0.0_dp, self%is_full .or. self%state%is_touching)
      call self%deformation%apply_single(self%q, self%dh)
      self%ahead = self%dh
      self%work = 0
      do k = 1, size(self%node, 2)
         associate (i => self%node(1, k), j => self%node(2, k), equations => self%equations)
            self%work(i, j) = self%dr(i, j)
            do l = 1, links
               m = i + link_i(l)
               n = abs(j + link_j(l))
               if (self%grid%is_line) n = j
               if (m < 0) cycle
               if (self%is_free(m, n)) self%work(i, j) = self%work(i, j) - equations%by_h(i, j, l)*self%dh(m, n)
               if (self%is_full(m, n)) self%work(i, j) = self%work(i, j) - equations%by_p(i, j, l)*u(m, n)
            end do
            if (i > 1 .and. .not. self%is_full(i - 1, j)) &
               self%work(i, j) = self%work(i, j) - equations%by_theta(i, j, 2)*u(i - 1, j)
         end associate
      end do
      call self%factors%solve_oil(self%grid, self%work)
      do k = 1, size(self%node, 2)
         u(self%node(1, k), self%node(2, k)) = self%work(self%node(1, k), self%node(2, k))
      end do
   end subroutine follow_oil

   !> Right side for residuals.
   subroutine residuals(self, sides, x)
      class(touching_system_t), intent(in) :: self
      type(touching_change_t), intent(in) :: sides
      real(dp), intent(out), contiguous :: x(:)
      integer :: k
      x(:size(self%weight)) = reshape(-self%weight*sides%p, [size(self%weight)])
      do k = 1, size(self%node, 2)
         x(size(self%weight) + k) = -sides%c(self%node(1, k), self%node(2, k))
      end do
      x(self%n - 1) = -sides%delta
      x(self%n) = -sides%ln_speed
   end subroutine residuals

   !> Changes of the unknowns of a solution.
   subroutine changes(self, x, change)
      class(touching_system_t), intent(in) :: self
      real(dp), intent(in), contiguous :: x(:)
      type(touching_change_t), intent(inout) :: change
      integer :: k
      change%p(:, :) = reshape(x(:size(self%weight)), shape(self%weight))
      change%c = 0
      do k = 1, size(self%node, 2)
         associate (i => self%node(1, k), j => self%node(2, k))
            change%c(i, j) = x(size(self%weight) + k) - merge(change%p(i, j), 0.0_dp, self%is_full(i, j))
         end associate
      end do
      change%delta = x(self%n - 1)
      change%ln_speed = x(self%n)
   end subroutine changes

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
      is_spent = self%n < 0
   end function is_spent

end module ehlwave_touching_system
