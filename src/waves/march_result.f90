!> The account of a time march: the history of the contact centre, and the cost.
module ehlwave_march_result
   use ehlwave_kinds, only: dp
   use ehlwave_solve_report, only: solve_report_t
   use ehlwave_status, only: status_converged
   implicit none (type, external)
   private

   !> History of the contact centre and the account of the march.
   type, public :: march_result_t
      integer :: status = status_converged     !! status of the first failed step, else converged
      integer :: steps = 0                     !! steps done
      real(dp), allocatable :: time(:)         !! (0:steps) T
      real(dp), allocatable :: central_film(:) !! (0:steps) H(0,0,T)
      real(dp), allocatable :: approach(:)     !! (0:steps) Delta(T)
      real(dp) :: worst_residual = 0           !! largest over the steps
      real(dp) :: worst_load_error = 0
      integer :: nonlinear_steps = 0, linear_steps = 0, factorisations = 0
      real(dp) :: work = 0                     !! operations, see `ehlwave_work_unit`
   contains
      procedure :: begin
      procedure :: note
      procedure :: count
   end type march_result_t

contains

   !> An empty account of so many steps.
   subroutine begin(self, steps)
      class(march_result_t), intent(out) :: self
      integer, intent(in) :: steps
      allocate (self%time(0:steps), self%central_film(0:steps), self%approach(0:steps), source=0.0_dp)
   end subroutine begin

   !> Record a solution as step k, 0: the start.
   pure subroutine note(self, k, t, central_film, approach)
      class(march_result_t), intent(inout) :: self
      integer, intent(in) :: k
      real(dp), intent(in) :: t, central_film, approach   !! T, H(0,0), Delta
      self%time(k) = t
      self%central_film(k) = central_film
      self%approach(k) = approach
   end subroutine note

   !> Add the cost of a solution; its outcome becomes the outcome of the march.
   pure subroutine count(self, report)
      class(march_result_t), intent(inout) :: self
      type(solve_report_t), intent(in) :: report
      self%nonlinear_steps = self%nonlinear_steps + report%nonlinear_steps
      self%linear_steps = self%linear_steps + report%linear_steps
      self%factorisations = self%factorisations + report%factorisations
      self%status = report%status
      self%worst_residual = max(self%worst_residual, report%residual)
      self%worst_load_error = max(self%worst_load_error, report%load_error)
   end subroutine count

end module ehlwave_march_result
