#include "chart/ChartTable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "deck/Characters.hpp"
#include "output/TableFile.hpp"

namespace atrapos::chart {
namespace {

/// As one cell: without commas, quotes of texts and line ends.
std::string cell(const std::string& text) {
  std::string result = deck::plainLine(text);
  std::replace(result.begin(), result.end(), ',', ';');
  result.erase(std::remove(result.begin(), result.end(), '"'), result.end());
  return result;
}

}  // namespace

std::string chartHeader() {
  return "curve,run,settings,outcome,error,at,worst_residual,steps,factorizations,orders,solves,seconds,"
         "digest";
}

std::string rowOf(const Measured& m) {
  return fmt::format("{},{},{},{},{:.6g},{:.6g},{:.3g},{},{},{},{},{:.4g},{}", cell(m.curve), m.run,
                     cell(m.settings), cell(m.outcome), m.error, m.at, m.worstResidual, m.steps,
                     m.factorizations, m.orders, m.solves, m.seconds, m.digest);
}

std::map<std::string, Measured> readRows(const std::string& file) {
  std::map<std::string, Measured> rows;
  if (!std::filesystem::exists(file)) return rows;
  const TableFile table(file);
  const auto texts = [&](const char* name) { return table.texts(name); };
  const auto numbers = [&](const char* name) { return table.numbers(name); };
  const auto curve = texts("curve"), settings = texts("settings"), outcome = texts("outcome"),
             digest = texts("digest");
  const auto error = numbers("error"), at = numbers("at"), residual = numbers("worst_residual"),
             seconds = numbers("seconds");
  const auto run = table.integers("run"), steps = table.integers("steps"),
             factorizations = table.integers("factorizations"), orders = table.integers("orders"),
             solves = table.integers("solves");
  for (std::size_t i = 0; i < table.numRows(); ++i)
    rows[digest[i]] = {curve[i],  run[i],      settings[i], outcome[i],        error[i],
                       at[i],     residual[i], steps[i],    factorizations[i], orders[i],
                       solves[i], seconds[i],  digest[i]};
  return rows;
}

}  // namespace atrapos::chart
