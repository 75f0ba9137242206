#include "atrapos/solid/ShellTerms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ShellSurface.hpp"
#include "StagedMaterial.hpp"
#include "atrapos/fem/EnhancedTerm.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/solid/GrowthStages.hpp"

namespace atrapos::solid {

using detail::cross;
using detail::joined;
using detail::pushForward;
using detail::range;
using detail::StagedParts;
using detail::unit;
using detail::Vec3;

namespace {

// Data at a point behind the Kinematics': g; then of an expansion the place and zeta, the unit tensor.
constexpr int kBase = 3, kPlace = 4, kUnit = 6;

/// Inputs x and e, data: the Kinematics', g; with `growth`, which may be null, those of expandingShellTerm.
/// Cauchy stress is shown without the enhanced part in F.
std::unique_ptr<fem::PointLaw> enhancedLaw(StagedParts parts, std::unique_ptr<fem::PointLaw> material,
                                           std::unique_ptr<fem::PointLaw> growth = nullptr, int fields = 0) {
  const int n = parts.inputs;
  const std::vector<int> x = range(0, n), data = range(0, parts.data), g = range(parts.data, kBase);
  fem::StagedPlan plan;
  plan.inputs = growth ? n + fields + 2 : n + 1;
  plan.data = parts.data + kBase + (growth ? kPlace + kUnit : 0);
  plan.symmetric = material->shape().symmetric && fields == 0;
  int next = plan.inputs;
  // The first wire of a stage's outputs.
  const auto add = [&](std::unique_ptr<fem::PointLaw> law, std::vector<int> inputs, std::vector<int> from) {
    const int first = next;
    next += law->shape().outputs;
    plan.stages.push_back({std::move(law), std::move(inputs), std::move(from)});
    return first;
  };
  const int enhanced = plan.inputs - 1, strain = add(std::move(parts.strain), x, data);
  std::vector<int> ofMaterial = joined(range(strain, 6), {enhanced});
  int stress = 0;
  std::vector<int> onFields;
  if (growth) {
    std::vector<int> of(growth->shape().inputs, n + fields);  // the load factor, and what is not read
    std::iota(of.begin(), of.begin() + fields, n);
    const int e = add(std::move(growth), of, range(parts.data + kBase, kPlace));
    onFields.assign(fields, e + 1);
    const int elastic = add(fem::pointLaw(ElasticStrainStage{}), joined(ofMaterial, {e}),
                            range(parts.data + kBase + kPlace, kUnit));
    const int own = add(std::move(material), range(elastic, 7), g);
    stress = add(fem::pointLaw(GrownStressStage{}), joined(range(own, 7), {e}), {});
  } else {
    stress = add(std::move(material), std::move(ofMaterial), g);
  }
  const int forces = add(std::move(parts.forces), joined(x, range(stress, 6)), data);
  plan.outputs = joined(joined(range(forces, n), onFields), {stress + 6});
  plan.names = detail::stressNames();
  plan.show = [=, gradient = parts.gradient](const double* wires, const double* at, double* shown) {
    double F[9];
    gradient(wires, at, F);
    pushForward(wires + stress, F, detail::determinant(F), shown);
  };
  return fem::stagedLaw(std::move(plan));
}

/// Axes of which the third is along `normal`.
std::array<Vec3, 3> axesOf(const double* normal) {
  const Vec3 n = unit({normal[0], normal[1], normal[2]});
  int farthest = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(n[i]) < std::abs(n[farthest]) - 1e-6) farthest = i;  // the first of those that tie
  Vec3 along{0, 0, 0};
  along[farthest] = 1;
  const Vec3 second = unit(cross(n, along));
  return {cross(second, n), second, n};
}

/// The data of metalLaw from those of the enhanced element at a point, whose last are the contravariant base
/// [component][i], if there is one, and g.
void metalData(const double* from, int before, bool plain, double* to) {
  const auto axes = axesOf(from + before - 3);
  if (plain) {
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) to[3 * i + k] = axes[k][i];
    return;
  }
  const int base = before - 12;
  std::copy_n(from, base, to);
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      to[base + 3 * k + i] =
          axes[k][0] * from[base + i] + axes[k][1] * from[base + 3 + i] + axes[k][2] * from[base + 6 + i];
}

bool isPlain(ShellStrains strains, int nodesPerElement) {
  return nodesPerElement == 8 && strains == ShellStrains::compatible;
}

StagedParts partsOf(ShellStrains strains, int nodesPerElement) {
  switch (nodesPerElement) {
    case 3:
      return detail::shellPartsOf<TiedShell<Mitc3>>();
    case 4:
      return detail::shellPartsOf<TiedShell<Mitc4>>();
    case 6:
      return detail::shellPartsOf<TiedShell<Mitc6>>();
    default:
      return isPlain(strains, nodesPerElement) ? detail::shellPartsOf<PlainShell>()
                                               : detail::shellPartsOf<AssumedShearShell>();
  }
}

