// The tables of a results' folder, one after the other with lines %% between them: path.csv, points.csv,
// branches.csv and summary.json. Taken over by a restart, drawn, taken as a reference of errors, or refused
// with one line.
#include <cmath>
#include <sstream>
#include <vector>

#include "TextTarget.hpp"
#include "chart/PathError.hpp"
#include "output/PathCurves.hpp"
#include "output/PathTable.hpp"
#include "output/TableFile.hpp"

using namespace atrapos;

namespace {

test::Language csv() {
  return {",\n",
          ",\n",
          {"", "0", "-1", "1e308", "nan", "inf", "2147483648", "1e-999", "step", "branch", "path_length",
           "load_factor", "negative_eigenvalues", "uncertainty", "maximum", "%%"},
          ",\n%{}\"",
          false};
}

template <class F>
void readOrRefuse(const F& read) {
  try {
    read();
  } catch (const std::invalid_argument& error) {
    fuzz::requireOneLine(error.what(), "");
  }
}

void writeParts(const std::string& text) {
  std::istringstream in(text);
  std::string line;
  for (const char* const name : {"path.csv", "points.csv", "branches.csv", "summary.json"}) {
    std::string part;
    while (std::getline(in, line) && line != "%%") part += line + (in.eof() ? "" : "\n");
    if (part.empty())
      std::filesystem::remove(fuzz::folder() / name);
    else
      fuzz::folder().write(name, part);
  }
}

/// As a restart does behind step 2 of the path, with any mark: what the rows are is known then.
void goOn(const std::string& file, const std::string& header) {
  readOrRefuse([&] { Table(fuzz::folder() / "new.csv", header).copyFrom(file, {0, 2}, {}); });
}

void takeAsReference(const std::string& file) {
  chart::Chart chart;
  chart.over = "load_factor";
  chart.monitors = {"tip"};
  readOrRefuse([&] {
    const auto rows = chart::readPath(file, chart, 0);
    chart.between = 10;
    chart::errorOf(rows, file, chart, *chart::ReferenceCurve::ofPoints(rows.over, rows.monitor, file));
  });
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  return fuzz::mutateText(csv(), data, size, most, seed);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  writeParts(fuzz::textOf(data, size));
  const std::string path = fuzz::folder() / "path.csv", points = fuzz::folder() / "points.csv";
  goOn(path, pathHeader({"tip"}));
  goOn(points, pointHeader({"tip"}));
  takeAsReference(path);
  readOrRefuse([&] { limitPointsOf(points); });
  readOrRefuse([&] { hopfPointsOf(points); });
  readOrRefuse([&] {
    const PathCurves curves = readCurves(fuzz::folder().path());
    for (const BranchCurve& branch : curves.branches) refined(branch);
    curves.find("tip");
  });
  return 0;
}
