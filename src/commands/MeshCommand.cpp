#include "commands/MeshCommand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "atrapos/fem/StructuredMesh.hpp"
#include "atrapos/fem/StructuredPlane.hpp"
#include "atrapos/fem/StructuredShell.hpp"
#include "deck/DeckValue.hpp"
#include "machine/Memory.hpp"

namespace atrapos {
namespace {

struct Builder {
  fem::Mesh operator()(const fem::BoxOptions& o) const { return fem::boxMesh(o); }
  fem::Mesh operator()(const fem::StripOptions& o) const { return fem::stripMesh(o); }
  fem::Mesh operator()(const fem::CylinderPanelOptions& o) const { return fem::cylinderPanelMesh(o); }
  fem::Mesh operator()(const fem::SpherePanelOptions& o) const { return fem::spherePanelMesh(o); }
  fem::Mesh operator()(const fem::ShellPlateOptions& o) const { return fem::shellPlateMesh(o); }
  fem::Mesh operator()(const fem::ShellCylinderOptions& o) const { return fem::shellCylinderMesh(o); }
  fem::Mesh operator()(const fem::ShellAnnulusOptions& o) const { return fem::shellAnnulusMesh(o); }
  fem::Mesh operator()(const fem::ShellSphereOptions& o) const { return fem::shellSphereMesh(o); }
  fem::Mesh operator()(const fem::RectangleOptions& o) const { return fem::rectangleMesh(o); }
  fem::Mesh operator()(const fem::AnnulusOptions& o) const { return fem::annulusMesh(o); }
  fem::Mesh operator()(const fem::QuadrilateralOptions& o) const { return fem::quadrilateralMesh(o); }
  fem::Mesh operator()(const fem::TrussOptions& o) const { return fem::trussMesh(o); }
};

struct CountElements {
  template <class Options>
  double operator()(const Options& options) const {
    double product = 1;
    for (const int n : options.divisions) product *= n;
    return product;
  }
  double operator()(const fem::TrussOptions& options) const {
    return static_cast<double>(options.bars.size());
  }
};

/// Before memory is taken for it: nodes and elements with their copies for the file, at most 1 kB an element
/// (HEX27).
void requireRoom(const deck::Deck& deck) {
  const double elements = std::visit(CountElements{}, *deck.mesh.generate);
  constexpr double most = 1e8, bytesEach = 1000;
  if (elements > most)
    deck::failAt(deck, "mesh/generate/divisions",
                 fmt::format("makes {:.3g} elements; expected at most {:.0e}", elements, most));
  const double room = machineMemory().available;
  if (room > 0 && elements * bytesEach > room)
    deck::failAt(deck, "mesh/generate/divisions",
                 fmt::format("makes {:.3g} elements, which may take {}; the machine has {}", elements,
                             inBytes(elements * bytesEach), inBytes(room)));
}

}  // namespace

fem::Mesh generateMesh(const deck::Deck& deck) {
  if (deck.problem) deck::failAt(deck, "problem", "a model problem has no mesh");
  if (!deck.mesh.generate)
    deck::failAt(deck, "mesh/generate", "missing; `atrapos mesh` needs it to make " + deck.mesh.file);
  requireRoom(deck);
  try {
    fem::Mesh mesh = std::visit(Builder{}, *deck.mesh.generate);
    mesh.title = deck::beginOf(deck.title, 80);  // what Exodus holds
    return mesh;
  } catch (const std::invalid_argument& e) {
    deck::failAt(deck, "mesh/generate", e.what());
  }
}

std::string otherThanGenerated(const deck::Deck& deck, const fem::Mesh& mesh) {
  constexpr int mostNodes = 200000;  // a tenth of a second
  if (!deck.mesh.generate || mesh.numNodes() > mostNodes) return {};
  fem::Mesh made;
  try {
    made = generateMesh(deck);
  } catch (const deck::DeckError&) {
    return {};  // this mesh came from elsewhere
  }
  const auto line = [&](const std::string& what) {
    return fmt::format("{} is not what mesh/generate makes ({}); `atrapos mesh {}` makes it anew",
                       deck.mesh.file, what, deck.file);
  };
  if (made.numNodes() != mesh.numNodes() || made.numElements() != mesh.numElements())
    return line(fmt::format("{} nodes, {} elements in place of {}, {}", mesh.numNodes(), mesh.numElements(),
                            made.numNodes(), made.numElements()));
  double size = 0, off = 0;
  for (std::size_t i = 0; i < made.coordinates.size(); ++i) {
    size = std::max(size, std::abs(made.coordinates[i]));
    off = std::max(off, std::abs(made.coordinates[i] - mesh.coordinates[i]));
  }
  constexpr double rounding = 1e-9;  // of programs that wrote the same mesh otherwise
  return off > rounding * size ? line(fmt::format("nodes lie up to {:.3g} elsewhere", off)) : "";
}

std::string describeMesh(const fem::Mesh& mesh) {
  std::string text = fmt::format("{} nodes", mesh.numNodes());
  for (const fem::Block& block : mesh.blocks)
    text += fmt::format(", {} {} in block '{}'", block.nodes.size() / fem::nodesPerElement(block.topology),
                        fem::topologyName(block.topology), block.name);
  return text;
}

}  // namespace atrapos
