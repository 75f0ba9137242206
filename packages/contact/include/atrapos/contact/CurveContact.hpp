#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "atrapos/contact/ContactLaw.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/Multipliers.hpp"

namespace atrapos::contact {

/// Law (15) with the place t on its curve as an unknown of the problem (docs/theory/contact.md, The contact
/// curve as unknown):
///
///     h = Delta e^-t - c eta (e^t + e^-t - 2),   R = eta (e^t - 1),   c = 1/alpha
///
/// Both are entire in t, t = 0 is h = Delta, and dh/dt < 0 everywhere; c = 0 is the barrier form. Needs Delta
/// > c eta.
///
/// in:   (u_x, t, u_y, -, u_z, -) of fem::DisplacementAndUnknown; with a tool that moves also the load
/// factor. data: Delta, X. out:  (-R n_x, -R'(t) (h - h(t)), -R n_y, 0, -R n_z, 0), the derivatives of one
/// potential where n = grad h.
template <class Tool>
struct CurveContactLaw {
  static_assert(detail::ToolData<Tool>::value == 0,
                "the contact curve is for tools without data of their own");
  static constexpr int numPlace = detail::PlaceInputs<Tool>::value;
  static constexpr int numInputs = 3 + numPlace, numOutputs = 6, numData = 4;
  static constexpr bool symmetric = Tool::symmetric;

  Tool tool;
  RegularisedPressure pressure;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    using std::exp;
    T projection[Tool::numUnknowns];
    project(in, data, projection);
    const T up = exp(in[1]), down = exp(-in[1]);
    const T R = pressure.eta * (up - 1.0);
    for (int i = 0; i < 3; ++i) out[2 * i] = -(R * projection[1 + i]);
    const T mismatch =
        projection[0] - data[0] * down + (pressure.compliance * pressure.eta) * (up + down - 2.0);
    out[1] = -(pressure.eta * (up * mismatch));
    out[3] = out[5] = T(0.0);
  }

  static constexpr int numObserved = 2;
  static std::vector<std::string> observedNames() { return {"contact_gap", "contact_pressure"}; }
  KOKKOS_INLINE_FUNCTION void observe(const double* in, const double* data, double* observed) const {
    double projection[Tool::numUnknowns];
    project(in, data, projection);
    observed[0] = projection[0];
    observed[1] = pressure.eta * std::expm1(in[1]);
  }

  void validate() const {
    tool.validate();
    pressure.validate();
  }

 private:
  template <class T>
  KOKKOS_INLINE_FUNCTION void project(const T* in, const taylor::Passive<T>* data, T* projection) const {
    T place[numPlace];
    for (int i = 0; i < 3; ++i) place[i] = in[2 * i] + data[1 + i];
    if constexpr (numPlace == 4) place[3] = in[6];
    for (int i = 0; i < Tool::numUnknowns; ++i) projection[i] = T(0.0);
    taylor::solveImplicit<numPlace, Tool::numUnknowns>(tool, place, projection);
  }
};

/// Adds contact of these points by law (15) with its curve as unknown; `gaps`: Delta of every point. The term
/// is the model's last. Weights of the points multiply the forces, as in LawTerm.
template <class Tool>
void addCurveContact(fem::FeModel& model, const fem::PointSet& points, const Tool& tool,
                     const RegularisedPressure& pressure, const std::vector<double>& gaps) {
  tool.validate();
  pressure.validate();
  const fem::PointSet own = fem::withMultipliers(model, points);
  std::vector<double> data;
  for (int p = 0; p < own.numEntities; ++p) {
    if (!(gaps.at(p) > pressure.compliance * pressure.eta))
      throw std::invalid_argument("contact point " + std::to_string(p + 1) +
                                  ": the reference gap must be > eta/alpha, got " + std::to_string(gaps[p]));
    data.push_back(gaps[p]);
    data.insert(data.end(), &own.positions[3 * p], &own.positions[3 * p] + 3);
    model.parameters.push_back(3 * own.nodes[(p + 1) * own.nodesPerEntity - 1]);
  }
  using Law = CurveContactLaw<Tool>;
  model.terms.push_back(std::make_unique<fem::LawTerm<Law, fem::DisplacementAndUnknown>>(
      Law{tool, pressure}, fem::withUnknowns(own), data));
}

}  // namespace atrapos::contact
