#include "import/InpTies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "deck/Characters.hpp"
#include "import/Names.hpp"

namespace atrapos::importer {
namespace {

constexpr int mostTies = 1000;  // each goes through the whole model

/// Nodes of a surface, and whether those of shells, which have directors.
struct Surface {
  std::vector<int> nodes;  ///< ascending
  std::set<bool> shells;
  bool massive = true;  ///< faces of solids, edges of plane bodies

  bool canTie() const { return !shells.empty() && massive; }  // of nodes alone there are no faces
};

bool common(const std::vector<int>& a, const std::vector<int>& b) {
  return std::any_of(a.begin(), a.end(),
                     [&](int node) { return std::binary_search(b.begin(), b.end(), node); });
}

Surface surfaceOf(const InpModel& model, std::string_view field, const InpPlace& place) {
  const std::string name = inpName(field);
  Surface surface;
  if (const auto* const faces = model.surfaces.find(name)) {
    for (const InpFace& face : *faces) {
      const auto nodes = inpFaceNodes(model, face);
      surface.nodes.insert(surface.nodes.end(), nodes.begin(), nodes.end());
      const InpElementType& type = *model.elements[static_cast<std::size_t>(face.element)].type;
      surface.shells.insert(type.family == Family::shell);
      surface.massive = surface.massive && (fem::isSolid(type.topology) || fem::isPlane(type.topology));
    }
  } else if (const auto* const nodes = model.nodeSets.find(name)) {
    surface.nodes = *nodes;
  } else {
    place.fail(fmt::format("*TIE: there is no surface '{}'", deck::shortened(name)));
  }
  inpMakeSet(surface.nodes);
  return surface;
}

const double* at(const InpModel& model, int node) {
  return &model.coordinates[3 * static_cast<std::size_t>(node)];
}

/// A millionth of the model: what coordinates of seven digits leave open.
double samePlace(const InpModel& model) {
  double size = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    double low = 0, high = 0;
    for (std::size_t i = d; i < model.coordinates.size(); i += 3) {
      low = i == d ? model.coordinates[i] : std::min(low, model.coordinates[i]);
      high = i == d ? model.coordinates[i] : std::max(high, model.coordinates[i]);
    }
    size = std::max(size, high - low);
  }
  return 1e-6 * size;
}

using Cell = std::array<long long, 3>;

/// [node of `from`] a node of `to` at its place; -1: there is none.
std::vector<int> partners(const InpModel& model, const std::vector<int>& from, const std::vector<int>& to) {
  const double size = samePlace(model);
  if (!(size > 0)) return std::vector<int>(from.size(), -1);
  const auto cellOf = [&](int node) {
    Cell cell{};
    for (std::size_t d = 0; d < 3; ++d) cell[d] = std::llround(at(model, node)[d] / size);
    return cell;
  };
  std::map<Cell, int> nodeIn;  // one a cell: what else is there is at its place
  for (const int node : to) nodeIn.emplace(cellOf(node), node);
  const auto partner = [&](int node) {
    const Cell cell = cellOf(node);
    for (int i = 0; i < 27; ++i) {
      const auto found = nodeIn.find({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1});
      if (found == nodeIn.end()) continue;
      const double *p = at(model, node), *q = at(model, found->second);
      if (std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) <= size) return found->second;
    }
    return -1;
  };
  std::vector<int> found;
  for (const int node : from) found.push_back(partner(node));
  return found;
}

/// These nodes become others everywhere.
void replace(InpModel& model, const std::vector<int>& from, const std::vector<int>& to,
             const InpPlace& place) {
  std::vector<int> now(model.nodeIds.size());
  for (std::size_t n = 0; n < now.size(); ++n) now[n] = static_cast<int>(n);
  for (std::size_t i = 0; i < from.size(); ++i) now[static_cast<std::size_t>(from[i])] = to[i];
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    int* const nodes = &model.connectivity[model.elements[e].firstNode];
    const int count = model.elements[e].type->nodes;
    for (int i = 0; i < count; ++i) nodes[i] = now[static_cast<std::size_t>(nodes[i])];
    std::vector<int> sorted(nodes, nodes + count);
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      place.fail(fmt::format("*TIE: ties nodes of element {} to each other", model.elementIds[e]));
  }
  const auto replaceIn = [&](std::vector<int>& set) {
    for (int& node : set) node = now[static_cast<std::size_t>(node)];
    inpMakeSet(set);
  };
  for (auto& named : model.nodeSets.all()) replaceIn(named.second);
  for (InpRigidBody& body : model.rigidBodies) {
    replaceIn(body.nodes);
    for (int* node : {&body.reference, &body.rotation})
      if (*node >= 0) *node = now[static_cast<std::size_t>(*node)];
  }
  for (std::size_t i = 0; i < from.size(); ++i)
    model.nodeAt[model.nodeIds[static_cast<std::size_t>(from[i])]] = to[i];
}

}  // namespace

void tieInpSurfaces(InpModel& model, const InpCard& card) {
  InpLines lines(card);
  for (InpLine line; lines.next(line);) {
    if (++model.ties > mostTies)
      line.place.fail(fmt::format("*TIE: more than {} ties, which is the most", mostTies));
    const Surface slave = surfaceOf(model, line.at(0), line.place),
                  master = surfaceOf(model, line.at(1), line.place);
    std::vector<int> from, to;
    std::size_t lost = 0;
    long long firstLost = 0;
    const std::vector<int> found = partners(model, slave.nodes, master.nodes);
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (found[i] < 0 && lost++ == 0) firstLost = model.nodeIds[static_cast<std::size_t>(slave.nodes[i])];
      if (found[i] < 0 || found[i] == slave.nodes[i]) continue;
      from.push_back(slave.nodes[i]);
      to.push_back(found[i]);
    }
    if (lost > 0) {
      const std::string which =
          fmt::format("{} of {} nodes of '{}' are at no node of '{}', first node {}", lost, found.size(),
                      plainName(inpName(line.at(0))), plainName(inpName(line.at(1))), firstLost);
      if (slave.canTie() && master.canTie() && !common(slave.nodes, master.nodes)) {
        model.remark(line.place, fmt::format("*TIE: a coupling of kind tie of the deck, {}", which));
        model.tied.push_back({inpName(line.at(0)), inpName(line.at(1))});
      } else {
        model.remark(
            line.place,
            fmt::format("*TIE: left out, {}; tied are surfaces whose meshes fit, and faces of solids and "
                        "edges of plane bodies that share no node",
                        which));
      }
      continue;
    }
    if (slave.shells != master.shells && !slave.shells.empty() && !master.shells.empty()) {
      model.remark(line.place,
                   "*TIE: left out, one surface is of shells and the other is not; decks have couplings of "
                   "kind shell_on_solid");
      continue;
    }
    replace(model, from, to, line.place);
    model.remark(line.place, fmt::format("*TIE: {} nodes of '{}' are one with those of '{}'", from.size(),
                                         plainName(inpName(line.at(0))), plainName(inpName(line.at(1)))));
  }
}

}  // namespace atrapos::importer
