!> Derivatives of the discrete Reynolds equation at single nodes: the links of a node, its diagonal, and how the oil it
!> takes in depends on its own pressure. Matrices and relaxations are made of them.
!>
!> They are the derivatives of the fluxes of `ehlwave_reynolds`: change both together. Nodes are unknown nodes.
module ehlwave_reynolds_links
   use ehlwave_face_flow, only: face_flow_t
   use ehlwave_flow, only: flow_t
   use ehlwave_kinds, only: dp
   use ehlwave_mesh, only: mesh_t
   use ehlwave_raised_flux, only: curvature
   use ehlwave_threads, only: is_shared
   implicit none (type, external)
   private
   public :: intake, poiseuille_links, reynolds_scale

   !> Nodes whose pressure and film enter the flow through the faces of a node: itself, east, west, north, south.
   integer, parameter, public :: flow_links = 5

contains

   !> Derivatives of the flow into a block of nodes, in array order, by the pressure (at fixed film) and by the film of
   !> their links: of the first part of R.
   pure subroutine poiseuille_links(mesh, flow, block, by_p, by_h)
      type(mesh_t), intent(in) :: mesh
      type(flow_t), intent(in) :: flow                       !! at the point of linearisation
      integer, intent(in) :: block(4)                        !! nodes: first and last i, first and last j
      real(dp), intent(out), contiguous :: by_p(:, :), by_h(:, :)   !! (nodes, flow_links)
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

   !> Links of an oil that is not Newtonian, without the small flow through a face that a gradient along it drives. Of a
   !> raised flux the share of the face itself counts, with 7/6 of its flow.
   pure subroutine general_links(mesh, flow, block, by_p, by_h)
      type(mesh_t), intent(in) :: mesh
      type(flow_t), intent(in) :: flow
      integer, intent(in) :: block(4)
      real(dp), intent(out), contiguous :: by_p(:, :), by_h(:, :)
      real(dp) :: cx, cy
      integer :: below, first, i, j, last, n

      cx = mesh%cx
      cy = mesh%cy
      if (flow%along_x%is_raised) cx = (1 + 2*curvature)*cx
      if (flow%along_y%is_raised) cy = (1 + 2*curvature)*cy
      i = block(1)
      n = block(2) - i + 1
      by_p = 0
      by_h = 0
      do j = block(3), block(4)
         first = (j - block(3))*n + 1
         last = first + n - 1
         associate (own_p => by_p(first:last, 1), own_h => by_h(first:last, 1))
            call add_links(flow%along_x, cx, [i, j], .true., n, own_p, by_p(first:last, 2), own_h, &
                           by_h(first:last, 2))
            call add_links(flow%along_x, cx, [i - 1, j], .false., n, own_p, by_p(first:last, 3), own_h, &
                           by_h(first:last, 3))
            if (mesh%grid%ny == 0) cycle
            call add_links(flow%along_y, cy, [i, j], .true., n, own_p, by_p(first:last, 4), own_h, &
                           by_h(first:last, 4))
            ! the face below a line of symmetry mirrors that above it
            below = mesh%grid%below(j)
            call add_links(flow%along_y, cy, [i, min(j, below)], below > j, n, own_p, by_p(first:last, 5), own_h, &
                           by_h(first:last, 5))
         end associate
      end do
   end subroutine general_links

   !> Terms that the flow through a row of faces adds to the derivatives of the residuals of a row of nodes, by
   !> themselves and by the other nodes of the faces.
   pure subroutine add_links(faces, c, face, is_first, n, own_p, other_p, own_h, other_h)
      type(face_flow_t), intent(in) :: faces
      real(dp), intent(in) :: c          !! weight of a flux
      integer, intent(in) :: face(2)     !! the first
      logical, intent(in) :: is_first    !! whether a node is its face's first: then the flux through the face flows in
      integer, intent(in) :: n           !! nodes
      real(dp), dimension(n), intent(inout) :: own_p, other_p, own_h, other_h
      integer :: i, k

      associate (j => face(2))
         do k = 1, n
            i = face(1) + k - 1
            if (is_first) then
               own_p(k) = own_p(k) + c*(faces%by_p1(i, j) - faces%own(i, j))
               other_p(k) = other_p(k) + c*(faces%by_p2(i, j) + faces%own(i, j))
               own_h(k) = own_h(k) + c*faces%by_h1(i, j)
               other_h(k) = other_h(k) + c*faces%by_h2(i, j)
            else
               own_p(k) = own_p(k) - c*(faces%by_p2(i, j) + faces%own(i, j))
               other_p(k) = other_p(k) - c*(faces%by_p1(i, j) - faces%own(i, j))
               own_h(k) = own_h(k) - c*faces%by_h2(i, j)
               other_h(k) = other_h(k) - c*faces%by_h1(i, j)
            end if
         end do
      end associate
   end subroutine add_links

   !> 1/|A_ii|: pressure change for a unit residual at each unknown node, from the Poiseuille terms and the effect of
   !> the node's own deformation on the wedge term. Zero elsewhere. A limit of the stress, which a gradient of the
   !> pressure raises, can make a flow fall as its gradient grows: it counts by its size.
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

   !> Intake of an oil that is not Newtonian: by the node's own pressure at fixed gradients.
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

end module ehlwave_reynolds_links
