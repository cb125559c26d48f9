!> The oil offered to a contact at its inlet: a layer, the same across or with a profile.
module ehlwave_inlet_oil
   use ehlwave_grid, only: grid_t
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   !> Layers of both surfaces together, at ambient pressure.
   type, public :: inlet_oil_t
      real(dp) :: over_flooded = 0                      !! r: layer over rho H of the flooded contact's centre; 0: not
                                                        !! given
      real(dp) :: layer = 0                             !! in units of c, where r is not given
      real(dp), allocatable :: y(:), share(:)           !! profile across: Y and layer there over that
   contains
      procedure :: is_short
      procedure :: is_even
      procedure :: supply_on
      procedure :: share_at
   end type inlet_oil_t

contains

   !> Whether an amount is given: else the contact is flooded.
   pure logical function is_short(self)
      class(inlet_oil_t), intent(in) :: self
      is_short = self%over_flooded > 0 .or. self%layer > 0
   end function is_short

   !> Whether it is even in Y: without a profile, or where its places begin at Y = 0 and it goes on as its mirror image.
   pure logical function is_even(self)
      class(inlet_oil_t), intent(in) :: self
      is_even = .true.
      if (allocated(self%y)) is_even = self%y(1) >= 0
   end function is_even

   !> Oil offered to each row of a grid, linear between the places of the profile.
   pure function supply_on(self, grid, flooded_oil) result(supply)
      class(inlet_oil_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: flooded_oil     !! rho H of the flooded contact's centre
      real(dp) :: supply(0:grid%ny)
      integer :: j

      supply = self%layer
      if (self%over_flooded > 0) supply = self%over_flooded*flooded_oil
      do j = 0, grid%ny
         supply(j) = supply(j)*self%share_at(grid%y(j))
      end do
   end function supply_on

   !> Share of the layer that the profile has at Y: 1 without one.
   pure real(dp) function share_at(self, y) result(share)
      class(inlet_oil_t), intent(in) :: self
      real(dp), intent(in) :: y
      real(dp) :: at
      integer :: k, n

      share = 1
      if (.not. allocated(self%y)) return
      at = merge(abs(y), y, self%is_even())
      n = size(self%y)
      k = min(max(count(self%y <= at), 1), n - 1)
      associate (place => min(max((at - self%y(k))/(self%y(k + 1) - self%y(k)), 0.0_dp), 1.0_dp))
         share = (1 - place)*self%share(k) + place*self%share(k + 1)
      end associate
   end function share_at

end module ehlwave_inlet_oil
