!> Fluxes of higher order on fitted grids: theory eq. (D17).
!>
!> A fitted flux belongs to a flow that is constant between two nodes, through a film that is straight there. Film and
!> flow are curves. With r = (H_(i-1) - H_i - H_(i+1) + H_(i+2))/(8 Hm), Hm the mean of H_i and H_(i+1),
!>
!>     q = fitted flux/(1 + r),        flux = q - (q_+ - 2 q + q_-)/12 + s (q_+ - q_-),   s = (H_(i+1) - H_i)/(8 Hm)
!>
!> with q_+ and q_- of the next faces. Along Y likewise; a line of symmetry mirrors the film, and q but for its sign.
module ehlwave_raised_flux
   use ehlwave_face_flow, only: face_flow_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_threads, only: is_shared
   implicit none (type, external)
   private
   public :: curvature, flux_before, raise_order, raised_across, raised_row, slope_change

   real(dp), parameter :: curvature = 1/12.0_dp   !! share of the second difference of the flow

contains

   !> Replace the fitted fluxes by q, and derivatives likewise; `raised_row` and `raised_across` have the rest.
   subroutine raise_order(along_x, along_y, grid, h)
      type(face_flow_t), intent(inout) :: along_x, along_y
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: h(0:, 0:)           !! H, (0:nx, 0:ny)
      real(dp), dimension(0:grid%nx) :: both, far
      logical :: is_curved(0:grid%nx)
      integer :: j, n

      n = grid%nx
      call prepare(along_x, grid, 1, n - 2)
      !$omp parallel do private(both, far, is_curved) schedule(static) if (is_shared(size(h)))
      do j = grid%first_row, grid%last_row
         both(:n - 1) = h(:n - 1, j) + h(1:, j)
         far(:n - 1) = both(:n - 1)
         far(1:n - 2) = h(:n - 3, j) + h(3:, j)
         is_curved = .true.
         is_curved([0, n - 1]) = .false.          ! the film is straight at the ends
         call raise_row(along_x, j, n, h(1:, j) - h(:n - 1, j), both, far, is_curved)
      end do
      if (grid%is_line) return
      call prepare(along_y, grid, merge(0, 1, grid%is_half), grid%ny - 2)
      !$omp parallel do private(both, far, is_curved) schedule(static) if (is_shared(size(h)))
      do j = 0, grid%ny - 1
         both = h(:, j) + h(:, j + 1)
         is_curved = j >= along_y%first_curved .and. j <= along_y%last_curved
         far = both
         if (is_curved(0)) far = h(:, grid%below(j)) + h(:, j + 2)
         call raise_row(along_y, j, n + 1, h(:, j + 1) - h(:, j), both, far, is_curved)
      end do
   end subroutine raise_order

   !> Work space for a raised flow.
   subroutine prepare(faces, grid, first_curved, last_curved)
      type(face_flow_t), intent(inout) :: faces
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: first_curved, last_curved
      faces%is_raised = .true.
      faces%first_curved = first_curved
      faces%last_curved = last_curved
      if (allocated(faces%slope)) return
      call grid%new_field(faces%slope)
      call grid%new_field(faces%thin)
      call grid%new_field(faces%outer)
   end subroutine prepare

   !> Raise row j of faces.
   pure subroutine raise_row(faces, j, n, rise, both, far, is_curved)
      type(face_flow_t), intent(inout) :: faces
      integer, intent(in) :: j
      integer, intent(in) :: n                      !! faces
      real(dp), intent(in) :: rise(0:n - 1)         !! H_(i+1) - H_i
      real(dp), intent(in) :: both(0:), far(0:)     !! H_i + H_(i+1), H_(i-1) + H_(i+2)
      logical, intent(in) :: is_curved(0:)          !! whether `far` is not of the two nodes alone
      real(dp), dimension(0:n - 1) :: bend, q
      bend = 1/(1 + 0.25_dp*(far(:n - 1) - both(:n - 1))/both(:n - 1))
      faces%thin(:n - 1, j) = 0.25_dp/both(:n - 1)
      faces%slope(:n - 1, j) = faces%thin(:n - 1, j)*rise
      q = bend*faces%flux(:n - 1, j)
      faces%flux(:n - 1, j) = q
      faces%own(:n - 1, j) = bend*faces%own(:n - 1, j)
      faces%cross(:n - 1, j) = bend*faces%cross(:n - 1, j)
      faces%by_p1(:n - 1, j) = bend*faces%by_p1(:n - 1, j)
      faces%by_p2(:n - 1, j) = bend*faces%by_p2(:n - 1, j)
      q = merge(bend*q*faces%thin(:n - 1, j), 0.0_dp, is_curved(:n - 1))     ! falls as `far` grows
      faces%outer(:n - 1, j) = -q
      q = q*far(:n - 1)/both(:n - 1)
      faces%by_h1(:n - 1, j) = bend*faces%by_h1(:n - 1, j) + q
      faces%by_h2(:n - 1, j) = bend*faces%by_h2(:n - 1, j) + q
   end subroutine raise_row

   !> Fluxes along row j.
   pure function raised_row(faces, j) result(flux)
      type(face_flow_t), intent(in) :: faces
      integer, intent(in) :: j
      real(dp) :: flux(0:ubound(faces%flux, 1))

      flux = faces%flux(:, j)
      associate (q => faces%flux, first => faces%first_curved, last => faces%last_curved)
         flux(first:last) = raised(q(first - 1:last - 1, j), q(first:last, j), q(first + 1:last + 1, j), &
                                   faces%slope(first:last, j))
      end associate
   end function raised_row

   !> Fluxes along Y from row j to the next.
   pure function raised_across(faces, j) result(flux)
      type(face_flow_t), intent(in) :: faces
      integer, intent(in) :: j
      real(dp) :: flux(0:ubound(faces%flux, 1))

      flux = faces%flux(:, j)
      if (j < faces%first_curved .or. j > faces%last_curved) return
      flux = raised(flux_before(faces, j), flux, faces%flux(:, j + 1), faces%slope(:, j))
   end function raised_across

   !> Flux through a face from q through the faces before, at and after it.
   elemental real(dp) function raised(before, at, after, slope)
      real(dp), intent(in) :: before, at, after
      real(dp), intent(in) :: slope              !! s
      raised = at - curvature*(after - 2*at + before) + slope*(after - before)
   end function raised

   !> q along Y through the faces before row j of them, mirrored at a line of symmetry.
   pure function flux_before(faces, j) result(q)
      type(face_flow_t), intent(in) :: faces
      integer, intent(in) :: j
      real(dp) :: q(0:ubound(faces%flux, 1))
      if (j > 0) then
         q = faces%flux(:, j - 1)
      else
         q = -faces%flux(:, 0)
      end if
   end function flux_before

   !> Change of s by changes of H at the first and the second node of a face.
   elemental real(dp) function slope_change(thin, slope, dh1, dh2)
      real(dp), intent(in) :: thin, slope         !! 1/(8 Hm), s
      real(dp), intent(in) :: dh1, dh2
      slope_change = thin*(dh2 - dh1 - 4*slope*(dh1 + dh2))
   end function slope_change

end module ehlwave_raised_flux
