!> Means of the fitted scheme between two nodes, theory eq. (D11).
module ehlwave_fitted_mean
   use ehlwave_film_flow, only: across_film_t, along_x, film_flow_t, flow_by_gx, flow_by_gy, flow_by_h, &
      flow_by_ln_eta, flow_by_p, flow_q, flow_values
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: fit_flows, intervals, logarithmic_mean

   integer, parameter :: intervals = 2   !! of a face, between whose places flows have logarithmic means
   real(dp), parameter :: alike = 0.02_dp   !! |ln(b/a)| below which a series stands for the mean
   !> |Sigma| below which flows are those that derivatives drive: their own ratio is that of round-off.
   real(dp), parameter :: slight_stress = 1e-6_dp

contains

   !> Mean of exp(t) between ln(a) and ln(b), (b - a)/ln(b/a), and the derivatives of its logarithm by ln(a) and ln(b).
   pure subroutine logarithmic_mean(a, b, mean, by_a, by_b)
      real(dp), intent(in) :: a, b                !! > 0
      real(dp), intent(out) :: mean, by_a, by_b
      real(dp) :: t

      t = log(b/a)
      if (abs(t) < alike) then
         mean = sqrt(a*b)*(1 + t**2/24 + t**4/1920)
         by_b = 0.5_dp + t/12 - t**3/720
      else
         mean = (b - a)/t
         by_b = (b - mean)/(b - a)
      end if
      by_a = 1 - by_b
   end subroutine logarithmic_mean

   !> One flow through each face from those at places evenly between its nodes, in ln(eta), H and P, at the gradient of
   !> the face: to each node the flow, and what its own quantities change of it, for densities that weight the nodes.
   pure subroutine fit_flows(film, direction, fluidity, h, gx, gy, rho, flow, points, across)
      type(film_flow_t), intent(in) :: film
      integer, intent(in) :: direction                 !! of the faces: along_x or along_y
      real(dp), intent(in) :: fluidity(:, :), h(:, :)  !! eta0/eta and H, (faces, 2) at their nodes
      real(dp), intent(in) :: gx(:), gy(:)             !! dP/dX and kappa dP/dY, (faces)
      real(dp), intent(in) :: rho(:, :)                !! (faces, 2)
      real(dp), intent(out) :: flow(:, :)              !! (flow_values, faces*2) at the first nodes, then at the others
      integer, intent(out) :: points                   !! see `evaluate` of `film_flow_t`
      type(across_film_t), intent(in), optional :: across   !! at the nodes, in the order of `flow`
      type(across_film_t), allocatable :: between
      real(dp), dimension(size(gx), 0:intervals) :: fluid, thick
      real(dp) :: at_place(flow_values, size(gx)*(intervals + 1)), sigma
      integer :: k, n

      n = size(gx)
      do k = 0, intervals
         associate (s => k/real(intervals, dp))
            fluid(:, k) = fluidity(:, 1)*(fluidity(:, 2)/fluidity(:, 1))**s
            thick(:, k) = (1 - s)*h(:, 1) + s*h(:, 2)
         end associate
      end do
      if (present(across)) then
         allocate (between)
         allocate (between%p(size(at_place, 2)))
         do k = 0, intervals
            associate (s => k/real(intervals, dp))
               between%p(n*k + 1:n*(k + 1)) = (1 - s)*across%p(:n) + s*across%p(n + 1:)
            end associate
         end do
      end if
      call film%evaluate(direction, [fluid], [thick], [spread(gx, 2, intervals + 1)], [spread(gy, 2, intervals + 1)], &
                         at_place, points, between)
      do k = 1, n
         sigma = film%n0*maxval(h(k, :))*abs(merge(gx(k), gy(k), direction == along_x))
         call join(merge(merge(flow_by_gx, flow_by_gy, direction == along_x), flow_q, sigma < slight_stress), &
                   thick(k, :), rho(k, :), at_place(:, k::n), flow(:, k::n))
      end do
   end subroutine fit_flows

   !> The same of one face.
   pure subroutine join(told, film, rho, places, nodes)
      integer, intent(in) :: told                   !! which value has the ratio of the flows
      real(dp), intent(in) :: film(0:), rho(2)      !! H at the places; the density at both nodes
      real(dp), intent(in) :: places(:, 0:)         !! (flow_values, 0:intervals)
      real(dp), intent(out) :: nodes(:, :)          !! (flow_values, 2)
      real(dp), dimension(0:ubound(places, 2)) :: q, share
      real(dp) :: flow, h(2), part(2), sum_h
      integer :: k, n

      n = ubound(places, 2)
      q = places(told, :)/film**3
      h = [film(0), film(n)]
      sum_h = sum(h)
      share = mean_shares(q)
      share = 2*product(h)**2/sum_h*share/film**3
      flow = dot_product(share, places(flow_q, :))
      nodes = 0
      do k = 0, n
         part = [n - k, k]/real(n, dp)
         nodes(flow_by_ln_eta, :) = nodes(flow_by_ln_eta, :) + part*share(k)*places(flow_by_ln_eta, k)
         nodes(flow_by_p, :) = nodes(flow_by_p, :) + part*share(k)*places(flow_by_p, k)
         nodes(flow_by_h, :) = nodes(flow_by_h, :) &
                               + part*share(k)*(places(flow_by_h, k) - 3*places(flow_q, k)/film(k))
         nodes(flow_by_gx, :) = nodes(flow_by_gx, :) + 0.5_dp*share(k)*places(flow_by_gx, k)
         nodes(flow_by_gy, :) = nodes(flow_by_gy, :) + 0.5_dp*share(k)*places(flow_by_gy, k)
      end do
      nodes(flow_by_h, :) = nodes(flow_by_h, :) + flow*(2/h - 1/sum_h)
      do k = 1, 2
         nodes(:, k) = nodes(:, k)*sum(rho)/rho(k)
      end do
      nodes(flow_q, :) = flow
   end subroutine join

   !> The derivatives of a mean of flows at places evenly between two by each of them; their sum, weighted by the flows, is
   !> the mean. That of both halves, L_2, and that of the whole, L_1, leave L_2^(4/3)/L_1^(1/3) exact to fourth order.
   pure function mean_shares(q) result(share)
      real(dp), intent(in) :: q(0:2)
      real(dp) :: share(0:2)
      real(dp) :: by(2), halves(0:2), mean, whole

      share = [1.0_dp, 4.0_dp, 1.0_dp]/6
      if (.not. min(q(0)*q(1), q(1)*q(2)) > 0) return
      call logarithmic_mean(abs(q(0)), abs(q(2)), whole, by(1), by(2))
      share = -[by(1), 0.0_dp, by(2)]/3
      halves = 0
      call logarithmic_mean(abs(q(0)), abs(q(1)), mean, by(1), by(2))
      halves(:1) = 0.5_dp*mean*by
      call logarithmic_mean(abs(q(1)), abs(q(2)), mean, by(1), by(2))
      halves(1:) = halves(1:) + 0.5_dp*mean*by
      share = share + 4*halves/(3*sum(halves))
      share = share*sum(halves)*(sum(halves)/whole)**(1/3.0_dp)/abs(q)
   end function mean_shares

end module ehlwave_fitted_mean
