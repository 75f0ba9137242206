#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace atrapos {

/// A result file as the page names it.
struct ShapeFile {
  int branch = 0;
  std::string name;   ///< of the branch
  std::string file;   ///< results.exo of that branch, without a part's numbers
  std::string tools;  ///< tools.exo of that branch, which need not be there
};

/// The surface of the body and its states: positions at rest, triangles, edges, displacements and fields of
/// every state, as base64 of little-endian floats and numbers of 4 bytes; beside it the rigid tools
/// (ReportTools), where they are there. States, then fields, are left out until `bytes` suffice, and tools
/// that alone take a third of them; `notes` says so. Null where no file has a displacement. Throws
/// exodus::Error on files that are damaged.
nlohmann::json shapeOf(const std::vector<ShapeFile>& files, std::size_t bytes,
                       std::vector<std::string>& notes);

/// Base64 of numbers of 4 bytes in the order of the machine, which is little-endian (x86-64).
std::string base64(const std::vector<float>& values);
std::string base64(const std::vector<std::uint32_t>& values);

/// Positions of at most `most` of `count` things, evenly, the first and the last with them.
std::vector<std::size_t> evenly(std::size_t count, std::size_t most);

}  // namespace atrapos
