!> Factors of declared errors. Written by `scripts/study accuracy --calibrate`: do not edit.
!>
!> 99 % of the errors of 858 contacts are below factor times rule, theory eq. (E1). Errors:
!> postprocess/record/accuracy/sample.csv.
module ehlwave_error_factors
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   integer, parameter, public :: central_film = 1, smallest_film = 2, friction = 3, &
                                 rolling = 4, response = 5, amplitude_ratio = 6

   !> With a coarser grid, and by the model alone: (quantity, kind), kinds of `kind_of`.
   !> By the edges of a flooded domain: (quantity), times the error of `ehlwave_domain_choice`.
   real(dp), parameter, public :: by_grids(6, 4) = reshape([ &
      1.19_dp, 1.50_dp, 2.10_dp, 3.14_dp, 2.10_dp, 2.10_dp, &
      1.20_dp, 1.77_dp, 2.04_dp, 3.14_dp, 2.02_dp, 2.02_dp, &
      1.60_dp, 1.56_dp, 2.04_dp, 3.14_dp, 2.01_dp, 2.01_dp, &
      1.98_dp, 1.56_dp, 2.04_dp, 3.14_dp, 2.01_dp, 2.01_dp], [6, 4])
   real(dp), parameter, public :: by_model(6, 4) = reshape([ &
      2.02_dp, 3.60_dp, 2.10_dp, 3.14_dp, 3.15_dp, 3.15_dp, &
      2.28_dp, 5.28_dp, 2.04_dp, 3.14_dp, 3.15_dp, 3.15_dp, &
      2.28_dp, 6.05_dp, 2.04_dp, 3.14_dp, 3.15_dp, 3.15_dp, &
      2.69_dp, 5.28_dp, 2.04_dp, 3.14_dp, 3.15_dp, 3.15_dp], [6, 4])
   real(dp), parameter, public :: by_domain(5) = [ &
      1.74_dp, 1.66_dp, 2.00_dp, 1.00_dp, 2.02_dp]

end module ehlwave_error_factors
