// Paths that are closed curves end when they have been followed once.
#include <gtest/gtest.h>

#include <cmath>

#include "problems/Record.hpp"

using namespace atrapos::path;

namespace {

/// x^2 + (lambda - 2)^2 = 1, and y that follows x and lambda: a circle over (lambda, x).
struct Circle {
  int size() const { return 2; }
  double scale() const { return 1; }
  bool symmetric() const { return false; }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    const S from = lambda - 2;
    return {u[0] * u[0] + from * from - 1, u[1] - u[0] * lambda};
  }
  template <class S>
  std::vector<S> internal(const std::vector<S>&, const S&) const {
    return {};
  }
};

}  // namespace

TEST(Closed, ACircleIsFollowedOnce) {
  for (const int direction : {1, -1}) {
    Options options;
    options.direction = direction;
    Followed<Circle> f(Circle{}, {1, 2}, 2, options, Stops{});
    EXPECT_EQ(f.outcome.reason, EndReason::pathClosed) << f.outcome.text;
    EXPECT_NE(f.outcome.text.find("with which step 1 began"), std::string::npos) << f.outcome.text;
    ASSERT_GE(f.record.steps.size(), 3u);
    // Once around and no step more: the angle that the steps go through.
    double angle = 0, last = 0;
    for (std::size_t s = 0; s < f.record.steps.size(); ++s) {
      const State end = f.record.steps[s].end;
      double turn = std::atan2(end.lambda - 2, end.u->getData()[0]) * direction - last;
      if (turn < 0) turn += 2 * M_PI;
      angle += turn;
      last = std::atan2(end.lambda - 2, end.u->getData()[0]) * direction;
      if (s + 1 < f.record.steps.size()) {
        EXPECT_LT(angle, 2 * M_PI);
      }
    }
    EXPECT_GE(angle, 2 * M_PI * (1 - 1e-4));
  }
}

// A stop on the second half still is one.
TEST(Closed, StopsComeFirst) {
  Stops stops;
  stops.pathLength = 4;
  Followed<Circle> f(Circle{}, {1, 2}, 2, Options{}, stops);
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
}

TEST(Trail, SharesWhatItHasInCommonAndMayBeLong) {
  const auto numbers = [](const Trail& trail) {
    std::vector<int> steps;
    for (const Landmark& mark : trail.all()) steps.push_back(mark.step);
    return steps;
  };
  const auto mark = [](int step) {
    Landmark m;
    m.step = step;
    return m;
  };
  Trail first;
  EXPECT_TRUE(first.empty());
  first.add(mark(1));
  first.add(mark(2));
  const Landmark* shared = &first.last();
  Trail second = first;
  EXPECT_EQ(&second.last(), shared);
  first.add(mark(3));
  second.add(mark(4));
  EXPECT_EQ(numbers(first), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(numbers(second), (std::vector<int>{1, 2, 4}));
  // As deep as that no stack is.
  for (int step = 5; step < 1000000; ++step) second.add(mark(step));
  Trail third = second;
  second = {};
  EXPECT_EQ(third.last().step, 999999);
  third = {};
  EXPECT_EQ(numbers(first), (std::vector<int>{1, 2, 3}));
}
