!> The discrete Reynolds equation: the fluxes through faces, its residual, and how both change.
!>
!> The flow along the pressure gradient goes through the faces between neighbouring nodes. This module computes the flux
!> through a face (`face_flux`) and its change (`face_change`); `ehlwave_reynolds_links` has the derivatives of the same
!> fluxes at single nodes. In a Newtonian oil eps is averaged between nodes; other oils and the fitted scheme use the
!> fluxes of `ehlwave_face_flow`.
module ehlwave_reynolds
   use ehlwave_complex_wedge, only: complex_wedge_t => wedge_t
   use ehlwave_face_flow, only: face_flow_t
   use ehlwave_flow, only: flow_t
   use ehlwave_kinds, only: dp
   use ehlwave_mesh, only: mesh_t
   use ehlwave_raised_flux, only: curvature, flux_before, raised_across, raised_row, slope_change
   use ehlwave_real_wedge, only: wedge_t
   use ehlwave_threads, only: is_shared, row_block
   use ehlwave_transport, only: transport_t
   implicit none (type, external)
   private
   public :: driven_flow, face_flux, follow_state, reynolds_residual, reynolds_change

   !> Change of the residual for a change of pressure and film, real or complex.
   interface reynolds_change
      module procedure real_change, complex_change
   end interface reynolds_change

contains

   !> Residual of theory eq. (7), eps averaged between nodes, (D1):
   !>
   !>     R = [eps_(i+1/2) (P_(i+1) - P_i) - eps_(i-1/2) (P_i - P_(i-1))]/hX^2 + kappa^2 (same in Y)/hY^2
   !>         - wedge and squeeze of `transport`
   !>
   !> at unknown nodes, zero elsewhere. R = 0 where P > 0; R <= 0 where the film is cavitated.
   subroutine reynolds_residual(mesh, transport, flow, r)
      type(mesh_t), intent(in) :: mesh
      type(transport_t), intent(in) :: transport
      type(flow_t), intent(in) :: flow
      real(dp), intent(out) :: r(0:, 0:)      !! R, (0:nx, 0:ny)
      integer :: i, j, nx

      nx = mesh%grid%nx
      call driven_flow(mesh, flow, r)
      !$omp parallel do private(i) schedule(static) if (is_shared(size(r)))
      do j = mesh%grid%first_row, mesh%grid%last_row
         call transport%subtract(nx, flow%f(:, j), r(:, j))
         if (allocated(transport%carried)) then
            do i = 1, nx - 1
               r(i, j) = r(i, j) - transport%carried(i, j)
            end do
         end if
      end do
   end subroutine reynolds_residual

   !> Flow that pressure gradients drive into each unknown node, zero elsewhere: the first part of R.
   subroutine driven_flow(mesh, flow, r)
      type(mesh_t), intent(in) :: mesh
      type(flow_t), intent(in) :: flow
      real(dp), intent(out) :: r(0:, 0:)      !! (0:nx, 0:ny)
      integer :: first

      r(:, 0) = 0
      r(:, mesh%grid%ny) = 0
      !$omp parallel do schedule(static) if (is_shared(size(r)))
      do first = mesh%grid%first_row, mesh%grid%last_row, row_block
         call drive_rows(mesh, flow, first, min(first + row_block - 1, mesh%grid%last_row), r)
      end do
   end subroutine driven_flow

   !> Drive some rows.
   pure subroutine drive_rows(mesh, flow, first, last, r)
      type(mesh_t), intent(in) :: mesh
      type(flow_t), intent(in) :: flow
      integer, intent(in) :: first, last
      real(dp), intent(inout) :: r(0:, 0:)
      real(dp), dimension(0:mesh%grid%nx) :: east, north, south
      integer :: i, j, jp, nx

      nx = mesh%grid%nx
      call face_flux(flow, mesh%grid%below(first), first, 0, south)
      do j = first, last
         jp = mesh%grid%above(j)
         call face_flux(flow, j, jp, 0, north)
         call face_flux(flow, j, j, 1, east)
         r(0, j) = 0
         r(nx, j) = 0
         do i = 1, nx - 1
            r(i, j) = mesh%cx*(east(i) - east(i - 1)) + mesh%cy*(north(i) - south(i))
         end do
         south = north
      end do
   end subroutine drive_rows

   !> Fluxes through the faces from nodes (i, j1) to (i + shift, j2), but for their weight: (eps_1 + eps_2) (P_2 - P_1).
   pure subroutine face_flux(flow, j1, j2, shift, flux)
      type(flow_t), intent(in) :: flow
      integer, intent(in) :: j1, j2, shift     !! shift: 1 along X, 0 across
      real(dp), intent(inout) :: flux(0:)      !! (0:nx), the last `shift` are left alone
      integer :: i

      if (flow%has_face_fluxes()) then
         if (shift == 1) then
            flux = flow%along_x%flux(:, j1)
            if (flow%along_x%is_raised) flux = raised_row(flow%along_x, j1)
         else if (flow%along_y%is_raised) then
            flux = (j2 - j1)*raised_across(flow%along_y, min(j1, j2))
         else
            flux = (j2 - j1)*flow%along_y%flux(:, min(j1, j2))
         end if
         return
      end if
      do i = 0, ubound(flux, 1) - shift
         flux(i) = (flow%eps(i, j1) + flow%eps(i + shift, j2))*(flow%p(i + shift, j2) - flow%p(i, j1))
      end do
   end subroutine face_flux

