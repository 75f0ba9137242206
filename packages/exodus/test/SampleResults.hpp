#pragma once

#include <string>
#include <vector>

#include "RawFile.hpp"
#include "SampleMesh.hpp"
#include "TempFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "atrapos/exodus/ResultWriter.hpp"

/// A file with all that this package writes.
inline RawFile sampleResults() {
  using namespace atrapos;
  const TempFile file;
  const auto mesh = sampleMesh(fem::Topology::Hex8);
  exodus::ResultNames names{{"u", "v"}, {"s"}, {"load_factor"}, {"a line"}, {}};
  exodus::ResultWriter writer(file(), mesh, names);
  const auto nodes = static_cast<std::size_t>(mesh.numNodes()),
             elements = static_cast<std::size_t>(mesh.numElements());
  for (int step = 1; step <= 2; ++step)
    writer.writeStep(step, std::vector<double>(2 * nodes, 1.5), std::vector<double>(elements, 2.5),
                     std::vector<double>(1, 3.5));
  return RawFile::read(file());
}

/// Reads all that a file of results has.
inline void readResults(const std::string& file) {
  const atrapos::exodus::ResultReader reader(file);
  for (int step = 0; step < reader.numSteps(); ++step) {
    reader.globals(step);
    for (const auto& name : reader.nodalNames()) reader.nodal(step, name);
    for (const auto& name : reader.elementNames()) reader.element(step, name);
  }
  reader.times();
  reader.info();
  reader.qa();
}
