#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/solid/MixedBody.hpp"
#include "deck/Deck.hpp"
#include "deck/DeckValue.hpp"

namespace atrapos::deck {
namespace {

template <class Entry>
std::vector<std::string> labels(const std::vector<Entry>& entries) {
  std::vector<std::string> labels;
  for (const auto& entry : entries) {
    labels.push_back(entry.name.empty() ? std::to_string(entry.id) : entry.name);
  }
  return labels;
}

class MeshCheck {
 public:
  MeshCheck(const Deck& deck, const fem::Mesh& mesh) : deck_(deck), mesh_(mesh) {}

  void nodes(const std::string& path, const std::string& set) const {
    const int nodeSet = fem::findNodeSet(mesh_, set);
    const int sideSet = fem::findSideSet(mesh_, set);
    if (nodeSet < 0 && sideSet < 0) {
      const auto nodeSets = labels(mesh_.nodeSets), sideSets = labels(mesh_.sideSets);
      auto all = nodeSets;
      all.insert(all.end(), sideSets.begin(), sideSets.end());
      fail(path,
           fmt::format("the mesh has no node set or side set '{}'{}; it has the {} and the {}", set,
                       suggestion(set, all), listed("node sets", nodeSets), listed("side sets", sideSets)));
    }
    const bool empty = nodeSet >= 0 ? mesh_.nodeSets[static_cast<std::size_t>(nodeSet)].nodes.empty()
                                    : mesh_.sideSets[static_cast<std::size_t>(sideSet)].sides.empty();
    if (empty) {
      fail(path, fmt::format("the {} set '{}' is empty", nodeSet >= 0 ? "node" : "side", set));
    }
  }

  void sides(const std::string& path, const std::string& set) const {
    const int found = fem::findSideSet(mesh_, set);
    if (found < 0) {
      const auto sideSets = labels(mesh_.sideSets);
      fail(path, fmt::format("the mesh has no side set '{}'{}; it has the {}", set, suggestion(set, sideSets),
                             listed("side sets", sideSets)));
    }
    if (mesh_.sideSets[static_cast<std::size_t>(found)].sides.empty()) {
      fail(path, fmt::format("the side set '{}' is empty", set));
    }
  }

  int block(const std::string& path, const std::string& name) const {
    const int found = fem::findBlock(mesh_, name);
    if (found < 0) {
      const auto blocks = labels(mesh_.blocks);
      fail(path, fmt::format("the mesh has no block '{}'{}; it has the {}", name, suggestion(name, blocks),
                             listed("blocks", blocks)));
    }
    return found;
  }

  void materials() const {
    std::map<int, std::string> materialOf;
    for (const auto& material : deck_.materials) {
      const std::string path = "materials/" + material.name + "/blocks";
      for (const auto& name : material.blocks) {
        const int found = block(path, name);
        const auto [previous, isNew] = materialOf.emplace(found, material.name);
        if (!isNew) {
          fail(path, fmt::format("block '{}' already has the material '{}'", name, previous->second));
        }
        if (std::holds_alternative<VonMises>(material.law)) plastic(material, found);
        const bool shell = fem::isShell(mesh_.blocks[static_cast<std::size_t>(found)]);
        if (isThin(found) && (material.dielectric || (!material.expansion.empty() && !shell))) {
          const std::string key = material.dielectric ? "dielectric" : "expansion";
          fail("materials/" + material.name + "/" + key,
               fmt::format(
                   "block '{}' has {}; {} is for {}", name, kindOf(found), key,
                   material.dielectric ? "solids and plane bodies" : "solids, plane bodies and shells"));
        }
      }
    }
    std::set<int> used;
    std::map<int, std::string> fluidOf;
    for (const auto& entry : materialOf) {
      used.insert(entry.first);
    }
    for (const auto& entry : deck_.physics) {
      const std::string path = "physics/" + entry.name + "/blocks";
      for (const auto& name : entry.blocks) {
        const int found = block(path, name);
        used.insert(found);
        if (isThin(found) && !fem::isShell(mesh_.blocks[static_cast<std::size_t>(found)])) {
          fail(path, fmt::format("block '{}' has {}; balances are for solids, plane cells and shells", name,
                                 kindOf(found)));
        }
        if (const auto* flow = std::get_if<FluidFlow>(&entry.law)) {
          fluid(entry.name, *flow, found);
          if (materialOf.count(found) != 0) {
            fail(path, fmt::format("block '{}' has the material '{}'; a fluid has none", name,
                                   materialOf.at(found)));
          }
          const auto [previous, isNew] = fluidOf.emplace(found, entry.name);
          if (!isNew) {
            fail(path, fmt::format("block '{}' already has the flow '{}'", name, previous->second));
          }
        }
      }
    }
    const auto blocks = labels(mesh_.blocks);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (used.count(static_cast<int>(i)) == 0) {
        fail(deck_.physics.empty() ? "materials" : "physics",
             fmt::format("the mesh's block '{}' has no material{}", blocks[i],
                         deck_.physics.empty() ? "" : " and no physics"));
      }
    }
  }

