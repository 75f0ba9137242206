! -u'' = lambda exp(u) on (0, 1), u = 0 at both ends: U(1) = u, U(2) = u', PAR(1) = lambda. A boundary value
! problem for AUTO's collocation at Gauss points, which shares nothing with collocation at Chebyshev points.
! PAR(2) = u(1/2): on the symmetric interval (0, 1/2) with u'(1/2) = 0 it is an end value.
subroutine func(ndim, u, icp, par, ijac, f, dfdu, dfdp)
  implicit none
  integer, intent(in) :: ndim, icp(*), ijac
  double precision, intent(in) :: u(ndim), par(*)
  double precision, intent(out) :: f(ndim)
  double precision, intent(inout) :: dfdu(ndim, ndim), dfdp(ndim, *)
  ! The half interval has length 1/2: derivatives with respect to t = 2 x.
  f(1) = 0.5d0 * u(2)
  f(2) = -0.5d0 * par(1) * exp(u(1))
end subroutine func

subroutine stpnt(ndim, u, par, t)
  implicit none
  integer, intent(in) :: ndim
  double precision, intent(inout) :: u(ndim), par(*)
  double precision, intent(in) :: t
  par(1) = 0
  u = 0
end subroutine stpnt

subroutine bcnd(ndim, par, icp, nbc, u0, u1, fb, ijac, dbc)
  implicit none
  integer, intent(in) :: ndim, icp(*), nbc, ijac
  double precision, intent(in) :: par(*), u0(ndim), u1(ndim)
  double precision, intent(out) :: fb(nbc)
  double precision, intent(inout) :: dbc(nbc, *)
  fb(1) = u0(1)
  fb(2) = u1(2)
end subroutine bcnd

subroutine icnd
end subroutine icnd
subroutine fopt
end subroutine fopt

subroutine pvls(ndim, u, par)
  implicit none
  integer, intent(in) :: ndim
  double precision, intent(in) :: u(ndim, *)
  double precision, intent(inout) :: par(*)
  double precision, external :: getp
  par(2) = getp("BV1", 1, u)
end subroutine pvls
