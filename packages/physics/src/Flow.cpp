#include "atrapos/physics/Flow.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/physics/Balance.hpp"
#include "atrapos/physics/FieldTerm.hpp"
#include "atrapos/physics/FlowLaw.hpp"
#include "atrapos/solid/MixedBody.hpp"

namespace atrapos::physics {
namespace {

template <int Components, bool Ring>
std::unique_ptr<fem::PointLaw> lawOf(const Flow& flow) {
  return fem::pointLaw(FlowLaw<Components, Ring>{flow.viscosity, flow.density});
}

/// rho dv_i/dt beside rho v . grad v.
fem::Capacity capacityOf(const Flow& flow, int components, int gradients) {
  return [=, rho = flow.density](const fem::PointBatch& points, const double*, double* C) {
    const int first = components * gradients, inputs = first + components + 1;
    for (int q = 0; q < points.numPoints; ++q)
      for (int i = first; i < first + components; ++i)
        std::fill_n(C + ((q * inputs + i) * inputs + i) * fem::kLanes, fem::kLanes, rho);
  };
}

}  // namespace

std::unique_ptr<fem::Term> flowTerm(const fem::Mesh& mesh, const fem::Block& block, const Flow& flow,
                                    const std::optional<solid::PlaneSection>& plane) {
  const std::size_t components = flow.velocity.size();
  if (components != (plane ? 2 : 3))
    throw std::invalid_argument("flowTerm: as many components as the mesh has dimensions are needed");
  const bool ring = plane && plane->kind == solid::PlaneSection::Kind::axisymmetric;
  const fem::Tabulation cell = solid::mixedTabulation(block.topology);
  fem::PointSet points =
      plane ? solid::planePoints(mesh, block, cell, *plane) : fem::volumePoints(mesh, block, cell);
  points.components = 1;
  points.field = flow.velocity[0];
  for (std::size_t i = 1; i < components; ++i) points.more.push_back(mapsOf(flow.velocity[i], points));
  for (const std::string& name : flow.velocity)
    points.more.push_back(fem::valuesOf(scalarField(name), points, cell));
  points.more.push_back(solid::pressureValues(scalarField(flow.pressure), points, block, cell));
  auto law = ring ? lawOf<2, true>(flow) : plane ? lawOf<2, false>(flow) : lawOf<3, false>(flow);
  const int count = static_cast<int>(components);
  return fem::storingTerm(std::move(law), points, {}, capacityOf(flow, count, ring ? 3 : count));
}

}  // namespace atrapos::physics
