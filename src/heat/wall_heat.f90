!> Temperatures of both surfaces under steady heat flows: half-spaces that move along X, theory eq. (T7).
!>
!> Heat upstream in the same row, as if even along Y, acts in the march of the row. The rest, which is small under fast
!> surfaces, is known from the march before: `rest`. The change of the heat flows with the rises of the surfaces, as
!> conduction across the film has it, lets it settle in a few marches also where surfaces are slow.
module ehlwave_wall_heat
   use ehlwave_grid, only: grid_t
   use ehlwave_heat_data, only: heat_scales_t
   use ehlwave_kinds, only: dp
   use ehlwave_moving_convolution, only: moving_convolution_t, moving_transform_t, new_moving_convolution
   use ehlwave_moving_source, only: source_weights
   use ehlwave_real_gmres, only: gmres_t, linear_system_t
   implicit none (type, external)
   private
   public :: new_wall_heat

   type, public :: wall_heat_t
      real(dp), allocatable :: upstream(:, :)    !! (0:nx, 2) rise by a unit of heat nx, nx - 1, ..., 0 nodes upstream
      real(dp), allocatable :: rest(:, :, :)     !! rises of surfaces 1 and 2 by all other heat, (2, 0:nx, 0:ny)
      real(dp) :: operations = 0                 !! counted work
      type(moving_convolution_t), private :: body(2)
   contains
      procedure :: take
      procedure :: settle
   end type wall_heat_t

   !> Change of the rises r of both surfaces with heat that changes with it: r - A (change of heat).
   type, extends(linear_system_t) :: coupled_walls_t
      type(grid_t) :: grid
      type(moving_convolution_t) :: body(2)
      type(moving_transform_t) :: transform
      real(dp), allocatable :: response(:, :, :)
   contains
      procedure :: multiply
      procedure :: precondition
      procedure :: is_spent
   end type coupled_walls_t

   real(dp), parameter :: least_peclet = 1       ! Peclet number of the heat that the march of a row takes in
   integer, parameter :: most_steps = 20         ! steps of GMRES
   real(dp), parameter :: reduction = 0.1_dp     ! of the residual in them

contains

   !> Kernels of both surfaces on a grid.
   function new_wall_heat(grid, kappa, scales) result(self)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: kappa              !! a/b
      type(heat_scales_t), intent(in) :: scales
      type(wall_heat_t) :: self
      real(dp), allocatable :: kernel(:, :), row(:, :)
      real(dp) :: hy
      integer :: m, reach

      associate (nx => grid%nx, ny => grid%ny)
         allocate (self%upstream(0:nx, 2))
         allocate (self%rest(2, 0:nx, 0:ny), source=0.0_dp)
         reach = merge(2*ny, ny, grid%is_half)
         hy = 0
         if (.not. grid%is_line) hy = grid%hy/kappa
         do m = 1, 2
            row = scales%body(m)*source_weights(nx, 0, grid%hx, hy, max(scales%peclet(m), least_peclet), .true.)
            self%upstream(:, m) = row(2*nx + 1:nx + 1:-1, 1)
            kernel = scales%body(m)*source_weights(nx, reach, grid%hx, hy, scales%peclet(m), grid%is_line)
            self%body(m) = new_moving_convolution(grid, kernel, self%upstream(nx:0:-1, m))
         end do
      end associate
   end function new_wall_heat

   !> Rises by heat flows that are known.
   subroutine take(self, grid, heat)
      class(wall_heat_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: heat(:, 0:, 0:)    !! into surfaces 1 and 2, (2, 0:nx, 0:ny)
      type(moving_transform_t) :: transform
      call transform%init(self%body(1))
      call find_rest(self, transform, grid, heat, self%rest)
      self%operations = self%operations + transform%operations
   end subroutine take

   !> After a march: rises by its heat, as this changes with them.
   subroutine settle(self, grid, heat, response, is_fast, missing)
      class(wall_heat_t), intent(inout) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: heat(:, 0:, 0:)        !! of the march, (2, 0:nx, 0:ny)
      real(dp), intent(in) :: response(:, 0:, 0:)    !! see `change_heat`, (2, 0:nx, 0:ny)
      logical, intent(in) :: is_fast                 !! whether both surfaces are
      real(dp), intent(out) :: missing(:, 0:, 0:)    !! of the rises of the march, K, (2, 0:nx, 0:ny)
      type(coupled_walls_t) :: walls
      type(gmres_t) :: gmres
      real(dp), allocatable :: change(:), later(:, :, :)

      walls%grid = grid
      walls%body = self%body
      walls%response = response
      call walls%transform%init(self%body(1))
      call find_rest(self, walls%transform, grid, heat, missing)
      missing = missing - self%rest
      if (is_fast) then                              ! little of the rest changes with the heat
         self%rest = self%rest + missing
         self%operations = self%operations + walls%transform%operations
         return
      end if
      gmres%largest_steps = most_steps
      allocate (change(size(missing)))
      allocate (later, mold=heat)
      call gmres%solve(walls, reshape(missing, [size(missing)]), change, reduction)
      call change_heat(response, reshape(change, shape(missing)), later)
      later = heat + later
      call find_rest(self, walls%transform, grid, later, self%rest)
      self%operations = self%operations + walls%transform%operations
   end subroutine settle

   !> Rises by heat that the march of a row does not take in.
   subroutine find_rest(self, transform, grid, heat, rest)
      type(wall_heat_t), intent(in) :: self
      type(moving_transform_t), intent(inout) :: transform
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: heat(:, 0:, 0:)
      real(dp), intent(out) :: rest(:, 0:, 0:)
      integer :: m
      do m = 1, 2
         call transform%apply(self%body(m), grid, .false., heat(m, :, :), rest(m, :, :))
      end do
   end subroutine find_rest

   !> Change of heat flows with the rises of both surfaces: conduction from one to the other, and less heat of shear.
   pure subroutine change_heat(response, rise, heat)
      real(dp), intent(in) :: response(:, :, :)      !! conduction, change of the heat into each with a rise of one
      real(dp), intent(in) :: rise(:, :, :)
      real(dp), intent(out) :: heat(:, :, :)
      real(dp), dimension(size(rise, 2), size(rise, 3)) :: across, less
      across = response(1, :, :)*(rise(2, :, :) - rise(1, :, :))
      less = response(2, :, :)*(rise(1, :, :) + rise(2, :, :))
      heat(1, :, :) = less + across
      heat(2, :, :) = less - across
   end subroutine change_heat

   subroutine multiply(self, x, y)
      class(coupled_walls_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      real(dp) :: heat(2, 0:self%grid%nx, 0:self%grid%ny), rise(2, 0:self%grid%nx, 0:self%grid%ny)
      integer :: m
      call change_heat(self%response, reshape(x, shape(rise)), heat)
      do m = 1, 2
         call self%transform%apply(self%body(m), self%grid, .true., heat(m, :, :), rise(m, :, :))
      end do
      y = x - reshape(rise, [size(rise)])
   end subroutine multiply

   subroutine precondition(self, x, y)
      class(coupled_walls_t), intent(inout) :: self
      real(dp), intent(in), contiguous, target :: x(:)
      real(dp), intent(out), contiguous, target :: y(:)
      if (self%grid%nx > 0) y = x
   end subroutine precondition

   pure logical function is_spent(self)
      class(coupled_walls_t), intent(in) :: self
      is_spent = .not. self%grid%nx > 0
   end function is_spent

end module ehlwave_wall_heat
