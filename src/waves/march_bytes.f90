!> Values of a march under way as bytes, for checkpoints.
module ehlwave_march_bytes
   use ehlwave_byte_stream, only: bytes_t
   use ehlwave_energy, only: energy_t
   use ehlwave_march_past, only: march_past_t
   use ehlwave_rescue, only: rescue_t
   implicit none (type, external)
   private
   public :: pass_energy, pass_past

contains

   !> Everything that the next steps depend on, to the bytes or from them. The steady state and `share` are not among
   !> it: they follow from the case.
   subroutine pass_past(bytes, march, rescue)
      type(bytes_t), intent(inout) :: bytes
      class(march_past_t), intent(inout) :: march     !! when read: of the same shape
      type(rescue_t), intent(inout) :: rescue

      associate (r => march%result, past => march%past, given => march%given)
         if (.not. allocated(given%rough)) call given%set_rough(0*given%transport%carried)   ! before step 1
         call bytes%numbers(march%history%approach)
         call bytes%numbers(past%before%delta)
         call bytes%numbers(past%earlier%delta)
         call bytes%numbers(past%earliest%delta)
         call bytes%numbers(r%worst_residual)
         call bytes%numbers(r%worst_load_error)
         call bytes%numbers(r%work)
         call bytes%numbers(given%load%carried)
         call bytes%numbers(given%load%force)
         call bytes%numbers(rescue%thinnest)
         call bytes%numbers(rescue%work_left)
         call bytes%numbers(rescue%highest)
         call bytes%count(r%steps)
         call bytes%count(r%nonlinear_steps)
         call bytes%count(r%linear_steps)
         call bytes%count(r%factorisations)
         call bytes%count(rescue%steps_left)
         call bytes%count(rescue%rung)
         call bytes%count(rescue%rescued)
         call bytes%numbers(r%time)
         call bytes%numbers(r%central_film)
         call bytes%numbers(r%approach)
         call bytes%numbers(past%before%p)
         call bytes%numbers(past%before%h)
         call bytes%numbers(past%earlier%p)
         call bytes%numbers(past%earliest%p)
         call past%period%pass(bytes)
         call bytes%numbers(march%history%f)
         call bytes%numbers(given%transport%carried)
         call bytes%numbers(given%rough)
      end associate
   end subroutine pass_past

   !> Temperatures so far for the next steps, besides the steady temperatures.
   subroutine pass_energy(bytes, energy)
      type(bytes_t), intent(inout) :: bytes
      type(energy_t), intent(inout) :: energy
      integer :: wall

      call bytes%numbers(energy%difference)
      call bytes%numbers(energy%into_wall)
      call bytes%numbers(energy%rise)
      call bytes%numbers(energy%earlier%f)
      call bytes%numbers(energy%earlier%p)
      call bytes%numbers(energy%earlier%rise)
      call bytes%numbers(energy%earlier%before)
      do wall = 1, size(energy%walls)
         call bytes%numbers(energy%walls(wall)%rise)
         call bytes%numbers(energy%walls(wall)%heat)
         call bytes%numbers(energy%walls(wall)%modes)
      end do
   end subroutine pass_energy

end module ehlwave_march_bytes
