// Residual, tangent and order-k right-hand sides must have the same bits for any number of threads. The
// number of threads is fixed when a process starts, so the test runs this executable again with one and with
// two.
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

#include "support/Model.hpp"
#include "support/Vectors.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

constexpr const char* kFileVariable = "ATRAPOS_TEST_THREADS_FILE";

/// All that the element loops compute; nothing here comes from a solver, whose BLAS has threads of its own.
Numbers everything() {
  Numbers all;
  const auto append = [&](const Numbers& x) { all.insert(all.end(), x.begin(), x.end()); };
  for (Topology cell : {Topology::Hex8, Topology::Hex20, Topology::Tet10}) {
    const Mesh mesh = distorted(box(cell, {8, 5, 4}), 0.01);  // some twenty batches and more
    const int numDofs = 3 * mesh.numNodes();
    FeProblem problem(busyModel(mesh));
    const Numbers u = randomNumbers(numDofs, 0.01, 1);
    const Tangent K = tangent(problem, u, 0.3);
    append(K.value);
    append(K.F);
    const Residual r = residual(problem, u, 0.3);
    append(r.r);
    append({r.norm.norm, r.norm.scale});
    append(problem.reactions({vectorOf(problem, u), 0.3}));
    problem.beginSeries({vectorOf(problem, u), 0.3}, 5);
    auto F = zeroVector(problem);
    for (int k = 1; k <= 5; ++k) {
      problem.orderRhs(k, *F);
      append(FeProblem::values(*F));
      problem.completeOrder(k, *vectorOf(problem, randomNumbers(numDofs, 0.1, 10 + k)), 0.1);
    }
  }
  return all;
}

/// Runs this executable's Threads.Write with so many threads; returns what it wrote: concurrency, numbers.
std::string runWith(int threads) {
  const std::string file =
      testing::TempDir() + "atrapos_threads_" + std::to_string(getpid()) + "_" + std::to_string(threads);
  // A child that inherits what MPI set up for its parent would take itself for a part of the parent's job.
  std::vector<std::string> environment;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const bool allow = text.rfind("OMPI_ALLOW_RUN_AS_ROOT", 0) == 0;
    bool drop = false;
    for (const char* prefix : {"OMPI_", "PMIX_", "PMI_", "ORTE_", "OMP_NUM_THREADS=", "GTEST_"})
      drop = drop || text.rfind(prefix, 0) == 0;
    if (allow || !drop) environment.push_back(text);
  }
  environment.push_back("OMP_NUM_THREADS=" + std::to_string(threads));
  environment.push_back(std::string(kFileVariable) + "=" + file);
  std::vector<char*> envp, argv;
  for (auto& text : environment) envp.push_back(text.data());
  envp.push_back(nullptr);
  std::string program = "/proc/self/exe", filter = "--gtest_filter=Threads.Write";
  char resolved[4096] = {};
  if (readlink(program.c_str(), resolved, sizeof(resolved) - 1) > 0) program = resolved;
  argv = {program.data(), filter.data(), nullptr};
  pid_t child = 0;
  EXPECT_EQ(posix_spawn(&child, program.c_str(), nullptr, nullptr, argv.data(), envp.data()), 0);
  int status = -1;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0) << "the run with " << threads << " threads failed";
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  std::remove(file.c_str());
  return bytes;
}

}  // namespace

TEST(Threads, Write) {
  const char* file = std::getenv(kFileVariable);
  if (file == nullptr) GTEST_SKIP() << "run by Threads.SameBitsForOneAndTwo";
  std::ofstream out(file, std::ios::binary);
  const Numbers all = everything();
  const int threads = Execution().concurrency();
  out.write(reinterpret_cast<const char*>(&threads), sizeof(threads));
  out.write(reinterpret_cast<const char*>(all.data()),
            static_cast<std::streamsize>(all.size() * sizeof(double)));
  ASSERT_TRUE(out.good());
}

TEST(Threads, SameBitsForOneAndTwo) {
  if (std::string(Execution::name()) == "Serial")
    GTEST_SKIP() << "this Kokkos has no threads: build with the openmp preset";
  const std::string one = runWith(1), two = runWith(2);
  int threads[2] = {0, 0};
  ASSERT_GT(one.size(), sizeof(int) + 100000 * sizeof(double));
  std::memcpy(&threads[0], one.data(), sizeof(int));
  std::memcpy(&threads[1], two.data(), sizeof(int));
  EXPECT_EQ(threads[0], 1);
  EXPECT_EQ(threads[1], 2);
  EXPECT_TRUE(one.substr(sizeof(int)) == two.substr(sizeof(int)));
}
