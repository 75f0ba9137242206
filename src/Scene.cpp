#include "Scene.hpp"

#include <fmt/format.h>

#include <Tpetra_Map.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "FollowerLoads.hpp"
#include "Registry.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/fem/ShellFaces.hpp"
#include "atrapos/solid/ShellResults.hpp"

namespace atrapos {

Scene::Scene(const deck::Deck& deck, fem::Mesh mesh) : deck_(deck), mesh_(std::move(mesh)) {
  deck::checkAgainstMesh(deck_, mesh_);
  shells_ = sceneShells(deck_, mesh_);
  if (deck_.output.shells == deck::Output::Shells::Body) {
    if (shells_.empty()) fail("output/shells", "the mesh has no shells, which alone have a body to write");
    body_ = fem::shellBody(mesh_, shells_.geometry);
  }
  fem::FeModel model;
  model.numNodes = shells_.geometry.numNodes();
  addMaterials(model);
  model.supports = fem::Supports(model.numNodes);
  addSupports(model);
  addLoads(model);
  addFollowers(model);
  addContacts(model);
  requireSupport(model.supports);
  requireEffect(model);
  problem_ = std::make_unique<fem::FeProblem>(std::move(model));
  addMonitors();
}

void Scene::fail(const std::string& key, const std::string& problem) const {
  throw deck::DeckError(fmt::format("{}: {}: {}", deck_.file, key, problem));
}

std::vector<int> Scene::nodesOf(const std::string& set) const {
  const int n = fem::findNodeSet(mesh_, set);
  if (n >= 0) return mesh_.nodeSets[n].nodes;
  return fem::nodesOf(mesh_, mesh_.sideSets.at(fem::findSideSet(mesh_, set)));
}

void Scene::addMaterials(fem::FeModel& model) {
  bodies_.resize(mesh_.blocks.size());
  for (const deck::Material& material : deck_.materials)
    for (const std::string& name : material.blocks) {
      const int b = fem::findBlock(mesh_, name);
      const fem::Block& block = mesh_.blocks[b];
      try {
        if (fem::isShell(block.topology)) {
          bodies_[b] = addShell(material, shells_.find(b), model);
          continue;
        }
        const auto cell = fem::tabulate(block.topology);
        const auto points = fem::volumePoints(mesh_, block, cell);
        bodies_[b] = {static_cast<int>(model.terms.size()), -1, fem::extrapolation(block.topology, cell)};
        model.terms.push_back(registry::materialTerm(material, points));
      } catch (const std::runtime_error& e) {
        fail("mesh/file", e.what());
      }
    }
}

BodyBlock Scene::addShell(const deck::Material& material, int shells, fem::FeModel& model) const {
  BodyBlock body{static_cast<int>(model.terms.size()), shells, solid::shellPointsToNodes({})};
  model.terms.push_back(registry::shellTerm(material, solid::shellPoints(shells_.elements[shells])));
  return body;
}

void Scene::addSupports(fem::FeModel& model) const {
  for (const deck::Support& support : deck_.supports)
    for (int node : nodesOf(support.set))
      for (int i = 0; i < 3; ++i) try {
          if (const auto& p = support.components[i])
            model.supports.prescribe(node, i, p->value, p->perLoadFactor);
          if (const auto& p = support.director[i])
            for (int director : shells_.geometry.directorNodes(node))
              model.supports.prescribe(director, i, p->value, p->perLoadFactor);
        } catch (const std::invalid_argument&) {
          fail("supports/" + support.name,
               fmt::format("displacement {0} of node {1}, or of its director, is prescribed twice with "
                           "different values",
                           "xyz"[i], node + 1));
        }
}

const deck::Tool& Scene::toolOf(const deck::Contact& contact) const {
  return *std::find_if(deck_.tools.begin(), deck_.tools.end(),
                       [&](const deck::Tool& tool) { return tool.name == contact.tool; });
}

std::vector<fem::PointSet> Scene::pointsOf(const deck::Contact& contact) const {
  const double zeta = zetaOf(contact.at);
  try {
    if (contact.points == deck::Contact::Points::Nodes)
      return {zeta == 0 ? fem::nodePoints(mesh_, nodesOf(contact.set))
                        : fem::shellNodePoints(mesh_, shells_.geometry, nodesOf(contact.set), zeta)};
    const auto& set = mesh_.sideSets.at(fem::findSideSet(mesh_, contact.set));
    return zeta == 0 ? fem::facePoints(mesh_, set, contact.quadratureDegree)
                     : fem::shellFacePoints(mesh_, shells_.geometry, set, zeta, contact.quadratureDegree);
  } catch (const std::runtime_error& e) {
    fail("contact/" + contact.name + "/set", e.what());
  }
}

void Scene::addContacts(fem::FeModel& model) {
  for (const deck::Tool& tool : deck_.tools) try {
      registry::validate(tool);
    } catch (const std::invalid_argument& e) {
      fail("tools/" + tool.name, e.what());
    }
  for (const deck::Contact& contact : deck_.contacts) {
    const deck::Tool& tool = toolOf(contact);
    contact::RegularisedPressure pressure;
    pressure.compliance = contact.stiffness ? 1.0 / *contact.stiffness : 0.0;
    pressure.eta = contact.regularisation;

    ContactPoints entry;
    entry.name = contact.name;
    entry.points = pointsOf(contact);
    entry.smallestGap = std::numeric_limits<double>::infinity();
    for (const fem::PointSet& points : entry.points) {
      std::vector<double> gaps, references;
      for (int p = 0; p < points.numPoints(); ++p) {
        const double* x = &points.positions[3 * static_cast<std::size_t>(p)];
        const std::string ambiguity = registry::ambiguity(tool, x);
        const double gap = registry::project(tool, x)[0];
        if (!ambiguity.empty() || !std::isfinite(gap))
          fail("contact/" + contact.name,
               fmt::format("the point ({:.6g}, {:.6g}, {:.6g}) has no unique projection on tool '{}'{}{}",
                           x[0], x[1], x[2], tool.name, ambiguity.empty() ? "" : ": it ", ambiguity));
        // Rounding of coordinates as large as the scene; anything deeper is meant.
        const double rounding = 1e-12 * (1 + std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]));
        if (gap < -rounding)
          fail("contact/" + contact.name, fmt::format("tool '{}' penetrates the body at the start: gap "
                                                      "{:.6g} at ({:.6g}, {:.6g}, {:.6g}); move the "
                                                      "tool or the mesh apart",
                                                      tool.name, gap, x[0], x[1], x[2]));
        // Law (15) needs Delta > eta/alpha; a point that touches at the start gets the least sensible value.
        const double least = 2 * pressure.eta * pressure.compliance;
        if (!contact.referenceGap && !(std::max(gap, least) > 0))
          fail("contact/" + contact.name + "/reference_gap",
               fmt::format(
                   "the body touches tool '{}' at ({:.6g}, {:.6g}, {:.6g}): a rigid contact needs a positive "
                   "reference_gap there, give a number",
                   tool.name, x[0], x[1], x[2]));
        gaps.push_back(gap);
        references.push_back(contact.referenceGap ? *contact.referenceGap : std::max(gap, least));
        entry.smallestGap = std::min(entry.smallestGap, gap);
      }
      entry.count += points.numPoints();
      entry.terms.push_back(static_cast<int>(model.terms.size()));
      entry.gaps.push_back(std::move(gaps));
      model.terms.push_back(registry::contactTerm(tool, pressure, points, references));
    }
    contacts_.push_back(std::move(entry));
  }
}

