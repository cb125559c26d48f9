!> By how much the shear of its own inlet thins a film: a law fitted to contacts that were computed with heat.
module ehlwave_inlet_law
   use ehlwave_inlet_coefficients, only: c => inlet_coefficients, error_share, error_slip, film_range, known_loss, &
                                         loading_range, l_range, largest_slide_roll, lowest_d, m_range
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: inlet_loss, inlet_loss_error, is_within_law

   !> Dimensionless groups of a contact, the inputs of the law.
   type, public :: inlet_t
      real(dp) :: loading = 0              !! L_t = eta0 beta ubar^2/k
      real(dp) :: slide_roll = 0           !! s = |u1 - u2|/ubar
      real(dp) :: wall = 0  !! B = (k/h) (a/ubar)^(1/2)/e_s: rise of the surfaces over the rise of the film
      real(dp) :: film = 0                 !! H(0,0) without heat
      real(dp) :: m = 0, l = 0, d = 1      !! M, L and D
   end type inlet_t

contains

   !> Share of the film that the warm inlet takes, y/(1 + y), theory eq. (T15):
   !>
   !>     y = c1 L_t^c2 (1 + c3 s^c4) (1 + c5 B^c6) G^(c7 + c8 D) exp(c9 D) (M/100)^c11,    G = H/(1 + c10 H^(3/2)).
   elemental real(dp) function inlet_loss(inlet) result(loss)
      type(inlet_t), intent(in) :: inlet
      associate (i => inlet)
         loss = c(1)*i%loading**c(2)*(1 + c(3)*i%slide_roll**c(4))*(1 + c(5)*i%wall**c(6)) &
                *(i%film/(1 + c(10)*i%film**1.5_dp))**(c(7) + c(8)*i%d)*exp(c(9)*i%d) &
                *(i%m/100)**c(11)
      end associate
      loss = loss/(1 + loss)
   end function inlet_loss

   !> Error of that share, the same way measured: 95 % of the contacts are within it.
   elemental real(dp) function inlet_loss_error(inlet) result(error)
      type(inlet_t), intent(in) :: inlet
      integer :: k
      k = count(inlet%slide_roll > error_slip) + 1
      error = error_share(k)*(inlet_loss(inlet) + known_loss)
   end function inlet_loss_error

   !> Whether the fit covers contacts like it.
   elemental logical function is_within_law(inlet)
      type(inlet_t), intent(in) :: inlet
      associate (i => inlet)
         is_within_law = is_in(i%m, m_range) .and. is_in(i%l, l_range) .and. is_in(i%film, film_range) .and. &
                         is_in(i%loading, loading_range) .and. i%slide_roll <= largest_slide_roll .and. &
                         (i%d >= lowest_d .or. abs(i%d) <= 0)
      end associate
   end function is_within_law

   pure logical function is_in(value, bounds)
      real(dp), intent(in) :: value, bounds(2)
      is_in = value >= bounds(1) .and. value <= bounds(2)
   end function is_in

end module ehlwave_inlet_law
