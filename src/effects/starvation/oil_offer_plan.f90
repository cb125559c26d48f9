!> The oil that a case offers to its contact: refusals, and its profile across.
module ehlwave_oil_offer_plan
   use ehlwave_case_definition, only: case_t
   use ehlwave_case_files, only: case_file_t, note_digest
   use ehlwave_conditions, only: conditions_t
   use ehlwave_errors, only: error_t, raise
   use ehlwave_formula, only: expected_film
   use ehlwave_inlet_oil, only: inlet_oil_t
   use ehlwave_kinds, only: dp
   use ehlwave_number_file, only: read_number_table
   use ehlwave_number_table, only: number_table_t
   use ehlwave_rheology, only: rheology_t
   use ehlwave_starvation_keys, only: starvation_keys_t
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: check_inlet, expected_oil, narrow_lane_text, read_oil

   real(dp), parameter :: least_oil = 1e-4_dp     !! over flooded, where a profile has none at Y = 0
   real(dp), parameter :: fewest_cells = 2        !! across a ridge or dry lane of a profile that resolve it
   real(dp), parameter :: least_height = 0.05_dp  !! over the largest share, of lanes that are judged

contains

   !> Refuse options outside starved contacts. `case` is flooded without an amount of oil.
   subroutine check_inlet(case, error)
      type(case_t), intent(in) :: case
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: given
      type(starvation_keys_t) :: keys
      logical :: has_pattern

      keys = case%effects%starvation
      given = ''
      if (keys%oil_over_flooded > 0) given = '&inlet oil_over_flooded = '//to_text(keys%oil_over_flooded, 6)//': '
      if (keys%oil_layer_m > 0) given = '&inlet oil_layer_m = '//to_text(keys%oil_layer_m, 6)//': '
      if (given == '') return
      has_pattern = case%is_wavy() .or. case%is_measured()
      if (keys%oil_layer_m > 0 .and. .not. case%is_dimensional) then
         call raise(error, given//'metres need dimensional conditions (radius_x_m, ...); give oil_over_flooded in '// &
                    'place of it')
      else if (.not. any(case%method == ['newton', 'auto  '])) then
         call raise(error, given//"starved contacts are solved by method = 'newton' alone, not by '"// &
            trim(case%method)//"', whose sweeps lack partly filled nodes")
      else if (has_pattern .and. abs(case%slip_parameter - 1) > 0) then
         call raise(error, given//'waves and surfaces need pure rolling, slip_parameter = 1: where the gap is not '// &
                    'full, under slip each layer moves with its own surface, which the model lacks')
      else if (has_pattern .and. case%response == 'periodic') then
         call raise(error, given//"response = 'periodic' starts in waves known to second order, which have no "// &
                    "contents of gaps that are not full: take 'transient', 'both' or 'harmonic'")
      else if (case%time_step_over_cell > 1) then
         call raise(error, given//'&solver time_step_over_cell = '//to_text(case%time_step_over_cell, 6)// &
                    ' is above 1: oil in partly filled gaps goes from node to node; use 1, 0.5, 0.25, ...')
      else if (abs(keys%oil_change_factor - 1) > 0 .and. has_pattern .and. case%response == 'harmonic') then
         call raise(error, "&inlet oil_change_factor: response = 'harmonic' takes no time steps: use 'transient'")
      else if (abs(keys%oil_change_factor - 1) > 0 .and. abs(case%slip_parameter - 1) > 0) then
         call raise(error, '&inlet oil_change_factor: a change of the layer needs pure rolling, '// &
                    'slip_parameter = 1: under slip the layers of the two surfaces change apart')
      end if
   end subroutine check_inlet

   !> The oil offered. Fails on a profile that cannot be used.
   subroutine read_oil(keys, conditions, inlet, files, error)
      type(starvation_keys_t), intent(in) :: keys
      type(conditions_t), intent(in) :: conditions
      type(inlet_oil_t), intent(out) :: inlet
      type(case_file_t), intent(inout) :: files(:)
      type(error_t), allocatable, intent(inout) :: error
      type(number_table_t) :: table
      integer :: share, y

      inlet%over_flooded = keys%oil_over_flooded
      if (keys%oil_layer_m > 0) inlet%layer = keys%oil_layer_m/conditions%c_m
      if (keys%oil_profile == '' .or. .not. inlet%is_short()) return
      call read_number_table(trim(keys%oil_profile), table, error)
      if (allocated(error)) then
         error%message = '&inlet oil_profile: '//error%message
         return
      end if
      y = table%column('y_over_b')
      share = table%column('layer_over_given')
      if (y == 0 .or. share == 0) then
         call raise(error, "&inlet oil_profile = '"//trim(keys%oil_profile)//"' needs the columns y_over_b and "// &
                    'layer_over_given')
         return
      end if
      call note_digest(files, trim(keys%oil_profile), table%digest())
      inlet%y = table%values(:, y)
      inlet%share = table%values(:, share)
      call check_profile(trim(keys%oil_profile), inlet, error)
   end subroutine read_oil

   !> Oil offered at Y = 0 over the flow of the flooded contact, by the film formula where a layer is given; before a
   !> change of the layer.
   pure real(dp) function expected_oil(inlet, conditions, rheology)
      type(inlet_oil_t), intent(in) :: inlet
      type(conditions_t), intent(in) :: conditions
      type(rheology_t), intent(in) :: rheology
      real(dp) :: hertz(1, 1)
      expected_oil = inlet%over_flooded
      if (inlet%layer > 0) then
         hertz = 1
         expected_oil = inlet%layer/(sum(rheology%density(hertz))*expected_film(conditions))
      end if
      expected_oil = max(least_oil, expected_oil*inlet%share_at(0.0_dp))
   end function expected_oil

   !> Why a ridge or dry lane of the profile is too narrow for the mesh: cells hold its oil, but not its form. '' where
   !> none is.
   function narrow_lane_text(inlet, y_max, hy) result(reason)
      type(inlet_oil_t), intent(in) :: inlet
      real(dp), intent(in) :: y_max, hy     !! half the width of the domain, mesh size
      character(len=:), allocatable :: reason
      real(dp) :: width

      reason = ''
      width = inlet%narrowest_lane(y_max, least_height)
      if (width < fewest_cells*hy) reason = 'the oil profile has a ridge or dry lane '//to_text(width, 2)// &
         ' b wide, '//to_text(width/hy, 2)//' cells: use hY <= '//to_text(width/fewest_cells, 2)
   end function narrow_lane_text

   !> A profile has two places or more, in order, and no negative layer; somewhere there is oil.
   subroutine check_profile(path, inlet, error)
      character(len=*), intent(in) :: path
      type(inlet_oil_t), intent(in) :: inlet
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: key
      integer :: n

      key = "&inlet oil_profile = '"//path//"': "
      n = size(inlet%y)
      if (n < 2) then
         call raise(error, key//'give two rows or more')
      else if (any(inlet%y(2:) <= inlet%y(:n - 1))) then
         call raise(error, key//'y_over_b has to grow from row to row')
      else if (any(inlet%share < 0) .or. .not. any(inlet%share > 0)) then
         call raise(error, key//'layer_over_given has to be 0 or more, and above 0 somewhere')
      end if
   end subroutine check_profile

end module ehlwave_oil_offer_plan
