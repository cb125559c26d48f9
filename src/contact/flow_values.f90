!> The flow of a place and its derivatives, in the units of the Reynolds equation, from the stress across its film.
!>
!>     Qhat = (H^2/(eta lambdabar)) (3/(2 N0)) integral zeta s sigma dzeta
!>
!> theory eq. (S4), with B and Sigma functions of ln(eta), H, the gradients and P.
module ehlwave_flow_values
   use ehlwave_film_stress, only: film_stress_t
   use ehlwave_kinds, only: dp
   use ehlwave_shear_limit, only: shear_limit_t
   use ehlwave_shear_moments, only: block_size
   implicit none (type, external)
   private
   public :: take_flow, take_limit

   integer, parameter, public :: along_x = 1, along_y = 2   !! components of the flow
   integer, parameter, public :: flow_values = 6            !! number of flow values at a place:
   integer, parameter, public :: flow_q = 1                 !! Qhat,
   integer, parameter, public :: flow_by_ln_eta = 2         !! its derivatives by ln(eta), H, g_x and g_y
   integer, parameter, public :: flow_by_h = 3
   integer, parameter, public :: flow_by_gx = 4
   integer, parameter, public :: flow_by_gy = 5
   integer, parameter, public :: flow_by_p = 6              !! derivative by P, which limits the stress

contains

   !> Flow and its derivatives at the places of a block.
   pure subroutine take_flow(component, stress, n0, lambdabar, fluidity, h, flow)
      integer, intent(in) :: component                          !! along_x or along_y
      class(film_stress_t), intent(in) :: stress                !! solved
      real(dp), intent(in) :: n0, lambdabar                     !! N0, dimensionless speed
      real(dp), intent(in) :: fluidity(stress%n), h(stress%n)   !! eta0/eta, H > 0
      real(dp), intent(out) :: flow(block_size, flow_values)    !! flow values of the places of the block
      real(dp) :: b_by_b, scale, unit
      integer :: j

      unit = 3/(lambdabar*n0)
      associate (s => stress, by_sigma => stress%flow_by_sigma)
         do j = 1, stress%n
            scale = unit*h(j)**2*fluidity(j)
            b_by_b = s%b(j)*s%flow_by_b(j, component)
            flow(j, flow_q) = scale*s%flow(j, component)
            flow(j, flow_by_ln_eta) = scale*(b_by_b - s%flow(j, component))
            flow(j, flow_by_h) = scale/h(j)*(2*s%flow(j, component) - b_by_b &
                                             + by_sigma(j, component, 1)*s%sigma(j, 1) &
                                             + by_sigma(j, component, 2)*s%sigma(j, 2))
            flow(j, flow_by_gx) = scale*n0*h(j)*by_sigma(j, component, 1)
            flow(j, flow_by_gy) = scale*n0*h(j)*by_sigma(j, component, 2)
            flow(j, flow_by_p) = merge(scale, 0.0_dp, allocated(stress%limit))   ! a factor of it, see `take_limit`
         end do
      end associate
   end subroutine take_flow

   !> Derivative by P of the flow at the places of a block, by the limit alone. After `take_flow`.
   pure subroutine take_limit(component, stress, limit, p, flow)
      integer, intent(in) :: component
      class(film_stress_t), intent(in) :: stress
      type(shear_limit_t), intent(in) :: limit
      real(dp), intent(in) :: p(stress%n)                    !! P
      real(dp), intent(inout) :: flow(block_size, flow_values)
      real(dp) :: by_p, by_sigma2, inverse
      integer :: j
      do j = 1, stress%n
         call limit%inverse_square(p(j), sum(stress%sigma(j, :)**2), inverse, by_p, by_sigma2)
         flow(j, flow_by_p) = flow(j, flow_by_p)*stress%flow_by_limit(j, component)*by_p
      end do
   end subroutine take_limit

end module ehlwave_flow_values
