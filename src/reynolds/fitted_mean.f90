!> Means of the fitted scheme between two nodes, theory eq. (D11).
module ehlwave_fitted_mean
   use ehlwave_film_flow, only: flow_by_h, flow_q, flow_values
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private
   public :: fit_flows, logarithmic_mean

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

   !> One flow between two nodes in place of that at each of them. Their derivatives by what belongs to a node get the
   !> weight that the sum of both, times their densities, needs.
   pure subroutine fit_flows(along, sigma, h, rho, first, second)
      integer, intent(in) :: along                       !! which derivative is that by the gradient along the face
      real(dp), intent(in) :: sigma                      !! |Sigma| by that gradient
      real(dp), intent(in) :: h(2), rho(2)               !! H and the density at both nodes
      real(dp), intent(inout) :: first(flow_values), second(flow_values)   !! see `ehlwave_film_flow`
      real(dp) :: by(2), flow, mean, q(2), share(2), sum_h
      integer :: told

      told = merge(along, flow_q, sigma < slight_stress)
      q = [first(told), second(told)]/h**3
      share = 0.5_dp
      if (product(sign(1.0_dp, q)) > 0 .and. all(abs(q) > 0)) then
         call logarithmic_mean(abs(q(1)), abs(q(2)), mean, by(1), by(2))
         share = by*mean/abs(q)
      end if
      sum_h = sum(h)
      share = share*2*product(h)**2/(sum_h*h**3)
      flow = share(1)*first(flow_q) + share(2)*second(flow_q)
      call weigh(first, 1)
      call weigh(second, 2)

   contains

      pure subroutine weigh(of_node, n)
         real(dp), intent(inout) :: of_node(:)
         integer, intent(in) :: n
         real(dp) :: by_h
         by_h = flow*(2/h(n) - 1/sum_h) - 3*share(n)*of_node(flow_q)/h(n) + share(n)*of_node(flow_by_h)
         of_node = share(n)*of_node*(rho(1) + rho(2))/rho(n)
         of_node(flow_by_h) = by_h*(rho(1) + rho(2))/rho(n)
         of_node(flow_q) = flow
      end subroutine weigh

   end subroutine fit_flows

end module ehlwave_fitted_mean
