#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "problems/Ends.hpp"
#include "problems/Record.hpp"

using namespace atrapos::path;

namespace {

TEST(Contact, AgreesWithTheTable) {
  std::ifstream file(ATRAPOS_TEST_DATA "/contact_regularized_1dof.csv");
  int compared = 0;
  for (std::string text; std::getline(file, text);) {
    for (char& c : text)
      if (c == ',') c = ' ';
    std::istringstream in(text);
    double alpha, eta, u, h, R, lambda;
    if (!(in >> alpha >> eta >> u >> h >> R >> lambda) || u == 0) continue;
    const Contact law{alpha, eta};
    Stops stops = loads({lambda});
    Followed<Contact> f(law, {0}, 0, Options{}, stops, 1.0);
    EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
    EXPECT_NEAR(f.final(0), u, 1.1e-6) << alpha << ' ' << eta;  // residual bound x scale / stiffness >= 1
    EXPECT_LE(f.worstInside(), 1.01e-6);
    ++compared;
  }
  EXPECT_GE(compared, 30);
}

int steps(double alpha, double eta, double internalWeight) {
  Stops stops = loads({3});
  Options options;
  options.pade = PadeUse::off;  // it passes the branch points in its own way
  Followed<Contact> f(Contact{alpha, eta}, {0}, 0, options, stops, internalWeight);
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  EXPECT_EQ(f.outcome.factorizations, f.outcome.steps + f.outcome.corrections);
  return f.outcome.steps;
}

/// The law's branch points next to h = 0 leave the disc of convergence when the parameter t of its hyperbola
/// takes part in the path parameter: a nearly hard law costs about as much as a soft one.
TEST(Contact, InternalVariableInTheInnerProductSavesSteps) {
  const int softWithout = steps(1e3, 0.1, 0), softWith = steps(1e3, 0.1, 1);
  const int hardWithout = steps(1e6, 1e-3, 0), hardWith = steps(1e6, 1e-3, 1);
  EXPECT_LT(softWith, softWithout);      // 4 and 6 here
  EXPECT_LT(2 * hardWith, hardWithout);  // 6 and 13 here
  const int harderWithout = steps(1e6, 1e-5, 0), harderWith = steps(1e6, 1e-5, 1);
  EXPECT_LT(2 * harderWith, harderWithout);  // 7 and 20 here
}

}  // namespace
