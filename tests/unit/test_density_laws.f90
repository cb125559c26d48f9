!> Density laws: values, derivatives against finite differences, limits.
program test_density_laws
   use ehlwave_density_law, only: density_law_t
   use ehlwave_dowson_higginson_density, only: dowson_higginson_density_t
   use ehlwave_incompressible_density, only: incompressible_density_t
   use ehlwave_kinds, only: dp
   use ehlwave_tait_density, only: tait_density_t
   use testing, only: test_t
   implicit none (type, external)

   type(tait_density_t), parameter :: tait = tait_density_t(modulus_pa=1.2e9_dp, modulus_rate=11.0_dp, &
                                                            expansion_per_k=7.5e-4_dp, softening_per_k=6e-3_dp)
   type(test_t) :: test
   real(dp), parameter :: p = 0.7e9_dp

   call check_law('Dowson-Higginson', dowson_higginson_density_t(expansion_per_k=7e-4_dp))
   call check_law('incompressible', incompressible_density_t(expansion_per_k=7e-4_dp))
   call check_law('Tait', tait)
   call test%check_close(density_of(dowson_higginson_density_t(), p, 0.0_dp), (5.9e8_dp + 1.34_dp*p)/(5.9e8_dp + p), &
                         'Dowson-Higginson', relative=1e-14_dp)
   call test%check_close(density_of(dowson_higginson_density_t(expansion_per_k=7e-4_dp), 0.0_dp, 40.0_dp), 1 - 0.028_dp, &
                         'Dowson-Higginson, warm', relative=1e-14_dp)
   call test%check_close(density_of(tait, p, 0.0_dp), 1/(1 - log(1 + 12*p/1.2e9_dp)/12), 'Tait', relative=1e-14_dp)
   call test%check_close(density_of(tait, p, 40.0_dp), 1/(1.03_dp*(1 - log(1 + 12*p/(1.2e9_dp*exp(-0.24_dp)))/12)), &
                         'Tait, warm', relative=1e-14_dp)
   call test%check(density_of(tait, 1e15_dp, 0.0_dp) < 4, 'Tait is bounded')
   call test%finish()

contains

   real(dp) function density_of(law, p_pa, rise_k)
      class(density_law_t), intent(in) :: law
      real(dp), intent(in) :: p_pa, rise_k
      real(dp), dimension(1) :: rho, slope_per_k, slope_per_pa
      call law%evaluate(1, [p_pa], [rise_k], rho, slope_per_pa, slope_per_k)
      density_of = rho(1)
   end function density_of

   subroutine check_law(name, law)
      character(len=*), intent(in) :: name
      class(density_law_t), intent(in) :: law
      real(dp), parameter :: pressure(3) = [1e6_dp, 0.4e9_dp, 1.3e9_dp], rise(3) = [-10.0_dp, 0.0_dp, 30.0_dp]
      real(dp), parameter :: step = 1e4_dp, step_k = 1e-2_dp
      real(dp), dimension(3) :: by_k, by_pa, rho
      integer :: i

      call law%evaluate(3, pressure, rise, rho, by_pa, by_k)
      do i = 1, 3
         call test%check_close(by_pa(i), (density_of(law, pressure(i) + step, rise(i)) &
                                          - density_of(law, pressure(i) - step, rise(i)))/(2*step), name//': by pressure', &
                               relative=1e-6_dp, absolute=1e-20_dp)
         call test%check_close(by_k(i), (density_of(law, pressure(i), rise(i) + step_k) &
                                         - density_of(law, pressure(i), rise(i) - step_k))/(2*step_k), name//': by temperature', &
                               relative=1e-6_dp)
      end do
      call test%check_close(density_of(law, 0.0_dp, 0.0_dp), 1.0_dp, name//': ambient', relative=0.0_dp)
   end subroutine check_law

end program test_density_laws
