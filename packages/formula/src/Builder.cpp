#include "atrapos/formula/Builder.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace atrapos::formula {
namespace {

// More than a program takes, for what several formulas share is counted once in the end.
constexpr std::size_t mostSteps = 4096;

[[noreturn]] void tooLong(std::size_t most) {
  throw FormulaError("is too long: formulas that act together may have " + std::to_string(most) +
                     " operations");
}

/// The value of an operation on numbers.
double valueOf(Operation operation, double a, double b) {
  Program program;
  program.steps[0].number = a;
  program.steps[1].number = b;
  program.steps[2] = {operation, 0, 1, b};
  program.numSteps = 3;
  program.results[0] = 2;
  program.numResults = 1;
  double value = 0;
  evaluate<double>(program, nullptr, nullptr, &value);
  return value;
}

bool same(const Step& a, const Step& b) {
  // -0 is not 0.
  return a.operation == b.operation && a.a == b.a && a.b == b.b &&
         std::memcmp(&a.number, &b.number, sizeof a.number) == 0;
}

}  // namespace

int Builder::add(const Step& step) {
  const auto known = std::find_if(steps_.begin(), steps_.end(), [&](const Step& s) { return same(s, step); });
  if (known != steps_.end()) return static_cast<int>(known - steps_.begin());
  if (steps_.size() >= mostSteps) tooLong(mostSteps);
  steps_.push_back(step);
  return static_cast<int>(steps_.size()) - 1;
}

int Builder::number(double value) {
  if (!std::isfinite(value))
    throw FormulaError("has a constant part whose value is " +
                       std::string(std::isnan(value) ? "no number" : "infinite"));
  return add({Operation::number, 0, 0, value});
}
int Builder::input(int index) { return add({Operation::input, index, 0, 0}); }
int Builder::datum(int index) { return add({Operation::datum, index, 0, 0}); }

int Builder::unary(Operation operation, int a) {
  if (isNumber(a)) return number(valueOf(operation, steps_[a].number, 0));
  return add({operation, a, 0, 0});
}

int Builder::binary(Operation operation, int a, int b) {
  if (isNumber(a) && isNumber(b)) return number(valueOf(operation, steps_[a].number, steps_[b].number));
  switch (operation) {
    case Operation::add:
      if (isNumber(a, 0)) return b;
      if (isNumber(b, 0)) return a;
      return add({operation, std::min(a, b), std::max(a, b), 0});
    case Operation::subtract:
      if (isNumber(b, 0)) return a;
      break;
    case Operation::multiply:
      if (isNumber(a, 0) || isNumber(b, 0)) return number(0);
      if (isNumber(a, 1)) return b;
      if (isNumber(b, 1)) return a;
      return add({operation, std::min(a, b), std::max(a, b), 0});
    case Operation::divide:
      if (isNumber(b, 1)) return a;
      break;
    case Operation::powerOf:
      if (isNumber(b)) return add({Operation::power, a, 0, steps_[b].number});
      break;
    default:
      break;
  }
  return add({operation, a, b, 0});
}

bool Builder::isBinary(Operation operation) {
  switch (operation) {
    case Operation::add:
    case Operation::subtract:
    case Operation::multiply:
    case Operation::divide:
    case Operation::powerOf:
      return true;
    default:
      return false;
  }
}

int Builder::magnitude(int step) {
  const Step s = steps_[step];  // steps are added meanwhile
  switch (s.operation) {
    case Operation::negate:
      return magnitude(s.a);
    case Operation::add:
    case Operation::subtract: {
      const int a = magnitude(s.a);
      return binary(Operation::add, a, magnitude(s.b));
    }
    case Operation::multiply: {
      const int a = magnitude(s.a);
      return binary(Operation::multiply, a, magnitude(s.b));
    }
    case Operation::divide: {
      const int a = magnitude(s.a);
      return binary(Operation::divide, a, unary(Operation::abs, s.b));
    }
    default:
      return unary(Operation::abs, step);
  }
}

std::vector<char> Builder::neededFor(const std::vector<int>& results) const {
  std::vector<char> needed(steps_.size(), 0);
  for (const int r : results) needed[r] = 1;
  for (std::size_t n = steps_.size(); n-- > 0;) {
    const Step& s = steps_[n];
    if (!needed[n] || s.operation <= Operation::datum) continue;
    needed[s.a] = 1;
    if (isBinary(s.operation)) needed[s.b] = 1;
  }
  return needed;
}

std::vector<int> Builder::inputsOf(int step) const {
  const std::vector<char> needed = neededFor({step});
  std::vector<int> inputs;
  for (std::size_t n = 0; n < steps_.size(); ++n)
    if (needed[n] && steps_[n].operation == Operation::input) inputs.push_back(steps_[n].a);
  std::sort(inputs.begin(), inputs.end());
  return inputs;
}

Program Builder::program(const std::vector<int>& results) const {
  if (results.size() > Program::maxResults) throw std::logic_error("formula: too many results");
  const std::vector<char> needed = neededFor(results);
  Program program;
  std::vector<int> place(steps_.size(), 0);
  for (std::size_t n = 0; n < steps_.size(); ++n) {
    if (!needed[n]) continue;
    if (program.numSteps == Program::maxSteps) tooLong(Program::maxSteps);
    Step s = steps_[n];
    if (s.operation > Operation::datum) {
      s.a = place[s.a];
      if (isBinary(s.operation)) s.b = place[s.b];
    }
    place[n] = program.numSteps;
    program.steps[program.numSteps++] = s;
  }
  for (const int r : results) program.results[program.numResults++] = place[r];
  return program;
}

}  // namespace atrapos::formula
