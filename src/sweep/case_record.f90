!> The record of a case in the store of a sweep: all that its report offers, and where and when it ran.
module ehlwave_case_record
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: case_plan_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_quantities, only: add_result
   use ehlwave_quantity, only: quantity_list_t
   implicit none (type, external)
   private
   public :: case_record

   !> Where and when a case ran.
   type, public :: circumstances_t
      character(len=256) :: host = ''
      integer :: rank = -1
      character(len=24) :: started = '', finished = ''
   end type circumstances_t

contains

   !> The quantities of a record.
   function case_record(case, plan, result, circumstances) result(list)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(case_result_t), intent(in) :: result
      type(circumstances_t), intent(in) :: circumstances
      type(quantity_list_t) :: list
      call add_result(list, case, plan, result)
      call list%add('host', 'machine the case ran on', trim(circumstances%host))
      call list%add('rank', 'MPI rank the case ran on, -1: not run', circumstances%rank)
      call list%add('started', 'local time', trim(circumstances%started))
      call list%add('finished', 'local time', trim(circumstances%finished))
   end function case_record

end module ehlwave_case_record
