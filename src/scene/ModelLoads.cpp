#include "atrapos/fem/Loads.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/fem/ShellFaces.hpp"
#include "atrapos/solid/ShellLoads.hpp"
#include "scene/FollowerLoads.hpp"
#include "scene/ModelMaker.hpp"
#include "scene/Sets.hpp"

// What acts on the body of a scene.
namespace atrapos {
namespace {

/// Adds one dead load of the deck to nodal forces.
struct DeadLoads {
  const fem::Mesh& mesh;
  const SceneShells& shells;
  const std::optional<solid::PlaneSection>& plane;
  const std::map<int, solid::ThinSection>& thin;
  std::vector<double>& force;

  void operator()(const deck::NodalLoad& load) const {
    const auto nodes = nodesOf(mesh, load.set);
    deck::Vector3 each = load.force;
    if (!load.perNode)
      for (double& f : each) f /= static_cast<double>(nodes.size());
    fem::addNodalLoad(nodes, each, force);
  }

  void operator()(const deck::SurfaceLoad& load) const {
    const double zeta = zetaOf(load.at);
    const auto faces = plane ? solid::planeEdgePoints(mesh, sidesOf(mesh, load.set), *plane, fem::loadDegree)
                       : zeta == 0 ? fem::facePoints(mesh, sidesOf(mesh, load.set), fem::loadDegree)
                                   : fem::shellFacePoints(mesh, shells.geometry, sidesOf(mesh, load.set),
                                                          zeta, fem::loadDegree);
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

  void operator()(const deck::MomentLoad&) const {}  // on a rotation (ModelMaker::addLoads)
  void operator()(const deck::InflowLoad&) const {}  // no force (ModelMaker::addInflows)
  void operator()(const deck::PluginLoad&) const {}  // the same

  void operator()(const deck::EdgeLoad& load) const {
    deck::Vector3 perLength = load.vector;
    if (load.kind == deck::EdgeLoad::Kind::Total)
      for (double& f : perLength) f /= fem::edgeLength(mesh, sidesOf(mesh, load.set));
    fem::addEdgeForce(mesh, sidesOf(mesh, load.set), perLength, force);
  }

  void operator()(const deck::VolumeLoad& load) const {
    for (const std::string& name : load.blocks) {
      const int block = fem::findBlock(mesh, name), i = shells.find(block);
      if (plane)
        fem::addTraction(
            {solid::planeValuePoints(mesh, mesh.blocks[block],
                                     fem::tabulate(mesh.blocks[block].topology, fem::loadDegree), *plane)},
            load.force, force);
      else if (const auto section = thin.find(block); section != thin.end())
        fem::addTraction({solid::thinValuePoints(mesh, mesh.blocks[block],
                                                 fem::tabulate(mesh.blocks[block].topology, fem::loadDegree),
                                                 section->second)},
                         load.force, force);
      else if (i >= 0)
        solid::addShellBodyForce(shells.elements[i], load.force, force);
      else
        fem::addBodyForce(mesh, mesh.blocks[block], load.force, force);
    }
  }
};

}  // namespace

void ModelMaker::addLoads() {
  const std::size_t size = 3 * static_cast<std::size_t>(made_.model.dofs.numNodes());
  std::vector<double> growing(size, 0.0), constant(size, 0.0);  // [3 node + component]
  for (const deck::Load& load : deck_.loads) {
    if (followers::isFollower(load)) continue;
    std::vector<double>& force = load.constant ? constant : growing;
    try {
      std::visit(DeadLoads{mesh_, shells_, plane_, thin_, force}, load.load);
    } catch (const std::runtime_error& e) {
      fail("loads/" + load.name, e.what());
    }
  }
  made_.model.load = made_.model.dofs.fromVectors(growing);
  made_.model.constantLoad = made_.model.dofs.fromVectors(constant);
  for (const deck::Load& load : deck_.loads)
    if (const auto* moment = std::get_if<deck::MomentLoad>(&load.load))
      (load.constant ? made_.model.constantLoad
                     : made_.model.load)[made_.model.dofs.firstDof(made_.hinges.at(moment->coupling))] +=
          moment->moment;
}

void ModelMaker::addFollowers() {
  for (const deck::Load& load : deck_.loads) {
    if (!followers::isFollower(load)) continue;
    try {
      for (auto& term : followers::terms(load, {mesh_, shells_, plane_, made_.model}))
        made_.model.terms.push_back(std::move(term));
    } catch (const std::invalid_argument& e) {
      fail("loads/" + load.name, e.what());
    }
  }
}

}  // namespace atrapos
