!> Temperatures of the oil as the flow takes them: held while pressure and film are solved for.
module ehlwave_film_heat
   use ehlwave_film_flow, only: film_flow_t
   use ehlwave_film_rules, only: across_film_t
   use ehlwave_kinds, only: dp
   use ehlwave_rheology, only: rheology_t
   implicit none (type, external)
   private

   !> The density of a place is that at the mean temperature across the film, the viscosity at each level that at its
   !> own: `ln_fluidity` over that at the mean.
   type, public :: film_heat_t
      real(dp), allocatable :: rise(:, :, :)          !! T - T0, K, (0:levels, 0:nx, 0:ny)
      real(dp), allocatable :: mean_rise(:, :)        !! its mean across the film, (0:nx, 0:ny)
      real(dp), allocatable :: ln_fluidity(:, :, :)   !! (0:levels, 0:nx, 0:ny)
      real(dp), allocatable :: thinning(:, :, :)      !! its derivative, -d ln(eta)/dT, 1/K
      real(dp), allocatable :: range(:, :)            !! range of `ln_fluidity` across the film, (0:nx, 0:ny)
      real(dp), allocatable :: moments(:, :, :)       !! (0:2, 0:nx, 0:ny) moments of `film_flow_t`, if available
   contains
      procedure :: weigh
      procedure :: take_row
      procedure :: take_ends
      procedure :: part
   end type film_heat_t

   public :: new_film_heat

