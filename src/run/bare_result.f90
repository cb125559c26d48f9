!> The result of one case without its effects. Values are NaN until they are computed.
module ehlwave_bare_result
   use ehlwave_contact_variant, only: variable_length
   use ehlwave_error_parts, only: error_parts_t
   use ehlwave_field_history, only: field_history_t
   use ehlwave_kinds, only: dp, no_value
   use ehlwave_rolling_result, only: rolling_result_t
   use ehlwave_shear_result, only: shear_result_t
   use ehlwave_status, only: status_pending
   use ehlwave_surface_result, only: surface_result_t
   implicit none (type, external)
   private

   integer, parameter, public :: rung_length = 12

   !> Results that are differentiated by every input; the phase itself, of the others the logarithm.
   integer, parameter, public :: of_central_film = 1, of_minimum_film = 2, of_friction = 3, &
      of_rolling_coefficient = 4, of_rolling_force = 5, of_ratio = 6, of_phase = 7, of_share = 8, of_speed = 9, &
      of_marched_ratio = 10, of_marched_phase = 11, of_mean_film = 12, gradients = 12

   !> Derivatives by the logarithm of a property of the oil, all else of the contact the same; NaN: not asked for, or
   !> none.
   type, public :: oil_sensitivity_t
      real(dp) :: film = no_value                    !! sensitivity of ln H(0,0)
      real(dp) :: response = no_value                !! sensitivity of ln(Ad/Ai), small waves
      real(dp) :: response_real = no_value           !! real part of the transfer function from the pattern to H(0,0)
      real(dp) :: response_imaginary = no_value
   end type oil_sensitivity_t

   !> Derivatives by the logarithm of a variable, see `case/case_variables`; NaN: none.
   type, public :: gradient_t
      character(len=variable_length) :: name = ''
      real(dp) :: of(gradients) = no_value
   end type gradient_t

   !> The results of the first surface, and all others.
   type, extends(surface_result_t), public :: bare_result_t
      integer :: status = status_pending
      logical :: is_resolved = .true.
      character(len=:), allocatable :: message       !! why not converged or not resolved, else empty
      ! smooth steady contact
      real(dp) :: central_film = no_value            !! H(0,0)
      real(dp) :: minimum_film = no_value            !! smallest H on the grid
      real(dp) :: central_film_moes = no_value       !! H(0,0) in the scale of theory eq. (6)
      real(dp) :: max_pressure = no_value            !! largest P
      ! estimated relative discretisation errors; NaN where there is no estimate
      real(dp) :: central_film_error = no_value      !! error of H(0,0), from the multigrid levels
      real(dp) :: minimum_film_error = no_value      !! error of the smallest H, likewise
      real(dp) :: friction_error = no_value          !! error of the friction coefficient, likewise
      real(dp) :: film_domain_error = 0              !! error of central_film by the edges of a flooded domain
      real(dp) :: minimum_film_domain_error = no_value, friction_domain_error = no_value   !! parts of them by the edges
      character(len=12) :: film_error_basis = ''     !! basis of the errors: 'coarse_grid' or 'model'
      real(dp) :: film_order = no_value              !! observed order of H(0,0) on the three finest levels
      real(dp) :: amplitude_ratio_error = no_value   !! error of Ad/Ai
      character(len=12) :: amplitude_error_basis = ''   !! basis: 'coarse_grid', 'model', or no estimate
      ! with their other parts; see run/error_account
      type(error_parts_t) :: film_errors = error_parts_t(mesh=no_value)    !! parts of the error of H(0,0)
      type(error_parts_t) :: ratio_errors = error_parts_t(mesh=no_value)   !! parts of the error of Ad/Ai
      real(dp) :: error_estimate = no_value          !! sum of the parts of the main quantity
      real(dp) :: overtone_error = 0                 !! relative error of Ad/Ai by overtones of another surface's waves
      real(dp) :: settling = 0                       !! relative error of Ad/Ai by its change since the period
                                                     !! before
      integer :: refinements = 0                     !! runs on finer grids than the first, for an accuracy
      ! waviness
      real(dp) :: amplitude_ratio = no_value         !! Ad/Ai by theory eq. (14)
      real(dp) :: mean_film = no_value               !! mean of H(0,0) over the measured periods
      character(len=8) :: route = ''                 !! origin of the film: a march from 'rest', or a march started in
                                                     !! 'waves'
      real(dp) :: v = 0, v2 = 0, f_r = 0             !! theory eq. (17), (16), (15)
      real(dp) :: formula_ratio = 0                  !! theory eq. (18)
      type(oil_sensitivity_t) :: by_oil(2)           !! by ln(alpha), by ln(stress of the flow law)
      type(gradient_t), allocatable :: by_key(:)     !! by each variable, if asked for
      integer :: transposed_solves = 0               !! transposed linear solves of the derivatives
      real(dp) :: transposed_work = 0                !! operations that they took
      type(shear_result_t) :: shear                  !! friction of the smooth contact, and estimates
      type(rolling_result_t) :: rolling              !! its resistance to rolling
      character(len=:), allocatable :: warning       !! relevant effect that the model lacks, else empty
      ! the largest over all solutions of the case
      real(dp) :: residual = 0                       !! mass residual, see solve_report_t
      real(dp) :: load_error = 0
      ! effort
      integer :: time_steps = 0                      !! steps done
      integer :: nonlinear_steps = 0, linear_steps = 0
      character(len=rung_length) :: rung = 'direct'  !! highest rung of the rescue ladder used, see solver/rescue
      integer :: rescued_solutions = 0               !! solutions that took more than the direct solve
      real(dp) :: seconds = 0                        !! wall time of the case
      real(dp) :: work_units = 0                     !! work in plain FFT convolutions of the whole grid
      real(dp) :: work = 0                           !! operations counted, without error estimates and sensitivities,
      real(dp) :: counted_work_units = no_value      !! operations in units of a convolution
      real(dp) :: own_convolution = no_value         !! operations of one deformation on the finest grid,
      real(dp) :: own_units = no_value               !! and counted operations over them
      real(dp) :: all_work = 0                       !! operations with error estimates and sensitivities,
      real(dp) :: total_work_units = no_value        !! all operations in units of a convolution
      real(dp) :: peak_memory_mib = 0                !! peak memory of the process so far
      real(dp), allocatable :: residual_history(:)  !! residuals of the failed solution: before each step and at the end
      ! history of the contact centre: times T, or phases over 2 pi for standing patterns
      real(dp), allocatable :: time(:), film_history(:), approach_history(:)
      ! fields of the last solution, if asked for
      real(dp), allocatable :: x(:), y(:), p(:, :), h(:, :)
      real(dp), allocatable :: shear_stress_pa(:, :) !! mean of the shear stresses at the two surfaces along X, if known
      type(field_history_t) :: history               !! fields over time, if asked for
   end type bare_result_t

end module ehlwave_bare_result
