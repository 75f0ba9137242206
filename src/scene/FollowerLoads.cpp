#include "scene/FollowerLoads.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "atrapos/fem/PointSet.hpp"
#include "atrapos/solid/EdgePressure.hpp"
#include "atrapos/solid/FacePressure.hpp"
#include "scene/Sets.hpp"

namespace atrapos::followers {
namespace {

using Terms = std::vector<std::unique_ptr<fem::Term>>;

struct Maker {
  const Body& body;
  bool constant;
  const fem::Mesh& mesh = body.mesh;
  const SceneShells& shells = body.shells;

  solid::LoadAmount amount(double value) const {
    return constant ? solid::LoadAmount{value, 0} : solid::LoadAmount{0, value};
  }

  Terms operator()(const deck::SurfaceLoad& load) const {
    if (body.plane)
      return solid::followerPressure(
          mesh, sidesOf(mesh, load.set), *body.plane, amount(load.pressure),
          solid::hasPotential(mesh, sidesOf(mesh, load.set), body.model.dofs, body.model.supports));
    const std::size_t blocks = shells.elements.size();
    // Pressure > 0 pushes on the body: against the normal of a top side, along it on a bottom side.
    std::vector<std::vector<int>> loaded(2 * blocks);
    fem::SideSet solids = sidesOf(mesh, load.set);
    solids.sides.clear();
    for (const fem::Side& side : sidesOf(mesh, load.set).sides) {
      const fem::ElementAddress at = fem::addressOf(mesh, side.element);
      const int i = shells.find(at.block);
      if (i < 0)
        solids.sides.push_back(side);
      else
        loaded[2 * i + side.side].push_back(at.element);
    }
    Terms result = solid::followerPressure(mesh, solids, amount(load.pressure));
    for (std::size_t k = 0; k < loaded.size(); ++k)
      if (!loaded[k].empty())
        result.push_back(solid::followerPressure(shells.elements[k / 2], loaded[k], zetaOf(load.at),
                                                 amount(k % 2 == 0 ? load.pressure : -load.pressure)));
    return result;
  }

  Terms operator()(const deck::EdgeLoad& load) const {
    Terms result;
    for (std::size_t i = 0; i < shells.elements.size(); ++i) {
      const fem::Block& block = mesh.blocks[shells.geometry.blocks[i].block];
      const auto edges = shellEdges(mesh, sidesOf(mesh, load.set), shells.geometry.blocks[i].block);
      if (edges.empty()) continue;
      try {
        result.push_back(term(load, shells.elements[i], edges));
      } catch (const std::invalid_argument& e) {
        throw std::invalid_argument(fmt::format("block '{}': {}", block.name, e.what()));
      }
    }
    return result;
  }

  std::unique_ptr<fem::Term> term(const deck::EdgeLoad& load, const solid::ShellElements& elements,
                                  const std::vector<solid::ShellEdge>& edges) const {
    const deck::Vector3& v = load.vector;
    if (load.kind == deck::EdgeLoad::Kind::Moment)
      return solid::deadEdgeMoment(elements, edges, {amount(v[0]), amount(v[1]), amount(v[2])});
    solid::FollowerEdgeLoad follower;
    if (load.kind == deck::EdgeLoad::Kind::FollowerMoment) {
      follower.moment = amount(load.moment);
    } else {
      follower.along = amount(v[0]);
      follower.outward = amount(v[1]);
      follower.director = amount(v[2]);
    }
    return solid::followerEdgeLoad(elements, edges, follower);
  }

  Terms operator()(const deck::InflowLoad&) const { return {}; }
  Terms operator()(const deck::PluginLoad&) const { return {}; }
  Terms operator()(const deck::MomentLoad&) const { return {}; }
  Terms operator()(const deck::NodalLoad&) const { return {}; }
  Terms operator()(const deck::VolumeLoad&) const { return {}; }
};

}  // namespace

bool isFollower(const deck::Load& load) {
  if (const auto* surface = std::get_if<deck::SurfaceLoad>(&load.load)) return surface->follower;
  if (const auto* edge = std::get_if<deck::EdgeLoad>(&load.load))
    return edge->kind != deck::EdgeLoad::Kind::Total && edge->kind != deck::EdgeLoad::Kind::Force;
  return false;
}

std::vector<std::unique_ptr<fem::Term>> terms(const deck::Load& load, const Body& body) {
  return std::visit(Maker{body, load.constant}, load.load);
}

}  // namespace atrapos::followers
