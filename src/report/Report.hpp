#pragma once

#include <string>

namespace atrapos {

/// Writes a page that shows the results in a folder: one HTML file that needs no other and no network. Throws
/// std::invalid_argument or exodus::Error, one line, where the folder holds no path or a damaged one,
/// FileError where the page cannot be written. The first rank writes, the others' calls do nothing.
void writeReport(const std::string& folder, const std::string& file);

}  // namespace atrapos
