#include <functional>

#include "FollowerLoads.hpp"
#include "Scene.hpp"
#include "atrapos/fem/Loads.hpp"
#include "atrapos/fem/ShellFaces.hpp"
#include "atrapos/solid/ShellLoads.hpp"

// What acts on the body of a scene.
namespace atrapos {
namespace {

/// Adds one dead load of the deck to nodal forces.
struct DeadLoads {
  const fem::Mesh& mesh;
  const SceneShells& shells;
  std::function<std::vector<int>(const std::string&)> nodesOf;
  std::vector<double>& force;

  const fem::SideSet& sides(const std::string& set) const {
    return mesh.sideSets.at(fem::findSideSet(mesh, set));
  }

  void operator()(const deck::NodalLoad& load) const {
    const auto nodes = nodesOf(load.set);
    deck::Vector3 each = load.force;
    if (!load.perNode)
      for (double& f : each) f /= static_cast<double>(nodes.size());
    fem::addNodalLoad(nodes, each, force);
  }

  void operator()(const deck::SurfaceLoad& load) const {
    const double zeta = zetaOf(load.at);
    const auto faces =
        zeta == 0 ? fem::facePoints(mesh, sides(load.set), fem::loadDegree)
                  : fem::shellFacePoints(mesh, shells.geometry, sides(load.set), zeta, fem::loadDegree);
    deck::Vector3 perArea = load.vector;
    switch (load.kind) {
      case deck::SurfaceLoad::Kind::Total:
        for (double& f : perArea) f /= fem::areaOf(faces);
        return fem::addTraction(faces, perArea, force);
      case deck::SurfaceLoad::Kind::Traction:
        return fem::addTraction(faces, perArea, force);
      case deck::SurfaceLoad::Kind::Pressure:
        return fem::addPressure(faces, load.pressure, force);
    }
  }

  void operator()(const deck::EdgeLoad& load) const {
    deck::Vector3 perLength = load.vector;
    if (load.kind == deck::EdgeLoad::Kind::Total)
      for (double& f : perLength) f /= fem::edgeLength(mesh, sides(load.set));
    fem::addEdgeForce(mesh, sides(load.set), perLength, force);
  }

  void operator()(const deck::VolumeLoad& load) const {
    for (const std::string& name : load.blocks) {
      const int block = fem::findBlock(mesh, name), i = shells.find(block);
      if (i >= 0)
        solid::addShellBodyForce(shells.elements[i], load.force, force);
      else
        fem::addBodyForce(mesh, mesh.blocks[block], load.force, force);
    }
  }
};

}  // namespace

void Scene::addLoads(fem::FeModel& model) const {
  const std::size_t dofs = 3 * static_cast<std::size_t>(model.numNodes);
  model.load.assign(dofs, 0.0);
  model.constantLoad.assign(dofs, 0.0);
  for (const deck::Load& load : deck_.loads) {
    if (followers::isFollower(load)) continue;
    std::vector<double>& force = load.constant ? model.constantLoad : model.load;
    try {
      std::visit(DeadLoads{mesh_, shells_, [&](const std::string& set) { return nodesOf(set); }, force},
                 load.load);
    } catch (const std::runtime_error& e) {
      fail("loads/" + load.name, e.what());
    }
  }
}

void Scene::addFollowers(fem::FeModel& model) const {
  for (const deck::Load& load : deck_.loads) {
    if (!followers::isFollower(load)) continue;
    try {
      for (auto& term : followers::terms(load, mesh_, shells_)) model.terms.push_back(std::move(term));
    } catch (const std::invalid_argument& e) {
      fail("loads/" + load.name, e.what());
    }
  }
}

}  // namespace atrapos