  void sections() const {
    std::map<int, std::string> sectionOf;
    for (const auto& section : deck_.shells.sections) {
      const std::string path = "shells/sections/" + section.name + "/blocks";
      for (const auto& name : section.blocks) {
        const int found = block(path, name);
        const fem::Block& b = mesh_.blocks[static_cast<std::size_t>(found)];
        if (!fem::isShell(b.topology)) {
          fail(path, fmt::format("block '{}' has {}, no shells", name, fem::topologyName(b.topology)));
        }
        if (b.membrane) {
          fail(path, fmt::format("block '{}' has membranes, which are no shells", name));
        }
        const auto [previous, isNew] = sectionOf.emplace(found, section.name);
        if (!isNew) {
          fail(path, fmt::format("block '{}' already has the section '{}'", name, previous->second));
        }
      }
    }
  }

  /// Membranes are surfaces in space, and bars lines, which all have an entry.
  void thinSections() const {
    std::set<int> thin;
    const auto check = [&](const std::vector<ThinSection>& sections, const char* key, const char* needed,
                           bool (*fits)(fem::Topology)) {
      for (const auto& section : sections) {
        const std::string path = fmt::format("{}/{}/blocks", key, section.name);
        for (const auto& name : section.blocks) {
          const int found = block(path, name);
          const fem::Topology topology = mesh_.blocks[static_cast<std::size_t>(found)].topology;
          if (!fits(topology)) {
            fail(path, fmt::format("block '{}' has {}, no {}", name, fem::topologyName(topology), needed));
          }
          if (!thin.insert(found).second) {
            fail(path, fmt::format("block '{}' has an entry already", name));
          }
          for (const auto& material : deck_.materials) {
            if (section.prestress != 0 && std::holds_alternative<VonMises>(material.law) &&
                std::any_of(material.blocks.begin(), material.blocks.end(), [&](const std::string& other) {
                  return fem::findBlock(mesh_, other) == found;
                })) {
              fail(fmt::format("{}/{}/prestress", key, section.name),
                   "is not for von_mises, whose yield stress would not see it");
            }
          }
        }
      }
    };
    check(deck_.membranes, "membranes", "surfaces in space (SHELL3, SHELL4, SHELL6, SHELL8, SHELL9)",
          [](fem::Topology t) { return fem::isShell(t); });
    check(deck_.bars, "bars", "bars (BAR2, BAR3)", [](fem::Topology t) { return fem::isBar(t); });
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      if (fem::isBar(mesh_.blocks[b].topology) && thin.count(static_cast<int>(b)) == 0) {
        fail("bars", fmt::format("block '{}' has bars without an entry, which says their area",
                                 labels(mesh_.blocks)[b]));
      }
    }
  }

  void joints() const {
    for (const auto& joint : deck_.shells.joints) {
      const std::string path = "shells/joints/" + joint.name + "/set";
      nodes(path, joint.set);
      if (!hasShells(joint.set)) {
        fail(path, fmt::format("no node of '{}' belongs to shells", joint.set));
      }
    }
  }

  /// A plane mesh, and what is said of it.
  void plane() const {
    if (mesh_.dimension == 2 && !deck_.plane && !deck_.materials.empty()) {
      fail("plane",
           "missing; the mesh is a plane one, so the deck says what it stands for: kind: strain, stress or "
           "axisymmetric");
    }
    if (mesh_.dimension == 3 && deck_.plane) {
      fail("plane", "the mesh has three dimensions; expected one with QUAD or TRI in two");
    }
  }