#define SCALAR real(dp)
#define WEDGE wedge_t
#define CHANGE real_change
#define CHANGE_ROWS real_change_rows
#define COEFFICIENT_CHANGE real_coefficient_change
#define FACE_CHANGE real_face_change
#define GENERAL_CHANGE real_general_change
#define RAISED_CHANGE real_raised_change
#define ACROSS_CHANGE real_across_change
#define RAISED_ACROSS_CHANGE real_raised_across_change
#include "reynolds_change.inc"
#undef SCALAR
#undef WEDGE
#undef CHANGE
#undef CHANGE_ROWS
#undef COEFFICIENT_CHANGE
#undef FACE_CHANGE
#undef GENERAL_CHANGE
#undef RAISED_CHANGE
#undef ACROSS_CHANGE
#undef RAISED_ACROSS_CHANGE

#define SCALAR complex(dp)
#define WEDGE complex_wedge_t
#define CHANGE complex_change
#define CHANGE_ROWS complex_change_rows
#define COEFFICIENT_CHANGE complex_coefficient_change
#define FACE_CHANGE complex_face_change
#define GENERAL_CHANGE complex_general_change
#define RAISED_CHANGE complex_raised_change
#define ACROSS_CHANGE complex_across_change
#define RAISED_ACROSS_CHANGE complex_raised_across_change
#include "reynolds_change.inc"

   !> Let a flow through faces follow a change of the state, linearly.
   subroutine follow_state(mesh, flow, p, h)
      type(mesh_t), intent(in) :: mesh
      type(flow_t), intent(inout) :: flow      !! at the state before, with fluxes through faces
      real(dp), intent(in) :: p(0:, 0:), h(0:, 0:)
      real(dp), dimension(0:mesh%grid%nx) :: flux
      real(dp), allocatable, dimension(:, :) :: dh, q
      integer :: j

      allocate (dh, q, mold=flow%p)
      q = p - flow%p
      dh = h - flow%h
      do j = mesh%grid%first_row, mesh%grid%last_row
         call real_general_change(mesh, flow, q, dh, [j], flux)
         flow%along_x%flux(:mesh%grid%nx - 1, j) = flow%along_x%flux(:mesh%grid%nx - 1, j) + flux(:mesh%grid%nx - 1)
         if (flow%along_x%is_raised) call follow_slope(flow%along_x, mesh%grid%nx, j, dh(0:, j), dh(1:, j))
      end do
      do j = 0, mesh%grid%ny - 1
         call real_general_change(mesh, flow, q, dh, [j, j + 1], flux)
         flow%along_y%flux(:, j) = flow%along_y%flux(:, j) + flux
         if (flow%along_y%is_raised) call follow_slope(flow%along_y, mesh%grid%nx + 1, j, dh(:, j), dh(:, j + 1))
      end do
      flow%f = flow%f + flow%f_p*q + flow%rho*dh
   end subroutine follow_state

   !> Slopes of row j of faces after changes of H at their nodes.
   pure subroutine follow_slope(faces, n, j, dh1, dh2)
      type(face_flow_t), intent(inout) :: faces
      integer, intent(in) :: n, j                     !! faces, row
      real(dp), intent(in) :: dh1(0:), dh2(0:)
      associate (slope => faces%slope(:n - 1, j))
         slope = slope + slope_change(faces%thin(:n - 1, j), slope, dh1(:n - 1), dh2(:n - 1))
      end associate
   end subroutine follow_slope

end module ehlwave_reynolds
