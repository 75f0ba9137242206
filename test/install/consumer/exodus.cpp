// A mesh written and read back by the installed library.
#include <cstdio>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/fem/StructuredMesh.hpp"

using namespace atrapos;

int main() {
  fem::StripOptions options;
  options.divisions = {4, 2, 1};
  const fem::Mesh written = fem::stripMesh(options);
  exodus::writeMesh(written, "consumer.exo");
  const fem::Mesh read = exodus::readMesh("consumer.exo");
  std::remove("consumer.exo");
  if (read.coordinates == written.coordinates && read.blocks[0].nodes == written.blocks[0].nodes) return 0;
  std::puts("the mesh read is not the mesh written");
  return 1;
}
