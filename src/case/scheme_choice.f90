!> The scheme of the Reynolds equation of a case: averaged, or fitted to steep inlets, theory eq. (D11), (D12).
module ehlwave_scheme_choice
   use ehlwave_case_definition, only: case_t
   use ehlwave_errors, only: error_t, raise
   implicit none (type, external)
   private
   public :: check_scheme, is_fitted

contains

   !> Refuse the fitted scheme where it is not written.
   subroutine check_scheme(case, error)
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error
      if (case%scheme /= 'fitted' .or. allocated(error)) return
      if (.not. suits(case)) call raise(error, "&solver scheme = 'fitted' is written for Newtonian oils, without "// &
         "heat, in flooded contacts: take 'averaged', or remove the key")
   end subroutine check_scheme

   !> Whether the case has the fitted scheme.
   pure logical function is_fitted(case)
      type(case_t), intent(in) :: case
      is_fitted = case%scheme == 'fitted'
   end function is_fitted

   !> Whether the fitted scheme is written for what the case asks.
   pure logical function suits(case)
      type(case_t), intent(in) :: case
      suits = case%oil%is_newtonian() .and. .not. (case%heat%is_given() .or. case%is_starved() .or. &
                                                   case%oil%shear_limit_over_pressure > 0)
   end function suits

end module ehlwave_scheme_choice
