#pragma once

#include <string>
#include <vector>

namespace atrapos {

/// Replaces a file whole or not at all: writes beside it and renames. Throws std::runtime_error, one line.
void replaceFile(const std::string& file, const std::string& content);

/// Makes the folder where it is missing. Throws std::invalid_argument, one line, where no file can be made in
/// it or one of `files` is a folder there; changes nothing that is in it.
void prepareFolder(const std::string& folder, const std::vector<std::string>& files);

}  // namespace atrapos
