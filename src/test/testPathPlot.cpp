// Pictures of paths: texts from decks are drawn and never run; lines are dotted from the located points on.
#include "output/PathPlot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "output/PathCurves.hpp"
#include "output/PathTable.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

constexpr const char* kHostile =
    "`touch pwned1` 8'12 \"@GPVAL_PWD it's \"`touch pwned2`\" @x \\\n!touch pwned3\nsystem 'touch pwned4'\r#";

/// Goes up, back through two unstable rows, and up again.
constexpr const char* kRows =
    "0,0,0,0,0,0,0,0\n1,1,2,1,1,0,0,0\n2,2,1,2,2,1,0,0\n2,3,1,3,3,1,0,0\n3,4,2,4,4,0,0,0\n3,5,3,5,5,0,0,0\n";

void writeTables(const std::filesystem::path& folder, const std::string& rows = kRows,
                 const std::string& points = "") {
  writeFile(folder / "path.csv",
            std::string("step,path_length,load_factor,x,y,negative_eigenvalues,branch,residual\n") + rows);
  writeFile(folder / "points.csv", pointHeader({"x", "y"}) + "\n" + points);
}

void writeSummary(const std::filesystem::path& folder, const std::string& title,
                  const std::string& drivenBy = "load") {
  const nlohmann::json summary{
      {"title", title}, {"driven_by", drivenBy}, {"monitors", {{"x", "displacement"}, {"y", "reaction"}}}};
  writeFile(folder / "summary.json", summary.dump());
}

std::size_t lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

/// The rows of a data block in a script, "x y" each; blank lines between pieces.
std::string block(const std::string& script, const std::string& name) {
  const std::size_t at = script.find(name + " << EOD\n");
  if (at == std::string::npos) return "";
  const std::size_t from = script.find('\n', at) + 1;
  return script.substr(from, script.find("EOD\n", from) - from);
}

/// First and last rows of the pieces of a data block.
std::vector<std::string> ends(const std::string& data) {
  std::vector<std::string> found;
  std::string last;
  std::istringstream in(data);
  for (std::string row; std::getline(in, row); last = row) {
    if (last.empty()) found.push_back(row);
    if (row.empty()) found.push_back(last);
  }
  return found;
}

/// A circle in steps of one radian, so many points each, with a mark at a point.
BranchCurve circle(int pointsPerStep) {
  BranchCurve curve;
  curve.values.resize(4);
  for (int i = 0; i <= 4 * pointsPerStep; ++i) {
    const double s = double(i) / pointsPerStep;
    curve.steps.push_back((i + pointsPerStep - 1) / pointsPerStep);
    curve.stability.push_back(i < pointsPerStep ? Stability::stable : Stability::unstable);
    const double values[] = {0, s, std::cos(s), std::sin(s)};
    for (int q = 0; q < 4; ++q) curve.values[q].push_back(values[q]);
  }
  curve.marks.push_back({static_cast<std::size_t>(pointsPerStep), "maximum", MarkType::limit});
  return curve;
}

/// Four points of a step leave h^4; the outermost stretches have three of them, h^3.
TEST(PathPlot, CurvesAreRoundBetweenTheirRows) {
  const auto error = [](int pointsPerStep) {
    const BranchCurve fine = refined(circle(pointsPerStep));
    double worst = 0;
    for (std::size_t i = 0; i < fine.numPoints(); ++i)
      worst = std::max(worst, std::hypot(fine.values[2][i] - std::cos(fine.values[1][i]),
                                         fine.values[3][i] - std::sin(fine.values[1][i])));
    return worst;
  };
  EXPECT_NEAR(std::log2(error(8) / error(16)), 3, 0.2);  // the next power is h = 1/8
  EXPECT_LT(error(5), 0.15 * (1 - std::cos(0.1)));       // that of chords
  const BranchCurve rows = circle(5), fine = refined(rows);
  EXPECT_EQ(fine.numPoints(), 20u * 8 + 1);
  ASSERT_EQ(fine.marks.size(), 1u);
  EXPECT_EQ(fine.values[1][fine.marks[0].point], 1.0);
  EXPECT_EQ(fine.stability[fine.marks[0].point], Stability::unstable);
  EXPECT_EQ(fine.stability[fine.marks[0].point - 1], Stability::stable);
  for (std::size_t i = 0; i < rows.numPoints(); ++i) EXPECT_EQ(fine.values[2][8 * i], rows.values[2][i]);
  // A step of one row is a chord.
  BranchCurve chords = circle(1);
  EXPECT_EQ(refined(chords).numPoints(), chords.numPoints());
}

