!> Gauss-Legendre rules on -1..1.
module ehlwave_gauss_legendre
   use ehlwave_kinds, only: dp, pi
   implicit none (type, external)
   private
   public :: new_gauss_rule

   !> Nodes in ascending order and weights that sum to 2; exact for polynomials up to degree 2 n - 1.
   type, public :: gauss_rule_t
      integer :: n = 0
      real(dp), allocatable :: node(:), weight(:)   !! (n)
   end type gauss_rule_t

contains

   !> Rule of n points: Newton for the roots of the Legendre polynomial from cos(pi (i - 1/4)/(n + 1/2)), which
   !> converges for all n in a few steps; weights 2/((1 - z^2) P_n'(z)^2). Symmetric to the last digit.
   pure function new_gauss_rule(n) result(self)
      integer, intent(in) :: n   !! number of points, at least 1
      type(gauss_rule_t) :: self
      integer, parameter :: steps = 5
      real(dp) :: slope, value, z
      integer :: i, step

      self%n = n
      allocate (self%node(n), self%weight(n))
      do i = 1, (n + 1)/2
         z = cos(pi*(i - 0.25_dp)/(n + 0.5_dp))
         if (2*i == n + 1) z = 0
         do step = 1, steps
            call legendre(n, z, value, slope)
            if (2*i /= n + 1) z = z - value/slope
         end do
         self%node(n + 1 - i) = z
         self%node(i) = -z
         self%weight(n + 1 - i) = 2/((1 - z**2)*slope**2)
         self%weight(i) = self%weight(n + 1 - i)
      end do
   end function new_gauss_rule

   !> P_n(z) and its derivative, |z| < 1.
   pure subroutine legendre(n, z, value, slope)
      integer, intent(in) :: n
      real(dp), intent(in) :: z
      real(dp), intent(out) :: value, slope
      real(dp) :: before, later
      integer :: k

      before = 0
      value = 1
      do k = 1, n
         later = ((2*k - 1)*z*value - (k - 1)*before)/k
         before = value
         value = later
      end do
      slope = n*(z*value - before)/(z**2 - 1)
   end subroutine legendre

end module ehlwave_gauss_legendre
