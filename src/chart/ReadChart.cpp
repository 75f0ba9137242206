#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "chart/Chart.hpp"
#include "chart/DeckEdits.hpp"
#include "deck/Deck.hpp"
#include "deck/Fields.hpp"

namespace atrapos::chart {
namespace {

using deck::Value;

Edits readEdits(const Value& map) {
  Edits edits;
  for (const Value& value : map.children()) edits.emplace_back(value.key(), value.tree());
  return edits;
}

/// The runs that `vary` makes: the values of all keys one by one, side by side.
std::vector<Edits> readRuns(const Value& vary) {
  std::vector<Edits> runs;
  for (const Value& values : vary.children()) {
    const auto& node = values.tree();
    if (node->kind != deck::YamlNode::Kind::List || node->items.empty())
      values.fail(fmt::format("expected a list of values, one a run, got {}", values.shown()));
    if (runs.empty()) runs.resize(node->items.size());
    if (runs.size() != node->items.size())
      values.fail(fmt::format("has {} values, but the key before {}: keys that vary together have as many",
                              node->items.size(), runs.size()));
    for (std::size_t i = 0; i < runs.size(); ++i) runs[i].emplace_back(values.key(), node->items[i]);
  }
  if (runs.empty()) vary.fail("expected keys of the deck and lists of values");
  return runs;
}

std::string besideChart(const Chart& chart, const std::string& file) {
  return (std::filesystem::path(chart.file).parent_path() / file).lexically_normal().string();
}

Curve readCurve(const Value& map, const Chart& chart) {
  deck::refuseUnknownKeys(map, {"set", "vary", "table"});
  Curve curve;
  curve.name = map.key();
  if (map.has("table")) {
    for (const char* const key : {"set", "vary"})
      if (map.has(key)) map.at(key).failKey("has no meaning beside a table");
    curve.table = besideChart(chart, map.at("table").text());
    return curve;
  }
  const Edits same = map.has("set") ? readEdits(map.at("set")) : Edits();
  curve.runs = map.has("vary") ? readRuns(map.at("vary")) : std::vector<Edits>(1);
  for (Edits& run : curve.runs) run.insert(run.begin(), same.begin(), same.end());
  return curve;
}

/// One name or a list of them, each once.
std::vector<std::string> namesOf(const Value& value) {
  if (value.tree()->kind != deck::YamlNode::Kind::List) return {value.text()};
  const auto names = value.texts();
  if (names.empty() || std::set<std::string>(names.begin(), names.end()).size() < names.size())
    value.fail("expected a name, or a list of names without one given twice");
  return names;
}

Reference readReference(const Value& map, const Chart& chart) {
  const std::size_t count = chart.monitors.size();
  deck::refuseUnknownKeys(map, {"file", "columns", "formula", "set"});
  Reference reference;
  if (map.has("file") + map.has("formula") + map.has("set") != 1)
    map.fail("expected one of file (with columns), formula and set");
  if (map.has("file")) {
    reference.file = besideChart(chart, map.at("file").text());
    if (!map.has("columns")) map.failMissing("columns", fmt::format("a list of {} names", 1 + count));
    const auto columns = map.at("columns").texts();
    if (columns.size() != 1 + count)
      map.at("columns").fail(fmt::format("expected {} names: of the quantity `over`, of {}", 1 + count,
                                         count == 1 ? "the monitor" : "each monitor"));
    reference.x = columns[0];
    reference.y.assign(columns.begin() + 1, columns.end());
  } else if (map.has("columns")) {
    map.at("columns").failKey("has no meaning without a file");
  }
  if (map.has("formula")) {
    if (count != 1) map.at("formula").failKey("is the curve of one monitor; expected file or set of several");
    reference.formula = map.at("formula").text();
  }
  if (map.has("set")) reference.own = readEdits(map.at("set"));
  return reference;
}

}  // namespace

Chart readChart(const std::string& file) {
  if (std::filesystem::is_directory(file))
    throw deck::DeckError(file + ": is a folder; expected a chart file");
  Chart chart;
  chart.file = file;
  chart.title = std::filesystem::path(file).stem().string();
  const Value root(deck::readYaml(deck::readText(file), file));
  deck::refuseUnknownKeys(root, {"title", "deck", "error", "repeat", "curves"});
  for (const char* const key : {"deck", "error", "curves"})
    if (!root.has(key)) root.failMissing(key, key == std::string("deck") ? "a file" : "a map");
  if (root.has("title")) chart.title = root.at("title").text();
  chart.deck = besideChart(chart, root.at("deck").text());
  const Value error = root.at("error");
  deck::refuseUnknownKeys(error, {"monitor", "over", "reference", "between"});
  for (const char* const key : {"monitor", "reference"})
    if (!error.has(key))
      error.failMissing(key, key == std::string("monitor") ? "a name or a list of names" : "a map");
  chart.monitors = namesOf(error.at("monitor"));
  if (error.has("over")) chart.over = error.at("over").text();
  if (error.has("between")) chart.between = error.at("between").integer(deck::check::count);
  chart.reference = readReference(error.at("reference"), chart);
  chart.about = onOneLine(error.tree());
  if (!chart.reference.file.empty()) chart.about += deck::readText(chart.reference.file);
  if (root.has("repeat")) chart.repeat = root.at("repeat").integer(deck::check::count);
  for (const Value& curve : root.at("curves").children()) chart.curves.push_back(readCurve(curve, chart));
  if (chart.curves.empty()) root.at("curves").fail("expected one curve or more");
  if (std::all_of(chart.curves.begin(), chart.curves.end(), [](const Curve& c) { return c.runs.empty(); }))
    root.at("curves").fail("expected a curve that is not a table");
  return chart;
}

}  // namespace atrapos::chart
