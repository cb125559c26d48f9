!> Expected wall time of cases, fitted to those that are finished.
!>
!>     ln(seconds) = a + b ln(cost) + c ln(M) + offset of the kind of run
!>
!> `cost` is the effort of the plan, in node updates. Priors (b = 1, c = 0, no offsets; weights as if known to a
!> factor of e^0.5) keep the fit sane while few cases are finished: ridge regression.
module ehlwave_cost_model
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t, run_harmonic, run_smooth, run_standing
   use ehlwave_small_solve, only: solve_small
   implicit none (type, external)
   private
   public :: cost_features, fit_cost_model

   integer, parameter, public :: feature_count = 6
   real(dp), parameter :: prior(feature_count) = [0.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp]
   real(dp), parameter :: weight(feature_count) = [1e-6_dp, 4.0_dp, 4.0_dp, 4.0_dp, 4.0_dp, 4.0_dp]

   type, public :: cost_model_t
      logical :: is_fitted = .false.                    !! else `seconds` only orders cases
      real(dp) :: coefficients(feature_count) = prior
   contains
      procedure :: seconds
   end type cost_model_t

contains

   !> Features from which the time of a case is predicted.
   pure function cost_features(plan) result(features)
      type(case_plan_t), intent(in) :: plan
      real(dp) :: features(feature_count)
      features = [1.0_dp, log(plan%cost), log(plan%conditions%m), merge(1.0_dp, 0.0_dp, plan%kind == run_smooth), &
                  merge(1.0_dp, 0.0_dp, plan%kind == run_standing), merge(1.0_dp, 0.0_dp, plan%kind == run_harmonic)]
   end function cost_features

   !> Expected wall time in seconds.
   pure real(dp) function seconds(self, features)
      class(cost_model_t), intent(in) :: self
      real(dp), intent(in) :: features(feature_count)
      seconds = exp(min(100.0_dp, max(-100.0_dp, dot_product(self%coefficients, features))))
   end function seconds

   !> Fit to finished cases; cases without a time are left out. Without any, the model is the plan's cost. `expected`
   !> scales it so that both agree on average; they then count as a finished case with an uncertainty factor of 2.
   pure function fit_cost_model(features, seconds, expected) result(model)
      real(dp), intent(in) :: features(:, :)   !! (feature_count, cases)
      real(dp), intent(in) :: seconds(:)       !! wall times
      real(dp), intent(in), optional :: expected(:)   !! wall times that the plans expect; NaN: no model
      type(cost_model_t) :: model
      real(dp), parameter :: weight_of_plans = 2
      ! features of the cases with a model, on average; ln(expected) less prior there
      real(dp) :: middle(feature_count), shift
      real(dp) :: normal(feature_count, feature_count), right(feature_count), difference(feature_count)
      logical :: is_solved
      integer :: i, j

      shift = 0
      middle = 0
      if (present(expected)) then
         do i = 1, size(expected)
            if (.not. ieee_is_finite(expected(i))) cycle
            middle = middle + features(:, i)
            shift = shift + log(expected(i)) - dot_product(prior, features(:, i))
         end do
         if (middle(1) > 0) then                ! their number
            shift = shift/middle(1)
            middle = middle/middle(1)
            model%coefficients(1) = shift
            model%is_fitted = .true.
         end if
      end if
      if (.not. any(seconds > 0)) return
      normal = 0
      do i = 1, feature_count
         normal(i, i) = weight(i)
      end do
      do i = 1, feature_count
         normal(:, i) = normal(:, i) + weight_of_plans*middle*middle(i)
      end do
      right = weight_of_plans*shift*middle     ! for the difference from the prior
      do i = 1, size(seconds)
         if (.not. seconds(i) > 0) cycle
         do j = 1, feature_count
            normal(:, j) = normal(:, j) + features(:, i)*features(j, i)
         end do
         right = right + features(:, i)*(log(seconds(i)) - dot_product(prior, features(:, i)))
      end do
      call solve_small(normal, right, 0.0_dp, difference, is_solved)
      if (.not. is_solved) return
      model%coefficients = prior + difference
      model%is_fitted = .true.
   end function fit_cost_model

end module ehlwave_cost_model
