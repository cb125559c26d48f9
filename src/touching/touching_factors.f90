!> Approximate inverse of the linearised equations of a contact whose surfaces may touch, without Delta and the speed.
!>
!> Pressures of oil and solids together are q = T w. Where the deformation decides, as under a high pressure or where
!> solids bear, T is the reciprocal of the deformation; where the flow decides, it is 1. With these unknowns w the
!> equations are close to local everywhere: incomplete factors of their near part serve all waves. The oil where solids
!> bear follows, by factors of its own.
module ehlwave_touching_factors
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_cycle_settings, only: diagonal_shift
   use ehlwave_grid, only: grid_t
   use ehlwave_inverse_deformation, only: inverse_deformation_t
   use ehlwave_kinds, only: dp
   use ehlwave_near_kernel, only: near_kernel_t, near_settings_t, new_near_kernel
   use ehlwave_real_band, only: band_t, new_band
   use ehlwave_real_ilu, only: ilu_t, new_ilu
   use ehlwave_touching_equations, only: link_i, link_j, links, touching_equations_t
   use ehlwave_touching_state, only: touching_law_t, touching_state_t
   implicit none (type, external)
   private

   !> Factors of a matrix on the unknown nodes: of a band on a line, else incomplete.
   type :: node_factors_t
      integer :: reach_x = 0, reach_y = 0
      type(ilu_t) :: ilu
      type(band_t) :: band
   end type node_factors_t

   type, public :: touching_factors_t
      type(inverse_deformation_t), private :: inverse
      type(near_kernel_t), private :: kernel
      type(node_factors_t), private :: all, oil             ! of w; of the oil where solids bear
      real(dp), allocatable, private :: inverse_near(:, :)  ! T at offsets, shape of the kernel's influence
      real(dp), allocatable, private :: part(:, :)          ! Psi, beyond the edges too: 0 there
      real(dp), allocatable, private :: scale(:, :), field(:, :), image(:, :), packed(:, :)
      real(dp), allocatable, private :: follows(:, :)       ! change of P where solids bear, if it is 1 elsewhere
      real(dp) :: operations = 0                            !! of T,
      integer :: entries = 0                                !! and of a node's row
   contains
      procedure :: init
      procedure :: make
      procedure :: solve
      procedure :: solve_oil
   end type touching_factors_t

   integer, parameter :: beyond = 10                        !! nodes beyond the edges with Psi = 0
   integer, parameter :: oil_reach = 2                      !! nodes upstream that the wedge reaches
   !> Resistance of the shortest waves by flow over that by deformation above which T is 1.
   real(dp), parameter :: decisive = 10
   !> Psi^2 that counts as 0: T is single, and its rounding would drive a flow where the oil flows easily.
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
         self%entries = self%kernel%entries
         if (allocated(self%inverse_near)) deallocate (self%inverse_near, self%part, self%scale, self%field, &
            self%image, self%packed)
         allocate (self%inverse_near, mold=self%kernel%influence)
         do j = lbound(self%inverse_near, 2), ubound(self%inverse_near, 2)
            do i = lbound(self%inverse_near, 1), ubound(self%inverse_near, 1)
               self%inverse_near(i, j) = near(abs(i), min(abs(j), ubound(near, 2)))
            end do
         end do
         call lay_out(grid, self%kernel%reach_x, self%kernel%reach_y, self%all)
         call lay_out(grid, oil_reach, min(1, self%kernel%reach_y), self%oil)
         allocate (self%part(-beyond:grid%nx + beyond, -beyond:grid%ny + beyond), source=0.0_dp)
         call grid%new_field(self%scale)
         call grid%new_field(self%field)
         call grid%new_field(self%image)
         call grid%new_field(self%follows)
         allocate (self%packed(grid%last_row - grid%first_row + 1, grid%nx - 1))
      end associate
   end subroutine init

   subroutine lay_out(grid, reach_x, reach_y, factors)
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: reach_x, reach_y
      type(node_factors_t), intent(out) :: factors
      factors%reach_x = reach_x
      factors%reach_y = reach_y
      if (grid%is_line) then
         factors%band = new_band(grid%nx - 1, reach_x)
      else
         factors%ilu = new_ilu(grid%last_row - grid%first_row + 1, grid%nx - 1, reach_y, reach_x)
      end if
   end subroutine lay_out

   !> Factors at a state at which the equations were linearised.
   subroutine make(self, grid, equations, law, state)
      class(touching_factors_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      type(touching_equations_t), intent(in) :: equations
      type(touching_law_t), intent(in) :: law
      type(touching_state_t), intent(in) :: state
      real(dp) :: rows(grid%last_row - grid%first_row + 1, self%kernel%entries)
      integer :: attempt, i, middle

      call make_oil(self, grid, equations, state)
      call divide(self, grid, equations, state)
      middle = self%kernel%entries/2 + 1
      do attempt = 1, size(diagonal_shift)
         if (.not. grid%is_line) call self%all%ilu%begin()
         do i = 1, grid%nx - 1
            call near_rows_of(self, grid, equations, law, state, i, rows)
            rows(:, middle) = (1 + diagonal_shift(attempt))*rows(:, middle)
            call put_line(self%all, i, rows, self%scale(i, grid%first_row:grid%last_row))
         end do
         if (grid%is_line) call self%all%band%factorise()
         if (grid%is_line) exit
         if (self%all%ilu%is_bounded()) exit
      end do
   end subroutine make

   !> Factors of the oil where solids bear, and the change of its P there where P changes by 1 at all other nodes.
   subroutine make_oil(self, grid, equations, state)
      class(touching_factors_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      type(touching_equations_t), intent(in) :: equations
      type(touching_state_t), intent(in) :: state
      real(dp) :: rows(grid%last_row - grid%first_row + 1, (2*oil_reach + 1)*(2*self%oil%reach_y + 1))
      integer :: i, j, l, n

      self%follows = 0
      if (.not. any(state%is_touching)) return
      if (.not. grid%is_line) call self%oil%ilu%begin()
      do i = 1, grid%nx - 1
         call oil_rows(grid, equations, state, i, self%oil%reach_y, rows)
         call put_line(self%oil, i, rows)
      end do
      if (grid%is_line) call self%oil%band%factorise()
      do j = grid%first_row, grid%last_row
         do i = 1, grid%nx - 1
            if (.not. state%is_touching(i, j) .or. state%is_cavitated(i, j)) cycle
            do l = 1, links
               n = abs(j + link_j(l))
               if (grid%is_line) n = j
               if (i + link_i(l) < 0) cycle
               if (state%is_touching(i + link_i(l), n) .or. state%is_cavitated(i + link_i(l), n)) cycle
               self%follows(i, j) = self%follows(i, j) - equations%by_p(i, j, l)
            end do
         end do
      end do
      call self%solve_oil(grid, self%follows)
      self%follows = max(0.0_dp, min(1.0_dp, self%follows))
   end subroutine make_oil

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

      call local_rows(self%follows, grid, equations, law, state, i, by_p, by_h)
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

   !> Derivatives of the equations of the nodes at one X by q and film of their links. Where solids bear it is the gap
   !> that counts.
   subroutine local_rows(follows, grid, equations, law, state, i, by_p, by_h)
      type(grid_t), intent(in) :: grid
      type(touching_equations_t), intent(in) :: equations
      type(touching_law_t), intent(in) :: law
      type(touching_state_t), intent(in) :: state
      integer, intent(in) :: i
      real(dp), intent(out) :: by_p(:, :), by_h(:, :)     !! (unknown rows, links)
      real(dp), intent(in) :: follows(0:, 0:)             !! by which P follows where solids bear
      integer :: j, l, m, n, row

      by_p = 0
      by_h = 0
      do l = 1, links
         m = i + link_i(l)
         if (m < 0) cycle
         do row = 1, size(by_p, 1)
            j = row - 1 + grid%first_row
            n = abs(j + link_j(l))
            if (grid%is_line) n = j
            if (state%is_touching(i, j)) then
               if (l > 1) cycle
               by_h(row, 1) = 1
               if (law%is_soft) by_p(row, 1) = law%softness/state%c(i, j)
            else
               if (law%is_soft .or. .not. state%is_touching(m, n)) by_h(row, l) = equations%by_h(i, j, l)
               if (state%is_cavitated(m, n)) cycle
               if (state%is_touching(m, n)) then
                  by_p(row, 1) = by_p(row, 1) + equations%by_p(i, j, l)*follows(m, n)
               else
                  by_p(row, l) = by_p(row, l) + equations%by_p(i, j, l)
               end if
            end if
         end do
      end do
   end subroutine local_rows

   !> A content deforms nothing: in the columns of cavitated nodes where no solids bear there is theta in place of q.
   subroutine take_contents(grid, kernel, equations, state, i, rows)
      type(grid_t), intent(in) :: grid
      type(near_kernel_t), intent(in) :: kernel
      type(touching_equations_t), intent(in) :: equations
      type(touching_state_t), intent(in) :: state
      integer, intent(in) :: i
      real(dp), intent(inout) :: rows(:, :)
      integer :: di, dj, entry, j, n, row

      do di = -kernel%reach_x, kernel%reach_x
         if (i + di < 1 .or. i + di > grid%nx - 1) cycle
         do dj = -kernel%reach_y, kernel%reach_y
            entry = kernel%entry_at(di, dj)
            do row = 1, size(rows, 1)
               j = row - 1 + grid%first_row
               n = abs(j + dj)
               if (n > grid%ny) cycle
               if (.not. state%is_cavitated(i + di, n) .or. state%is_touching(i + di, n)) cycle
               rows(row, entry) = 0
               if (dj /= 0 .or. di > 0 .or. di < -1 .or. state%is_touching(i, j)) cycle
               rows(row, entry) = equations%by_theta(i, j, 1 - di)
            end do
         end do
      end do
   end subroutine take_contents

   !> Fold entries beyond a line of symmetry back, and clear entries beyond the other edges.
   pure subroutine fold(grid, kernel, rows)
      type(grid_t), intent(in) :: grid
      type(near_kernel_t), intent(in) :: kernel
      real(dp), intent(inout) :: rows(:, :)
      integer :: di, dj, entry, n, row, target

      n = size(rows, 1)
      do row = 1, n
         if (row > kernel%reach_y .and. row <= n - kernel%reach_y) cycle
         do di = -kernel%reach_x, kernel%reach_x
            do dj = -kernel%reach_y, kernel%reach_y
               target = row + dj
               if (target >= 1 .and. target <= n) cycle
               entry = kernel%entry_at(di, dj)
               if (grid%is_half .and. target < 1) then
                  target = 2 - target
                  if (target - row <= kernel%reach_y .and. target <= n) &
                     rows(row, entry + target - row - dj) = rows(row, entry + target - row - dj) + rows(row, entry)
               end if
               rows(row, entry) = 0
            end do
         end do
      end do
   end subroutine fold

   !> Rows of the oil where solids bear, and of the identity elsewhere.
   subroutine oil_rows(grid, equations, state, i, reach_y, rows)
      type(grid_t), intent(in) :: grid
      type(touching_equations_t), intent(in) :: equations
      type(touching_state_t), intent(in) :: state
      integer, intent(in) :: i, reach_y
      real(dp), intent(out) :: rows(:, :)                 !! (unknown rows, entries)
      integer :: j, l, middle, n, row

      rows = 0
      middle = size(rows, 2)/2 + 1
      do row = 1, size(rows, 1)
         j = row - 1 + grid%first_row
         if (.not. state%is_touching(i, j)) then
            rows(row, middle) = 1
            cycle
         end if
         do l = 1, links
            n = abs(j + link_j(l))
            if (grid%is_line) n = j
            if (i + link_i(l) < 1 .or. i + link_i(l) > grid%nx - 1) cycle
            if (n > grid%last_row .or. n < grid%first_row) cycle
            if (.not. state%is_touching(i + link_i(l), n) .or. state%is_cavitated(i + link_i(l), n)) cycle
            if (grid%is_line .and. link_j(l) /= 0) cycle
            associate (entry => middle + link_i(l)*(2*reach_y + 1) + n - j)
               rows(row, entry) = rows(row, entry) + equations%by_p(i, j, l)
            end associate
         end do
         if (state%is_cavitated(i, j)) rows(row, middle) = rows(row, middle) + equations%by_theta(i, j, 1)
         if (i == 1) cycle
         if (state%is_cavitated(i - 1, j) .and. state%is_touching(i - 1, j)) &
            rows(row, middle - (2*reach_y + 1)) = equations%by_theta(i, j, 2)
      end do
      if (any(abs(rows(:, middle)) <= 0)) where (abs(rows(:, middle)) <= 0) rows(:, middle) = -1
   end subroutine oil_rows

   !> Hand a line of rows to the factors, over their diagonals where `scale` is asked for.
   subroutine put_line(factors, i, rows, scale)
      type(node_factors_t), intent(inout) :: factors
      integer, intent(in) :: i
      real(dp), intent(inout) :: rows(:, :)
      real(dp), intent(out), optional :: scale(:)
      real(dp) :: diagonal(size(rows, 1))
      integer :: k

      if (present(scale)) then
         diagonal = rows(:, size(rows, 2)/2 + 1)
         where (.not. abs(diagonal) > 0) diagonal = 1
         scale = 1/diagonal
         do k = 1, size(rows, 2)
            rows(:, k) = rows(:, k)*scale
         end do
      end if
      if (allocated(factors%band%a)) then
         factors%band%a(i, :) = rows(1, :)
      else
         call factors%ilu%add_line(i, rows)
      end if
   end subroutine put_line

   !> Solve with factors in place.
   subroutine solve_packed(factors, packed)
      type(node_factors_t), intent(inout) :: factors
      real(dp), intent(inout), contiguous :: packed(:, :)   !! (unknown rows, lines)
      if (allocated(factors%band%a)) then
         call factors%band%solve(packed(1, :))
      else
         call factors%ilu%solve(packed)
      end if
   end subroutine solve_packed

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
            self%packed(:, i) = residual(i, first:last)*self%scale(i, first:last)
         end do
         call solve_packed(self%all, self%packed)
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

   !> Changes of P or theta where solids bear, for residuals of the oil there and 0 elsewhere, in place.
   subroutine solve_oil(self, grid, change)
      class(touching_factors_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(inout), contiguous :: change(0:, 0:)
      integer :: i
      associate (first => grid%first_row, last => grid%last_row)
         do i = 1, grid%nx - 1
            self%packed(:, i) = change(i, first:last)
         end do
         call solve_packed(self%oil, self%packed)
         do i = 1, grid%nx - 1
            change(i, first:last) = self%packed(:, i)
         end do
      end associate
   end subroutine solve_oil

end module ehlwave_touching_factors
