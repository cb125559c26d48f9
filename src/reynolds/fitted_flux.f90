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
      real(dp) :: by_1, by_2, conductance, difference, mean, rho, sum_h
      integer :: i, i2, j, j2, k

      j = node(2)
      j2 = j + shift(2)
      do k = 0, n - 1
         i = node(1) + k
         i2 = i + shift(1)
         call logarithmic_mean(oil%fluidity(i, j), oil%fluidity(i2, j2), mean, by_1, by_2)
         sum_h = oil%h(i, j) + oil%h(i2, j2)
         rho = oil%rho(i, j) + oil%rho(i2, j2)
         conductance = rho*mean*2*(oil%h(i, j)*oil%h(i2, j2))**2/(sum_h*lambdabar)
         difference = oil%p(i2, j2) - oil%p(i, j)
         faces%own(i, j) = conductance
         faces%flux(i, j) = conductance*difference
         faces%by_p1(i, j) = conductance*difference*(oil%drho(i, j)/rho - by_1*oil%dln_eta(i, j))
         faces%by_p2(i, j) = conductance*difference*(oil%drho(i2, j2)/rho - by_2*oil%dln_eta(i2, j2))
         faces%by_h1(i, j) = conductance*difference*(2/oil%h(i, j) - 1/sum_h)
         faces%by_h2(i, j) = conductance*difference*(2/oil%h(i2, j2) - 1/sum_h)
      end do
   end subroutine fit_row

end module ehlwave_fitted_flux
