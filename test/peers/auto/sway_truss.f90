! Von Mises truss whose top may sway: bars (EA = 1) from (-b, 0) and (b, 0) to (0, h), b = PAR(2), h = 1.
! U(1) = sinking of the top, U(2) = sway, PAR(1) = load in units of EA (h/L)^3.
subroutine func(ndim, u, icp, par, ijac, f, dfdu, dfdp)
  implicit none
  integer, intent(in) :: ndim, icp(*), ijac
  double precision, intent(in) :: u(ndim), par(*)
  double precision, intent(out) :: f(ndim)
  double precision, intent(inout) :: dfdu(ndim, ndim), dfdp(ndim, *)
  double precision :: height, left, right, b
  b = par(2)
  height = 1 - u(1)
  ! Twice the Green-Lagrange strains times the square of the length.
  left = (u(2) + b)**2 + height**2 - (1 + b**2)
  right = (u(2) - b)**2 + height**2 - (1 + b**2)
  f(1) = par(1) + 0.5d0 * (left + right) * height
  f(2) = -0.5d0 * (left * (u(2) + b) + right * (u(2) - b))
end subroutine func

subroutine stpnt(ndim, u, par, t)
  implicit none
  integer, intent(in) :: ndim
  double precision, intent(inout) :: u(ndim), par(*)
  double precision, intent(in) :: t
  par(1) = 0
  par(2) = 0.5d0
  u = 0
end subroutine stpnt

subroutine bcnd
end subroutine bcnd
subroutine icnd
end subroutine icnd
subroutine fopt
end subroutine fopt
subroutine pvls
end subroutine pvls
