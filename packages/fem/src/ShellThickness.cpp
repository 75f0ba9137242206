#include "atrapos/fem/ShellThickness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>

#include "Labels.hpp"

namespace atrapos::fem {
namespace {

bool isThickness(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name == "thickness";
}

/// Attributes that hold the thickness: first column and how many (one, or one a node).
struct Columns {
  std::size_t first = 0, count = 0;
};

Columns thicknessColumns(const Block& block) {
  const auto& names = block.attributeNames;
  const auto named = std::find_if(names.begin(), names.end(), isThickness);
  if (named != names.end()) return {static_cast<std::size_t>(named - names.begin()), 1};
  if (names.size() == 1) return {0, 1};
  const std::size_t N = nodesPerElement(block.topology);
  if (names.size() == N) return {0, N};
  throw std::invalid_argument(
      fmt::format("{}: the shells have no thickness: give a number, or the block one attribute (or several "
                  "with one named "
                  "thickness, or one for each of the {} nodes); it has {}",
                  blockLabel(block), N, names.size()));
}

}  // namespace

std::vector<double> shellThickness(const Mesh& mesh, const ShellSection& section) {
  const Block& block = mesh.blocks.at(section.block);
  const std::size_t N = nodesPerElement(block.topology), numElements = block.nodes.size() / N;
  if (section.thickness) {
    if (!(*section.thickness > 0) || !std::isfinite(*section.thickness))
      throw std::invalid_argument(fmt::format("{}: the thickness of shells must be positive, got {}",
                                              blockLabel(block), *section.thickness));
    return std::vector<double>(numElements * N, *section.thickness);
  }
  const Columns columns = thicknessColumns(block);
  std::vector<double> result(numElements * N);
  for (std::size_t e = 0; e < numElements; ++e)
    for (std::size_t n = 0; n < N; ++n) {
      const std::size_t column = columns.first + (columns.count > 1 ? n : 0);
      const double t = block.attributes[e * block.attributeNames.size() + column];
      if (!(t > 0) || !std::isfinite(t))
        throw std::invalid_argument(
            fmt::format("{}: the thickness in its attributes must be positive, got {}{}",
                        elementLabel(mesh, section.block, static_cast<int>(e)), t,
                        columns.count > 1 ? " at " + nodeLabel(mesh, block.nodes[e * N + n]) : ""));
      result[e * N + n] = t;
    }
  return result;
}

}  // namespace atrapos::fem
