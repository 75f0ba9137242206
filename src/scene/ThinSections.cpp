#include "scene/ThinSections.hpp"

namespace atrapos {

std::map<int, solid::ThinSection> thinSections(const deck::Deck& deck, const fem::Mesh& mesh) {
  std::map<int, solid::ThinSection> sections;
  for (const auto* list : {&deck.membranes, &deck.bars})
    for (const deck::ThinSection& section : *list)
      for (const std::string& name : section.blocks)
        if (const int block = fem::findBlock(mesh, name); block >= 0)
          sections[block] = {section.size, section.prestress};
  return sections;
}

void markMembranes(const deck::Deck& deck, fem::Mesh& mesh) {
  for (const auto& [block, section] : thinSections(deck, mesh))
    mesh.blocks[block].membrane = fem::isShell(mesh.blocks[block].topology);
}

}  // namespace atrapos