  /// Whether something along z, or out of the plane, is asked for where there is none.
  void inPlane(const std::string& path, bool leaves) const {
    if (mesh_.dimension == 2 && leaves) {
      fail(path, "a plane body has no z");
    }
  }

  void support(const Support& support) const {
    const std::string path = "supports/" + support.name;
    nodes(path + "/set", support.set);
    inPlane(path + "/z", support.components[2] && !holds(support.condition, 2, false));
    inPlane(path + "/condition", support.condition == Support::Condition::SymmetryZ);
    inPlane(path + "/normal", support.normal && (*support.normal)[2] != 0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (support.director[axis] && !holds(support.condition, axis, true) && !hasShells(support.set)) {
        fail(fmt::format("{}/director_{}", path, "xyz"[axis]),
             fmt::format("no node of '{}' belongs to shells, so there is no director", support.set));
      }
    }
  }

  /// The sides of a set that must be faces, of solids too where `place` is the middle.
  void faces(const std::string& path, const std::string& set, ShellPlace place) const {
    sides(path + "/set", set);
    for (const fem::Side& side : sideSet(set).sides) {
      const bool shell = fem::isShell(blockOf(side));
      if (fem::isShell(blockOf(side).topology) && side.side > 1) {
        fail(path + "/set",
             fmt::format(
                 "the side set '{}' has edges of shells; expected faces (edges take loads of type edge)",
                 set));
      }
      if (!shell && place != ShellPlace::Middle) {
        fail(path + "/at", fmt::format("the side set '{}' has faces of {}; top and bottom are for shells",
                                       set, blockOf(side).membrane ? "membranes" : "solids"));
      }
    }
  }

  void edges(const std::string& path, const std::string& set) const {
    sides(path, set);
    for (const fem::Side& side : sideSet(set).sides) {
      if (!fem::isShell(blockOf(side).topology) || side.side < 2) {
        fail(path, fmt::format("side {} of element {} in the side set '{}' is no edge of a shell",
                               side.side + 1, mesh_.elementNumber(side.element), set));
      }
    }
  }

  void coupling(const Coupling& coupling) const {
    const std::string path = "couplings/" + coupling.name;
    if (coupling.kind == Coupling::Kind::Equation) {
      for (const EquationTerm& term : coupling.terms) {
        nodes(path + "/terms", term.set);
        inPlane(path + "/terms", term.unknown == "z");
      }
      return;
    }
    if (coupling.kind == Coupling::Kind::Tie) {
      sides(path + "/set", coupling.set);
      sides(path + "/to", coupling.to);
      return;
    }
    nodes(path + "/set", coupling.set);
    if (coupling.kind == Coupling::Kind::ShellOnSolid && !hasShells(coupling.set)) {
      fail(path + "/set", fmt::format("no node of '{}' belongs to shells", coupling.set));
    }
    if (coupling.reference.empty()) return;
    const std::string& name = coupling.reference;
    nodes(path + "/reference", name);
    const int set = fem::findNodeSet(mesh_, name);
    const std::size_t count = set >= 0 ? mesh_.nodeSets[static_cast<std::size_t>(set)].nodes.size()
                                       : fem::nodesOf(mesh_, sideSet(name)).size();
    if (count != 1)
      fail(path + "/reference", fmt::format("'{}' has {} nodes; expected a set of one node", name, count));
  }

  void contact(const Contact& contact) const {
    const std::string path = "contact/" + contact.name;
    if (!isAtNodes(contact, mesh_)) {
      faces(path, contact.set, contact.at);
      return;
    }
    nodes(path + "/set", contact.set);
    if (contact.shares == Contact::Shares::DistributionFactors) {
      distributionFactors(path + "/shares", contact.set);
    }
    if (contact.at != ShellPlace::Middle && !hasShells(contact.set)) {
      fail(path + "/at",
           fmt::format("no node of '{}' belongs to shells, which have a top and a bottom", contact.set));
    }
  }

  /// Of the contact that a monitor names, which the deck has.
  void notAtNodes(const std::string& monitor, const std::string& name, const char* why) const {
    const auto contact = std::find_if(deck_.contacts.begin(), deck_.contacts.end(),
                                      [&](const Contact& c) { return c.name == name; });
    if (isAtNodes(*contact, mesh_)) {
      fail("output/monitors/" + monitor + "/contact",
           fmt::format("contact '{}' acts at nodes, {}", name, why));
    }
  }

