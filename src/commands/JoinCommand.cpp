#include "commands/JoinCommand.hpp"

#include <fmt/format.h>

#include <ostream>
#include <stdexcept>

#include "atrapos/exodus/JoinedResults.hpp"
#include "commands/MeshCommand.hpp"
#include "output/Files.hpp"

namespace atrapos {
namespace {

/// Which parts a name means.
exodus::PartName partsOf(const std::string& name) {
  const std::vector<int> found = exodus::findParts(name);
  if (found.size() > 1)
    throw std::invalid_argument(fmt::format("{}: is cut into {} parts; name the files of one decomposition",
                                            name, fmt::join(found, " and again into ")));
  if (found.size() == 1) return {name, found.front(), 0};
  return exodus::parsePartName(name);
}

}  // namespace

void joinParts(const std::vector<std::string>& files, const std::string& output, std::ostream* progress) {
  const exodus::PartName parts = partsOf(files.front());
  for (const std::string& name : files) {
    const exodus::PartName other = partsOf(name);
    if (other.file != parts.file || other.parts != parts.parts)
      throw std::invalid_argument(
          fmt::format("{} and {} are not parts of one decomposition", files.front(), name));
  }
  const exodus::JoinedResults results(parts.file, parts.parts);
  const std::string file = output.empty() ? parts.file : output;
  std::vector<std::string> inputs;
  for (int p = 0; p < parts.parts; ++p) inputs.push_back(exodus::partName(parts.file, parts.parts, p));
  requireOwn(file, Made::mesh, inputs);
  exodus::writeJoined(results, file);
  if (!progress) return;
  *progress << fmt::format("{}: {}", file, describeMesh(results.joined().mesh));
  const exodus::ResultNames names = results.names();
  if (results.numSteps() > 0)
    *progress << fmt::format("; {} states with {} nodal and {} element variables", results.numSteps(),
                             names.nodal.size(), names.element.size());
  *progress << fmt::format("; from {} parts\n", parts.parts);
  if (results.uneven())
    *progress << fmt::format(
        "some parts have more than these {} states, a run was ended while it wrote: "
        "what all parts have is joined\n",
        results.numSteps());
}

}  // namespace atrapos
