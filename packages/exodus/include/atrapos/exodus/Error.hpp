#pragma once

#include <stdexcept>
#include <string>

namespace atrapos::exodus {

/// What is wrong with a file or with what should be written to it: one line that begins with the file's name.
/// Names that a file has are in it with blanks for control characters, which would move a terminal's cursor.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& line) : std::runtime_error(plain(line)) {}

 private:
  static std::string plain(std::string line);
};

}  // namespace atrapos::exodus
