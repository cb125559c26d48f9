!> The way of the oil offered to a contact: content of the gap, layers that leave it, and the balance of both.
module ehlwave_oil_passage
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_equations, only: equations_t
   use ehlwave_given, only: given_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_reynolds, only: face_flux
   use ehlwave_state, only: state_t
   implicit none (type, external)
   private
   public :: follow_oil

   real(dp), parameter :: nothing = 1e-15_dp   !! share of the oil that is round-off of pressures far out

   !> Oil balance of a solution.
   type, public :: oil_passage_t
      real(dp), allocatable :: content(:, :)   !! theta, (0:nx, 0:ny)
      real(dp), allocatable :: offered(:)      !! (0:ny) inflow through the inlet edge, rho H over the mean speed
      real(dp), allocatable :: behind(:)       !! (0:ny) outflow through the outlet edge
      real(dp) :: side_flow = no_value         !! share of the inflow that leaves over the sides
      real(dp) :: balance_error = no_value     !! relative loss or gain of oil
      real(dp) :: meniscus_x = no_value        !! X at Y = 0 from which on the gap is full; NaN: outside the domain
   end type oil_passage_t

contains

   !> Follow the oil through a solution; a time step lacks a balance, as the gap fills and empties.
   subroutine follow_oil(problem, given, state, passage)
      type(contact_problem_t), intent(in) :: problem
      type(given_t), intent(in) :: given               !! to the solution, with a supply
      type(state_t), intent(in) :: state
      type(oil_passage_t), intent(out) :: passage
      type(equations_t) :: equations
      real(dp) :: entering, side, width
      real(dp), dimension(0:problem%grid%nx) :: flux
      integer :: j, nx

      call equations%init(problem)
      call equations%evaluate(problem, given, state)
      associate (grid => problem%grid, mesh => equations%mesh, content => equations%content, flow => equations%flow)
         nx = grid%nx
         allocate (passage%content(0:nx, 0:grid%ny), source=flow%f)
         call fill_edges(passage%content, grid, state%p)
         passage%content(:, :) = min(1.0_dp, passage%content/(flow%rho*state%h))
         allocate (passage%offered(0:grid%ny), source=flow%f(0, :))
         allocate (passage%behind(0:grid%ny), source=flow%f(0, :))
         passage%meniscus_x = meniscus(equations, state)
         if (allocated(given%transport%inflow)) return
         do j = grid%first_row, grid%last_row
            call face_flux(flow, j, j, 1, flux)
            passage%behind(j) = content%outflow(nx - 1, j) - grid%hx*mesh%cx*flux(nx - 1)
            ! The inflow of the first node is extrapolated like its outflow
            passage%offered(j) = flow%f(0, j) + content%outflow(1, j) - flow%f(1, j) - grid%hx*mesh%cx*flux(0)
         end do
         width = grid%hy
         entering = sum(grid%weight(grid%first_row:grid%last_row)*passage%offered(grid%first_row:grid%last_row))*width
         side = 0
         if (.not. grid%is_line) then
            call face_flux(flow, grid%last_row, grid%ny, 0, flux)
            side = -grid%weight(grid%last_row)*sum(flux(1:nx - 1))
            if (.not. grid%is_half) then
               call face_flux(flow, 0, grid%first_row, 0, flux)
               side = side + sum(flux(1:nx - 1))
            end if
            side = side*mesh%cy*grid%hx*grid%hy
         end if
         passage%side_flow = merge(side/entering, 0.0_dp, abs(side) > nothing*entering)
         passage%balance_error = abs(entering - side - width* &
            sum(grid%weight(grid%first_row:grid%last_row)*passage%behind(grid%first_row:grid%last_row)))/entering
      end associate
   end subroutine follow_oil

   !> Edges without pressure beside the contact and downstream, where no balance holds: the oil there comes from the
   !> inlet edge or the nodes upstream.
   pure subroutine fill_edges(oil, grid, p)
      real(dp), intent(inout) :: oil(0:, 0:)   !! rho theta H, (0:nx, 0:ny)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: p(0:, 0:)
      integer :: j

      do j = 0, grid%ny
         if (j < grid%first_row .or. j > grid%last_row) then
            where (.not. p(:, j) > 0) oil(:, j) = oil(0, j)
         end if
      end do
      oil(grid%nx, :) = oil(grid%nx - 1, :)
   end subroutine fill_edges

   !> Place where the gap becomes full upstream of the centre at Y = 0. It lies behind the last partly filled node,
   !> by its share of content between inflow and full. The pressure of the next node drives that share back, so that
   !> the pressure begins here.
   pure real(dp) function meniscus(equations, state) result(x)
      type(equations_t), intent(in) :: equations
      type(state_t), intent(in) :: state
      real(dp) :: arriving, share
      integer :: i, row

      associate (grid => equations%mesh%grid, content => equations%content, flow => equations%flow)
         row = minloc(abs(grid%y), 1) - 1
         x = no_value
         i = minloc(abs(grid%x), 1) - 1
         if (content%is_partial(i, row)) return
         do i = i, 0, -1
            if (content%is_partial(i, row)) exit
         end do
         if (i < 0) return
         share = 0
         if (i > 0) then
            arriving = content%outflow(i - 1, row)
            share = (flow%f(i, row) - arriving)/max(flow%rho(i, row)*state%h(i, row) - arriving, tiny(1.0_dp))
         end if
         x = grid%x(i) + grid%hx*(1 - min(max(share, 0.0_dp), 1.0_dp))
      end associate
   end function meniscus

end module ehlwave_oil_passage
