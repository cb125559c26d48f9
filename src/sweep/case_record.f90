!> The record of a case in the store of a sweep: all quantities of its report, place and time of its run.
module ehlwave_case_record
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_case_text, only: input_identity
   use ehlwave_clock, only: time_stamp
   use ehlwave_errors, only: error_t
   use ehlwave_field_file, only: write_case_file
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_quantities, only: add_result
   use ehlwave_quantity, only: quantity_list_t
   use ehlwave_store, only: store_t
   implicit none (type, external)
   private
   public :: make_record, store_result

contains

   !> The quantities of a record.
   subroutine make_record(case, plan, identity, result, store, started, finished, list)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      character(len=*), intent(in) :: identity
      type(case_result_t), intent(in) :: result
      class(store_t), intent(in) :: store          !! store of the present rank
      character(len=*), intent(in) :: started, finished
      type(quantity_list_t), intent(inout) :: list   !! may be that of another case: its memory serves again
      list%count = 0
      call add_result(list, case, plan, result, identity)
      call list%add('host', 'machine the case ran on', trim(store%host))
      call list%add('rank', 'MPI rank the case ran on, -1: not run', store%rank)
      call list%add('started', 'local time', trim(started))
      call list%add('finished', 'local time', trim(finished))
   end subroutine make_record

   !> Store a case that is done: all that its report offers, and where and when it ran.
   subroutine store_result(case, plan, input, result, started, store, error)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      character(len=*), intent(in) :: input      !! effective input of the case
      type(case_result_t), intent(in) :: result
      character(len=*), intent(in) :: started
      class(store_t), intent(inout) :: store
      type(error_t), allocatable, intent(inout) :: error
      type(quantity_list_t), save :: record

      if (case%fields) call write_case_file(store%fields_path(input_identity(input)), case, plan, result, error)
      call make_record(case, plan, input_identity(input), result, store, started, time_stamp(), record)
      call store%keep(record, input, error)
   end subroutine store_result

end module ehlwave_case_record
