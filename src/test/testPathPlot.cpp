// The picture of a path: texts from decks are drawn and never run; lines end where their rows end.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "output/Gnuplot.hpp"
#include "output/PathPlot.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

constexpr const char* kHostile =
    "`touch pwned1` 8'12 \"@GPVAL_PWD it's \"`touch pwned2`\" @x \\\n!touch pwned3\nsystem 'touch pwned4'\r#";

/// Goes up, back through two unstable rows, and up again.
constexpr const char* kRows =
    "0,0,0,0,0,0,0,0\n1,1,2,1,1,0,0,0\n2,2,1,2,2,1,0,0\n2,3,1,3,3,1,0,0\n3,4,2,4,4,0,0,0\n3,5,3,5,5,0,0,0\n";

void writeTables(const std::filesystem::path& folder) {
  writeFile(folder / "path.csv",
            std::string("step,path_length,load_factor,x,y,negative_eigenvalues,branch,residual\n") + kRows);
  writeFile(folder / "points.csv",
            "step,branch,path_length,load_factor,kind,negative_change,nullity,uncertainty,x,y\n");
}

/// The same picture as a text: lines and words can be read in it.
std::string drawnAsSvg(const std::filesystem::path& folder) {
  std::string script = readFile(folder / "path.gp");
  script.replace(0, script.find("set encoding"), "set terminal svg noenhanced\nset output 'path.svg'\n");
  writeFile(folder / "svg.gp", script);
  const std::string why = runGnuplot(folder.string(), "svg.gp");
  if (!why.empty()) throw std::runtime_error(why);
  return readFile(folder / "path.svg");
}

std::size_t lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

TEST(PathPlot, TextsAndFoldersAreDrawnAndNotRun) {
  const TemporaryFolder all;
  const auto folder = all / ("-d it's $(touch pwned5) `touch pwned6`; touch pwned7\n\"");
  std::filesystem::create_directory(folder);
  writeTables(folder);
  ASSERT_EQ(plotPath(folder.string(), "Plain", {"x", "y"}, 1), "");
  const std::size_t plain = lines(readFile(folder / "path.gp"));
  std::filesystem::remove(folder / "path.png");

  EXPECT_EQ(plotPath(folder.string(), kHostile, {kHostile, "'"}, 1), "");
  EXPECT_EQ(readFile(folder / "path.png").substr(1, 3), "PNG");
  const std::string script = readFile(folder / "path.gp");
  EXPECT_EQ(lines(script), plain);  // none of theirs

  std::vector<std::string> found;
  for (const auto& [name, content] : snapshot(all.path()))
    if (content != "<folder>") found.push_back(std::filesystem::path(name).filename().string());
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (std::vector<std::string>{"path.csv", "path.gp", "path.png", "points.csv"}));
}

TEST(PathPlot, TextsAreDrawnAsTheyAre) {
  const TemporaryFolder folder;
  writeTables(folder.path());
  ASSERT_EQ(plotPath(folder.path().string(), kHostile, {"{/Symbol a}_2", "y"}, 1), "");
  std::string shown = kHostile;
  for (char& c : shown)
    if (c == '\n' || c == '\r') c = ' ';
  const std::string svg = drawnAsSvg(folder.path());
  for (const std::string& text : {shown, std::string("{/Symbol a}_2")})
    EXPECT_NE(svg.find(">" + text + "<"), std::string::npos) << text << "\n" << svg;
}

TEST(PathPlot, TheThickLineEndsWhereThePathIsUnstable) {
  const TemporaryFolder folder;
  writeTables(folder.path());
  ASSERT_EQ(plotPath(folder.path().string(), "Two stable stretches", {"x", "y"}, 1), "");
  const std::string svg = drawnAsSvg(folder.path());
  // Curves of the first panel: everything, then what is stable. Each M begins a line.
  const auto strokes = [&](int curve) {
    const std::size_t from = svg.find("gnuplot_plot_" + std::to_string(curve) + "a");
    const std::size_t data = svg.find(" d='", from) + 4;
    const std::string drawn = svg.substr(data, svg.find('\'', data) - data);
    return std::count(drawn.begin(), drawn.end(), 'M');
  };
  EXPECT_EQ(strokes(1), 1);
  EXPECT_EQ(strokes(2), 2);
}

}  // namespace
}  // namespace atrapos::test
