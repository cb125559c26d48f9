!> Derivatives of a linear response by inputs, theory eq. (W11).
!>
!> Inputs enter by few dimensionless numbers: a right side is reduced by those before it, as in
!> `ehlwave_contact_gradient`, and its system is solved for the rest alone.
module ehlwave_response_gradient
   use ehlwave_complex_wedge, only: wedge_t
   use ehlwave_contact_gradient, only: moved_state
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_contact_variant, only: contact_variable_t, contact_variant_t
   use ehlwave_equations, only: equations_t
   use ehlwave_grid, only: grid_t
   use ehlwave_given, only: given_t
   use ehlwave_harmonic_response, only: harmonic_response_t
   use ehlwave_harmonic_solver, only: harmonic_solver_t
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_load_balance, only: harmonic_inertia
   use ehlwave_reynolds, only: reynolds_change
   use ehlwave_state, only: state_t
   use ehlwave_status, only: status_converged
   use ehlwave_steady_tangent, only: tangent_change_t
   use ehlwave_transport, only: harmonic_wedge
   use ehlwave_waviness, only: waviness_t
   implicit none (type, external)
   private
   public :: differentiate_response

   !> Right sides that are solved, orthonormal, and their solutions.
   type, public :: response_basis_t
      integer :: solves = 0                                        !! linear solves so far
      complex(dp), allocatable, private :: sides(:, :)             ! (n, solved)
      type(harmonic_response_t), allocatable, private :: responses(:)
   contains
      procedure :: solve
   end type response_basis_t

