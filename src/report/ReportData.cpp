#include "report/ReportData.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "output/FieldFiles.hpp"
#include "output/Files.hpp"
#include "output/PathCurves.hpp"
#include "output/TableFile.hpp"
#include "report/ReportShape.hpp"

namespace atrapos {
namespace {

using nlohmann::json;

// A page of some 20 MB opens in a second or two.
constexpr std::size_t kShapeBytes = 12'000'000;  // before base64
constexpr std::size_t kCurveNumbers = 400'000;
constexpr std::size_t kRows = 4000;  // of a table

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json numbers(const std::vector<double>& all, const std::vector<std::size_t>& places) {
  json list = json::array();
  for (const std::size_t i : places) list.push_back(number(all[i]));
  return list;
}

/// Every so many-th point of a branch, and all where something begins or was located.
std::vector<std::size_t> keptPoints(const BranchCurve& branch, std::size_t every) {
  std::vector<bool> keep(branch.numPoints(), false);
  for (std::size_t i = 0; i < keep.size(); ++i)
    keep[i] = i % every == 0 || i + 1 == keep.size() || branch.stability[i] != branch.stability[i - 1];
  for (const CurveMark& mark : branch.marks) keep[mark.point] = true;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < keep.size(); ++i)
    if (keep[i]) kept.push_back(i);
  return kept;
}

json branchOf(const BranchCurve& branch, std::size_t every) {
  const auto kept = keptPoints(branch, every);
  json of{
      {"number", branch.number}, {"name", branch.name}, {"marks", json::array()}, {"values", json::array()}};
  of["thinned"] = every > 1;
  std::string stability;
  json steps = json::array();
  for (const std::size_t i : kept) {
    stability += static_cast<char>('0' + static_cast<int>(branch.stability[i]));
    steps.push_back(branch.steps[i]);
  }
  of["stability"] = stability;
  of["steps"] = steps;
  for (const auto& values : branch.values) of["values"].push_back(numbers(values, kept));
  for (const CurveMark& mark : branch.marks) {
    const auto at = std::lower_bound(kept.begin(), kept.end(), mark.point) - kept.begin();
    static const char* const types[] = {"limit", "bifurcation", "hopf"};
    of["marks"].push_back({{"point", at}, {"kind", mark.kind}, {"type", types[static_cast<int>(mark.type)]}});
  }
  return of;
}

json branchesOf(const PathCurves& curves, std::vector<std::string>& notes) {
  std::size_t points = 0;
  for (const BranchCurve& b : curves.branches) points += b.numPoints();
  const std::size_t every = 1 + points * curves.quantities.size() / kCurveNumbers;
  if (every > 1) notes.push_back(fmt::format("the curves show one of {} rows of path.csv", every));
  json list = json::array();
  for (const BranchCurve& b : curves.branches) list.push_back(branchOf(b, every));
  return list;
}

/// Which quantities the page begins with: as the pictures do.
json axesOf(const PathCurves& curves) {
  const auto first = [&](QuantityKind kind) {
    const auto& all = curves.quantities;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Quantity& q) { return q.kind == kind; });
    return found == all.end() ? std::size_t{0} : static_cast<std::size_t>(found - all.begin());
  };
  const std::size_t force = first(QuantityKind::force), displacement = first(QuantityKind::displacement);
  if (curves.drivenByDisplacement && force > 0 && displacement > 0)
    return {{"x", displacement}, {"y", force}};
  return {{"x", displacement > 0 ? displacement : curves.quantities.size() > 2 ? 2 : 1}, {"y", 0}};
}

json cellOf(const TableFile& table, std::size_t row, std::size_t place) {
  const double value = table.number(row, place);
  if (std::isfinite(value)) return value;
  const std::string& text = table.text(row, place);
  return text == "inf" || text == "nan" || text == "-nan" ? json(nullptr) : json(text);
}

json tableOf(const TableFile& table, std::size_t columns, const char* name, std::vector<std::string>& notes) {
  json rows = json::array();
  const auto kept = evenly(table.numRows(), kRows);
  for (const std::size_t i : kept) {
    json row = json::array();
    for (std::size_t c = 0; c < columns; ++c) row.push_back(cellOf(table, i, c));
    rows.push_back(std::move(row));
  }
  if (kept.size() < table.numRows())
    notes.push_back(fmt::format("the table of {} shows {} of {} rows", name, kept.size(), table.numRows()));
  return {{"columns", std::vector<std::string>(table.names().begin(), table.names().begin() + columns)},
          {"rows", std::move(rows)}};
}

/// steps.csv: its last column holds the terms of the series.
json stepsOf(const std::string& file, std::vector<std::string>& notes) {
  if (!std::filesystem::exists(file))
    return {{"columns", json::array()}, {"rows", json::array()}, {"terms", json::array()}};
  const TableFile table(file);
  const std::size_t terms = table.place("terms");
  json steps = tableOf(table, terms, "steps", notes);
  json all = json::array();
  for (const std::size_t i : evenly(table.numRows(), kRows)) {
    json row = json::array();
    std::istringstream in(table.text(i, terms));
    for (double term = 0; in >> term;) row.push_back(number(term));
    all.push_back(std::move(row));
  }
  steps["terms"] = std::move(all);
  return steps;
}

std::vector<ShapeFile> shapeFilesOf(const std::string& folder, const PathCurves& curves) {
  std::vector<ShapeFile> files;
  for (const BranchCurve& b : curves.branches)
    files.push_back(
        {b.number, b.name, folder + "/" + fieldsName(b.number), folder + "/" + toolsName(b.number)});
  return files;
}

}  // namespace

json reportData(const std::string& folder) {
  const PathCurves curves = readCurves(folder);
  std::vector<std::string> notes;
  json data{{"title", curves.title}, {"axes", axesOf(curves)}, {"quantities", json::array()}};
  for (const Quantity& q : curves.quantities) data["quantities"].push_back({{"name", q.name}});
  data["branches"] = branchesOf(curves, notes);
  data["steps"] = stepsOf(folder + "/steps.csv", notes);
  const std::string events = folder + "/events.csv";
  if (std::filesystem::exists(events)) {
    const TableFile table(events);
    data["events"] = tableOf(table, table.names().size(), "contact events", notes);
  }
  if (const std::string file = folder + "/summary.json"; std::filesystem::is_regular_file(file)) {
    std::ifstream in(file);
    json summary = json::parse(in, nullptr, false);
    if (!summary.is_object())
      throw std::invalid_argument(fmt::format("{}/summary.json: is not what a run writes", folder));
    if (const auto deck = summary.find("deck_text"); deck != summary.end()) {
      data["deck"] = *deck;
      summary.erase(deck);
    }
    data["summary"] = std::move(summary);
  }
  data["shape"] = shapeOf(shapeFilesOf(folder, curves), kShapeBytes, notes);
  data["notes"] = notes;
  return data;
}

}  // namespace atrapos
