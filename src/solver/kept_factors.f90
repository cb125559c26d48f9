!> Decision whether factors of an earlier linear system precondition another: they are kept while they save work.
module ehlwave_kept_factors
   use ehlwave_kinds, only: dp
   implicit none (type, external)
   private

   integer, parameter :: first = 1, later = 2    !! systems of a nonlinear solution
   real(dp), parameter :: memory = 0.5_dp        !! weight of all earlier savings against the last

   !> Account of the last factors. Old factors take more GMRES steps than new ones. A solve loses the work of these
   !> steps. Factors are made anew as soon as a solve loses more than the mean loss of all solves with these factors,
   !> where making them counts as the loss of the first: the rule for the least mean cost of parts that wear.
   type, public :: kept_factors_t
      logical, private :: may_keep = .false.     ! factors from system to system
      integer, private :: level = 0              ! of the factors; 0: none to be kept
      integer, private :: solves = 0             ! linear systems that they served
      integer, private :: system = first         ! the next of a nonlinear solution
      real(dp), private :: saved(first:later) = 0   ! operations, by keeping factors for such systems; latest count most
      real(dp), private :: speed = 0             ! decades of the residual in an operation, when they were new
      real(dp), private :: making = 0, loss = 0  ! operations: making them; these and all lost since
   contains
      procedure :: begin
      procedure :: serve
      procedure :: worth
      procedure :: note_new
      procedure :: note_old
   end type kept_factors_t

contains

   !> Begin a nonlinear solution. Factors of the solution before are kept if they may, and if such factors have not
   !> failed the first system since they last might not.
   pure subroutine begin(self, may_keep)
      class(kept_factors_t), intent(inout) :: self
      logical, intent(in) :: may_keep
      self%system = first
      self%may_keep = may_keep
      if (.not. may_keep) self%level = 0
      if (.not. may_keep) self%saved = 0
   end subroutine begin

   !> Whether there are factors that are kept for a system of this level.
   pure logical function serve(self, level)
      class(kept_factors_t), intent(in) :: self
      integer, intent(in) :: level
      serve = self%may_keep .and. self%level == level .and. self%saved(self%system) >= 0
   end function serve

   !> Operations of a solve to a reduction, beyond which the kept factors lose more than they may.
   pure real(dp) function worth(self, reduction)
      class(kept_factors_t), intent(in) :: self
      real(dp), intent(in) :: reduction          !! residual after it over the residual before
      worth = decades(reduction)/self%speed + self%loss/self%solves
   end function worth

   !> Take account of a system that was solved with new factors.
   pure subroutine note_new(self, level, factor_work, solve_work, reduction)
      class(kept_factors_t), intent(inout) :: self
      integer, intent(in) :: level               !! level of the system; 0: the factors are useless
      real(dp), intent(in) :: factor_work        !! operations that made them
      real(dp), intent(in) :: solve_work         !! operations of the solve
      real(dp), intent(in) :: reduction          !! residual after it over that before
      self%level = level
      self%solves = 1
      self%system = later
      self%making = factor_work
      self%loss = factor_work
      self%speed = decades(reduction)/max(1.0_dp, solve_work)
   end subroutine note_new

   !> Take account of a system that was solved with the kept factors.
   pure subroutine note_old(self, solve_work, reduction)
      class(kept_factors_t), intent(inout) :: self
      real(dp), intent(in) :: solve_work         !! operations of the solve
      real(dp), intent(in) :: reduction          !! residual after it over the residual before
      real(dp) :: lost

      lost = max(0.0_dp, solve_work - decades(reduction)/self%speed)
      if (lost*self%solves > self%loss) self%level = 0
      self%saved(self%system) = memory*self%saved(self%system) + self%making - lost
      self%system = later
      self%loss = self%loss + lost
      self%solves = self%solves + 1
   end subroutine note_old

   !> Decades that a reduction spans.
   elemental real(dp) function decades(reduction)
      real(dp), intent(in) :: reduction
      decades = -log10(min(1.0_dp, max(tiny(1.0_dp), reduction)))
   end function decades

end module ehlwave_kept_factors
