!> Operating conditions of an EHL contact: Moes parameters, Hertz scales, and the relations between them.
module ehlwave_conditions
   use ehlwave_elliptic_integrals, only: ellipticity, ellipticity_integrals, ellipticity_integrals_t, line_integrals
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp, pi
   use ehlwave_text, only: to_text
   implicit none (type, external)
   private
   public :: conditions_from_moes, conditions_from_dimensional

   real(dp), parameter, public :: smallest_radius_ratio = 0.005_dp
   real(dp), parameter :: round_off = 1e-12_dp        ! relative: D of equal radii is 1 but for it
   real(dp), parameter :: largest_alphabar = 500      ! viscosity grows by exp(alphabar) under Barus' law
   !> Ratio of gamma M between a slender elliptical contact and a line contact with the same alphabar and L: (2/3)
   !> pi^3/(2 pi)^(3/2)
   real(dp), parameter :: slender_over_line = 2*pi**3/(3*(2*pi)**1.5_dp)

   !> Dimensional data of a contact, SI units.
   type, public :: contact_data_t
      real(dp) :: radius_x_m = 0                    !! Rx, reduced radius in the rolling direction, m
      real(dp) :: radius_y_m = 0                    !! Ry, reduced radius across, m
      real(dp) :: reduced_modulus_pa = 0            !! E', Pa
      real(dp) :: load_n = 0                        !! F, N
      real(dp) :: load_n_per_m = 0                  !! w, of a line contact, which has no F and no Ry, N/m
      real(dp) :: mean_speed_m_per_s = 0            !! (u1 + u2)/2, m/s
      real(dp) :: viscosity_pa_s = 0                !! eta0, Pa s
      real(dp) :: pressure_viscosity_per_pa = 0     !! alpha, 1/Pa
   end type contact_data_t

   !> Everything that follows from (M, L, D) and alpha: theory eq. (1) to (6), of a line contact (L1) to (L9).
   type, public :: conditions_t
      real(dp) :: m = 0, l = 0, d = 1               !! Moes load and lubricant parameters, D = Rx/Ry; 0: line contact
      type(ellipticity_integrals_t) :: elliptic     !! kappa, K, E
      real(dp) :: gamma = 1                         !! pressure factor of the ellipticity
      real(dp) :: alphabar = 0                      !! alpha ph, eq. (3)
      real(dp) :: lambdabar = 0                     !! dimensionless speed, eq. (4)
      real(dp) :: s = 0.5_dp                        !! shape factor, eq. (5)
      real(dp) :: moes_film_factor = 0              !! (h/Rx)(2U)^(-1/2) per unit H, eq. (6)
      real(dp) :: slip_parameter = 1                !! S = u1/ubar
      real(dp) :: alpha_per_pa = 0                  !! alpha, 1/Pa
      real(dp) :: hertz_pressure_pa = 0             !! ph, Pa
      logical :: has_dimensions = .false.           !! whether the lengths below are known
      real(dp) :: a_m = 0, b_m = 0, c_m = 0         !! Hertz semi-axes and approach, m; b of a line contact stays 0
      type(contact_data_t) :: data                  !! set when has_dimensions; E' also where given besides M, L
                                                    !! and D
   contains
      procedure :: is_line
      procedure :: steepness
      procedure :: radius_over_a
   end type conditions_t