  void distributionFactors(const std::string& path, const std::string& set) const {
    const int found = fem::findNodeSet(mesh_, set);
    if (found < 0) {
      fail(path, fmt::format("'{}' is a side set; distribution factors are those of a node set", set));
    }
    const fem::NodeSet& nodeSet = mesh_.nodeSets[static_cast<std::size_t>(found)];
    if (nodeSet.factors.empty()) {
      fail(path, fmt::format("the mesh has no distribution factors for the node set '{}'", set));
    }
    for (std::size_t i = 0; i < nodeSet.factors.size(); ++i) {
      if (!(nodeSet.factors[i] > 0)) {
        fail(path, fmt::format(
                       "the distribution factor of node {} in the node set '{}' is {:.6g}, must be positive",
                       mesh_.nodeNumber(nodeSet.nodes[i]), set, nodeSet.factors[i]));
      }
    }
  }

  void load(const Load& load) const {
    const std::string path = "loads/" + load.name;
    if (const auto* nodal = std::get_if<NodalLoad>(&load.load)) {
      inPlane(path, nodal->force[2] != 0);
      nodes(path + "/set", nodal->set);
    } else if (const auto* surface = std::get_if<SurfaceLoad>(&load.load)) {
      inPlane(path, surface->vector[2] != 0);
      faces(path, surface->set, surface->at);
    } else if (const auto* edge = std::get_if<EdgeLoad>(&load.load)) {
      edges(path + "/set", edge->set);
      const bool dead = edge->kind == EdgeLoad::Kind::Total || edge->kind == EdgeLoad::Kind::Force;
      for (const fem::Side& side : sideSet(edge->set).sides) {
        if (!dead && blockOf(side).membrane) {
          fail(path, fmt::format("block '{}' has membranes, whose edges take dead forces alone",
                                 blockOf(side).name));
        }
      }
    } else if (const auto* inflow = std::get_if<InflowLoad>(&load.load)) {
      if (inflow->contact.empty()) {
        sides(path + "/set", inflow->set);
      }
    } else if (std::holds_alternative<MomentLoad>(load.load)) {
      return;  // of a coupling, which is checked by itself
    } else if (const auto* own = std::get_if<PluginLoad>(&load.load)) {
      sides(path + "/set", own->set);
    } else {
      inPlane(path, std::get<VolumeLoad>(load.load).force[2] != 0);
      for (const auto& name : std::get<VolumeLoad>(load.load).blocks) {
        block(path + "/blocks", name);
      }
    }
  }

 private:
  /// What a material that yields does not serve so far.
  void plastic(const Material& material, int block) const {
    const bool thin = isThin(block) || (deck_.plane && deck_.plane->kind == Plane::Kind::Stress);
    if (thin && std::get<VonMises>(material.law).strains == VonMises::Strains::Finite) {
      fail("materials/" + material.name + "/strains",
           "finite strains are for solids, plane strain and axisymmetry; shells, membranes, bars and plane "
           "stress take small");
    }
    if (!deck_.path.series()) {
      fail("materials/" + material.name + "/law",
           "von_mises needs path/method: series, whose events are the points that begin to yield");
    }
  }

  void fluid(const std::string& name, const FluidFlow& flow, int block) const {
    const std::string path = "physics/" + name;
    const fem::Block& cells = mesh_.blocks[static_cast<std::size_t>(block)];
    if (!solid::hasPressures(cells.topology)) {
      fail(path + "/blocks",
           fmt::format("block '{}' has {}; a flow needs cells of degree 2: QUAD8, QUAD9, TRI6, HEX20, HEX27, "
                       "TET10 or WEDGE15",
                       cells.name, fem::topologyName(cells.topology)));
    }
    if (static_cast<int>(flow.velocity.size()) != mesh_.dimension) {
      fail(path + "/velocity", fmt::format("has {} components; the mesh has {} dimensions",
                                           flow.velocity.size(), mesh_.dimension));
    }
    if (deck_.plane && deck_.plane->kind == Plane::Kind::Stress) {
      fail(path, "a flow is plane with kind: strain, or axisymmetric");
    }
  }

