// The command under mpirun: the same path on 1, 2 and 3 ranks, files by one of them, errors told once.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "atrapos/exodus/ResultReader.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/SameTable.hpp"
#include "support/ShellPlate.hpp"
#include "support/Table.hpp"

namespace atrapos::test {
namespace {

/// A deck with its mesh, run on several numbers of ranks.
struct DeckOnRanks {
  TemporaryFolder folder;

  explicit DeckOnRanks(const std::string& deck) {
    writeFile(folder / "deck.yaml", deck);
    const CommandResult r = runAtrapos({"mesh", "-q", "deck.yaml"}, folder.path());
    if (r.exitCode != 0) throw std::runtime_error(r.err);
  }

  std::string run(int ranks, const std::vector<std::string>& more = {}) const {
    const std::string name = "on" + std::to_string(ranks);
    std::vector<std::string> words{"run", "-q", "deck.yaml", "-o", name};
    words.insert(words.end(), more.begin(), more.end());
    const CommandResult r = runAtraposOnRanks(ranks, words, folder.path());
    if (r.exitCode != 0) throw std::runtime_error(r.err);
    return name;
  }
  std::filesystem::path file(const std::string& run, const std::string& name) const {
    return folder.path() / run / name;
  }
};

/// Events of points that close together by symmetry come in the order of their roundings: by number here.
void expectSameEvents(const Table& a, const Table& b) {
  const std::vector<std::string> columns{"step", "point", "path_length", "load_factor",
                                         "node", "x",     "y",           "z"};
  const auto sorted = [&](const Table& table) {
    std::vector<std::vector<double>> rows(table.numRows());
    for (const std::string& name : columns) {
      const auto values = table.column(name);
      for (std::size_t i = 0; i < rows.size(); ++i) rows[i].push_back(values[i]);
    }
    std::sort(rows.begin(), rows.end());
    return rows;
  };
  const auto x = sorted(a), y = sorted(b);
  ASSERT_GT(x.size(), 0u);
  ASSERT_EQ(x.size(), y.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t c = 0; c < columns.size(); ++c)
      EXPECT_NEAR(x[i][c], y[i][c], 1e-9 * std::max(1.0, std::abs(x[i][c])))
          << columns[c];  // printed digits: 10
}

void expectSameFields(const std::filesystem::path& a, const std::filesystem::path& b, double tolerance) {
  const exodus::ResultReader x(a.string()), y(b.string());
  ASSERT_EQ(x.numSteps(), y.numSteps());
  ASSERT_EQ(x.nodalNames(), y.nodalNames());
  ASSERT_EQ(x.elementNames(), y.elementNames());
  ASSERT_GT(x.numSteps(), 1);
  const int last = x.numSteps() - 1;
  // Components of vectors and tensors count against the largest one: some are zero but for rounding.
  const auto largest = [&](const std::vector<std::string>& names, const auto& read) {
    double size = 0, worst = 0;
    for (const std::string& name : names) {
      const auto p = read(x, name), q = read(y, name);
      for (std::size_t i = 0; i < p.size(); ++i) {
        size = std::max(size, std::abs(p[i]));
        worst = std::max(worst, std::abs(p[i] - q.at(i)));
      }
    }
    EXPECT_GT(size, 0);
    EXPECT_LE(worst, tolerance * size) << names.front();
  };
  largest(x.nodalNames(), [&](const auto& file, const std::string& name) { return file.nodal(last, name); });
  if (!x.elementNames().empty())
    largest(x.elementNames(),
            [&](const auto& file, const std::string& name) { return file.element(last, name); });
}

nlohmann::json summaryOf(const DeckOnRanks& deck, const std::string& run) {
  return nlohmann::json::parse(readFile(deck.file(run, "summary.json")));
}

/// The well-conditioned block on the roll: what rounds differently must not show. What is asked of runs on
/// several ranks.
constexpr double kSame = 1e-10;

std::string block() { return readFile(ATRAPOS_ACCEPT_DATA "/block.yaml"); }

TEST(Ranks, BlockWithContactFollowsTheSamePath) {
  const DeckOnRanks deck(edited(block(), "  points_per_step: 2",
                                "  points_per_step: 2\n  fields: [displacement, reaction, contact, stress]"));
  const CommandResult alone = runAtrapos({"run", "-q", "deck.yaml", "-o", "alone"}, deck.folder.path());
  ASSERT_EQ(alone.exitCode, 0) << alone.err;
  const Table path(deck.file("alone", "path.csv")), stored(ATRAPOS_ACCEPT_DATA "/block_path.csv");
  expectSameTable(stored, path, kSame);
  for (const int ranks : {1, 2, 3}) {
    SCOPED_TRACE(ranks);
    const std::string run = deck.run(ranks);
    expectSameTable(path, Table(deck.file(run, "path.csv")), kSame);
    EXPECT_EQ(summaryOf(deck, run).at("ranks"), ranks);
    EXPECT_EQ(summaryOf(deck, run).at("steps"), summaryOf(deck, "alone").at("steps"));
    EXPECT_EQ(summaryOf(deck, run).at("contacts"), summaryOf(deck, "alone").at("contacts"));
    expectSameEvents(Table(deck.file("alone", "events.csv")), Table(deck.file(run, "events.csv")));
    // Stresses are differences of displacements, reactions sums of stresses: ten times as far off.
    expectSameFields(deck.file("alone", "results.exo"), deck.file(run, "results.exo"), 10 * kSame);
  }
}

TEST(Ranks, RunGoesOnWithAnotherNumberOfRanks) {
  const DeckOnRanks whole(block()),
      parts(edited(block(), "{load_factor: 0.5}", "{load_factor: 0.5, steps: 4}"));
  const std::string three = parts.run(3);
  writeFile(parts.folder / "deck.yaml", block());
  const std::string two = parts.run(2, {"--restart", three});
  EXPECT_EQ(summaryOf(parts, two).at("restarted_behind_step"), 4);
  expectSameTable(Table(whole.file(whole.run(1), "path.csv")), Table(parts.file(two, "path.csv")), kSame);
}

TEST(Ranks, ShellsWithFollowersAndCouplingsFollowTheSamePath) {
  const DeckOnRanks deck(kShellPlate);
  const Table path(deck.file(deck.run(1), "path.csv"));
  EXPECT_GT(std::abs(path.column("tip_uz").back()), 0.1);
  for (const int ranks : {2, 3})
    // A tenth of the length thick; measured: 4e-12.
    expectSameTable(path, Table(deck.file(deck.run(ranks), "path.csv")), kSame);
}

/// Lines of the command's own, without those of mpirun.
int linesWith(const CommandResult& r, const std::string& text) {
  const auto lines = r.errorLines();
  return static_cast<int>(std::count_if(lines.begin(), lines.end(), [&](const std::string& line) {
    return line.find(text) != std::string::npos;
  }));
}

/// The number behind a text.
int numberAfter(const std::string& all, const std::string& text) {
  const auto at = all.find(text);
  if (at == std::string::npos) throw std::runtime_error("no '" + text + "' in:\n" + all);
  return std::stoi(all.substr(at + text.size()));
}

TEST(Ranks, ThreadsOfAllFitTheMachine) {
  const DeckOnRanks deck(block());
  for (const int ranks : {1, 2, 3}) {
    SCOPED_TRACE(ranks);
    const CommandResult r = runAtraposOnRanks(ranks, {"--version", "--verbose"}, deck.folder.path());
    ASSERT_EQ(r.exitCode, 0) << r.err;
    EXPECT_EQ(numberAfter(r.out, "ranks       "), ranks);
    EXPECT_EQ(r.out.find("ranks       "), r.out.rfind("ranks       "));  // said once
    const int processors = numberAfter(r.out, "processors  ");
    const int loops = numberAfter(r.out, "element loops ");
    EXPECT_LE(ranks * loops, std::max(ranks, processors));
    EXPECT_EQ(numberAfter(r.out, "BLAS and MUMPS "), 1);
    EXPECT_EQ(summaryOf(deck, deck.run(ranks)).at("threads"), loops);
  }
}

TEST(Ranks, ErrorOfAllIsToldOnce) {
  TemporaryFolder folder;
  writeFile(folder / "deck.yaml", edited(block(), "x_min", "no_such_set"));
  ASSERT_EQ(runAtrapos({"mesh", "-q", "deck.yaml"}, folder.path()).exitCode, 0);
  const CommandResult r = runAtraposOnRanks(2, {"run", "-q", "deck.yaml"}, folder.path());
  EXPECT_EQ(r.exitCode, 2);
  EXPECT_EQ(linesWith(r, "no_such_set"), 1) << r.err;
}

TEST(Ranks, ErrorOfOneEndsAll) {
  const DeckOnRanks deck(block());
  writeFile(deck.folder / "taken", "a file where the first rank wants a folder");
  const CommandResult r = runAtraposOnRanks(3, {"run", "-q", "deck.yaml", "-o", "taken"}, deck.folder.path());
  EXPECT_EQ(r.exitCode, 2);
  EXPECT_EQ(linesWith(r, "cannot be made"), 1) << r.err;
}

/// Nodes under the block close one by one on a roll that lies askew.
std::string hardBlock() {
  std::string deck = edited(block(), "stiffness: 1000, regularisation: 1.0e-3", "law: hard, points: nodes");
  deck = edited(deck, "divisions: [4, 1, 1]", "divisions: [8, 3, 2]");
  deck = edited(deck, "-1.25], axis: [0, 1, 0]", "-1.05], axis: [0.05, 1, 0.02]");
  return edited(deck, "stop: {load_factor: 0.5}", "stop: {load_factor: 2}");
}

/// Path, events and fields of a deck with contact on 2 and 3 ranks; returns the number of events.
int expectSameContact(const std::string& text) {
  const DeckOnRanks deck(text);
  const std::string alone = deck.run(1);
  const Table path(deck.file(alone, "path.csv"));
  for (const int ranks : {2, 3}) {
    SCOPED_TRACE(ranks);
    const std::string run = deck.run(ranks);
    expectSameTable(path, Table(deck.file(run, "path.csv")), kSame);
    expectSameEvents(Table(deck.file(alone, "events.csv")), Table(deck.file(run, "events.csv")));
    expectSameFields(deck.file(alone, "results.exo"), deck.file(run, "results.exo"), 10 * kSame);
  }
  return summaryOf(deck, alone).at("contact_events");
}

TEST(Ranks, HardContactFollowsTheSamePath) { EXPECT_EQ(expectSameContact(hardBlock()), 4); }

TEST(Ranks, HardContactOverFacesFollowsTheSamePath) {
  EXPECT_GE(expectSameContact(edited(hardBlock(), ", points: nodes", ", points: quadrature")), 4);
}

/// A floor of a plate that turns up into an arc under the block, without a step in its slope.
std::string onPatches(const std::string& deck) {
  const auto at = deck.find("{type: cylinder"), end = deck.find('}', at);
  const std::string patches =
      "{type: patches, surfaces: {plate: {degree: [1, 1], points: [[1, -1, -0.05], [1, 2, -0.05], "
      "[3.4, -1, -0.05], [3.4, 2, -0.05]]}, arc: {degree: [2, 1], points: [[3.4, -1, -0.05], [3.4, 2, "
      "-0.05], "
      "[3.8, -1, -0.05], [3.8, 2, -0.05], [4.6, -1, -0.02], [4.6, 2, -0.02]]}}}";
  return deck.substr(0, at) + patches + deck.substr(end + 1);
}

TEST(Ranks, PatchesAreFollowedAsOnOneRank) {
  EXPECT_GE(
      expectSameContact(onPatches(edited(block(), "stiffness: 1000,", "carried: near, stiffness: 1000,"))),
      1);
  EXPECT_GE(expectSameContact(onPatches(hardBlock())), 2);
}

TEST(Ranks, HardContactGoesOnWithAnotherNumberOfRanks) {
  const DeckOnRanks whole(hardBlock()),
      parts(edited(hardBlock(), "{load_factor: 2}", "{load_factor: 2, steps: 3}"));
  const std::string two = parts.run(2);
  writeFile(parts.folder / "deck.yaml", hardBlock());
  const std::string one = parts.run(1, {"--restart", two});
  expectSameTable(Table(whole.file(whole.run(1), "path.csv")), Table(parts.file(one, "path.csv")), kSame);
}

TEST(Ranks, SharpenedContactIsTheSame) {
  const DeckOnRanks deck(edited(block(), "  order: 15", "  order: 15\n  sharpen: 0.1"));
  const std::string alone = deck.run(1), shared = deck.run(2);
  const Table one(deck.file(alone, "sharpen.csv"));
  EXPECT_GT(one.numRows(), 1);
  expectSameTable(one, Table(deck.file(shared, "sharpen.csv")), kSame);
  EXPECT_EQ(summaryOf(deck, alone).at("sharpened").at("reached"), true);
}

TEST(Ranks, CheckForeseesTheMemoryOfAll) {
  const DeckOnRanks deck(block());
  const CommandResult one = runAtrapos({"check", "deck.yaml"}, deck.folder.path()),
                      two = runAtraposOnRanks(2, {"check", "deck.yaml"}, deck.folder.path());
  ASSERT_EQ(one.exitCode, 0) << one.err;
  ASSERT_EQ(two.exitCode, 0) << two.err;
  const auto upTo = [](const std::string& text, const char* end) { return text.substr(0, text.find(end)); };
  EXPECT_EQ(upTo(one.out, "# memory"), upTo(two.out, "# ranks"));
  EXPECT_EQ(two.out.find("# unknowns"), two.out.rfind("# unknowns"));  // said once
  // All in MB: so small a block is nothing beside the program, which is there twice.
  const int programOnce = numberAfter(one.out, "#   set up"),
            programTwice = numberAfter(two.out, "#   set up");
  EXPECT_GT(programTwice, 1.5 * programOnce);
  EXPECT_LT(programTwice, 3 * programOnce);
}

TEST(Ranks, ModelProblemRunsOnTheFirst) {
  TemporaryFolder folder;
  writeFile(folder / "deck.yaml", "problem: {name: bratu_1d}\npath:\n  stop: {steps: 5}\n");
  const CommandResult one = runAtrapos({"run", "-q", "deck.yaml", "-o", "one"}, folder.path()),
                      two = runAtraposOnRanks(2, {"run", "deck.yaml", "-o", "two"}, folder.path());
  ASSERT_EQ(one.exitCode, 0) << one.err;
  ASSERT_EQ(two.exitCode, 0) << two.err;
  EXPECT_EQ(readFile(folder / "one" / "path.csv"), readFile(folder / "two" / "path.csv"));
  EXPECT_NE(two.out.find("the model problem runs on the first rank"), std::string::npos) << two.out;
  // An error there is told once and ends all ranks with its exit code.
  writeFile(folder / "deck.yaml",
            "problem: {name: bratu_1d, parameters: {nonsense: 1}}\npath:\n  stop: {steps: 5}\n");
  const CommandResult bad = runAtraposOnRanks(2, {"run", "-q", "deck.yaml"}, folder.path());
  EXPECT_EQ(bad.exitCode, 2);
  EXPECT_EQ(linesWith(bad, "nonsense"), 1) << bad.err;
}

TEST(Ranks, MapRunsOnTheFirst) {
  const DeckOnRanks deck(block());
  const std::vector<std::string> words{"map",      "deck.yaml", "--orders", "10",
                                       "--deltas", "1e-4",      "--pade",   "off"};
  const CommandResult r = runAtraposOnRanks(2, words, deck.folder.path());
  ASSERT_EQ(r.exitCode, 0) << r.err;
  EXPECT_EQ(Table(deck.folder / "map.csv").numRows(), 1);
}

}  // namespace
}  // namespace atrapos::test
