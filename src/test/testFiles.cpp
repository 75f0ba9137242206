// Files that cannot be written, and those that may not be replaced.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "atrapos/exodus/ResultWriter.hpp"
#include "atrapos/fem/StructuredMesh.hpp"
#include "machine/OutputFile.hpp"
#include "output/Files.hpp"
#include "output/PathTable.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/SmallDeck.hpp"

namespace atrapos::test {
namespace {

/// No file may become longer, as on a full disk.
class Limit {
 public:
  explicit Limit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  Limit(const Limit&) = delete;
  Limit& operator=(const Limit&) = delete;
  ~Limit() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

template <class F>
std::string errorOf(const F& f) {
  try {
    f();
  } catch (const std::exception& e) {
    return e.what();
  }
  return {};
}

TEST(Files, TablesHoldWholeRows) {
  const TemporaryFolder folder;
  const std::string file = (folder / "path.csv").string();
  Table table(file, "step,branch");
  int rows = 0;
  const Limit limit(1000);
  const std::string error = errorOf([&] {
    for (;; ++rows) table.append("1234567,0");
  });
  EXPECT_EQ(error, file + ": cannot be written: File too large");
  EXPECT_EQ(rows, 98);  // 12 bytes of the header, 10 a row
  EXPECT_EQ(readFile(file).size(), 12u + 98 * 10);
  EXPECT_EQ(table.mark().count, 98u);
}

TEST(Files, ResultsHoldWholeStates) {
  const TemporaryFolder folder;
  const std::string file = (folder / "results.exo").string();
  fem::BoxOptions box;
  box.divisions = {3, 3, 3};
  const fem::Mesh mesh = fem::boxMesh(box);
  exodus::ResultWriter writer(file, mesh, {{"u"}, {}, {"load_factor"}, {}, {}});
  const auto state = [&](int step) { return std::vector<double>(mesh.numNodes(), step); };
  writer.writeStep(1, state(1), {}, std::vector<double>{0.5});
  int step = 2;
  {
    const Limit limit(std::filesystem::file_size(file) + 4000);
    const std::string error = errorOf([&] {
      for (; step < 100; ++step) writer.writeStep(step, state(step), {}, std::vector<double>{0.5});
    });
    EXPECT_EQ(error.rfind(file + ": ", 0), 0u) << error;
    EXPECT_NE(error.find("File too large"), std::string::npos) << error;
    EXPECT_LT(step, 10);
  }
  const exodus::ResultReader reader(file);
  ASSERT_EQ(reader.numSteps(), step - 1);
  for (int s = 0; s < reader.numSteps(); ++s) EXPECT_EQ(reader.nodal(s, "u"), state(s + 1)) << s;
}

TEST(Files, WholeFilesAreReplacedOrNot) {
  const TemporaryFolder folder;
  const std::string file = (folder / "summary.json").string();
  replaceFile(file, "first");
  {
    const Limit limit(100);
    EXPECT_EQ(errorOf([&] { replaceFile(file, std::string(1000, 'x')); }),
              file + ".new: cannot be written: File too large");
  }
  EXPECT_EQ(readFile(file), "first");
  EXPECT_EQ(snapshot(folder.path()).size(), 1u);
  EXPECT_EQ(errorOf([&] { OutputFile(folder.path().string(), false); }),
            folder.path().string() + ": cannot be written: Is a directory");
  EXPECT_NE(errorOf([&] { OutputFile("/dev/full", false); }).find("no regular file"), std::string::npos);
}

TEST(Files, NamesOfResults) {
  for (const char* name : {"path.csv", "restart.bin", "results.exo", "results_branch12.exo",
                           "results.exo.4.0", "results_branch2.exo.16.03"})
    EXPECT_TRUE(isResultName(name)) << name;
  for (const char* name : {"notes.txt", "my_results.exo", "results.exodus", "results_branch2.exo.old",
                           "path.csv.new", "results.exo.4.4"})
    EXPECT_FALSE(isResultName(name)) << name;
}

class OwnFiles : public testing::Test {
 protected:
  void SetUp() override {
    writeFile(folder_ / "deck.yaml", kSmallDeck);
    ASSERT_EQ(runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path()).exitCode, 0);
  }
  void refuses(const std::vector<std::string>& words, const std::string& expected) {
    const auto before = files();
    const CommandResult r = runAtrapos(words, folder_.path());
    EXPECT_EQ(r.exitCode, 2);
    ASSERT_EQ(r.errorLines().size(), 1u) << r.err;
    EXPECT_NE(r.err.find(expected), std::string::npos) << r.err;
    EXPECT_TRUE(files() == before) << "something was written";
  }
  /// Of regular files: pipes are not read.
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_.path()))
      found[entry.path().string()] = entry.is_regular_file() ? readFile(entry.path()) : "";
    return found;
  }
  TemporaryFolder folder_;
};

