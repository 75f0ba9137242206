#include "atrapos/contact/CurveContact.hpp"

#include <stdexcept>

namespace atrapos::contact {

fem::PointSet withCurves(fem::FeModel& model, const fem::PointSet& points,
                         const RegularisedPressure& pressure, const std::vector<double>& gaps) {
  pressure.validate();
  for (int p = 0; p < points.numPoints(); ++p)
    if (!(gaps.at(p) > pressure.compliance * pressure.eta))
      throw std::invalid_argument("contact point " + std::to_string(p + 1) +
                                  ": the reference gap must be > eta/alpha, got " + std::to_string(gaps[p]));
  return fem::withParameter(model, points, {"place on the contact curve", {""}, fem::Role::parameter});
}

}  // namespace atrapos::contact
