#include "scene/Scene.hpp"

#include <fmt/format.h>

#include <Tpetra_Map.hpp>

#include "plugin/Plugins.hpp"
#include "scene/ModelMaker.hpp"
#include "scene/ThinSections.hpp"

namespace atrapos {
namespace {

solid::PlaneSection planeSection(const deck::Plane& plane) {
  using Kind = solid::PlaneSection::Kind;
  switch (plane.kind) {
    case deck::Plane::Kind::Strain:
      return {Kind::strain, plane.thickness.value_or(1)};
    case deck::Plane::Kind::Stress:
      return {Kind::stress, plane.thickness.value_or(1)};
    case deck::Plane::Kind::Axisymmetric:
      return {Kind::axisymmetric, 1};
  }
  throw std::logic_error("planeSection: not a kind of plane bodies");
}

}  // namespace

Scene::Scene(const deck::Deck& deck, DeckMesh mesh)
    : deck_(deck), mesh_(std::move(mesh.mesh)), givenRanks_(std::move(mesh.ranks)) {
  plugins::require(deck_);
  markMembranes(deck_, mesh_);
  deck::checkAgainstMesh(deck_, mesh_);
  shells_ = sceneShells(deck_, mesh_);
  if (mesh_.dimension == 2) plane_ = deck_.plane ? planeSection(*deck_.plane) : solid::PlaneSection{};
  if (deck_.output.shells == deck::Output::Shells::Body) {
    if (shells_.empty())
      deck::failAt(deck_, "output/shells", "the mesh has no shells, which alone have a body to write");
    body_ = fem::shellBody(mesh_, shells_.geometry);
  }
  tools_ = sceneTools(deck_);
  problem_ = std::make_unique<fem::FeProblem>(makeModel());
  addMonitors();
}

fem::FeModel Scene::makeModel() {
  SceneModel made = ModelMaker({deck_, mesh_, givenRanks_, shells_, plane_, tools_}).make();
  bodies_ = std::move(made.bodies);
  contacts_ = std::move(made.contacts);
  deck_.contacts = std::move(made.chosenContacts);
  shells_.joints = std::move(made.joints);
  ties_ = std::move(made.ties);
  normalForces_ = std::move(made.normalForces);
  hinges_ = std::move(made.hinges);
  made.model.dofName = [this, dofs = made.model.dofs](int dof) { return dofName(dofs, dof); };
  return std::move(made.model);
}

std::vector<std::string> Scene::remarks() const {
  std::vector<std::string> lines = describe(mesh_, shells_);
  for (const TiedSurfaces& tie : ties_)
    lines.push_back(fmt::format(
        "tie       {}: {} nodes follow{}, largest gap {:.3g}", tie.name, tie.nodes,
        tie.open > 0 ? fmt::format(", {} have nothing opposite and are free", tie.open) : "", tie.gap));
  return lines;
}

std::string Scene::dofName(const fem::DofMap& dofs, int dof) const {
  const fem::ShellGeometry& g = shells_.geometry;
  const fem::DofMap::Address at = dofs.addressOf(dof);
  if (at.node >= g.numNodes()) return dofs.nameOf(dof);  // of rigid bodies and contact points
  const int node = at.node < g.numMeshNodes ? at.node : g.meshNode[at.node - g.numMeshNodes];
  const fem::Field& field = dofs.fields()[at.field];
  const std::string component = field.components[at.component];
  return fmt::format("{}{}{} {} node {}", field.name, component.empty() ? "" : " ", component,
                     at.node < g.numMeshNodes ? "of" : "at", mesh_.nodeNumber(node));
}

std::vector<int> Scene::elementRanks() const {
  std::vector<int> all;
  for (const BodyBlock& body : bodies_) {
    const std::vector<int>& ofBlock = problem_->ranksOf(body.any());
    all.insert(all.end(), ofBlock.begin(), ofBlock.end());
  }
  return all;
}

int Scene::numUnknowns() const { return static_cast<int>(problem_->map()->getGlobalNumElements()); }

}  // namespace atrapos
