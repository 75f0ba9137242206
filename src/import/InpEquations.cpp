#include "import/InpEquations.hpp"

#include <fmt/format.h>

namespace atrapos::importer {
namespace {

constexpr std::size_t mostEquations = 10000;  // each is an entry of the deck
constexpr std::size_t mostNodes = 1'000'000;  // in the terms of all of them
constexpr long long mostTerms = 1000;

/// The terms, which go on over lines of three or four.
InpEquation readTerms(const InpModel& model, InpLines& lines, const InpPlace& place, long long count,
                      std::size_t& numNodes) {
  InpEquation equation{place, {}};
  InpLine line;
  std::size_t field = 0;
  const auto next = [&] {
    if (field % 3 == 0 && (field >= line.fields.size() || line.at(field).empty())) {
      if (!lines.next(line)) place.fail(fmt::format("*EQUATION: ends before its {} terms", count));
      field = 0;
    }
    return line.at(field++);
  };
  for (long long t = 0; t < count; ++t) {
    InpEquation::Term term;
    const std::string_view nodes = next();
    term.nodes = inpNodes(model, nodes, line.place);
    if ((numNodes += term.nodes.size()) > mostNodes)
      line.place.fail(
          fmt::format("*EQUATION: more than {} nodes in all terms, which is the most", mostNodes));
    term.component = static_cast<int>(inpInteger(next(), line.place, "degree of freedom", 1, 6)) - 1;
    term.factor = inpNumber(next(), line.place, "factor");
    if (term.factor != 0) equation.terms.push_back(std::move(term));
  }
  return equation;
}

}  // namespace

void readInpEquations(InpModel& model, const InpCard& card) {
  InpLines lines(card);
  for (InpLine line; lines.next(line);) {
    const auto count = inpInteger(line.at(0), line.place, "number of terms", 1, mostTerms);
    InpEquation equation = readTerms(model, lines, line.place, count, model.equationNodes);
    const auto leaveOut = [&](const char* why) {
      model.remark(line.place, fmt::format("*EQUATION: left out, {}", why));
    };
    bool rotates = false, lost = false, fits = true;
    for (const InpEquation::Term& term : equation.terms) {
      rotates = rotates || term.component > 2;
      lost = lost || term.nodes.empty();
      fits = fits && (term.nodes.size() == 1 || term.nodes.size() == equation.terms.front().nodes.size());
    }
    if (rotates) {
      leaveOut("it has rotations");
    } else if (lost) {
      leaveOut("the mesh has not all of its nodes");
    } else if (equation.terms.size() < 2) {
      leaveOut("it has one term; a support holds that");
    } else if (!fits) {
      line.place.fail(
          "*EQUATION: its sets have different numbers of nodes; expected as many as the first, or one");
    } else {
      if (model.equations.size() == mostEquations)
        line.place.fail(fmt::format("*EQUATION: more than {}, which is the most", mostEquations));
      model.equations.push_back(std::move(equation));
    }
  }
}

}  // namespace atrapos::importer
