!> Temperatures of the oil as the flow takes them: held while pressure and film are solved for.
module ehlwave_film_heat
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
   contains
      procedure :: weigh
      procedure :: part
   end type film_heat_t

contains

   !> Take means and fluidities of the rises at pressure p.
   pure subroutine weigh(self, rheology, weight, p)
      class(film_heat_t), intent(inout) :: self
      type(rheology_t), intent(in) :: rheology
      real(dp), intent(in) :: weight(0:)     !! of an integral across the film, (0:levels)
      real(dp), intent(in) :: p(0:, 0:)      !! P, (0:nx, 0:ny)
      real(dp), dimension(0:size(weight)) :: at, exponent, rise, slope   ! at the levels, and at the mean
      integer :: i, j, n

      n = size(weight) - 1
      do j = 0, ubound(p, 2)
         do i = 0, ubound(p, 1)
            rise(:n) = self%rise(:, i, j)
            rise(n + 1) = dot_product(weight, rise(:n))
            self%mean_rise(i, j) = rise(n + 1)
            if (maxval(abs(rise)) > 0) then
               at = max(p(i, j), 0.0_dp)
               call rheology%ln_viscosity(n + 2, at, rise, exponent, slope)
               self%ln_fluidity(:, i, j) = exponent(n + 1) - exponent(:n)
               if (.not. maxval(abs(slope)) > 0) self%ln_fluidity(:, i, j) = 0   ! not what rounding makes of it
            else
               call rheology%ln_viscosity(1, [max(p(i, j), 0.0_dp)], rise(:0), exponent(:0), slope(:0))
               slope = slope(0)
               self%ln_fluidity(:, i, j) = 0
            end if
            self%thinning(:, i, j) = -slope(:n)
         end do
      end do
   end subroutine weigh

   !> That of some of the nodes.
   pure function part(self, first, last)
      class(film_heat_t), intent(in) :: self
      integer, intent(in) :: first(2), last(2)   !! i and j
      type(film_heat_t) :: part
      associate (nx => last(1) - first(1), ny => last(2) - first(2), n => ubound(self%rise, 1))
         allocate (part%rise(0:n, 0:nx, 0:ny), part%ln_fluidity(0:n, 0:nx, 0:ny), part%mean_rise(0:nx, 0:ny))
      end associate
      part%rise = self%rise(:, first(1):last(1), first(2):last(2))
      part%mean_rise = self%mean_rise(first(1):last(1), first(2):last(2))
      part%ln_fluidity = self%ln_fluidity(:, first(1):last(1), first(2):last(2))
   end function part

end module ehlwave_film_heat
