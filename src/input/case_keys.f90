!> The table of keys: every key of a case once, in the order of the effective input.
!>
!> A new key is a component of case_t and its statement here; reading, sweeping, effective input, identity, messages
!> and the printed reference follow. Common properties of successive keys precede them (`common`). Give a key that is
!> added `is_late=.true.`: then cases that do not use it keep their identity, and stores their results. If its default
!> differs from earlier behaviour, see `case_text`. Contradictions between keys are in `case_completion`. A key that
!> names a file to be read has a `file`, by which `case/case_files` and the results know it.
module ehlwave_case_keys
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_key, only: key_t
   use ehlwave_effect_keys, only: by_second_order
   use ehlwave_key_list, only: key_list_t
   use ehlwave_kinds, only: dp
   use ehlwave_oil_keys, only: visit_oil_keys
   use ehlwave_roughness_keys, only: visit_surface, visit_waviness
   use ehlwave_threads, only: most_threads
   implicit none (type, external)
   private
   public :: case_key_list, case_values, default_keys, list_case_keys, list_oil_keys, &
      take_values

   character(len=*), parameter :: elliptical = 'elliptical contacts (radius_ratio_d above 0), not to line contacts'
   character(len=*), parameter :: time_steps = 'marches in time (waves or a surface that move, or &dynamics end_time)'
   character(len=*), parameter :: linear = "response = 'harmonic' or 'both' of waves"

