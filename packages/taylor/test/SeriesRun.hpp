#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "LongSeries.hpp"
#include "atrapos/taylor/Law.hpp"

constexpr int L = 8;
using Values = atrapos::taylor::Lanes<L>;
using Coefficients = std::vector<std::vector<Values>>;  ///< [input or output][order]

enum class Mode { Direct, ZeroThenComplete, CompleteInThree };

struct SeriesResult {
  Coefficients out;
  std::vector<double> history;
  int slots = 0;
};

/// All orders of a law: with the true coefficients at once, or as a solver does it (zeros, then increments).
template <class Law>
SeriesResult runSeries(const Law& law, const Coefficients& in, Mode mode, const Values* data = nullptr) {
  using namespace atrapos::taylor;
  const int maxOrder = static_cast<int>(in[0].size()) - 1;
  SeriesResult r;
  r.slots = historySlots<L>(law);
  // NaN everywhere: a coefficient read before it is written cannot go unnoticed.
  r.history.assign(historyDoubles<L>(r.slots, maxOrder), std::nan(""));
  r.out.assign(Law::numOutputs, std::vector<Values>(maxOrder + 1, Values(0.0)));
  Context<L> context{r.history.data(), maxOrder, 0, Pass::Start, 0};
  Values x[Law::numInputs], y[Law::numOutputs];
  const auto execute = [&](int k, Pass pass, double share) {
    context.order = k;
    context.pass = pass;
    for (int j = 0; j < Law::numInputs; ++j) x[j] = share * in[j][k];
    sweep<L>(law, context, x, data, y);
    EXPECT_EQ(context.cursor, r.slots);
    for (int i = 0; i < Law::numOutputs; ++i) r.out[i][k] += y[i];
  };
  for (int k = 0; k <= maxOrder; ++k) {
    if (k == 0)
      execute(k, Pass::Start, 1);
    else if (mode == Mode::Direct)
      execute(k, Pass::Sweep, 1);
    else {
      execute(k, Pass::Sweep, 0);
      const int parts = mode == Mode::CompleteInThree ? 3 : 1;
      for (int i = 0; i < parts; ++i) execute(k, Pass::Complete, 1.0 / parts);
    }
  }
  return r;
}

constexpr double decay = 0.5;

/// Input series, different in every lane: order 0 in [first, last], then coefficients of size decay^k.
inline std::vector<Values> testSeries(int maxOrder, double first, double last, int seed) {
  std::vector<Values> a(maxOrder + 1);
  for (int l = 0; l < L; ++l) {
    a[0][l] = first + (last - first) * l / (L - 1);
    for (int k = 1; k <= maxOrder; ++k)
      a[k][l] = 0.3 * (last - first) * std::pow(decay, k) * std::cos(1.0 + 1.7 * k * seed + 0.9 * l);
  }
  return a;
}

inline LongSeries lane(const std::vector<Values>& a, int l) {
  std::vector<long double> c;
  for (const auto& x : a) c.push_back(x[l]);
  return LongSeries(c);
}

/// What rounding errors of the coefficients up to k amount to in coefficient k, per unit of relative error:
/// the recurrences carry errors of lower orders along, as the series' own growth (at least decay^k) does.
inline double roundingScale(const std::function<long double(int)>& c, int k) {
  double scale = 0, size = 1;
  for (int j = k; j >= 0; --j, size *= decay)
    scale = std::max(scale, static_cast<double>(std::fabs(c(j))) * size);
  return scale;
}

/// Compares all orders and lanes of one output with an expected series.
template <class Expected>
void expectSeries(const std::vector<Values>& actual, Expected expected, double tolerance,
                  const std::string& what) {
  for (int l = 0; l < L; ++l) {
    const auto coefficient = expected(l);
    for (int k = 0; k < static_cast<int>(actual.size()); ++k) {
      const double error = std::fabs(static_cast<double>(actual[k][l] - coefficient(k)));
      ASSERT_LE(error, tolerance * roundingScale(coefficient, k))
          << what << ", order " << k << ", lane " << l << ": " << actual[k][l] << " instead of "
          << static_cast<double>(coefficient(k));
    }
  }
}

/// Columns of numbers of a reference file, by rows; lines that do not start with a number are left out.
inline std::vector<std::vector<double>> readColumns(const std::string& name) {
  std::ifstream file(std::string(ATRAPOS_TAYLOR_TEST_DATA) + "/" + name);
  EXPECT_TRUE(file.good()) << name;
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.find_first_of("0123456789-") != 0) continue;
    std::stringstream stream(line);
    rows.emplace_back();
    for (std::string cell; std::getline(stream, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  EXPECT_GT(rows.size(), 5u) << name;
  return rows;
}
