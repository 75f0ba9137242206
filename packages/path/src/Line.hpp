#pragma once

#include <sstream>
#include <string>

namespace atrapos::path {

/// One line from its parts.
template <class... Parts>
std::string line(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

}  // namespace atrapos::path