TEST(PathPlot, TextsAndFoldersAreDrawnAndNotRun) {
  const TemporaryFolder all;
  const auto folder = all / ("-d it's $(touch pwned5) `touch pwned6`; touch pwned7\n\"");
  std::filesystem::create_directory(folder);
  writeTables(folder);
  writeSummary(folder, "Plain");
  ASSERT_EQ(plotPath({folder.string()}), "");
  const std::size_t plain = lines(readFile(folder / "path.gp"));
  std::filesystem::remove(folder / "path.png");

  writeSummary(folder, kHostile);
  EXPECT_EQ(plotPath({folder.string()}), "");
  EXPECT_EQ(readFile(folder / "path.png").substr(1, 3), "PNG");
  EXPECT_EQ(lines(readFile(folder / "path.gp")), plain);  // none of theirs
  const std::string odd = "p $(touch pwned8) `touch pwned9`'";
  EXPECT_EQ(plotPath({folder.string(), (folder / odd).string()}), "");
  EXPECT_EQ(readFile(folder / (odd + ".png")).substr(1, 3), "PNG");

  std::vector<std::string> found;
  for (const auto& [name, content] : snapshot(all.path()))
    if (content != "<folder>") found.push_back(std::filesystem::path(name).filename().string());
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (std::vector<std::string>{odd + ".gp", odd + ".png", odd + ".svg", "path.csv", "path.gp",
                                             "path.png", "path.svg", "points.csv", "summary.json"}));
}

TEST(PathPlot, TextsAreDrawnAsTheyAre) {
  const TemporaryFolder folder;
  for (const std::string& title : std::vector<std::string>{kHostile, "{/Symbol a}_2"}) {
    writeTables(folder.path());
    writeSummary(folder.path(), title);
    ASSERT_EQ(plotPath({folder.path().string()}), "");
    std::string shown = title;
    for (char& c : shown)
      if (c == '\n' || c == '\r') c = ' ';
    const std::string svg = readFile(folder / "path.svg");
    EXPECT_NE(svg.find(">" + shown + "<"), std::string::npos) << title << "\n" << svg;
  }
}

TEST(PathPlot, DottedFromTheLocatedPointsOn) {
  const TemporaryFolder folder;
  // Between rows 2 and 3 a maximum, between 4 and 5 a minimum; a bifurcation point and a Hopf point that
  // change nothing; the extremum of a monitor is none of these.
  PointRow up{2, 0, 1.25, 2.1, "maximum"}, down{3, 0, 3.75, 0.9, "minimum"},
      idle{2, 0, 2.5, 1.5, "pitchfork", 0, 1}, other{2, 0, 2.6, 1.6, "maximum:x"},
      hopf{3, 0, 3, 1.2, hopfKind};
  up.monitors = {1.25, 1.25}, down.monitors = {3.75, 3.75}, idle.monitors = other.monitors = {2.5, 2.5};
  hopf.monitors = {3, 3};
  writeTables(
      folder.path(), kRows,
      text(up) + "\n" + text(idle) + "\n" + text(other) + "\n" + text(hopf) + "\n" + text(down) + "\n");
  ASSERT_EQ(plotPath({folder.path().string(), "", "x", {"load factor"}}), "");
  const std::string script = readFile(folder / "path.gp");
  EXPECT_EQ(ends(block(script, "$curve_0_0_0")),
            (std::vector<std::string>{"0 0", "1.25 2.1", "3.75 0.9", "5 3"}));
  EXPECT_EQ(ends(block(script, "$curve_0_0_1")), (std::vector<std::string>{"1.25 2.1", "3.75 0.9"}));
  EXPECT_EQ(block(script, "$marks_0_0"), "1.25 2.1\n3.75 0.9\n");
  EXPECT_EQ(block(script, "$marks_0_1"), "2.5 1.5\n");
  EXPECT_EQ(block(script, "$marks_0_2"), "3 1.2\n");
  // Above the maximum and the bifurcation point, below the minimum.
  EXPECT_EQ(block(script, "$labels_0_0"), "3 1.2 \"1.2\"\n2.5 1.5 \"1.5\"\n1.25 2.1 \"2.1\"\n");
  EXPECT_EQ(block(script, "$labels_0_1"), "3.75 0.9 \"0.9\"\n");
  // What is drawn: as many strokes as pieces.
  const std::string svg = readFile(folder / "path.svg");
  const auto drawn = [&](int curve) {
    const std::size_t from = svg.find("gnuplot_plot_" + std::to_string(curve) + "a\"");
    const std::size_t data = svg.find(" d='", from) + 4;
    const std::string d = svg.substr(data, svg.find('\'', data) - data);
    return std::count(d.begin(), d.end(), 'M');
  };
  EXPECT_EQ(drawn(1), 2) << svg;
  EXPECT_EQ(drawn(2), 1) << svg;
}

