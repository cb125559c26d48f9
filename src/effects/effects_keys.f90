!> The list of effects in the input of a case. A new effect is a component and a line of `effect`.
module ehlwave_effects_keys
   use ehlwave_effect_keys, only: effect_keys_t
   use ehlwave_heat_keys, only: heat_keys_t
   use ehlwave_key_list, only: key_list_t
   use ehlwave_second_surface_keys, only: second_surface_keys_t
   use ehlwave_starvation_keys, only: starvation_keys_t
   use ehlwave_touching_keys, only: touching_keys_t
   implicit none (type, external)
   private

   integer, parameter, public :: effect_count = 4

   type, public :: effects_keys_t
      type(heat_keys_t) :: heat
      type(touching_keys_t) :: touching
      type(second_surface_keys_t) :: second
      type(starvation_keys_t) :: starvation
   contains
      procedure :: effect
      procedure :: visit
      procedure :: refuse
      procedure :: changing
      procedure :: are_warm
      procedure, nopass :: mandatory_key
   end type effects_keys_t

contains

   !> Effect number k.
   function effect(self, k) result(one)
      class(effects_keys_t), target :: self
      integer, intent(in) :: k
      class(effect_keys_t), pointer :: one
      select case (k)
      case (1); one => self%heat
      case (2); one => self%touching
      case (3); one => self%second
      case default; one => self%starvation
      end select
   end function effect

   !> See the keys of the effects that follow a group.
   subroutine visit(self, group, list)
      class(effects_keys_t), intent(inout), target :: self
      character(len=*), intent(in) :: group
      type(key_list_t), intent(inout) :: list
      class(effect_keys_t), pointer :: one
      integer :: k
      do k = 1, effect_count
         one => self%effect(k)
         if (one%follows() == group) call one%visit(list)
      end do
   end subroutine visit

   !> Whether an effect of the case refuses a method.
   logical function refuse(self, method)
      class(effects_keys_t), intent(in), target :: self
      integer, intent(in) :: method
      class(effect_keys_t), pointer :: one
      integer :: k
      refuse = .false.
      do k = 1, effect_count
         one => self%effect(k)
         if (one%is_given()) refuse = refuse .or. one%refuses(method)
      end do
   end function refuse

   !> Name of a part that changes in a march, so that more than waves moves the film; '': none.
   function changing(self) result(name)
      class(effects_keys_t), intent(in), target :: self
      character(len=:), allocatable :: name
      class(effect_keys_t), pointer :: one
      integer :: k
      name = ''
      do k = 1, effect_count
         one => self%effect(k)
         if (name == '') name = one%changing()
      end do
   end function changing

   !> Whether an effect of the case finds temperatures.
   logical function are_warm(self)
      class(effects_keys_t), intent(in), target :: self
      class(effect_keys_t), pointer :: one
      integer :: k
      are_warm = .false.
      do k = 1, effect_count
         one => self%effect(k)
         if (one%is_given()) are_warm = are_warm .or. one%finds_temperatures()
      end do
   end function are_warm

   !> Name of the key without which the group of effect number k is a mistake; '': none.
   function mandatory_key(k) result(name)
      integer, intent(in) :: k
      character(len=:), allocatable :: name
      type(effects_keys_t), target :: effects
      class(effect_keys_t), pointer :: one
      one => effects%effect(k)
      name = one%mandatory_key()
   end function mandatory_key

end module ehlwave_effects_keys