contains

   !> All keys of a case with their values.
   function case_key_list(case) result(list)
      type(case_t), intent(in) :: case
      type(key_list_t) :: list
      call list_case_keys(case, list)
   end function case_key_list

   !> `case_key_list` in a list that may be one of another case: its memory serves again.
   subroutine list_case_keys(case, list)
      type(case_t), intent(in) :: case
      type(key_list_t), intent(inout) :: list
      type(case_t) :: copy
      copy = case
      call visit_case_keys(copy, list)
   end subroutine list_case_keys

   !> The keys of the oil of a case, likewise.
   subroutine list_oil_keys(case, list)
      type(case_t), intent(in) :: case
      type(key_list_t), intent(inout) :: list
      type(case_t) :: copy
      copy = case
      call list%begin()
      call visit_oil(copy, list)
   end subroutine list_oil_keys

   !> All keys with their defaults. Made at the first call, which threads must not share.
   function default_keys() result(list)
      type(key_list_t), pointer :: list
      type(key_list_t), save, target :: defaults
      if (.not. allocated(defaults%values)) defaults = case_key_list(case_t())
      list => defaults
   end function default_keys

   !> Values without the keys, for callers that need only values.
   function case_values(case) result(list)
      type(case_t), intent(in) :: case
      type(key_list_t) :: list
      type(case_t) :: copy
      copy = case
      list%has_keys = .false.
      call visit_case_keys(copy, list)
   end function case_values

   !> Give the values of a list of all keys to a case.
   subroutine take_values(list, case)
      type(key_list_t), intent(inout) :: list
      type(case_t), intent(inout) :: case
      list%gives_back = .true.
      call visit_case_keys(case, list)
      list%gives_back = .false.
   end subroutine take_values

   subroutine visit_case_keys(case, list)
      type(case_t), intent(inout) :: case
      type(key_list_t), intent(inout) :: list

      call list%begin()
      call visit_conditions(case, list)
      call visit_oil(case, list)
      call visit_waviness(case%roughness_t, 'Harmonic waves of one surface.', list)
      call list%see(case%phase_deg, key_t('phase_deg', 'phase of waves at rest; 0: smallest gap at X = 0', unit='deg', &
         minimum=-360.0_dp, maximum=360.0_dp, is_late=.true., when='waves at rest with &touching', &
         applies=case%effects%touching%is_given() .and. case%is_wavy() .and. .not. case%moves()))
      call list%see(case%response, key_t('response', "response to the waves; 'transient': waves of this amplitude "// &
         "in time, "// &
         "'periodic': the periodic state of these waves, by a march from their linear response; where that does "// &
         "not find it, from the smooth contact, "// &
         "'harmonic': the linear response to small waves, without time steps, 'both': march and response", &
         choices='transient periodic harmonic both', counts=case%is_rough(), when='waves (orientation)'))
      call visit_surface(case%roughness_t, 'A measured surface in place of &waviness.', &
         'surface written by `ehlwave surface`; it enters at x_min, moves with S and is followed until its '// &
         'trailing end is at the contact centre, or end_time; needs dimensional conditions. The whole domain is '// &
         'computed unless it is even in Y. With --output, surface_position_m is the x of the surface at '// &
         'the centre for each film_at_centre', list)
      call case%effects%visit('surface', list)
      call visit_grid(case, list)
      call visit_solver(case, list)
      call visit_dynamics(case, list)
      call list%enter('output', 'Additional results and files.')
      call list%see(case%fields, key_t('fields', 'whether the last fields are kept even without --output', &
         is_written=.false., can_vary=.false.))
      call list%see(case%fields_every, key_t('fields_every', 'time steps from one kept set of fields to the next; '// &
         'with '// &
         '--output a march writes pressure, film and shear stress over time; 0: the last fields alone', &
         minimum=0.0_dp, is_late=.true., can_vary=.false.))
      call list%see(case%sensitivities, key_t('sensitivities', 'whether results are differentiated '// &
         'by every input; film, friction, resistance to rolling, linear response or '// &
         'periodic state, and share of touching surfaces, of contacts without heat, on a mesh in units of a and b', &
         is_late=.true.))
      call list%see(case%mean_rise, key_t('mean_rise', 'whether a linear response includes the change of the '// &
         'mean film by waves, to second order, and the smallest film; .false. saves a third of its work, without '// &
         'a warning when waves touch', is_late=.true., is_effort=.true., &
         counts=case%responds() .and. .not. case%effects%refuse(by_second_order), when=linear//' in flooded contacts'))
      call case%effects%visit('output', list)
   end subroutine visit_case_keys

   subroutine visit_oil(case, list)
      type(case_t), intent(inout) :: case
      type(key_list_t), intent(inout) :: list
      call visit_oil_keys(case%oil, case%effects%are_warm(), list)
      call case%effects%visit('lubricant', list)
   end subroutine visit_oil

   subroutine visit_conditions(case, list)
      type(case_t), intent(inout) :: case
      type(key_list_t), intent(inout) :: list

      call list%enter('conditions', 'Either the Moes parameters M, L and D or dimensional data.')
      list%common%is_written = case%is_dimensional
      ! Bounds of radii, modulus and viscosity include all known contacts: a value in another unit is refused.
      call list%see(case%data%radius_x_m, key_t('radius_x_m', 'reduced radius in the rolling direction', unit='m', &
         minimum=1e-6_dp, maximum=5.0_dp, is_required=.true.))
      call list%see(case%data%radius_y_m, key_t('radius_y_m', 'reduced radius across; none: line contact', unit='m', &
         minimum=1e-6_dp, maximum=1e4_dp))
      list%common%is_written = .true.
      call list%see(case%data%reduced_modulus_pa, key_t('reduced_modulus_pa', "reduced elastic modulus E': 2/E' = "// &
         '(1 - nu1^2)/E1 + (1 - nu2^2)/E2; also besides M, L and D, for friction and flow laws other than newtonian', &
         unit='Pa', minimum=1e6_dp, maximum=3e12_dp))
      list%common%is_written = case%is_dimensional
      call list%see(case%data%load_n, key_t('load_n', 'load', unit='N', above=0.0_dp))
      call list%see(case%data%load_n_per_m, key_t('load_n_per_m', 'load per length of a line contact; in place of '// &
         'load_n and radius_y_m', unit='N/m', above=0.0_dp))
      call list%see(case%data%mean_speed_m_per_s, key_t('mean_speed_m_per_s', 'mean speed (u1 + u2)/2', unit='m/s', &
         above=0.0_dp, is_required=.true.))
      call list%see(case%data%viscosity_pa_s, key_t('viscosity_pa_s', 'viscosity at ambient pressure', unit='Pa s', &
         minimum=1e-5_dp, maximum=20.0_dp, is_required=.true.))
      list%common%is_written = .not. case%is_dimensional
      call list%see(case%load_parameter_m, key_t('load_parameter_m', 'load parameter M of Moes', above=0.0_dp, &
         is_required=.true.))
      call list%see(case%lubricant_parameter_l, key_t('lubricant_parameter_l', 'lubricant parameter L of Moes; 0: '// &
         'isoviscous', minimum=0.0_dp, is_required=.true.))
      call list%see(case%radius_ratio_d, key_t('radius_ratio_d', 'ratio of the reduced radii D = Rx/Ry; 1: '// &
         'circular, 0.005 or more: elliptical, 0: line contact', minimum=0.0_dp, is_required=.true.))
      list%common%is_written = .true.
      call list%see(case%slip_parameter, key_t('slip_parameter', 'slip parameter S = u1/ubar; speed of the wavy '// &
         'surface over the mean speed', minimum=0.0_dp, maximum=2.0_dp))
      call list%see(case%slide_to_roll_ratio, key_t('slide_to_roll_ratio', 'slide-to-roll ratio (u1 - u2)/ubar; in '// &
         'place of slip_parameter, S = 1 + ratio/2; surface 1 is the wavy one', minimum=-2.0_dp, maximum=2.0_dp, &
         is_written=.false.))
   end subroutine visit_conditions

   subroutine visit_grid(case, list)
      type(case_t), intent(inout) :: case
      type(key_list_t), intent(inout) :: list
      logical :: is_elliptical

      is_elliptical = case%radius_ratio_d > 0
      call list%enter('grid', 'Domain, in units of a (X) and b (Y), and cells.')
      call list%see(case%x_min, key_t('x_min', 'X of the inlet boundary', maximum=-1.0_dp))
      call list%see(case%x_max, key_t('x_max', 'X of the outlet boundary', minimum=1.0_dp))
      call list%see(case%y_max, key_t('y_max', 'Y of the side boundary', minimum=1.0_dp, applies=is_elliptical, &
         when=elliptical))
      call list%see(case%cells_x, key_t('cells_x', 'cells along X over the whole domain; even and at least 16, '// &
         'best if they can be halved several times; 0: chosen so that the case is resolved', minimum=0.0_dp, &
         maximum=8192.0_dp))
      call list%see(case%cells_y, key_t('cells_y', 'cells along Y over the whole domain; as cells_x', minimum=0.0_dp, &
         maximum=8192.0_dp, applies=is_elliptical, when=elliptical))
      call list%see(case%largest_cells, key_t('largest_cells', 'limit of chosen cells', minimum=64.0_dp, &
         maximum=8192.0_dp, default='1024; of line contacts 8192', is_written=min(case%cells_x, case%cells_y) == 0, &
         counts=min(case%cells_x, case%cells_y) == 0 .or. case%accuracy > 0, is_effort=.true., &
         when='cells_x or cells_y = 0, or accuracy'))
      call list%see(case%domain, key_t('domain', "computed domain; 'auto': half of it where the case is even in Y, "// &
         "'whole': "//'always all of it', choices='auto whole', applies=is_elliptical, when=elliptical))
      call list%see(case%edges, key_t('edges', "pressure at the edges of the domain; 'flooded': from the oil "// &
         "farther out; "// &
         "with accuracy a domain of the usual size is enlarged where that takes more; 'truncated': 0, which "// &
         "starves the contact a little", choices='flooded truncated'))
   end subroutine visit_grid

   subroutine visit_solver(case, list)
      type(case_t), intent(inout) :: case
      type(key_list_t), intent(inout) :: list

      call list%enter('solver', 'How the equations are solved, and how well.')
      call list%see(case%tolerance, key_t('tolerance', 'tolerance of steady states: mass residual and load error; '// &
         "where method = 'auto' takes 'fas' and none is given, 1e-6 to 1.5e-3 in proportion to the expected error "// &
         'of the mesh; the error that it leaves in the film stays far below that one', minimum=1e-12_dp, &
         maximum=0.1_dp))
      call list%see(case%step_tolerance, key_t('step_tolerance', 'tolerance of time steps at 20 % amplitude; '// &
         'reduced in proportion for smaller waves', minimum=1e-12_dp, maximum=0.1_dp, counts=case%marches(), &
         is_effort=.true., when=time_steps))
      call list%see(case%response_tolerance, key_t('response_tolerance', 'tolerance of the linear response: its '// &
         'residual', minimum=1e-12_dp, maximum=0.1_dp, is_late=.true., counts=case%responds(), is_effort=.true., &
         when=linear))
      call list%see(case%time_step_over_cell, key_t('time_step_over_cell', 'time step dT/hX; a whole number or one '// &
         'over a whole number; below 1 only adds samples between the steps of dT = hX', above=0.0_dp, &
         is_effort=.true., when=time_steps//', and responses with an equation of motion', counts=case%marches() .or. &
         (case%responds() .and. case%moves() .and. case%load_balance == 'equation_of_motion')))
      call list%see(case%largest_steps, key_t('largest_steps', 'largest number of Newton steps, or multigrid '// &
         'cycles, of a solution', minimum=1.0_dp, maximum=10000.0_dp))
      call list%see(case%settling_periods, key_t('settling_periods', 'periods to wait before the amplitude is '// &
         'measured; once the pattern has reached the outlet end, and a change of the layer or a load step has passed', &
         minimum=0.0_dp, maximum=1000.0_dp, is_effort=.true., when='marches of waves without end_time', &
         counts=case%marches() .and. case%has_ratio() .and. .not. case%end_time > 0))
      call list%see(case%largest_total_steps, key_t('largest_total_steps', 'largest number of Newton steps of a '// &
         'case on the '// &
         'finest grid; steps of rescues count; 0: 600, and 40 more for each time step or 300 for each phase of a '// &
         'standing pattern; a case without this key also ends at ten times the work of its plan', minimum=0.0_dp, &
         maximum=1e9_dp, is_written=case%largest_total_steps > 0))
      call list%see(case%method, key_t('method', "method of solution; 'auto': 'fas' where it is faster, for "// &
         "steady states and linear responses of flooded, isothermal, Newtonian elliptical contacts on more than "// &
         "512 cells along a side, from gamma M = 1000 on or with Barus' law on 512 and more along both, else "// &
         "'newton'; 'fas': FAS multigrid with hybrid line relaxation, the "// &
         "paper's method, 'petsc': the finest level by PETSc's variational inequality solver, an independent check "// &
         "(builds with PETSc)", choices='auto newton fas petsc'))
      call list%see(case%cycle, key_t('cycle', 'multigrid cycle', choices='f v w', default="'f'", &
         applies=case%method == 'fas', when="method = 'fas'"))
      call list%see(case%deformation, key_t('deformation', "how the deformation is computed; 'auto': the faster "// &
         "method, 'fft'; 'mlmi': multilevel multi-integration, with an error far below the discretisation error", &
         choices='auto fft mlmi'))
      call list%see(case%scheme, key_t('scheme', "differences of the Reynolds equation; 'averaged': eps averaged "// &
         "between nodes, upstream differences of second order; 'fitted': fluxes that integrate steep inlets "// &
         "between nodes, upstream differences of third order, for heavy loads; without heat, in flooded contacts; "// &
         "'auto': 'fitted' for an accuracy that takes clearly fewer cells so, else 'averaged'", &
         choices='auto averaged fitted', is_late=.true.))
      call list%see(case%error_estimate, key_t('error_estimate', "estimate of the error of Ad/Ai; 'coarse_grid': "// &
         "from the "// &
         "same case on 2 and 4 times the mesh size (5 to 15 % of the time), 'model': the error that the plan expects", &
         choices='coarse_grid model', counts=case%has_ratio() .and. case%response /= 'harmonic', is_effort=.true., &
         when="waves without response = 'harmonic'"))
      call list%see(case%accuracy, key_t('accuracy', 'requested relative error of Ad/Ai, in smooth contacts of '// &
         'H(0,0); e.g. 0.01: chooses cells, time step, tolerances and amplitudes that are not given. Measured '// &
         'surfaces have none where cells, time step, scheme, method or tolerances are given, or the fitted scheme '// &
         'does not serve', &
         above=0.0_dp, maximum=0.2_dp, default='none; of measured surfaces 0.005'))
      call list%see(case%threads, key_t('threads', 'threads that share one case; no result depends on them; 0: '// &
         'OMP_NUM_THREADS, else the cores that are its own', minimum=0.0_dp, maximum=real(most_threads, dp), &
         default='the cores', is_written=.false., can_vary=.false.))
   end subroutine visit_solver

   subroutine visit_dynamics(case, list)
      type(case_t), intent(inout) :: case
      type(key_list_t), intent(inout) :: list

      call list%enter('dynamics', 'Load and mutual approach in time.')
      call list%see(case%load_balance, key_t('load_balance', 'equation of the mutual approach', &
         choices='force_balance equation_of_motion', counts=case%marches() .or. (case%responds() .and. case%moves()), &
         when=time_steps//', and responses to waves that move'))
      call list%see(case%natural_frequency, key_t('natural_frequency', 'dimensionless natural frequency Omega', &
         above=0.0_dp, applies=case%load_balance == 'equation_of_motion', when="load_balance = 'equation_of_motion'"))
      call list%see(case%load_factor, key_t('load_factor', 'load from T = 0 on over the steady load; a load '// &
         'step', above=0.0_dp, counts=case%marches() .or. (case%is_rough() .and. case%response /= 'transient'), &
         when=time_steps))
      call list%see(case%end_time, key_t('end_time', 'T to which is marched; none: until the amplitude is measured', &
         above=0.0_dp))
   end subroutine visit_dynamics

end module ehlwave_case_keys
