!> Sensitivities of a case to its oil: of the smooth film and, where there is one, of the linear response.
module ehlwave_sensitivity_case
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_kinds, only: dp
   use ehlwave_oil_sensitivity, only: differentiate_response
   use ehlwave_shared_steady, only: shared_steady_t
   use ehlwave_status, only: status_converged
   implicit none (type, external)
   private
   public :: find_film_sensitivities, find_response_sensitivities

contains

   !> d ln H(0,0)/dx of the steady state; one that is not found stays NaN.
   subroutine find_film_sensitivities(case, steady, result)
      type(case_t), intent(in) :: case
      type(shared_steady_t), intent(inout) :: steady
      type(case_result_t), intent(inout) :: result
      integer :: x

      call steady%differentiate(case)
      associate (level => steady%multigrid%levels(size(steady%multigrid%levels)))
         do x = 1, size(steady%by_oil)
            if (steady%by_oil(x)%status == status_converged) result%by_oil(x)%film = &
               level%problem%grid%value_at_centre(steady%by_oil(x)%state%h) &
               /level%problem%grid%value_at_centre(level%state%h)
         end do
      end associate
   end subroutine find_film_sensitivities

   !> d T/dx of the transfer function T from the pattern to H(0,0), and d ln|T|/dx.
   subroutine find_response_sensitivities(steady, response, result)
      type(shared_steady_t), intent(inout) :: steady         !! with the sensitivities of the film
      type(harmonic_response_t), intent(in) :: response      !! its last one, converged
      type(case_result_t), intent(inout) :: result
      type(harmonic_response_t) :: derivative
      integer :: x

      do x = 1, size(steady%by_oil)
         if (steady%by_oil(x)%status /= status_converged) cycle
         call differentiate_response(steady%response, steady%multigrid%levels, response, x, steady%by_oil(x), &
            derivative)
         if (derivative%status /= status_converged) cycle
         result%by_oil(x)%response_real = real(derivative%film, dp)
         result%by_oil(x)%response_imaginary = aimag(derivative%film)
         result%by_oil(x)%response = real(derivative%film/response%film, dp)
      end do
   end subroutine find_response_sensitivities

end module ehlwave_sensitivity_case
