!> Response of a steady contact to a small harmonic pattern: one complex linear system, no time stepping.
module ehlwave_harmonic_response
   use ehlwave_complex_gmres, only: complex_gmres_t
   use ehlwave_full_multigrid, only: level_t
   use ehlwave_harmonic_system, only: harmonic_system_t
   use ehlwave_kinds, only: dp, pi
   use ehlwave_waviness, only: waviness_t
   implicit none (type, external)
   private

   !> Answer to a pattern of unit amplitude, exp(i (kx X - w T)) times its shape in Y, a crest at the origin at T = 0.
   type, public :: harmonic_response_t
      complex(dp) :: film = 0                        !! amplitude of H(0,0) for a pattern of unit amplitude
      complex(dp) :: approach = 0                    !! that of Delta
      integer :: steps = 0                           !! GMRES steps
      real(dp) :: reduction = 0                      !! what was left of the linear residual
      complex(dp), allocatable :: p(:, :), h(:, :)   !! amplitudes of P and H, (0:nx, 0:ny)
   end type harmonic_response_t

   !> Systems of the grids below one level, linearised about its steady state. They point at each other and at
   !> the levels: declare it a target, do not copy it.
   type, public :: harmonic_solver_t
      real(dp) :: tolerance = 1e-5_dp
      type(harmonic_system_t), allocatable :: systems(:)
      type(complex_gmres_t) :: gmres
   contains
      procedure :: init
      procedure :: respond
   end type harmonic_solver_t

contains

   !> Linearise about the steady state of the finest of `levels`.
   subroutine init(self, levels)
      class(harmonic_solver_t), intent(inout), target :: self
      type(level_t), intent(in), target :: levels(:)
      integer :: l, n

      n = size(levels)
      allocate (self%systems(n))
      do l = 1, n
         call self%systems(l)%init(levels(l)%problem)
         if (l > 1) self%systems(l)%coarser => self%systems(l - 1)
      end do
      call self%systems(n)%linearise(levels(n)%state)
   end subroutine init

   subroutine respond(self, waviness, response)
      class(harmonic_solver_t), intent(inout), target :: self
      type(waviness_t), intent(in) :: waviness
      type(harmonic_response_t), intent(out) :: response
      type(harmonic_system_t), pointer :: system
      complex(dp), allocatable, target :: b(:), x(:)
      complex(dp), allocatable :: g(:, :), dh(:, :)
      complex(dp), pointer, contiguous :: q(:, :)
      real(dp) :: kx

      system => self%systems(size(self%systems))
      kx = 0
      if (waviness%wavelength_x > 0) kx = 2*pi/waviness%wavelength_x
      associate (grid => system%problem%grid)
         allocate (g(0:grid%nx, 0:grid%ny))
         g = waviness%shape_fixed(grid%x, grid%y, 0.0_dp)
         if (kx > 0) g = g - cmplx(0, 1, dp)*waviness%shape_fixed(grid%x, grid%y, 0.5_dp*pi)
         allocate (b(system%n), x(system%n))
         call system%set_frequency(kx*waviness%slip, grid%hx, (0.0_dp, 0.0_dp))
         allocate (dh(0:grid%nx, 0:grid%ny))
         call system%gap_change(g, b)
         call self%gmres%solve(system, b, x, self%tolerance)
         response%steps = self%gmres%steps
         response%reduction = self%gmres%reduction
         q(0:grid%nx, 0:grid%ny) => x(:system%n - 1)
         call system%film_change(q, x(system%n), dh)
         dh = dh + g
         response%film = cmplx(grid%value_at_centre(real(dh, dp)), grid%value_at_centre(aimag(dh)), dp)
         response%approach = x(system%n)
         allocate (response%p, source=q)
         call move_alloc(dh, response%h)
      end associate
   end subroutine respond

end module ehlwave_harmonic_response
