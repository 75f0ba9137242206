// `atrapos chart`: runs with other values, errors against closed forms, tables and own runs, what is known is
// kept, and what makes no chart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "chart/Chart.hpp"
#include "chart/ChartTable.hpp"
#include "chart/DeckEdits.hpp"
#include "chart/PathError.hpp"
#include "deck/Deck.hpp"
#include "output/TableFile.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

using namespace chart;

deck::YamlTree tree(const std::string& text) { return deck::readYaml(text, "deck.yaml").root; }

TEST(DeckEdits, ReplaceAddAndTakeAway) {
  const auto root = tree("path: {order: 20, stop: {load_factor: 1}}\ntitle: \"it's: [a] 'title'\"\n");
  const auto value = tree("v: [1, 2.5e-3, {k: ~, t: '12'}]\n")->items[0];
  EXPECT_EQ(yamlText(replaced(root, "path/order", value)),
            "\"path\": {\"order\": [1, 2.5e-3, {\"k\": ~, \"t\": \"12\"}], \"stop\": {\"load_factor\": 1}}\n"
            "\"title\": \"it's: [a] 'title'\"\n");
  EXPECT_EQ(yamlText(replaced(root, "output/monitors/a", textValue("b"))),
            yamlText(root) + "\"output\": {\"monitors\": {\"a\": \"b\"}}\n");
  EXPECT_EQ(yamlText(replaced(root, "path/stop", tree("v: ~\n")->items[0])),
            "\"path\": {\"order\": 20}\n\"title\": \"it's: [a] 'title'\"\n");
  EXPECT_EQ(onOneLine(valueAt(root, "path/stop/load_factor")), "1");
  EXPECT_FALSE(valueAt(root, "path/stop/more"));
  EXPECT_THROW(replaced(root, "title/more", value), std::invalid_argument);
}

/// What is written is read as the same again.
TEST(DeckEdits, WriteWhatTheyRead) {
  for (const char* text : {"a: 'yes'\n", "a: yes\n", "a: \"x \\\" \\\\ y\"\n", "a: |\n  two\n  lines\n",
                           "a: [~, {}, [], '']\n", "'a/b': 1e-6\n", "a: {b: 0x10, c: 010, d: 1_000}\n"}) {
    const std::string once = yamlText(tree(text));
    EXPECT_EQ(yamlText(tree(once)), once) << text;
  }
  EXPECT_EQ(tree(yamlText(tree("a: |\n  two\n  lines\n")))->items[0]->text, "two\nlines\n");
}

/// Cubics through four points: the error falls with the fourth power, and what is cubic is exact.
TEST(ReferenceCurve, OfPoints) {
  double before = 0;
  for (const int n : {10, 20, 40}) {
    std::vector<double> x, y, cube;
    for (int i = 0; i <= n; ++i) {
      x.push_back(2.0 * i / n);
      y.push_back(std::sin(3 * x.back()));
      cube.push_back(std::pow(x.back() - 1, 3));
    }
    const auto sine = ReferenceCurve::ofPoints(x, y, "t"), exact = ReferenceCurve::ofPoints(x, cube, "t");
    double worst = 0;
    for (double at = 0; at <= 2; at += 0.003) {
      worst = std::max(worst, std::abs((*sine)(at)-std::sin(3 * at)));
      EXPECT_NEAR((*exact)(at), std::pow(at - 1, 3), 1e-14);
    }
    if (before > 0) {
      EXPECT_NEAR(std::log2(before / worst), 4, 0.5);
    }
    before = worst;
    EXPECT_TRUE(std::isnan((*sine)(-0.01)));
    EXPECT_TRUE(std::isnan((*sine)(2.01)));
  }
}

/// A path has many points behind a corner and few before: no cubic swings there.
TEST(ReferenceCurve, DoesNotSwing) {
  std::vector<double> x{0, 0.5, 0.9}, y{0, 0, 0};
  for (double d = 1e-6; d < 1; d *= 2) {
    x.push_back(1 + d);
    y.push_back(std::pow(d, 1.5));
  }
  const auto curve = ReferenceCurve::ofPoints(x, y, "t");
  for (double at = 0; at <= x.back(); at += 0.001) {
    const double exact = at < 1 ? 0 : std::pow(at - 1, 1.5);
    EXPECT_NEAR((*curve)(at), exact, at < 1 ? 1e-8 : 1e-2) << at;
  }
}

