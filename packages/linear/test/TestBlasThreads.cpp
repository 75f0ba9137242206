#include <gtest/gtest.h>

#include "atrapos/linear/BlasThreads.hpp"
#include "atrapos/linear/Error.hpp"

namespace atrapos::linear::test {
namespace {

TEST(BlasThreads, SetAndGetAgree) {
  EXPECT_THROW(setBlasThreads(0), SolverError);
  const int before = blasThreads();
  EXPECT_EQ(before == 0, blasName().empty());
  if (before == 0) {
    EXPECT_FALSE(setBlasThreads(1));
    GTEST_SKIP() << "the BLAS at hand has no thread control";
  }
  // A BLAS may cap the number at its compiled maximum, which is far above 2.
  for (int n : {2, 1}) {
    EXPECT_TRUE(setBlasThreads(n));
    EXPECT_EQ(blasThreads(), n);
  }
  setBlasThreads(before);
}

}  // namespace
}  // namespace atrapos::linear::test
