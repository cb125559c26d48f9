!> Keeps the results file of a sweep up to date with its store.
module ehlwave_results_writer
   use, intrinsic :: iso_fortran_env, only: output_unit
   use ehlwave_case_text, only: input_identity
   use ehlwave_clock, only: time_stamp, wall_seconds
   use ehlwave_errors, only: error_t
   use ehlwave_kinds, only: dp
   use ehlwave_results_file, only: write_results
   use ehlwave_store_contents, only: contents_t, read_store
   use ehlwave_sweep_cases, only: sweep_t
   use ehlwave_terminal, only: say
   implicit none (type, external)
   private

   real(dp), parameter :: shortest_interval_s = 60
   real(dp), parameter :: intervals_per_write = 50   !! so writing takes at most 2 per cent of the time of rank 0

   type, public :: results_writer_t
      type(sweep_t), pointer :: sweep => null()
      character(len=:), allocatable :: sweep_text        !! the sweep file as it was
      character(len=:), allocatable :: folder            !! the store
      integer :: ranks = 1
      real(dp), private :: last_s = 0, interval_s = shortest_interval_s
      integer, private :: done = -1                      ! finished cases when it was written last
   contains
      procedure :: renew
      procedure :: write => write_now
   end type results_writer_t

contains

   !> Write the file when some time has passed and cases have been finished since it was written.
   subroutine renew(self, done)
      class(results_writer_t), intent(inout) :: self
      integer, intent(in) :: done                        !! finished cases
      type(contents_t) :: contents
      type(error_t), allocatable :: error
      real(dp) :: now

      now = wall_seconds()
      if (self%last_s <= 0) self%last_s = now
      if (done == self%done .or. now - self%last_s < self%interval_s) return
      self%done = done
      call self%write(contents, error)
      if (allocated(error)) call say(output_unit, time_stamp()//' '//error%message)
   end subroutine renew

   !> Write the file from the content of the store, which is returned.
   subroutine write_now(self, contents, error)
      class(results_writer_t), intent(inout) :: self
      type(contents_t), intent(out) :: contents
      type(error_t), allocatable, intent(inout) :: error
      real(dp) :: start

      start = wall_seconds()
      call read_store(self%folder, input_identity, contents, error, ranks_of_last_run=self%ranks)
      if (.not. allocated(error)) call write_results(self%sweep%output, self%sweep_text, self%sweep, contents, error)
      self%last_s = wall_seconds()
      self%interval_s = max(shortest_interval_s, intervals_per_write*(self%last_s - start))
   end subroutine write_now

end module ehlwave_results_writer
