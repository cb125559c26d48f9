!> The meniscus of a contact with too little oil while its solution is sought: where to look for it in the next step.
module ehlwave_meniscus
   use ehlwave_equations, only: equations_t
   use ehlwave_grid, only: grid_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_oil_content, only: oil_content_t
   use ehlwave_reynolds_links, only: flow_links, poiseuille_links
   use ehlwave_state, only: state_t
   implicit none (type, external)
   private
   public :: fill_ahead, hold_empty, is_full_to_edge

   !> Share of the way to the contact that `fill_ahead` fills at most, besides the overflowing node. In a wide gap the
   !> pressure of a step far from the solution is meaningless; close to the contact the gap follows it.
   real(dp), parameter :: farthest_share = 0.05_dp

contains

   !> Fill all nodes that overflow in a step, in a steady state. Pressure drives s times the missing content back into
   !> the last partly filled node i of a row. With s > 1 a plain step would fill only this node, the next step its
   !> neighbour upstream, and so on. A pressure that falls evenly to 0 over s hX from node i + 1 upstream drives back
   !> just the missing content: there the meniscus lies.
   pure subroutine fill_ahead(equations, state, change)
      type(equations_t), intent(in) :: equations   !! evaluated at the state
      type(state_t), intent(in) :: state           !! before the step
      real(dp), intent(inout) :: change(0:, 0:)    !! change of P by the step, (0:nx, 0:ny)
      real(dp) :: by_h(1, flow_links), by_p(1, flow_links), next, share
      integer, parameter :: east = 2               ! link
      integer :: i, j, m

      associate (grid => equations%mesh%grid, content => equations%content, flow => equations%flow)
         do j = grid%first_row, grid%last_row
            i = last_partial(content, grid, j)
            if (i < 1) cycle
            next = state%p(i + 1, j) + change(i + 1, j)
            if (next <= 0) cycle
            call poiseuille_links(equations%mesh, flow, [i, i, j, j], by_p, by_h)
            share = grid%hx*by_p(1, east)*next/(flow%rho(i, j)*state%h(i, j) - content%outflow(i - 1, j))
            if (.not. share > 0) cycle
            share = min(share, 1 + max(0.0_dp, farthest_share*(-1 - grid%x(i))/grid%hx))
            do m = 1, min(int(share), i)
               associate (node => i + 1 - m)
                  if (.not. content%is_partial(node, j)) exit
                  change(node, j) = next*(1 - m/share) - state%p(node, j)
               end associate
            end do
         end do
      end associate
   end subroutine fill_ahead

   !> Whether the gap is full from the inlet edge on, at Y = 0.
   pure logical function is_full_to_edge(equations)
      type(equations_t), intent(in) :: equations   !! equations of a solution
      associate (grid => equations%mesh%grid)
         is_full_to_edge = last_partial(equations%content, grid, minloc(abs(grid%y), 1) - 1) <= 1
      end associate
   end function is_full_to_edge

   !> Hold the empty part of the inlet as it is in the first guess of a level.
   subroutine hold_empty(level)
      type(level_t), intent(inout) :: level
      type(equations_t) :: equations

      associate (problem => level%problem, grid => level%problem%grid)
         call problem%film_of_guess(level%given, level%state)
         call equations%init(problem)
         call equations%evaluate(problem, level%given, level%state)
         problem%deformation%work = problem%deformation%work + equations%work()
         level%given%is_empty = equations%is_cavitated
         level%given%is_empty(minloc(abs(grid%x), 1) - 1:, :) = .false.   ! not behind the contact
         where (level%given%is_empty) level%state%p = 0
      end associate
   end subroutine hold_empty

   !> Number of the last partly filled node of a row upstream of the centre; -1: none, as all are full, or the centre is
   !> not.
   pure integer function last_partial(content, grid, j) result(i)
      type(oil_content_t), intent(in) :: content
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: j
      integer :: centre
      centre = minloc(abs(grid%x), 1) - 1
      i = -1
      if (content%is_partial(centre, j)) return
      do i = centre, 0, -1
         if (content%is_partial(i, j)) exit
      end do
   end function last_partial

end module ehlwave_meniscus
