!> The two kinds of change of a line relaxation, and where which is used.
!>
!> Venner (1991); Venner and Lubrecht, Multilevel Methods in Lubrication (2000), chapter 6. Where Poiseuille flow
!> dominates, a change is single: the pressure of one node. Where it is weak, the equation determines the deformation,
!> whose kernel reaches far: there a change is distributive, 1 at the node and in sum -1 at its four neighbours, and
!> its deformation falls as 1/r^3.
module ehlwave_relaxation_change
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_kernel, only: kernel_t, new_kernel
   use ehlwave_kinds, only: dp
   use ehlwave_rheology, only: rheology_t
   implicit none (type, external)
   private
   public :: new_relaxation_change

   integer, parameter, public :: single = 0, distributed = 1   !! kinds of change

   !> Poiseuille over wedge coefficient below which changes are distributed, for cells that are square in metres.
   !> It grows with the square of their aspect: single changes in long cells deform many of their neighbours.
   real(dp), parameter :: switch_of_squares = 3

   !> Switch for an oil that is not Newtonian. The ratio counts the flow along X and across. Where sliding makes the
   !> flow along X several times easier, lines couple less, and single changes spread at ratios that would do
   !> otherwise.
   real(dp), parameter :: switch_of_easy_flow = 6

   !> Switch for an oil whose thickening by a pressure increment is as strong at the Hertz pressure as at zero
   !> pressure. Its spike grows with refinement (Barus' law, M = 20, L = 10: 2.5, 3.3, 4.5, 6.3 on 256^2 to 2048^2
   !> cells). The flow changes there by a large factor between nodes, so that the sum of the flows to all sides is a
   !> poor measure of coupling. On 2048^2 cells cycles do not converge with a switch of 3.
   real(dp), parameter :: switch_of_steep_spike = 6

   !> Switch on a fitted grid, whose upstream differences respond more strongly to changes of a line. M = 1000, D =
   !> 1, 512^2 cells to 1e-3: 40 cycles without convergence with 3, 7 cycles with 6, 5 with 12.
   real(dp), parameter :: switch_of_fitted = 12
   real(dp), parameter :: steep_share = 0.9_dp   ! ratio of the thickening at P = 0 to its value at P = 1

   !> Changes of strength 1 on a grid.
   type, public :: relaxation_change_t
      integer :: reach = 3                             !! nodes along X within which a line sees its own deformation
      real(dp) :: switch = 0                           !! `switch_of_squares` for the cells of this grid
      real(dp) :: share_x = 0, share_y = 0             !! shares of a distributive change at its neighbours
      real(dp), allocatable :: shape(:, :, :)          !! pressure of a change, (-reach-2:reach+2, 0:1, kind)
      real(dp), allocatable :: influence(:, :, :)      !! its deformation
   end type relaxation_change_t

contains

   !> Changes for the grid, the contact and the oil of a problem.
   function new_relaxation_change(problem) result(self)
      type(contact_problem_t), intent(in) :: problem
      type(relaxation_change_t) :: self
      type(kernel_t) :: kernel
      real(dp) :: aspect
      integer :: i, j, r

      associate (grid => problem%grid, kappa => problem%conditions%elliptic%kappa, k => problem%conditions%elliptic%k)
         kernel = new_kernel(grid, kappa, k)
         aspect = grid%hy/(kappa*grid%hx)
         self%switch = switch_of(problem%rheology)*max(aspect, 1/aspect)**2
         if (grid%is_fitted) self%switch = max(self%switch, switch_of_fitted*max(aspect, 1/aspect)**2)
         self%reach = max(3, min(5, nint(aspect)))
         self%share_x = 0.5_dp*max(0.5_dp, aspect**2/(1 + aspect**2))
         self%share_y = 0.5_dp - self%share_x
         r = self%reach + 2
         allocate (self%shape(-r:r, 0:1, 0:1), self%influence(-r:r, 0:1, 0:1), source=0.0_dp)
         self%shape(0, 0, :) = 1
         self%shape(-1, 0, distributed) = -self%share_x
         self%shape(1, 0, distributed) = -self%share_x
         self%shape(0, 1, distributed) = -self%share_y
         do j = 0, 1
            do i = -r, r
               self%influence(i, j, single) = kernel%at(i, j)
               self%influence(i, j, distributed) = kernel%at(i, j) &
                  - self%share_x*(kernel%at(i - 1, j) + kernel%at(i + 1, j)) &
                  - self%share_y*(kernel%at(i, j - 1) + kernel%at(i, j + 1))
            end do
         end do
      end associate
   end function new_relaxation_change

   !> The switch of square cells, for an oil.
   pure real(dp) function switch_of(rheology) result(switch)
      type(rheology_t), intent(in) :: rheology
      real(dp), dimension(2) :: rho, drho, fluidity, thickening

      switch = switch_of_squares
      if (.not. rheology%is_newtonian()) switch = switch_of_easy_flow
      call rheology%evaluate(2, [0.0_dp, 1.0_dp], rho, drho, fluidity, thickening)
      if (thickening(2) > steep_share*thickening(1)) switch = max(switch, switch_of_steep_spike)
   end function switch_of

end module ehlwave_relaxation_change