TEST(ReferenceCurve, HasCornersWherePointsStandTwice) {
  const auto curve = ReferenceCurve::ofPoints({0, 1, 1, 2, 3}, {0, 1, 1, 0, -1}, "t");
  for (const double x : {0.0, 0.3, 0.9, 1.0, 1.1, 2.5})
    EXPECT_NEAR((*curve)(x), x < 1 ? x : 2 - x, 1e-15) << x;
  EXPECT_DOUBLE_EQ((*ReferenceCurve::ofPoints({0, -1, -2}, {0, 1, 2}, "t"))(-1.5), 1.5);
  EXPECT_THROW(ReferenceCurve::ofPoints({0, 2, 1}, {0, 0, 0}, "t"), std::invalid_argument);
}

/// The charts of the examples: each run is a deck.
TEST(ChartExamples, AreCharts) {
  int runs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ATRAPOS_EXAMPLES "/charts")) {
    if (entry.path().extension() != ".yaml") continue;
    const Chart chart = readChart(entry.path().string());
    const auto root = deck::readYaml(deck::readText(chart.deck), chart.deck).root;
    for (const Curve& curve : chart.curves)
      for (const Edits& run : curve.runs) {
        deck::YamlTree edited = root;
        for (const auto& [keys, value] : run) edited = replaced(edited, keys, value);
        EXPECT_NO_THROW(deck::readDeckText(yamlText(edited), chart.deck))
            << entry.path() << ' ' << curve.name;
        ++runs;
      }
  }
  EXPECT_GT(runs, 50);
}

class ChartTest : public testing::Test {
 protected:
  ChartTest() {
    writeFile(folder_ / "bar.yaml", "problem: {name: stvk_bar}\noutput: {points_per_step: 4}\n");
  }

  CommandResult chart(const std::string& text) {
    writeFile(folder_ / "c.yaml", text);
    return runAtrapos({"chart", "c.yaml"}, folder_.path(), 100);
  }
  std::map<std::string, Measured> rows() const {
    std::map<std::string, Measured> byName;
    for (const auto& [digest, row] : readRows((folder_ / "c_chart").string() + "/chart.csv"))
      byName[row.curve + std::to_string(row.run)] = row;
    return byName;
  }
  TemporaryFolder folder_;
};

/// A Saint Venant-Kirchhoff bar's force is cubic: a series of order 3 is all of it, one of order 2 is not.
const std::string kBar =
    "deck: bar.yaml\n"
    "error: {monitor: load_factor, over: shortening, reference: {formula: "
    "(1+shortening)*((1+shortening)^2-1)/2}}\n"
    "curves:\n"
    "  series:\n"
    "    vary: {path/accuracy: [1e-2, 1e-3], path/residual: [1e-2, 1e-3]}\n"
    "  low orders:\n"
    "    set: {path/order: 2, path/pade: off}\n"
    "    vary: {path/accuracy: [1e-2, 1e-3], path/residual: [1e-2, 1e-3]}\n";

TEST_F(ChartTest, ErrorsAgainstAFormula) {
  const CommandResult r = chart(kBar);
  ASSERT_EQ(r.exitCode, 0) << r.err;
  const auto table = rows();
  ASSERT_EQ(table.size(), 4u);
  for (const auto& [name, row] : table) {
    EXPECT_EQ(row.outcome, "stop");
    EXPECT_GT(row.steps, 0);
    EXPECT_LT(row.error, name.back() == '1' ? 1e-1 : 1e-3) << name;
  }
  EXPECT_GT(table.at("low orders2").steps, 3 * table.at("low orders1").steps);
  EXPECT_LT(table.at("low orders2").error, 0.1 * table.at("low orders1").error);
  for (const char* file : {"chart.png", "chart.svg", "chart.gp"})
    EXPECT_TRUE(exists(folder_.path() / "c_chart" / file)) << file;
  EXPECT_NE(r.out.find("4/4 low orders 2: stop"), std::string::npos) << r.out;
}

/// Of several monitors each counts over its range: a quantity over itself has no error.
TEST_F(ChartTest, ErrorsOfSeveralMonitors) {
  const auto errorOf = [&](const std::string& monitor, const std::string& curve) {
    const CommandResult r = chart("deck: bar.yaml\nerror: {monitor: " + monitor +
                                  ", over: shortening, reference: {set: {path/accuracy: 1e-9, path/residual: "
                                  "1e-9, output/points_per_step: 40}}}\n"
                                  "curves: {" +
                                  curve + ": {set: {path/accuracy: 1e-2, path/residual: 1e-2}}}\n");
    EXPECT_EQ(r.exitCode, 0) << r.err;
    return rows().at(curve + "1").error;
  };
  const double one = errorOf("load_factor", "one"), both = errorOf("[shortening, load_factor]", "both");
  const auto loads =
      TableFile((folder_ / "c_chart/runs/1-1/results/path.csv").string()).numbers("load_factor");
  const auto [low, high] = std::minmax_element(loads.begin(), loads.end());
  EXPECT_GT(one, 0);
  EXPECT_NEAR(both * (*high - *low), one, 1e-5 * one);  // six digits in the table
}

