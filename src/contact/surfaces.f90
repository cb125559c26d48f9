!> The rough surfaces of a contact, and the sum of their heights in the gap.
module ehlwave_surfaces
   use ehlwave_kinds, only: dp
   use ehlwave_waviness, only: no_waviness, waviness_t
   implicit none (type, external)
   private
   public :: new_surfaces

   !> The gap is the sum over the list. Results are about the surface at `main`.
   type, public :: surfaces_t
      type(waviness_t), allocatable :: list(:)
      integer :: main = 1
   contains
      procedure :: is_rough
      procedure :: is_measured
      procedure :: is_symmetric
      procedure :: moves
      procedure :: frequency
      procedure :: period
      procedure :: passing_time
      procedure :: rough_at
      procedure :: rough_of_waves
      procedure :: rough_fixed
   end type surfaces_t

contains

   !> One surface; without it a smooth one.
   pure function new_surfaces(waviness) result(self)
      type(waviness_t), intent(in), optional :: waviness
      type(surfaces_t) :: self
      if (present(waviness)) then
         self%list = [waviness]
      else
         self%list = [no_waviness()]
      end if
   end function new_surfaces

   !> Whether there is any roughness.
   pure logical function is_rough(self)
      class(surfaces_t), intent(in) :: self
      is_rough = any(self%list%is_present)
   end function is_rough

   !> Whether results are about a measured surface, not about waves.
   pure logical function is_measured(self)
      class(surfaces_t), intent(in) :: self
      is_measured = allocated(self%list(self%main)%surface)
   end function is_measured

   !> Whether the gap is even in Y.
   pure logical function is_symmetric(self)
      class(surfaces_t), intent(in) :: self
      integer :: n
      is_symmetric = all([(self%list(n)%is_symmetric(), n=1, size(self%list))])
   end function is_symmetric

   !> Whether the gap changes in time.
   pure logical function moves(self)
      class(surfaces_t), intent(in) :: self
      integer :: n
      moves = any([(self%list(n)%moves(), n=1, size(self%list))])
   end function moves

   !> Angular frequency of the waves that results are about, in units of 1/T; 0 where they do not move, and of a list
   !> not yet made.
   elemental real(dp) function frequency(self)
      class(surfaces_t), intent(in) :: self
      frequency = 0
      if (allocated(self%list)) frequency = self%list(self%main)%frequency()
   end function frequency

   !> Time after which the waves that results are about repeat, in T.
   pure real(dp) function period(self)
      class(surfaces_t), intent(in) :: self
      period = self%list(self%main)%period()
   end function period

   !> T until the slowest of the patterns, and what it launched into the oil (speed 1), have passed X = outlet.
   pure real(dp) function passing_time(self, outlet)
      class(surfaces_t), intent(in) :: self
      real(dp), intent(in) :: outlet
      integer :: n
      passing_time = 0
      do n = 1, size(self%list)
         associate (surface => self%list(n))
            if (surface%moves()) passing_time = max(passing_time, (outlet - surface%start)/min(1.0_dp, surface%slip))
         end associate
      end do
   end function passing_time

   !> Roughness in the gap at time T, behind the fronts of the surfaces, in units of c.
   pure function rough_at(self, x, y, t, film) result(rough)
      class(surfaces_t), intent(in) :: self
      real(dp), intent(in) :: x(:), y(:)           !! node coordinates X, Y
      real(dp), intent(in) :: t                    !! T
      real(dp), intent(in) :: film                 !! smooth H(0,0)
      real(dp) :: rough(size(x), size(y))
      integer :: n
      rough = 0
      do n = 1, size(self%list)
         rough = rough + self%list(n)%amplitude(film)*self%list(n)%shape_at(x, y, t)
      end do
   end function rough_at

   !> The same of waves that are everywhere and have crests at X = 0 at T = 0.
   pure function rough_of_waves(self, x, y, t, film) result(rough)
      class(surfaces_t), intent(in) :: self
      real(dp), intent(in) :: x(:), y(:), t, film
      real(dp) :: rough(size(x), size(y))
      integer :: n
      rough = 0
      do n = 1, size(self%list)
         associate (waves => self%list(n))
            rough = rough + waves%amplitude(film)*waves%shape_fixed(x, y, -waves%frequency()*t)
         end associate
      end do
   end function rough_of_waves

   !> The same of patterns that stand still, the one that results are about with a phase.
   pure function rough_fixed(self, x, y, phase, film) result(rough)
      class(surfaces_t), intent(in) :: self
      real(dp), intent(in) :: x(:), y(:)
      real(dp), intent(in) :: phase                !! radian
      real(dp), intent(in) :: film
      real(dp) :: rough(size(x), size(y))
      integer :: n
      rough = 0
      do n = 1, size(self%list)
         rough = rough + self%list(n)%amplitude(film)*self%list(n)%shape_fixed(x, y, &
            merge(phase, 0.0_dp, n == self%main))
      end do
   end function rough_fixed

end module ehlwave_surfaces
