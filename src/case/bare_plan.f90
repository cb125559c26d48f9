!> The plan of one case without its effects: what is computed, on which grid, in how many steps, and why.
module ehlwave_bare_plan
   use ehlwave_accuracy_model, only: expected_film_error, light_error, upstream_error, wave_x_error, &
      wave_y_error
   use ehlwave_case_files, only: case_file_t
   use ehlwave_conditions, only: conditions_t
   use ehlwave_error_parts, only: error_parts_t
   use ehlwave_kinds, only: dp
   use ehlwave_memory, only: many_nodes
   use ehlwave_resolution, only: resolution_t
   use ehlwave_rheology, only: rheology_t
   use ehlwave_surfaces, only: surfaces_t
   use ehlwave_thinning, only: thinning_t
   use ehlwave_work_unit, only: expected_unit_seconds, largest_timed, work_unit_operations
   implicit none (type, external)
   private

   integer, parameter, public :: run_smooth = 1      !! steady state of smooth surfaces only
   integer, parameter, public :: run_standing = 2    !! steady states of a stationary pattern
   integer, parameter, public :: run_march = 3       !! march in time
   integer, parameter, public :: run_harmonic = 4    !! linear response only

   type, public :: bare_plan_t
      type(conditions_t) :: conditions
      type(rheology_t) :: rheology
      type(thinning_t) :: thinning                   !! of the oil
      logical :: is_fitted = .false.                 !! scheme of the Reynolds equation
      real(dp) :: steepness = 1                      !! steepness of the inlet, for the scheme: over a Newtonian oil's
      type(surfaces_t) :: surfaces
      type(case_file_t), allocatable :: files(:)     !! files that cases may read; with digests if this one does
      integer :: kind = run_smooth
      logical :: responds = .false.                  !! the linear response is computed
      logical :: is_by_multigrid = .false.           !! steady states by FAS
      integer :: levels = 0                          !! across the film at which temperatures are found; 0: none
      real(dp) :: bytes_of_effects = 0               !! memory that effects take per cell
      integer :: field_sets = 0                      !! fields over time that are kept
      integer :: threads = 1                         !! threads that share the case; the least a sweep can have
      logical :: is_periodic = .false.               !! the periodic state is sought first; the march is the
                                                     !! is
      logical :: is_half = .true.                    !! only Y >= 0 is computed
      real(dp) :: x_min = 0, x_max = 0, y_max = 0    !! domain; the pattern starts at the x_min of the case whatever it
                                                     !! is
      real(dp) :: domain_scale = 1                   !! over the domain of the case
      real(dp) :: domain_error = 0  !! relative, expected by the edges, for the quantity of expected_error,
      real(dp) :: film_domain_error = 0              !! and of H(0,0)
      integer :: cells_x = 0, cells_y = 0            !! cells of the whole domain; cells_y = 1 for a line contact
      character(len=:), allocatable :: grid_reason
      real(dp) :: hx = 0, hy = 0                     !! hy = 0 of a line contact
      character(len=4) :: deformation = ''           !! 'fft' or 'mlmi'
      integer :: cells_per_step = 1, steps_per_cell = 1
      real(dp) :: dt = 0                             !! time step, 0 without march
      integer :: steps = 0                           !! time steps
      integer :: first_sample = 0                    !! step from which the amplitude is measured,
      logical :: measures = .true.                   !! if the march is long enough for that
      real(dp) :: rest = 0                           !! T from which on effects that change should no longer move the
                                                     !! film
      integer :: largest_total_steps = 0             !! cap on the nonlinear steps of the finest grid,
      real(dp) :: largest_work = huge(1.0_dp)        !! cap on operations where the case gives none, see `cap_work`,
      real(dp) :: largest_work_in_all = huge(1.0_dp)   !! and with finer runs
      integer :: phases = 0                          !! steady solutions of a standing pattern
      type(resolution_t) :: resolution
      type(error_parts_t) :: expected                !! relative errors of Ad/Ai, of smooth contacts of H(0,0); from
                                                     !! models
      real(dp) :: expected_error = 0                 !! sum of mesh, time and tolerance errors
      real(dp) :: expected_work_units = 0            !! counted, without error estimates
      real(dp) :: work_with_estimates = 0            !! work with error estimates: measure of time
      real(dp) :: cost = 0                           !! expected effort, node updates of the finest grid
   contains
      procedure :: expected_film_mesh_error
      procedure :: wave_mesh_error
      procedure :: expected_ratio_mesh_error
      procedure :: expected_work
      procedure :: expected_seconds
      procedure :: has_work_cap
      procedure :: expected_memory_mib
   end type bare_plan_t

