!> Discretisation error from values of a quantity on grids of mesh size h, 2h and 4h: Richardson, theory eq. (E1).
module ehlwave_error_estimate
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_resolution, only: coarsest_inlet, fewest_points_per_wave, resolution_t, wanted_points_per_wave
   implicit none (type, external)
   private
   public :: estimate_error, formal_order, likely_order, observed_order

   real(dp), parameter :: formal_order = 2     !! order of the discretisation in space and time
   real(dp), parameter :: lowest_order = 1     !! assumed where the values do not converge monotonically
   !> Above it the finer two of three values agree by chance, and the coarser two are more reliable. A line contact of
   !> order 3.7 was off by 8 times the estimate of the finer two; 4 % of random contacts have an order above this.
   real(dp), parameter :: highest_order = 2.5_dp

contains

   !> Estimated relative error of values(1): |v(h) - v(2h)|/((2^p - 1) |v(h)|), theory eq. (E1), and for |v(h) - v(2h)|
   !> at least the share of |v(2h) - v(4h)| that is left of it at `highest_order`.
   !>
   !> p is the observed order of three values if between 1 and 2, the nearer of these two limits where it lies outside
   !> or where the differences change sign (order 1: the careful side), and `usual_order` with two values only. NaN
   !> with fewer than two values or where one of the first two is not finite or the first is 0.
   pure real(dp) function estimate_error(values, usual_order)
      real(dp), intent(in) :: values(:)   !! on meshes h, 2h, 4h, ...: the finest first
      real(dp), intent(in), optional :: usual_order   !! absent: 2
      real(dp) :: difference, order

      estimate_error = no_value
      if (size(values) < 2) return
      if (.not. all(ieee_is_finite(values(:2)))) return
      if (.not. abs(values(1)) > 0) return
      difference = abs(values(1) - values(2))
      order = formal_order
      if (present(usual_order)) order = usual_order
      if (size(values) > 2) then
         if (ieee_is_finite(values(3))) then
            order = lowest_order
            if ((values(1) - values(2))*(values(2) - values(3)) > 0) &
               order = min(max(observed_order(values), lowest_order), formal_order)
            difference = max(difference, abs(values(2) - values(3))/2**highest_order)
         end if
      end if
      estimate_error = difference/((2**order - 1)*abs(values(1)))
   end function estimate_error

   !> Order to expect of the response to waves with two grids, by the resolution of the inlet and of waves: 2 where it
   !> resolves them well, 1 where it barely does (M = 1000, D = 1: 1.1 with hX = 0.25 inlet lengths), and not above
   !> the order of the film where three levels show it.
   pure real(dp) function likely_order(film_order, resolution, steepness, points_above)
      real(dp), intent(in) :: film_order   !! NaN: not known
      type(resolution_t), intent(in) :: resolution
      real(dp), intent(in) :: steepness    !! thinning of the oil, see `thinning_t`: its inlet is shorter by the root of
                                           !! it
      real(dp), intent(in), optional :: points_above   !! on a wave along X, above the fewest, that do; absent: 4
      real(dp), parameter :: fine_inlet = 0.15_dp, usual_points = 4
      real(dp) :: well, enough_along_x

      enough_along_x = usual_points
      if (present(points_above)) enough_along_x = points_above
      well = (coarsest_inlet - sqrt(steepness)*resolution%inlet)/(coarsest_inlet - fine_inlet)
      if (resolution%points_x > 0) well = min(well, (resolution%points_x - fewest_points_per_wave)/enough_along_x)
      if (resolution%points_y > 0) well = min(well, (resolution%points_y - fewest_points_per_wave) &
                                              /(wanted_points_per_wave - fewest_points_per_wave))
      likely_order = lowest_order + (formal_order - lowest_order)*min(max(well, 0.0_dp), 1.0_dp)
      if (ieee_is_finite(film_order)) likely_order = min(likely_order, max(film_order, lowest_order))
   end function likely_order

   !> Theory eq. (E2): log2 of |v(2h) - v(4h)|/|v(h) - v(2h)|; NaN without three finite values or where they do not
   !> differ.
   pure real(dp) function observed_order(values)
      real(dp), intent(in) :: values(:)   !! on meshes h, 2h, 4h, ...: the finest first
      real(dp) :: fine, coarse

      observed_order = no_value
      if (size(values) < 3) return
      if (.not. all(ieee_is_finite(values(:3)))) return
      fine = abs(values(1) - values(2))
      coarse = abs(values(2) - values(3))
      if (fine > 0 .and. coarse > 0) observed_order = log(coarse/fine)/log(2.0_dp)
   end function observed_order

end module ehlwave_error_estimate
