#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace atrapos {

/// Joins part files, mesh and results, into one file (`output`; empty: the parts' name without numbers).
/// `files`: any of the parts, or their common name where there is one decomposition of it; all parts are
/// read. `progress` may be null. Throws exodus::Error and std::invalid_argument, one line, where parts are
/// missing or do not belong together.
void joinParts(const std::vector<std::string>& files, const std::string& output, std::ostream* progress);

}  // namespace atrapos
