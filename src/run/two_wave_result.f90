!> Attenuated and complementary wave in the linear response of a case under slip.
module ehlwave_two_wave_result
   use ehlwave_contact_problem, only: contact_problem_t
   use ehlwave_kinds, only: dp, no_value, pi
   use ehlwave_state, only: state_t
   use ehlwave_wave_medium, only: take_media
   use ehlwave_two_waves, only: fit_two_waves, two_waves_t, wave_medium_t
   use ehlwave_waviness, only: waviness_t
   implicit none (type, external)
   private
   public :: new_two_wave_result

   real(dp), parameter :: half_window = 0.5_dp      ! range of X over which the film is split
   real(dp), parameter :: least_pressure = 0.05_dp  ! P of rows that are inside the contact

   complex(dp), parameter :: no_number = (no_value, no_value)

   !> The waves about X = 0 in a row; NaN outside the contact.
   type, public :: wave_row_t
      type(two_waves_t) :: fit                     !! as the film has them
      complex(dp) :: attenuated = no_number        !! a in closed form
      complex(dp) :: psi = no_number               !! wave number of the complementary wave in closed form, 1/a
   end type wave_row_t

   type, public :: two_wave_result_t
      type(wave_row_t) :: centre                   !! the row nearest to Y = 0
      type(wave_row_t), allocatable :: rows(:)     !! (0:ny)
   end type two_wave_result_t

contains

   !> Split the response of the film, (0:nx, 0:ny) over Ai, to a pattern that moves.
   function new_two_wave_result(problem, state, waviness, h) result(self)
      type(contact_problem_t), intent(in) :: problem
      type(state_t), intent(in) :: state            !! steady state
      type(waviness_t), intent(in) :: waviness
      complex(dp), intent(in) :: h(0:, 0:)
      type(two_wave_result_t) :: self
      type(wave_medium_t), allocatable :: medium(:, :)   ! (0:ny, first:last)
      complex(dp), allocatable :: shape(:, :)            ! (first:last, 2)
      integer :: column, first, i, j, last
      real(dp) :: kx, ky

      associate (grid => problem%grid)
         column = minloc(abs(grid%x), 1) - 1
         first = column - int(half_window/grid%hx + 1e-9_dp)
         last = 2*column - first
         allocate (self%rows(0:grid%ny))
         if (first < 1 .or. last > grid%nx - 1) return
         allocate (medium(0:grid%ny, first:last), shape(first:last, 2))
         kx = 2*pi/waviness%wavelength_x
         ky = 0
         if (waviness%wavelength_y > 0) ky = 2*pi/waviness%wavelength_y
         call take_media(problem, state, first, medium)
         do j = grid%first_row, grid%last_row
            if (state%p(column, j) < least_pressure) cycle
            associate (row => self%rows(j), centre => medium(j, column))
               row%attenuated = centre%attenuated(kx, ky, waviness%slip)
               row%psi = centre%complementary_number(kx*waviness%slip, ky)
               do i = first, last
                  shape(i, 1) = medium(j, i)%attenuated(kx, ky, waviness%slip)/row%attenuated
                  shape(i, 2) = medium(j, i)%h/centre%h
               end do
               row%fit = fit_two_waves(grid%x(first:last), h(first:last, j), kx, row%psi, shape)
            end associate
         end do
         self%centre = self%rows(minloc(abs(grid%y), 1) - 1)
      end associate
   end function new_two_wave_result

end module ehlwave_two_wave_result
