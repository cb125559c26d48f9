!> Terms of the oil's residuals where solids bear that depend on changes elsewhere, and their transposes.
module ehlwave_touching_oil_links
   use ehlwave_kinds, only: dp
   use ehlwave_touching_equations, only: link_i, link_row, links, touching_equations_t
   use ehlwave_touching_unknowns, only: touching_unknowns_t
   implicit none (type, external)
   private
   public :: subtract_links, subtract_links_transposed

contains

   !> Subtract from the residuals r, where solids bear, the changes by the film and by P or theta elsewhere.
   pure subroutine subtract_links(unknowns, equations, is_line, dh, u, r)
      type(touching_unknowns_t), intent(in) :: unknowns
      type(touching_equations_t), intent(in) :: equations
      logical, intent(in) :: is_line
      real(dp), intent(in), dimension(0:, 0:) :: dh, u   !! changes of the film, and of P or theta
      real(dp), intent(inout) :: r(0:, 0:)
      integer :: k, l, m, n

      do k = 1, size(unknowns%node, 2)
         associate (i => unknowns%node(1, k), j => unknowns%node(2, k))
            do l = 1, links
               m = i + link_i(l)
               n = link_row(j, l, is_line)
               if (m < 0) cycle
               if (unknowns%is_free(m, n)) r(i, j) = r(i, j) - equations%by_h(i, j, l)*dh(m, n)
               if (unknowns%is_full(m, n)) r(i, j) = r(i, j) - equations%by_p(i, j, l)*u(m, n)
            end do
            if (i > 1 .and. .not. unknowns%is_full(i - 1, j)) &
               r(i, j) = r(i, j) - equations%by_theta(i, j, 2)*u(i - 1, j)
         end associate
      end do
   end subroutine subtract_links

   !> Transposed `subtract_links`: for weights r of the residuals, weights of the changes.
   pure subroutine subtract_links_transposed(unknowns, equations, is_line, r, dh, u)
      type(touching_unknowns_t), intent(in) :: unknowns
      type(touching_equations_t), intent(in) :: equations
      logical, intent(in) :: is_line
      real(dp), intent(in) :: r(0:, 0:)
      real(dp), intent(inout), dimension(0:, 0:) :: dh, u
      integer :: k, l, m, n

      do k = 1, size(unknowns%node, 2)
         associate (i => unknowns%node(1, k), j => unknowns%node(2, k))
            do l = 1, links
               m = i + link_i(l)
               n = link_row(j, l, is_line)
               if (m < 0) cycle
               if (unknowns%is_free(m, n)) dh(m, n) = dh(m, n) - equations%by_h(i, j, l)*r(i, j)
               if (unknowns%is_full(m, n)) u(m, n) = u(m, n) - equations%by_p(i, j, l)*r(i, j)
            end do
            if (i > 1 .and. .not. unknowns%is_full(i - 1, j)) &
               u(i - 1, j) = u(i - 1, j) - equations%by_theta(i, j, 2)*r(i, j)
         end associate
      end do
   end subroutine subtract_links_transposed

end module ehlwave_touching_oil_links
