!> Elastic deformation by multilevel multi-integration (MLMI).
!>
!> Brandt and Lubrecht, J. Comput. Phys. 90 (1990) 348-370; Venner and Lubrecht, Multilevel Methods in
!> Lubrication (2000), chapter 5. The sum D(i) = sum over k of K(i - k) P(k) with the cell kernel K is
!> brought to every second node along a direction, first where the node distance in metres is smaller, again and
!> again: first along the finer direction only when the cells are not square, then in turn.
!>
!>     P'   = (adjoint of interpolation) P                          anterpolate
!>     u'   = sum over coarse nodes of K at coarse distances P'     the same again, or the sum itself
!>     u    = interpolation of (u' + corrections) + corrections     interpolate_and_correct
!>
!> The corrections replace the interpolated kernel by the exact kernel near its singularity. The neglected far
!> corrections are the error, which does not depend on how smooth P is. With all corrections the sum is exact.
module ehlwave_deformation_mlmi
   use ehlwave_deformation, only: deformation_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kernel, only: new_kernel
   use ehlwave_kinds, only: dp
   use ehlwave_mlmi_correction, only: along_x, along_y
   use ehlwave_mlmi_level, only: mlmi_level_t
   use ehlwave_mlmi_transfer, only: anterpolate, interpolate_and_correct, sum_directly
   use ehlwave_work_unit, only: mlmi_operations
   implicit none (type, external)
   private

   integer, parameter :: most_levels = 40

   !> Set the components before `init`; the defaults make an error well below the discretisation error.
   type, extends(deformation_t), public :: deformation_mlmi_t
      integer :: order = 8          !! order of the transfers: 4, 6 or 8
      real(dp) :: reach = 0         !! radius of the corrections on the finest level in nodes; 0: by the grid
      integer :: levels = 0         !! number of levels, 1 is direct summation; 0: the cheapest
      type(mlmi_level_t), allocatable, private :: level(:)   ! finest first
   contains
      procedure :: init
      procedure :: apply
   end type deformation_mlmi_t

contains

   !> Levels, corrections and work space for a grid; kappa and K of the contact.
   subroutine init(self, grid, kappa, k)
      class(deformation_mlmi_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa   !! ellipticity a/b
      real(dp), intent(in) :: k       !! complete elliptic integral of the first kind
      type(mlmi_level_t) :: level(most_levels)
      real(dp) :: gaps(2), reach
      integer :: direction, l

      reach = self%reach
      if (reach <= 0) reach = default_reach(self%order, grid)
      level(1)%last = [grid%nx, grid%ny]
      level(1)%is_half = grid%is_half
      level(1)%kernel%kernel_t = new_kernel(grid, kappa, k)
      do l = 1, most_levels - 1
         if (l == self%levels) exit
         gaps = level(l)%kernel%gaps()
         direction = merge(along_x, along_y, gaps(1) <= gaps(2))
         call level(l)%plan_coarser(direction, self%order, reach, level(l + 1))
         if (self%levels < 1 .and. &
             level(l)%sum_cost() <= level(l)%step_cost(self%order) + level(l + 1)%sum_cost()) exit
         call level(l)%make_coarsening(direction, self%order)
      end do
      call level(l)%make_coarsest(self%order)
      self%level = level(:l)
      self%convolution = mlmi_operations*product(self%level(1)%last + 1)
   end subroutine init

   !> Radius that makes the error fall as h^2: with a constant radius it falls as h, and with growing radius about
   !> as reach^(2 - order). At 256 by 256 cells the error is below a tenth of the discretisation error (the change
   !> of the Hertz deformation from 128 by 128 cells). Small grids cost nothing and get a fixed radius.
   pure real(dp) function default_reach(order, grid)
      integer, intent(in) :: order
      type(grid_t), intent(in) :: grid
      real(dp) :: cells
      cells = max(128.0_dp, sqrt(real(grid%nx, dp)*grid%ny*merge(2, 1, grid%is_half)))
      select case (order)
      case (:4)
         default_reach = 7*sqrt(cells/256)
      case (5:6)
         default_reach = 6*(cells/256)**0.3_dp
      case default
         default_reach = 6.5_dp*(cells/256)**0.25_dp
      end select
   end function default_reach

   !> Deformation D = sum over cells of influence times P, theory eq. (9), at all nodes.
   subroutine apply(self, p, d)
      class(deformation_mlmi_t), intent(inout) :: self
      real(dp), intent(in), contiguous :: p(0:, 0:)    !! pressure at the nodes, (0:nx, 0:ny), zero on the outer
                                                       !! boundary
      real(dp), intent(out), contiguous :: d(0:, 0:)   !! deformation, (0:nx, 0:ny)
      integer :: j, l, n

      self%work = self%work + self%convolution
      n = size(self%level)
      do j = 0, self%level(1)%last(2)
         call self%level(1)%put_row(j, 0, p(:, j))
      end do
      call self%level(1)%mirror_pressure()
      if (n == 1) then
         call sum_directly(self%level(1), [0, 0], d)
         return
      end if

      do l = 1, n - 1
         call anterpolate(self%level(l), self%level(l + 1))
      end do
      associate (coarsest => self%level(n))
         call sum_directly(coarsest, coarsest%first, coarsest%u(:, coarsest%first(2):))
         call coarsest%mirror_result()
      end associate
      do l = n - 1, 2, -1
         associate (level => self%level(l))
            call interpolate_and_correct(level, self%level(l + 1), level%first, level%u(:, level%first(2):))
            call level%mirror_result()
         end associate
      end do
      call interpolate_and_correct(self%level(1), self%level(2), [0, 0], d)
   end subroutine apply

end module ehlwave_deformation_mlmi
