!> Approximate inverse of the linearised equations of a contact whose surfaces may touch, without Delta and the speed.
!>
!> Pressures of oil and solids together are q = T w. Where the deformation decides, as under a high pressure or where
!> solids bear, T is the reciprocal of the deformation; where the flow decides, it is 1. With these unknowns w the
!> equations are close to local everywhere: incomplete factors of their near part serve all waves, with corrections on
!> coarser grids where the flow decides. The oil where solids bear follows, by factors of its own.
module ehlwave_touching_factors
   use ehlwave_coarse_factors, only: coarse_factors_t
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_cycle_settings, only: diagonal_shift
   use ehlwave_grid, only: grid_t
   use ehlwave_inverse_deformation, only: inverse_deformation_t
   use ehlwave_kinds, only: dp
   use ehlwave_near_kernel, only: near_kernel_t, near_settings_t, new_near_kernel
   use ehlwave_node_factors, only: node_factors_t
   use ehlwave_touching_equations, only: link_i, link_j, links, touching_equations_t
   use ehlwave_touching_local_rows, only: fold, local_rows, take_contents
   use ehlwave_touching_oil_factors, only: touching_oil_factors_t
   use ehlwave_touching_state, only: touching_law_t, touching_state_t
   implicit none (type, external)
   private

   type, public :: touching_factors_t
      type(inverse_deformation_t), private :: inverse
      type(near_kernel_t), private :: kernel
      type(node_factors_t), private :: all                  ! of w
      type(coarse_factors_t), private :: coarse             ! of w where the flow decides
      type(touching_oil_factors_t) :: oil                   !! of the oil where solids bear
      real(dp), allocatable, private :: inverse_near(:, :)  ! T at offsets, shape of the kernel's influence
      real(dp), allocatable, private :: part(:, :)          ! Psi, beyond the edges too: 0 there
      real(dp), allocatable, private :: scale(:, :), field(:, :), image(:, :), packed(:, :), right(:, :)
      real(dp) :: operations = 0                            !! of T,
      integer :: entries = 0                                !! and of a node's row, with corrections
   contains
      procedure :: init
      procedure :: make
      procedure :: solve
      procedure :: solve_transposed
   end type touching_factors_t

   integer, parameter :: beyond = 10                        !! nodes beyond the edges with Psi = 0
   !> Resistance of the shortest waves by flow over that by deformation above which T is 1.
   real(dp), parameter :: decisive = 1
   !> Psi^2 that counts as 0: there the oil flows easily.
   real(dp), parameter :: least_part = 1e-2_dp

