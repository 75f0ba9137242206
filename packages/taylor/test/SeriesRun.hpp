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

constexpr int L = atrapos::taylor::nativeLanes;
using Values = atrapos::taylor::Lanes<L>;
using Coefficients = std::vector<std::vector<Values>>;  ///< [input or output][order]

enum class Mode { Direct, AsASolver };

struct SeriesResult {
  Coefficients out;
  std::vector<double> memory;
  atrapos::taylor::HistoryShape shape;
  atrapos::taylor::Failures<L> failures;
};

/// All orders of a law: with the true coefficients at once, or as a solver does it, who knows an order's
/// inputs only after its sweep.
template <class Law>
SeriesResult runSeries(const Law& law, const Coefficients& in, Mode mode, const Values* data = nullptr) {
  using namespace atrapos::taylor;
  const int maxOrder = static_cast<int>(in[0].size()) - 1;
  SeriesResult r;
  r.shape = historyShape(law);
  // NaN everywhere: a coefficient read before it is written cannot go unnoticed.
  r.memory.assign(r.shape.doubles<L>(maxOrder), std::nan(""));
  Context<L> context;
  context.shape = r.shape;
  context.memory = r.memory.data();
  context.failures = &r.failures;
  context.waiting = HistoryShape::waiting(maxOrder);
  r.out.assign(Law::numOutputs, std::vector<Values>(maxOrder + 1, Values(0.0)));
  Values x[Law::numInputs], y[Law::numOutputs];
  HistoryShape taken;
  const auto add = [&](int k) {
    for (int i = 0; i < Law::numOutputs; ++i) r.out[i][k] += y[i];
    if (k == 0) taken = context.taken;
    EXPECT_EQ(context.taken.slots, taken.slots);
    EXPECT_EQ(context.taken.constants, taken.constants);
  };
  for (int k = 0; k <= maxOrder; ++k) {
    context.order = k;
    for (int j = 0; j < Law::numInputs; ++j) x[j] = in[j][k];
    if (k == 0) {
      start(law, context, x, data, y);
    } else if (mode == Mode::Direct) {
      sweepKnown(law, context, x, data, y);
    } else {
      context.block = orderBlock(k, maxOrder);
      sweep(law, context, data, y);
      add(k);
      complete(law, context, x, data, y);
    }
    add(k);
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
