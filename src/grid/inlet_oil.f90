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
      procedure :: mean_share
      procedure :: narrowest_lane
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

   !> Oil offered to each row of a grid: the mean of the profile over the cell about the row, so that no oil is lost.
   pure function supply_on(self, grid, flooded_oil) result(supply)
      class(inlet_oil_t), intent(in) :: self
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: flooded_oil     !! rho H of the flooded contact's centre
      real(dp) :: supply(0:grid%ny)
      integer :: j

      supply = self%layer
      if (self%over_flooded > 0) supply = self%over_flooded*flooded_oil
      do j = 0, grid%ny
         supply(j) = supply(j)*self%mean_share(grid%y(j) - 0.5_dp*grid%hy, grid%y(j) + 0.5_dp*grid%hy)
      end do
   end function supply_on

   !> Share of the layer in the profile at Y: 1 without profile.
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

   !> Exact mean of the profile between two Y: 1 without profile.
   pure real(dp) function mean_share(self, from, to) result(share)
      class(inlet_oil_t), intent(in) :: self
      real(dp), intent(in) :: from, to       !! Y; equal: the value there
      if (.not. allocated(self%y)) then
         share = 1
      else if (.not. to > from) then
         share = self%share_at(from)
      else if (self%is_even() .and. from < 0) then
         share = (oil_between(self, max(0.0_dp, -to), -from) + oil_between(self, 0.0_dp, max(0.0_dp, to)))/(to - from)
      else
         share = oil_between(self, from, to)/(to - from)
      end if
   end function mean_share

   !> Integral of the profile over an interval on which no mirror image is needed, by the trapezia between its places.
   pure real(dp) function oil_between(self, from, to) result(oil)
      type(inlet_oil_t), intent(in) :: self
      real(dp), intent(in) :: from, to
      real(dp) :: first, last
      integer :: k, n

      n = size(self%y)
      oil = self%share(1)*max(0.0_dp, min(to, self%y(1)) - from) + self%share(n)*max(0.0_dp, to - max(from, self%y(n)))
      do k = 1, n - 1
         first = max(from, self%y(k))
         last = min(to, self%y(k + 1))
         if (last > first) oil = oil + 0.5_dp*(last - first)*(inside(first) + inside(last))
      end do

   contains

      pure real(dp) function inside(y)
         real(dp), intent(in) :: y
         associate (place => (y - self%y(k))/(self%y(k + 1) - self%y(k)))
            inside = (1 - place)*self%share(k) + place*self%share(k + 1)
         end associate
      end function inside

   end function oil_between

   !> Width at half height of the narrowest ridge or dry lane of the profile within |Y| < y_max; `huge` where there is
   !> none. `least` is the smallest height over the largest share that counts.
   pure real(dp) function narrowest_lane(self, y_max, least) result(width)
      class(inlet_oil_t), intent(in) :: self
      real(dp), intent(in) :: y_max, least
      real(dp), allocatable :: share(:), y(:)
      real(dp) :: half, sides(2)
      integer :: feet(2), k, m, n

      width = huge(1.0_dp)
      if (.not. allocated(self%y)) return
      y = self%y
      share = self%share
      if (self%is_even()) then
         y = [-self%y(size(self%y):1:-1), self%y]
         share = [self%share(size(self%y):1:-1), self%share]
      end if
      n = size(y)
      do k = 2, n - 1
         m = k - 1 + run_of(share(k:), 0)          ! the last of equal shares
         if (m == n .or. .not. abs(share(k) - share(k - 1)) > 0) cycle
         if ((share(k) - share(k - 1))*(share(m) - share(m + 1)) <= 0) cycle
         if (y(k) > y_max .or. y(m) < -y_max) cycle
         feet = [k + 1 - run_of(share(k:1:-1), sign_of(share(k - 1) - share(k))), &
                 m - 1 + run_of(share(m:), sign_of(share(m + 1) - share(m)))]
         half = 0.5_dp*minval(abs(share(feet) - share(k)))
         if (2*half < least*maxval(share)) cycle
         half = share(k) + sign(half, share(k - 1) - share(k))
         sides = [place_of(half, feet(1), k), place_of(half, m, feet(2))]
         width = min(width, sides(2) - sides(1))
      end do

   contains

      !> Y between two places at which the profile, monotone there, has a share: the place nearest to the lane.
      pure real(dp) function place_of(level, first, last) result(at)
         real(dp), intent(in) :: level
         integer, intent(in) :: first, last
         integer :: i
         at = y(first)
         do i = first, last - 1
            if ((share(i) - level)*(share(i + 1) - level) > 0 .or. .not. abs(share(i + 1) - share(i)) > 0) cycle
            at = y(i) + (y(i + 1) - y(i))*(level - share(i))/(share(i + 1) - share(i))
         end do
      end function place_of

   end function narrowest_lane

   pure integer function sign_of(value)
      real(dp), intent(in) :: value
      sign_of = nint(sign(1.0_dp, value))
   end function sign_of

   !> Number of first values that stay equal (direction 0) or never turn back (1: rising, -1: falling).
   pure integer function run_of(values, direction) result(length)
      real(dp), intent(in) :: values(:)
      integer, intent(in) :: direction
      do length = 1, size(values) - 1
         associate (change => values(length + 1) - values(length))
            if (direction == 0 .and. abs(change) > 0) return
            if (direction /= 0 .and. change*direction < 0) return
         end associate
      end do
   end function run_of

end module ehlwave_inlet_oil
