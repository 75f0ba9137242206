#include "output/PathTable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "machine/Ranks.hpp"

namespace atrapos {

Table::Table(const std::string& file, const std::string& header, bool append)
    : file_(file), header_(header), writes_(ranks::isFirst()) {
  if (writes_) out_.open(file, append ? std::ios::app : std::ios::trunc);
  if (!append) this->append(header);
}

void Table::append(const std::string& row) {
  if (!writes_) return;
  out_ << row << '\n';
  out_.flush();
  if (!out_) throw std::runtime_error(fmt::format("{}: cannot be written (disk full?)", file_));
}

namespace {

std::vector<std::string> wordsOf(const std::string& row) {
  std::vector<std::string> words;
  std::istringstream in(row);
  for (std::string word; std::getline(in, word, ',');) words.push_back(word);
  return words;
}

}  // namespace

void Table::copyFrom(const std::string& file, const RestartPlace& last) {
  if (!writes_) return;
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line)) throw std::invalid_argument(fmt::format("{}: cannot be read", file));
  if (line != header_)
    throw std::invalid_argument(
        fmt::format("{}: has the columns {}, the deck asks for {}", file, line, header_));
  const auto names = wordsOf(header_);
  const auto column = [&](const char* name) {
    return std::find(names.begin(), names.end(), name) - names.begin();
  };
  const auto step = column("step"), branch = column("branch");
  while (std::getline(in, line)) {
    if (in.eof()) break;  // without its end: a row cut short
    const auto words = wordsOf(line);
    const int onBranch = std::stoi(words.at(branch));
    if (onBranch > last.branch || (onBranch == last.branch && std::stoi(words.at(step)) > last.step)) break;
    append(line);
  }
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

std::string pointHeader(const std::vector<std::string>& monitors) {
  return "step,branch,path_length,load_factor,kind,negative_change,nullity,uncertainty" + joined(monitors);
}

std::string text(const PointRow& r) {
  std::string row = fmt::format("{},{}", r.step, r.branch) + exact(r.pathLength) + exact(r.loadFactor) +
                    fmt::format(",{},{},{},{:.3e}", r.kind, r.negativeChange, r.nullity, r.uncertainty);
  for (double m : r.monitors) row += exact(m);
  return row;
}

}  // namespace atrapos