contains

   !> Whether it is a line contact, D = 0.
   pure logical function is_line(self)
      class(conditions_t), intent(in) :: self
      is_line = .not. self%d > 0
   end function is_line

   !> gamma M, the steepness of the inlet. A line contact takes it from slender contacts with the same alphabar and
   !> L, whose inlet is the same.
   pure real(dp) function steepness(self)
      class(conditions_t), intent(in) :: self
      steepness = self%gamma*self%m
      if (self%is_line()) steepness = slender_over_line*steepness
   end function steepness

   !> Rx/a by theory eq. (20), (L2): a/R = 4 E ph/E', 1/R = (1 + D)/Rx, of a line E = 1. 0 where E' or ph is not known.
   pure real(dp) function radius_over_a(self)
      class(conditions_t), intent(in) :: self
      radius_over_a = 0
      if (self%hertz_pressure_pa > 0) radius_over_a = &
         (1 + self%d)*self%data%reduced_modulus_pa/(4*self%elliptic%e*self%hertz_pressure_pa)
   end function radius_over_a

   !> Conditions from the Moes parameters, theory eq. (1) to (6); for D = 0 see `set_line`.
   !>
   !> ph = alphabar/alpha. With L = 0 (isoviscous) that is 0, and pressure in pascal is unknown.
   !> Fails for M <= 0, L < 0, alpha <= 0, D neither 0 nor in 0.005 to 1, or alpha ph above 500.
   subroutine conditions_from_moes(m, l, d, alpha_per_pa, self, error)
      real(dp), intent(in) :: m, l, d               !! Moes parameters, Rx/Ry
      real(dp), intent(in) :: alpha_per_pa          !! pressure-viscosity coefficient, 1/Pa
      type(conditions_t), intent(out) :: self
      type(error_t), allocatable, intent(out) :: error

      call set_moes(m, l, d, alpha_per_pa, self, error)
      if (.not. allocated(error)) call check_range(self, error)
   end subroutine conditions_from_moes

   !> Conditions from the Moes parameters; loads beyond the model are left to `check_range`.
   subroutine set_moes(m, l, d, alpha_per_pa, self, error)
      real(dp), intent(in) :: m, l, d, alpha_per_pa
      type(conditions_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error

      if (.not. (m > 0)) then
         call raise(error, 'load_parameter_m must be above 0, got '//to_text(m, 6))
      else if (.not. (l >= 0)) then
         call raise(error, 'lubricant_parameter_l must not be negative, got '//to_text(l, 6))
      else if (.not. ((d >= smallest_radius_ratio .and. d <= 1) .or. abs(d) <= 0)) then
         call raise(error, 'radius_ratio_d must lie in 0.005 to 1, or be 0 for a line contact, got '//to_text(d, 6)// &
                    '; for Rx > Ry the contact is wider along rolling, which is outside the model range')
      else if (.not. (alpha_per_pa > 0)) then
         call raise(error, 'pressure_viscosity_per_pa must be above 0, got '//to_text(alpha_per_pa, 6))
      end if
      if (allocated(error)) return

      self%m = m
      self%l = l
      self%d = d
      self%alpha_per_pa = alpha_per_pa
      if (self%is_line()) then
         call set_line(self)
      else
         call set_ellipse(self)
      end if
      self%hertz_pressure_pa = self%alphabar/alpha_per_pa
   end subroutine set_moes

   !> Refuse a load beyond the model, by alpha ph ~ M^(1/3), of line contacts M^(1/2), or beyond numbers, by lambdabar.
   !> The message has the load of dimensional data, where it is given.
   subroutine check_range(self, error, data)
      type(conditions_t), intent(in) :: self
      type(error_t), allocatable, intent(inout) :: error
      type(contact_data_t), intent(in), optional :: data
      real(dp), parameter :: rounded_off = 0.995_dp   ! three digits of a bound, rounded, are within it
      character(len=:), allocatable :: given, bound
      real(dp) :: largest_m, load, unit

      given = 'load_parameter_m = '//to_text(self%m, 6)//' and lubricant_parameter_l = '//to_text(self%l, 6)//' give '
      if (.not. self%alphabar <= largest_alphabar) then
         largest_m = rounded_off*self%m*(largest_alphabar/self%alphabar)**merge(2, 3, self%is_line())
         bound = 'load_parameter_m of at most '//to_text(largest_m, 3)
         if (present(data)) then
            load = max(data%load_n, data%load_n_per_m)
            given = load_text(data, load, ' = ')//' gives '
            load = load*(largest_m/self%m)
            unit = 10.0_dp**(floor(log10(max(load, tiny(load)))) - 2)
            bound = load_text(data, unit*anint(load/unit), ' of at most ')
         end if
         given = given//'alpha ph = '//to_text(self%alphabar, 4)//', which is outside the model range (at most '// &
                 to_text(largest_alphabar, 3)//'): give '
         if (largest_m > 0) then
            call raise(error, given//bound)
         else
            call raise(error, given//'a smaller lubricant_parameter_l')
         end if
      else if (.not. (self%lambdabar > 0 .and. self%lambdabar < huge(self%lambdabar))) then
         call raise(error, given//'lambdabar = '//to_text(self%lambdabar, 4)//', beyond the range of numbers: '// &
                    'give a '//trim(merge('smaller', 'larger ', self%m > 1))//' load_parameter_m')
      end if
   end subroutine check_range

   !> Load with its key and unit: 'load_n of at most 762000 N'.
   function load_text(data, load, relation) result(text)
      type(contact_data_t), intent(in) :: data
      real(dp), intent(in) :: load
      character(len=*), intent(in) :: relation
      character(len=:), allocatable :: text

      if (data%load_n_per_m > 0) then
         text = 'load_n_per_m'//relation//to_text(load, 9)//' N/m'
      else
         text = 'load_n'//relation//to_text(load, 9)//' N'
      end if
   end function load_text

   !> Scales of an elliptical contact, theory eq. (3) to (6).
   pure subroutine set_ellipse(self)
      type(conditions_t), intent(inout) :: self   !! M, L and D are set
      self%elliptic = ellipticity_integrals(ellipticity(self%d))
      associate (kappa => self%elliptic%kappa, k => self%elliptic%k, b => self%elliptic%b_over_m)
         self%gamma = pi**2*kappa/(16*b**2)
         self%alphabar = self%l/pi*(1.5_dp*self%m*self%gamma)**(1.0_dp/3)
         self%lambdabar = 16*pi**(4.0_dp/3)*self%m**(-4.0_dp/3)*b**(5.0_dp/3) &
                          /(6**(1.0_dp/3)*kappa**(4.0_dp/3)*k**2)
         self%s = b/k
         self%moes_film_factor = 0.5_dp*k*b**(-1.0_dp/3)*(6*self%m*kappa/pi)**(2.0_dp/3)
      end associate
   end subroutine set_ellipse

   !> Scales of a line contact of load w per length, theory eq. (L1) to (L9): M = w/(E' Rx) (2U)^(-1/2),
   !> a^2 = 8 w Rx/(pi E'), ph = 2 w/(pi a), c = a^2/(2 Rx), so that
   !>
   !>     alphabar = L (M/(2 pi))^(1/2),  lambdabar = 6 us eta0 a/(c^2 ph) = 3 pi^2/(2 M^2),  (h/Rx)(2U)^(-1/2) = 4 M
   !>     H/pi.
   !>
   !> With gamma = M^(1/2) the wave parameter equals the line-contact parameter, V = (lambda/a)(gamma M/L)^(1/2) =
   !> (lambda/a) M^(3/4) L^(-1/2) = (2 pi)^(3/4) (lambda/a) alphabar^(3/2) L^(-2). The limit of gamma M for slender
   !> contacts with the same alphabar and L is 1.31 times as large (`slender_over_line`), and the limit of V 1.15
   !> times.
   pure subroutine set_line(self)
      type(conditions_t), intent(inout) :: self   !! M and L are set
      self%elliptic = line_integrals()
      self%gamma = sqrt(self%m)
      self%alphabar = self%l*sqrt(self%m/(2*pi))
      self%lambdabar = 1.5_dp*(pi/self%m)**2
      self%s = 1
      self%moes_film_factor = 4*self%m/pi
   end subroutine set_line

   !> Conditions from dimensional data, theory eq. (2) and (20). Line contacts, given by a load per length, use
   !> `set_line`.
   !>
   !> Fails when a value is missing or not positive, naming its key, when there are two loads, or when D = Rx/Ry is out
   !> of range.
   subroutine conditions_from_dimensional(data, self, error)
      type(contact_data_t), intent(in) :: data
      type(conditions_t), intent(out) :: self
      type(error_t), allocatable, intent(out) :: error
      real(dp) :: modulus_g, speed_u2, ratio

      call check_data(data, error)
      if (allocated(error)) return
      speed_u2 = data%viscosity_pa_s*2*data%mean_speed_m_per_s/(data%reduced_modulus_pa*data%radius_x_m)
      modulus_g = data%pressure_viscosity_per_pa*data%reduced_modulus_pa
      if (data%load_n_per_m > 0) then
         call set_moes(data%load_n_per_m/(data%reduced_modulus_pa*data%radius_x_m)*speed_u2**(-0.5_dp), &
                       modulus_g*speed_u2**0.25_dp, 0.0_dp, data%pressure_viscosity_per_pa, self, error)
      else
         ratio = data%radius_x_m/data%radius_y_m
         if (abs(ratio - 1) <= round_off) ratio = 1
         call set_moes(data%load_n/(data%reduced_modulus_pa*data%radius_x_m**2)*speed_u2**(-0.75_dp), &
                       modulus_g*speed_u2**0.25_dp, ratio, data%pressure_viscosity_per_pa, self, error)
      end if
      if (.not. allocated(error)) call check_range(self, error, data)
      if (allocated(error)) return
      self%has_dimensions = .true.
      self%data = data
      call set_lengths(self)
   end subroutine conditions_from_dimensional

   !> Hertz lengths and pressure from dimensional data, theory eq. (20) and (L2).
   pure subroutine set_lengths(self)
      type(conditions_t), intent(inout) :: self   !! all else is set
      real(dp) :: r_m

      associate (data => self%data, kappa => self%elliptic%kappa, k => self%elliptic%k, e => self%elliptic%e)
         if (self%is_line()) then
            self%a_m = sqrt(8*data%load_n_per_m*data%radius_x_m/(pi*data%reduced_modulus_pa))
            self%c_m = self%a_m**2/(2*data%radius_x_m)
            self%hertz_pressure_pa = 2*data%load_n_per_m/(pi*self%a_m)
         else
            r_m = 1/(1/data%radius_x_m + 1/data%radius_y_m)
            self%a_m = (3*data%load_n*r_m/data%reduced_modulus_pa*(2*kappa*e/pi))**(1.0_dp/3)
            self%b_m = self%a_m/kappa
            self%c_m = self%a_m**2/(2*r_m)*k/e
            self%hertz_pressure_pa = 3*data%load_n/(2*pi*self%a_m*self%b_m)
         end if
      end associate
   end subroutine set_lengths

   !> Whether all dimensional data are there: an elliptical contact has load_n and radius_y_m, a line contact
   !> load_n_per_m. The error names the first key that is missing.
   subroutine check_data(data, error)
      type(contact_data_t), intent(in) :: data
      type(error_t), allocatable, intent(out) :: error
      character(len=*), parameter :: key(*) = [character(len=25) :: 'radius_x_m', 'radius_y_m', 'reduced_modulus_pa', &
         'load_n', 'mean_speed_m_per_s', 'viscosity_pa_s', 'pressure_viscosity_per_pa']
      real(dp) :: value(size(key))
      integer :: i

      if (data%load_n_per_m > 0 .and. (data%load_n > 0 .or. data%radius_y_m > 0)) then
         call raise(error, 'load_n_per_m = '//to_text(data%load_n_per_m, 6)// &
            ' is the load of a line contact: leave out load_n '// &
                    'and radius_y_m, or, for an elliptical contact, load_n_per_m')
         return
      end if
      value = [data%radius_x_m, data%radius_y_m, data%reduced_modulus_pa, data%load_n, data%mean_speed_m_per_s, &
               data%viscosity_pa_s, data%pressure_viscosity_per_pa]
      do i = 1, size(key)
         if (value(i) > 0 .or. (data%load_n_per_m > 0 .and. any(key(i) == ['radius_y_m', 'load_n    ']))) cycle
         call raise(error, trim(key(i))//' is missing: dimensional conditions need all of radius_x_m, radius_y_m, '// &
            'reduced_modulus_pa, load_n, mean_speed_m_per_s, viscosity_pa_s; a line contact needs load_n_per_m '// &
            'in place of radius_y_m and load_n')
         return
      end do
   end subroutine check_data

end module ehlwave_conditions
