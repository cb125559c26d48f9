!> Cases that only take time.
module synthetic_case
   use ehlwave_case_account, only: blank_result
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_result, only: case_result_t
   use ehlwave_case_text, only: case_identity
   use ehlwave_clock, only: rest_for, wall_seconds
   use ehlwave_kinds, only: dp, i8, pi
   use ehlwave_march_keeper, only: march_keeper_t
   use ehlwave_monitor, only: monitor_t
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_shared_steady, only: shared_steady_t
   use ehlwave_status, only: status_converged
   implicit none (type, external)
   private
   public :: sleep_through

   real(dp), parameter :: spread = 0.5_dp, slice_s = 0.02_dp
   real(dp), public :: mean_s = 0, mean_cost = 1   !! mean time of a case, mean cost of a plan
   real(dp), public :: in_cases = 0                !! time that this rank spent in cases

contains

   !> Substitute for run_case.
   subroutine sleep_through(case, plan, monitor, result, shared, keeper)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(inout) :: plan
      class(monitor_t), intent(inout) :: monitor
      type(case_result_t), intent(out) :: result
      type(shared_steady_t), intent(inout), target, optional :: shared
      class(march_keeper_t), intent(inout), optional :: keeper
      real(dp) :: begin, normal, uniform(2), wanted
      integer(i8) :: bits
      character(len=16) :: identity

      begin = wall_seconds()
      identity = case_identity(case)
      read (identity, '(z16)') bits
      uniform = [ibits(bits, 0, 24) + 1, ibits(bits, 24, 24)]/2.0_dp**24
      normal = sqrt(-2*log(uniform(1)))*cos(2*pi*uniform(2))
      wanted = mean_s*plan%cost/mean_cost*exp(spread*normal - 0.5_dp*spread**2)
      result = blank_result(case, plan)
      do while (wanted > wall_seconds() - begin)
         call rest_for(min(slice_s, wanted - (wall_seconds() - begin)))
         call monitor%step_done('sleep', 1, 1)
      end do
      result%status = status_converged
      result%central_film = uniform(1)
      result%amplitude_ratio = uniform(2)
      result%amplitude_ratio_fit = uniform(2)
      result%seconds = max(1e-6_dp, wall_seconds() - begin)
      in_cases = in_cases + result%seconds
      if (present(keeper)) keeper%seconds_before = 0
      if (present(shared)) shared%has_coarse = .false.
   end subroutine sleep_through

end module synthetic_case

!> A sweep whose cases only take time: measures scheduler and store by themselves, with real MPI and real files.
!>
!>     mpirun -n RANKS synthetic_sweep CASES SECONDS OUTPUT.h5
!>
!> CASES cases over M, wavelength and orientation; a case sleeps (so that there may be more ranks than cores) a time
!> in proportion to the cost of its plan, times a lognormal factor unknown to the plan; SECONDS is the mean, 0: no
!> time at all. Prints the wall time, the time of the cases alone, and the difference.
program synthetic_sweep
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use ehlwave_case_completion, only: complete_case
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_plan, only: make_plan
   use ehlwave_case_text, only: effective_input
   use ehlwave_clock, only: wall_seconds
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_planned_case, only: case_plan_t
   use ehlwave_process, only: end_program
   use ehlwave_sweep_cases, only: sweep_t
   use ehlwave_sweep_job, only: run_job
   use ehlwave_sweep_leader, only: job_options_t
   use ehlwave_text, only: to_text
   use mpi_f08, only: mpi_allreduce, mpi_barrier, mpi_bcast, mpi_comm_rank, mpi_comm_size, mpi_comm_world, &
      mpi_double_precision, mpi_finalize, mpi_init, mpi_sum
   use synthetic_case, only: in_cases, mean_cost, mean_s, sleep_through
   implicit none (type, external)

   character(len=*), parameter :: input_path = 'synthetic_sweep.nml'
   type(sweep_t), target :: sweep
   character(len=256) :: argument
   real(dp) :: cpu_s, cpu_start_s, start, sums(2)
   integer :: cases, code, io, rank, ranks, unit

   call mpi_init()
   call mpi_comm_rank(mpi_comm_world, rank)
   call mpi_comm_size(mpi_comm_world, ranks)
   call get_command_argument(1, argument)
   read (argument, *, iostat=io) cases
   call get_command_argument(2, argument)
   if (io == 0) read (argument, *, iostat=io) mean_s
   call get_command_argument(3, argument)
   if (io /= 0 .or. argument == '') then
      if (rank == 0) write (error_unit, '(a)') 'Usage: synthetic_sweep CASES SECONDS OUTPUT.h5'
      stop 2
   end if
   sweep%output = trim(argument)
   if (rank == 0) then
      open (newunit=unit, file=input_path, status='replace')
      write (unit, '(a)') '&sweep /'
      close (unit)
      call make_cases()
   end if
   call mpi_bcast(mean_cost, 1, mpi_double_precision, 0, mpi_comm_world)
   start = wall_seconds()
   call cpu_time(cpu_start_s)
   call run_job(mpi_comm_world, sleep_through, input_path, sweep, job_options_t(), code)
   call mpi_barrier(mpi_comm_world)
   call cpu_time(cpu_s)
   cpu_s = cpu_s - cpu_start_s
   call mpi_allreduce([in_cases, cpu_s], sums, 2, mpi_double_precision, mpi_sum, mpi_comm_world)
   if (rank == 0) call report(wall_seconds() - start, sums(1), sums(2))
   call mpi_finalize()
   call end_program(code)

contains

   subroutine make_cases()
      character(len=12), parameter :: orientations(3) = [character(len=12) :: 'transverse', 'isotropic', 'longitudinal']
      type(case_t) :: case
      type(case_plan_t) :: plan
      type(error_t), allocatable :: error
      integer :: i
      call sweep%begin(cases, skips_unresolved=.false.)
      do i = 1, cases
         case = case_t()
         case%load_parameter_m = 50 + 0.01_dp*i
         case%lubricant_parameter_l = 12.05_dp
         case%radius_ratio_d = 1
         case%orientation = orientations(1 + modulo(i, 3))
         case%wavelength_over_a = 0.5_dp + 0.25_dp*modulo(i, 11)
         call complete_case(case, 'synthetic', error)
         if (.not. allocated(error)) call make_plan(case, plan, error)
         if (allocated(error)) stop 1
         call sweep%keep(case, plan, effective_input(case))
      end do
      mean_cost = sum(sweep%plans%cost)/cases
   end subroutine make_cases

   subroutine report(wall_s, cases_s, all_cpu_s)
      real(dp), intent(in) :: wall_s, cases_s
      real(dp), intent(in) :: all_cpu_s   !! processor time of all ranks, waiting for messages included
      write (output_unit, '(a)') 'synthetic '//to_text(cases)//' cases, '//to_text(ranks)//' ranks: '//to_text(wall_s, 4)// &
         ' s wall, '//to_text(cases_s, 4)//' s in cases, efficiency '//to_text(cases_s/(ranks*wall_s), 4)// &
         '; per case '//to_text(1e3_dp*wall_s/cases, 4)//' ms wall, '//to_text(1e3_dp*(wall_s*ranks - cases_s)/cases, 4)// &
         ' ms of a rank besides the case, '//to_text(1e3_dp*all_cpu_s/cases, 4)//' ms of processor, '// &
         to_text(1e3_dp*cpu_s/cases, 4)//' of them on rank 0'
   end subroutine report

end program synthetic_sweep