contains

   !> T0 everywhere.
   pure function new_film_heat(levels, nx, ny, film) result(self)
      integer, intent(in) :: levels, nx, ny
      type(film_flow_t), intent(in) :: film
      type(film_heat_t) :: self
      allocate (self%rise(0:levels, 0:nx, 0:ny), source=0.0_dp)
      allocate (self%ln_fluidity, self%thinning, source=self%rise)
      allocate (self%mean_rise(0:nx, 0:ny), source=0.0_dp)
      allocate (self%range, source=self%mean_rise)
      if (.not. film%has_moments()) return
      allocate (self%moments(0:2, 0:nx, 0:ny), source=0.0_dp)
      self%moments(0, :, :) = 1
      self%moments(2, :, :) = 1/3.0_dp
   end function new_film_heat

   !> Take means and fluidities of the rises at pressure p. Beyond the last given node of a row, the rises of that
   !> node apply; where there is no pressure, all other values do.
   pure subroutine weigh(self, rheology, film, weight, p, until)
      class(film_heat_t), intent(inout) :: self
      type(rheology_t), intent(in) :: rheology
      type(film_flow_t), intent(in) :: film
      real(dp), intent(in) :: weight(0:)     !! weights of an integral across the film, (0:levels)
      real(dp), intent(in) :: p(0:, 0:)      !! P, (0:nx, 0:ny)
      integer, intent(in) :: until(0:)       !! (0:ny)
      integer :: i, j, last

      do j = 0, ubound(p, 2)
         last = until(j)
         if (any(p(last + 1:, j) > 0)) last = ubound(p, 1)
         call weigh_row(self, rheology, film, weight, p(:last, j), last, j)
         do i = last + 1, ubound(p, 1)
            self%mean_rise(i, j) = self%mean_rise(last, j)
            self%range(i, j) = self%range(last, j)
            self%ln_fluidity(:, i, j) = self%ln_fluidity(:, last, j)
            self%thinning(:, i, j) = self%thinning(:, last, j)
            if (allocated(self%moments)) self%moments(:, i, j) = self%moments(:, last, j)
         end do
      end do
   end subroutine weigh

   !> Moments of a row, up to a node.
   pure subroutine weigh_row(self, rheology, film, weight, p, last, j)
      class(film_heat_t), intent(inout) :: self
      type(rheology_t), intent(in) :: rheology
      type(film_flow_t), intent(in) :: film
      real(dp), intent(in) :: weight(0:)     !! (0:levels)
      integer, intent(in) :: last, j
      real(dp), intent(in) :: p(0:last)
      real(dp), dimension(0:last) :: at, largest, least                      ! values at the nodes of the row
      real(dp), dimension(0:last, 0:size(weight)) :: exponent, rise, slope   ! at the levels and at the mean
      logical :: is_warm(0:last)
      integer :: i, k, n

      n = ubound(weight, 1)
      at = max(p, 0.0_dp)
      is_warm = .false.
      rise(:, n + 1) = 0
      do k = 0, n
         do i = 0, last
            rise(i, k) = self%rise(k, i, j)
            rise(i, n + 1) = rise(i, n + 1) + weight(k)*rise(i, k)
            is_warm(i) = is_warm(i) .or. abs(rise(i, k)) > 0
         end do
      end do
      self%mean_rise(:last, j) = rise(:, n + 1)
      call rheology%ln_viscosity(last + 1, n + 2, at, rise, exponent, slope)
      largest = -huge(largest)
      least = huge(least)
      do k = 0, n
         do i = 0, last
            ! larger than rounding of an even viscosity
            exponent(i, k) = merge(exponent(i, n + 1) - exponent(i, k), 0.0_dp, is_warm(i) .and. abs(slope(i, k)) > 0)
            largest(i) = max(largest(i), exponent(i, k))
            least(i) = min(least(i), exponent(i, k))
         end do
      end do
      do i = 0, last
         self%range(i, j) = largest(i) - least(i)
         do k = 0, n
            self%ln_fluidity(k, i, j) = exponent(i, k)
            self%thinning(k, i, j) = -slope(i, k)
         end do
      end do
      if (allocated(self%moments)) call film%rules%moments_of(self%ln_fluidity(:, :last, j), self%range(:last, j), &
                                                        self%moments(:, :last, j))
   end subroutine weigh_row

   !> Differences across the film at the nodes of a row.
   pure subroutine take_row(self, across, j)
      class(film_heat_t), intent(in) :: self
      type(across_film_t), intent(inout) :: across
      integer, intent(in) :: j
      if (allocated(self%moments)) then
         across%moments = self%moments(:, :, j)
      else
         across%ln_fluidity = self%ln_fluidity(:, :, j)
         across%range = self%range(:, j)
      end if
   end subroutine take_row

   !> Take both ends of faces: a row, then the row beyond.
   pure subroutine take_ends(self, across, i, shift, rows)
      class(film_heat_t), intent(in) :: self
      type(across_film_t), intent(inout) :: across
      integer, intent(in) :: i(:), shift           !! i of the first ends; offset to the second ends
      integer, intent(in) :: rows(2)
      integer :: k, n

      n = size(i)
      if (allocated(self%moments)) then
         allocate (across%moments(0:2, 2*n))
         do k = 1, n
            across%moments(:, k) = self%moments(:, i(k), rows(1))
            across%moments(:, n + k) = self%moments(:, i(k) + shift, rows(2))
         end do
      else
         allocate (across%ln_fluidity(size(self%rise, 1), 2*n), across%range(2*n))
         do k = 1, n
            across%ln_fluidity(:, k) = self%ln_fluidity(:, i(k), rows(1))
            across%ln_fluidity(:, n + k) = self%ln_fluidity(:, i(k) + shift, rows(2))
            across%range(k) = self%range(i(k), rows(1))
            across%range(n + k) = self%range(i(k) + shift, rows(2))
         end do
      end if
   end subroutine take_ends

   !> Part for some of the nodes.
   pure function part(self, first, last)
      class(film_heat_t), intent(in) :: self
      integer, intent(in) :: first(2), last(2)   !! i and j
      type(film_heat_t) :: part
      associate (nx => last(1) - first(1), ny => last(2) - first(2), n => ubound(self%rise, 1))
         allocate (part%rise(0:n, 0:nx, 0:ny), part%ln_fluidity(0:n, 0:nx, 0:ny), part%mean_rise(0:nx, 0:ny))
         allocate (part%range(0:nx, 0:ny))
         if (allocated(self%moments)) allocate (part%moments(0:2, 0:nx, 0:ny))
      end associate
      part%rise = self%rise(:, first(1):last(1), first(2):last(2))
      part%mean_rise = self%mean_rise(first(1):last(1), first(2):last(2))
      part%ln_fluidity = self%ln_fluidity(:, first(1):last(1), first(2):last(2))
      part%range(:, :) = self%range(first(1):last(1), first(2):last(2))
      if (allocated(self%moments)) part%moments(:, :, :) = self%moments(:, first(1):last(1), first(2):last(2))
   end function part

end module ehlwave_film_heat
