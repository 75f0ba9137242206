#pragma once

#include <stdexcept>

namespace atrapos::formula {

/// What is wrong with a formula, in one line.
class FormulaError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace atrapos::formula
