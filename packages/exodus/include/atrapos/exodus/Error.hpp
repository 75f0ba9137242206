#pragma once

#include <stdexcept>

namespace atrapos::exodus {

/// What is wrong with a file or with what should be written to it: one line that begins with the file's name.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace atrapos::exodus