/// Rows of one step's ends alone are exact, and the curve through them is not.
TEST_F(ChartTest, ErrorsBetweenRows) {
  writeFile(folder_ / "bar.yaml", "problem: {name: stvk_bar}\noutput: {points_per_step: 1}\n");
  const auto errorOf = [&](const std::string& more) {
    std::string text = kBar.substr(0, kBar.find("  low orders"));
    text.replace(text.find("monitor: "), 0, more);
    std::filesystem::remove_all(folder_.path() / "c_chart");  // which keeps rows of both
    const CommandResult r = chart(text);
    EXPECT_EQ(r.exitCode, 0) << r.err;
    return rows().at("series1").error;
  };
  const double ofRows = errorOf(""), between = errorOf("between: 100, ");
  EXPECT_GT(between, 1e3 * ofRows);
  EXPECT_LT(between, 1);
}

TEST_F(ChartTest, KeepsWhatItKnows) {
  ASSERT_EQ(chart(kBar).exitCode, 0);
  const auto first = rows();
  const CommandResult again = chart(kBar + "  more: {set: {path/order: 12}}\n");
  ASSERT_EQ(again.exitCode, 0) << again.err;
  EXPECT_NE(again.out.find("series 1: known"), std::string::npos) << again.out;
  EXPECT_NE(again.out.find("more 1: stop"), std::string::npos) << again.out;
  const auto second = rows();
  ASSERT_EQ(second.size(), 5u);
  for (const auto& [name, row] : first) EXPECT_EQ(second.at(name).seconds, row.seconds);
  // Another reference: all anew.
  std::string other = kBar;
  other.replace(other.find("^2-1)/2"), 7, "^2-1)/3");
  const CommandResult anew = chart(other);
  EXPECT_EQ(anew.out.find("known"), std::string::npos) << anew.out;
}

TEST_F(ChartTest, OwnRunsAndTablesOfOthers) {
  writeFile(folder_ / "other.csv", "seconds,error\n3,1e-3\n30,1e-6\n");
  const CommandResult r = chart(
      "deck: bar.yaml\n"
      "error: {monitor: shortening, over: path_length, reference: {set: {path/order: 30, path/accuracy: "
      "1e-12}}}\n"
      "curves:\n"
      "  low: {vary: {path/order: [3, 6]}}\n"
      "  other: {table: other.csv}\n");
  ASSERT_EQ(r.exitCode, 0) << r.err;
  EXPECT_NE(r.out.find("the reference is a run of the deck's own"), std::string::npos) << r.out;
  EXPECT_EQ(rows().size(), 2u);
  EXPECT_NE(readFile(folder_.path() / "c_chart" / "chart.gp").find("\"other\""), std::string::npos);
}

/// A run that comes to no stop has no error, and is told.
TEST_F(ChartTest, RunsThatEndEarlyAreTold) {
  const CommandResult r =
      chart(kBar + "  short: {set: {path/order: 2, path/pade: off, path/accuracy: 1e-9}}\n");
  ASSERT_EQ(r.exitCode, 0) << r.err;
  const Measured row = rows().at("short1");
  EXPECT_NE(row.outcome, "stop");
  EXPECT_TRUE(std::isnan(row.error));
  EXPECT_NE(r.out.find("not in the picture: short 1: "), std::string::npos) << r.out;
}

