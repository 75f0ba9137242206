#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "Jobs.hpp"

namespace atrapos::bench {
namespace {

std::vector<std::vector<std::string>> readCsv(const std::string& file) {
  std::vector<std::vector<std::string>> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    lines.push_back(fields);
  }
  return lines;
}

/// Whether peers do not run a law.
bool isAlone(const std::string& law) {
  return law.rfind("rubber", 0) == 0 || law.find("bratu") != std::string::npos;
}

/// `bench_taylor --quick --csv FILE`: every law and method once, all numbers positive, ratios consistent.
TEST(BenchTable, QuickRunWritesTheWholeTable) {
  const std::string csv = testing::TempDir() + "bench_taylor_quick.csv";
  std::remove(csv.c_str());
  ASSERT_EQ(
      std::system((std::string(ATRAPOS_BENCH_TAYLOR) + " --quick --csv " + csv + " > /dev/null").c_str()), 0);
  const auto lines = readCsv(csv);
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0], (std::vector<std::string>{"law", "order", "points", "method", "us_per_point", "gflops",
                                                "gbytes_per_s", "speedup_vs_sacado"}));
  std::set<std::pair<std::string, std::string>> seen;
  double sacado = 0;
  for (std::size_t n = 1; n < lines.size(); ++n) {
    const auto& f = lines[n];
    ASSERT_EQ(f.size(), 8u) << "line " << n;
    EXPECT_TRUE(seen.insert({f[0], f[3]}).second) << f[0] << " " << f[3] << " twice";
    EXPECT_EQ(f[1], "10");
    const bool alone = isAlone(f[0]);
    for (int i : {2, 4, 5, 6, alone ? 6 : 7}) {
      const double value = std::stod(f[i]);
      EXPECT_TRUE(std::isfinite(value) && value > 0)
          << f[0] << " " << f[3] << ": " << lines[0][i] << " " << f[i];
    }
    const double us = std::stod(f[4]);
    if (f[3] == "sacado") sacado = us;
    EXPECT_NEAR(std::stod(f[7]) * us / sacado, alone ? 0 : 1, 2e-5);  // three numbers of six digits
  }
  for (const std::string& law : lawNames())
    for (const std::string& method : methodNames()) {
      const bool contact = law.rfind("contact", 0) == 0;
      if (method == "atrapos_closed" && !contact) continue;
      if (method.rfind("hand", 0) == 0 && law != "saint_venant_kirchhoff") continue;
      if (isAlone(law) && method != "atrapos") continue;
      EXPECT_TRUE(seen.count({law, method})) << law << " " << method;
    }
}

/// What is asked for and does not fit is named; a word that is not understood is an error.
TEST(BenchTable, RefusesWhatItDoesNotKnow) {
  const std::string command = ATRAPOS_BENCH_TAYLOR;
  EXPECT_NE(std::system((command + " --laws rubber > /dev/null 2>&1").c_str()), 0);
  EXPECT_NE(std::system((command + " --orders 0 > /dev/null 2>&1").c_str()), 0);
  EXPECT_NE(std::system((command + " --quick --csv /no/such/folder/t.csv > /dev/null 2>&1").c_str()), 0);
}

}  // namespace
}  // namespace atrapos::bench
