#pragma once

#include <functional>
#include <string>
#include <vector>

#include "File.hpp"
#include "atrapos/exodus/MeshPart.hpp"
#include "atrapos/exodus/ResultWriter.hpp"
#include "atrapos/fem/Mesh.hpp"

namespace atrapos::exodus {

/// What goes into a new file with the mesh.
struct FileContents {
  const fem::Mesh& mesh;
  std::vector<QaRecord> qa;               ///< without the record of this program, which is added
  std::vector<std::string> info;          ///< lines of any length
  std::size_t longestName = 0;            ///< of names that `more` defines
  std::function<void(const File&)> more;  ///< defines results; may be empty
  const MeshPart* part = nullptr;         ///< whose mesh it is; null: a whole mesh
};

/// Makes the file beside its place and moves it there once complete; it stays open for steps.
File createFile(const std::string& file, const FileContents& contents);

}  // namespace atrapos::exodus
