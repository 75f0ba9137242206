#include "scene/Shells.hpp"
#include "scene/Degrees.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/SharedEdges.hpp"
#include "scene/Sets.hpp"

namespace atrapos {
namespace {

std::vector<fem::ShellSection> sectionsOf(const deck::Deck& deck, const fem::Mesh& mesh) {
  std::vector<fem::ShellSection> sections;
  for (int b = 0; b < static_cast<int>(mesh.blocks.size()); ++b)
    if (fem::isShell(mesh.blocks[b])) sections.push_back({b, std::nullopt});
  for (const deck::ShellSection& section : deck.shells.sections)
    for (const std::string& name : section.blocks)
      for (fem::ShellSection& s : sections)
        if (s.block == fem::findBlock(mesh, name)) s.thickness = section.thickness;
  return sections;
}

/// Whether a shell's assumed strains are its own, and there are no others to choose.
bool isTied(fem::Topology topology) {
  return !fem::hasMiddles(topology) || topology == fem::Topology::Shell6;
}

deck::Shear shearOf(const deck::Deck& deck, const fem::Mesh& mesh, int block) {
  for (const deck::ShellSection& section : deck.shells.sections)
    for (const std::string& name : section.blocks)
      if (section.shear && fem::findBlock(mesh, name) == block) {
        if (*section.shear == deck::Shear::Compatible && isTied(mesh.blocks[block].topology))
          deck::failAt(deck, "shells/sections/" + section.name + "/shear",
                       fmt::format("block '{}' has {}, whose shear is always assumed", name,
                                   fem::topologyName(mesh.blocks[block].topology)));
        return *section.shear;
      }
  return deck.shells.shear;
}

solid::ShellCubature cubatureOf(const deck::Deck& deck, const fem::Mesh& mesh, int block) {
  solid::ShellCubature cubature;
  for (const deck::Material& material : deck.materials)
    for (const std::string& name : material.blocks)
      if (fem::findBlock(mesh, name) == block && std::holds_alternative<deck::VonMises>(material.law))
        cubature.throughThickness = deck.shells.metalPoints;
  return cubature;
}

/// The axis of a plane of symmetry; empty where the condition is none.
std::optional<int> symmetryAxis(deck::Support::Condition condition) {
  if (condition == deck::Support::Condition::Clamped) return std::nullopt;
  for (int axis = 0; axis < 3; ++axis)
    if (deck::holds(condition, static_cast<std::size_t>(axis), true)) return axis;
  return std::nullopt;
}

/// Directors of SHELL4 and SHELL3 at planes of symmetry, in these planes: the mean of the normals there is
/// that of the facets on one side alone, off by half the angle between neighbours.
std::vector<fem::PrescribedDirector> directorsInSymmetry(const deck::Deck& deck, const fem::Mesh& mesh,
                                                         const fem::ShellGeometry& geometry) {
  std::set<int> facetNodes;
  for (const fem::Block& block : mesh.blocks)
    if (fem::isShell(block) && !fem::hasMiddles(block.topology))
      facetNodes.insert(block.nodes.begin(), block.nodes.end());
  if (facetNodes.empty()) return {};
  const double largest =
      std::sin(radians(deck.shells.foldAngle));  // beyond it the surface meets itself in a fold
  std::map<int, fem::PrescribedDirector> directors;
  for (const deck::Support& support : deck.supports) {
    const auto axis = symmetryAxis(support.condition);
    if (!axis) continue;
    for (const int node : nodesOf(mesh, support.set)) {
      if (facetNodes.count(node) == 0 || geometry.directorNodes(node).size() != 1) continue;
      const double* D = &geometry.directors[3 * static_cast<std::size_t>(geometry.firstDirector[node])];
      const double length = std::hypot(D[0], D[1], D[2]);
      if (std::abs(D[*axis]) > largest * length) continue;
      auto& director =
          directors.try_emplace(node, fem::PrescribedDirector{node, {D[0], D[1], D[2]}}).first->second;
      director.direction[*axis] = 0;
    }
  }
  std::vector<fem::PrescribedDirector> result;
  for (const auto& entry : directors) result.push_back(entry.second);
  return result;
}

fem::ShellGeometry geometryOf(const deck::Deck& deck, const fem::Mesh& mesh) {
  fem::ShellGeometryOptions options;
  options.foldAngle = deck.shells.foldAngle;
  try {
    fem::ShellGeometry geometry = fem::shellGeometry(mesh, sectionsOf(deck, mesh), options);
    options.directors = directorsInSymmetry(deck, mesh, geometry);
    return options.directors.empty() ? geometry : fem::shellGeometry(mesh, sectionsOf(deck, mesh), options);
  } catch (const std::invalid_argument& e) {
    deck::failAt(deck, "shells", e.what());
  }
}

}  // namespace

int SceneShells::find(int block) const {
  for (std::size_t i = 0; i < geometry.blocks.size(); ++i)
    if (geometry.blocks[i].block == block) return static_cast<int>(i);
  return -1;
}

SceneShells sceneShells(const deck::Deck& deck, fem::Mesh& mesh) {
  for (const fem::Block& block : mesh.blocks)
    if (block.topology == fem::Topology::Shell9 && fem::isShell(block))
      deck::failAt(
          deck, "mesh/file",
          fmt::format("block '{}' has SHELL9; accepted are SHELL8, SHELL6, SHELL4 and SHELL3", block.name));
  SceneShells shells;
  shells.parts = fem::orientShells(mesh, deck.shells.foldAngle);
  shells.geometry = geometryOf(deck, mesh);
  for (const fem::ShellBlock& b : shells.geometry.blocks) {
    shells.elements.push_back({b.nodes, b.midsurface, b.directors, b.directorScale, b.nodesPerElement});
    shells.shear.push_back(shearOf(deck, mesh, b.block));
    shells.cubature.push_back(cubatureOf(deck, mesh, b.block));
  }
  return shells;
}

fem::ShellJoints joinShells(const deck::Deck& deck, const fem::Mesh& mesh, const SceneShells& shells,
                            fem::FeModel& model) {
  std::set<int> hinges;
  for (const deck::ShellJoint& joint : deck.shells.joints) {
    bool found = false;
    for (const int node : nodesOf(mesh, joint.set)) {
      found = found || shells.geometry.directorNodes(node).size() > 1;
      if (joint.kind == deck::ShellJoint::Kind::Hinge)
        hinges.insert(node);
      else
        hinges.erase(node);
    }
    if (!found)
      deck::failAt(deck, "shells/joints/" + joint.name + "/set",
                   fmt::format("at no node of '{}' do shells meet at more than the fold angle of {:g} "
                               "degrees, so there is no joint",
                               joint.set, deck.shells.foldAngle));
  }
  try {
    const double youngsModulus = deck::largestYoungsModulus(deck);
    fem::coupleSharedEdges(model, mesh, shells.geometry, youngsModulus);
    return fem::joinShells(model, mesh, shells.geometry, youngsModulus, {hinges.begin(), hinges.end()});
  } catch (const std::invalid_argument& e) {
    deck::failAt(deck, "shells", e.what());
  }
}

std::vector<std::string> describe(const fem::Mesh& mesh, const SceneShells& shells) {
  std::vector<std::string> lines;
  constexpr int most = 5;  // lines on parts
  int parts = 0, elements = 0;
  for (const fem::ShellPart& part : shells.parts) {
    if (part.turned == 0) continue;
    elements += part.turned;
    const auto where = [&] {
      return fmt::format("of element {} (block '{}')", mesh.elementNumber(part.element), part.block);
    };
    if (++parts <= most)
      lines.push_back(
          fmt::format("normals   {} of the {} shells around that {} turned over, so that "
                      "neighbours agree on top and bottom",
                      part.turned, part.elements, where()));
    if (part.sidesMixed)
      lines.push_back(
          fmt::format("warning   a side set has faces on both sides of the shells around that {}: "
                      "they stay where the mesh has them",
                      where()));
  }
  if (parts > most)
    lines.push_back(fmt::format("normals   {} shells turned over in {} parts in all", elements, parts));
  if (!shells.geometry.followers.empty())
    lines.push_back(fmt::format(
        "edges     {} are shared by shells with and without middle nodes: the middles follow the ends",
        shells.geometry.followers.size()));
  if (const std::vector<int> nodes = fem::middlesAtCorners(mesh); !nodes.empty())
    lines.push_back(fmt::format(
        "warning   {} nodes are in the middle of an edge of one shell and a corner of another (first node "
        "{}): their "
        "edges do not fit between the nodes, and stresses there are off; give both sides the same edges",
        nodes.size(), mesh.nodeNumber(nodes.front())));
  const std::size_t rigid = shells.joints.rigid.size(), hinged = shells.joints.hinged.size();
  if (rigid + hinged > 0)
    lines.push_back(
        fmt::format("joints    of shells at {} nodes: {} rigid, {} hinged", rigid + hinged, rigid, hinged));
  return lines;
}

double zetaOf(deck::ShellPlace place) {
  switch (place) {
    case deck::ShellPlace::Top:
      return solid::topSurface;
    case deck::ShellPlace::Middle:
      return solid::midSurface;
    case deck::ShellPlace::Bottom:
      return solid::bottomSurface;
  }
  return solid::midSurface;
}

std::vector<solid::ShellEdge> shellEdges(const fem::Mesh& mesh, const fem::SideSet& set, int block) {
  std::vector<solid::ShellEdge> edges;
  for (const fem::Side& side : set.sides) {
    const fem::ElementAddress at = fem::addressOf(mesh, side.element);
    if (at.block == block) edges.push_back({at.element, side.side - 2});
  }
  return edges;
}

}  // namespace atrapos
