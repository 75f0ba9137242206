// Every n-th allocation, write, sync, opening, closing, renaming and removal of a run fails, or the process
// is killed there: the run says so in one line and goes on behind it, bit for bit.
//
// Of every kind some calls, evenly spread: ATRAPOS_FAULTS of them (2), or all where there are less.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/SmallDeck.hpp"

namespace atrapos::test {
namespace {

using Words = std::vector<std::string>;
using Settings = std::map<std::string, std::string>;

/// Variables of the environment of what is started meanwhile.
class Environment {
 public:
  explicit Environment(Settings settings) : settings_(std::move(settings)) {
    for (const auto& [name, value] : settings_) setenv(name.c_str(), value.c_str(), 1);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;
  ~Environment() {
    for (const auto& [name, value] : settings_) unsetenv(name.c_str());
  }

 private:
  Settings settings_;
};

long most() {
  const char* const text = std::getenv("ATRAPOS_FAULTS");
  return text ? std::max(1L, std::atol(text)) : 2;
}

/// `count` numbers or less of 1..n, the first and the last among them.
std::vector<long> spread(long n, long count) {
  std::vector<long> all;
  for (long i = 0; i < std::min(n, count); ++i)
    all.push_back(n <= count ? i + 1 : 1 + i * (n - 1) / std::max(1L, count - 1));
  return all;
}

/// Whether Exodus files are the same but for the date and the time of their records.
bool alike(const std::string& a, const std::string& b) {
  std::size_t others = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) others += a[i] != b[i] ? 1 : 0;
  return a.size() == b.size() && others <= 16;
}

/// How a command on meshes may end whose n-th call of a kind fails or kills.
void expectKilledOrTold(const CommandResult& r, const std::string& kind, const std::string& how) {
  if (how == "kill") {
    EXPECT_EQ(r.signal, SIGKILL);
    return;
  }
  // A write of netCDF that failed once may be made again.
  EXPECT_TRUE(r.exitCode == 2 || (r.exitCode == 0 && (kind == "new" || kind == "write")))
      << r.exitCode << r.err;
  EXPECT_EQ(r.errorLines().size(), r.exitCode == 0 ? 0u : 1u) << r.err;
}

class Faults : public testing::Test {
 protected:
  void SetUp() override {
    // Hard contact that closes in step 5 of 6: an event.
    const std::string soft = "{tool: roll, set: z_min, stiffness: 1000, regularisation: 1.0e-3}";
    std::string deck = edited(kSmallDeck, soft, "{tool: roll, set: z_min, points: nodes, law: hard}");
    deck = edited(edited(deck, "divisions: [4, 1, 1]", "divisions: [2, 1, 1]"), "order: 15", "order: 8");
    writeFile(folder_ / "deck.yaml", edited(deck, "{load_factor: 0.5}", "{load_factor: 8, steps: 6}"));
    ASSERT_EQ(runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path()).exitCode, 0);
    counts_ = counts(kRun);
    std::filesystem::rename(folder_ / "r", folder_ / "whole");
    ASSERT_NE(readFile(folder_ / "whole" / "events.csv").find("closes"), std::string::npos);
  }

  CommandResult faulty(const Words& words, const std::string& fault, const Settings& more = {},
                       int ranks = 0) {
    Settings settings{{"LD_PRELOAD", ATRAPOS_FAULTS_LIBRARY},
                      {"ATRAPOS_FAULT", fault},
                      {"ATRAPOS_FAULT_FOLDER", std::filesystem::canonical(folder_.path()).string()}};
    settings.insert(more.begin(), more.end());
    const Environment environment(settings);
    return ranks > 0 ? runAtraposOnRanks(ranks, words, folder_.path(), 60)
                     : runAtrapos(words, folder_.path(), 60);
  }

  /// How many calls of every kind the command makes undisturbed; on several ranks the last one.
  std::map<std::string, long> counts(const Words& words, int ranks = 0) {
    Settings settings{{"ATRAPOS_FAULT_COUNTS", (folder_ / "counts").string()}};
    if (ranks > 0) settings["ATRAPOS_FAULT_RANK"] = std::to_string(ranks - 1);
    const CommandResult r = faulty(words, "none:0", settings, ranks);
    EXPECT_EQ(r.exitCode, 0) << r.err;
    std::istringstream in(readFile(folder_ / "counts"));
    std::map<std::string, long> all;
    std::string kind;
    for (long n = 0; in >> kind >> n;) all[kind] = n;
    return all;
  }

