!> One step of Newton's method for a line contact whose surfaces may touch, by the full matrix.
!>
!> Unknowns, with q the change of P + C and the sets held: at each unknown node q, or the change of theta where it is
!> cavitated, or that of P where solids bear; q of nodes where solids bear; Delta; ln(speed) where the share is given.
module ehlwave_touching_direct
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_dense_lu, only: solve_dense
   use ehlwave_kernel, only: cell_influence
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: load_factor
   use ehlwave_touching_equations, only: link_i, links, touching_equations_t
   use ehlwave_touching_state, only: touching_law_t, touching_state_t
   use ehlwave_touching_change, only: touching_change_t
   implicit none (type, external)
   private
   public :: solve_directly

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
      real(dp) :: kernel(0:problem%grid%nx)
      real(dp), allocatable :: a(:, :), x(:)
      integer :: of_q(problem%grid%nx - 1)    ! unknown that is q of a node, 0: none
      integer :: approach, bearing, i, m, n, nodes

      nodes = problem%grid%nx - 1
      associate (grid => problem%grid, touching => state%is_touching(:, 0))
         kernel = cell_influence([(i*grid%hx, i=0, grid%nx)], 0.0_dp, grid%hx, grid%hy, 0.0_dp, 0.0_dp)
      end associate
      bearing = nodes
      do i = 1, nodes
         of_q(i) = merge(0, i, state%is_cavitated(i, 0))
         if (.not. state%is_touching(i, 0)) cycle
         bearing = bearing + 1
         of_q(i) = bearing
      end do
      approach = bearing + 1
      n = approach + merge(1, 0, sides%seeks_speed)
      allocate (a(n, n), x(n), source=0.0_dp)
      do i = 1, nodes
         call set_oil_row(equations, law, state, kernel, of_q, approach, i, a(i, :))
         if (sides%seeks_speed) a(i, n) = sides%by_speed(i, 0)
         x(i) = -sides%p(i, 0)
         if (.not. state%is_touching(i, 0)) cycle
         m = of_q(i)
         call add_deformation(kernel, of_q, i, 1.0_dp, a(m, :))
         a(m, approach) = -1
         x(m) = -sides%c(i, 0)
         if (.not. law%is_soft) cycle
         a(m, m) = a(m, m) + law%softness/state%c(i, 0)
         if (.not. state%is_cavitated(i, 0)) a(m, i) = a(m, i) - law%softness/state%c(i, 0)
      end do
      associate (weight => load_factor*problem%grid%hx*problem%grid%hy)
         do i = 1, nodes
            if (of_q(i) > 0) a(approach, of_q(i)) = weight
            if (.not. (state%is_touching(i, 0) .and. sides%seeks_speed)) cycle
            a(n, of_q(i)) = weight
            if (.not. state%is_cavitated(i, 0)) a(n, i) = -weight
         end do
      end associate
      x(approach) = -sides%delta
      if (sides%seeks_speed) x(n) = -sides%ln_speed
      call solve_dense(a, x, is_singular)
      if (is_singular) return
      change%p = 0
      change%c = 0
      do i = 1, nodes
         change%p(i, 0) = x(i)
         if (.not. state%is_touching(i, 0)) cycle
         change%c(i, 0) = x(of_q(i)) - merge(0.0_dp, x(i), state%is_cavitated(i, 0))
      end do
      change%delta = x(approach)
      change%ln_speed = 0
      if (sides%seeks_speed) change%ln_speed = x(n)
   end subroutine solve_directly

   !> Derivatives of the residual of a node of the oil.
   subroutine set_oil_row(equations, law, state, kernel, of_q, approach, i, row)
      type(touching_equations_t), intent(in) :: equations
      type(touching_law_t), intent(in) :: law
      type(touching_state_t), intent(in) :: state
      real(dp), intent(in) :: kernel(0:)
      integer, intent(in) :: of_q(:), approach, i
      real(dp), intent(inout) :: row(:)
      integer :: l, m

      do l = 1, links
         m = i + link_i(l)
         if (m < 0) cycle
         if (law%is_soft .or. .not. state%is_touching(m, 0)) then   ! the film is free there
            call add_deformation(kernel, of_q, m, equations%by_h(i, 0, l), row)
            row(approach) = row(approach) - equations%by_h(i, 0, l)
         end if
         if (m < 1 .or. m > size(of_q)) cycle
         if (.not. state%is_cavitated(m, 0)) row(m) = row(m) + equations%by_p(i, 0, l)
      end do
      if (state%is_cavitated(i, 0)) row(i) = row(i) + equations%by_theta(i, 0, 1)
      if (i == 1) return
      if (state%is_cavitated(i - 1, 0)) row(i - 1) = row(i - 1) + equations%by_theta(i, 0, 2)
   end subroutine set_oil_row

   !> Add a factor times the deformation at a node.
   pure subroutine add_deformation(kernel, of_q, node, factor, row)
      real(dp), intent(in) :: kernel(0:), factor
      integer, intent(in) :: of_q(:), node
      real(dp), intent(inout) :: row(:)
      integer :: i
      if (.not. abs(factor) > 0) return
      do i = 1, size(of_q)
         if (of_q(i) > 0) row(of_q(i)) = row(of_q(i)) + factor*kernel(abs(i - node))
      end do
   end subroutine add_deformation

end module ehlwave_touching_direct
