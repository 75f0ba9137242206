// `atrapos-gmsh FILE MESH plane|shells [quiet]`: what `atrapos import` starts for meshes of Gmsh. A program
// of its own, as libgmsh would double the time that `atrapos` takes to start, and does not survive all
// damaged files.

#include <sys/resource.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>

#include "atrapos/exodus/MeshFile.hpp"
#include "gmsh/ReadGmsh.hpp"

namespace {

void limit(int what, rlim_t most) {
  rlimit value{};
  getrlimit(what, &value);
  value.rlim_cur = std::min(most, value.rlim_max);
  setrlimit(what, &value);
}

/// A mesh takes some 30 times the memory of its file, and seconds for 100 MB; a damaged one may ask for any.
void limitTo(const std::string& file) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(file, error);
  const rlim_t size = error ? 0 : bytes;
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_AS, (rlim_t{4} << 30) + 100 * size);
  limit(RLIMIT_CPU, 60 + size / (rlim_t{1} << 20));
}

}  // namespace

int main(int argc, char** argv) {
  constexpr int badInput = 2;
  if (argc < 4) {
    std::cerr << "atrapos-gmsh: is started by atrapos import\n";
    return badInput;
  }
  const std::string file = argv[1], output = argv[2], surfaces = argv[3];
  try {
    limitTo(file);
    const atrapos::importer::Model model =
        atrapos::importer::readGmsh(file, surfaces == "shells" ? atrapos::importer::Surfaces::shells
                                                               : atrapos::importer::Surfaces::plane);
    atrapos::exodus::writeMesh(model.mesh, output);
    if (argc < 5)
      for (const std::string& remark : model.remarks) std::cout << remark << '\n';
    return 0;
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return badInput;
  }
}
