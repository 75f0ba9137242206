#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "atrapos/contact/CurveContactLaw.hpp"
#include "atrapos/contact/PatchSearch.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/Multipliers.hpp"
#include "atrapos/fem/PointLawOf.hpp"

namespace atrapos::contact {

/// The points' nodes and parameters of contact with its curve as unknown, and their data but for the tool's.
struct CurvePoints {
  fem::PointSet points;
  std::vector<double> data;  ///< [point] Delta, X
};

/// Gives the model a node more for every point, whose first unknown is t, a part of the path parameter.
/// Throws std::invalid_argument for gaps that the law cannot have.
CurvePoints withCurves(fem::FeModel& model, const fem::PointSet& points, const RegularisedPressure& pressure,
                       const std::vector<double>& gaps);

/// Adds contact of these points by law (15) with its curve as unknown; `gaps`: Delta of every point. The term
/// is the model's last. Weights of the points multiply the forces, as in LawTerm.
template <class Tool>
void addCurveContact(fem::FeModel& model, const fem::PointSet& points, const Tool& tool,
                     const RegularisedPressure& pressure, const std::vector<double>& gaps) {
  tool.validate();
  using Law = CurveContactLaw<Tool>;
  const CurvePoints curves = withCurves(model, points, pressure, gaps);
  model.terms.push_back(
      fem::lawTerm(fem::pointLaw(Law{tool, pressure}), fem::withUnknowns(curves.points), curves.data));
}

/// The same with a set of patches, at rest (PatchTool) or moving (MovingTool<PatchTool>).
template <class Tool>
void addCurveContact(fem::FeModel& model, const fem::PointSet& points, const PatchSearch<Tool>& search,
                     const RegularisedPressure& pressure, const std::vector<double>& gaps) {
  search.tool.validate();
  using Law = CurveContactLaw<Tool>;
  const CurvePoints curves = withCurves(model, points, pressure, gaps);
  std::vector<double> data;
  for (int p = 0; p < curves.points.numEntities; ++p) {
    data.insert(data.end(), &curves.data[Law::toolData * p], &curves.data[Law::toolData * p] + Law::toolData);
    data.insert(data.end(), {-1, 0, 0});
  }
  const auto pieces =
      search.pieces(Law::numInputs, Law::toolData,
                    [](const double* in, const double* own, double* x) { Law::placeOf(in, own, x); });
  model.terms.push_back(fem::lawTerm(fem::pointLaw(Law{search.tool, pressure}),
                                     fem::withUnknowns(curves.points), data, pieces));
}

}  // namespace atrapos::contact
