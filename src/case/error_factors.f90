!> Factors of declared errors. Written by `scripts/study accuracy --calibrate`: do not edit.
!>
!> 99 % of the errors of 1485 contacts are below factor times rule, theory eq. (E1). Errors:
!> postprocess/record/accuracy/sample.csv.gz.
module ehlwave_error_factors
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   integer, parameter, public :: central_film = 1, smallest_film = 2, friction = 3, &
                                 rolling = 4, response = 5, amplitude_ratio = 6

   !> With a coarser grid: (quantity, kind), kinds of `kind_of`.
   real(dp), parameter, public :: by_grids(6, 4) = reshape([ &
      1.18_dp, 1.60_dp, 2.04_dp, 2.91_dp, 2.03_dp, 2.03_dp, &
      1.22_dp, 1.67_dp, 2.06_dp, 3.27_dp, 2.25_dp, 2.25_dp, &
      1.91_dp, 1.56_dp, 3.39_dp, 3.50_dp, 2.04_dp, 2.04_dp, &
      1.97_dp, 1.49_dp, 2.06_dp, 3.27_dp, 2.50_dp, 2.50_dp], [6, 4])

   !> By the model alone, likewise.
   real(dp), parameter, public :: by_model(6, 4) = reshape([ &
      1.97_dp, 3.51_dp, 2.04_dp, 2.91_dp, 6.71_dp, 6.71_dp, &
      2.09_dp, 5.85_dp, 2.06_dp, 3.27_dp, 6.32_dp, 6.32_dp, &
      2.37_dp, 10.7_dp, 3.39_dp, 3.50_dp, 6.32_dp, 6.32_dp, &
      2.69_dp, 5.85_dp, 2.06_dp, 3.27_dp, 6.32_dp, 6.32_dp], [6, 4])

   !> By the edges of a flooded domain: (quantity), times the error of `ehlwave_domain_choice`.
   real(dp), parameter, public :: by_domain(5) = [ &
      1.95_dp, 1.98_dp, 2.00_dp, 1.00_dp, 1.87_dp]

end module ehlwave_error_factors
