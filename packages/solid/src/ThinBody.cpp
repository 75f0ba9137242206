#include "atrapos/solid/ThinBody.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "ShellSurface.hpp"
#include "StagedMaterial.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/ReducedLaw.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/solid/ThinStages.hpp"

namespace atrapos::solid {

using detail::cross;
using detail::dot;
using detail::joined;
using detail::range;
using detail::StagedParts;
using detail::unit;
using detail::Vec3;

namespace {

/// A point of a cell: its place, the tangents of the map from reference coordinates, orthonormal axes along
/// them, and their area (length).
struct ThinPlace {
  Vec3 x{}, tangents[2]{}, axes[2]{};
  double measure = 0;
};

ThinPlace placeAt(const fem::Mesh& mesh, const int* nodes, const fem::Tabulation& t, int q) {
  ThinPlace p;
  for (int n = 0; n < t.numNodes; ++n)
    for (int i = 0; i < 3; ++i) {
      const double X = mesh.coordinates[3 * static_cast<std::size_t>(nodes[n]) + i];
      p.x[i] += t.values[q * t.numNodes + n] * X;
      for (int d = 0; d < t.dim; ++d) p.tangents[d][i] += t.gradients[(q * t.numNodes + n) * t.dim + d] * X;
    }
  const auto length = [](const Vec3& v) { return std::sqrt(dot(v, v)); };
  if (t.dim == 1) {
    p.measure = length(p.tangents[0]);
    if (p.measure > 0) p.axes[0] = unit(p.tangents[0]);
    return p;
  }
  const Vec3 normal = cross(p.tangents[0], p.tangents[1]);
  p.measure = length(normal);
  if (p.measure > 0) {
    p.axes[0] = unit(p.tangents[0]);
    p.axes[1] = unit(cross(normal, p.axes[0]));
  }
  return p;
}

/// dxi_d/dX_b along the axes, [d][b].
std::array<double, 4> mapOf(const ThinPlace& p, int dim) {
  const auto along = [&](int d, int b) { return dot(p.tangents[d], p.axes[b]); };
  if (dim == 1) return {1 / along(0, 0), 0, 0, 0};
  const double g00 = along(0, 0), g01 = along(0, 1), g10 = along(1, 0), g11 = along(1, 1),
               det = g00 * g11 - g01 * g10;
  return {g11 / det, -g10 / det, -g01 / det, g00 / det};
}

/// A block's points, but for what each of them has.
fem::PointSet emptyPoints(const fem::Block& block, const fem::Tabulation& cell) {
  if (!fem::isShell(block.topology) && !fem::isBar(block.topology))
    throw std::runtime_error(fmt::format("block '{}': {} is neither a surface nor a bar in space", block.name,
                                         fem::topologyName(block.topology)));
  fem::PointSet p;
  p.nodesPerEntity = cell.numNodes;
  p.pointsPerEntity = cell.numPoints;
  p.nodes = block.nodes;
  p.numEntities = static_cast<int>(block.nodes.size()) / cell.numNodes;
  return p;
}

/// Appends weight and position of all points, and calls more(place, point of the cell).
template <class More>
void forEachPlace(const fem::Mesh& mesh, const fem::Block& block, const fem::Tabulation& cell,
                  const ThinSection& section, fem::PointSet& p, const More& more) {
  for (int e = 0; e < p.numEntities; ++e)
    for (int q = 0; q < cell.numPoints; ++q) {
      const ThinPlace place =
          placeAt(mesh, &block.nodes[static_cast<std::size_t>(e) * cell.numNodes], cell, q);
      if (!(place.measure > 0))
        throw std::runtime_error(
            fmt::format("block '{}', element {} (of the block) has no {} at a cubature point", block.name,
                        e + 1, cell.dim == 1 ? "length" : "area"));
      p.weights.push_back(cell.weights[q] * place.measure * section.size);
      p.positions.insert(p.positions.end(), place.x.begin(), place.x.end());
      more(place, q);
    }
}

/// The material's strain across the body is such that there is no force. Inputs and data: the Kinematics',
/// the last input being condensed, the last datum the stress at rest of the first `along` axes.
std::unique_ptr<fem::PointLaw> condensedLaw(StagedParts parts, std::unique_ptr<fem::PointLaw> material,
                                            int along) {
  const int n = parts.inputs, across = n - 1, strain = n, stress = strain + 6;
  const std::vector<int> x = range(0, n), data = range(0, parts.data);
  fem::StagedPlan plan;
  plan.inputs = n;
  plan.data = parts.data;
  plan.symmetric = material->shape().symmetric;
  plan.stages.push_back({std::move(parts.strain), x, data});
  plan.stages.push_back(
      {std::move(material), joined(range(strain, 6), {across}), {-1, -1, -1}});  // e g x g = 0
  plan.stages.push_back({std::move(parts.forces), joined(x, range(stress, 6)), data});
  plan.outputs = range(stress + 7, n);
  plan.names = detail::stressNames();
  plan.show = [=, gradient = parts.gradient](const double* wires, const double* at, double* shown) {
    double F[9], S[6];
    gradient(wires, at, F);
    std::copy_n(wires + stress, 6, S);
    for (int k = 0; k < along; ++k) S[k] += at[data.back()];
    detail::pushForward(S, F, detail::determinant(F), shown);
  };
  fem::Reduction reduction;
  reduction.inputs = joined(range(0, across), {-1});
  reduction.outputs = range(0, across);
  reduction.numInputs = across;
  reduction.condensed = across;
  return fem::reducedLaw(fem::stagedLaw(std::move(plan)), std::move(reduction));
}

}  // namespace

fem::Tabulation thinTabulation(fem::Topology topology) {
  // Shells of three nodes have points for their bending.
  return fem::tabulate(topology == fem::Topology::Shell3 ? fem::Topology::Tri3 : topology);
}

ThinPoints thinPoints(const fem::Mesh& mesh, const fem::Block& block, const fem::Tabulation& cell,
                      const ThinSection& section) {
  ThinPoints made{emptyPoints(block, cell), {}};
  fem::PointSet& p = made.points;
  p.shapeComponents = cell.dim;
  p.ofPlaces = false;
  forEachPlace(mesh, block, cell, section, p, [&](const ThinPlace& place, int q) {
    const auto map = mapOf(place, cell.dim);
    for (int n = 0; n < cell.numNodes; ++n) {
      const double* dN = &cell.gradients[(q * cell.numNodes + n) * cell.dim];
      for (int b = 0; b < cell.dim; ++b) {
        double sum = 0;
        for (int d = 0; d < cell.dim; ++d) sum += dN[d] * map[2 * d + b];
        p.shape.push_back(sum);
      }
    }
    for (int i = 0; i < 3; ++i)
      for (int b = 0; b < cell.dim; ++b) made.axes.push_back(place.axes[b][i]);
  });
  return made;
}

fem::PointSet thinValuePoints(const fem::Mesh& mesh, const fem::Block& block, const fem::Tabulation& cell,
                              const ThinSection& section) {
  fem::PointSet p = emptyPoints(block, cell);
  p.shapeComponents = 1;
  forEachPlace(mesh, block, cell, section, p, [&](const ThinPlace&, int q) {
    const double* N = &cell.values[static_cast<std::size_t>(q) * cell.numNodes];
    p.shape.insert(p.shape.end(), N, N + cell.numNodes);
  });
  return p;
}

std::unique_ptr<fem::PointLaw> membraneLaw(std::unique_ptr<fem::PointLaw> material) {
  return condensedLaw(detail::partsOf<MembraneKinematics<true>>(), std::move(material), 2);
}

std::unique_ptr<fem::PointLaw> barLaw(std::unique_ptr<fem::PointLaw> material) {
  return condensedLaw(detail::partsOf<BarKinematics<true>>(), std::move(material), 1);
}

std::unique_ptr<fem::PointLaw> membraneLaw(const Metal& metal) {
  return detail::metalLaw(detail::partsOf<MembraneKinematics<false>>(), detail::planeStressMetal(metal));
}

std::unique_ptr<fem::PointLaw> barLaw(const Metal& metal) {
  detail::MetalStage stage{
      metal.kinematicModulus > 0 ? fem::pointLaw(BarMetalStage<true>{metal})
                                 : fem::pointLaw(BarMetalStage<false>{metal}),
      [poisson = metal.lambda / (2 * (metal.lambda + metal.mu))](const double* E, const double* variables) {
        const double plastic = variables[1];
        return 1 + 2 * (-poisson * (E[0] - plastic) - plastic / 2);
      }};
  return detail::metalLaw(detail::partsOf<BarKinematics<false>>(), std::move(stage));
}

std::unique_ptr<fem::Term> thinTerm(std::unique_ptr<fem::PointLaw> law, const ThinPoints& points,
                                    const ThinSection& section) {
  const std::size_t count = points.points.numPoints(),
                    axes = points.axes.size() / std::max<std::size_t>(count, 1);
  const fem::LawShape shape = law->shape();
  const bool metal = shape.variables > 0;
  std::vector<double> data(count * shape.data);
  for (std::size_t p = 0; p < count; ++p) {
    double* at = &data[p * shape.data];
    if (metal) ++at;  // no point yields at rest
    *std::copy_n(&points.axes[p * axes], axes, at) = section.stress;
  }
  return fem::lawTerm(std::move(law), points.points, data);
}

}  // namespace atrapos::solid