TEST_F(OwnFiles, WhatOthersMadeStays) {
  writeFile(folder_ / "other.exo", "precious");
  refuses({"mesh", "deck.yaml", "-o", "other.exo"}, "other.exo is there and was not made by atrapos");
  refuses({"map", "deck.yaml", "-o", "other.exo"}, "other.exo is there and was not made by atrapos");
  refuses({"map", "deck.yaml", "-o", "deck.yaml"}, "deck.yaml is read too");
  refuses({"map", "deck.yaml", "-o", "box.exo"}, "box.exo");
  writeFile(folder_ / "box.exo.2.1", "precious");
  refuses({"split", "box.exo", "2"}, "box.exo.2.1 is there and was not made by atrapos");
  std::filesystem::create_directory(folder_ / "mine");
  for (const char* name : {"path.csv", "steps.csv", "results.exo", "summary.json", "restart.bin", "path.png",
                           "path.svg", "report.html", "results.exo.2.0"}) {
    writeFile(folder_ / "mine" / name, "precious");
    refuses({"run", "deck.yaml", "-o", "mine"},
            std::string("mine/") + name + " is there and was not made by atrapos");
    std::filesystem::remove(folder_ / "mine" / name);
  }
  // Empty files of such names hold nothing.
  writeFile(folder_ / "mine" / "path.csv", "");
  EXPECT_EQ(runAtrapos({"run", "-q", "deck.yaml", "-o", "mine"}, folder_.path()).exitCode, 0);
  refuses({"mesh", "deck.yaml", "-o", "mine/results.exo"}, "mine/results.exo holds results");
}

TEST_F(OwnFiles, PicturesAndPagesOfOthersStay) {
  ASSERT_EQ(runAtrapos({"run", "-q", "deck.yaml"}, folder_.path()).exitCode, 0);
  for (const char* name : {"photo.png", "photo.svg", "photo.gp", "notes.html"})
    writeFile(folder_ / name, "precious");
  refuses({"report", "deck_results", "-o", "notes.html"}, "notes.html is there and was not made by atrapos");
  for (const char* name : {"photo.gp", "photo.png", "photo.svg"}) {
    refuses({"plot", "deck_results", "-o", "photo"},
            std::string(name) + " is there and was not made by atrapos");
    std::filesystem::remove(folder_ / name);
  }
  for (int times = 0; times < 2; ++times) {
    EXPECT_EQ(runAtrapos({"plot", "deck_results", "-o", "photo", "-x", "tip_uz", "-y", "force,load factor"},
                         folder_.path())
                  .exitCode,
              0);
    EXPECT_EQ(runAtrapos({"report", "-q", "deck_results", "-o", "page.html"}, folder_.path()).exitCode, 0);
  }
  EXPECT_EQ(readFile(folder_ / "page.html"), readFile(folder_ / "deck_results" / "report.html"));
  refuses({"plot", "nowhere"}, "nowhere: holds no path.csv");
  refuses({"report", "."}, "holds no path.csv");
  refuses({"plot", "deck_results", "-y", "tip"},
          "there is no 'tip' in path.csv; there are load factor, path length, tip_uz, force");
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  std::filesystem::rename(folder_ / "pipe", folder_ / "deck_results" / "path.csv");
  refuses({"report", "deck_results"}, "path.csv: cannot be read");
}

