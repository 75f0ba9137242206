// `bench_scaling` on its smallest sizes: every part is counted, memory is as foreseen, the parts are all of
// it.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "CsvRows.hpp"

namespace {

TEST(BenchScaling, WritesTheTable) {
  const std::string csv = testing::TempDir() + "bench_scaling_test.csv";
  std::remove(csv.c_str());
  const std::string command = std::string(ATRAPOS_BENCH_SCALING) +
                              " --sizes 1000 3000 --threads 1 --steps 1 --repeats 2 --csv " + csv +
                              " > /dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const auto rows = atrapos::bench::csvRows(csv);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].at("ranks"), "1");
  for (auto row : rows) {
    const auto number = [&](const char* name) { return std::stod(row.at(name)); };
    SCOPED_TRACE(row.at("family") + " " + row.at("asked"));
    ASSERT_EQ(row.at("end"), "done");
    // Whole elements, and more nodes an element in small meshes.
    EXPECT_GT(number("unknowns"), 0.5 * number("asked"));
    EXPECT_LT(number("unknowns"), 2 * number("asked"));
    EXPECT_EQ(number("steps"), 1);
    double parts = 0;
    for (const char* part :
         {"tangent_s", "analysis_s", "factor_s", "solve_s", "order_s", "residual_s", "output_s"}) {
      EXPECT_GT(number(part), 0) << part;
      parts += number(part);
    }
    EXPECT_GT(number("contact_s"), 0);
    EXPECT_LE(parts, 1.01 * number("total_s"));  // four digits are printed
    EXPECT_GT(number("contact_points"), 0);
    EXPECT_GE(number("orders"), 20);
    EXPECT_GT(number("factor_bytes"), 8 * 0.9 * number("factor_entries"));
    // The program itself is most of it at these sizes.
    EXPECT_GT(number("foreseen_bytes"), 0.5 * number("peak_bytes"));
    EXPECT_LT(number("foreseen_bytes"), 1.5 * number("peak_bytes"));
  }
}

/// The same work on two ranks: what is counted agrees, and a rank needs less memory.
TEST(BenchScaling, RanksShareOneRun) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one processor: two ranks are left out";
  const std::string csv = testing::TempDir() + "bench_scaling_ranks_test.csv";
  std::remove(csv.c_str());
  // Open MPI's mpirun refuses the superuser otherwise; who waits makes room for other tests.
  const std::string command =
      "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1 " +
      std::string(ATRAPOS_BENCH_SCALING) +
      " --families shell --sizes 15000 --ranks 1 2 --threads 1 --steps 1 --repeats 1 --csv " + csv +
      " > /dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const auto rows = atrapos::bench::csvRows(csv);
  ASSERT_EQ(rows.size(), 2u);
  for (const auto& row : rows) ASSERT_EQ(row.at("end"), "done");
  auto one = rows[0], two = rows[1];
  EXPECT_EQ(two.at("ranks"), "2");
  for (const char* count : {"unknowns", "elements", "contact_points", "steps", "factorizations", "orders"})
    EXPECT_EQ(one.at(count), two.at(count)) << count;
  for (const char* part : {"tangent_s", "factor_s", "solve_s", "order_s", "contact_s", "residual_s"})
    EXPECT_GT(std::stod(two.at(part)), 0) << part;
  // Histories are shared out, but for the filling of last batches of eight elements; the program (some 70 MB
  // of 200) is there twice, and what else a rank has is half, and a little that every rank has.
  EXPECT_LT(std::stod(two.at("history_bytes")), 1.5 * std::stod(one.at("history_bytes")));
  EXPECT_GT(std::stod(two.at("peak_bytes")), 1.1 * std::stod(one.at("peak_bytes")));
  EXPECT_LT(std::stod(two.at("rank_peak_bytes")), 0.8 * std::stod(one.at("rank_peak_bytes")));
}

}  // namespace
