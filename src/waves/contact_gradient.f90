!> Derivatives of a steady state and of its linear response by input, theory eq. (W10), (W11).
!>
!> With R(u, x) = 0 the steady equations of the state u, x the logarithm of an input, J0 their Jacobian,
!>
!>     du/dx = -J0^(-1) dR/dx.
!>
!> The response u1 solves L(u, x) u1 = r(u, x), so
!>
!>     L du1/dx = -d/dx (L u1 - r),    u1 held, u moving by du/dx.
!>
!> Both right sides are difference quotients of residuals with a step of 1e-5, of second order, which leave about 1e-8
!> of the result. Cavitated nodes stay cavitated. The mesh stays in units of a and b.
!>
!> Many inputs enter by few dimensionless numbers. A right side is reduced by those solved before, and solved only as
!> far as it is not a combination of them (`gradient_basis_t`).
module ehlwave_contact_gradient
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_contact_variant, only: contact_variable_t
   use ehlwave_equations, only: equations_t
   use ehlwave_given, only: given_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_state, only: new_state, state_t
   use ehlwave_status, only: status_converged
   use ehlwave_steady_tangent, only: steady_tangent_t, tangent_change_t
   implicit none (type, external)
   private
   public :: residual_slope, moved_state

   !> Right sides that are solved, orthonormal, and their solutions.
   type, public :: gradient_basis_t
      integer :: solves = 0                                  !! linear solves so far
      real(dp), allocatable, private :: sides(:, :)          ! (n, solved)
      type(tangent_change_t), allocatable, private :: changes(:)
   contains
      procedure :: solve
   end type gradient_basis_t

contains

   !> -dR/dx of the weighted residuals, a right side of `tangent%solve`.
   subroutine residual_slope(tangent, level, variable, flooded_oil, b)
      type(steady_tangent_t), intent(in) :: tangent
      type(level_t), intent(inout) :: level                !! the finest of the tangent; left as it was
      type(contact_variable_t), intent(in) :: variable
      real(dp), intent(in) :: flooded_oil(:)               !! (variants) rho H of the flooded contact's centre
      real(dp), allocatable, target, intent(out) :: b(:)   !! (tangent%linear%n)
      type(contact_problem_t) :: problem
      type(equations_t) :: equations
      type(given_t) :: given
      type(state_t) :: state
      real(dp), pointer, contiguous :: r(:, :)
      real(dp), allocatable :: edge(:)
      integer :: k

      associate (linear => tangent%linear, finest => tangent%linear%levels(tangent%linear%finest))
         allocate (b(linear%n), source=0.0_dp)
         allocate (edge(finest%equations%edges%count()), source=0.0_dp)
         r(0:level%problem%grid%nx, 0:level%problem%grid%ny) => b(:linear%n - 1)
         given = tangent%given
         state = tangent%state
         do k = 1, size(variable%variants)
            associate (variant => variable%variants(k))
               call variable%stand_in(k, level%problem, problem)
               if (variable%changes_kernel) call problem%film(given, state%p, state%delta, state%h)
               if (allocated(given%supply)) given%supply(:) = variant%inlet%supply_on(problem%grid, flooded_oil(k))
               call equations%init(problem)
               call equations%evaluate(problem, given, state)
               r = r - variant%weight*equations%residual
               edge = edge - variant%weight*equations%edge_excess
               b(linear%n) = b(linear%n) - variant%weight*equations%edges%load
               call variable%give_back(level%problem, problem)
            end associate
         end do
         r = merge(0.0_dp, finest%row_scale*r, finest%equations%is_cavitated)
         do k = 1, size(edge)
            r(finest%equations%edges%i(k), finest%equations%edges%j(k)) = edge(k)
         end do
      end associate
   end subroutine residual_slope

   !> The steady state moved along its derivative, in the problem of a variant.
   subroutine moved_state(problem, changes_kernel, given, base, change, place, state)
      type(contact_problem_t), intent(inout) :: problem    !! problem of the variant
      logical, intent(in) :: changes_kernel
      type(given_t), intent(in) :: given
      type(state_t), intent(in) :: base, change            !! u, du/dx
      real(dp), intent(in) :: place                        !! change of x
      type(state_t), intent(inout) :: state

      state = base
      state%p = base%p + place*change%p
      state%delta = base%delta + place*change%delta
      if (changes_kernel) then
         call problem%film(given, state%p, state%delta, state%h)
      else
         state%h = base%h + place*change%h
      end if
   end subroutine moved_state

   !> Change of the state for a right side: from earlier right sides, and a solve of the rest if it exceeds the
   !> tolerance.
   subroutine solve(self, tangent, levels, b, tolerance, change)
      class(gradient_basis_t), intent(inout) :: self
      type(steady_tangent_t), intent(inout) :: tangent
      type(level_t), intent(inout), target :: levels(:)   !! levels of `tangent`
      real(dp), intent(in), contiguous :: b(:)
      real(dp), intent(in) :: tolerance                   !! tolerance of the linear residual
      type(tangent_change_t), intent(out) :: change
      type(tangent_change_t) :: found
      real(dp), allocatable :: rest(:), share(:)
      real(dp) :: length, part
      integer :: i, pass

      if (.not. allocated(self%changes)) allocate (self%changes(0), self%sides(size(b), 0))
      allocate (share(size(self%changes)), source=0.0_dp)
      rest = b
      length = norm2(b)
      do pass = 1, 2
         do i = 1, size(share)
            part = dot_product(self%sides(:, i), rest)
            rest = rest - part*self%sides(:, i)
            share(i) = share(i) + part
         end do
      end do
      change%state = new_state(levels(size(levels))%problem%grid)
      change%state%h = 0
      change%status = status_converged
      do i = 1, size(share)
         call add(share(i), self%changes(i)%state)
      end do
      part = norm2(rest)
      if (.not. part > tolerance*length) return
      call tangent%solve(levels, rest/part, tolerance, found)
      self%solves = self%solves + 1
      change%status = found%status
      if (found%status /= status_converged) return
      call add(part, found%state)
      self%sides = reshape([self%sides, rest/part], [size(b), size(share) + 1])
      self%changes = [self%changes, found]

   contains

      subroutine add(factor, other)
         real(dp), intent(in) :: factor
         type(state_t), intent(in) :: other
         change%state%p = change%state%p + factor*other%p
         change%state%h = change%state%h + factor*other%h
         change%state%delta = change%state%delta + factor*other%delta
      end subroutine add

   end subroutine solve

end module ehlwave_contact_gradient
