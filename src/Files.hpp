#pragma once

#include <string>

namespace atrapos {

/// Replaces a file whole or not at all: writes beside it and renames. Throws std::runtime_error, one line.
void replaceFile(const std::string& file, const std::string& content);

}  // namespace atrapos
