!> The discrete Reynolds equation: its residual, and all that follows from it.
!>
!> The flow along the pressure gradient goes through the faces between neighbouring nodes. This module alone knows how
!> much: the flux through a face (`face_flux`), its change (`face_change`), the links of a node (`poiseuille_links`),
!> the diagonal (`reynolds_scale`) and how the oil a node takes in depends on its own pressure (`intake`). In a
!> Newtonian oil eps is averaged between nodes; the fluxes of another oil, and those of the fitted scheme, are those of
!> `ehlwave_face_flow`.
module ehlwave_reynolds
   use ehlwave_complex_wedge, only: complex_wedge_t => wedge_t
   use ehlwave_face_flow, only: face_flow_t
   use ehlwave_flow, only: flow_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_real_wedge, only: wedge_t
   use ehlwave_threads, only: is_shared, row_block
   use ehlwave_transport, only: transport_t
   implicit none (type, external)
   private
   public :: new_mesh, driven_flow, face_flux, follow_state, reynolds_residual, reynolds_change, reynolds_scale, &
             poiseuille_links, intake

   !> A grid with the weights of a difference of fluxes along X and along Y.
   type, public :: mesh_t
      type(grid_t) :: grid
      real(dp) :: kappa = 1
      real(dp) :: cx = 0, cy = 0   !! 1/(2 hX^2), kappa^2/(2 hY^2): a flux is twice that at the mean of its nodes
   end type mesh_t

   !> Change of the residual for a change of pressure and film, real or complex.
   interface reynolds_change
      module procedure real_change, complex_change
   end interface reynolds_change

   !> Nodes whose pressure and film enter the flow through the faces of a node: itself, east, west, north, south.
   integer, parameter, public :: flow_links = 5

contains

   !> Weights of a grid for a contact of ellipticity kappa.
   pure function new_mesh(grid, kappa) result(self)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa
      type(mesh_t) :: self
      self%grid = grid
      self%kappa = kappa
      self%cx = 0.5_dp/grid%hx**2
      self%cy = 0.5_dp*kappa**2/grid%hy**2
   end function new_mesh

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

   !> The same on some rows.
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
#include "reynolds_change.inc"
#undef SCALAR
#undef WEDGE
#undef CHANGE
#undef CHANGE_ROWS
#undef COEFFICIENT_CHANGE
#undef FACE_CHANGE
#undef GENERAL_CHANGE

