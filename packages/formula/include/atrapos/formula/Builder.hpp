#pragma once

#include <string>
#include <vector>

#include "atrapos/formula/FormulaError.hpp"
#include "atrapos/formula/Program.hpp"

namespace atrapos::formula {

/// Makes programs: what was asked for before is given again, operations on numbers are worked out. Numbers of
/// steps are counted over all formulas of a builder.
class Builder {
 public:
  /// Throws FormulaError where the number is not finite: a constant part that divides by zero, or the like.
  int number(double value);
  int input(int index);
  int datum(int index);
  /// Throws FormulaError where the formulas become longer than Program::maxSteps.
  int unary(Operation operation, int a);
  int binary(Operation operation, int a, int b);

  /// The size of what a step is the sum of: |a| + |b| for a + b and a - b, through products and quotients; it
  /// is of the order of the step's rounding over epsilon. For the values of doubles.
  int magnitude(int step);

  /// The inputs that a step depends on, ascending.
  std::vector<int> inputsOf(int step) const;

  /// Those of the steps that the results need. Throws FormulaError as above.
  Program program(const std::vector<int>& results) const;

 private:
  static bool isBinary(Operation operation);
  bool isNumber(int step) const { return steps_[step].operation == Operation::number; }
  bool isNumber(int step, double value) const { return isNumber(step) && steps_[step].number == value; }
  int add(const Step& step);
  /// [step] 1 where the results need it.
  std::vector<char> neededFor(const std::vector<int>& results) const;

  std::vector<Step> steps_;
};

}  // namespace atrapos::formula