TEST(PathPlot, NothingIsStableWithoutProof) {
  const TemporaryFolder folder;
  // No point was located where the count changes; and then it is not known.
  writeTables(folder.path(),
              "0,0,0,0,0,0,0,0\n1,1,1,1,1,1,0,0\n2,2,2,2,2,1,0,0\n3,3,3,3,3,-1,0,0\n4,4,4,4,4,-1,0,0\n");
  const PathCurves curves = readCurves(folder.path().string());
  ASSERT_EQ(curves.branches.size(), 1u);
  const auto& s = curves.branches[0].stability;
  EXPECT_EQ(s[0], Stability::unstable);
  EXPECT_EQ(s[1], Stability::unstable);
  EXPECT_EQ(s[2], Stability::unknown);
  EXPECT_EQ(s[3], Stability::unknown);
  // Two points within one step: what lies between them cannot be stable.
  PointRow up{1, 0, 0.25, 0.5, "maximum"}, down{1, 0, 0.75, 0.4, "minimum"};
  up.monitors = down.monitors = {0.5, 0.5};
  writeTables(folder.path(), "0,0,0,0,0,0,0,0\n1,1,1,1,1,0,0,0\n", text(up) + "\n" + text(down) + "\n");
  const PathCurves snaps = readCurves(folder.path().string());
  const std::vector<Stability> expected{Stability::stable, Stability::unstable, Stability::stable,
                                        Stability::stable};
  EXPECT_EQ(snaps.branches[0].stability, expected);
}

// Columns in another order were as many monitors as there is no memory for.
TEST(PathPlot, ColumnsInAnotherOrderAreRefused) {
  const TemporaryFolder folder;
  writeTables(folder.path());
  writeFile(folder / "path.csv", "step,path_length,negative_eigenvalues,x,load_factor,branch\n1,2,0,3,4,0\n");
  writeFile(folder / "points.csv", pointHeader({}) + "\n");
  EXPECT_THROW(readCurves(folder.path().string()), std::invalid_argument);
}

TEST(PathPlot, TablesThatDoNotBelongTogetherAreRefused) {
  const TemporaryFolder folder;
  const auto refusal = [&] {
    try {
      readCurves(folder.path().string());
    } catch (const std::invalid_argument& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  writeTables(folder.path());
  EXPECT_EQ(refusal(), "no error");
  writeFile(folder / "points.csv", pointHeader({"x"}) + "\n");
  EXPECT_NE(refusal().find("path.csv and points.csv have different monitors"), std::string::npos)
      << refusal();
  PointRow nowhere{2, 0, std::nan(""), 2.1, "maximum"};
  nowhere.monitors = {1, 1};
  writeTables(folder.path(), kRows, text(nowhere) + "\n");
  EXPECT_EQ(refusal(), "points.csv: row 1 has no path length");
}

TEST(PathPlot, ForcesOverDisplacementsWhereTheseAreGiven) {
  const TemporaryFolder folder;
  writeTables(folder.path());
  writeSummary(folder.path(), "Pulled", "displacement");
  ASSERT_EQ(plotPath({folder.path().string()}), "");
  std::string script = readFile(folder / "path.gp");
  EXPECT_NE(script.find("set xlabel \"x\"\nset ylabel \"y\"\n"), std::string::npos) << script;
  EXPECT_EQ(script.find("\"load factor\""), std::string::npos) << script;
  writeSummary(folder.path(), "Loaded", "load");
  ASSERT_EQ(plotPath({folder.path().string()}), "");
  script = readFile(folder / "path.gp");
  EXPECT_NE(script.find("set xlabel \"x\"\nset ylabel \"load factor\"\n"), std::string::npos) << script;
}

TEST(PathPlot, WhatIsSeenOfManyRowsStays) {
  const TemporaryFolder folder;
  std::ostringstream rows;
  constexpr int count = 40000;
  for (int i = 0; i <= count; ++i) {
    const double a = 1e-4 * i;
    rows << i << ',' << a << ',' << std::sin(a) << ',' << a << ',' << 0 << ",0,0,0\n";
  }
  writeTables(folder.path(), rows.str());
  ASSERT_EQ(plotPath({folder.path().string(), "", "x", {"load factor"}}), "");
  const std::string data = block(readFile(folder / "path.gp"), "$curve_0_0_0");
  EXPECT_LT(lines(data), 12000u);
  std::istringstream in(data);
  double x = 0, y = 0, last = 0, highest = 0;
  while (in >> x >> y) {
    EXPECT_LT(std::abs(x - last), 4 * 1e-3);  // the width over 4000, and one row
    highest = std::max(highest, y);
    last = x;
  }
  EXPECT_NEAR(last, 4, 1e-9);
  EXPECT_NEAR(highest, 1, 1e-6);
}

TEST(PathPlot, RequestsAreChecked) {
  const TemporaryFolder folder;
  EXPECT_THROW(plotPath({(folder / "none").string()}), std::invalid_argument);
  writeTables(folder.path());
  try {
    plotPath({folder.path().string(), "", "z", {}});
    FAIL() << "accepted";
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "there is no 'z' in path.csv; there are load factor, path length, x, y");
  }
}

}  // namespace
}  // namespace atrapos::test