#define SCALAR complex(dp)
#define WEDGE complex_wedge_t
#define CHANGE complex_change
#define CHANGE_ROWS complex_change_rows
#define COEFFICIENT_CHANGE complex_coefficient_change
#define FACE_CHANGE complex_face_change
#define GENERAL_CHANGE complex_general_change
#include "reynolds_change.inc"

   !> Derivatives of the flow into a block of nodes, in array order, by the pressure (at fixed film) and by the film of
   !> their links: of the first part of R.
   pure subroutine poiseuille_links(mesh, flow, block, by_p, by_h)
      type(mesh_t), intent(in) :: mesh
      type(flow_t), intent(in) :: flow                       !! at the point of linearisation
      integer, intent(in) :: block(4)                        !! nodes: first and last i, first and last j
      real(dp), intent(out) :: by_p(:, :), by_h(:, :)        !! (nodes, flow_links)
      real(dp) :: east, north, south, west
      integer :: i, j, jm, jp, k, shift

      if (flow%has_face_fluxes()) then
         call general_links(mesh, flow, block, by_p, by_h)
         return
      end if
      associate (eps => flow%eps, eps_p => flow%eps_p, eps_h => flow%eps_h, p => flow%p, cx => mesh%cx, cy => mesh%cy)
         do j = block(3), block(4)
            jm = mesh%grid%below(j)
            jp = mesh%grid%above(j)
            shift = (j - block(3))*(block(2) - block(1) + 1) + 1 - block(1)
            do i = block(1), block(2)
               k = i + shift
               east = cx*(p(i + 1, j) - p(i, j))
               west = cx*(p(i - 1, j) - p(i, j))
               north = cy*(p(i, jp) - p(i, j))
               south = cy*(p(i, jm) - p(i, j))
               by_p(k, 2) = cx*(eps(i, j) + eps(i + 1, j))
               by_p(k, 3) = cx*(eps(i - 1, j) + eps(i, j))
               by_p(k, 4) = cy*(eps(i, j) + eps(i, jp))
               by_p(k, 5) = cy*(eps(i, jm) + eps(i, j))
               by_p(k, 1) = -(by_p(k, 2) + by_p(k, 3) + by_p(k, 4) + by_p(k, 5)) &
                            + (east + west + north + south)*eps_p(i, j)
               by_p(k, 2) = by_p(k, 2) + east*eps_p(i + 1, j)
               by_p(k, 3) = by_p(k, 3) + west*eps_p(i - 1, j)
               by_p(k, 4) = by_p(k, 4) + north*eps_p(i, jp)
               by_p(k, 5) = by_p(k, 5) + south*eps_p(i, jm)
               by_h(k, 1) = (east + west + north + south)*eps_h(i, j)
               by_h(k, 2) = east*eps_h(i + 1, j)
               by_h(k, 3) = west*eps_h(i - 1, j)
               by_h(k, 4) = north*eps_h(i, jp)
               by_h(k, 5) = south*eps_h(i, jm)
            end do
         end do
      end associate
   end subroutine poiseuille_links

   !> The same of an oil that is not Newtonian, but for the small part that a gradient along a face drives through it.
   pure subroutine general_links(mesh, flow, block, by_p, by_h)
      type(mesh_t), intent(in) :: mesh
      type(flow_t), intent(in) :: flow
      integer, intent(in) :: block(4)
      real(dp), intent(out) :: by_p(:, :), by_h(:, :)
      integer :: below, i, j, k

      k = 0
      do j = block(3), block(4)
         do i = block(1), block(2)
            k = k + 1
            by_p(k, :) = 0
            by_h(k, :) = 0
            call add_link(flow%along_x, mesh%cx, [i, j], .true., by_p(k, 1), by_p(k, 2), by_h(k, 1), by_h(k, 2))
            call add_link(flow%along_x, mesh%cx, [i - 1, j], .false., by_p(k, 1), by_p(k, 3), by_h(k, 1), by_h(k, 3))
            if (mesh%grid%ny == 0) cycle
            call add_link(flow%along_y, mesh%cy, [i, j], .true., by_p(k, 1), by_p(k, 4), by_h(k, 1), by_h(k, 4))
            ! the face below a line of symmetry mirrors that above it
            below = mesh%grid%below(j)
            call add_link(flow%along_y, mesh%cy, [i, min(j, below)], below > j, by_p(k, 1), by_p(k, 5), by_h(k, 1), &
               by_h(k, 5))
         end do
      end do
   end subroutine general_links

   !> Terms that the flow through a face adds to the derivatives of a node's residual, by itself and by the other node
   !> of the face.
   pure subroutine add_link(faces, c, face, is_first, own_p, other_p, own_h, other_h)
      type(face_flow_t), intent(in) :: faces
      real(dp), intent(in) :: c              !! weight of a flux
      integer, intent(in) :: face(2)
      logical, intent(in) :: is_first        !! whether the node is the face's first: then what flows through it flows
                                             !! in
      real(dp), intent(inout) :: own_p, other_p, own_h, other_h

      associate (i => face(1), j => face(2))
         if (is_first) then
            own_p = own_p + c*(faces%by_p1(i, j) - faces%own(i, j))
            other_p = other_p + c*(faces%by_p2(i, j) + faces%own(i, j))
            own_h = own_h + c*faces%by_h1(i, j)
            other_h = other_h + c*faces%by_h2(i, j)
         else
            own_p = own_p - c*(faces%by_p2(i, j) + faces%own(i, j))
            other_p = other_p - c*(faces%by_p1(i, j) - faces%own(i, j))
            own_h = own_h - c*faces%by_h2(i, j)
            other_h = other_h - c*faces%by_h1(i, j)
         end if
      end associate
   end subroutine add_link

   !> 1/|A_ii|: how much pressure one unit of residual is worth at each unknown node, from the Poiseuille
   !> terms and the effect of the node's own deformation on the wedge term. Zero elsewhere. A limit of the stress, which
   !> a gradient of the pressure raises, can make a flow fall as its gradient grows: it counts by its size.
   subroutine reynolds_scale(mesh, wedge, self_influence, flow, scale)
      type(mesh_t), intent(in) :: mesh
      real(dp), intent(in) :: wedge(0:)        !! (0:nx) modulus of the weight of a node's own rho H
      real(dp), intent(in) :: self_influence   !! deformation at a node under its own unit pressure
      type(flow_t), intent(in) :: flow
      real(dp), intent(out) :: scale(0:, 0:)   !! (0:nx, 0:ny)
      integer :: i, j, jm, jp

      scale(:, 0) = 0
      scale(:, mesh%grid%ny) = 0
      !$omp parallel do private(i, jm, jp) schedule(static) if (is_shared(size(scale)))
      do j = mesh%grid%first_row, mesh%grid%last_row
         scale(0, j) = 0
         scale(mesh%grid%nx, j) = 0
         jm = mesh%grid%below(j)
         jp = mesh%grid%above(j)
         if (flow%has_face_fluxes()) then
            do i = 1, mesh%grid%nx - 1
               scale(i, j) = 1/(mesh%cx*(abs(flow%along_x%own(i - 1, j)) + abs(flow%along_x%own(i, j))) &
                                + mesh%cy*(abs(flow%along_y%own(i, min(j, jm))) + abs(flow%along_y%own(i, j))) &
                                + wedge(i)*(flow%rho(i, j)*self_influence + flow%f_p(i, j)))
            end do
            cycle
         end if
         do i = 1, mesh%grid%nx - 1
            scale(i, j) = 1/(mesh%cx*(flow%eps(i - 1, j) + 2*flow%eps(i, j) + flow%eps(i + 1, j)) &
                             + mesh%cy*(flow%eps(i, jm) + 2*flow%eps(i, j) + flow%eps(i, jp)) &
                             + wedge(i)*(flow%rho(i, j)*self_influence + flow%f_p(i, j)))
         end do
      end do
   end subroutine reynolds_scale

   !> How fast the oil that flows into a node falls with the node's own pressure at fixed fluxes of its neighbours:
   !> -d eps/dP times the pressure differences around it.
   pure real(dp) function intake(mesh, flow, i, j)
      type(mesh_t), intent(in) :: mesh
      type(flow_t), intent(in) :: flow
      integer, intent(in) :: i, j   !! node
      if (flow%has_face_fluxes()) then
         intake = intake_at_gradient(mesh, flow, i, j)
         return
      end if
      associate (p => flow%p, jm => mesh%grid%below(j), jp => mesh%grid%above(j))
         intake = -flow%eps_p(i, j)*(mesh%cx*(p(i + 1, j) - 2*p(i, j) + p(i - 1, j)) &
                                     + mesh%cy*(p(i, jp) - 2*p(i, j) + p(i, jm)))
      end associate
   end function intake

   !> The same of an oil that is not Newtonian: by the node's own pressure at fixed gradients.
   pure real(dp) function intake_at_gradient(mesh, flow, i, j) result(intake)
      type(mesh_t), intent(in) :: mesh
      type(flow_t), intent(in) :: flow
      integer, intent(in) :: i, j   !! node
      real(dp) :: from_below

      associate (x => flow%along_x, y => flow%along_y, below => mesh%grid%below(j))
         intake = -mesh%cx*(x%by_p1(i, j) - x%by_p2(i - 1, j))
         if (mesh%grid%ny == 0) return
         from_below = -y%by_p2(i, min(j, below))
         if (below > j) from_below = y%by_p1(i, j)
         intake = intake - mesh%cy*(y%by_p1(i, j) + from_below)
      end associate
   end function intake_at_gradient

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
      end do
      do j = 0, mesh%grid%ny - 1
         call real_general_change(mesh, flow, q, dh, [j, j + 1], flux)
         flow%along_y%flux(:, j) = flow%along_y%flux(:, j) + flux
      end do
      flow%f = flow%f + flow%f_p*q + flow%rho*dh
   end subroutine follow_state

end module ehlwave_reynolds
