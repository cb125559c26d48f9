!> One step of Newton's method for a contact whose surfaces may touch, by the full matrix.
!>
!> Unknowns, with q the change of P + C and the sets held: at each unknown node q, or the change of theta where it is
!> cavitated, or of P where solids bear; q of nodes where solids bear; Delta; ln(speed) where the share is given.
module ehlwave_touching_direct
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_dense_lu, only: solve_dense
   use ehlwave_grid, only: grid_t
   use ehlwave_kernel, only: cell_influence
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_touching_change, only: touching_change_t
   use ehlwave_touching_equations, only: link_i, link_j, links, touching_equations_t
   use ehlwave_touching_state, only: touching_law_t, touching_state_t
   implicit none (type, external)
   private
   public :: solve_directly

   !> Places of the unknowns of nodes, 0: none, and the influence of a cell on nodes so many rows and columns away.
   type :: layout_t
      integer, allocatable :: of_oil(:, :), of_q(:, :)   ! (0:nx, 0:ny)
      real(dp), allocatable :: kernel(:, :)              ! (0:nx, 0:2 ny)
      integer :: oil = 0, approach = 0                   ! unknowns of the oil; place of Delta
   end type layout_t

contains

   !> Change that makes the linearised residuals zero.
   subroutine solve_directly(problem, law, equations, state, sides, change, is_singular)
      type(contact_problem_t), intent(in) :: problem
      type(touching_law_t), intent(in) :: law
      type(touching_equations_t), intent(in) :: equations   !! linearised at the state
      type(touching_state_t), intent(in) :: state
      type(touching_change_t), intent(in) :: sides          !! residuals, see there
      type(touching_change_t), intent(inout) :: change
      logical, intent(out) :: is_singular
      type(layout_t) :: layout
      real(dp), allocatable :: a(:, :), x(:)
      integer :: i, j, k, m, n

      call lay_out(problem, state, layout)
      associate (grid => problem%grid, approach => layout%approach)
         n = approach + merge(1, 0, sides%seeks_speed)
         allocate (a(n, n), x(n), source=0.0_dp)
         do j = grid%first_row, grid%last_row
            do i = 1, grid%nx - 1
               k = layout%of_oil(i, j)
               call set_oil_row(grid, equations, law, state, layout, i, j, a(k, :))
               if (sides%seeks_speed) a(k, n) = sides%by_speed(i, j)
               x(k) = -sides%p(i, j)
               m = layout%of_q(i, j)
               if (m > 0) a(approach, m) = load_factor*grid%weight(j)*grid%hx*grid%hy
               if (.not. state%is_touching(i, j)) cycle
               call add_deformation(grid, layout, i, j, 1.0_dp, a(m, :))
               a(m, approach) = -1
               x(m) = -sides%c(i, j)
               if (law%is_soft) then
                  a(m, m) = a(m, m) + law%softness/state%c(i, j)
                  if (.not. state%is_cavitated(i, j)) a(m, k) = a(m, k) - law%softness/state%c(i, j)
               end if
               if (.not. sides%seeks_speed) cycle
               a(n, m) = a(approach, m)
               if (.not. state%is_cavitated(i, j)) a(n, k) = -a(approach, m)
            end do
         end do
         x(approach) = -sides%delta
         if (sides%seeks_speed) x(n) = -sides%ln_speed
         call solve_dense(a, x, is_singular)
         if (is_singular) return
         change%p = 0
         change%c = 0
         do j = grid%first_row, grid%last_row
            do i = 1, grid%nx - 1
               change%p(i, j) = x(layout%of_oil(i, j))
               if (state%is_touching(i, j)) change%c(i, j) = x(layout%of_q(i, j)) &
                  - merge(0.0_dp, change%p(i, j), state%is_cavitated(i, j))
            end do
         end do
         change%delta = x(approach)
         change%ln_speed = 0
         if (sides%seeks_speed) change%ln_speed = x(n)
      end associate
   end subroutine solve_directly

   !> Number the unknowns.
   subroutine lay_out(problem, state, layout)
      type(contact_problem_t), intent(in) :: problem
      type(touching_state_t), intent(in) :: state
      type(layout_t), intent(out) :: layout
      integer :: bearing, i, j

      associate (grid => problem%grid, elliptic => problem%conditions%elliptic)
         allocate (layout%of_oil(0:grid%nx, 0:grid%ny), layout%of_q(0:grid%nx, 0:grid%ny), source=0)
         layout%oil = (grid%nx - 1)*(grid%last_row - grid%first_row + 1)
         bearing = layout%oil
         do j = grid%first_row, grid%last_row
            do i = 1, grid%nx - 1
               layout%of_oil(i, j) = i + (j - grid%first_row)*(grid%nx - 1)
               if (state%is_touching(i, j)) then
                  bearing = bearing + 1
                  layout%of_q(i, j) = bearing
               else if (.not. state%is_cavitated(i, j)) then
                  layout%of_q(i, j) = layout%of_oil(i, j)
               end if
            end do
         end do
         layout%approach = bearing + 1
         allocate (layout%kernel(0:grid%nx, 0:2*grid%ny))
         do j = 0, 2*grid%ny
            layout%kernel(:, j) = cell_influence([(i*grid%hx, i=0, grid%nx)], j*grid%hy, grid%hx, grid%hy, &
                                                 elliptic%kappa, elliptic%k)
         end do
      end associate
   end subroutine lay_out

   !> Derivatives of the residual of a node of the oil.
   subroutine set_oil_row(grid, equations, law, state, layout, i, j, row)
      type(grid_t), intent(in) :: grid
      type(touching_equations_t), intent(in) :: equations
      type(touching_law_t), intent(in) :: law
      type(touching_state_t), intent(in) :: state
      type(layout_t), intent(in) :: layout
      integer, intent(in) :: i, j
      real(dp), intent(inout) :: row(:)
      integer :: l, m, n, place

      do l = 1, links
         m = i + link_i(l)
         n = abs(j + link_j(l))
         if (grid%is_line) n = j
         if (m < 0) cycle
         if (law%is_soft .or. .not. state%is_touching(m, n)) then   ! the film is free there
            call add_deformation(grid, layout, m, n, equations%by_h(i, j, l), row)
            row(layout%approach) = row(layout%approach) - equations%by_h(i, j, l)
         end if
         place = layout%of_oil(m, n)
         if (place == 0 .or. state%is_cavitated(m, n)) cycle
         row(place) = row(place) + equations%by_p(i, j, l)
      end do
      place = layout%of_oil(i, j)
      if (state%is_cavitated(i, j)) row(place) = row(place) + equations%by_theta(i, j, 1)
      if (i == 1) return
      place = layout%of_oil(i - 1, j)
      if (state%is_cavitated(i - 1, j)) row(place) = row(place) + equations%by_theta(i, j, 2)
   end subroutine set_oil_row

   !> Add a factor times the deformation at a node. On half a domain each cell has its mirror image.
   subroutine add_deformation(grid, layout, i, j, factor, row)
      type(grid_t), intent(in) :: grid
      type(layout_t), intent(in) :: layout
      integer, intent(in) :: i, j
      real(dp), intent(in) :: factor
      real(dp), intent(inout) :: row(:)
      integer :: k, l

      if (.not. abs(factor) > 0) return
      do l = grid%first_row, grid%last_row
         do k = 1, grid%nx - 1
            associate (place => layout%of_q(k, l))
               if (place == 0) cycle
               row(place) = row(place) + factor*layout%kernel(abs(i - k), abs(j - l))
               if (grid%is_half .and. l > 0) row(place) = row(place) + factor*layout%kernel(abs(i - k), j + l)
            end associate
         end do
      end do
   end subroutine add_deformation

end module ehlwave_touching_direct