TEST_F(OwnFiles, DevicesAndPipesAreNotReplaced) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  for (const char* file : {"pipe", "/dev/null"}) {
    refuses({"mesh", "deck.yaml", "-o", file}, "is no regular file");
    refuses({"map", "deck.yaml", "-o", file}, "is no regular file");
  }
  EXPECT_NE(errorOf([&] {
              exodus::writeMesh(fem::boxMesh({}), (folder_ / "pipe").string());
            }).find("is no regular file"),
            std::string::npos);
  std::filesystem::create_directory(folder_ / "results");
  std::filesystem::rename(folder_ / "pipe", folder_ / "results" / "path.csv");
  refuses({"run", "deck.yaml", "-o", "results"}, "results/path.csv is no regular file");
  struct stat status {};
  ASSERT_EQ(stat("/dev/null", &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode));
}

TEST_F(OwnFiles, WhatIsReadIsNotReplaced) {
  ASSERT_EQ(runAtrapos({"run", "-q", "deck.yaml", "-o", "first"}, folder_.path()).exitCode, 0);
  writeFile(folder_ / "deck.yaml", edited(kSmallDeck, "file: box.exo", "file: first/results.exo"));
  refuses({"run", "deck.yaml", "-o", "first"}, "first/results.exo is read too");
  EXPECT_EQ(runAtrapos({"run", "-q", "deck.yaml", "-o", "second"}, folder_.path()).exitCode, 0);
  ASSERT_EQ(runAtrapos({"split", "-q", "box.exo", "2"}, folder_.path()).exitCode, 0);
  refuses({"join", "box.exo.2.0", "-o", "box.exo.2.1"}, "box.exo.2.1 is read too");
}

TEST_F(OwnFiles, PartsOfDifferentDecompositionsAreNotJoined) {
  refuses({"split", "box.exo", "5"}, "box.exo: has 4 elements, which cannot be shared out to 5 parts");
  for (const char* parts : {"2", "3"})
    ASSERT_EQ(runAtrapos({"split", "-q", "box.exo", parts}, folder_.path()).exitCode, 0);
  refuses({"join", "box.exo"}, "box.exo: is cut into 2 and again into 3 parts");
  refuses({"join", "box.exo.2.0", "box.exo.3.1"}, "are not parts of one decomposition");
}

TEST_F(OwnFiles, ChartsAreNoFolders) {
  std::filesystem::create_directory(folder_ / "charts.yaml");
  refuses({"chart", "charts.yaml"}, "charts.yaml: is a folder; expected a chart file");
}

TEST_F(OwnFiles, ARunThatFailsBeforeItsFirstStepLeavesTheLastResults) {
  ASSERT_EQ(runAtrapos({"run", "-q", "deck.yaml"}, folder_.path()).exitCode, 0);
  const auto before = snapshot(folder_ / "deck_results");
  // The result file cannot be made: found when the tables are there.
  std::filesystem::create_directory(folder_ / "deck_results" / "results.exo.new");
  const CommandResult r = runAtrapos({"run", "-q", "deck.yaml"}, folder_.path());
  EXPECT_EQ(r.exitCode, 2) << r.err;
  EXPECT_EQ(r.errorLines().size(), 1u) << r.err;
  std::filesystem::remove(folder_ / "deck_results" / "results.exo.new");
  EXPECT_TRUE(snapshot(folder_ / "deck_results") == before);
}

}  // namespace
}  // namespace atrapos::test
