!> The amplitude up to which waves respond linearly.
!>
!> The relative difference of Ad/Ai grows with the square of Ai: difference = factor (Ai/film)^2. Factors were measured
!> by marches beside linear responses (96 x 96 cells, transverse waves of 0.6 and 1.2 a):
!>
!>     M, L, D, S                       Newtonian                         Ree-Eyring of 5 MPa
!>     100, 12.05, 1, 1                 0.05
!>     100, 12.05, 1, 0.8 and 1.2       0.04                              0.2
!>     100, 12.05, 1, 0.5               0.05, 0.15                        0.1, 0.5
!>     100, 12.05, 1, 1.5               0.12                              0.4 (1.2 a)
!>     80, 8, 0.5, 0.5                  0.07, 1.8                         0.07, 4.4
!>     80, 8, 0.5, 1.5                  12 to 17 (0.6 a), 1.1 (1.2 a)     0.2 (1.2 a)
!>
!> The wave that the oil carries makes the difference, which varies much between cases. The range holds for the worst.
module ehlwave_linear_range
   use ehlwave_case_definition, only: case_t
   use ehlwave_kinds, only: dp
   use ehlwave_roughness, only: roughness_t, surface_speed
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: expected_nonlinearity, is_beyond_linear, linear_amplitude, linear_limit_text

   real(dp), parameter, public :: tolerated_difference = 0.01_dp   !! tolerated difference of Ad/Ai, relative, within
                                                                   !! the linear range
   real(dp), parameter :: rolling_factor = 0.05_dp                 !! factor of (Ai over the film)^2
   real(dp), parameter :: slip_factor(2) = [68.0_dp, 18.0_dp]      !! factors over (S - 1)^2: Newtonian oil with S > 1,
                                                                   !! others

contains

   !> Relative difference to expect between Ad/Ai of the waves of a case and of small waves.
   elemental real(dp) function expected_nonlinearity(case) result(difference)
      type(case_t), intent(in) :: case
      type(roughness_t) :: waves(2)
      integer :: n
      difference = 0
      if (.not. case%has_linear_range()) return
      waves = case%surfaces()
      do n = 1, size(waves)
         if (waves(n)%is_wavy()) difference = difference &
            + curvature(case, surface_speed(n, case%slip_parameter))*waves(n)%amplitude_over_film**2
      end do
   end function expected_nonlinearity

   !> Whether the waves of a case, of both surfaces together, are beyond the linear range.
   elemental logical function is_beyond_linear(case)
      type(case_t), intent(in) :: case
      is_beyond_linear = expected_nonlinearity(case) > tolerated_difference
   end function is_beyond_linear

   !> Largest Ai within the linear range of each surface, with the other surface smooth, as text.
   function linear_limit_text(case) result(text)
      type(case_t), intent(in) :: case
      character(len=:), allocatable :: text
      text = limit(1)//' % of the film'
      if (case%effects%second%roughness%is_wavy()) text = text//' on surface 1 and '//limit(2)//' % on surface 2'

   contains

      function limit(surface)
         integer, intent(in) :: surface
         character(len=:), allocatable :: limit
         limit = to_text(100*linear_amplitude(case, surface, tolerated_difference), 2)
      end function limit

   end function linear_limit_text

   !> Largest Ai of a surface, over the film, with at most this relative difference of Ad/Ai from small waves.
   elemental real(dp) function linear_amplitude(case, surface, difference)
      type(case_t), intent(in) :: case
      integer, intent(in) :: surface       !! 1 or 2, the other one smooth
      real(dp), intent(in) :: difference
      linear_amplitude = min(1.0_dp, sqrt(difference/curvature(case, surface_speed(surface, case%slip_parameter))))
   end function linear_amplitude

   !> Difference over (Ai over the film)^2, for the waves of a surface.
   elemental real(dp) function curvature(case, speed)
      type(case_t), intent(in) :: case
      real(dp), intent(in) :: speed        !! speed of the surface, over the mean speed
      curvature = rolling_factor + slip_factor(merge(1, 2, case%oil%is_newtonian() .and. speed > 1))*(speed - 1)**2
   end function curvature

end module ehlwave_linear_range
