#include "atrapos/exodus/JoinedResults.hpp"

#include <algorithm>

namespace atrapos::exodus {
namespace {

std::vector<MeshPart> readParts(const std::string& file, int parts) {
  std::vector<MeshPart> all;
  for (int p = 0; p < parts; ++p) all.push_back(readPart(partName(file, parts, p)));
  return all;
}

std::vector<double> spread(const std::vector<double>& ofPart, const std::vector<int>& places,
                           std::vector<double> whole) {
  for (std::size_t i = 0; i < places.size(); ++i) whole[places[i]] = ofPart[i];
  return whole;
}

}  // namespace

JoinedResults::JoinedResults(const std::string& file, int parts)
    : joined_(join(readParts(file, parts), file)) {
  for (int p = 0; p < parts; ++p) readers_.emplace_back(partName(file, parts, p));
  const ResultReader& first = readers_.front();
  numSteps_ = first.numSteps();
  for (const ResultReader& reader : readers_) {
    uneven_ = uneven_ || reader.numSteps() != first.numSteps();
    numSteps_ = std::min(numSteps_, reader.numSteps());
  }
  // A part without nodes or elements has none of their variables.
  for (int p = parts; p-- > 0;) {
    if (!joined_.nodes[p].empty()) nodalNames_ = readers_[p].nodalNames();
    if (!joined_.elements[p].empty()) elementNames_ = readers_[p].elementNames();
  }
  for (int p = 0; p < parts; ++p) {
    const ResultReader& reader = readers_[p];
    if ((!joined_.nodes[p].empty() && reader.nodalNames() != nodalNames_) ||
        (!joined_.elements[p].empty() && reader.elementNames() != elementNames_) ||
        reader.globalNames() != first.globalNames())
      throw Error(file + ": part " + std::to_string(p) + " has other variables than other parts");
    auto times = reader.times();
    times.resize(numSteps_);
    if (times != this->times())
      throw Error(file + ": part " + std::to_string(p) + " has steps at other times than part 0");
  }
}

std::vector<double> JoinedResults::times() const {
  auto times = readers_.front().times();
  times.resize(numSteps_);
  return times;
}

ResultNames JoinedResults::names() const {
  const ResultReader& first = readers_.front();
  return {nodalNames_, elementNames_, first.globalNames(), first.info(), first.qa()};
}

std::vector<double> JoinedResults::nodal(int step, const std::string& name) const {
  std::vector<double> whole(joined_.mesh.numNodes());
  for (std::size_t p = readers_.size(); p-- > 0;)  // of a node's parts the lowest one has the last word
    if (!joined_.nodes[p].empty())
      whole = spread(readers_[p].nodal(step, name), joined_.nodes[p], std::move(whole));
  return whole;
}

std::vector<double> JoinedResults::element(int step, const std::string& name) const {
  std::vector<double> whole(joined_.partOfElement.size());
  for (std::size_t p = 0; p < readers_.size(); ++p)
    if (!joined_.elements[p].empty())
      whole = spread(readers_[p].element(step, name), joined_.elements[p], std::move(whole));
  return whole;
}

std::vector<double> JoinedResults::globals(int step) const { return readers_.front().globals(step); }

void writeJoined(const JoinedResults& results, const std::string& file) {
  const ResultNames names = results.names();
  ResultWriter writer(file, results.joined().mesh, names);
  const auto times = results.times();
  for (int step = 0; step < results.numSteps(); ++step) {
    std::vector<double> nodal, element;
    const auto append = [](std::vector<double>& all, const std::vector<double>& more) {
      all.insert(all.end(), more.begin(), more.end());
    };
    for (const std::string& name : names.nodal) append(nodal, results.nodal(step, name));
    for (const std::string& name : names.element) append(element, results.element(step, name));
    writer.writeStep(times[step], nodal, element, results.globals(step));
  }
}

}  // namespace atrapos::exodus
