!> Overtones and mixed waves in the film under two rough surfaces: frequencies m1 f1 + m2 f2.
!>
!> Waves of finite amplitude excite them in proportion to the product of the heights to the powers |m1| and |m2|. A
!> record separates those whose frequencies differ from all others by more than the inverse of its length. An overtone
!> with the frequency of the other surface's waves cannot be separated from them.
module ehlwave_overtones
   use ehlwave_kinds, only: dp
   use ehlwave_surfaces, only: surfaces_t
   implicit none (type, external)
   private
   public :: overtone_error, resolved_periods

   integer, parameter :: fitted_order = 3              !! largest |m1| + |m2| of a fit,
   integer, parameter :: counted_order = 6             !! and of the error by overtones
   real(dp), parameter :: fewest_beats = 0.75_dp       !! beats in a record that separate two frequencies
   !> Overtone over the product of the heights, both over the film. Measured: 0.02 to 0.21 (M = 20 to 300, D = 0 to 1, 1
   !> and 2 a, heights of 0.05 to 0.3, first overtone).
   real(dp), parameter :: overtone_share = 0.25_dp

contains

   !> Periods, in T, of all waves that a record resolves: the waves of the surfaces first, then overtones of two.
   pure function resolved_periods(surfaces, time_step) result(periods)
      class(surfaces_t), intent(in) :: surfaces
      real(dp), intent(in) :: time_step            !! dT of the record
      real(dp), allocatable :: periods(:)
      real(dp) :: frequency
      integer :: m1, m2, order

      periods = surfaces%periods()
      if (size(periods) < 2) return
      do order = 2, fitted_order
         do m1 = 0, order
            do m2 = m1 - order, order - m1, max(1, 2*(order - m1))
               frequency = seen(surfaces, m1, m2, time_step)
               if (.not. any(are_close(surfaces, frequency, [0.0_dp, 0.5_dp/time_step, 1/periods]))) &
                  periods = [periods, 1/frequency]
            end do
         end do
      end do
   end function resolved_periods

   !> Relative error of the height of the waves of surface n by overtones and mixed waves of their frequency.
   pure real(dp) function overtone_error(surfaces, n, heights, time_step) result(error)
      class(surfaces_t), intent(in) :: surfaces    !! two that the record separates, else there is no error
      integer, intent(in) :: n
      real(dp), intent(in) :: heights(:)           !! heights of the waves in the film, over the film
      real(dp), intent(in) :: time_step            !! dT of the record
      real(dp) :: own
      integer :: m1, m2, order

      error = 0
      if (size(surfaces%periods()) < 2 .or. .not. heights(n) > 0) return
      own = 1/surfaces%list(n)%period()
      do order = 2, counted_order
         do m1 = 0, order
            do m2 = m1 - order, order - m1, max(1, 2*(order - m1))
               if (are_close(surfaces, seen(surfaces, m1, m2, time_step), own)) &
                  error = error + overtone_share*heights(1)**m1*heights(2)**abs(m2)/heights(n)
            end do
         end do
      end do
   end function overtone_error

   !> Frequency of an overtone in a record with steps of dT.
   pure real(dp) function seen(surfaces, m1, m2, time_step) result(frequency)
      class(surfaces_t), intent(in) :: surfaces
      integer, intent(in) :: m1, m2
      real(dp), intent(in) :: time_step
      frequency = abs(m1/surfaces%list(1)%period() + m2/surfaces%list(2)%period())
      frequency = abs(frequency - nint(frequency*time_step)/time_step)
   end function seen

   !> Whether a record does not separate two frequencies.
   elemental logical function are_close(surfaces, one, other)
      class(surfaces_t), intent(in) :: surfaces
      real(dp), intent(in) :: one, other
      are_close = abs(one - other)*surfaces%window() < fewest_beats
   end function are_close

end module ehlwave_overtones
