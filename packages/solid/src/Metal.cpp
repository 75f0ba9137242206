#include "atrapos/solid/Metal.hpp"

#include <cmath>
#include <stdexcept>

#include "atrapos/solid/SaintVenantKirchhoff.hpp"

namespace atrapos::solid {

Metal metalFromYoung(double E, double nu, const Metal& plastic) {
  const auto elastic = SaintVenantKirchhoff::fromYoung(E, nu);
  Metal m = plastic;
  m.lambda = elastic.lambda;
  m.mu = elastic.mu;
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(what);
  };
  require(m.yieldStress > 0 && std::isfinite(m.yieldStress), "the yield stress must be positive");
  for (const double x : {m.modulus, m.saturation, m.exponent, m.kinematicModulus, m.recall})
    require(std::isfinite(x), "hardening must be finite");
  require(m.exponent >= 0, "the exponent of Voce's hardening must not be negative");
  require(m.width >= 0 && m.width <= 0.5, "the width of a smoothed yield surface must be 0 to 0.5");
  require(m.kinematicModulus >= 0 && m.recall >= 0, "kinematic hardening must not be negative");
  require(m.modulus >= 0 && m.yieldStress + m.saturation > 0,
          "isotropic hardening must not use up the yield stress");
  require(3 * m.mu + m.kinematicModulus + m.modulus + std::fmin(0.0, m.saturation * m.exponent) > 0,
          "the material softens faster than its elasticity allows");
  return m;
}

}  // namespace atrapos::solid
