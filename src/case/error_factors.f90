!> Factors of declared errors. Written by `scripts/study accuracy --calibrate`: do not edit.
!>
!> 99 % of the errors of 1304 contacts are below factor times rule, theory eq. (E1). Errors:
!> postprocess/record/accuracy/sample.csv.gz.
module ehlwave_error_factors
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   integer, parameter, public :: central_film = 1, smallest_film = 2, friction = 3, &
                                 rolling = 4, response = 5, amplitude_ratio = 6

   !> With a coarser grid: (quantity, kind), kinds of `kind_of`.
   real(dp), parameter, public :: by_grids(6, 4) = reshape([ &
      1.20_dp, 1.29_dp, 2.30_dp, 2.95_dp, 2.00_dp, 2.09_dp, &
      1.27_dp, 1.84_dp, 2.30_dp, 2.95_dp, 2.25_dp, 2.25_dp, &
      1.91_dp, 1.53_dp, 2.30_dp, 2.95_dp, 2.25_dp, 2.25_dp, &
      1.98_dp, 1.50_dp, 7.29_dp, 2.95_dp, 2.50_dp, 2.50_dp], [6, 4])

   !> By the model alone, likewise.
   real(dp), parameter, public :: by_model(6, 4) = reshape([ &
      1.89_dp, 1.29_dp, 3.50_dp, 2.95_dp, 4.10_dp, 4.10_dp, &
      2.08_dp, 1.84_dp, 2.88_dp, 2.95_dp, 3.92_dp, 3.92_dp, &
      2.48_dp, 1.53_dp, 2.88_dp, 2.95_dp, 3.92_dp, 3.92_dp, &
      2.69_dp, 1.50_dp, 7.29_dp, 2.95_dp, 3.92_dp, 3.92_dp], [6, 4])

   !> By the edges of a flooded domain: (quantity), times the error of `ehlwave_domain_choice`;
   !> friction and rolling: times the part by the oil outside.
   real(dp), parameter, public :: by_domain(5) = [ &
      2.76_dp, 2.25_dp, 0.509_dp, 0.0535_dp, 2.20_dp]

end module ehlwave_error_factors