contains

   !> Whether the plan sets the cap on the work of a case.
   pure logical function has_work_cap(self)
      class(bare_plan_t), intent(in) :: self
      has_work_cap = self%largest_work < huge(1.0_dp)
   end function has_work_cap

   !> Relative error of H(0,0) of the smooth contact to expect by the mesh.
   pure real(dp) function expected_film_mesh_error(self)
      class(bare_plan_t), intent(in) :: self
      expected_film_mesh_error = self%steepness*expected_film_error(self%conditions, self%hx)
   end function expected_film_mesh_error

   !> Relative error of Ad/Ai by the points on waves; along X it is a part of its own with the fitted scheme.
   pure real(dp) function wave_mesh_error(self)
      class(bare_plan_t), intent(in) :: self
      wave_mesh_error = 0
      if (self%is_fitted .and. self%resolution%points_x > 0) &
         wave_mesh_error = wave_x_error(self%resolution%points_x, self%surfaces%largest_slip())
      if (self%resolution%points_y > 0) wave_mesh_error = wave_mesh_error &
         + wave_y_error(self%resolution%points_y, self%surfaces%largest_slip(), self%is_fitted)
   end function wave_mesh_error

   !> Relative error of Ad/Ai, or of a response, to expect by the mesh.
   pure real(dp) function expected_ratio_mesh_error(self, film)
      class(bare_plan_t), intent(in) :: self
      real(dp), intent(in) :: film         !! H(0,0)
      expected_ratio_mesh_error = self%expected%mesh + light_error(film, self%is_fitted)*self%hx**2
      if (self%is_fitted) expected_ratio_mesh_error = expected_ratio_mesh_error + upstream_error(self%resolution%inlet)
   end function expected_ratio_mesh_error

   !> Operations to expect, error estimates included.
   elemental real(dp) function expected_work(self)
      class(bare_plan_t), intent(in) :: self
      expected_work = self%work_with_estimates*work_unit_operations(self%cells_x, self%cells_y)
   end function expected_work

   !> Run time to expect here and now, from the model of the work and a work unit timed on the spot.
   real(dp) function expected_seconds(self)
      class(bare_plan_t), intent(in) :: self
      expected_seconds = self%work_with_estimates*expected_unit_seconds(self%cells_x, self%cells_y)
   end function expected_seconds

   !> Peak memory of the process to expect, in MiB, without MPI: a constant plus a share per computed cell, more on
   !> finer grids, whose GMRES keeps more vectors; in single precision above `many_nodes`. Measured within an eighth: 64
   !> to 2048 cells along each side, M = 100 and, up to 1024, 1000; smooth, transverse waves of 0.5 a by their response,
   !> and marches.
   pure real(dp) function expected_memory_mib(self)
      class(bare_plan_t), intent(in) :: self
      real(dp), parameter :: program_mib = 17, bytes_smooth = 720, bytes_short = 600, bytes_multigrid = 325, &
         bytes_wavy = 900, bytes_past = 165, &                          ! the last period of waves
         bytes_timing = 64, &                                           ! bytes of a work unit, per timed cell
         bytes_in_parts = 762, &     ! bytes of responses whose linear systems are not kept side by side
         bytes_response = 1710, bytes_line = 2600, bytes_periodic = 1900, &
         bytes_set = 48, &                                              ! three fields, and their file
         bytes_fitted = 215, bytes_faces = 150, &   ! fluxes through faces: of the fitted scheme, of other oils
         bytes_fitted_response = 380                ! more of them in responses
      real(dp), parameter :: thread_mib = 1, bytes_thread = 600   ! rows, columns and lines of its own
      real(dp), parameter :: usual_cells = 256*128, smooth_growth = 0.18_dp, periodic_growth = 0.06_dp
      real(dp) :: bytes, cells, halvings   ! bytes of the mesh of `usual_cells`
      cells = real(self%cells_x, dp)*self%cells_y
      if (self%is_half) cells = cells/2
      halvings = 0.5_dp*log(max(1.0_dp, cells/usual_cells))/log(2.0_dp)
      bytes = merge(bytes_short, bytes_smooth*(1 + smooth_growth*halvings), cells > many_nodes)
      if (self%is_by_multigrid) bytes = bytes_multigrid &
         + bytes_timing*min(real(self%cells_x, dp)*self%cells_y, real(largest_timed, dp))/cells
      if (self%kind /= run_smooth) bytes = max(bytes, bytes_wavy)
      if (self%kind == run_march .and. self%surfaces%repeat_soon()) bytes = bytes + bytes_past
      if (self%is_periodic) bytes = bytes_periodic*(1 + periodic_growth*halvings**2)
      if (self%responds) bytes = max(bytes, bytes_response)
      if (self%responds .and. cells > many_nodes) bytes = bytes_in_parts
      if (self%conditions%is_line()) then
         bytes = bytes_line
         cells = self%cells_x
      end if
      bytes = bytes + self%bytes_of_effects
      if (self%is_fitted) then
         bytes = bytes + bytes_fitted
         if (self%responds .and. cells <= many_nodes) bytes = bytes + bytes_fitted_response
      else if (self%levels > 0 .or. .not. self%rheology%is_newtonian()) then
         bytes = bytes + bytes_faces
      end if
      expected_memory_mib = program_mib + (bytes + bytes_set*self%field_sets)*cells/2.0_dp**20 &
                            + (self%threads - 1)*(thread_mib + bytes_thread*(self%cells_x + self%cells_y)/2.0_dp**20)
   end function expected_memory_mib

end module ehlwave_bare_plan
