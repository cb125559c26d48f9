!> The rough surfaces of a contact, and the sum of their heights in the gap.
module ehlwave_surfaces
   use ehlwave_kinds, only: dp
   use ehlwave_waviness, only: waviness_t
   implicit none (type, external)
   private

   !> The gap is the sum over the list. Results are about the surface at `main`.
   type, public :: surfaces_t
      type(waviness_t), allocatable :: list(:)
      integer :: main = 1
   contains
      procedure :: is_rough
      procedure :: is_measured
      procedure :: share_in_film
      procedure :: is_symmetric
      procedure :: moves
      procedure :: frequency
      procedure :: largest_slip
      procedure :: shortest_period
      procedure :: longest_period
      procedure :: repeat_period
      procedure :: repeat_soon
      procedure :: window
      procedure :: are_apart
      procedure :: periods
      procedure :: are_one
      procedure :: smallest_amplitude
      procedure :: passing_time
      procedure :: rough_behind_fronts
      procedure :: rough_of_waves
      procedure :: rough_fixed
   end type surfaces_t

   integer, parameter :: largest_whole = 12            !! periods of one surface after which two may repeat together
   real(dp), parameter :: whole = 1e-6_dp              !! tolerance of whole ratios of periods
   real(dp), parameter :: fewest_beats = 0.5_dp        !! beats in which a fit resolves two frequencies

contains

   !> Whether there is any roughness.
   pure logical function is_rough(self)
      class(surfaces_t), intent(in) :: self
      is_rough = any(self%list%is_present)
   end function is_rough

   !> Whether a surface was measured: results are not about waves then.
   pure logical function is_measured(self)
      class(surfaces_t), intent(in) :: self
      integer :: n
      is_measured = any([(allocated(self%list(n)%surface), n=1, size(self%list))])
   end function is_measured

   !> Relative error of results over the relative error of deformed waves: 1 of results about waves; of measured
   !> heights, whose results are films, their amplitude over the film.
   pure real(dp) function share_in_film(self, film) result(share)
      class(surfaces_t), intent(in) :: self
      real(dp), intent(in) :: film                         !! smooth H(0,0)
      integer :: n
      share = 1
      if (.not. self%is_measured()) return
      share = min(1.0_dp, sum([(self%list(n)%equivalent_amplitude(film), n=1, size(self%list))]))
   end function share_in_film

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

   !> Largest speed of a surface or of the oil, over the mean speed.
   pure real(dp) function largest_slip(self)
      class(surfaces_t), intent(in) :: self
      largest_slip = max(1.0_dp, maxval(self%list%slip))
   end function largest_slip

   !> Angular frequency of the waves that results are about, in units of 1/T; 0 where they do not move, and of a list
   !> not yet made.
   elemental real(dp) function frequency(self)
      class(surfaces_t), intent(in) :: self
      frequency = 0
      if (allocated(self%list)) frequency = self%list(self%main)%frequency()
   end function frequency

   !> Shortest and longest time in which the waves of a surface pass, in T; of surfaces that move.
   pure real(dp) function shortest_period(self)
      class(surfaces_t), intent(in) :: self
      integer :: n
      shortest_period = huge(1.0_dp)
      do n = 1, size(self%list)
         if (self%list(n)%moves()) shortest_period = min(shortest_period, self%list(n)%period())
      end do
   end function shortest_period

   pure real(dp) function longest_period(self)
      class(surfaces_t), intent(in) :: self
      integer :: n
      longest_period = 0
      do n = 1, size(self%list)
         if (self%list(n)%moves()) longest_period = max(longest_period, self%list(n)%period())
      end do
   end function longest_period

   !> Time after which all waves repeat, in T: the period of a single moving surface, or the least common multiple of
   !> two. 0 where the periods have no ratio of small whole numbers.
   pure real(dp) function repeat_period(self)
      class(surfaces_t), intent(in) :: self
      real(dp) :: ratio
      integer :: n

      repeat_period = self%list(1)%period()
      if (size(self%list) == 1) return
      do n = 1, largest_whole
         ratio = n*self%list(1)%period()/self%list(2)%period()
         if (nint(ratio) < 1 .or. nint(ratio) > largest_whole .or. abs(ratio - nint(ratio)) > whole*ratio) cycle
         repeat_period = n*self%list(1)%period()
         return
      end do
      repeat_period = 0
   end function repeat_period

   !> Whether all waves move and repeat within a few of the shortest periods.
   pure logical function repeat_soon(self)
      class(surfaces_t), intent(in) :: self
      integer, parameter :: few = 3
      repeat_soon = allocated(self%list)
      if (repeat_soon) repeat_soon = self%moves() .and. .not. self%is_measured()
      if (.not. repeat_soon) return
      associate (period => self%repeat_period())
         repeat_soon = period > 0 .and. period <= few*self%shortest_period()
      end associate
   end function repeat_soon

   !> Time over which waves are measured, in T: until they repeat, or for a beat of two that do not.
   pure real(dp) function window(self)
      class(surfaces_t), intent(in) :: self
      real(dp) :: beats

      window = self%repeat_period()
      if (window > 0) return
      beats = abs(1/self%list(1)%period() - 1/self%list(2)%period())
      window = self%longest_period()*min(real(largest_whole, dp), max(1.0_dp, 1/(beats*self%longest_period())))
   end function window

   !> Whether the film at a point resolves the waves of both surfaces: their frequencies differ.
   pure logical function are_apart(self)
      class(surfaces_t), intent(in) :: self
      are_apart = .true.
      if (size(self%list) > 1) are_apart = &
         abs(1/self%list(1)%period() - 1/self%list(2)%period())*self%window() > fewest_beats
   end function are_apart

   !> Periods, in T, that the film at a point resolves.
   pure function periods(self) result(found)
      class(surfaces_t), intent(in) :: self
      real(dp), allocatable :: found(:)
      integer :: n
      found = [(self%list(n)%period(), n=1, merge(size(self%list), 1, self%are_apart()))]
   end function periods

   !> Whether all surfaces have the same waves and speed: the gap then has a single wave with the sum of their
   !> amplitudes.
   pure logical function are_one(self)
      class(surfaces_t), intent(in) :: self
      associate (first => self%list(1), last => self%list(size(self%list)))
         are_one = first%is_oblique .eqv. last%is_oblique
         are_one = are_one .and. maxval(abs([first%wavelength_x - last%wavelength_x, &
            first%wavelength_y - last%wavelength_y, first%slip - last%slip])) <= 0
      end associate
   end function are_one

   !> The smallest amplitude of a pattern, in units of c; of waves.
   pure real(dp) function smallest_amplitude(self, film)
      class(surfaces_t), intent(in) :: self
      real(dp), intent(in) :: film                 !! smooth H(0,0)
      integer :: n
      smallest_amplitude = minval([(self%list(n)%amplitude(film), n=1, size(self%list))])
   end function smallest_amplitude

   !> Time T until the slowest pattern and its waves in the oil (speed 1) have passed X = outlet.
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
   pure function rough_behind_fronts(self, x, y, t, film) result(rough)
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
   end function rough_behind_fronts

   !> Height of waves everywhere in the domain, with crests at X = 0 at T = 0.
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

   !> Height of stationary patterns; the phase applies to the main pattern.
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