TEST_F(ChartTest, WhatMakesNoChart) {
  const std::string head =
      "deck: bar.yaml\nerror: {monitor: shortening, reference: {formula: load_factor}}\n";
  const auto expectLine = [&](const std::string& text, const std::string& line) {
    const CommandResult r = chart(text);
    EXPECT_EQ(r.exitCode, 2) << r.err;
    EXPECT_EQ(r.errorLines().size(), 1u) << r.err;
    EXPECT_NE(r.err.find(line), std::string::npos) << r.err;
  };
  expectLine(head, "c.yaml: curves: is missing; expected a map");
  expectLine(head + "curves: {}\n", "c.yaml:3:1: curves: expected one curve or more");
  expectLine(head + "curves: {a: {vary: {path/order: 3}}}\n",
             "curves/a/vary/path/order: expected a list of values, one a run, got 3");
  expectLine(head + "curves: {a: {vary: {path/order: [3, 4], path/accuracy: [1e-3]}}}\n",
             "has 1 values, but the key before 2: keys that vary together have as many");
  expectLine(head + "curves: {a: {set: {path/ordre: 3}}}\n",
             "path/ordre: is not a key here (did you mean 'order'?)");
  expectLine(head + "curves: {a: {set: {problem/name/x: 3}}}\n", "'x' stands below what is no map");
  expectLine(head + "curves: {a: {tabel: x}}\n", "curves/a/tabel: is not a key here (did you mean 'table'?)");
  expectLine("deck: bar.yaml\nerror: {monitor: shortening, reference: {}}\ncurves: {a: {}}\n",
             "expected one of file (with columns), formula and set");
  expectLine("deck: bar.yaml\nerror: {monitor: shortening, reference: {formula: sin(x)}}\ncurves: {a: {}}\n",
             "error/reference/formula: ");
  expectLine("deck: bar.yaml\nerror: {monitor: width, reference: {formula: load_factor}}\ncurves: {a: {}}\n",
             "has no column width");
  expectLine("deck: bar.yaml\nerror: {monitor: [a, b], reference: {formula: sin(x)}}\ncurves: {a: {}}\n",
             "formula: is the curve of one monitor; expected file or set of several");
  expectLine("deck: bar.yaml\nerror: {monitor: [a, a], reference: {formula: sin(x)}}\ncurves: {a: {}}\n",
             "expected a name, or a list of names without one given twice");
  expectLine(
      "deck: bar.yaml\nerror: {monitor: [a, b], reference: {file: t.csv, columns: [x, a]}}\ncurves: {a: "
      "{}}\n",
      "expected 3 names: of the quantity `over`, of each monitor");
  expectLine(
      "deck: bar.yaml\nerror: {monitor: a, reference: {formula: x, columns: [x, a]}}\ncurves: {a: {}}\n",
      "error/reference/columns: has no meaning without a file");
  expectLine("deck: bar.yaml\nerror: {reference: {formula: x}}\ncurves: {a: {}}\n",
             "error/monitor: is missing; expected a name or a list of names");
  writeFile(folder_ / "other.csv", "seconds,error\n3,1e-3\n");
  expectLine(head + "curves: {a: {table: other.csv}}\n", "curves: expected a curve that is not a table");
  writeFile(folder_ / "t.csv", "x,a,b\n100,1,1\n200,inf,2\n300,3,3\n");
  const std::string table =
      "deck: bar.yaml\nerror: {monitor: shortening, reference: {file: t.csv, columns: [x, ";
  expectLine(table + "a]}}\ncurves: {a: {}}\n", "t.csv: row 2 holds no numbers");
  expectLine(table + "b]}}\ncurves: {a: {}}\n", "the reference knows no load_factor of the path");
  expectLine(
      "deck: bar.yaml\nerror: {monitor: shortening, reference: {set: {path/order: 2, path/pade: off, "
      "path/accuracy: 1e-9}}}\ncurves: {a: {}}\n",
      "error/reference: the run does not reach a stop: ");
  expectLine("deck: none.yaml\nerror: {monitor: a, reference: {formula: load_factor}}\ncurves: {a: {}}\n",
             "none.yaml: cannot be read");
}

TEST_F(ChartTest, IsMadeByOneRank) {
  writeFile(folder_ / "c.yaml", kBar);
  const CommandResult r = runAtraposOnRanks(2, {"chart", "c.yaml"}, folder_.path());
  EXPECT_NE(r.exitCode, 0);
  EXPECT_NE(r.err.find("a chart is made by one rank; expected no mpirun"), std::string::npos) << r.err;
}

TEST_F(ChartTest, WritesIntoNoFolderOfOthers) {
  std::filesystem::create_directory(folder_ / "c_chart");
  writeFile(folder_.path() / "c_chart" / "chart.csv", "mine\n");
  const CommandResult r = chart(kBar);
  EXPECT_EQ(r.exitCode, 2);
  EXPECT_NE(r.err.find("was not made by atrapos"), std::string::npos) << r.err;
  EXPECT_EQ(readFile(folder_.path() / "c_chart" / "chart.csv"), "mine\n");
  std::filesystem::remove(folder_.path() / "c_chart" / "chart.csv");
  std::filesystem::create_directory(folder_.path() / "c_chart" / "runs");
  EXPECT_NE(chart(kBar).err.find("c_chart/runs is there, but no c_chart/chart.csv; expected another folder"),
            std::string::npos);
}

}  // namespace
}  // namespace atrapos::test
