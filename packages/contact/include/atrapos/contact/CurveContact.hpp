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

/// Gives the model a place t on its curve for every point, a parameter of the law; t is the law's last input
/// but for the load factor. `gaps`: Delta of every point. Throws std::invalid_argument for those that the law
/// cannot have.
fem::PointSet withCurves(fem::FeModel& model, const fem::PointSet& points,
                         const RegularisedPressure& pressure, const std::vector<double>& gaps);

/// Adds contact of these points by law (15) with its curve as unknown; `gaps`: Delta of every point. The term
/// is the model's last. Weights of the points multiply the forces, as in LawTerm.
template <class Tool>
void addCurveContact(fem::FeModel& model, const fem::PointSet& points, const Tool& tool,
                     const RegularisedPressure& pressure, const std::vector<double>& gaps) {
  tool.validate();
  using Law = CurveContactLaw<Tool>;
  const fem::PointSet curves = withCurves(model, points, pressure, gaps);
  model.terms.push_back(fem::lawTerm(fem::pointLaw(Law{tool, pressure}), curves, gaps));
}

/// The same with a set of patches, at rest (PatchTool) or moving (MovingTool<PatchTool>).
template <class Tool>
void addCurveContact(fem::FeModel& model, const fem::PointSet& points, const PatchSearch<Tool>& search,
                     const RegularisedPressure& pressure, const std::vector<double>& gaps) {
  search.tool.validate();
  using Law = CurveContactLaw<Tool>;
  const fem::PointSet curves = withCurves(model, points, pressure, gaps);
  std::vector<double> data;
  for (const double gap : gaps) data.insert(data.end(), {gap, -1, 0, 0});
  const auto pieces = search.pieces(Law::numInputs, Law::toolData,
                                    [](const double* in, const double*, double* x) { Law::placeOf(in, x); });
  model.terms.push_back(fem::lawTerm(fem::pointLaw(Law{search.tool, pressure}), curves, data, pieces));
}

}  // namespace atrapos::contact
