#include "atrapos/contact/CurveContact.hpp"

#include <stdexcept>

namespace atrapos::contact {

CurvePoints withCurves(fem::FeModel& model, const fem::PointSet& points, const RegularisedPressure& pressure,
                       const std::vector<double>& gaps) {
  pressure.validate();
  CurvePoints curves{fem::withMultipliers(model, points), {}};
  const fem::PointSet& own = curves.points;
  for (int p = 0; p < own.numEntities; ++p) {
    if (!(gaps.at(p) > pressure.compliance * pressure.eta))
      throw std::invalid_argument("contact point " + std::to_string(p + 1) +
                                  ": the reference gap must be > eta/alpha, got " + std::to_string(gaps[p]));
    curves.data.push_back(gaps[p]);
    curves.data.insert(curves.data.end(), &own.positions[3 * p], &own.positions[3 * p] + 3);
    model.parameters.push_back(3 * own.nodes[(p + 1) * own.nodesPerEntity - 1]);
  }
  return curves;
}

}  // namespace atrapos::contact
