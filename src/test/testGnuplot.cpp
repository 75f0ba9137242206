// Texts of decks are strings to gnuplot and nothing else, and gnuplot runs where it should.
#include "output/Gnuplot.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

TEST(GnuplotText, IsOneLineThatMeansNothing) {
  EXPECT_EQ(gnuplotText(""), "\"\"");
  EXPECT_EQ(gnuplotText("Strip on a roll, nu = 0.3 (1)"), "\"Strip on a roll, nu = 0.3 (1)\"");
  EXPECT_EQ(gnuplotText("`touch pwned`"), "\"\\140touch pwned\\140\"");
  EXPECT_EQ(gnuplotText("'\"\\@%#$!"), "\"\\047\\042\\134\\100\\045\\043\\044\\041\"");
  EXPECT_EQ(gnuplotText("`12`a1"), "\"\\140\\061\\062\\140a1\"");  // digits would be the number's
  EXPECT_EQ(gnuplotText("é"), "\"\\303\\251\"");
  EXPECT_EQ(gnuplotText("a\n\r\t\x1b\x7f b"), "\"a      b\"");
  EXPECT_EQ(gnuplotText(std::string("a\0b", 3)), "\"a b\"");
  EXPECT_EQ(gnuplotText("a\xC2\x85 \xE2\x80\xA8z"), "\"a   z\"");  // ends of lines of Unicode
  EXPECT_EQ(gnuplotText("a\xE4z\xC3"), "\"a z \"");                // a file's name that is no UTF-8
}

TEST(GnuplotText, IsCutToALinesLength) {
  const std::string most(120, 'x');
  EXPECT_EQ(gnuplotText(most), '"' + most + '"');
  EXPECT_EQ(gnuplotText(most + 'x'), '"' + most + "...\"");
  std::string accents;
  for (int i = 0; i < 1000; ++i) accents += "ä";
  EXPECT_EQ(gnuplotText(accents).size(), 1 + 120 * 8 + 3 + 1u);  // characters, not bytes
}

/// What gnuplot takes a text for.
std::string printed(const std::string& text, const std::filesystem::path& folder) {
  writeFile(folder / "print.gp", "set print 'out'\nprint " + gnuplotText(text) + "\n");
  EXPECT_EQ(runGnuplot(folder.string(), "print.gp"), "") << text;
  return readFile(folder / "out");
}

TEST(GnuplotText, IsTheTextItselfToGnuplot) {
  const TemporaryFolder folder;
  std::string all;
  for (char c = ' '; c < 0x7f; ++c) all += c;
  for (const std::string& text :
       {all, std::string("`touch pwned`"), std::string("'`touch pwned`'"), std::string("\"`touch pwned`\""),
        std::string("\\"), std::string("''"), std::string("\"\"'"), std::string("a\\"),
        std::string("@GPVAL_PWD"), std::string("%d %s"), std::string("Träger 😀 `touch pwned`")})
    EXPECT_EQ(printed(text, folder.path()), text + "\n");
  EXPECT_EQ(printed("a\"\n!touch pwned\nsystem 'touch pwned'", folder.path()),
            "a\" !touch pwned system 'touch pwned'\n");
  EXPECT_EQ(snapshot(folder.path()).size(), 2u);  // print.gp, out
}

// As it was without quoting: the test would see what it looks for.
TEST(GnuplotText, WouldBeRunOtherwise) {
  const TemporaryFolder folder;
  writeFile(folder / "print.gp", "set title \"`touch pwned`\"\n");
  runGnuplot(folder.path().string(), "print.gp");
  EXPECT_TRUE(std::filesystem::exists(folder / "pwned"));
}

/// Another folder to be in, and another CDPATH, until the end of life.
class Elsewhere {
 public:
  Elsewhere(const std::filesystem::path& folder, const std::filesystem::path& search)
      : before_(std::filesystem::current_path()) {
    std::filesystem::current_path(folder);
    setenv("CDPATH", search.c_str(), 1);
  }
  ~Elsewhere() {
    std::filesystem::current_path(before_);
    unsetenv("CDPATH");
  }

 private:
  std::filesystem::path before_;
};

TEST(RunGnuplot, RunsTheScriptOfItsFolder) {
  const TemporaryFolder all;
  for (const char* where : {"here", "there"}) {
    std::filesystem::create_directories(all / where / "results");
    writeFile(all / where / "results" / "path.gp", std::string("set print 'out'\nprint '") + where + "'\n");
  }
  const Elsewhere elsewhere(all / "here", all / "there");
  EXPECT_EQ(runGnuplot("results", "path.gp"), "");
  EXPECT_EQ(readFile(all / "here" / "results" / "out"), "here\n");
  EXPECT_FALSE(std::filesystem::exists(all / "there" / "results" / "out"));
}

TEST(RunGnuplot, SaysWhyThereIsNoPicture) {
  const TemporaryFolder folder;
  writeFile(folder / "wrong.gp", "plot\n");
  EXPECT_EQ(runGnuplot(folder.path().string(), "wrong.gp"), "gnuplot failed (see wrong.gp)");
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder.path().c_str(), 1);
  EXPECT_EQ(runGnuplot(folder.path().string(), "path.gp"), "gnuplot is not installed (path.gp draws it)");
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace atrapos::test
