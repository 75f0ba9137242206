#include <algorithm>
#include <cmath>

#include <Tpetra_Vector.hpp>

#include "Critical.hpp"
#include "PadeFit.hpp"

namespace atrapos::path {

Series pathResponse(Calls& calls, const State& from, const PathTangent& along, double weight, int order) {
  SeriesRequest request;
  request.order = order;
  request.weight = weight;
  request.previous = &along;
  request.factored = true;
  const Series plain = buildSeries(calls, from, request);

  auto f = calls.newVector(), v = calls.newVector();
  fillUnsymmetric(*f, 1);
  // Alike in all fields, whatever their units.
  if (const auto weights = calls.eigenvalueWeights(from); !weights.is_null())
    f->elementWiseMultiply(1, *weights, *f, 0);
  calls.solve(*f, *v);
  // Small enough to be linear in (near a transcritical point the response goes with the root of it), large
  // enough to stand above rounding. The pole found is a guess, which Newton makes exact.
  constexpr double part = 1e-7;
  const double factor = part * plain.coefficient(1).u->norm2() / v->norm2();
  f->scale(std::isfinite(factor) && factor > 0 ? factor : part);
  request.perturbation = f.get();
  const Series moved = buildSeries(calls, from, request);

  Series response(from, plain.weight());
  for (int k = 1; k <= plain.order(); ++k) {
    Increment d{Teuchos::rcp(new Vector(*moved.coefficient(k).u, Teuchos::Copy)),
                moved.coefficient(k).internal};
    d.u->update(-1, *plain.coefficient(k).u, 1);
    for (std::size_t i = 0; i < d.internal.size(); ++i) d.internal[i] -= plain.coefficient(k).internal[i];
    const double norm = std::sqrt(calls.problem().inner(d, d));
    response.append(std::move(d), moved.lambdaCoefficient(k) - plain.lambdaCoefficient(k), norm);
  }
  return response;
}

ResponsePoles responsePoles(Calls& calls, const CriticalSearch& search, const State& from,
                            const PathTangent& along, double behind, double ahead) {
  const Series response =
      pathResponse(calls, from, along, search.series.weight(), std::max(search.order, 16));
  constexpr double agreement = 0.05;
  ResponsePoles poles;
  poles.direction = response.coefficient(response.order()).u;
  // What is noise of the coefficients depends on how nonlinear the response is: the first level that shows as
  // many poles as eigenvalues changed sign counts, else the one that shows most.
  for (const double noise : {1e-5, 1e-7, 1e-3, 1e-9}) {
    auto a = realPoles(calls.problem(), response, behind, ahead, noise, agreement);
    if (a.size() > poles.a.size()) poles.a = std::move(a);
    if (static_cast<int>(poles.a.size()) >= search.signChanges) break;
  }
  return poles;
}

}  // namespace atrapos::path
