! Column of 10 rigid links of length h = 1/10, clamped at its foot, pressed by lambda at its top, springs
! 1/h between the links and 2/h at the foot, one shortening s of stiffness EA = 100 for all.
! U(1) = s, U(1 + i) = angle of link i, PAR(1) = lambda.
subroutine func(ndim, u, icp, par, ijac, f, dfdu, dfdp)
  implicit none
  integer, intent(in) :: ndim, icp(*), ijac
  double precision, intent(in) :: u(ndim), par(*)
  double precision, intent(out) :: f(ndim)
  double precision, intent(inout) :: dfdu(ndim, ndim), dfdp(ndim, *)
  double precision :: h
  integer :: i, n
  n = ndim - 1
  h = 1d0 / n
  f(1) = -100 * u(1)
  do i = 1, n
    f(1) = f(1) - h * par(1) * cos(u(i + 1))
    f(i + 1) = h * par(1) * (1 + u(1)) * sin(u(i + 1))
    if (i == 1) then
      f(i + 1) = f(i + 1) - 2 / h * u(2)
    else
      f(i + 1) = f(i + 1) - (u(i + 1) - u(i)) / h
    end if
    if (i < n) f(i + 1) = f(i + 1) + (u(i + 2) - u(i + 1)) / h
  end do
end subroutine func

subroutine stpnt(ndim, u, par, t)
  implicit none
  integer, intent(in) :: ndim
  double precision, intent(inout) :: u(ndim), par(*)
  double precision, intent(in) :: t
  par(1) = 0
  u = 0
end subroutine stpnt

subroutine bcnd
end subroutine bcnd
subroutine icnd
end subroutine icnd
subroutine fopt
end subroutine fopt

! PAR(3) = rotation of the free end, where it is flat: parabola through the last two links.
subroutine pvls(ndim, u, par)
  implicit none
  integer, intent(in) :: ndim
  double precision, intent(in) :: u(ndim)
  double precision, intent(inout) :: par(*)
  par(3) = 1.125d0 * u(ndim) - 0.125d0 * u(ndim - 1)
end subroutine pvls
