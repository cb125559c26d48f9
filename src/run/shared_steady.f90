!> Steady state of a contact and the linear systems about it, shared by all its patterns.
module ehlwave_shared_steady
   use ehlwave_bare_result, only: of_rolling_coefficient, of_rolling_force
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_text, only: effective_input
   use ehlwave_contact_variant, only: contact_variable_t
   use ehlwave_effects_result, only: effects_result_t
   use ehlwave_energy, only: energy_t
   use ehlwave_full_multigrid, only: full_multigrid_t
   use ehlwave_grid, only: grid_t, new_grid, new_line_grid
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_harmonic_solver, only: harmonic_solver_t, least_in_single
   use ehlwave_kinds, only: dp
   use ehlwave_memory, only: many_nodes
   use ehlwave_planned_case, only: case_plan_t, run_harmonic
   use ehlwave_rescue, only: rescue_t, rung_direct
   use ehlwave_rolling_result, only: rolling_result_t
   use ehlwave_solve_report, only: solve_limits_t, solve_report_t
   use ehlwave_solver_choice, only: init_multigrid, method_t
   use ehlwave_status, only: status_converged
   use ehlwave_steady_gradient, only: steady_gradient_t
   use ehlwave_text, only: to_text
   use ehlwave_waviness, only: waviness_t
   implicit none (type, external)
   private
   public :: adjoint_tolerance, grid_of, limits_of, steady_key

   !> It owns the hierarchy. Such a large object is a `class` here and where it is declared: for a `type` gfortran
   !> writes copies and ends of all its parts into each procedure, which compiles three times as long.
   type, public :: shared_steady_t
      type(full_multigrid_t) :: multigrid
      type(energy_t) :: energy                       !! energy equation of the steady state, with heat
      type(rolling_result_t) :: rolling              !! its resistance to rolling
      type(rescue_t) :: rescue                       !! as the steady state left it, for later parts of a case
      class(harmonic_solver_t), allocatable :: response          !! about the finest level
      type(steady_gradient_t) :: gradient            !! gradient of its state, see `differentiate`
      class(harmonic_solver_t), allocatable :: coarse_response   !! about the next coarser state, if `has_coarse`
      logical :: has_coarse = .false.
      integer :: most_nodes = many_nodes             !! above which linear systems are not kept side by side
      real(dp) :: work = 0                           !! operations that the steady state took
      type(effects_result_t) :: effects              !! effects of the steady state
      real(dp), private :: linear_work = 0   ! work of linear systems kept with it
      real(dp), private :: kept_work = 0, mark = 0   ! work by other cases for the present one; count at its start
      logical, private :: is_linearised = .false., is_differentiated = .false.
      character(len=:), allocatable, private :: key  ! key of the steady state held, if reusable
   contains
      procedure :: prepare
      procedure :: work_so_far
      procedure :: linearise
      procedure :: respond_coarsely
      procedure :: make_room
      procedure :: differentiate
   end type shared_steady_t

   ! Tolerance of the levels below the finest. A first guess needs 1e-3; the error estimate needs the discretisation
   ! error of these levels alone (M = 20, D = 0.35 on 512^2: 1e-3 leaves 4e-4 of H(0,0), ten times the error of the
   ! finest).
   real(dp), parameter :: coarse_tolerance = 1e-5_dp

   real(dp), parameter :: loosest = 1e-6_dp, tightest = 1e-10_dp   !! tolerances of transposed systems; rounding
                                                                   !! may not let the residual fall farther

