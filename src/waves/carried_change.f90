!> Changes of a film from period to period that the oil carries on to the centre.
module ehlwave_carried_change
   use ehlwave_equations, only: equations_t
   use ehlwave_grid, only: grid_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp, pi
   use ehlwave_lagrange, only: lagrange_weights
   use ehlwave_march_settings, only: march_settings_t
   implicit none (type, external)
   private
   public :: carried_share

   !> Films of the last steps at Y = 0, and the difference of the last from the film a period before.
   !>
   !> In the high-pressure zone the oil carries the difference of a film from the periodic film unchanged: a change at X
   !> is at the centre after the time -X. So the final film at the centre is known before the oil arrives.
   type, public :: carried_change_t
      type(grid_t), private :: grid
      real(dp), allocatable, private :: films(:, :)   ! (0:nx, 0:n - 1), of step m at m modulo n
      real(dp), allocatable, private :: change(:)     ! (0:nx)
      real(dp), allocatable, private :: weight(:)     ! (0:nx), its share in the correction
      real(dp), private :: lag = 0                    ! period, steps
      real(dp), private :: cells_per_step = 1
      real(dp), private :: first = 0                  ! X from which on films are carried to the centre
      integer, private :: row = 0                     ! Y = 0
   contains
      procedure :: begin
      procedure :: see
      procedure :: is_known
      procedure :: largest
      procedure :: correct
   end type carried_change_t

   integer, parameter, public :: points = 6  !! points of interpolation in time; four leave 1e-3 of A where a period
                                                       !! has ten steps
   real(dp), parameter :: farthest_upstream = -1       !! X, from where the film has to repeat
   real(dp), parameter :: most_lost = 0.4_dp  !! loss of the carried change, on the way to the centre, by `spread`
   real(dp), parameter :: least_lost = 0.1_dp          !! or gained, by all else
   real(dp), parameter :: spread = 6e-4_dp  !! decay of a wave by Poiseuille flow, on a way of length 1/k: this
                                                       !! times (1/share - 1) (k hX)^2; M = 100, lambda = 0.5 a:
                                                       !! changes at X = -0.8 differ by 0.07 at the centre
   real(dp), parameter :: whole = 1e-6_dp              !! share of a step

   real(dp), parameter :: spread_weight = 1000   !! measured: fewest Newton steps between 100 and 10^4

contains

   !> How much of a pressure disturbance is carried along with the film rather than spread by Poiseuille flow,
   !> 0 to 1 at each node: 1/(1 + weight eps/(hX K0)), K0 the deformation under a cell of unit pressure.
   function carried_share(level) result(share)
      type(level_t), intent(in) :: level    !! at its steady state
      real(dp), allocatable :: share(:, :)
      type(equations_t) :: equations

      call equations%init(level%problem)
      call equations%evaluate(level%problem, level%given, level%state)
      share = 1/(1 + spread_weight*equations%flow%mobility()/(level%problem%grid%hx*equations%self_influence))
   end function carried_share

   !> Begin with the film that a march starts in.
   subroutine begin(self, grid, settings, share, film)
      class(carried_change_t), intent(out) :: self
      type(grid_t), intent(in) :: grid
      type(march_settings_t), intent(in) :: settings
      real(dp), intent(in) :: share(0:, 0:)     !! films that the oil carries, (0:nx, 0:ny)
      real(dp), intent(in) :: film(0:, 0:)
      real(dp) :: loss, wave_number
      integer :: i

      self%grid = grid
      self%lag = settings%repeat_time(grid)/settings%time_step(grid)
      self%cells_per_step = settings%time_step(grid)/grid%hx
      self%row = minloc(abs(grid%y), 1) - 1
      allocate (self%films(0:grid%nx, 0:ceiling(self%lag) + 3), self%change(0:grid%nx), source=0.0_dp)
      allocate (self%weight(0:grid%nx), source=0.0_dp)
      self%films(:, 0) = film(:, self%row)
      self%first = 0
      loss = 0
      associate (lengths => settings%surfaces%list%wavelength_x)
         wave_number = 2*pi/minval(lengths, mask=lengths > 0)
      end associate
      do i = count(grid%x <= 0) - 1, 0, -1
         if (grid%x(i) < farthest_upstream) exit
         loss = loss + spread*(1/share(i, self%row) - 1)*(wave_number*grid%hx)**3
         if (loss > most_lost) exit
         self%first = grid%x(i)
         self%weight(i) = least_lost + loss
      end do
      where (grid%x >= farthest_upstream .and. grid%x <= self%first) self%weight = 1
   end subroutine begin

   !> Take the film of step k.
   subroutine see(self, k, film)
      class(carried_change_t), intent(inout) :: self
      integer, intent(in) :: k
      real(dp), intent(in) :: film(0:, 0:)
      real(dp) :: weights(0:points - 1)
      integer :: base, m

      self%films(:, modulo(k, size(self%films, 2))) = film(:, self%row)
      if (.not. self%is_known(k)) return
      base = max(k - ceiling(self%lag) - 2, 0)
      weights = lagrange_weights(points, k - self%lag - base)
      self%change = film(:, self%row)
      do m = 0, points - 1
         self%change = self%change - weights(m)*self%films(:, modulo(base + m, size(self%films, 2)))
      end do
   end subroutine see

   !> Whether the film a period before step k is known.
   pure logical function is_known(self, k)
      class(carried_change_t), intent(in) :: self
      integer, intent(in) :: k
      real(dp) :: later
      later = merge(0.0_dp, 2.0_dp, abs(self%lag - nint(self%lag)) < whole)   ! points of an interpolation between steps
      is_known = k >= max(self%lag - whole + later, real(points, dp))
   end function is_known

   !> Largest change from X = -1 to the centre. The share corrected by `correct` counts by its loss on the way.
   pure real(dp) function largest(self, corrects)
      class(carried_change_t), intent(in) :: self
      logical, intent(in) :: corrects
      if (corrects) then
         largest = maxval(self%weight*abs(self%change))
      else
         largest = maxval(abs(self%change), mask=self%weight > 0)
      end if
   end function largest

   !> Add to films at the centre, over the last period and the steps interpolated with it, the changes that are on
   !> their way. All changes are at a whole number of periods upstream. A period below a time step has no such places.
   pure subroutine correct(self, films)
      class(carried_change_t), intent(in) :: self
      real(dp), intent(inout) :: films(0:)       !! (0:k), the last step seen
      real(dp) :: place, x
      integer :: i, k

      if (self%lag < 1) return
      do k = max(0, ubound(films, 1) - floor(self%lag) - points), ubound(films, 1)
         x = -(k - ubound(films, 1) + self%lag)*self%cells_per_step*self%grid%hx
         do while (x >= self%first)
            place = (x - self%grid%x(0))/self%grid%hx
            i = min(floor(place), self%grid%nx - 1)
            films(k) = films(k) + self%change(i) + (place - i)*(self%change(i + 1) - self%change(i))
            x = x - self%lag*self%cells_per_step*self%grid%hx
         end do
      end do
   end subroutine correct

end module ehlwave_carried_change
