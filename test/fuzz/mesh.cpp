// An Exodus file: a mesh with results, or a part of one, or one line. Mutants are changed variable by
// variable, or in their bytes; files of NetCDF-4 are left to the tests, for HDF5 reads them in a process of
// its own.
#include <cstring>

#include "FileCheck.hpp"
#include "RawMutator.hpp"
#include "SampleResults.hpp"
#include "Target.hpp"
#include "atrapos/exodus/Decomposition.hpp"
#include "atrapos/exodus/Error.hpp"
#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/MeshPart.hpp"

using namespace atrapos;

namespace {

/// Whether it was read.
template <class F>
bool readOrRefuse(const std::string& file, const F& read) {
  try {
    read(file);
    return true;
  } catch (const exodus::Error& error) {
    fuzz::requireOneLine(error.what(), file);
    return false;
  }
}

/// One of two parts of a mesh, as a rank has it.
RawFile samplePart() {
  const fem::Mesh mesh = sampleMesh(fem::Topology::Hex8);
  const exodus::Decomposition cut(mesh, {0, 0, 0, 1, 1, 1}, 2);
  exodus::writePart(cut.part(0), fuzz::folder() / "sample.exo");
  return RawFile::read(exodus::partName(fuzz::folder() / "sample.exo", 2, 0));
}

/// The file as variables; what is none is a sample.
RawFile rawOf(const std::string& content, unsigned seed) {
  const std::string file = fuzz::folder().write("raw.exo", content);
  try {
    // Whose header announces no more than there is.
    if (exodus::checkFile(file) == exodus::Format::Classic) return RawFile::read(file);
  } catch (const std::runtime_error&) {
  }
  static const RawFile results = sampleResults(), part = samplePart();
  return seed % 2 == 0 ? results : part;
}

std::string contentOf(const std::string& file) {
  std::string content(std::filesystem::file_size(file), '\0');
  std::ifstream(file, std::ios::binary).read(content.data(), static_cast<std::streamsize>(content.size()));
  return content;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  const RawFile raw = rawOf(fuzz::textOf(data, size), seed);
  const std::string file = fuzz::folder() / "mutant.exo";
  try {
    RawMutator(seed)(raw).write(file);
  } catch (const std::runtime_error&) {  // no NetCDF file
    return LLVMFuzzerMutate(data, size, most);
  }
  const std::string changed = contentOf(file);
  if (changed.size() > most) return LLVMFuzzerMutate(data, size, most);
  std::memcpy(data, changed.data(), changed.size());
  return seed / 2 % 4 == 0 ? LLVMFuzzerMutate(data, changed.size(), most) : changed.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 0 && data[0] == 0x89) return 0;  // HDF5
  const std::string file = fuzz::folder().write(exodus::partName("mesh.exo", 2, 0), fuzz::textOf(data, size));
  // Where a mesh is refused a part is too, but for one without elements: that is tried now and then.
  if (readOrRefuse(file, exodus::readMesh) || size % 8 == 0) readOrRefuse(file, exodus::readPart);
  readOrRefuse(file, readResults);
  return 0;
}