/// Those of the enhanced element, whose weights and maps serve a metal too. poisson: of the material at rest.
fem::EnhancedPoints pointsOf(double poisson, const ShellElements& elements, ShellStrains strains,
                             const ShellCubature& cubature) {
  switch (elements.nodesPerElement) {
    case 3:
      return mitc3Points(elements, poisson, cubature);
    case 4:
      return mitc4Points(elements, poisson, cubature);
    case 6:
      return mitc6Points(elements, cubature);
    default:
      return isPlain(strains, elements.nodesPerElement) ? shellPoints(elements, cubature)
                                                        : assumedShearPoints(elements, cubature);
  }
}

/// The shape functions of an element's own nodes at its points, zeta fastest.
fem::Tabulation ownNodesAt(const ShellCubature& cubature, int nodesPerElement) {
  const fem::Tabulation plane = detail::PlanePoints(cubature.inPlane, nodesPerElement).table;
  fem::Tabulation all;
  all.numNodes = nodesPerElement;
  all.numPoints = plane.numPoints * cubature.throughThickness;
  for (int p = 0; p < all.numPoints; ++p) {
    const double* values = detail::valuesAt(plane, p / cubature.throughThickness);
    all.values.insert(all.values.end(), values, values + nodesPerElement);
  }
  return all;
}

}  // namespace

std::unique_ptr<fem::PointLaw> sixNodeShellLaw(std::unique_ptr<fem::PointLaw> material) {
  return enhancedLaw(detail::partsOf<TiedShell<Mitc6>>(), std::move(material));
}

std::unique_ptr<fem::Term> expandingShellTerm(const ShellElements& elements, ShellStrains strains,
                                              double poissonsRatio, std::unique_ptr<fem::PointLaw> material,
                                              std::unique_ptr<fem::PointLaw> growth,
                                              const std::vector<std::string>& fields,
                                              const ShellCubature& cubature) {
  const int N = elements.nodesPerElement;
  fem::EnhancedPoints points = pointsOf(poissonsRatio, elements, strains, cubature);
  const std::size_t count = points.points.numPoints(), before = points.data.size() / count,
                    each = static_cast<std::size_t>(points.points.pointsPerEntity);
  StagedParts parts = partsOf(strains, N);
  const std::size_t numData = static_cast<std::size_t>(parts.data + kBase + kPlace + kUnit);
  std::vector<double> data;
  data.reserve(count * numData);
  for (std::size_t p = 0; p < count; ++p) {
    if (isPlain(strains, N)) data.insert(data.end(), {1, 0, 0, 0, 1, 0, 0, 0, 1});  // the axes are Cartesian
    data.insert(data.end(), &points.data[p * before], &points.data[p * before] + before);
    data.insert(data.end(), &points.points.positions[3 * p], &points.points.positions[3 * p] + 3);
    data.push_back(points.modes[p % each * points.numParameters]);  // zeta
    data.resize(data.size() + kUnit);
    parts.unit(&data[p * numData], &data[(p + 1) * numData - kUnit]);
  }
  points.data = std::move(data);
  const fem::Tabulation own = ownNodesAt(cubature, N);
  for (const std::string& field : fields)
    points.points.more.push_back(fem::valuesOf({field, {""}}, points.points, own));
  return fem::enhancedTerm(
      enhancedLaw(std::move(parts), std::move(material), std::move(growth), static_cast<int>(fields.size())),
      points);
}

std::unique_ptr<fem::PointLaw> shellMetalLaw(const Metal& metal, ShellStrains strains, int nodesPerElement) {
  return detail::metalLaw(partsOf(strains, nodesPerElement), detail::planeStressMetal(metal));
}

std::unique_ptr<fem::Term> shellMetalTerm(const Metal& metal, const ShellElements& elements,
                                          ShellStrains strains, const ShellCubature& cubature) {
  auto law = shellMetalLaw(metal, strains, elements.nodesPerElement);
  const fem::EnhancedPoints enhanced =
      pointsOf(metal.lambda / (2 * (metal.lambda + metal.mu)), elements, strains, cubature);
  const auto numData = static_cast<std::size_t>(law->shape().data);
  const std::size_t count = enhanced.points.numPoints(), before = enhanced.data.size() / count;
  std::vector<double> data(count * numData);
  for (std::size_t p = 0; p < count; ++p)
    metalData(&enhanced.data[p * before], static_cast<int>(before),
              isPlain(strains, elements.nodesPerElement), &data[p * numData] + 1);
  return fem::lawTerm(std::move(law), enhanced.points, data);
}

}  // namespace atrapos::solid