  /// Behind a failure: the run goes on, or begins anew where no step was finished.
  void goesOn(int ranks = 0) {
    const auto run = [&](const Words& words) {
      return ranks > 0 ? runAtraposOnRanks(ranks, words, folder_.path()) : runAtrapos(words, folder_.path());
    };
    CommandResult r = run({"run", "-q", "deck.yaml", "--restart", "r"});
    if (r.exitCode == 2) {
      bool nothingThere = false;
      for (const char* const reason :
           {"cannot be read", "holds no finished step", "does not exist", "not a restart file"})
        nothingThere = nothingThere || r.err.find(reason) != std::string::npos;
      EXPECT_TRUE(nothingThere) << r.err;
      r = run(kRun);
    }
    EXPECT_EQ(r.exitCode, 0) << r.err;
  }

  void expectWhole(const std::string& whole = "whole") {
    for (const char* const name : {"path.csv", "points.csv", "steps.csv", "events.csv", "restart.bin"}) {
      ASSERT_TRUE(std::filesystem::exists(folder_ / "r" / name)) << name;
      EXPECT_TRUE(readFile(folder_ / "r" / name) == readFile(folder_ / whole / name)) << name << " differs";
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "r"))
      EXPECT_NE(entry.path().extension(), ".new") << entry.path();
  }

  /// Of a run: one line with `expected`, or nothing where it could do without what failed.
  void fails(const std::string& kind, const std::string& how, const std::string& expected) {
    ASSERT_GT(counts_[kind], 0);
    for (const long n : spread(counts_[kind], most())) {
      SCOPED_TRACE(kind + ":" + std::to_string(n) + ":" + how);
      std::filesystem::remove_all(folder_ / "r");
      const CommandResult r = faulty(kRun, kind + ":" + std::to_string(n) + ":" + how);
      EXPECT_EQ(r.signal, 0);
      EXPECT_TRUE(r.exitCode == 0 || r.exitCode == 2) << r.exitCode;
      EXPECT_EQ(r.errorLines().size(), r.exitCode == 0 ? 0u : 1u) << r.err;
      if (r.exitCode != 0) {
        EXPECT_NE(r.err.find(expected), std::string::npos) << r.err;
        EXPECT_EQ(r.err.find(".part"), std::string::npos) << r.err;  // a name that nobody has given
        goesOn();
      }
      expectWhole();
    }
  }

  inline static const Words kRun{"run", "-q", "deck.yaml", "-o", "r"};
  TemporaryFolder folder_;
  std::map<std::string, long> counts_;
};

TEST_F(Faults, OneWrite) { fails("write", "once", "r/"); }
TEST_F(Faults, AllWritesFromOneOn) { fails("write", "on", "r/"); }
TEST_F(Faults, Syncs) { fails("sync", "once", "Input/output error"); }
TEST_F(Faults, Openings) { fails("open", "once", "r/"); }
TEST_F(Faults, Closings) { fails("close", "once", "r/"); }
TEST_F(Faults, Renamings) { fails("rename", "once", "cannot be put in its place"); }
TEST_F(Faults, Removals) { fails("remove", "once", "cannot be removed: Permission denied"); }
TEST_F(Faults, Allocations) { fails("new", "once", "deck.yaml: out of memory"); }
TEST_F(Faults, AllAllocationsFromOneOn) { fails("new", "on", "deck.yaml: out of memory"); }

TEST_F(Faults, Kills) {
  for (const std::string kind : {"write", "rename", "sync", "remove"})
    for (const long n : spread(counts_[kind], most())) {
      SCOPED_TRACE(kind + ":" + std::to_string(n));
      std::filesystem::remove_all(folder_ / "r");
      ASSERT_EQ(faulty(kRun, kind + ":" + std::to_string(n) + ":kill").signal, SIGKILL);
      goesOn();
      expectWhole();
    }
}

// A restart that is killed leaves a run that goes on: what it has is not less than before.
TEST_F(Faults, KillsOfRestarts) {
  const Words restart{"run", "-q", "deck.yaml", "--restart", "r", "--from", "3"};
  const auto put = [&] {
    std::filesystem::remove_all(folder_ / "r");
    std::filesystem::copy(folder_ / "whole", folder_ / "r");
  };
  put();
  const auto all = counts(restart);
  for (const std::string kind : {"write", "rename", "remove"})
    for (const long n : spread(all.at(kind), most())) {
      SCOPED_TRACE(kind + ":" + std::to_string(n));
      put();
      ASSERT_EQ(faulty(restart, kind + ":" + std::to_string(n) + ":kill").signal, SIGKILL);
      const CommandResult r = runDeck({"--restart", "r"}, folder_.path());
      EXPECT_EQ(r.exitCode, 0) << r.err;
      expectWhole();
    }
}

