#include "Shells.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace atrapos {

fem::ShellGeometry shellsOf(const deck::Deck& deck, const fem::Mesh& mesh) {
  std::vector<fem::ShellSection> sections;
  for (int b = 0; b < static_cast<int>(mesh.blocks.size()); ++b)
    if (fem::isShell(mesh.blocks[b].topology)) sections.push_back({b, std::nullopt});
  for (const deck::ShellSection& section : deck.shells.sections)
    for (const std::string& name : section.blocks)
      for (fem::ShellSection& s : sections)
        if (s.block == fem::findBlock(mesh, name)) s.thickness = section.thickness;
  fem::ShellGeometryOptions options;
  options.foldAngle = deck.shells.foldAngle;
  try {
    return fem::shellGeometry(mesh, sections, options);
  } catch (const std::invalid_argument& e) {
    throw deck::DeckError(fmt::format("{}: shells: {}", deck.file, e.what()));
  }
}

void refuseUnsupported(const deck::Deck& deck, const fem::Mesh& mesh) {
  const auto fail = [&](const std::string& key, const std::string& what) {
    throw deck::DeckError(fmt::format("{}: {}: {}", deck.file, key, what));
  };
  for (const fem::Block& block : mesh.blocks)
    if (fem::isShell(block.topology))
      fail("mesh/file",
           fmt::format("block '{}' has {}: shells are read and checked, but cannot be run yet; accepted "
                       "are the HEX, TET and WEDGE cells",
                       block.name, fem::topologyName(block.topology)));
  for (const deck::Load& load : deck.loads) {
    const std::string key = "loads/" + load.name;
    const auto* surface = std::get_if<deck::SurfaceLoad>(&load.load);
    const auto* edge = std::get_if<deck::EdgeLoad>(&load.load);
    if (surface != nullptr && surface->follower)
      fail(key + "/follower", "pressures that follow cannot be run yet; accepted is false");
    if (surface != nullptr && surface->at != deck::ShellPlace::Middle)
      fail(key + "/at", "loads on the top or bottom of shells cannot be run yet; accepted is middle");
    if (edge != nullptr && edge->kind != deck::EdgeLoad::Kind::Total &&
        edge->kind != deck::EdgeLoad::Kind::Force)
      fail(key, "moments on edges and forces that follow cannot be run yet; accepted are total and force");
  }
  for (const deck::Contact& contact : deck.contacts)
    if (contact.at != deck::ShellPlace::Middle)
      fail("contact/" + contact.name + "/at",
           "contact on the top or bottom of shells cannot be run yet; accepted is middle");
}

}  // namespace atrapos
