#include "atrapos/physics/FieldTerm.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/ReducedLaw.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/physics/Balance.hpp"

namespace atrapos::physics {
namespace {

/// A law in space at points of a plane.
std::unique_ptr<fem::PointLaw> inPlane(std::unique_ptr<fem::PointLaw> law, int fields) {
  fem::Reduction r;
  for (int f = 0; f < fields; ++f) {
    for (const int i : {3 * f, 3 * f + 1, -1, 3 * f + 2}) r.inputs.push_back(i);
    for (const int o : {4 * f, 4 * f + 1, 4 * f + 3}) r.outputs.push_back(o);
  }
  const bool seesLoadFactor = law->shape().inputs > 4 * fields;
  if (seesLoadFactor) r.inputs.push_back(3 * fields);
  r.numInputs = 3 * fields + (seesLoadFactor ? 1 : 0);
  return fem::reducedLaw(std::move(law), std::move(r));
}

/// Quadratic cells in full: a source is a quadratic function at least.
fem::Tabulation cellOf(fem::Topology topology) {
  switch (topology) {
    case fem::Topology::Quad8:
    case fem::Topology::Quad9:
    case fem::Topology::Hex20:
    case fem::Topology::Hex27:
    case fem::Topology::Shell8:
      return fem::tabulate(topology, 5);
    case fem::Topology::Tri6:
    case fem::Topology::Shell6:
    case fem::Topology::Tet10:
    case fem::Topology::Wedge15:
      return fem::tabulate(topology, 4);
    default:
      return fem::tabulate(topology, 2);
  }
}

fem::PointSet gradientPoints(const fem::Mesh& mesh, const fem::Block& block, const fem::Tabulation& cell,
                             const std::optional<solid::PlaneSection>& plane,
                             const solid::ShellElements* shells) {
  if (shells != nullptr) return solid::shellFieldPoints(*shells, cell);
  if (!plane) return fem::volumePoints(mesh, block, cell);
  const bool ring = plane->kind == solid::PlaneSection::Kind::axisymmetric;
  // A scalar has no part of its gradient around the axis.
  fem::PointSet points =
      solid::planePoints(mesh, block, cell, {solid::PlaneSection::Kind::strain, ring ? 1 : plane->thickness});
  if (!ring) return points;
  for (int p = 0; p < points.numPoints(); ++p) {
    const double radius = points.positions[3 * static_cast<std::size_t>(p)];
    if (!(radius > 0))
      throw std::runtime_error("block '" + block.name + "', element " +
                               std::to_string(p / points.pointsPerEntity + 1) +
                               " (of the block): the radius x is not positive; the axis is x = 0");
    points.weights[p] *= 2 * std::acos(-1.0) * radius;
  }
  return points;
}

/// What fields store, point by point: a matrix of it is wanted once a step at most.
fem::Capacity inBatches(const FieldCapacity& capacity, int fields, const fem::LawShape& shape, bool plane) {
  if (!capacity) return {};
  return [=](const fem::PointBatch& points, const double* in, double* C) {
    const int I = shape.inputs, O = shape.outputs, gradient = plane ? 2 : 3, each = gradient + 1;
    std::vector<double> full(4 * fields + 1), c(fields);
    for (int q = 0; q < points.numPoints; ++q)
      for (int lane = 0; lane < points.lanes; ++lane) {
        const auto input = [&](int i) { return in[(q * I + i) * fem::kLanes + lane]; };
        std::fill(full.begin(), full.end(), 0.0);
        for (int f = 0; f < fields; ++f) {
          for (int i = 0; i < gradient; ++i) full[4 * f + i] = input(each * f + i);
          full[4 * f + 3] = input(each * f + gradient);
        }
        if (I > each * fields) full.back() = input(each * fields);
        double place[3] = {};
        for (int i = 0; i < shape.data; ++i)
          place[i] = points.data[(q * shape.data + i) * fem::kLanes + lane];
        capacity(full.data(), place, c.data());
        for (int f = 0; f < fields; ++f) {
          const int value = each * f + gradient;
          C[((q * O + value) * I + value) * fem::kLanes + lane] = c[f];
        }
      }
  };
}

/// The places of points where a law has them as its data.
std::vector<double> placesFor(const fem::PointLaw& law, const fem::PointSet& points) {
  return law.shape().data > 0 ? points.positions : std::vector<double>{};
}

}  // namespace

fem::Interpolation mapsOf(const std::string& field, fem::Interpolation same) {
  same.field = field;
  same.components = 1;
  return same;
}

void requireFieldLaw(const fem::PointLaw& law, int fields, int each) {
  const fem::LawShape shape = law.shape();
  const int values = each * fields;
  if (shape.outputs == values && (shape.inputs == values || shape.inputs == values + 1) &&
      (shape.data == 0 || shape.data == 3) && shape.variables == 0 && shape.events == 0)
    return;
  throw std::invalid_argument("a law with " + std::to_string(shape.inputs) + " inputs, " +
                              std::to_string(shape.outputs) + " outputs, " + std::to_string(shape.data) +
                              " data; expected " + std::to_string(values) +
                              " (and perhaps the load factor), " + std::to_string(values) +
                              ", 0 or 3, and neither variables nor events");
}

std::unique_ptr<fem::Term> fieldTerm(const fem::Mesh& mesh, const fem::Block& block,
                                     const std::vector<std::string>& fields,
                                     std::unique_ptr<fem::PointLaw> law, const FieldCapacity& capacity,
                                     const std::optional<solid::PlaneSection>& plane,
                                     const solid::ShellElements* shells) {
  const int count = static_cast<int>(fields.size());
  requireFieldLaw(*law, count, 4);
  const fem::Tabulation cell = cellOf(block.topology);
  fem::PointSet points = gradientPoints(mesh, block, cell, plane, shells);
  points.components = 1;
  points.field = fields[0];
  for (int f = 0; f < count; ++f) {
    if (f > 0) points.more.push_back(mapsOf(fields[f], points));
    points.more.push_back(fem::valuesOf(scalarField(fields[f]), points, cell));
  }
  const std::vector<double> places = placesFor(*law, points);
  auto atPoints = plane ? inPlane(std::move(law), count) : std::move(law);
  const fem::LawShape shape = atPoints->shape();
  return fem::storingTerm(std::move(atPoints), points, places,
                          inBatches(capacity, count, shape, plane.has_value()));
}

std::vector<std::unique_ptr<fem::Term>> sideTerms(const fem::Mesh& mesh, const fem::SideSet& set,
                                                  const std::vector<std::string>& fields,
                                                  const std::function<std::unique_ptr<fem::PointLaw>()>& law,
                                                  const std::optional<solid::PlaneSection>& plane) {
  constexpr int degree = 5;  // three points along an edge of degree 2
  std::vector<std::unique_ptr<fem::Term>> terms;
  for (fem::PointSet& points :
       plane ? solid::planeEdgePoints(mesh, set, *plane, degree) : fem::facePoints(mesh, set, degree)) {
    points.components = 1;
    points.field = fields[0];
    for (std::size_t f = 1; f < fields.size(); ++f) points.more.push_back(mapsOf(fields[f], points));
    auto own = law();
    requireFieldLaw(*own, static_cast<int>(fields.size()), 1);
    const std::vector<double> places = placesFor(*own, points);
    terms.push_back(fem::lawTerm(std::move(own), points, places));
  }
  return terms;
}

}  // namespace atrapos::physics
