!> Flow of generalised Newtonian oils across the film: closed forms, limits, symmetry, derivatives.
program test_film_flow
   use ehlwave_carreau_law, only: new_carreau_law
   use ehlwave_eyring_law, only: eyring_law_t
   use ehlwave_film_flow, only: film_flow_t, new_film_flow
   use ehlwave_film_rules, only: across_film_t
   use ehlwave_flow_law, only: flow_law_t
   use ehlwave_flow_values, only: along_x, along_y, flow_by_gx, flow_by_gy, flow_q, flow_values
   use ehlwave_kinds, only: dp
   use ehlwave_shear_limit, only: limit_floor, new_shear_limit
   use testing, only: test_t
   implicit none (type, external)

   real(dp), parameter :: lambdabar = 0.02_dp, n0 = 1.2_dp
   type(test_t) :: test

   call check_conry()
   call check_conry_far()
   call check_ehret()
   call check_cubic()
   call check_newtonian()
   call check_symmetry()
   call check_derivatives('Ree-Eyring', eyring_law_t())
   call check_derivatives('Carreau, n = 0.45', new_carreau_law(0.45_dp))
   call check_derivatives('Carreau, n = 1', new_carreau_law(1.0_dp))
   call check_derivatives('limited', eyring_law_t(), limit=9.0_dp)
   call check_derivatives('warm', eyring_law_t(), ln_fluidity=[0.3_dp, 1.2_dp, 2.0_dp, 2.5_dp, 2.4_dp, 1.7_dp, 0.9_dp])
   call check_derivatives('warm and Newtonian', new_carreau_law(1.0_dp), ln_fluidity=[0.0_dp, 0.7_dp, 0.9_dp, 0.8_dp, 0.2_dp])
   call check_derivatives('warm and limited', new_carreau_law(0.6_dp), 14.0_dp, [0.0_dp, 0.7_dp, 0.9_dp, 0.8_dp, 0.2_dp])
   call check_uneven()
   call check_limit()
   call check_extremes()
   call test%finish()