contains

   !> du1/dx of the response that `harmonic` found last.
   subroutine differentiate_response(harmonic, levels, response, steps_per_cell, variable, change, flooded_oil, &
                                     basis, derivative)
      type(harmonic_solver_t), intent(inout) :: harmonic   !! about `levels`, with its tangent
      type(level_t), intent(inout), target :: levels(:)
      type(harmonic_response_t), intent(in) :: response    !! u1, converged
      integer, intent(in) :: steps_per_cell                !! as in `respond`
      type(contact_variable_t), intent(in) :: variable     !! x
      type(tangent_change_t), intent(in) :: change         !! du/dx, converged
      real(dp), intent(in) :: flooded_oil(:)               !! as in `residual_slope`
      type(response_basis_t), intent(inout) :: basis       !! of this response
      type(harmonic_response_t), intent(out) :: derivative
      complex(dp), allocatable, target :: b(:)
      complex(dp), allocatable :: dh(:, :), dr(:, :), edge(:), film(:, :), pattern(:, :)
      complex(dp), pointer, contiguous :: r(:, :)
      type(contact_problem_t) :: problem
      type(equations_t) :: equations
      type(given_t) :: given
      type(state_t) :: state
      type(wedge_t) :: wedge
      integer :: i, k

      associate (finest => harmonic%linear%levels(harmonic%linear%finest), level => levels(size(levels)), &
                 n => harmonic%linear%n, tangent => harmonic%tangent)
         allocate (b(n), source=(0.0_dp, 0.0_dp))
         allocate (dh, dr, film, pattern, mold=response%h)
         allocate (edge(finest%equations%edges%count()), source=(0.0_dp, 0.0_dp))
         r(0:ubound(dr, 1), 0:ubound(dr, 2)) => b(:n - 1)
         dh = 0
         given = tangent%given
         do k = 1, size(variable%variants)
            associate (variant => variable%variants(k), w => variable%variants(k)%weight)
               call variable%stand_in(k, level%problem, problem)
               call moved_state(problem, variable%changes_kernel, given, tangent%state, change%state, variant%place, &
                                state)
               if (allocated(given%supply)) given%supply(:) = variant%inlet%supply_on(problem%grid, flooded_oil(k))
               call equations%init(problem)
               call equations%evaluate(problem, given, state)
               pattern = variant%waves%amplitude_at(problem%grid%x, problem%grid%y)
               call film_of(problem, response, film)
               film = film + pattern
               wedge = wedge_of(problem%grid, variant%waves)
               if (allocated(finest%equations%content)) &
                  call wedge%set_content(finest%equations%content%is_partial, finest%equations%content%slope)
               call reynolds_change(equations%mesh, wedge, equations%flow, response%p, film, dr)
               r = r - w*dr
               dh = dh + w*film
               do i = 1, size(edge)
                  associate (x => equations%edges%i(i), y => equations%edges%j(i))
                     edge(i) = edge(i) - w*equations%edge_slope(i)*(film(x, y) - pattern(x, y))
                  end associate
               end do
               if (variant%natural_frequency > 0) b(n) = b(n) - w*response%approach* &
                  harmonic_inertia(variant%natural_frequency, problem%grid%hx/steps_per_cell, variant%waves%frequency())
               call variable%give_back(level%problem, problem)
            end associate
         end do
         r = merge((0.0_dp, 0.0_dp), finest%row_scale*r, finest%equations%is_cavitated)
         do i = 1, size(edge)
            r(finest%equations%edges%i(i), finest%equations%edges%j(i)) = edge(i)
         end do
         call basis%solve(harmonic, levels, b, derivative)
         derivative%h = derivative%h + dh
         call derivative%take_centre(level%problem%grid)
      end associate
   end subroutine differentiate_response

   !> Change of the response for a right side: a sum of earlier ones, and a solve of the rest where that is above the
   !> tolerance.
   subroutine solve(self, harmonic, levels, b, derivative)
      class(response_basis_t), intent(inout) :: self
      type(harmonic_solver_t), intent(inout) :: harmonic
      type(level_t), intent(inout), target :: levels(:)
      complex(dp), intent(in), contiguous :: b(:)
      type(harmonic_response_t), intent(out) :: derivative
      type(harmonic_response_t) :: found
      complex(dp), allocatable :: rest(:), share(:)
      complex(dp) :: part
      real(dp) :: length
      integer :: i, pass

      if (.not. allocated(self%responses)) allocate (self%responses(0), self%sides(size(b), 0))
      allocate (share(size(self%responses)), source=(0.0_dp, 0.0_dp))
      rest = b
      do pass = 1, 2
         do i = 1, size(share)
            part = dot_product(self%sides(:, i), rest)
            rest = rest - part*self%sides(:, i)
            share(i) = share(i) + part
         end do
      end do
      associate (grid => levels(size(levels))%problem%grid)
         allocate (derivative%p(0:grid%nx, 0:grid%ny), derivative%h(0:grid%nx, 0:grid%ny), source=(0.0_dp, 0.0_dp))
      end associate
      derivative%status = status_converged
      do i = 1, size(share)
         call add(share(i), self%responses(i))
      end do
      length = norm2(abs(rest))
      if (.not. length > harmonic%tolerance*norm2(abs(b))) return
      rest = rest/length
      call harmonic%respond_to(levels, rest, found)
      self%solves = self%solves + 1
      derivative%status = found%status
      if (found%status /= status_converged) return
      call add(cmplx(length, 0, dp), found)
      self%sides = reshape([self%sides, rest], [size(b), size(share) + 1])
      self%responses = [self%responses, found]

   contains

      subroutine add(factor, other)
         complex(dp), intent(in) :: factor
         type(harmonic_response_t), intent(in) :: other
         derivative%p = derivative%p + factor*other%p
         derivative%h = derivative%h + factor*other%h
         derivative%approach = derivative%approach + factor*other%approach
      end subroutine add

   end subroutine solve

   !> Wedge and squeeze of the changes by a pattern.
   function wedge_of(grid, waves) result(wedge)
      type(grid_t), intent(in) :: grid            !! the finest
      type(waviness_t), intent(in) :: waves
      type(wedge_t) :: wedge
      wedge = harmonic_wedge(grid, waves%frequency(), grid%hx)
   end function wedge_of

   !> Film of the response without the pattern, in the problem of a variant.
   subroutine film_of(problem, response, film)
      type(contact_problem_t), intent(inout) :: problem
      type(harmonic_response_t), intent(in) :: response
      complex(dp), intent(out) :: film(0:, 0:)
      real(dp), allocatable, dimension(:, :) :: imaginary, p, real_part

      allocate (imaginary, real_part, mold=real(film, dp))
      p = real(response%p, dp)
      call problem%deformation%apply(p, real_part)
      p = aimag(response%p)
      call problem%deformation%apply(p, imaginary)
      film = cmplx(real_part, imaginary, dp) - response%approach
   end subroutine film_of

end module ehlwave_response_gradient
