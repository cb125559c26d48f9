!> One physical effect in the input of a case: its keys, and the methods that it refuses.
module ehlwave_effect_keys
   use ehlwave_key_list, only: key_list_t
   implicit none (type, external)
   private

   ! Methods that an effect may refuse.
   integer, parameter, public :: by_fas = 1            !! FAS multigrid, chosen by the plan
   integer, parameter, public :: by_fitted_scheme = 2  !! fitted scheme of the Reynolds equation
   integer, parameter, public :: by_second_order = 3   !! mean film of small waves, to second order
   integer, parameter, public :: by_long_steps = 4     !! time steps longer than hX, chosen by the plan

   type, abstract, public :: effect_keys_t
   contains
      procedure(follows), deferred, nopass :: follows
      procedure(visit), deferred :: visit
      procedure(is_given), deferred :: is_given
      procedure, nopass :: refuses
      procedure :: changing
      procedure, nopass :: finds_temperatures
      procedure, nopass :: mandatory_key
   end type effect_keys_t

   abstract interface

      !> Name of the group behind which the keys of the effect come.
      pure function follows() result(group)
         character(len=:), allocatable :: group
      end function follows

      !> Enter the group of the effect, and see its keys.
      subroutine visit(self, list)
         import :: effect_keys_t, key_list_t
         class(effect_keys_t), intent(inout) :: self
         type(key_list_t), intent(inout) :: list
      end subroutine visit

      !> Whether the case has the effect.
      elemental logical function is_given(self)
         import :: effect_keys_t
         class(effect_keys_t), intent(in) :: self
      end function is_given

   end interface

contains

   !> Whether a method is not written for the effect.
   pure logical function refuses(method)
      integer, intent(in) :: method
      refuses = .false.
   end function refuses

   !> Name of the part that changes in a march, so that more than waves moves the film; '': none.
   pure function changing(self) result(name)
      class(effect_keys_t), intent(in) :: self
      character(len=:), allocatable :: name
      name = ''
   end function changing

   !> Whether the effect finds temperatures, without which the contact is isothermal.
   pure logical function finds_temperatures()
      finds_temperatures = .false.
   end function finds_temperatures

   !> Name of the key without which the group of the effect is a mistake; '': none.
   pure function mandatory_key() result(name)
      character(len=:), allocatable :: name
      name = ''
   end function mandatory_key

end module ehlwave_effect_keys
