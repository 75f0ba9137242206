#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/Table.hpp"

namespace atrapos::test {

/// Largest difference in parts of the largest value.
inline double difference(const std::vector<double>& x, const std::vector<double>& y) {
  double worst = 0, scale = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double off = std::abs(x[i] - y.at(i));
    if (!std::isfinite(off)) return off;
    worst = std::max(worst, off);
    scale = std::max(scale, std::abs(x[i]));
  }
  return worst > 0 ? worst / scale : 0;
}

/// All columns of the first table but the residual, which is rounding itself; the second one may have more.
inline void expectSameTable(const Table& a, const Table& b, double tolerance) {
  ASSERT_EQ(a.numRows(), b.numRows());
  for (const std::string& name : a.names())
    if (name != "residual") {
      EXPECT_LE(difference(a.column(name), b.column(name)), tolerance) << name;
    }
}

}  // namespace atrapos::test
