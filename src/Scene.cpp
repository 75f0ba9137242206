#include "Scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "Registry.hpp"
#include "Shells.hpp"
#include "atrapos/fem/Loads.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/fem/ShellFaces.hpp"

namespace atrapos {

Scene::Scene(const deck::Deck& deck, fem::Mesh mesh) : deck_(deck), mesh_(std::move(mesh)) {
  deck::checkAgainstMesh(deck_, mesh_);
  shellsOf(deck_, mesh_);
  refuseUnsupported(deck_, mesh_);
  fem::FeModel model;
  model.numNodes = mesh_.numNodes();
  addMaterials(model);
  model.supports = fem::Supports(model.numNodes);
  addSupports(model);
  addLoads(model);
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
  solids_.resize(mesh_.blocks.size());
  for (const deck::Material& material : deck_.materials)
    for (const std::string& name : material.blocks) {
      const int b = fem::findBlock(mesh_, name);
      const fem::Block& block = mesh_.blocks[b];
      try {
        const auto cell = fem::tabulate(block.topology);
        const auto points = fem::volumePoints(mesh_, block, cell);
        solids_[b] = {static_cast<int>(model.terms.size()), fem::extrapolation(block.topology, cell)};
        model.terms.push_back(registry::materialTerm(material, points));
      } catch (const std::runtime_error& e) {
        fail("mesh/file", e.what());
      }
    }
}

void Scene::addSupports(fem::FeModel& model) const {
  for (const deck::Support& support : deck_.supports)
    for (int node : nodesOf(support.set))
      for (int i = 0; i < 3; ++i)
        if (const auto& p = support.components[i]) try {
            model.supports.prescribe(node, i, p->value, p->perLoadFactor);
          } catch (const std::invalid_argument& e) {
            fail("supports/" + support.name, e.what());
          }
}

void Scene::addLoads(fem::FeModel& model) const {
  const std::size_t dofs = 3 * static_cast<std::size_t>(mesh_.numNodes());
  model.load.assign(dofs, 0.0);
  model.constantLoad.assign(dofs, 0.0);
  struct Adder {
    const Scene& scene;
    std::vector<double>& force;
    void operator()(const deck::NodalLoad& load) const {
      const auto nodes = scene.nodesOf(load.set);
      deck::Vector3 each = load.force;
      if (!load.perNode)
        for (double& f : each) f /= static_cast<double>(nodes.size());
      fem::addNodalLoad(nodes, each, force);
    }
    void operator()(const deck::SurfaceLoad& load) const {
      const auto& set = scene.mesh_.sideSets.at(fem::findSideSet(scene.mesh_, load.set));
      switch (load.kind) {
        case deck::SurfaceLoad::Kind::Total:
          return fem::addSurfaceForce(scene.mesh_, set, load.vector, force);
        case deck::SurfaceLoad::Kind::Traction:
          return fem::addTraction(scene.mesh_, set, load.vector, force);
        case deck::SurfaceLoad::Kind::Pressure:
          return fem::addPressure(scene.mesh_, set, load.pressure, force);
      }
    }
    void operator()(const deck::EdgeLoad& load) const {
      const auto& set = scene.mesh_.sideSets.at(fem::findSideSet(scene.mesh_, load.set));
      deck::Vector3 perLength = load.vector;
      if (load.kind == deck::EdgeLoad::Kind::Total)
        for (double& f : perLength) f /= fem::edgeLength(scene.mesh_, set);
      fem::addEdgeForce(scene.mesh_, set, perLength, force);
    }
    void operator()(const deck::VolumeLoad& load) const {
      for (const std::string& name : load.blocks)
        fem::addBodyForce(scene.mesh_, scene.mesh_.blocks.at(fem::findBlock(scene.mesh_, name)), load.force,
                          force);
    }
  };
  for (const deck::Load& load : deck_.loads)
    std::visit(Adder{*this, load.constant ? model.constantLoad : model.load}, load.load);
}

void Scene::requireSupport(const fem::Supports& supports) const {
  std::vector<fem::HeldDirection> held;
  for (const ContactPoints& contact : contacts_)
    for (const fem::PointSet& points : contact.points)
      for (int n : points.nodes) {
        const double* x = &mesh_.coordinates[3 * static_cast<std::size_t>(n)];
        const double place[4] = {x[0], x[1], x[2], 0};
        const ToolProjection over = contact.tool->project(place);
        if (std::isfinite(over.gap)) held.push_back({n, {over.normal[0], over.normal[1], over.normal[2]}});
      }
  for (const fem::FreeBody& body : fem::freeBodies(mesh_, supports, held))
    fail("supports",
         fmt::format("the body with block '{}' can still move freely in {} rigid motion{}: prescribe more "
                     "displacements",
                     body.block, body.motions, body.motions == 1 ? "" : "s"));
}

void Scene::requireEffect(const fem::FeModel& model) const {
  if (model.supports.driven()) return;
  for (const ContactPoints& contact : contacts_)
    if (contact.tool->moves()) return;
  for (std::size_t dof = 0; dof < model.load.size(); ++dof)
    if (model.load[dof] != 0 && !model.supports.fixed(static_cast<int>(dof))) return;
  fail("loads", "without effect: all that depends on the load factor acts on supported displacements");
}

}  // namespace atrapos
