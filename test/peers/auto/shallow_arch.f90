! Shallow pinned arch (EI = 1, span pi), rise e sin x, pressed down by lambda sin x, w = sum u_n sin(n x),
! Galerkin with four modes; e = PAR(2). Energy divided by pi/2:
!   sum n^4 (u_n - e_n)^2 / 2 + T^2 / 2 + lambda u_1,   T = sum n^2 (u_n^2 - e_n^2) / 2.
subroutine func(ndim, u, icp, par, ijac, f, dfdu, dfdp)
  implicit none
  integer, intent(in) :: ndim, icp(*), ijac
  double precision, intent(in) :: u(ndim), par(*)
  double precision, intent(out) :: f(ndim)
  double precision, intent(inout) :: dfdu(ndim, ndim), dfdp(ndim, *)
  double precision :: e(ndim), thrust
  integer :: n
  e = 0
  e(1) = par(2)
  thrust = 0
  do n = 1, ndim
    thrust = thrust + 0.5d0 * n**2 * (u(n)**2 - e(n)**2)
  end do
  do n = 1, ndim
    f(n) = -(dble(n)**4 * (u(n) - e(n)) + dble(n)**2 * u(n) * thrust)
  end do
  f(1) = f(1) - par(1)
end subroutine func

subroutine stpnt(ndim, u, par, t)
  implicit none
  integer, intent(in) :: ndim
  double precision, intent(inout) :: u(ndim), par(*)
  double precision, intent(in) :: t
  par(1) = 0
  par(2) = 4
  u = 0
  u(1) = par(2)
end subroutine stpnt

subroutine bcnd
end subroutine bcnd
subroutine icnd
end subroutine icnd
subroutine fopt
end subroutine fopt
subroutine pvls
end subroutine pvls
