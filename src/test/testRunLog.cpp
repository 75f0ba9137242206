// What a run tells: times left where the path goes steadily to a stop, and nothing where they would be
// guesses.
#include <gtest/gtest.h>

#include <functional>
#include <sstream>

#include "output/RunLog.hpp"

namespace atrapos {
namespace {

/// What is told along a path whose step n, of 5 s, ends at these values.
std::string toldAlong(const deck::Path& settings, int steps, const std::function<double(int)>& load,
                      const std::function<double(int)>& tip) {
  std::ostringstream out;
  RunLog log(&out, settings, {"tip"});
  log.head();
  for (int n = 1; n <= steps; ++n) {
    path::StepReport report;
    report.step = n;
    report.lambdaEnd = load(n);
    report.pathLengthEnd = n;
    log.step(report, {0, 0, 5.0 * n, {tip(n)}}, {});
  }
  return out.str();
}

double rising(int n) { return 0.01 * n; }

TEST(RunLog, TimeLeftAtTheRateOfTheLastSteps) {
  deck::Path settings;
  settings.stop.pathLength = 30;
  // 24 steps of 5 s are left when six have been seen.
  EXPECT_NE(toldAlong(settings, 6, rising, rising)
                .find("about 2 min to path length 30 at the rate of the last 5 steps"),
            std::string::npos);
  settings.stop.loadFactors = {-1, 0.1};  // 4 steps left; the other one lies behind
  EXPECT_NE(toldAlong(settings, 6, rising, rising).find("about 20 s to load factor 0.1 "), std::string::npos);
  settings.stop.monitors["tip"] = {0.09};
  EXPECT_NE(toldAlong(settings, 6, rising, rising).find("about 15 s to tip 0.09 "), std::string::npos);
}

TEST(RunLog, NoTimeLeftWhereItIsNotKnown) {
  deck::Path settings;
  settings.stop.limitPoint = 1;
  EXPECT_EQ(toldAlong(settings, 20, rising, rising).find("about"), std::string::npos);
  settings.stop.loadFactors = {1};
  EXPECT_NE(toldAlong(settings, 20, rising, rising).find("about"), std::string::npos);
  // A load that falls, and one that goes up and down.
  EXPECT_EQ(toldAlong(
                settings, 20, [](int n) { return -0.1 * n; }, rising)
                .find("about"),
            std::string::npos);
  EXPECT_EQ(toldAlong(
                settings, 20, [](int n) { return n % 3; }, rising)
                .find("about"),
            std::string::npos);
}

TEST(RunLog, PointsInWords) {
  PointRow limit{3, 0, 1.5, 0.25, "maximum"};
  limit.monitors = {-2, 1, 4, 5};
  const std::vector<std::string> names{"a", "b", "c", "d"};
  EXPECT_EQ(describe(limit, names), "limit point (maximum) at load factor 0.25: a = -2, b = 1, c = 4");
  limit.kind = "maximum:a";
  EXPECT_EQ(describe(limit, names), "");  // of a monitor: points.csv has it
  PointRow pair{3, 0, 1.5, 0.25, "multiple", 2, 2};
  EXPECT_EQ(describe(pair, {}), "bifurcation point (multiple) at load factor 0.25, 2 null vectors");
}

TEST(RunLog, SearchesAreToldWhereTheyTakeLong) {
  std::ostringstream out;
  const deck::Path settings;
  RunLog log(&out, settings, {});
  log.search(0, 2, 1);
  EXPECT_EQ(out.str(), "");
  log.search(1, 2, 6);
  EXPECT_NE(
      out.str().find("locating bifurcation points: 2 eigenvalue(s) changed sign, the places of 1 are found"),
      std::string::npos)
      << out.str();
  RunLog silent(nullptr, settings, {});
  silent.head();
  silent.search(0, 1, 100);
}

}  // namespace
}  // namespace atrapos
