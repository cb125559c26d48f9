!> A contact as it would be with other input, on the grid of the one at hand. Derivatives by input keys are difference
!> quotients of residuals and results between such variants.
module ehlwave_contact_variant
   use ehlwave_conditions, only: conditions_t
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_grid, only: grid_t
   use ehlwave_inlet_oil, only: inlet_oil_t
   use ehlwave_kinds, only: dp
   use ehlwave_rheology, only: rheology_t
   use ehlwave_touching_data, only: touching_data_t
   use ehlwave_waviness, only: waviness_t
   implicit none (type, external)
   private
   public :: central_places, one_sided_places

   integer, parameter, public :: variable_length = 32   !! longest name of a variable

   !> Centred differences, and second-order differences at the end of a range.
   real(dp), parameter :: central_places(2) = [1.0_dp, -1.0_dp], central_weights(2) = [0.5_dp, -0.5_dp]
   real(dp), parameter :: one_sided_places(3) = [0.0_dp, 1.0_dp, 2.0_dp], &
                          one_sided_weights(3) = [-1.5_dp, 2.0_dp, -0.5_dp]

   !> One point of a difference quotient.
   type, public :: contact_variant_t
      real(dp) :: place = 0               !! change of x
      real(dp) :: weight = 0              !! weight of the differentiated quantity
      type(conditions_t) :: conditions
      type(rheology_t) :: rheology
      type(inlet_oil_t) :: inlet
      type(waviness_t), allocatable :: waves(:)   !! waves of the rough surfaces
      type(touching_data_t) :: touching
      real(dp) :: natural_frequency = 0
   end type contact_variant_t

   !> A variable x, the logarithm of a positive input or of its modulus.
   type, public :: contact_variable_t
      character(len=variable_length) :: name = ''
      logical :: is_of_waves = .false.       !! the steady state does not depend on it
      logical :: changes_kernel = .false.    !! the ellipticity depends on it
      type(contact_variant_t), allocatable :: variants(:)
   contains
      procedure :: place_variants
      procedure :: stand_in
      procedure :: give_back
   end type contact_variable_t

contains

   !> Variants of which the last entries are still to be set: on both sides, or on one side (side = 1 or -1).
   pure subroutine place_variants(self, step, side)
      class(contact_variable_t), intent(inout) :: self
      real(dp), intent(in) :: step
      integer, intent(in) :: side            !! 0: both

      if (allocated(self%variants)) deallocate (self%variants)
      if (side == 0) then
         allocate (self%variants(size(central_places)))
         self%variants%place = step*central_places
         self%variants%weight = central_weights/step
      else
         allocate (self%variants(size(one_sided_places)))
         self%variants%place = side*step*one_sided_places
         self%variants%weight = one_sided_weights/(side*step)
      end if
   end subroutine place_variants

   !> The problem of a variant. It borrows the deformation of the present problem, if the kernel is the same, until
   !> `give_back`.
   subroutine stand_in(self, k, problem, other)
      class(contact_variable_t), intent(in) :: self
      integer, intent(in) :: k                          !! variant
      type(contact_problem_t), intent(inout) :: problem
      type(contact_problem_t), intent(inout) :: other

      associate (variant => self%variants(k))
         if (self%changes_kernel) then
            if (allocated(other%deformation)) deallocate (other%deformation)
            call other%init(problem%grid, variant%conditions, variant%rheology)
         else
            call move_alloc(problem%deformation, other%deformation)
            other%grid = problem%grid
            call other%set_conditions(variant%conditions, variant%rheology)
         end if
      end associate
   end subroutine stand_in

   !> Return the deformation.
   subroutine give_back(self, problem, other)
      class(contact_variable_t), intent(in) :: self
      type(contact_problem_t), intent(inout) :: problem, other
      if (self%changes_kernel) return
      call move_alloc(other%deformation, problem%deformation)
   end subroutine give_back

end module ehlwave_contact_variant
