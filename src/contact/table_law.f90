!> Measured viscosities, interpolated.
module ehlwave_table_law
   use ehlwave_errors, only: error_t, raise
   use ehlwave_kinds, only: dp
   use ehlwave_monotone_curve, only: monotone_curve_t
   use ehlwave_number_table, only: number_table_t
   use ehlwave_text, only: to_text
   use ehlwave_viscosity_law, only: largest_exponent, viscosity_law_t
   use ehlwave_viscosity_table, only: pressure, read_curves, temperature
   implicit none (type, external)
   private
   public :: new_table_law

   !> ln(eta) = sum_k w_k(X) y_k(p),  X = 1/(T - 178 K): y_k is the curve through ln(eta) at the temperature T_k, see
   !> `core/monotone_curve`. ln(eta) is nearly straight in X: Vogel's law with Cameron's constant, 95 C, is straight.
   !> With two temperatures the weights w are straight. With more, the weights come from parabolas through three
   !> temperatures; neighbouring parabolas are blended linearly. So both slopes are continuous. ln(eta) goes on with
   !> its last slope by p beyond the largest pressure, and by X beyond the temperatures.
   type, extends(viscosity_law_t), public :: table_law_t
      type(monotone_curve_t), allocatable, private :: curves(:)   ! curves of ln(eta/Pa s) over p, temperatures rising
      real(dp), allocatable, private :: x(:)                      ! X of the curves, 1/K
      real(dp), private :: temperature_k = 0                      ! T0, K
      real(dp), private :: ambient = 0                            ! ln(eta0/Pa s)
   contains
      procedure :: evaluate
      procedure, private :: weigh
   end type table_law_t

   real(dp), parameter :: vogel_k = 178                          ! pole of X
   real(dp), parameter :: same_k = 0.01_dp                       ! difference below which temperatures count as equal

