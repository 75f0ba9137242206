// The same deck gives the same path: run twice, on more threads, in another build, on another machine.
#include <gtest/gtest.h>

#include <cmath>

#include "support/StripRun.hpp"

namespace atrapos::test {
namespace {

/// Largest difference in a column over the first `rows` rows, in parts of the largest value.
double difference(const Table& a, const Table& b, const std::string& name, std::size_t rows) {
  const auto x = a.column(name), y = b.column(name);
  double worst = 0, scale = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    const double off = std::abs(x.at(i) - y.at(i));
    if (!std::isfinite(off)) return off;
    worst = std::max(worst, off);
    scale = std::max(scale, std::abs(x[i]));
  }
  return worst > 0 ? worst / scale : 0;  // columns of zeros have no scale
}

/// All columns of the first table but the residual, which is rounding and truncation error itself; the second
/// one may have more.
void expectSame(const Table& a, const Table& b, std::size_t rows, double tolerance) {
  for (const std::string& name : a.names()) {
    if (name != "residual") {
      EXPECT_LE(difference(a, b, name, rows), tolerance) << name;
    }
  }
}

TEST(Reproducible, SecondRunOnMoreThreadsGivesTheSamePath) {
  const Edits shorter{{"{load_factor: 0.25}", "{load_factor: 0.25, steps: 30}"}};
  const StripRun one("solid.yaml", shorter, {"-t", "1"});
  ASSERT_EQ(one.summary.at("threads"), 1);
  const bool serial = one.summary.at("execution_space") == "Serial";
  const StripRun two("solid.yaml", shorter, {"-t", serial ? "1" : "2"});
  if (serial) {
    EXPECT_EQ(readFile(one.folder.results("path.csv")), readFile(two.folder.results("path.csv")));
    return;
  }
  ASSERT_EQ(two.summary.at("threads"), 2);
  ASSERT_EQ(one.path->numRows(), two.path->numRows());
  // The same to the bit as long as the forces of all elements are added up in one order. 1e-10 is what is
  // promised.
  expectSame(*one.path, *two.path, static_cast<std::size_t>(one.path->numRows()), 1e-10);
}

/// A well-conditioned body: whatever rounds differently (compiler, instruction set, BLAS, flavour of Kokkos)
/// must not show. With and without fused multiply-add the whole path with contact differs by 5e-14.
TEST(Reproducible, BlockFollowsTheStoredPath) {
  TemporaryFolder folder;
  writeFile(folder / "block.yaml", readFile(ATRAPOS_ACCEPT_DATA "/block.yaml"));
  ASSERT_EQ(runAtrapos({"mesh", "-q", "block.yaml"}, folder.path()).exitCode, 0);
  const CommandResult r = runAtrapos({"run", "-q", "block.yaml"}, folder.path());
  ASSERT_EQ(r.exitCode, 0) << r.err;
  const Table stored(ATRAPOS_ACCEPT_DATA "/block_path.csv"), path(folder / "block_results" / "path.csv");
  ASSERT_EQ(path.numRows(), stored.numRows()) << "other steps: see data/README.md";
  expectSame(stored, path, static_cast<std::size_t>(stored.numRows()), 1e-10);
}

/// The thin strip: 400 x 0.8 mm of solid cells make a tangent with a condition number of about 1e10, so that
/// the very first solution differs by 5e-6 where rounding differs (fused multiply-add, BLAS kernel, MUMPS or
/// KLU). Later steps do not add to that. Step lengths are rounded, but sooner or later (step 15 without fused
/// multiply-add) one falls on the other side; rows are compared as far as the steps agree. With polynomials:
/// the length of a fraction's step takes part in what rounding leaves of the highest orders.
TEST(Reproducible, StripFollowsTheStoredPath) {
  const StripRun run("solid.yaml",
                     {{"stop: {load_factor: 0.25}", "pade: off\n  stop: {load_factor: 0.25, steps: 15}"}});
  const Table stored(ATRAPOS_ACCEPT_DATA "/strip_path.csv");
  ASSERT_EQ(stored.numRows(), 76);
  ASSERT_EQ(run.path->numRows(), 76);
  const auto a = stored.column("path_length"), b = run.path->column("path_length");
  std::size_t rows = 1;
  while (rows < a.size() && std::abs(a[rows] - b[rows]) <= 1e-10 * a[rows]) ++rows;
  RecordProperty("steps_that_agree", static_cast<int>((rows - 1) / 5));
  // At least past the touch, in step 5.
  ASSERT_GE(rows, 1u + 5 * 6) << "the steps differ from the stored ones from row " << rows << " on";
  // Four times the 5e-6 of the worst machine seen.
  expectSame(stored, *run.path, rows, 2e-5);
}

}  // namespace
}  // namespace atrapos::test
