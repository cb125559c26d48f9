!> The second rough surface in the plan of a case: inputs that contradict it.
module ehlwave_second_surface_plan
   use ehlwave_case_definition, only: case_t
   use ehlwave_effect_plan, only: effect_plan_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   use ehlwave_roughness, only: roughness_t, surface_speed
   implicit none (type, external)
   private

   type, extends(effect_plan_t), public :: second_surface_plan_t
   contains
      procedure, nopass :: check
   end type second_surface_plan_t

contains

   !> Refuse a second surface without a first, and marches in which one of the two stands still: its pattern would never
   !> enter, or be present at once.
   subroutine check(case, error)
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error
      type(roughness_t) :: both(2)
      integer :: n

      if (allocated(error) .or. .not. case%is_pair()) return
      both = case%surfaces()
      if (.not. both(1)%is_rough()) then
         call raise(error, both(2)%given_as()//' without &waviness or &surface: a single rough surface is '// &
            'the first; write it there, with 2 - S for slip_parameter')
      else if (case%response /= 'harmonic') then
         do n = 1, size(both)
            if (.not. allocated(error)) call check_moving(both(n), case%slip_parameter, error)
         end do
      end if
   end subroutine check

   subroutine check_moving(roughness, slip, error)
      type(roughness_t), intent(in) :: roughness
      real(dp), intent(in) :: slip                   !! S
      type(error_t), allocatable, intent(inout) :: error
      character(len=*), parameter :: way = ": take response = 'harmonic', or remove one surface"

      if (.not. surface_speed(roughness%surface, slip) > 0) then
         call raise(error, roughness%given_as()//': the surface stands still (slip_parameter), and marches '// &
            'take pairs of surfaces that both move'//way)
      else if (roughness%is_wavy() .and. .not. roughness%wavelength_x_over_a > 0) then
         call raise(error, roughness%given_as()//': the pattern does not vary along X and stands still; '// &
            'marches take pairs of patterns that both move'//way)
      end if
   end subroutine check_moving

end module ehlwave_second_surface_plan
