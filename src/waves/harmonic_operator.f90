!> The linear operator for small changes of a single frequency: the contact linearised about its steady state.
module ehlwave_harmonic_operator
   use ehlwave_complex_linearised_contact, only: linearised_contact_t
   use ehlwave_cycle_settings, only: response_cycle
   use ehlwave_given, only: given_t, steady_given
   use ehlwave_hierarchy, only: level_t
   use ehlwave_kinds, only: dp
   use ehlwave_memory, only: many_nodes, return_memory
   use ehlwave_state, only: state_t
   use ehlwave_transport, only: harmonic_wedge
   use ehlwave_two_waves, only: wave_medium_t
   use ehlwave_wave_medium, only: take_media
   implicit none (type, external)
   private

   !> The contact linearised about a steady state, for changes of a single frequency at a time.
   type, public :: harmonic_operator_t
      type(linearised_contact_t) :: linear
      logical :: is_real = .false.                 !! whether the change is real and stationary
      real(dp), private :: frequency = 0           ! frequency of the operator
      logical, private :: has_factors = .false.    ! factors of the frequency
   contains
      procedure :: init
      procedure :: drop
      procedure :: set_frequency
   end type harmonic_operator_t

contains

   !> Linearise about the steady state of the finest of `levels`, of smooth surfaces; coarser levels about their own
   !> steady state, where it is similar. Injection from the finest grid would miss a spike two nodes wide. For the book
   !> case on 2048^2 cells this halves the GMRES steps (25 in place of 48).
   subroutine init(self, levels)
      class(harmonic_operator_t), intent(inout) :: self
      type(level_t), intent(inout) :: levels(:)   !! coarsest first
      type(given_t) :: given
      type(state_t) :: state
      integer :: l, n

      n = size(levels)
      self%has_factors = .false.
      call self%linear%init(levels, response_cycle)
      call self%linear%start(n)
      do l = n, 1, -1
         if (l < n) then
            if (.not. is_like(levels(l), levels(n))) exit
            self%linear%levels(l)%has_own_state = .true.
         end if
         state = levels(l)%state
         associate (problem => levels(l)%problem, equations => self%linear%levels(l)%equations)
            given = steady_given(problem%grid, levels(l)%given%supply)
            call problem%film(given, state%p, state%delta, state%h)
            call equations%evaluate(problem, given, state)
         end associate
      end do
      do l = 1, n
         call self%linear%levels(l)%equations%keep_changes()
      end do
      if (self%linear%n > many_nodes) call return_memory()
   end subroutine init

   !> Whether a coarser level has a solution of the same case that resolves it. Levels of a heavy load do not: M =
   !> 10,000, 1024^2, with their states: 22 GMRES steps in place of 14.
   pure logical function is_like(coarse, fine)
      type(level_t), intent(in) :: coarse, fine
      real(dp), parameter :: largest_change = 0.05_dp   ! share of H(0,0)
      is_like = .false.
      if (allocated(fine%given%supply) .or. allocated(fine%problem%heat)) return
      if (.not. (coarse%has_film() .and. fine%has_film())) return
      is_like = abs(coarse%central_film/fine%central_film - 1) < largest_change
   end function is_like

   !> Free the data that the next `init` makes anew for another frequency.
   subroutine drop(self)
      class(harmonic_operator_t), intent(inout) :: self
      if (allocated(self%linear%levels)) deallocate (self%linear%levels)
      self%has_factors = .false.
   end subroutine drop

   !> Operator for changes of a single frequency, and its factors unless available. A real, stationary change uses the
   !> tangent's factors.
   subroutine set_frequency(self, levels, frequency, inertia, is_real, along)
      class(harmonic_operator_t), intent(inout) :: self
      type(level_t), intent(inout), target :: levels(:)   !! levels of `init`
      real(dp), intent(in) :: frequency       !! w in units of 1/T
      complex(dp), intent(in) :: inertia      !! weight of Delta in the load row, 0: force balance
      logical, intent(in) :: is_real
      real(dp), intent(in), optional :: along !! wave number along a line contact, 1/a; absent: 0
      real(dp) :: wanted
      integer :: l

      self%is_real = is_real
      wanted = 0
      if (present(along)) wanted = along
      associate (linear => self%linear)
         if (abs(wanted - linear%along) > 0) then
            self%has_factors = .false.
            call linear%set_along(wanted, flow_along(levels(linear%finest)))
         end if
         call linear%borrow(levels)
         if (self%has_factors .and. abs(frequency - self%frequency) <= 0 .and. abs(inertia - linear%inertia) <= 0) then
            if (.not. is_real) call linear%count_factors()
         else
            do l = 1, linear%finest
               linear%levels(l)%wedge = harmonic_wedge(linear%levels(l)%equations%mesh%grid, frequency, &
                                                       linear%levels(linear%finest)%equations%mesh%grid%hx)
            end do
            linear%inertia = inertia
            call linear%weigh(linear%finest)
            if (.not. is_real) call linear%factorise(1)
            self%frequency = frequency
            self%has_factors = .not. is_real
         end if
         call linear%release()
      end associate
   end subroutine set_frequency

   !> Flow along Y over the pressure gradient there, at each node: theory eq. (W16).
   function flow_along(level) result(mobility)
      type(level_t), intent(in) :: level         !! with its steady state
      real(dp), allocatable :: mobility(:, :)    !! (0:nx, 0:ny), 0 at both ends
      type(wave_medium_t), allocatable :: medium(:, :)
      integer :: i

      associate (grid => level%problem%grid)
         allocate (mobility(0:grid%nx, 0:grid%ny), source=0.0_dp)
         allocate (medium(0:grid%ny, 1:grid%nx - 1))
         call take_media(level%problem, level%state, 1, medium)
         do i = 1, grid%nx - 1
            mobility(i, :) = medium(:, i)%eps(2)
         end do
      end associate
   end function flow_along

end module ehlwave_harmonic_operator
