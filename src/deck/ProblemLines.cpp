#include "deck/ProblemLines.hpp"

#include <algorithm>
#include <unordered_map>

#include "deck/Characters.hpp"
#include "deck/DeckTables.hpp"

namespace atrapos::deck {
namespace {

void flatten(const Node& node, const std::string& path, std::vector<std::string>& lines) {
  if (node.children.empty() && !node.text.empty()) {
    lines.push_back(path + ": " + node.text);
  }
  for (const auto& [key, child] : node.children) {
    flatten(child, path.empty() ? key : path + "/" + key, lines);
  }
}

bool isOfProblem(const std::string& line) {
  const std::string block = line.substr(0, line.find_first_of("/:"));
  const bool left =
      block == "title" || block == "mesh" || block == "path" || block == "solver" || block == "output";
  return !left || line.rfind("output/monitors/", 0) == 0;
}

constexpr const char* kStages = "path/stages/";

bool isStage(const std::string& line) { return line.rfind(kStages, 0) == 0; }

/// What a stage does, whether a run has come to it or not.
std::string lineOf(const Stage& stage) {
  const bool releases = !stage.release.empty();
  const std::string what = releases ? yamlList(stage.release) : yamlList(stage.drives);
  return fmt::format("{}{}: {} {}", kStages, stage.name, releases ? "releases" : "drives",
                     what.empty() ? "all" : what);
}

std::string keyOf(const std::string& line) { return line.substr(0, line.find(": ")); }

// For messages: the lines of an earlier run come from a file that may be damaged, or forged.
std::string keyIn(const std::string& line) { return plainLine(beginOf(keyOf(line), 120)); }

std::string valueIn(const std::string& line) {
  const std::size_t at = line.find(": ");
  return at == std::string::npos ? "" : plainLine(beginOf(line.substr(at + 2), 60));
}

std::unordered_map<std::string, const std::string*> byKey(const std::vector<std::string>& lines) {
  std::unordered_map<std::string, const std::string*> map;
  for (const std::string& line : lines) {
    map.emplace(keyOf(line), &line);
  }
  return map;
}

}  // namespace

std::vector<std::string> problemLines(const Deck& deck) {
  Deck whole = deck;
  for (Tool& tool : whole.tools) {
    if (auto* const patches = std::get_if<PatchesTool>(&tool.surface)) {
      patches->file.clear();
    }
  }
  std::vector<std::string> lines;
  flatten(print(deck.problem ? problemDeckTable() : deckTable(), whole), "", lines);
  lines.erase(
      std::remove_if(lines.begin(), lines.end(), [](const std::string& line) { return !isOfProblem(line); }),
      lines.end());
  for (const Stage& stage : deck.path.stages) {
    lines.push_back(lineOf(stage));
  }
  return lines;
}

std::string firstDifference(const std::vector<std::string>& before, std::vector<std::string> now) {
  // Stages may be added: a run that has come to the end of the last one goes on with them.
  const auto oldKeys = byKey(before);
  now.erase(std::remove_if(now.begin(), now.end(),
                           [&](const std::string& line) {
                             return isStage(line) && std::any_of(before.begin(), before.end(), isStage) &&
                                    oldKeys.count(keyOf(line)) == 0;
                           }),
            now.end());
  const auto at = std::mismatch(before.begin(), before.end(), now.begin(), now.end());
  if (at.first == before.end() && at.second == now.end()) {
    return {};
  }
  // What is missing or new is told before what has only moved.
  const auto newLines = byKey(now);
  for (const std::string& line : before) {
    const auto other = newLines.find(keyOf(line));
    if (other == newLines.end()) {
      return fmt::format("{} was {} and is not there now", keyIn(line), valueIn(line));
    }
    if (*other->second != line) {
      return fmt::format("{} was {} and is {} now", keyIn(line), valueIn(line), valueIn(*other->second));
    }
  }
  for (const std::string& line : now) {
    if (oldKeys.count(keyOf(line)) == 0) {
      return fmt::format("{} is {} now and was not there", keyIn(line), valueIn(line));
    }
  }
  return fmt::format("{} stands in another place", keyIn(at.first != before.end() ? *at.first : *at.second));
}

}  // namespace atrapos::deck