TEST_F(Faults, MeshesSplitsAndJoins) {
  const Words split{"split", "-q", "box.exo", "2", "-o", "cut"},
      join{"join", "-q", "cut", "-o", "joined.exo"}, mesh{"mesh", "-q", "deck.yaml"};
  const std::map<std::string, Words> commands{{"box.exo", mesh}, {"cut.2.0", split}, {"joined.exo", join}};
  ASSERT_EQ(runAtrapos(split, folder_.path()).exitCode, 0);
  ASSERT_EQ(runAtrapos(join, folder_.path()).exitCode, 0);
  std::filesystem::remove(folder_ / "counts");
  const auto before = snapshot(folder_.path());
  for (const auto& [file, words] : commands) {
    const auto all = counts(words);
    for (const std::string kind : {"write", "rename", "open", "sync", "new"})
      for (const std::string how : {"once", "kill"})
        for (const long n : spread(all.at(kind), most())) {
          SCOPED_TRACE(file + " " + kind + ":" + std::to_string(n) + ":" + how);
          const CommandResult r = faulty(words, kind + ":" + std::to_string(n) + ":" + how);
          expectKilledOrTold(r, kind, how);
          // What was there is whole: the old or the new.
          for (const auto& [path, content] : before) {
            if (content == "<folder>") continue;
            EXPECT_TRUE(alike(readFile(folder_ / path), content)) << path;
          }
        }
  }
}

// The mesh of before stays, or the new one is there; a deck is there whole or not at all.
TEST_F(Faults, Imports) {
  writeFile(folder_ / "plate.inp",
            "*NODE\n1\n2,1\n3,1,1\n4,0,1\n*ELEMENT, TYPE=CPS4, ELSET=p\n1, 1,2,3,4\n*MATERIAL, NAME=m\n"
            "*ELASTIC\n1, .3\n*SOLID SECTION, ELSET=p, MATERIAL=m\n.1\n*BOUNDARY\n1, 1, 2\n4, 1\n"
            "*STEP\n*STATIC\n*DLOAD\np, P2, 2.\n*END STEP\n");
  const Words import{"import", "-q", "plate.inp", "--deck"};
  const auto all = counts(import);
  const std::string deck = readFile(folder_ / "plate.yaml"), mesh = readFile(folder_ / "plate.exo");
  ASSERT_NE(deck, "");
  for (const std::string kind : {"write", "rename", "open", "sync", "new"})
    for (const std::string how : {"once", "kill"})
      for (const long n : spread(all.at(kind), most())) {
        SCOPED_TRACE(kind + ":" + std::to_string(n) + ":" + how);
        std::filesystem::remove(folder_ / "plate.yaml");
        const CommandResult r = faulty(import, kind + ":" + std::to_string(n) + ":" + how);
        expectKilledOrTold(r, kind, how);
        EXPECT_TRUE(alike(readFile(folder_ / "plate.exo"), mesh));
        if (std::filesystem::exists(folder_ / "plate.yaml"))
          EXPECT_EQ(readFile(folder_ / "plate.yaml"), deck);
        else
          EXPECT_EQ(runAtrapos(import, folder_.path()).exitCode, 0);
      }
}

TEST_F(Faults, KillsOfARank) {
  ASSERT_EQ(runAtraposOnRanks(2, {"run", "-q", "deck.yaml", "-o", "whole2"}, folder_.path()).exitCode, 0);
  // Rank 1 writes nothing: it is killed at an allocation.
  const std::map<std::string, std::string> kindOf{{"0", "write"}, {"1", "new"}};
  // Not up to the last one: their number may differ from run to run.
  const std::map<std::string, long> last{{"write", counts_["write"] / 2},
                                         {"new", counts(kRun, 2)["new"] * 9 / 10}};
  for (const auto& [rank, kind] : kindOf)
    for (const long n : spread(last.at(kind), std::min(most(), 8L))) {
      SCOPED_TRACE("rank " + rank + " " + kind + ":" + std::to_string(n));
      std::filesystem::remove_all(folder_ / "r");
      const CommandResult r =
          faulty(kRun, kind + ":" + std::to_string(n) + ":kill", {{"ATRAPOS_FAULT_RANK", rank}}, 2);
      EXPECT_NE(r.exitCode, 0);
      goesOn(2);
      expectWhole("whole2");
    }
}

TEST_F(Faults, ClocksThatJump) {
  for (const char* const way : {"back", "jump"}) {
    SCOPED_TRACE(way);
    std::filesystem::remove_all(folder_ / "r");
    const CommandResult r = faulty(kRun, "none:0", {{"ATRAPOS_FAULT_CLOCK", way}});
    EXPECT_EQ(r.exitCode, 0) << r.err;
    EXPECT_EQ(r.err, "");
    expectWhole();
  }
}

}  // namespace
}  // namespace atrapos::test
