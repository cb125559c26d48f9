!> Choices of the multigrid cycle that preconditions a linearised contact.
module ehlwave_cycle_settings
   use ehlwave_kinds, only: dp
   use ehlwave_near_kernel, only: near_settings_t
   implicit none (type, external)
   private

   !> Settings that differ between Newton's steps and the response to small waves; measured, see the README.
   type, public :: cycle_settings_t
      type(near_settings_t) :: near
      real(dp) :: largest_share = 0.8_dp    !! share of a smooth residual, left to the coarser grid
      logical :: is_even = .false.          !! whether that share falls less where the node's own deformation is little
                                            !! of the diagonal, and not with the oil's compressibility
      real(dp) :: steep_fall = 0            !! `fall_along` that halves that share; 0: none does
      logical :: checks_factors = .false.   !! whether factors are tried before use: where they serve a long solve
   end type cycle_settings_t

   ! Reach along X, where cells are short there, relative to a pattern isotropic in metres. The coarser grids cover the
   ! rest: M = 1000, D = 0.07, 256^2: 12 GMRES steps in place of 10 for three quarters of the work. Short waves need
   ! more (M = 2000, D = 0.04, 0.125 a, 512^2: 14 steps with three quarters of the pattern, 20 with a half, 11 with
   ! all).
   real(dp), parameter :: newton_reach = 0.5_dp, response_reach = 0.75_dp

   ! Behind the spike the pressure falls within few nodes, and waves move that fall along. Its residual is for the
   ! factors. Book, 1024^2: 17 GMRES steps, without 33.
   real(dp), parameter :: response_fall = 6

   ! GMRES steps of M = 1000, D = 1, 2048^2, and of the book, whose oil is incompressible, there: 19 and 23. As Newton's
   ! method has it: with 0.7 35 and 23, with 0.8 25 and 25, with 0.88 19 and 30. Up to 1024^2 it makes a step of
   ! difference.
   real(dp), parameter :: response_share = 0.7_dp

   type(cycle_settings_t), parameter, public :: newton_cycle = cycle_settings_t( &
      near=near_settings_t(stretch_x=newton_reach, taper=0.5_dp, least_taper=0.5_dp))

   type(cycle_settings_t), parameter, public :: response_cycle = cycle_settings_t( &
      near=near_settings_t(least_x=3, stretch_x=response_reach, taper=0.75_dp, least_taper=0.5_dp), &
      largest_share=response_share, is_even=.true., steep_fall=response_fall, checks_factors=.true.)

   real(dp), parameter, public :: diagonal_shift(4) = [0.0_dp, 0.1_dp, 0.3_dp, 1.0_dp]   !! shifts of factors, tried in
                                                                                         !! turn

end module ehlwave_cycle_settings
