#include "commands/SplitCommand.hpp"

#include <fmt/format.h>

#include <ostream>
#include <set>
#include <stdexcept>

#include "atrapos/exodus/Decomposition.hpp"
#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/fem/Partition.hpp"
#include "commands/MeshCommand.hpp"
#include "output/Files.hpp"

namespace atrapos {

void splitMesh(const std::string& file, int parts, const std::string& output, std::ostream* progress) {
  const fem::Mesh mesh = exodus::readMesh(file);
  if (parts > mesh.numElements())
    throw std::invalid_argument(fmt::format("{}: has {} elements, which cannot be shared out to {} parts",
                                            file, mesh.numElements(), parts));
  const exodus::Decomposition cut(mesh, fem::partition(mesh, parts), parts);
  const std::string base = output.empty() ? file : output;
  for (int p = 0; p < parts; ++p) requireOwn(exodus::partName(base, parts, p), Made::mesh, {file});
  if (progress) *progress << fmt::format("{}: {}\n", file, describeMesh(mesh));
  for (int p = 0; p < parts; ++p) {
    const exodus::MeshPart part = cut.part(p);
    exodus::writePart(part, base);
    if (!progress) continue;
    std::set<int> shared;
    for (const exodus::PartBorder& border : part.borders)
      shared.insert(border.nodes.begin(), border.nodes.end());
    *progress << fmt::format("{}: {} elements, {} nodes, {} of them shared with {} other part{}\n",
                             exodus::partName(base, parts, p), part.mesh.numElements(), part.mesh.numNodes(),
                             shared.size(), part.borders.size(), part.borders.size() == 1 ? "" : "s");
  }
}

}  // namespace atrapos