contains

   !> The input on which the steady state of a case depends: all of its input except the waves and their computation;
   !> for a Newtonian oil without heat also except the sliding. Cells, domain and cap on the steps come from the plan.
   function steady_key(case, plan) result(key)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      character(len=:), allocatable :: key
      type(case_t) :: bare, defaults

      bare = case
      bare%orientation = 'none'
      bare%effects%second = defaults%effects%second
      if (plan%rheology%is_newtonian() .and. .not. case%effects%are_warm()) &
         bare%slip_parameter = defaults%slip_parameter   ! else slip thins or warms the oil
      bare%load_balance = defaults%load_balance
      bare%natural_frequency = defaults%natural_frequency
      bare%cells_x = plan%cells_x
      bare%cells_y = plan%cells_y
      key = effective_input(bare)//merge('half ', 'whole', plan%is_half)//to_text(plan%kind)// &
            ' '//to_text(plan%largest_total_steps)//' '//to_text(plan%largest_work)//' '//to_text(plan%domain_scale)
   end function steady_key

   !> Have the steady state of a case in `multigrid` and the account of it in `rescue`: solved now, or kept from a case
   !> that has the same. A state that is going to be marched on from is not kept. The numbers, steps included, do not
   !> depend on which it is.
   subroutine prepare(self, case, plan)
      class(shared_steady_t), intent(inout) :: self
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      character(len=:), allocatable :: key
      integer :: n

      if (.not. allocated(self%response)) allocate (self%response, self%coarse_response)
      key = ''
      if (plan%kind == run_harmonic) key = steady_key(case, plan)
      if (allocated(self%key) .and. len(key) > 0) then
         if (self%key == key .and. serves(self, plan)) then
            self%kept_work = self%work
            self%mark = self%multigrid%work()
            ! the film of a Newtonian oil does not depend on sliding, its friction does
            do n = 1, size(self%multigrid%levels)
               self%multigrid%levels(n)%problem%conditions%slip_parameter = plan%conditions%slip_parameter
            end do
            return
         end if
      end if
      self%key = key
      self%is_linearised = .false.
      if (allocated(self%response%tangent)) deallocate (self%response%tangent)
      if (allocated(self%coarse_response%tangent)) deallocate (self%coarse_response%tangent)
      self%is_differentiated = .false.
      call init_multigrid(self%multigrid, plan%conditions, plan%rheology, grid_of(case, plan), &
                          method_t(case%method, case%cycle, plan%deformation))
      self%kept_work = 0
      self%mark = 0
      self%rescue = rescue_t(is_ready=climbs(plan), steps_left=plan%largest_total_steps, work_left=plan%largest_work)
      call self%rescue%solve_steady(self%multigrid, limits_of(case), coarse_tolerance)
      self%effects = effects_result_t()
      call self%effects%solve(case, plan, self%multigrid, self%rescue, limits_of(case), coarse_tolerance, self%energy)
      ! before `linearise` solves the coarser level again, so that kept states have the same error
      self%rolling = rolling_result_t()
      associate (levels => self%multigrid%levels)
         if (levels(size(levels))%report%status == status_converged) &
            call self%rolling%take(levels(size(levels):1:-1))
      end associate
      self%work = self%multigrid%work()
   end subroutine prepare

   !> Operations of the case at hand, as if it had found all itself that was kept for it.
   pure real(dp) function work_so_far(self)
      class(shared_steady_t), intent(in) :: self
      work_so_far = self%kept_work + (self%multigrid%work() - self%mark)
   end function work_so_far

   !> Whether a steady state may be rescued: where the grid does not resolve the case the result is not worth the
   !> effort.
   pure logical function climbs(plan)
      type(case_plan_t), intent(in) :: plan
      climbs = plan%resolution%is_resolved
   end function climbs

   !> Whether the state held is the result of a case of the same key. The waves decide whether the grid resolves a
   !> case, and thus its limit on the ladder; a direct solve is independent of this.
   pure logical function serves(self, plan)
      type(shared_steady_t), intent(in) :: self
      type(case_plan_t), intent(in) :: plan
      associate (report => self%multigrid%levels(size(self%multigrid%levels))%report)
         serves = (self%rescue%rung == rung_direct .and. report%status == status_converged) .or. &
                  (self%rescue%is_ready .eqv. climbs(plan))
      end associate
   end function serves

   !> Linear systems about the steady state, and about the state on the next coarser grid, first solved to the same
   !> tolerance.
   subroutine linearise(self, case, plan)
      class(shared_steady_t), intent(inout) :: self
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(solve_report_t) :: report
      real(dp) :: work_before
      integer :: n

      work_before = self%multigrid%work()
      if (self%is_linearised) then
         if (.not. allocated(self%response%linear%levels)) call self%response%init(self%multigrid%levels)
         self%kept_work = self%kept_work + self%linear_work - (self%multigrid%work() - work_before)   ! counted already
         return
      end if
      n = size(self%multigrid%levels)
      self%has_coarse = n > 1
      if (n > 1 .and. case%effects%are_warm()) self%has_coarse = self%multigrid%levels(n - 1)%has_film()   ! if warm
      if (self%has_coarse) then
         call self%multigrid%solve_level(n - 1, limits_of(case), report)
         self%has_coarse = report%status == status_converged
      end if
      ! nothing nonlinear follows: give the memory back
      if (plan%kind == run_harmonic) deallocate (self%multigrid%solver)
      self%response%tolerance = case%response_tolerance
      self%coarse_response%tolerance = case%response_tolerance
      self%response%in_single = min(case%tolerance, case%response_tolerance) >= least_in_single
      self%coarse_response%in_single = self%response%in_single
      call self%response%init(self%multigrid%levels)
      if (.not. is_large(self)) call self%response%find_tangent(self%multigrid%levels)
      if (self%has_coarse .and. .not. is_large(self)) call self%coarse_response%init(self%multigrid%levels(:n - 1))
      self%is_linearised = .true.
      self%linear_work = self%multigrid%work() - work_before
   end subroutine linearise

   !> Whether the linear systems are too large to be kept side by side.
   pure logical function is_large(self)
      type(shared_steady_t), intent(in) :: self
      is_large = size(self%multigrid%levels(size(self%multigrid%levels))%state%p) > self%most_nodes
   end function is_large

   !> Response of the next coarser level, if `has_coarse`. Of a large grid its system is there for this time only.
   subroutine respond_coarsely(self, waviness, natural_frequency, steps_per_cell, response)
      class(shared_steady_t), intent(inout) :: self
      type(waviness_t), intent(in) :: waviness
      real(dp), intent(in) :: natural_frequency      !! Omega of the equation of motion; 0: force balance
      integer, intent(in) :: steps_per_cell          !! m for dT = hX/m
      type(harmonic_response_t), intent(out) :: response
      associate (levels => self%multigrid%levels(:size(self%multigrid%levels) - 1))
         if (is_large(self)) call self%coarse_response%init(levels)
         call self%coarse_response%respond(levels, waviness, natural_frequency, steps_per_cell, response)
         if (is_large(self)) call self%coarse_response%drop()
      end associate
   end subroutine respond_coarsely

   !> Provide the tangent, for steps after a response. On a large grid it replaces the system of the response, which
   !> the next case makes anew, unless it is still needed.
   subroutine make_room(self, keeps_response)
      class(shared_steady_t), intent(inout) :: self
      logical, intent(in) :: keeps_response
      if (.not. is_large(self)) return
      if (.not. keeps_response) call self%response%drop()
      call self%response%count_tangent(self%multigrid%levels)
   end subroutine make_room

   !> Derivatives of the results of the steady state by variables.
   subroutine differentiate(self, case, variables, is_wanted)
      class(shared_steady_t), intent(inout) :: self
      type(case_t), intent(in) :: case
      type(contact_variable_t), intent(in) :: variables(:)
      logical, intent(in) :: is_wanted(:)   !! results
      integer :: r

      call self%response%find_tangent(self%multigrid%levels)
      associate (gradient => self%gradient, levels => self%multigrid%levels, tangent => self%response%tangent)
         if (self%is_differentiated .and. gradient%serves(variables)) then
            self%kept_work = self%kept_work + gradient%work
         else
            call gradient%find(tangent, levels, self%effects%starvation%flooded, variables, adjoint_tolerance(case))
            self%is_differentiated = .true.
         end if
         do r = 1, size(is_wanted)
            if (.not. is_wanted(r)) cycle
            if (allocated(gradient%adjoints(r)%vector)) then
               self%kept_work = self%kept_work + gradient%adjoints(r)%work
            else if (r == of_rolling_force) then   ! the coefficient times the load, which is given
               gradient%adjoints(r) = gradient%adjoints(of_rolling_coefficient)
               gradient%adjoints(r)%work = 0
            else
               call gradient%solve(tangent, levels, r, adjoint_tolerance(case))
            end if
         end do
      end associate
   end subroutine differentiate

   !> Tolerance of the transposed systems.
   pure real(dp) function adjoint_tolerance(case)
      type(case_t), intent(in) :: case
      adjoint_tolerance = min(loosest, max(tightest, case%tolerance))
   end function adjoint_tolerance

   !> The finest grid.
   pure function grid_of(case, plan) result(grid)
      type(case_t), intent(in) :: case
      type(case_plan_t), intent(in) :: plan
      type(grid_t) :: grid
      if (plan%conditions%is_line()) then
         grid = new_line_grid(plan%x_min, plan%x_max, plan%cells_x)
      else
         grid = new_grid(plan%x_min, plan%x_max, plan%y_max, plan%cells_x, plan%cells_y, plan%is_half)
      end if
      grid%is_flooded = case%edges == 'flooded'
      grid%is_fitted = plan%is_fitted
      ! where surfaces touch, pressures have edges
      grid%has_curved_pressure = plan%is_fitted .and. .not. plan%effects%touching%is_given
   end function grid_of

   !> Tolerance and limits of a steady solution of a case.
   pure function limits_of(case) result(limits)
      type(case_t), intent(in) :: case
      type(solve_limits_t) :: limits
      limits = solve_limits_t(tolerance=case%tolerance, largest_steps=case%largest_steps)
   end function limits_of

end module ehlwave_shared_steady
