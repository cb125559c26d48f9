!> Means between two nodes of the fitted scheme, and the resulting single flow of a shear-thinning oil: theory eq.
!> (D11), (D13).
module ehlwave_fitted_mean
   use ehlwave_film_flow, only: film_flow_t
   use ehlwave_film_rules, only: across_film_t
   use ehlwave_flow_values, only: along_x, flow_by_gx, flow_by_gy, flow_by_h, flow_by_ln_eta, flow_by_p, flow_q, &
      flow_values
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: fit_flows, logarithmic_mean

   integer, parameter, public :: places_of_face = 3   !! where the flow is evaluated: both nodes, and between them
   real(dp), parameter :: part(2, 0:2) = reshape([1.0_dp, 0.0_dp, 0.5_dp, 0.5_dp, 0.0_dp, 1.0_dp], [2, 3])   ! by node

   real(dp), parameter :: alike = 0.02_dp   !! |ln(b/a)| below which a series replaces the mean
   !> |Sigma| below which derivatives give the flows: the ratio of the flows is round-off.
   real(dp), parameter :: slight_stress = 1e-6_dp

contains

   !> Means of exp(t) between ln(a) and ln(b), (b - a)/ln(b/a), and the derivatives of their logarithms by ln(a) and
   !> ln(b).
   pure subroutine logarithmic_mean(n, a, b, mean, by_a, by_b)
      integer, intent(in) :: n
      real(dp), intent(in) :: a(n), b(n)          !! > 0
      real(dp), intent(out) :: mean(n), by_a(n), by_b(n)
      real(dp) :: by_series, difference, ratio(n), series, t, unlike
      integer :: k

      do k = 1, n
         ratio(k) = log(b(k)/a(k))
      end do
      do k = 1, n                                 ! both ways, so that the loop is vectorised
         t = ratio(k)
         series = sqrt(a(k)*b(k))*(1 + t**2*(1/24.0_dp + t**2*(1/1920.0_dp)))
         by_series = 0.5_dp + t*(1/12.0_dp - t**2*(1/720.0_dp))
         unlike = merge(1.0_dp, t, abs(t) < alike)
         difference = merge(1.0_dp, b(k) - a(k), abs(t) < alike)
         mean(k) = merge(series, difference/unlike, abs(t) < alike)
         by_b(k) = merge(by_series, (b(k) - mean(k))/difference, abs(t) < alike)
         by_a(k) = 1 - by_b(k)
      end do
   end subroutine logarithmic_mean

   !> A single flow through each face of a row at the gradient of the face: for each node the flow, and the
   !> derivatives by its own quantities, for densities that weight the nodes.
   pure subroutine fit_flows(film, direction, fluidity, h, gx, gy, rho, flow, points, across)
      type(film_flow_t), intent(in) :: film
      integer, intent(in) :: direction                 !! direction of the faces: along_x or along_y
      real(dp), intent(in) :: fluidity(:, :), h(:, :)  !! eta0/eta and H, (faces, 2) at their nodes
      real(dp), intent(in) :: gx(:), gy(:)             !! dP/dX and kappa dP/dY, (faces)
      real(dp), intent(in) :: rho(:, :)                !! (faces, 2)
      real(dp), intent(out) :: flow(:, :)              !! (flow_values, 2*faces), first nodes first
      integer, intent(out) :: points                   !! see `evaluate` of `film_flow_t`
      type(across_film_t), intent(in), optional :: across   !! P at the nodes, in the order of `flow`
      type(across_film_t), allocatable :: between
      real(dp) :: at_place(flow_values, size(gx)*places_of_face), gradient(size(gx)), thick(size(gx), 0:2)
      integer :: along, k, n

      n = size(gx)
      thick(:, 0) = h(:, 1)
      thick(:, 1) = 0.5_dp*(h(:, 1) + h(:, 2))
      thick(:, 2) = h(:, 2)
      if (present(across)) then
         allocate (between)
         between%p = [across%p(:n), 0.5_dp*(across%p(:n) + across%p(n + 1:)), across%p(n + 1:)]
      end if
      call film%evaluate(direction, [fluidity(:, 1), sqrt(fluidity(:, 1))*sqrt(fluidity(:, 2)), fluidity(:, 2)], &
                         [thick], [gx, gx, gx], [gy, gy, gy], at_place, points, between)
      along = merge(flow_by_gx, flow_by_gy, direction == along_x)
      gradient = merge(gx, gy, direction == along_x)
      do k = 1, n
         call join(merge(along, flow_q, film%n0*maxval(thick(k, :))*abs(gradient(k)) < slight_stress), thick(k, :), &
                   rho(k, :), at_place(:, k::n), flow(:, k::n))
      end do
   end subroutine fit_flows

   !> Join the two nodes of a face.
   pure subroutine join(told, h, rho, places, nodes)
      integer, intent(in) :: told                   !! which value has the ratio of the flows
      real(dp), intent(in) :: h(0:2), rho(2)        !! H at the places; the density at both nodes
      real(dp), intent(in) :: places(:, 0:)         !! (flow_values, 0:2)
      real(dp), intent(out) :: nodes(:, :)          !! (flow_values, 2)
      real(dp) :: ends(2), flow, share(0:2)
      integer :: k

      ends = [h(0), h(2)]
      share = 2*product(ends)**2/(sum(ends)*h**3)*mean_shares(places(told, :)/h**3)
      flow = dot_product(share, places(flow_q, :))
      nodes(flow_by_ln_eta, :) = matmul(part, share*places(flow_by_ln_eta, :))
      nodes(flow_by_p, :) = matmul(part, share*places(flow_by_p, :))
      nodes(flow_by_h, :) = matmul(part, share*(places(flow_by_h, :) - 3*places(flow_q, :)/h)) &
                            + flow*(2/ends - 1/sum(ends))
      nodes(flow_by_gx, :) = 0.5_dp*dot_product(share, places(flow_by_gx, :))
      nodes(flow_by_gy, :) = 0.5_dp*dot_product(share, places(flow_by_gy, :))
      do k = 1, 2
         nodes(flow_q + 1:, k) = nodes(flow_q + 1:, k)*sum(rho)/rho(k)
      end do
      nodes(flow_q, :) = flow
   end subroutine join

   !> Derivatives of the mean (D13) by the averaged values; their sum weighted by these values is the mean. Without
   !> heat all have the same sign; else Simpson's rule gives the weights.
   pure function mean_shares(q) result(share)
      real(dp), intent(in) :: q(0:2)
      real(dp) :: share(0:2)
      real(dp) :: halves(0:2)
      real(dp), dimension(3) :: by_first, by_last, mean      ! of the whole and of both halves

      share = [1.0_dp, 4.0_dp, 1.0_dp]/6
      if (.not. min(q(0)*q(1), q(1)*q(2)) > 0) return
      call logarithmic_mean(3, abs(q([0, 0, 1])), abs(q([2, 1, 2])), mean, by_first, by_last)
      halves = 0.5_dp*[mean(2)*by_first(2), mean(2)*by_last(2) + mean(3)*by_first(3), mean(3)*by_last(3)]
      share = 4*halves/(3*sum(halves)) - [by_first(1), 0.0_dp, by_last(1)]/3
      share = share*sum(halves)*(sum(halves)/mean(1))**(1/3.0_dp)/abs(q)
   end function mean_shares

end module ehlwave_fitted_mean