void Scene::requireSupport(const fem::Supports& supports) const {
  std::vector<fem::HeldDirection> held;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const deck::Tool& tool = toolOf(deck_.contacts[c]);
    for (const fem::PointSet& points : contacts_[c].points)
      for (int n : points.nodes) {
        if (n >= mesh_.numNodes()) continue;  // a director
        const auto y = registry::project(tool, &mesh_.coordinates[3 * static_cast<std::size_t>(n)]);
        held.push_back({n, {y[1], y[2], y[3]}});
      }
  }
  for (const fem::FreeBody& body : fem::freeBodies(mesh_, supports, held, &shells_.geometry))
    fail("supports",
         fmt::format("the body with block '{}' can still move freely in {} rigid motion{}: prescribe more "
                     "displacements",
                     body.block, body.motions, body.motions == 1 ? "" : "s"));
}

void Scene::requireEffect(const fem::FeModel& model) const {
  if (model.supports.driven()) return;
  for (const deck::Load& load : deck_.loads)
    if (followers::isFollower(load) && !load.constant) return;
  for (std::size_t dof = 0; dof < model.load.size(); ++dof)
    if (model.load[dof] != 0 && !model.supports.fixed(static_cast<int>(dof))) return;
  fail("loads", "without effect: all that depends on the load factor acts on supported displacements");
}

int Scene::numContactPoints() const {
  return std::accumulate(contacts_.begin(), contacts_.end(), 0,
                         [](int n, const ContactPoints& c) { return n + c.count; });
}

int Scene::numUnknowns() const { return static_cast<int>(problem_->map()->getGlobalNumElements()); }

}  // namespace atrapos
