// Gap and pressure of a point over a cylinder, from the installed headers: law (15) with Delta = h gives R =
// 0.
#include <cmath>
#include <cstdio>

#include "atrapos/contact/ContactLaw.hpp"

using namespace atrapos;

int main() {
  contact::ContactLaw<contact::Cylinder> law;
  law.tool.radius = 2;
  law.pressure = {1e-3, 1e-2};
  const double x[] = {3, 7, 4}, delta[] = {3};  // 5 from the axis, the y axis
  double gapAndPressure[2];
  law.observe(x, delta, gapAndPressure);
  // Newton's method on numbers of order 1.
  if (std::abs(gapAndPressure[0] - 3) < 1e-14 && std::abs(gapAndPressure[1]) < 1e-14) return 0;
  std::printf("gap %.17g, pressure %.17g instead of 3, 0\n", gapAndPressure[0], gapAndPressure[1]);
  return 1;
}