contains

   !> Law of a table, see `read_curves`. Fails as that, and where T0 is missing or out of range.
   pure subroutine new_table_law(table, temperature_k, law, error)
      type(number_table_t), intent(in) :: table
      real(dp), intent(in) :: temperature_k        !! T0, K; 0: the temperature of a table with a single temperature
      type(table_law_t), intent(out) :: law
      type(error_t), allocatable, intent(inout) :: error
      real(dp), allocatable :: list(:)             ! temperatures

      call read_curves(table, list, law%curves, error)
      if (allocated(error)) return
      law%x = 1/(list - vogel_k)
      call choose_temperature(table, list, temperature_k, law, error)
      if (.not. allocated(error)) call finish(table, law, error)
   end subroutine new_table_law

   !> T0 of the law: as requested, or the only temperature of the table.
   pure subroutine choose_temperature(table, list, temperature_k, law, error)
      type(number_table_t), intent(in) :: table
      real(dp), intent(in) :: list(:)              !! temperatures, rising; 0: not given by the table
      real(dp), intent(in) :: temperature_k        !! asked for, 0: none
      type(table_law_t), intent(inout) :: law
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: range

      range = to_text(list(1), 6)
      if (size(list) > 1) range = to_text(size(list))//' temperatures, '//range//' to '//to_text(list(size(list)), 6)
      law%temperature_k = temperature_k
      if (size(list) == 1 .and. .not. temperature_k > 0) law%temperature_k = list(1)
      if (table%column(temperature) == 0) then
         continue
      else if (.not. law%temperature_k > 0) then
         call raise(error, table%path//': has '//range//' K: &lubricant temperature_k is needed')
      else if (law%temperature_k < list(1) - same_k .or. law%temperature_k > list(size(list)) + same_k) then
         call raise(error, table%path//': &lubricant temperature_k = '//to_text(temperature_k, 6)// &
                    ' is outside the table ('//range//' K): change it, or measure there')
      end if
   end subroutine choose_temperature

   !> eta0 and the largest pressure of a law whose T0 is known. Refuse viscosities that rise with temperature, and
   !> interpolated ones that do not rise with pressure.
   pure subroutine finish(table, law, error)
      type(number_table_t), intent(in) :: table
      type(table_law_t), intent(inout) :: law
      type(error_t), allocatable, intent(inout) :: error
      real(dp), dimension(size(law%curves)) :: ambient, weight, weight_per_k
      real(dp), dimension(size(table%line)) :: exponent, isothermal, slope, slope_per_k
      real(dp) :: unused
      integer :: k, piece

      do k = 1, size(ambient)
         piece = 1
         call law%curves(k)%evaluate(0.0_dp, piece, ambient(k), unused)
      end do
      if (any(ambient(2:) >= ambient(:size(ambient) - 1))) then
         call raise(error, table%path//': viscosity at ambient pressure does not fall with temperature everywhere')
         return
      end if
      call law%weigh(law%temperature_k, weight, weight_per_k)
      law%ambient = sum(weight*ambient)
      law%ambient_pa_s = exp(law%ambient)
      do k = 1, size(ambient)
         if (abs(weight(k)) > 0) law%largest_pressure_pa = min(law%largest_pressure_pa, maxval(law%curves(k)%x))
      end do
      isothermal = 0
      call law%evaluate(size(slope), table%values(:, table%column(pressure)), isothermal, exponent, slope, slope_per_k)
      if (any(slope <= 0)) call raise(error, table%path//': viscosity interpolated at '// &
                                      to_text(law%temperature_k, 6)//' K does not rise with pressure everywhere: '// &
                                      'smooth the values')
   end subroutine finish

   !> The curves are asked in turn for every pressure; neighbouring pressures mostly lie in the same piece of a curve.
   pure subroutine evaluate(self, n, p_pa, rise_k, exponent, slope_per_pa, slope_per_k)
      class(table_law_t), intent(in) :: self
      integer, intent(in) :: n
      real(dp), intent(in) :: p_pa(n), rise_k(n)
      real(dp), intent(out) :: exponent(n), slope_per_pa(n), slope_per_k(n)
      real(dp), dimension(size(self%curves)) :: weight, weight_per_k
      real(dp) :: slope, y
      integer :: i, k, piece(size(self%curves))

      piece = 1
      do i = 1, n
         if (is_new(i)) call self%weigh(self%temperature_k + rise_k(i), weight, weight_per_k)
         exponent(i) = -self%ambient
         slope_per_pa(i) = 0
         slope_per_k(i) = 0
         do k = 1, size(self%curves)
            if (max(abs(weight(k)), abs(weight_per_k(k))) <= 0) cycle
            call self%curves(k)%evaluate(p_pa(i), piece(k), y, slope)
            exponent(i) = exponent(i) + weight(k)*y
            slope_per_pa(i) = slope_per_pa(i) + weight(k)*slope
            slope_per_k(i) = slope_per_k(i) + weight_per_k(k)*y
         end do
         exponent(i) = min(exponent(i), largest_exponent)
      end do

   contains

      !> Whether a temperature differs from the previous one.
      pure logical function is_new(i)
         integer, intent(in) :: i
         is_new = i == 1
         if (.not. is_new) is_new = abs(rise_k(i) - rise_k(i - 1)) > 0
      end function is_new

   end subroutine evaluate

   !> Weights of the curves at a temperature, and their derivatives by it.
   pure subroutine weigh(self, temperature_k, weight, per_k)
      class(table_law_t), intent(in) :: self
      real(dp), intent(in) :: temperature_k
      real(dp), intent(out) :: weight(:), per_k(:)
      real(dp) :: inside, left(3), left_slope(3), right(3), right_slope(3), t, width, x
      integer :: centre, k, n

      n = size(self%x)
      weight = 0
      per_k = 0
      if (n == 1) then
         weight(1) = 1
         return
      end if
      x = 1/max(temperature_k - vogel_k, 1.0_dp)       ! far below any table
      inside = max(self%x(n), min(self%x(1), x))       ! x falls as temperatures rise
      k = max(1, min(n - 1, count(self%x >= inside)))
      width = self%x(k + 1) - self%x(k)
      t = (inside - self%x(k))/width
      if (n == 2) then
         weight = [1 - t, t]
         per_k = [-1, 1]/width
      else
         centre = max(2, k)
         call parabola(self%x(centre - 1:centre + 1), inside, left, left_slope)
         weight(centre - 1:centre + 1) = (1 - t)*left
         per_k(centre - 1:centre + 1) = (1 - t)*left_slope - left/width
         centre = min(n - 1, k + 1)
         call parabola(self%x(centre - 1:centre + 1), inside, right, right_slope)
         weight(centre - 1:centre + 1) = weight(centre - 1:centre + 1) + t*right
         per_k(centre - 1:centre + 1) = per_k(centre - 1:centre + 1) + t*right_slope + right/width
      end if
      weight = weight + (x - inside)*per_k
      per_k = -per_k*x**2                              ! dX/dT = -X^2
   end subroutine weigh

   !> Weights of three points in the parabola through them, and their slopes.
   pure subroutine parabola(points, x, weight, slope)
      real(dp), intent(in) :: points(3), x
      real(dp), intent(out) :: weight(3), slope(3)
      real(dp) :: a, b, c
      integer :: i
      do i = 1, 3
         a = points(i)
         b = points(1 + modulo(i, 3))
         c = points(1 + modulo(i + 1, 3))
         weight(i) = (x - b)*(x - c)/((a - b)*(a - c))
         slope(i) = (2*x - b - c)/((a - b)*(a - c))
      end do
   end subroutine parabola

end module ehlwave_table_law
