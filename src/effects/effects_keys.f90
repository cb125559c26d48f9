!> The list of effects in the input of a case. A new effect is a component and a line of `effect`.
module ehlwave_effects_keys
   use ehlwave_effect_keys, only: effect_keys_t
   use ehlwave_key_list, only: key_list_t
   use ehlwave_starvation_keys, only: starvation_keys_t
   implicit none (type, external)
   private

   integer, parameter, public :: effect_count = 1

   type, public :: effects_keys_t
      type(starvation_keys_t) :: starvation
   contains
      procedure :: effect
      procedure :: visit
      procedure :: refuse
      procedure :: changing
   end type effects_keys_t

contains

   !> Effect number k.
   function effect(self, k) result(one)
      class(effects_keys_t), target :: self
      integer, intent(in) :: k
      class(effect_keys_t), pointer :: one
      select case (k)
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

end module ehlwave_effects_keys