contains

   !> A place, S = 1.5: fluidity such that B is as given.
   subroutine at(flow, component, b, h, g, values)
      type(film_flow_t), intent(in) :: flow
      integer, intent(in) :: component
      real(dp), intent(in) :: b, h, g(2)
      real(dp), intent(out) :: values(flow_values)
      real(dp) :: row(flow_values, 1)
      call flow%evaluate(component, [fluidity_for(flow, b, h)], [h], g(1:1), g(2:2), row)
      values = row(:, 1)
   end subroutine at

   pure real(dp) function fluidity_for(flow, b, h)
      type(film_flow_t), intent(in) :: flow
      real(dp), intent(in) :: b, h
      fluidity_for = lambdabar*flow%n0*0.5_dp/(3*b*h)
   end function fluidity_for

   pure real(dp) function newtonian(flow, b, h)
      type(film_flow_t), intent(in) :: flow
      real(dp), intent(in) :: b, h
      newtonian = h**3*fluidity_for(flow, b, h)/lambdabar
   end function newtonian

   !> Conry, Wang and Cusano 1987: the factor of the flow where there is no gradient across sliding.
   subroutine check_conry()
      real(dp), parameter :: variations(*) = [0.05_dp, 0.5_dp, 1.5_dp, 5.0_dp, 12.0_dp, 20.0_dp], &
                             rates(*) = [1e-6_dp, 1e-2_dp, 1.0_dp, 1e2_dp, 1e4_dp, 1e6_dp], h = 0.15_dp
      type(film_flow_t) :: flow
      real(dp) :: factor, g, mean, values(flow_values)
      real(dp) :: b_found(1), factors(2, 1), sigma(1)
      integer :: i, j

      flow = new_film_flow(eyring_law_t(), n0, lambdabar, 1.5_dp)
      do j = 1, size(rates)
         do i = 1, size(variations)
            associate (s => variations(i), b => rates(j))
               g = s/(n0*h)
               mean = asinh(b*s/sinh(s))
               factor = cosh(mean)*3*(s*cosh(s) - sinh(s))/s**3
               call at(flow, along_x, b, h, [g, 0.0_dp], values)
               call test%check_close(values(flow_q), newtonian(flow, b, h)*g*factor, 'Conry''s factor', relative=1e-10_dp)
               call flow%mean_stress([fluidity_for(flow, b, h)], [h], [-g], [0.0_dp], sigma, b_found, factors)
               call test%check_close(sigma(1), mean, 'sigma_m', relative=1e-10_dp, absolute=1e-15_dp*s)
               call test%check_close(b_found(1), b, 'B', relative=1e-14_dp)
            end associate
         end do
      end do
   end subroutine check_conry

   !> Beyond 20, where the exponential alone is left: as exact as its rules can be.
   subroutine check_conry_far()
      real(dp), parameter :: variations(*) = [40.0_dp, 90.0_dp, 200.0_dp], h = 0.15_dp, b = 1e4_dp
      type(film_flow_t) :: flow
      real(dp) :: values(flow_values)
      integer :: i

      flow = new_film_flow(eyring_law_t(), n0, lambdabar, 1.5_dp)
      do i = 1, size(variations)
         associate (s => variations(i))
            call at(flow, along_x, b, h, [s/(n0*h), 0.0_dp], values)
            call test%check_close(values(flow_q), newtonian(flow, b, h)/(n0*h)*sqrt(1 + (b*s/sinh(s))**2) &
                                  *3*(s*cosh(s) - sinh(s))/s**2, 'Conry''s factor beyond 20', relative=1e-9_dp)
         end associate
      end do
   end subroutine check_conry_far

   !> Ehret, Dowson and Taylor 1998: the limit of a small gradient.
   subroutine check_ehret()
      real(dp), parameter :: rates(*) = [1e-3_dp, 1.0_dp, 1e3_dp, 1e6_dp], h = 0.2_dp
      type(film_flow_t) :: flow
      real(dp) :: along(flow_values), across(flow_values), mean
      integer :: i

      flow = new_film_flow(eyring_law_t(), n0, lambdabar, 1.5_dp)
      do i = 1, size(rates)
         mean = asinh(rates(i))
         call at(flow, along_x, rates(i), h, [0.0_dp, 0.0_dp], along)
         call at(flow, along_y, rates(i), h, [0.0_dp, 0.0_dp], across)
         call test%check_close([along(flow_by_gx), across(flow_by_gy)], newtonian(flow, rates(i), h)* &
                               [cosh(mean), sinh(mean)/mean], 'tangents of Ehret', relative=1e-11_dp)
         call test%check_close([along(flow_by_gy), across(flow_by_gx), along(flow_q), across(flow_q)], spread(0.0_dp, 1, 4), &
                               'no flow without gradient', absolute=1e-14_dp*along(flow_by_gx))
      end do
   end subroutine check_ehret

   !> Carreau with n = 1/3: sigma_m (1 + sigma_m^2 + Sigma^2) = B and the factor 1 + 3 sigma_m^2 + 3 Sigma^2/5.
   subroutine check_cubic()
      real(dp), parameter :: means(*) = [1e-3_dp, 0.3_dp, 2.0_dp, 50.0_dp], variations(*) = [0.01_dp, 0.3_dp, 3.0_dp, 30.0_dp], &
                             h = 0.15_dp
      type(film_flow_t) :: flow
      real(dp) :: b, g, values(flow_values)
      integer :: i, j

      flow = new_film_flow(new_carreau_law(1/3.0_dp), n0, lambdabar, 1.5_dp)
      do j = 1, size(variations)
         do i = 1, size(means)
            associate (m => means(i), s => variations(j))
               b = m*(1 + m**2 + s**2)
               g = s/(n0*h)
               call at(flow, along_x, b, h, [g, 0.0_dp], values)
               call test%check_close(values(flow_q), newtonian(flow, b, h)*g*(1 + 3*m**2 + 0.6_dp*s**2), 'cubic Carreau', &
                                     relative=1e-11_dp)
            end associate
         end do
      end do
   end subroutine check_cubic

   !> Carreau with n = 1 and Ree-Eyring with a large tau0 are Newton's law.
   subroutine check_newtonian()
      real(dp), parameter :: h = 0.15_dp, g(2) = [3.0_dp, -2.0_dp], fluidity = 1e-5_dp
      type(film_flow_t) :: flow
      real(dp) :: q, row(flow_values, 1)
      integer :: component, i

      do i = 1, 2
         if (i == 1) flow = new_film_flow(new_carreau_law(1.0_dp), n0, lambdabar, 1.5_dp)
         if (i == 2) flow = new_film_flow(eyring_law_t(), n0*5e6_dp/1e15_dp, lambdabar, 1.5_dp)
         do component = along_x, along_y
            call flow%evaluate(component, [fluidity], [h], g(1:1), g(2:2), row)
            q = h**3*fluidity/lambdabar*g(component)
            call test%check_close(row(:3, 1), [q, -q, 3*q/h], 'Newtonian flow', relative=1e-9_dp)
            call test%check_close(row(flow_by_gx - 1 + component, 1), q/g(component), 'by its gradient', relative=1e-9_dp)
            call test%check_close(row(flow_by_gy + 1 - component, 1), 0.0_dp, 'by the other', absolute=1e-9_dp*abs(q))
         end do
      end do
   end subroutine check_newtonian

   !> S and 2 - S give the same flow; the flow is odd in the gradient.
   subroutine check_symmetry()
      real(dp), parameter :: h(3) = 0.15_dp, gx(3) = [3.0_dp, -1.0_dp, 30.0_dp], gy(3) = [-2.0_dp, 0.5_dp, 8.0_dp], &
                             fluidity(3) = [1e-5_dp, 1e-3_dp, 1e-2_dp]
      type(film_flow_t) :: fast, slow
      real(dp), dimension(flow_values, 3) :: one, other, reverse
      integer :: component

      fast = new_film_flow(eyring_law_t(), n0, lambdabar, 1.4_dp)
      slow = new_film_flow(eyring_law_t(), n0, lambdabar, 0.6_dp)
      do component = along_x, along_y
         call fast%evaluate(component, fluidity, h, gx, gy, one)
         call slow%evaluate(component, fluidity, h, gx, gy, other)
         call fast%evaluate(component, fluidity, h, -gx, -gy, reverse)
         call test%check_close([one], [other], 'S and 2 - S', relative=1e-11_dp)
         call test%check_close([one(:3, :)], [-reverse(:3, :)], 'odd in the gradient', relative=1e-11_dp)
         call test%check_close([one(4:, :)], [reverse(4:, :)], 'derivatives even in it', relative=1e-11_dp)
      end do
   end subroutine check_symmetry

   !> Taylor test: the remainder Q(x + t d) - Q(x) - t dQ(x) d falls by 4 when t halves.
   subroutine check_derivatives(name, law, limit, ln_fluidity)
      character(len=*), intent(in) :: name
      class(flow_law_t), intent(in) :: law
      real(dp), intent(in), optional :: limit                 !! limit of the stress over tau0, for P = 1
      real(dp), intent(in), optional :: ln_fluidity(0:)       !! at levels across the film
      real(dp), parameter :: direction(5) = [0.7_dp, 0.03_dp, 0.9_dp, -0.8_dp, 0.1_dp]   ! changes of ln(eta), H, g_x,
                                                                                         ! g_y, P
      real(dp), parameter :: points(4, 4) = reshape([-11.0_dp, 0.15_dp, 1.0_dp, 0.7_dp, -4.0_dp, 0.2_dp, -9.0_dp, 6.0_dp, &
                                                     -9.0_dp, 0.1_dp, 2.0_dp, 30.0_dp, 0.5_dp, 0.3_dp, 12.0_dp, -3.0_dp], [4, 4])
      type(film_flow_t) :: flow
      type(across_film_t), allocatable :: across
      real(dp) :: remainder(2), step, x(5), here(flow_values, 1), there(flow_values, 1)
      integer :: component, i, k, n

      flow = new_film_flow(law, n0, lambdabar, 1.5_dp)
      if (present(limit) .or. present(ln_fluidity)) allocate (across)
      if (present(limit)) flow%limit = new_shear_limit(limit, 0.1_dp)
      if (present(ln_fluidity)) then
         call flow%rules%set_levels(size(ln_fluidity) - 1)
         across%ln_fluidity = reshape(ln_fluidity, [size(ln_fluidity), 1])
         across%range = [maxval(ln_fluidity) - minval(ln_fluidity)]
         if (flow%has_moments()) call take_moments(flow, across)
      end if
      do i = 1, size(points, 2)
         do component = along_x, along_y
            do k = 0, merge(5, 4, present(limit))   ! all at once, then each alone
               do n = 1, 2
                  step = 1e-2_dp/2**n
                  x = merge(step*direction, 0.0_dp, k == 0 .or. [1, 2, 3, 4, 5] == k)
                  if (present(limit)) across%p = [0.8_dp]
                  call flow%evaluate(component, exp(points(1:1, i)), points(2:2, i), points(3:3, i), points(4:4, i), here, &
                                     across=across)
                  if (present(limit)) across%p = across%p + x(5)
                  call flow%evaluate(component, exp(points(1:1, i) - x(1)), points(2:2, i) + x(2), points(3:3, i) + x(3), &
                                     points(4:4, i) + x(4), there, across=across)
                  remainder(n) = there(flow_q, 1) - here(flow_q, 1) - dot_product(here(2:, 1), x)
               end do
               if (abs(remainder(2)) < 1e-13_dp*abs(here(flow_q, 1))) cycle   ! linear in it
               call test%check_close(log(remainder(1)/remainder(2))/log(2.0_dp), 2.0_dp, name//': observed order', absolute=0.1_dp)
            end do
         end do
      end do
   end subroutine check_derivatives

   !> An oil of Newton's law whose fluidity goes linearly across the film, 1 + c zeta, has a_0 = 1, a_1 = c/3 and a_2 = 1/3:
   !> sliding alone drives oil towards the surface where it is thin.
   subroutine check_uneven()
      integer, parameter :: levels = 24
      real(dp), parameter :: c = 0.6_dp, h = 0.15_dp, g = 2.0_dp, b = 0.8_dp
      type(film_flow_t) :: flow
      type(across_film_t) :: across
      real(dp) :: factors(2, 1), mean, rate(1), row(flow_values, 1), sigma(1), variation
      integer :: k

      flow = new_film_flow(new_carreau_law(1.0_dp), n0, lambdabar, 1.5_dp)
      call flow%rules%set_levels(levels)
      across%ln_fluidity = reshape([(log(1 + c*(2.0_dp*k/levels - 1)), k=0, levels)], [levels + 1, 1])
      call take_moments(flow, across)
      variation = n0*h*g
      mean = b - c/3*variation
      call flow%evaluate(along_x, [fluidity_for(flow, b, h)], [h], [g], [0.0_dp], row, across=across)
      call test%check_close(row(flow_q, 1), newtonian(flow, b, h)*g*3*(c/3*mean + variation/3)/variation, &
                            'flow of an uneven oil', relative=1e-5_dp)
      call flow%mean_stress([fluidity_for(flow, b, h)], [h], [g], [0.0_dp], sigma, rate, factors, across)
      call test%check_close(sigma(1), mean, 'its stress', relative=1e-5_dp)
   end subroutine check_uneven

   !> Moments of the fluidities of a place.
   subroutine take_moments(flow, across)
      type(film_flow_t), intent(in) :: flow
      type(across_film_t), intent(inout) :: across
      associate (ln => across%ln_fluidity)
         allocate (across%moments(0:2, 1))
         across%range = maxval(ln, 1) - minval(ln, 1)
         call flow%rules%moments_of(ln, across%range, across%moments)
      end associate
   end subroutine take_moments

   !> Sliding as fast as may be never needs more than the limit of the stress, and nears it.
   subroutine check_limit()
      real(dp), parameter :: limit = 3, h = 0.15_dp
      type(film_flow_t) :: flow
      type(across_film_t) :: across
      real(dp) :: before, factors(2, 1), rate(1), sigma(1)
      integer :: k

      flow = new_film_flow(eyring_law_t(), n0, lambdabar, 1.5_dp)
      flow%limit = new_shear_limit(limit, 0.1_dp)
      across%p = [1.0_dp]
      before = 0
      do k = -2, 5
         call flow%mean_stress([fluidity_for(flow, 10.0_dp**k, h)], [h], [0.0_dp], [0.0_dp], sigma, rate, factors, across)
         call test%check(sigma(1) > before .and. sigma(1) < limit*(1 + limit_floor**2), 'between the one before and the limit')
         before = sigma(1)
      end do
      call test%check_close(before, limit, 'near the limit', relative=1e-3_dp)
      call flow%mean_stress([fluidity_for(flow, 0.01_dp, h)], [h], [0.0_dp], [0.0_dp], sigma, rate, factors, across)
      call test%check_close(sigma(1), asinh(0.01_dp), 'that of the law far below it', relative=1e-6_dp)
   end subroutine check_limit

   !> Finite whatever an iterate may hold, and no arithmetic trap.
   subroutine check_extremes()
      real(dp), parameter :: fluidity(4) = [1e-260_dp, 1e-260_dp, 1.0_dp, 1e-10_dp], h(4) = [0.1_dp, 1e-6_dp, 30.0_dp, 0.1_dp], &
                             gx(4) = [1e4_dp, 0.0_dp, 1e3_dp, 1e-200_dp], gy(4) = [1e3_dp, 1.0_dp, -1e4_dp, 0.0_dp]
      type(film_flow_t) :: flow
      real(dp) :: values(flow_values, 4)
      integer :: component, law

      do law = 1, 2
         if (law == 1) flow = new_film_flow(eyring_law_t(), n0, lambdabar, 1.5_dp)
         if (law == 2) flow = new_film_flow(new_carreau_law(0.2_dp), n0, lambdabar, 1.5_dp)
         do component = along_x, along_y
            call flow%evaluate(component, fluidity, h, gx, gy, values)
            call test%check(all(abs(values) < huge(1.0_dp)), 'finite')
         end do
      end do
   end subroutine check_extremes

end program test_film_flow
