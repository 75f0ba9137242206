#include "commands/FirstAnswer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <utility>

#include "atrapos/linear/FactorCost.hpp"
#include "scene/Extents.hpp"
#include "scene/Revolution.hpp"

namespace atrapos {
namespace {

using Vector3 = std::array<double, 3>;

/// The thickness of the thinnest shell, or of the thinnest body.
double thicknessOf(const Scene& scene) {
  const fem::Mesh& mesh = scene.mesh();
  double thinnest = INFINITY;
  const auto& directors = scene.shells().geometry.directors;
  for (std::size_t d = 0; d + 2 < directors.size(); d += 3)
    thinnest = std::min(thinnest, 2 * std::hypot(directors[d], directors[d + 1], directors[d + 2]));
  for (const fem::Block& block : mesh.blocks) {
    if (!fem::isSolid(block.topology) && !fem::isPlane(block.topology)) continue;
    const Extents extents = extentsOf(mesh, block);
    for (int axis = 0; axis < mesh.dimension; ++axis) thinnest = std::min(thinnest, extents.body[axis]);
  }
  return thinnest;
}

/// Sum over the nodes of the mesh of a vector of dofs, and its largest node.
struct Displacements {
  Vector3 sum{};
  int node = -1;
  double largest = 0;
};

Displacements displacementsIn(const Scene& scene, const fem::DofMap& dofs,
                              const std::vector<double>& values) {
  Displacements result;
  const int field = dofs.find(fem::displacementField().name);
  for (int n = 0; n < scene.mesh().numNodes() && !values.empty(); ++n) {
    double square = 0;
    for (int i = 0; i < scene.mesh().dimension; ++i) {
      const int dof = dofs.dof(field, n, i);
      if (dof < 0) continue;
      const double value = values[static_cast<std::size_t>(dof)];
      result.sum[static_cast<std::size_t>(i)] += value;
      square += value * value;
    }
    if (std::sqrt(square) > result.largest) {
      result.largest = std::sqrt(square);
      result.node = n;
    }
  }
  return result;
}

/// "(0, 0, -100)" of as many components as the mesh has.
std::string shown(const Vector3& v, int dimension) {
  std::string text;
  for (int i = 0; i < dimension; ++i)
    text += fmt::format("{}{:.6g}", i > 0 ? ", " : "", v[static_cast<std::size_t>(i)]);
  return "(" + text + ")";
}

std::vector<std::string> describeAnswer(const Scene& scene, double size, double loadFactor,
                                        const Displacements& answer) {
  constexpr double rounding = 1e-14;  // of what balances
  if (answer.largest < rounding * size) return {"linear    nothing moves at first"};
  std::vector<std::string> lines{fmt::format(
      "linear    at load factor {:.6g}: largest displacement {:.3g} at node {}, {:.2g} of the size {:.4g}",
      loadFactor, answer.largest, scene.mesh().nodeNumber(answer.node), answer.largest / size, size)};
  // A path may go far beyond its linear answer, and its first load be small, but not by so much.
  constexpr double much = 1e3, little = 1e-9;
  if (answer.largest > much * size || answer.largest < little * size)
    lines.push_back(fmt::format("warning   loads or units: the linear answer is {:.2g} of the body's size",
                                answer.largest / size));
  return lines;
}

/// Solids that are turned around an axis and move alike all around it.
std::string revolved(const Scene& scene, const std::vector<double>& answer) {
  const auto& blocks = scene.mesh().blocks;
  // What tools do is not in a linear answer.
  if (!scene.contacts().empty() || !std::all_of(blocks.begin(), blocks.end(), [](const fem::Block& block) {
        return fem::isSolid(block.topology);
      }))
    return {};
  const auto axis = axisOfRevolution(scene.mesh(), scene.problem().model().dofs, answer);
  if (!axis) return {};
  return fmt::format(
      "waste     the linear answer is the same all around {}: a plane body (plane: {{kind: axisymmetric}}) "
      "has it with the unknowns of one section, and all of the path but waves around the axis",
      "xyz"[*axis]);
}

}  // namespace

std::vector<std::string> describeFirstAnswer(Scene& scene, const path::State& start,
                                             linear::TangentSolver& solver) {
  fem::FeProblem& problem = scene.problem();
  const fem::FeModel& model = problem.model();
  const double size = longestSide(scene.mesh());
  if (model.dofs.find(fem::displacementField().name) < 0 || !(size > 0)) return {};
  std::vector<std::string> lines;
  const int dimension = scene.mesh().dimension;
  for (const auto& [load, when] :
       {std::pair{&model.load, "at load factor 1"}, std::pair{&model.constantLoad, "that stay"}}) {
    const Displacements forces = displacementsIn(scene, model.dofs, *load);
    if (forces.node >= 0)
      lines.push_back(fmt::format("forces    {}: {} in all, without those that follow or are tools'", when,
                                  shown(forces.sum, dimension)));
  }
  if (const double slenderness = thicknessOf(scene) / size; slenderness < 0.1)
    lines.push_back(
        fmt::format("slender   {:.3g} thick for {:.4g}: a strut of it buckles at strains of {:.2g}",
                    slenderness * size, size, std::pow(M_PI * slenderness, 2) / 12));

  constexpr double most = 1e11;  // operations: some ten seconds
  const auto cost = linear::estimate(solver);
  if (!cost || cost->operations > most) return lines;
  const std::vector<double>& ends = scene.deck().path.stop.loadFactors;
  const double loadFactor = ends.empty() ? 1 : ends.back();
  try {
    const auto F = Teuchos::rcp(new path::Vector(problem.map())),
               answer = Teuchos::rcp(new path::Vector(problem.map()));
    const auto K = problem.tangent(start, *F);
    if (F->normInf() == 0) return lines;  // tools that have not arrived
    solver.factor(K);
    solver.solve(*F, *answer);
    answer->scale(loadFactor);
    const std::vector<double> values = fem::FeProblem::values(*answer);
    const Displacements u = displacementsIn(scene, model.dofs, values);
    if (u.node >= 0)
      for (const std::string& line : describeAnswer(scene, size, loadFactor, u)) lines.push_back(line);
    if (std::string line = revolved(scene, values); !line.empty()) lines.push_back(std::move(line));
  } catch (const std::exception& e) {
    // What touches at the start holds a body from the path's first event on.
    if (scene.contacts().empty())
      lines.push_back(fmt::format("linear    no answer at the start: {}", e.what()));
  }
  return lines;
}

}  // namespace atrapos