contains

   !> Work space for a problem.
   subroutine init(self, problem)
      class(touching_factors_t), intent(inout) :: self
      type(contact_problem_t), intent(in) :: problem
      real(dp), allocatable :: near(:, :)
      integer :: i, j

      associate (grid => problem%grid, elliptic => problem%conditions%elliptic)
         call self%inverse%init(grid, elliptic%kappa, elliptic%k)
         self%kernel = new_near_kernel(grid, elliptic%kappa, elliptic%k, near_settings_t())
         call self%inverse%near(grid, near)
         self%operations = self%inverse%operations
         ! corrections of an elliptical contact cost as much again
         self%entries = merge(1, 2, grid%is_line)*self%kernel%entries
         if (allocated(self%inverse_near)) deallocate (self%inverse_near, self%part, self%scale, self%field, &
            self%image, self%packed, self%right)
         allocate (self%inverse_near, mold=self%kernel%influence)
         do j = lbound(self%inverse_near, 2), ubound(self%inverse_near, 2)
            do i = lbound(self%inverse_near, 1), ubound(self%inverse_near, 1)
               self%inverse_near(i, j) = near(abs(i), min(abs(j), ubound(near, 2)))
            end do
         end do
         call self%all%init(grid, self%kernel%reach_x, self%kernel%reach_y)
         call self%coarse%init(grid, self%kernel%reach_x, self%kernel%reach_y)
         call self%oil%init(grid, self%kernel%reach_y)
         allocate (self%part(-beyond:grid%nx + beyond, -beyond:grid%ny + beyond), source=0.0_dp)
         call grid%new_field(self%scale)
         call grid%new_field(self%field)
         call grid%new_field(self%image)
         allocate (self%packed(grid%last_row - grid%first_row + 1, grid%nx - 1))
         allocate (self%right, mold=self%packed)
      end associate
   end subroutine init

   !> Factors at a state at which the equations were linearised.
   subroutine make(self, grid, equations, law, state)
      class(touching_factors_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      type(touching_equations_t), intent(in) :: equations
      type(touching_law_t), intent(in) :: law
      type(touching_state_t), intent(in) :: state
      real(dp) :: rows(grid%last_row - grid%first_row + 1, self%kernel%entries)
      integer :: attempt, i, middle
      logical :: is_bounded

      call self%oil%make(grid, equations, law%is_soft, state)
      call divide(self, grid, equations, state)
      middle = self%kernel%entries/2 + 1
      do attempt = 1, size(diagonal_shift)
         call self%all%begin()
         do i = 1, grid%nx - 1
            call near_rows_of(self, grid, equations, law, state, i, rows)
            if (attempt == 1) call self%coarse%put_line(i, rows, flow_decides(self, grid, state, i))
            rows(:, middle) = (1 + diagonal_shift(attempt))*rows(:, middle)
            call self%all%put_line(i, rows, self%scale(i, grid%first_row:grid%last_row))
         end do
         call self%all%finish(is_bounded)
         if (is_bounded) exit
      end do
      call self%coarse%finish()
   end subroutine make

   !> Psi, the part of T that is the reciprocal of the deformation.
   subroutine divide(self, grid, equations, state)
      class(touching_factors_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      type(touching_equations_t), intent(in) :: equations
      type(touching_state_t), intent(in) :: state
      real(dp) :: ratio
      integer :: i, j

      self%part = 0
      do j = grid%first_row, grid%last_row
         do i = 1, grid%nx - 1
            if (state%is_touching(i, j)) then
               self%part(i, j) = 1
            else if (.not. state%is_cavitated(i, j)) then
               ratio = abs(equations%by_p(i, j, 1))/(abs(equations%by_h(i, j, 1))*self%inverse%shortest)
               self%part(i, j) = sqrt(max(0.0_dp, 1/(1 + ratio/decisive) - least_part)/(1 - least_part))
            end if
         end do
      end do
      if (.not. grid%is_half) return
      do j = 1, beyond
         self%part(:, -j) = self%part(:, j)
      end do
   end subroutine divide

   !> Unknown nodes at one X that corrections on coarser grids are for: the flow decides more than the deformation.
   pure function flow_decides(self, grid, state, i) result(decides)
      class(touching_factors_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      type(touching_state_t), intent(in) :: state
      integer, intent(in) :: i
      logical :: decides(grid%last_row - grid%first_row + 1)
      associate (first => grid%first_row, last => grid%last_row)
         decides = self%part(i, first:last)**2 < 0.5_dp .and. &
                   .not. (state%is_touching(i, first:last) .or. state%is_cavitated(i, first:last))
      end associate
   end function flow_decides

   !> Rows of all unknown nodes at one X: the product of the local equations and of T.
   subroutine near_rows_of(self, grid, equations, law, state, i, rows)
      class(touching_factors_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      type(touching_equations_t), intent(in) :: equations
      type(touching_law_t), intent(in) :: law
      type(touching_state_t), intent(in) :: state
      integer, intent(in) :: i
      real(dp), intent(out) :: rows(:, :)                 !! (unknown rows, entries)
      real(dp), dimension(size(rows, 1), links) :: by_p, by_h
      real(dp), dimension(size(rows, 1)) :: own, theirs
      integer :: at, di, dj, entry, l
      logical :: is_own

      call local_rows(self%oil%follows, grid, equations, law, state, i, by_p, by_h)
      rows = 0
      associate (kernel => self%kernel, first => grid%first_row, last => grid%last_row, part => self%part)
         do di = -kernel%reach_x, kernel%reach_x
            if (i + di < 1 .or. i + di > grid%nx - 1) cycle
            do dj = -kernel%reach_y, kernel%reach_y
               entry = kernel%entry_at(di, dj)
               theirs = part(i + di, first + dj:last + dj)
               do l = 1, links
                  if (i + link_i(l) < 0) cycle
                  is_own = link_i(l) == di .and. link_j(l) == dj
                  at = di - link_i(l)
                  own = part(i + link_i(l), first + link_j(l):last + link_j(l))
                  rows(:, entry) = rows(:, entry) &
                                   + by_h(:, l)*(1 - theirs**2)*kernel%influence(at, dj - link_j(l)) &
                                   + by_p(:, l)*own*theirs*self%inverse_near(at, dj - link_j(l))
                  if (is_own) rows(:, entry) = rows(:, entry) + by_h(:, l)*theirs**2 + by_p(:, l)*(1 - theirs**2)
               end do
            end do
         end do
         call take_contents(grid, kernel, equations, state, i, rows)
         call fold(grid, kernel, rows)
      end associate
   end subroutine near_rows_of

   !> Changes q, and theta where the film is cavitated and no solids bear, for residuals: of the gap where solids bear.
   subroutine solve(self, grid, state, residual, q)
      class(touching_factors_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      type(touching_state_t), intent(in) :: state
      real(dp), intent(in), contiguous :: residual(0:, 0:)
      real(dp), intent(out), contiguous :: q(0:, 0:)
      integer :: i, j

      associate (first => grid%first_row, last => grid%last_row, nx => grid%nx)
         do i = 1, nx - 1
            self%right(:, i) = residual(i, first:last)
            self%packed(:, i) = self%right(:, i)*self%scale(i, first:last)
         end do
         call self%all%solve(self%packed, is_transposed=.false.)
         call self%coarse%correct(self%right, self%packed)
         q = 0
         do i = 1, nx - 1
            q(i, first:last) = self%packed(:, i)
         end do
         self%field = self%part(0:nx, 0:grid%ny)*q
         call self%inverse%apply(self%field, self%image)
         do j = first, last
            do i = 1, nx - 1
               if (state%is_cavitated(i, j) .and. .not. state%is_touching(i, j)) cycle
               q(i, j) = self%part(i, j)*self%image(i, j) + (1 - self%part(i, j)**2)*q(i, j)
            end do
         end do
      end associate
   end subroutine solve

   !> Transposed `solve`: weights of the residuals for weights of the changes.
   subroutine solve_transposed(self, grid, state, q, residual)
      class(touching_factors_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      type(touching_state_t), intent(in) :: state
      real(dp), intent(in), contiguous :: q(0:, 0:)
      real(dp), intent(out), contiguous :: residual(0:, 0:)
      integer :: i, j
      logical :: is_content

      residual = 0
      self%field = 0
      do j = grid%first_row, grid%last_row
         do i = 1, grid%nx - 1
            is_content = state%is_cavitated(i, j) .and. .not. state%is_touching(i, j)
            residual(i, j) = merge(1.0_dp, 1 - self%part(i, j)**2, is_content)*q(i, j)
            ! rows of a half domain count for two
            if (.not. is_content) self%field(i, j) = self%part(i, j)*q(i, j)/grid%weight(j)
         end do
      end do
      call self%inverse%apply(self%field, self%image)
      associate (first => grid%first_row, last => grid%last_row, nx => grid%nx)
         do j = first, last
            residual(:, j) = residual(:, j) + self%part(0:nx, j)*grid%weight(j)*self%image(:, j)
         end do
         do i = 1, nx - 1
            self%packed(:, i) = residual(i, first:last)
         end do
         call self%coarse%correct_transposed(self%packed, self%right)
         call self%all%solve(self%packed, is_transposed=.true.)
         do i = 1, nx - 1
            residual(i, first:last) = self%right(:, i) + self%packed(:, i)*self%scale(i, first:last)
         end do
      end associate
   end subroutine solve_transposed

end module ehlwave_touching_factors