  [[noreturn]] void fail(const std::string& path, const std::string& what) const {
    failAt(deck_, path, what);
  }

  const fem::SideSet& sideSet(const std::string& name) const {
    return mesh_.sideSets[static_cast<std::size_t>(fem::findSideSet(mesh_, name))];
  }

  const fem::Block& blockOf(const fem::Side& side) const {
    return mesh_.blocks[static_cast<std::size_t>(fem::addressOf(mesh_, side.element).block)];
  }

  /// Whether a block's cells are no bodies themselves: shells, membranes, bars; and their name.
  bool isThin(int block) const {
    const fem::Topology topology = mesh_.blocks[static_cast<std::size_t>(block)].topology;
    return fem::isShell(topology) || fem::isBar(topology);
  }
  const char* kindOf(int block) const {
    const fem::Block& b = mesh_.blocks[static_cast<std::size_t>(block)];
    return fem::isBar(b.topology) ? "bars" : b.membrane ? "membranes" : "shells";
  }

  bool hasShells(const std::string& set) const {
    const int nodeSet = fem::findNodeSet(mesh_, set);
    const std::vector<int> nodes = nodeSet >= 0 ? mesh_.nodeSets[static_cast<std::size_t>(nodeSet)].nodes
                                                : fem::nodesOf(mesh_, sideSet(set));
    std::vector<char> onShell(static_cast<std::size_t>(mesh_.numNodes()), 0);
    for (const fem::Block& block : mesh_.blocks) {
      for (const int node : block.nodes) {
        onShell[static_cast<std::size_t>(node)] |= fem::isShell(block) ? 1 : 0;
      }
    }
    return std::any_of(nodes.begin(), nodes.end(),
                       [&](int node) { return onShell[static_cast<std::size_t>(node)] != 0; });
  }

  static std::string listed(const std::string& kind, const std::vector<std::string>& names) {
    return kind + " " + (names.empty() ? "(none)" : joined(names));
  }

  const Deck& deck_;
  const fem::Mesh& mesh_;
};

}  // namespace

bool isAtNodes(const Contact& contact, const fem::Mesh& mesh) {
  if (contact.points != Contact::Points::Auto) {
    return contact.points == Contact::Points::Nodes;
  }
  // The numbers of a law are others at nodes: who gives them says where.
  return contact.law == Contact::Law::Auto && fem::findSideSet(mesh, contact.set) < 0 &&
         fem::findNodeSet(mesh, contact.set) >= 0;
}

void checkAgainstMesh(const Deck& deck, const fem::Mesh& mesh) {
  const MeshCheck check(deck, mesh);
  check.plane();
  check.materials();
  check.thinSections();
  check.sections();
  check.joints();
  for (const auto& support : deck.supports) {
    check.support(support);
  }
  for (const auto& coupling : deck.couplings) {
    check.coupling(coupling);
  }
  for (const auto& load : deck.loads) {
    check.load(load);
  }
  for (const auto& contact : deck.contacts) {
    check.contact(contact);
  }
  for (const auto& monitor : deck.output.monitors) {
    if (const auto* displacement = std::get_if<DisplacementMonitor>(&monitor.quantity)) {
      check.nodes("output/monitors/" + monitor.name + "/set", displacement->set);
      check.inPlane("output/monitors/" + monitor.name, displacement->component == Component::Z);
    } else if (const auto* field = std::get_if<FieldMonitor>(&monitor.quantity)) {
      check.nodes("output/monitors/" + monitor.name + "/set", field->set);
    } else if (const auto* area = std::get_if<ContactAreaMonitor>(&monitor.quantity)) {
      check.notAtNodes(monitor.name, area->contact, "which have no area");
    } else if (const auto* pressure = std::get_if<ContactPressureMonitor>(&monitor.quantity)) {
      check.notAtNodes(monitor.name, pressure->contact, "by forces and not by a pressure");
    } else if (const auto* center = std::get_if<ContactCenterMonitor>(&monitor.quantity)) {
      check.inPlane("output/monitors/" + monitor.name, center->component == Component::Z);
    } else if (const auto* spread = std::get_if<ContactSpreadMonitor>(&monitor.quantity)) {
      check.inPlane("output/monitors/" + monitor.name, spread->component == Component::Z);
    }
  }
}

}  // namespace atrapos::deck
