!> Factors of declared errors. Written by `scripts/study accuracy --calibrate`: do not edit.
!>
!> 99 % of the errors of 206 contacts are below factor times rule, theory eq. (E1). Errors:
!> postprocess/record/accuracy/sample.csv.
module ehlwave_error_factors
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   integer, parameter, public :: central_film = 1, smallest_film = 2, friction = 3, &
                                 rolling = 4, response = 5, amplitude_ratio = 6

   !> With a coarser grid, and by the model alone: (quantity, kind), kinds of `kind_of`.
   real(dp), parameter, public :: by_grids(6, 4) = reshape([ &
      1.11_dp, 1.35_dp, 15.3_dp, 2.00_dp, 2.18_dp, 2.10_dp, &
      1.20_dp, 1.85_dp, 15.3_dp, 2.00_dp, 1.99_dp, 2.10_dp, &
      2.00_dp, 2.00_dp, 15.3_dp, 2.00_dp, 2.50_dp, 2.50_dp, &
      2.00_dp, 2.00_dp, 15.3_dp, 2.00_dp, 2.50_dp, 2.50_dp], [6, 4])
   real(dp), parameter, public :: by_model(6, 4) = reshape([ &
      3.00_dp, 4.00_dp, 15.3_dp, 4.00_dp, 4.00_dp, 4.00_dp, &
      3.00_dp, 4.00_dp, 15.3_dp, 4.00_dp, 4.00_dp, 4.00_dp, &
      5.00_dp, 6.00_dp, 15.3_dp, 4.00_dp, 5.00_dp, 5.00_dp, &
      5.00_dp, 6.00_dp, 15.3_dp, 4.00_dp, 5.00_dp, 5.00_dp], [6, 4])

end module ehlwave_error_factors
