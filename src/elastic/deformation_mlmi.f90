!> Elastic deformation by multilevel multi-integration.
module ehlwave_deformation_mlmi
   use ehlwave_deformation, only: deformation_t
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   use ehlwave_mlmi_correction, only: along_x, along_y, sampled_kernel_t
   use ehlwave_mlmi_level, only: mlmi_level_t
   implicit none (type, external)
   private

   integer, parameter :: most_levels = 40

   type, extends(deformation_t), public :: deformation_mlmi_t
      integer :: order = 6
      real(dp) :: reach = 0
      integer :: max_levels = 99
      type(mlmi_level_t), allocatable, private :: level(:)
   contains
      procedure :: init
      procedure :: apply
      procedure :: describe
   end type deformation_mlmi_t

contains

   subroutine init(self, grid, kappa, k)
      class(deformation_mlmi_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa   !! ellipticity a/b
      real(dp), intent(in) :: k       !! complete elliptic integral of the first kind
      type(mlmi_level_t) :: level(most_levels), next
      real(dp) :: gap(2)
      integer :: direction, l

      level(1)%last = [grid%nx, grid%ny]
      level(1)%is_half = grid%is_half
      level(1)%kernel = sampled_kernel_t(hx=grid%hx, hy=grid%hy, kappa=kappa, k=k)
      do l = 1, most_levels - 1
         gap = level(l)%kernel%gaps()
         direction = merge(along_x, along_y, gap(1) <= gap(2))
         call level(l)%plan_coarser(direction, self%order, self%reach, next)
         if (l >= self%max_levels) exit
         if (self%max_levels > 90 .and. level(l)%sum_cost() <= level(l)%step_cost(self%order) + next%sum_cost()) exit
         call level(l)%make_coarsening(direction, self%order)
         level(l + 1) = next
      end do
      call level(l)%make_coarsest(self%order)
      self%level = level(:l)
   end subroutine init

   subroutine apply(self, p, d)
      class(deformation_mlmi_t), intent(inout) :: self
      real(dp), intent(in) :: p(0:, 0:)    !! pressure at the nodes, (0:nx, 0:ny), zero on the outer boundary
      real(dp), intent(out) :: d(0:, 0:)   !! deformation, (0:nx, 0:ny)
      integer :: j, l, n

      n = size(self%level)
      do j = 0, ubound(p, 2)
         call self%level(1)%put_row(j, 0, p(:, j))
      end do
      call self%level(1)%mirror_pressure()
      do l = 1, n - 1
         call self%level(l)%anterpolate(self%level(l + 1))
      end do
      if (n == 1) then
         do j = 0, ubound(p, 2)
            call self%level(1)%sum_row(j, d(:, j))
         end do
         return
      end if
      associate (coarsest => self%level(n))
         do j = coarsest%first(2), coarsest%last(2)
            call coarsest%sum_row(j, coarsest%u(:, j))
         end do
         call coarsest%mirror_result()
      end associate
      do l = n - 1, 2, -1
         associate (level => self%level(l))
            call level%finish(self%level(l + 1), level%first, level%u(:, level%first(2):))
            call level%mirror_result()
         end associate
      end do
      call self%level(1)%finish(self%level(2), [0, 0], d)
   end subroutine apply

   subroutine describe(self)
      class(deformation_mlmi_t), intent(in) :: self
      integer :: l
      do l = 1, size(self%level)
         associate (v => self%level(l))
            print *, l, v%direction, v%first, v%last, v%correction%reach_x, v%correction%reach_y, sum(2*v%correction%width + 1)
         end associate
      end do
   end subroutine describe

end module ehlwave_deformation_mlmi
