#pragma once

#include <string>
#include <vector>

namespace atrapos::exodus {

/// Cuts text into info records of at most 80 characters, Exodus' limit. Line breaks end a record. A longer
/// line is continued: each record of exactly 80 characters whose last one is a backslash goes on in the next
/// record (a line of 80 that ends with a backslash of its own is cut too, so the rule has no exception).
std::vector<std::string> toInfoRecords(const std::vector<std::string>& lines);

/// The lines again. Blanks at the end of a line are lost in the file.
std::vector<std::string> fromInfoRecords(const std::vector<std::string>& records);

}  // namespace atrapos::exodus
