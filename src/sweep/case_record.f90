!> The record of a case in the store of a sweep: all that its report offers, and where and when it ran.
module ehlwave_case_record
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: case_plan_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_case_text, only: text_identity
   use ehlwave_clock, only: time_stamp
   use ehlwave_errors, only: error_t
   use ehlwave_field_file, only: write_case_file
   use ehlwave_json, only: json_t
   use ehlwave_quantities, only: add_result
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_quantity_output, only: json_of
   use ehlwave_store, only: store_t
   implicit none (type, external)
   private
   public :: case_record, store_result

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

   !> Store a case that is done: all that its report offers, and where and when it ran.
   subroutine store_result(case, plan, input, result, started, store, error)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      character(len=*), intent(in) :: input      !! effective input of the case
      type(case_result_t), intent(in) :: result
      character(len=*), intent(in) :: started
      class(store_t), intent(inout) :: store
      type(error_t), allocatable, intent(inout) :: error
      type(json_t) :: record

      if (case%fields) call write_case_file(store%fields_path(text_identity(input)), case, plan, result, error)
      record = json_of(case_record(case, plan, result, circumstances_t(store%host, store%rank, started, time_stamp())))
      call store%keep(record, input, error)
   end subroutine store_result

end module ehlwave_case_record
