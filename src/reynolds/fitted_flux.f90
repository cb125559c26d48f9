!> Fluxes of a Newtonian oil through the faces between nodes, fitted to steep inlets: theory eq. (D11).
!>
!> Between two nodes of a heavily loaded inlet the viscosity changes by a large factor, so that a mean of eps is
!> meaningless. A flow q that is constant along the line through them has
!>
!>     q int lambdabar/H^3 dX = rho int dP/eta,
!>
!> which is integrated with H and ln(eta) linear between the nodes:
!>
!>     eps = rho G Phi/lambdabar,    G = 2 H_1^2 H_2^2/(H_1 + H_2),    Phi = (phi_2 - phi_1)/ln(phi_2/phi_1)
!>
!> with phi = 1/eta and rho the mean density.
module ehlwave_fitted_flux
   use ehlwave_face_flow, only: face_flow_t, node_oil_t
   use ehlwave_fitted_mean, only: logarithmic_mean
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_threads, only: is_shared
   use ehlwave_work_unit, only: fitted_operations
   implicit none (type, external)
   private
   public :: fit_faces

contains

   !> Faces along X and along Y, in the unit of `face_flow_t`; none along Y in a line contact.
   subroutine fit_faces(grid, lambdabar, oil, along_x, along_y)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: lambdabar
      type(node_oil_t), intent(in) :: oil
      type(face_flow_t), intent(inout) :: along_x, along_y
      integer :: j

      !$omp parallel do schedule(static) if (is_shared(size(oil%p)))
      do j = 0, grid%ny
         if (j >= grid%first_row .and. j <= grid%last_row) &
            call fit_row(oil, lambdabar, [0, j], [1, 0], grid%nx, along_x)
         if (j < grid%ny) call fit_row(oil, lambdabar, [1, j], [0, 1], grid%nx - 1, along_y)
      end do
      along_x%work = real(fitted_operations, dp)*size(oil%p)
      along_y%work = merge(0.0_dp, along_x%work, grid%is_line)
   end subroutine fit_faces

   !> Fluxes of a row of faces and their derivatives.
   pure subroutine fit_row(oil, lambdabar, node, shift, n, faces)
      type(node_oil_t), intent(in) :: oil
      real(dp), intent(in) :: lambdabar
      integer, intent(in) :: node(2)             !! first node of the first face
      integer, intent(in) :: shift(2)            !! from the first to the second node of a face
      integer, intent(in) :: n                   !! faces
      type(face_flow_t), intent(inout) :: faces
      real(dp), dimension(n) :: by_1, by_2, by_h, by_rho, conductance, flux, mean
      integer :: i, i2, j, j2, k, last, last_2

      ! loops over local arrays are vectorised
      i = node(1)
      last = i + n - 1
      j = node(2)
      i2 = i + shift(1)
      last_2 = last + shift(1)
      j2 = j + shift(2)
      call logarithmic_mean(n, oil%fluidity(i:last, j), oil%fluidity(i2:last_2, j2), mean, by_1, by_2)
      do k = 1, n
         by_rho(k) = 1/(oil%rho(i + k - 1, j) + oil%rho(i2 + k - 1, j2))
         by_h(k) = 1/(oil%h(i + k - 1, j) + oil%h(i2 + k - 1, j2))
         conductance(k) = mean(k)*(oil%rho(i + k - 1, j) + oil%rho(i2 + k - 1, j2))*(2/lambdabar)*by_h(k) &
                          *(oil%h(i + k - 1, j)*oil%h(i2 + k - 1, j2))**2
         flux(k) = conductance(k)*(oil%p(i2 + k - 1, j2) - oil%p(i + k - 1, j))
      end do
      faces%own(i:last, j) = conductance
      faces%flux(i:last, j) = flux
      faces%by_p1(i:last, j) = flux*(oil%drho(i:last, j)*by_rho - by_1*oil%dln_eta(i:last, j))
      faces%by_p2(i:last, j) = flux*(oil%drho(i2:last_2, j2)*by_rho - by_2*oil%dln_eta(i2:last_2, j2))
      faces%by_h1(i:last, j) = flux*(2/oil%h(i:last, j) - by_h)
      faces%by_h2(i:last, j) = flux*(2/oil%h(i2:last_2, j2) - by_h)
   end subroutine fit_row

end module ehlwave_fitted_flux
