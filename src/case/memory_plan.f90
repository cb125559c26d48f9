!> Whether a planned case fits into memory.
module ehlwave_memory_plan
   use ehlwave_memory, only: memory_limit_mib
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: memory_shortage

contains

   !> The memory that a case lacks, in words; empty if there is enough. Nothing is allocated: the plan's estimate is
   !> compared with the limit.
   function memory_shortage(plan) result(text)
      class(case_plan_t), intent(in) :: plan
      character(len=:), allocatable :: text
      text = ''
      if (plan%expected_memory_mib() > memory_limit_mib()) text = 'the case needs about '// &
         to_text(nint(plan%expected_memory_mib()))//' MiB of memory, and this process can have '// &
         to_text(nint(memory_limit_mib()))//' MiB: take fewer cells, or raise the limit'
   end function memory_shortage

end module ehlwave_memory_plan
