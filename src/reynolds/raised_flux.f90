!> Fluxes of higher order along X on fitted grids: theory eq. (D17).
!>
!> A fitted flux belongs to a flow that is constant between two nodes, through a film that is straight there. Film and
!> flow are curves. With r = (H_(i-1) - H_i - H_(i+1) + H_(i+2))/(8 Hm), Hm the mean of H_i and H_(i+1),
!>
!>     q = fitted flux/(1 + r),        flux = q - (q_+ - 2 q + q_-)/12 + s (q_+ - q_-),   s = (H_(i+1) - H_i)/(8 Hm)
!>
!> with q_+ and q_- of the next faces.
module ehlwave_raised_flux
   use ehlwave_face_flow, only: face_flow_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_threads, only: is_shared
   implicit none (type, external)
   private
   public :: curvature, raise_order, raised_row, slope_change

   real(dp), parameter :: curvature = 1/12.0_dp   !! share of the second difference of the flow

contains

   !> Replace the fitted fluxes along X by q, and derivatives likewise; `raised_row` has the rest.
   subroutine raise_order(faces, grid, h)
      type(face_flow_t), intent(inout) :: faces
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: h(0:, 0:)           !! H, (0:nx, 0:ny)
      real(dp), dimension(0:grid%nx - 1) :: bend, both, far, q
      integer :: j, n

      if (.not. allocated(faces%slope)) then
         call grid%new_field(faces%slope)
         call grid%new_field(faces%thin)
         call grid%new_field(faces%outer)
      end if
      faces%is_raised = .true.
      n = grid%nx
      !$omp parallel do private(bend, both, far, q) schedule(static) if (is_shared(size(h)))
      do j = grid%first_row, grid%last_row
         both = h(:n - 1, j) + h(1:, j)
         far = both
         far(1:n - 2) = h(:n - 3, j) + h(3:, j)
         bend = 1/(1 + 0.25_dp*(far - both)/both)
         faces%thin(:n - 1, j) = 0.25_dp/both
         faces%slope(:n - 1, j) = faces%thin(:n - 1, j)*(h(1:, j) - h(:n - 1, j))
         q = bend*faces%flux(:n - 1, j)
         faces%flux(:n - 1, j) = q
         faces%own(:n - 1, j) = bend*faces%own(:n - 1, j)
         faces%cross(:n - 1, j) = bend*faces%cross(:n - 1, j)
         faces%by_p1(:n - 1, j) = bend*faces%by_p1(:n - 1, j)
         faces%by_p2(:n - 1, j) = bend*faces%by_p2(:n - 1, j)
         q = bend*q*faces%thin(:n - 1, j)         ! falls as `far` grows
         q([0, n - 1]) = 0                        ! the film is straight at the ends
         faces%outer(:n - 1, j) = -q
         q = q*far/both
         faces%by_h1(:n - 1, j) = bend*faces%by_h1(:n - 1, j) + q
         faces%by_h2(:n - 1, j) = bend*faces%by_h2(:n - 1, j) + q
      end do
   end subroutine raise_order

   !> Fluxes along row j.
   pure function raised_row(faces, j) result(flux)
      type(face_flow_t), intent(in) :: faces
      integer, intent(in) :: j
      real(dp) :: flux(0:ubound(faces%flux, 1))
      integer :: i

      flux = faces%flux(:, j)
      do i = 1, ubound(flux, 1) - 2
         associate (q => faces%flux)
            flux(i) = q(i, j) - curvature*(q(i + 1, j) - 2*q(i, j) + q(i - 1, j)) &
                      + faces%slope(i, j)*(q(i + 1, j) - q(i - 1, j))
         end associate
      end do
   end function raised_row

   !> Change of s along row j by a change of H.
   pure function slope_change(faces, j, dh) result(ds)
      type(face_flow_t), intent(in) :: faces
      integer, intent(in) :: j
      real(dp), intent(in) :: dh(0:)
      real(dp) :: ds(0:ubound(dh, 1) - 1)
      associate (n => ubound(dh, 1))
         ds = faces%thin(:n - 1, j)*(dh(1:) - dh(:n - 1) - 4*faces%slope(:n - 1, j)*(dh(1:) + dh(:n - 1)))
      end associate
   end function slope_change

end module ehlwave_raised_flux
