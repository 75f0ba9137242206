#pragma once

#include <iosfwd>
#include <string>

namespace atrapos {

/// `atrapos report`: the page of the results in a folder. `output`: empty: report.html in the folder. Throws
/// as writeReport, and where the file is there and is no report.
void reportResults(const std::string& folder, const std::string& output, std::ostream* progress);

}  // namespace atrapos
