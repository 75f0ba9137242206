#pragma once

#include <cmath>
#include <cstddef>
#include <new>

#include "atrapos/taylor/FadFunctions.hpp"
#include "atrapos/taylor/Law.hpp"

/// Formulas that are read when a program runs, as laws use them: lists of operations on whatever scalar a law
/// sees (double, Fad, Taylor coefficients).
namespace atrapos::formula {

enum class Operation : int {
  number,  ///< Step::number
  input,   ///< in[a]
  datum,   ///< data[a], passive
  add,
  subtract,
  multiply,
  divide,
  negate,
  abs,
  power,    ///< a to the constant Step::number
  powerOf,  ///< a to the power b
  exp,
  log,
  log10,
  sqrt,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  sinh,
  cosh,
  tanh,
  erf
};

/// One operation; a and b are earlier steps.
struct Step {
  Operation operation = Operation::number;
  int a = 0, b = 0;
  double number = 0;
};

/// Formulas that share their common parts: steps, one after the other, and which of them are the results.
/// A value: laws have it as a member.
struct Program {
  static constexpr int maxSteps = 96, maxResults = 8;
  Step steps[maxSteps];
  int numSteps = 0;
  int results[maxResults] = {};  ///< numbers of steps
  int numResults = 0;
};

namespace detail {

/// The values of a program's steps: none is made before its turn, for a coefficient of a series is large.
template <class T>
class Values {
 public:
  ATRAPOS_FORCEINLINE const T& operator[](int step) const {
    return *reinterpret_cast<const T*>(memory_ + step * sizeof(T));
  }
  template <class E>
  ATRAPOS_FORCEINLINE void set(int step, const E& value) {
    new (memory_ + step * sizeof(T)) T(value);
  }

 private:
  alignas(T) unsigned char memory_[Program::maxSteps * sizeof(T)];
};

/// One step. Not for inlining: it is the same for all laws with formulas.
template <class T>
ATRAPOS_NOINLINE KOKKOS_FUNCTION void execute(const Program& program, const T* in,
                                              const taylor::Passive<T>* data, Values<T>& v) {
  using std::acos, std::asin, std::atan, std::cos, std::cosh, std::erf, std::exp, std::fabs, std::log,
      std::log10, std::pow, std::sin, std::sinh, std::sqrt, std::tan, std::tanh;
  using taylor::erf;
  for (int n = 0; n < program.numSteps; ++n) {
    const Step& s = program.steps[n];
    switch (s.operation) {
      case Operation::number:
        v.set(n, s.number);
        break;
      case Operation::input:
        v.set(n, in[s.a]);
        break;
      case Operation::datum:
        v.set(n, data[s.a]);
        break;
      case Operation::add:
        v.set(n, T(v[s.a] + v[s.b]));
        break;
      case Operation::subtract:
        v.set(n, T(v[s.a] - v[s.b]));
        break;
      case Operation::multiply:
        v.set(n, T(v[s.a] * v[s.b]));
        break;
      case Operation::divide:
        v.set(n, T(v[s.a] / v[s.b]));
        break;
      case Operation::negate:
        v.set(n, T(-v[s.a]));
        break;
      case Operation::abs:
        v.set(n, T(fabs(v[s.a])));
        break;
      case Operation::power:
        v.set(n, T(pow(v[s.a], s.number)));
        break;
      case Operation::powerOf:
        v.set(n, T(pow(v[s.a], v[s.b])));
        break;
      case Operation::exp:
        v.set(n, T(exp(v[s.a])));
        break;
      case Operation::log:
        v.set(n, T(log(v[s.a])));
        break;
      case Operation::log10:
        v.set(n, T(log10(v[s.a])));
        break;
      case Operation::sqrt:
        v.set(n, T(sqrt(v[s.a])));
        break;
      case Operation::sin:
        v.set(n, T(sin(v[s.a])));
        break;
      case Operation::cos:
        v.set(n, T(cos(v[s.a])));
        break;
      case Operation::tan:
        v.set(n, T(tan(v[s.a])));
        break;
      case Operation::asin:
        v.set(n, T(asin(v[s.a])));
        break;
      case Operation::acos:
        v.set(n, T(acos(v[s.a])));
        break;
      case Operation::atan:
        v.set(n, T(atan(v[s.a])));
        break;
      case Operation::sinh:
        v.set(n, T(sinh(v[s.a])));
        break;
      case Operation::cosh:
        v.set(n, T(cosh(v[s.a])));
        break;
      case Operation::tanh:
        v.set(n, T(tanh(v[s.a])));
        break;
      case Operation::erf:
        v.set(n, T(erf(v[s.a])));
        break;
    }
  }
}

}  // namespace detail

/// results[0 .. numResults) of a program. in, data: as many as the program's builder was told of. T: double,
/// a Fad type or a taylor::Sweep.
template <class T>
ATRAPOS_FORCEINLINE void evaluate(const Program& program, const T* in, const taylor::Passive<T>* data,
                                  T* results) {
  detail::Values<T> values;
  detail::execute(program, in, data, values);
  for (int r = 0; r < program.numResults; ++r) results[r] = values[program.results[r]];
}

}  // namespace atrapos::formula
