!> Levels across the film at which temperatures are known: evenly spaced, the first and the last on the surfaces.
module ehlwave_film_levels
   use ehlwave_kinds, only: dp
   use ehlwave_lagrange, only: lagrange_weights
   implicit none (type, external)
   private
   public :: add_source, integrate_levels, new_film_levels

   integer, parameter, public :: most_levels = 128   !! intervals
   integer, parameter :: points = 4           ! points of the cubics between levels

   type, public :: film_levels_t
      integer :: n = 0                        !! intervals across the film, at least 4
      real(dp) :: d = 0                       !! 1/n
      real(dp), allocatable :: zeta(:)        !! (0:n) place across: 0 at surface 2, 1 at surface 1
      real(dp), allocatable :: weight(:)      !! (0:n) of an integral across, exact for cubics
      real(dp), allocatable :: heat_weight(:) !! weights of a source in the layers of theory eq. (D9)
   contains
      procedure :: running_integral
   end type film_levels_t

   !> Values at some places across the film from those at the levels, by cubics through the nearest.
   type, public :: level_weights_t
      integer, allocatable :: first(:)        !! (places) the first level
      real(dp), allocatable :: weight(:, :)   !! (points, places) of that level and the next
   end type level_weights_t

   public :: new_level_weights

contains

   pure function new_film_levels(n) result(self)
      integer, intent(in) :: n
      type(film_levels_t) :: self
      real(dp), dimension(0:n) :: integral, unit
      integer :: k

      self%n = n
      self%d = 1.0_dp/n
      allocate (self%zeta(0:n), self%weight(0:n), self%heat_weight(0:n))
      self%zeta = [(k*self%d, k=0, n)]
      do k = 0, n
         unit = 0
         unit(k) = 1
         integral = self%running_integral(unit)
         self%weight(k) = integral(n)
         integral = 0
         call add_source(self, unit, integral)
         self%heat_weight(k) = sum(integral)
      end do
   end function new_film_levels

   !> Add a source to the layers about the levels with weights 1, 10, 1 inside, half a layer at the surfaces.
   pure subroutine add_source(levels, source, layer)
      class(film_levels_t), intent(in) :: levels
      real(dp), intent(in), contiguous :: source(0:)      !! (0:n)
      real(dp), intent(inout), contiguous :: layer(0:)
      integer :: k
      associate (n => levels%n, d => levels%d, s => source)
         do k = 1, n - 1
            layer(k) = layer(k) + d/12*(s(k - 1) + 10*s(k) + s(k + 1))
         end do
         layer(0) = layer(0) + d/24*(7*s(0) + 6*s(1) - s(2))
         layer(n) = layer(n) + d/24*(7*s(n) + 6*s(n - 1) - s(n - 2))
      end associate
   end subroutine add_source

   !> Integral of a field from surface 2 to each level, exact for cubics.
   pure function running_integral(self, field) result(integral)
      class(film_levels_t), intent(in) :: self
      real(dp), intent(in) :: field(0:)       !! (0:n)
      real(dp) :: integral(0:self%n)
      call integrate_levels(self%n, field, integral)
   end function running_integral

   !> Integrals between so many intervals.
   pure subroutine integrate_levels(n, field, integral)
      integer, intent(in) :: n
      real(dp), intent(in) :: field(0:n)
      real(dp), intent(out) :: integral(0:n)
      real(dp) :: share
      integer :: k

      share = 1.0_dp/(24*n)
      associate (f => field)
         integral(0) = 0
         integral(1) = share*(9*f(0) + 19*f(1) - 5*f(2) + f(3))
         do k = 2, n - 1
            integral(k) = share*(13*(f(k - 1) + f(k)) - f(k - 2) - f(k + 1))
         end do
         integral(n) = share*(9*f(n) + 19*f(n - 1) - 5*f(n - 2) + f(n - 3))
         do k = 2, n
            integral(k) = integral(k - 1) + integral(k)
         end do
      end associate
   end subroutine integrate_levels

   pure function new_level_weights(n, place) result(self)
      integer, intent(in) :: n                !! intervals between levels
      real(dp), intent(in) :: place(:)        !! -1 at surface 2, 1 at surface 1
      type(level_weights_t) :: self
      real(dp) :: position
      integer :: i

      allocate (self%first(size(place)), self%weight(points, size(place)))
      do i = 1, size(place)
         position = 0.5_dp*(1 + place(i))*n
         self%first(i) = min(max(floor(position) - 1, 0), n - points + 1)
         self%weight(:, i) = lagrange_weights(points, position - self%first(i))
      end do
   end function new_level_weights

end module ehlwave_film_levels
