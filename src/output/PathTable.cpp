#include "output/PathTable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "deck/Characters.hpp"
#include "machine/Ranks.hpp"
#include "output/TableFile.hpp"

namespace atrapos {

Table::Table(const std::string& file, const std::string& header, bool append)
    : header_(header), writes_(ranks::isFirst()) {
  if (!writes_) return;
  if (append) {
    std::ifstream in(file);
    std::string row;
    std::getline(in, row);  // the header
    while (std::getline(in, row)) count(row);
  }
  out_ = OutputFile(file, append);
  if (!append) out_.write(header + '\n');
}

void Table::append(const std::string& row) {
  if (!writes_) return;
  out_.write(row + '\n');
  count(row);
}

void Table::count(const std::string& row) {
  digest_.add(row);
  mark_ = {mark_.count + 1, digest_.value()};
}

namespace {

std::vector<std::string> wordsOf(const std::string& row) {
  std::vector<std::string> words;
  std::istringstream in(row);
  for (std::string word; std::getline(in, word, ',');) words.push_back(word);
  return words;
}

/// A whole number at that place of a row; empty: there is none.
std::optional<int> numberAt(const std::vector<std::string>& words, std::size_t place) {
  int number = 0;
  if (place >= words.size()) return {};
  const char* const end = words[place].data() + words[place].size();
  const auto read = std::from_chars(words[place].data(), end, number);
  return read.ec == std::errc() && read.ptr == end ? std::optional(number) : std::nullopt;
}

/// Bytes of a header in a message.
constexpr std::size_t mostShown = 300;

}  // namespace

void Table::copyFrom(const std::string& file, const RestartPlace& last, const Mark& mark) {
  if (!writes_) return;
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line)) throw std::invalid_argument(fmt::format("{}: cannot be read", file));
  if (line != header_)
    throw std::invalid_argument(fmt::format("{}: has the columns {}, the deck asks for {}", file,
                                            deck::plainLine(deck::beginOf(line, mostShown)),
                                            deck::beginOf(header_, mostShown)));
  const auto names = wordsOf(header_);
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const auto step = column("step"), branch = column("branch");
  while (std::getline(in, line)) {
    if (in.eof()) break;  // without its end: a row cut short
    const auto words = wordsOf(line);
    const auto onBranch = numberAt(words, branch), ofStep = numberAt(words, step);
    if (!onBranch || !ofStep)
      throw std::invalid_argument(fmt::format("{}: row {} is damaged", file, mark_.count + 1));
    if (*onBranch > last.branch || (*onBranch == last.branch && *ofStep > last.step)) break;
    append(line);
  }
  if (mark_ == mark) return;
  throw std::invalid_argument(fmt::format(
      "{}: {}; expected the file as the run left it", file,
      mark_.count == mark.count
          ? std::string("rows were changed")
          : fmt::format("has {} rows up to where the run goes on, it wrote {}", mark_.count, mark.count)));
}

namespace {

// 17 digits: a double read back is the same double.
std::string exact(double x) { return fmt::format(",{:.17g}", x); }

std::string joined(const std::vector<std::string>& monitors) {
  std::string text;
  for (const auto& name : monitors) text += ',' + name;
  return text;
}

}  // namespace

std::string pathHeader(const std::vector<std::string>& monitors) {
  return "step,path_length,load_factor" + joined(monitors) + ",negative_eigenvalues,branch,residual";
}

std::string text(const PathRow& r) {
  std::string row = std::to_string(r.step) + exact(r.pathLength) + exact(r.loadFactor);
  for (double m : r.monitors) row += exact(m);
  return row + fmt::format(",{},{},{:.3e}", r.negative, r.branch, r.residual);
}

std::string stepHeader() {
  return "step,branch,order,radius,length,path_length,load_factor,residual,cut_backs,corrections,closed_"
         "contacts,"
         "contact_changes,rational,negative_eigenvalues,terms";
}

std::string text(const StepRow& r) {
  std::string row = fmt::format("{},{},{},{:.6e},{:.6e}", r.step, r.branch, r.order, r.radius, r.length) +
                    exact(r.pathLength) + exact(r.loadFactor) +
                    fmt::format(",{:.3e},{},{},{},{},{},{},", r.residual, r.cutBacks, r.corrections,
                                r.contacts, r.changes, r.rational ? 1 : 0, r.negative);
  for (std::size_t k = 0; k < r.terms.size(); ++k)
    row += fmt::format("{}{:.3e}", k == 0 ? "" : " ", r.terms[k]);
  return row;
}

std::string pointHeader(const std::vector<std::string>& monitors) {
  return "step,branch,path_length,load_factor,kind,negative_change,nullity,frequency,uncertainty" +
         joined(monitors);
}

std::string text(const PointRow& r) {
  std::string row = fmt::format("{},{}", r.step, r.branch) + exact(r.pathLength) + exact(r.loadFactor) +
                    fmt::format(",{},{},{},{:.17g},{:.3e}", r.kind, r.negativeChange, r.nullity, r.frequency,
                                r.uncertainty);
  for (double m : r.monitors) row += exact(m);
  return row;
}

namespace {

/// Those of these kinds in a points.csv.
std::vector<PointRow> pointsOf(const std::string& file, const std::vector<std::string>& kinds) {
  const TableFile table(file);
  const auto step = table.integers("step"), branch = table.integers("branch"),
             change = table.integers("negative_change");
  const auto length = table.numbers("path_length"), load = table.numbers("load_factor"),
             frequency = table.numbers("frequency"), uncertainty = table.numbers("uncertainty");
  const auto kind = table.texts("kind");
  const std::size_t monitors = table.place("uncertainty") + 1;
  std::vector<PointRow> rows;
  for (std::size_t i = 0; i < table.numRows(); ++i) {
    if (std::find(kinds.begin(), kinds.end(), kind[i]) == kinds.end()) continue;
    PointRow row{step[i], branch[i], length[i], load[i], kind[i]};
    row.negativeChange = change[i];
    row.frequency = frequency[i];
    row.uncertainty = uncertainty[i];
    for (std::size_t m = monitors; m < table.names().size(); ++m) row.monitors.push_back(table.number(i, m));
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::vector<PointRow> limitPointsOf(const std::string& file) {
  return pointsOf(file, {"maximum", "minimum"});
}
std::vector<PointRow> hopfPointsOf(const std::string& file) { return pointsOf(file, {hopfKind}); }

}  // namespace atrapos
