// Paths with iterative solves are those with a factorization; the solver is picked by memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/Table.hpp"

namespace atrapos::test {
namespace {

/// The block of data/block.yaml in a folder with its mesh.
struct Block {
  TemporaryFolder folder;

  Block() {
    write("");
    const CommandResult r = runAtrapos({"mesh", "-q", "deck.yaml"}, folder.path());
    if (r.exitCode != 0) throw std::runtime_error(r.err);
  }
  void write(const std::string& solver) const {
    writeFile(folder / "deck.yaml", readFile(ATRAPOS_ACCEPT_DATA "/block.yaml") + solver);
  }
  /// The run of the deck with `solver` added, on some ranks.
  Table path(const std::string& solver, const std::string& name, int ranks = 1) {
    write(solver);
    const std::vector<std::string> words{"run", "deck.yaml", "-o", name};
    const CommandResult r =
        ranks == 1 ? runAtrapos(words, folder.path()) : runAtraposOnRanks(ranks, words, folder.path());
    if (r.exitCode != 0) throw std::runtime_error(r.err + r.out);
    printed = r.out;
    return Table((folder.path() / name / "path.csv").string());
  }
  nlohmann::json summary(const std::string& name) const {
    return nlohmann::json::parse(readFile(folder.path() / name / "summary.json"));
  }
  std::string printed;
};

void expectSame(const Table& a, const Table& b) {
  ASSERT_EQ(a.numRows(), b.numRows());
  for (const std::string& name : a.names()) {
    if (name == "residual" || name == "negative_eigenvalues") continue;
    const auto x = a.column(name), y = b.column(name);
    double size = 0, off = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      size = std::max(size, std::abs(x[i]));
      off = std::max(off, std::abs(x[i] - y[i]));
    }
    // The deck's bound of the residual is 1e-8, that of the solves a thousandth of it; the tangent's
    // condition is below 1e4.
    EXPECT_LE(off, 1e-7 * size) << name;
  }
}

TEST(KrylovPath, IsThePathOfTheFactorization) {
  Block block;
  const Table direct = block.path("", "direct");
  for (const char* preconditioner : {"single_factor", "ilu"})
    for (const int ranks : {1, 2}) {
      const std::string name = preconditioner + std::to_string(ranks);
      const Table path = block.path(
          std::string("\nsolver: {type: belos, preconditioner: ") + preconditioner + "}\n", name, ranks);
      expectSame(direct, path);
      EXPECT_NE(block.printed.find("negative eigenvalues are not counted"), std::string::npos)
          << block.printed;
      for (const double negative : path.column("negative_eigenvalues")) EXPECT_EQ(negative, -1);
      const auto summary = block.summary(name);
      EXPECT_EQ(summary.at("steps"), block.summary("direct").at("steps"));
      // One iteration a solve would be a factor in double precision.
      EXPECT_GT(summary.at("iterations").at("total").get<int>(), summary.at("solves").get<int>());
    }
}

TEST(KrylovPath, AutoTakesTheFactorizationWhereItFits) {
  Block block;
  const Table direct = block.path("", "direct"), automatic = block.path("\nsolver: auto\n", "auto");
  ASSERT_EQ(direct.numRows(), automatic.numRows());
  for (const std::string& name : direct.names())
    EXPECT_EQ(direct.column(name), automatic.column(name)) << name;
  EXPECT_NE(block.printed.find("solver: MUMPS"), std::string::npos) << block.printed;
  EXPECT_EQ(block.summary("auto").at("solver"), block.summary("direct").at("solver"));
}

TEST(KrylovPath, AutoSaysWhatDoesNotFit) {
  Block block;
  // 1 kB.
  block.write("\nsolver: {type: auto, memory: 1.0e-6}\n");
  const CommandResult r = runAtrapos({"run", "deck.yaml", "-o", "none"}, block.folder.path());
  EXPECT_NE(r.exitCode, 0);
  EXPECT_NE((r.out + r.err).find("no tangent solver fits"), std::string::npos) << r.out << r.err;
  EXPECT_EQ(block.summary("none").at("ended"), "solverFailed");
}

TEST(KrylovPath, KeysOfAnotherTypeAreRefused) {
  Block block;
  for (const char* solver : {"{type: mumps, memory: 1}", "{type: auto, preconditioner: ilu}",
                             "{type: belos, name: klu2}", "{type: belos, low_rank: 2}", "krylov"}) {
    block.write(std::string("\nsolver: ") + solver + "\n");
    const CommandResult r = runAtrapos({"check", "deck.yaml"}, block.folder.path());
    EXPECT_EQ(r.exitCode, 2) << solver;
    EXPECT_NE(r.err.find("solver"), std::string::npos) << r.err;
  }
}

}  // namespace
}  // namespace atrapos::test
