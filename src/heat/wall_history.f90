!> Rise of a surface that moves along X under a heat flow that changes in time: a half-space that conducts into its
!> depth alone, theory eq. (T10).
!>
!> A point of the surface accumulates the heat taken since it came under the film. The kernel s^(-1/2) applies to the
!> last step, exact for flows that are linear in it, and before it a sum of exponentials, each of which goes on with the
!> surface from step to step.
module ehlwave_wall_history
   use ehlwave_kinds, only: dp, pi
   use ehlwave_lagrange, only: lagrange_weights
   implicit none (type, external)
   private
   public :: new_wall_history

   type, public :: wall_history_t
      real(dp) :: own = 0                             !! rise by a unit of heat flow at the end of a step
      real(dp), allocatable :: rise(:, :)             !! rise by all earlier heat, (0:nx, 0:ny)
      real(dp), allocatable :: heat(:, :)             !! flow at the last step, now at nodes that it has come to
      real(dp), allocatable :: modes(:, :, :)         !! integral of the flow times an exponential, (0:nx, 0:ny, modes)
      real(dp), private :: unit = 0                   ! rise over the integral of the flow times s^(-1/2)
      real(dp), private :: shift = 0                  ! cells that the surface moves in a step
      real(dp), private :: dt = 0
      real(dp), allocatable, private :: weight(:)     ! weights of modes,
      real(dp), allocatable, private :: decay(:)      ! decay in a step,
      real(dp), allocatable, private :: late(:), early(:)  ! gain by the flow at its end and at its start
   contains
      procedure :: take
      procedure :: go_on
   end type wall_history_t

   ! Rates of the exponentials are mu^2 with mu = e^y, in equal steps of y: s^(-1/2) = 2/sqrt(pi) integral exp(-mu^2 s)
   ! d mu has an error of 2e-4 then.
   real(dp), parameter :: step = 0.5_dp
   real(dp), parameter :: slowest = 0.3_dp            ! mu times the root of the longest time; slower modes are merged
   real(dp), parameter :: fastest = 12                ! mu^2 times a step
   integer, parameter :: points = 4                   ! points of the interpolation between nodes

contains

   !> A surface that has taken no heat.
   pure function new_wall_history(nx, ny, hx, speed, dt, unit) result(self)
      integer, intent(in) :: nx, ny
      real(dp), intent(in) :: hx
      real(dp), intent(in) :: speed        !! speed of the surface
      real(dp), intent(in) :: dt           !! length of a step
      real(dp), intent(in) :: unit         !! rise over the integral of the flow over X times X^(-1/2)
      type(wall_history_t) :: self
      real(dp), allocatable :: rate(:)
      real(dp) :: first
      integer :: k, n

      self%dt = dt
      self%shift = speed*dt/hx
      self%unit = unit*sqrt(speed)
      self%own = self%unit*4*sqrt(dt)/3
      allocate (self%rise(0:nx, 0:ny), self%heat(0:nx, 0:ny), source=0.0_dp)
      first = 0.5_dp*log(slowest**2/(nx*hx/speed + dt))
      n = ceiling((0.5_dp*log(fastest/dt) - first)/step) + 1
      allocate (rate(0:n), self%weight(0:n), self%decay(0:n), self%late(0:n), self%early(0:n))
      do k = 1, n
         rate(k) = exp(2*(first + (k - 1)*step))
         self%weight(k) = step*sqrt(rate(k))
      end do
      rate(0) = rate(1)*(exp(step) - 1)/(exp(3*step) - 1)
      self%weight(0) = self%weight(1)/(exp(step) - 1)
      do k = 0, n
         self%weight(k) = 2/sqrt(pi)*self%weight(k)
         self%decay(k) = exp(-rate(k)*dt)
         self%late(k) = dt*late_share(rate(k)*dt)
         self%early(k) = dt*early_share(rate(k)*dt)
      end do
      allocate (self%modes(0:nx, 0:ny, 0:n), source=0.0_dp)
   end function new_wall_history

   !> Integral of s exp(-z (1 - s)) over s from 0 to 1.
   pure real(dp) function late_share(z)
      real(dp), intent(in) :: z
      real(dp), parameter :: small = 1e-3_dp
      late_share = (1 - (1 - exp(-z))/max(z, small))/max(z, small)
      if (z < small) late_share = 0.5_dp - z/6 + z**2/24
   end function late_share

   !> Early share of (1 - s) exp(-z (1 - s)).
   pure real(dp) function early_share(z)
      real(dp), intent(in) :: z
      real(dp), parameter :: small = 1e-3_dp
      early_share = ((1 - exp(-z))/max(z, small) - exp(-z))/max(z, small)
      if (z < small) early_share = 0.5_dp - z/3 + z**2/8
   end function early_share

   !> Take the heat flow of the step that ends.
   pure subroutine take(self, heat)
      class(wall_history_t), intent(inout) :: self
      real(dp), intent(in) :: heat(0:, 0:)      !! (0:nx, 0:ny)
      integer :: k
      do k = 0, ubound(self%modes, 3)
         self%modes(:, :, k) = self%modes(:, :, k) + self%late(k)*heat + self%early(k)*self%heat
      end do
      self%heat = heat
   end subroutine take

   !> Move on by a step. Heat comes with the surface, none from before the first node.
   pure subroutine go_on(self)
      class(wall_history_t), intent(inout) :: self
      integer :: k

      call move(self%shift, self%heat)
      self%rise = 2*sqrt(self%dt)/3*self%heat
      do k = 0, ubound(self%modes, 3)
         call move(self%shift, self%modes(:, :, k))
         self%modes(:, :, k) = self%decay(k)*self%modes(:, :, k)
         self%rise = self%rise + self%weight(k)*self%modes(:, :, k)
      end do
      self%rise = self%unit*self%rise
   end subroutine go_on

   !> A field, on by so many cells.
   pure subroutine move(shift, field)
      real(dp), intent(in) :: shift
      real(dp), intent(inout), contiguous :: field(0:, 0:)
      real(dp) :: row(-points - ceiling(shift):ubound(field, 1)), weight(0:points - 1), last_weight(0:points - 1)
      integer :: first, i, j, nx

      nx = ubound(field, 1)
      first = -floor(shift) - points/2                ! the first of the nodes between which it was, from that it is at
      weight = lagrange_weights(points, -shift - first)
      last_weight = lagrange_weights(points, -shift - first + 1)   ! weights of slow surfaces at the last node
      row(:-1) = 0
      do j = 0, ubound(field, 2)
         row(0:) = field(:, j)
         do i = 0, nx
            if (i + first + points - 1 > nx) then
               field(i, j) = dot_product(last_weight, row(i + first - 1:i + first + points - 2))
            else
               field(i, j) = dot_product(weight, row(i + first:i + first + points - 1))
            end if
         end do
      end do
   end subroutine move

end module ehlwave_wall_history
