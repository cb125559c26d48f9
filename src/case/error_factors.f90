!> Factors of declared errors. Written by `scripts/study accuracy --calibrate`: do not edit.
!>
!> 99 % of the errors of 1489 contacts are below factor times rule, theory eq. (E1). Errors:
!> postprocess/record/accuracy/sample.csv.xz.
module ehlwave_error_factors
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   integer, parameter, public :: central_film = 1, smallest_film = 2, friction = 3, &
                                 rolling = 4, response = 5, amplitude_ratio = 6

   !> With a coarser grid: (quantity, kind), kinds of `kind_of`.
   real(dp), parameter, public :: by_grids(6, 4) = reshape([ &
      1.20_dp, 1.29_dp, 1.56_dp, 1.41_dp, 2.00_dp, 2.07_dp, &
      1.27_dp, 1.85_dp, 0.886_dp, 2.10_dp, 2.70_dp, 1.96_dp, &
      1.46_dp, 1.03_dp, 2.04_dp, 4.85_dp, 1.87_dp, 2.07_dp, &
      1.31_dp, 1.41_dp, 1.27_dp, 4.85_dp, 2.77_dp, 2.15_dp], [6, 4])

   !> By the model alone, likewise.
   real(dp), parameter, public :: by_model(6, 4) = reshape([ &
      2.10_dp, 0.670_dp, 0.712_dp, 1.12_dp, 3.92_dp, 1.53_dp, &
      2.10_dp, 0.668_dp, 1.46_dp, 1.12_dp, 4.61_dp, 4.61_dp, &
      1.25_dp, 0.309_dp, 0.612_dp, 1.45_dp, 8.82_dp, 1.51_dp, &
      2.47_dp, 0.668_dp, 1.30_dp, 1.45_dp, 4.61_dp, 4.61_dp], [6, 4])

   !> By the edges of a flooded domain: (quantity), times the error of `ehlwave_domain_choice`;
   !> rolling: times the part by the oil outside, which counts whole for friction.
   real(dp), parameter, public :: by_domain(5) = [ &
      2.87_dp, 2.50_dp, 0.448_dp, 0.0516_dp, 2.25_dp]

end module ehlwave_error_factors
