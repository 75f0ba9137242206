#include <algorithm>
#include <cctype>
#include <ostream>

#include "deck/DeckTables.hpp"

namespace atrapos::deck {

std::string yaml(const std::string& text) {
  const bool number =
      std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  const bool word = !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_';
  });
  if (word && (number || readsAsText(text))) {
    return text;
  }
  std::string quoted = "'";
  for (const char c : text) {
    quoted += c;
    if (c == '\'') {
      quoted += c;
    }
  }
  return quoted + "'";
}

namespace {

std::string onOneLine(const Node& node) {
  if (node.children.empty()) {
    return node.text;
  }
  std::string line;
  for (const auto& [key, child] : node.children) {
    line += (line.empty() ? "{" : ", ") + key + ": " + onOneLine(child);
  }
  return line + "}";
}

int depth(const Node& node) {
  int deepest = 0;
  for (const auto& child : node.children) {
    deepest = std::max(deepest, 1 + depth(child.second));
  }
  return deepest;
}

void printLines(const Node& node, int indent, std::ostream& out) {
  for (const auto& [key, child] : node.children) {
    out << std::string(static_cast<std::size_t>(indent), ' ') << key << ':';
    // Entries stand on one line each; so does a whole block of plain values.
    if (indent >= 4 || depth(child) <= 1) {
      out << ' ' << onOneLine(child) << '\n';
    } else {
      out << '\n';
      printLines(child, indent + 2, out);
    }
  }
}

void printKey(const std::string& path, const KeyText& text, std::ostream& out) {
  out << path << text.key << ": " << text.accepts;
  if (!text.standard.empty()) {
    out << " [" << text.standard << "]";
  }
  out << ". " << text.meaning << '\n';
}

template <class S>
void printKeys(const std::string& path, const Table<S>& table, std::ostream& out) {
  for (const KeyText& text : textsOf(table)) {
    printKey(path, text, out);
  }
}

template <class E, class Variant>
void printKeys(const std::string& path, const Variants<E, Variant>& variants, std::ostream& out) {
  printKey(
      path,
      {variants.selector, "one of " + joined(wordsOf(variants)), "", "which kind; decides the other keys"},
      out);
  for (const auto& alternative : variants.alternatives) {
    for (KeyText text : alternative.texts) {
      text.meaning = fmt::format("({}: {}) {}", variants.selector, alternative.word, text.meaning);
      printKey(path, text, out);
    }
  }
  printKeys(path, variants.common, out);
}

}  // namespace

void describe(const Deck& deck, std::ostream& out) {
  printLines(print(deck.problem ? problemDeckTable() : deckTable(), deck), 0, out);
}

void describeKeys(std::ostream& out) {
  printKeys("", deckTable(), out);
  printKeys("mesh/", meshTable(), out);
  printKeys("mesh/generate/", generateVariants(), out);
  printKeys("materials/NAME/", materialVariants(), out);
  printKeys("materials/NAME/dielectric/", dielectricTable(), out);
  printKeys("physics/NAME/", physicsVariants(), out);
  printKeys("fields/NAME/", scalarFieldTable(), out);
  printKeys("plane/", planeTable(), out);
  printKeys("shells/", shellsTable(), out);
  printKeys("shells/sections/NAME/", shellSectionTable(), out);
  printKeys("shells/joints/NAME/", shellJointTable(), out);
  printKeys("membranes/NAME/", membraneTable(), out);
  printKeys("bars/NAME/", barTable(), out);
  printKeys("supports/NAME/", supportTable(), out);
  printKeys("couplings/NAME/", couplingTable(), out);
  printKeys("loads/NAME/", loadVariants(), out);
  printKeys("tools/NAME/", toolVariants(), out);
  printKeys("tools/NAME/surfaces/NAME/", splineSurfaceTable(), out);
  printKeys("tools/NAME/motion/", motionTable(), out);
  printKeys("contact/NAME/", contactTable(), out);
  printKeys("path/", pathTable(), out);
  printKeys("path/stop/", stopTable(), out);
  printKeys("path/stages/NAME/", stageTable(), out);
  printKeys("problem/", modelTable(), out);
  printKeys("solver/", solverTable(), out);
  printKeys("output/", outputTable(), out);
  printKeys("output/monitors/NAME/", monitorVariants(), out);
}

}  // namespace atrapos::deck
