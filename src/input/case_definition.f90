!> The input of a case: every key with its default. `case_keys` has their meaning and bounds.
module ehlwave_case_definition
   use ehlwave_conditions, only: contact_data_t
   use ehlwave_effects_keys, only: effects_keys_t
   use ehlwave_kinds, only: dp
   use ehlwave_oil, only: oil_t
   use ehlwave_roughness, only: name_length, path_length, roughness_t
   implicit none (type, external)
   private
   public :: name_length, path_length

   real(dp), parameter :: no_ratio = huge(1.0_dp)        ! not given; 0 is a ratio

   !> All keys, in the order of the groups. The roughness belongs to the first surface, &waviness and &surface.
   type, extends(roughness_t), public :: case_t
      ! &conditions
      logical :: is_dimensional = .false.                !! given by dimensional data, from which M, L and D follow
      type(contact_data_t) :: data
      real(dp) :: load_parameter_m = 0, lubricant_parameter_l = 0, radius_ratio_d = 0
      real(dp) :: slip_parameter = 1
      real(dp) :: slide_to_roll_ratio = no_ratio         !! slip in another form: completed from S, or S from it
      ! &lubricant
      type(oil_t) :: oil
      ! &waviness
      character(len=name_length) :: response = 'transient'
      type(effects_keys_t) :: effects
      ! &grid
      real(dp) :: x_min = -2.5_dp, x_max = 1.5_dp, y_max = 2
      integer :: cells_x = 256, cells_y = 256            !! 0: chosen by the plan; cells_y of a line contact: completed
                                                         !! to 1
      integer :: largest_cells = 0                       !! limit of the choices of the plan, completed
      character(len=name_length) :: domain = 'auto'
      character(len=name_length) :: edges = 'flooded'
      ! &solver
      real(dp) :: tolerance = 1e-6_dp
      real(dp) :: step_tolerance = 1e-4_dp
      real(dp) :: response_tolerance = 1e-5_dp           !! tolerance of the linear response
      real(dp) :: time_step_over_cell = 1                !! 0: chosen by the plan
      integer :: largest_steps = 60
      integer :: largest_total_steps = 0                 !! 0: chosen by the plan
      integer :: settling_periods = 1
      character(len=name_length) :: method = 'auto'      !! completed to that in use
      logical :: has_free_tolerance = .false.            !! no key: none was given for steady states
      character(len=:), allocatable :: idle              !! no key: report of the plan on keys without effect
      character(len=name_length) :: cycle = ''           !! cycle of method = 'fas', completed
      character(len=name_length) :: deformation = 'auto'
      character(len=name_length) :: scheme = 'auto'               !! scheme of the Reynolds equation
      character(len=name_length) :: error_estimate = 'coarse_grid'
      real(dp) :: accuracy = 0                           !! relative error asked for; 0: none
      integer :: threads = 0                             !! threads that share the case; 0: chosen at run time
      ! &dynamics
      character(len=name_length) :: load_balance = 'force_balance'
      real(dp) :: natural_frequency = 0                  !! 0: none
      real(dp) :: load_factor = 1
      real(dp) :: end_time = 0                           !! 0: until the amplitude is measured
      ! &output
      logical :: fields = .false.
      integer :: fields_every = 0                        !! time steps between sets of fields; 0: the last
                                                         !! alone
      logical :: sensitivities = .false.
      logical :: mean_rise = .true.
   contains
      procedure :: is_pair
      procedure :: is_rough
      procedure :: surfaces
      procedure :: has_heights
      procedure :: has_ratio
      procedure :: has_linear_range
      procedure :: moves
      procedure :: marches
      procedure :: touches_at_rest
      procedure :: responds
      procedure :: repeats
   end type case_t

   integer, parameter, public :: usual_largest_cells = 1024   !! cells that the plan chooses without a limit,
   integer, parameter, public :: largest_line_cells = 8192    !! cells for line contacts

contains

   !> Whether the second surface is rough, too.
   elemental logical function is_pair(self)
      class(case_t), intent(in) :: self
      is_pair = self%effects%second%is_given()
   end function is_pair

   !> Roughness of both surfaces; the second may be smooth.
   pure function surfaces(self)
      class(case_t), intent(in) :: self
      type(roughness_t) :: surfaces(2)
      surfaces = [self%roughness_t, self%effects%second%roughness]
   end function surfaces

   !> Whether a surface is rough.
   elemental logical function is_rough(self)
      class(case_t), intent(in) :: self
      is_rough = self%roughness_t%is_rough() .or. self%effects%second%roughness%is_rough()
   end function is_rough

   !> Whether the steady state is one of waves at rest that solids may bear.
   elemental logical function touches_at_rest(self)
      class(case_t), intent(in) :: self
      touches_at_rest = self%effects%touching%is_given() .and. self%is_rough() .and. .not. self%marches()
   end function touches_at_rest

   !> Whether a surface has measured heights.
   elemental logical function has_heights(self)
      class(case_t), intent(in) :: self
      has_heights = self%roughness_t%is_measured() .or. self%effects%second%roughness%is_measured()
   end function has_heights

   !> Whether the gap changes in time: a pattern varies along X and its surface moves.
   elemental logical function moves(self)
      class(case_t), intent(in) :: self
      associate (s => self%slip_parameter)
         moves = self%roughness_t%moves_at(s) .or. self%effects%second%roughness%moves_at(s)
      end associate
   end function moves

   !> Whether there are time steps. Known when the slip is.
   elemental logical function marches(self)
      class(case_t), intent(in) :: self
      marches = (self%moves() .or. self%end_time > 0) .and. .not. (self%is_rough() .and. self%response == 'harmonic')
   end function marches

   !> Whether the linear response is computed.
   elemental logical function responds(self)
      class(case_t), intent(in) :: self
      responds = self%is_rough() .and. (self%response == 'harmonic' .or. self%response == 'both')
   end function responds

   !> Whether the periodic state of waves is sought.
   elemental logical function repeats(self)
      class(case_t), intent(in) :: self
      repeats = self%moves() .and. self%response == 'periodic'
   end function repeats

   !> Whether the result is about waves, Ad/Ai; else it is about the film.
   elemental logical function has_ratio(self)
      class(case_t), intent(in) :: self
      has_ratio = self%is_wavy() .and. .not. self%effects%second%roughness%is_measured()
   end function has_ratio

   !> Whether small waves of the case have an Ad/Ai of their own: waves of any size on touching surfaces do not.
   elemental logical function has_linear_range(self)
      class(case_t), intent(in) :: self
      has_linear_range = self%has_ratio() .and. .not. self%effects%touching%is_given()
   end function has_linear_range

end module ehlwave_case_definition
