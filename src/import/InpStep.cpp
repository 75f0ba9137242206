#include "import/InpStep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>

#include "deck/Characters.hpp"
#include "import/Import.hpp"

namespace atrapos::importer {
namespace {

constexpr std::size_t mostLoadEntries = 50'000'000;

class StepReader {
 public:
  explicit StepReader(InpModel& model) : model_(model) {
    for (const InpRigidBody& body : model.rigidBodies) leading_.insert(body.reference);
  }

  InpStep operator()() {
    const auto [first, last] = chosenStep();
    for (const InpCard* card : model_.boundaries) readBoundary(*card, false);
    for (auto card = first; card != last; ++card) readCard(**card);
    for (auto card = model_.steps.begin(); card != model_.steps.end(); ++card)
      if (card < first || card >= last)
        if ((*card)->keyword == "STEP")
          model_.remark((*card)->place, "*STEP: left out with all that is in it, a deck has one");
    return std::move(step_);
  }

 private:
  using Cards = std::vector<const InpCard*>::const_iterator;

  /// From its *STEP to behind its last card.
  std::pair<Cards, Cards> chosenStep() const {
    const auto isStep = [](const InpCard* card) { return card->keyword == "STEP"; };
    const auto end = model_.steps.cend();
    for (auto step = model_.steps.cbegin(); step != end;) {
      const auto next = std::find_if(step + 1, end, isStep);
      if (std::any_of(step, next, [](const InpCard* card) {
            return card->keyword == "STATIC" || card->keyword == "BUCKLE";
          }))
        return {step, next};
      step = next;
    }
    throw Error(fmt::format("{}: has no step with *STATIC or *BUCKLE, which a deck needs", *model_.file));
  }

  void readCard(const InpCard& card) {
    const std::string& k = card.keyword;
    if (k == "ENDSTEP") return;
    if (k == "STEP") return readStep(card);
    if (k == "STATIC") return readStatic(card);
    if (k == "BUCKLE") {
      step_.procedure = InpStep::Procedure::buckle;
      step_.place = card.place;
      return;
    }
    if (k == "BOUNDARY") return readBoundary(card, true);
    if (k == "CLOAD") return readForces(card);
    if (k == "DLOAD") return readElementLoads(card);
    if (k == "DSLOAD") return readSurfaceLoads(card);
    model_.remark(card.place, fmt::format("*{}: left out", deck::shortened(k)));
  }

  void readStep(const InpCard& card) {
    step_.nonlinearGeometry = card.has("NLGEOM") && card.word("NLGEOM") != "NO";
    if (const std::string* most = card.find("INC"))
      step_.increments =
          static_cast<int>(inpInteger(*most, card.place, "number of increments", 1, 1'000'000'000));
  }

  void readStatic(const InpCard& card) {
    step_.place = card.place;
    if (!card.has("RIKS")) return;
    step_.procedure = InpStep::Procedure::riks;
    InpLine line;
    if (!InpLines(card).next(line)) return;
    if (!line.at(4).empty())
      step_.loadFactor = inpNumber(line.at(4), line.place, "load proportionality factor");
    if (line.at(5).empty()) return;
    const auto nodes = inpNodes(model_, line.at(5), line.place);
    const int component = static_cast<int>(inpInteger(line.at(6), line.place, "degree of freedom", 1, 6)) - 1;
    const double value = inpNumber(line.at(7), line.place, "displacement");
    if (component > 2 || nodes.empty())
      return model_.remark(line.place, "*STATIC, RIKS: the end at a rotation is left out");
    step_.displacement = InpStep::Target{nodes.front(), component, value};
  }

  void refuseWords(const InpCard& card, std::initializer_list<const char*> words) {
    for (const char* word : words)
      if (card.has(word)) model_.remark(card.place, fmt::format("*{}: {} is left out", card.keyword, word));
  }

  void readBoundary(const InpCard& card, bool inStep) {
    refuseWords(card, {"AMPLITUDE", "TIMEDELAY", "SUBMODEL"});
    if (card.word("TYPE", "DISPLACEMENT") != "DISPLACEMENT")
      return model_.remark(card.place,
                           fmt::format("*BOUNDARY, TYPE={}: left out", deck::shortened(card.word("TYPE"))));
    if (card.word("OP") == "NEW") step_.supports.clear();
    InpLines lines(card);
    for (InpLine line; lines.next(line);) {
      const auto nodes = inpNodes(model_, line.at(0), line.place);
      double value = 0;
      std::set<int> held;
      if (isInteger(line.at(1))) {
        const auto first = inpInteger(line.at(1), line.place, "degree of freedom", 1, 1000),
                   last = line.at(2).empty()
                              ? first
                              : inpInteger(line.at(2), line.place, "degree of freedom", 1, 1000);
        for (auto d = first; d <= std::min(last, 6LL); ++d) held.insert(static_cast<int>(d) - 1);
        if (last > 6) model_.remark(line.place, "degrees of freedom beyond 6 are left out");
        value = card.has("FIXED") ? 0 : inpNumber(line.at(3), line.place, "displacement");
      } else {
        held = named(line);
      }
      if (value != 0 && !inStep)
        line.place.fail("a displacement before the first step is not 0; expected it in a step");
      count(nodes.size(), line.place);
      for (const int node : nodes) {
        InpSupport& support = step_.supports[node];
        support.place = line.place;
        for (const int d : held) support.value[static_cast<std::size_t>(d)] = value;
      }
    }
  }

  static std::set<int> named(const InpLine& line) {
    static const std::map<std::string, std::set<int>> names{
        {"XSYMM", {0, 4, 5}},  {"YSYMM", {1, 3, 5}},
        {"ZSYMM", {2, 3, 4}},  {"XASYMM", {1, 2, 3}},
        {"YASYMM", {0, 2, 4}}, {"ZASYMM", {0, 1, 5}},
        {"PINNED", {0, 1, 2}}, {"ENCASTRE", {0, 1, 2, 3, 4, 5}}};
    const auto at = names.find(inCapitals(line.at(1)));
    if (at == names.end())
      line.place.fail(fmt::format(
          "'{}' is no degree of freedom; expected 1 to 6, XSYMM, YSYMM, ZSYMM, PINNED or ENCASTRE",
          deck::shortened(std::string(line.at(1)))));
    return at->second;
  }

  void readForces(const InpCard& card) {
    refuseWords(card, {"AMPLITUDE", "TIMEDELAY", "FOLLOWER", "LOADCASE", "SECTOR", "SUBMODEL"});
    InpLines lines(card);
    for (InpLine line; lines.next(line);) {
      const auto nodes = inpNodes(model_, line.at(0), line.place);
      const auto component = inpInteger(line.at(1), line.place, "degree of freedom", 1, 1000);
      const double value = inpNumber(line.at(2), line.place, "force");
      const auto leads = [&](int node) { return leading_.count(node) > 0; };
      if (component > 6 || (component > 3 && !std::all_of(nodes.begin(), nodes.end(), leads))) {
        model_.remark(line.place,
                      "*CLOAD: a moment is left out, decks have moments on rigid bodies and edges of shells");
        continue;
      }
      count(nodes.size(), line.place);
      auto& of = component > 3 ? step_.moments : step_.forces;
      for (const int node : nodes) of[node][static_cast<std::size_t>((component - 1) % 3)] += value;
    }
  }

  void readElementLoads(const InpCard& card) {
    refuseWords(card, {"AMPLITUDE", "TIMEDELAY"});
    InpLines lines(card);
    for (InpLine line; lines.next(line);) {
      const auto elements = inpElements(model_, line.at(0), line.place);
      const std::string label = inCapitals(line.at(1));
      const double value = inpNumber(line.at(2), line.place, "load");
      if (elements.empty()) {
        model_.remark(line.place, "*DLOAD: left out, the mesh has none of its elements");
      } else if (label == "GRAV") {
        addGravity(line, elements, value);
      } else if (label == "BX" || label == "BY" || label == "BZ") {
        InpStep::VolumeLoad load{line.place, elements, {}, false};
        load.force[static_cast<std::size_t>(label[1] - 'X')] = value;
        step_.volumeLoads.push_back(std::move(load));
      } else if (isPressure(label)) {
        count(elements.size(), line.place);
        for (const int e : elements) addPressure(e, label, value, line.place);
      } else {
        model_.remark(line.place, fmt::format("*DLOAD, {}: left out; known are P, P1 to P6, GRAV, BX, BY, BZ",
                                              deck::shortened(label)));
      }
    }
  }

  static bool isPressure(const std::string& label) {
    return label == "P" || (label.size() == 2 && label[0] == 'P' && label[1] >= '1' && label[1] <= '6');
  }

  /// P on a shell acts along its normal: pushes on its bottom.
  void addPressure(int e, const std::string& label, double value, const InpPlace& place) {
    const fem::Topology topology = model_.elements[static_cast<std::size_t>(e)].type->topology;
    const auto side = inpFace(topology, fem::isShell(topology) && label == "P" ? "SNEG" : label);
    if (!side || (fem::isShell(topology) && *side > 1))
      place.fail(fmt::format("element {} has no face for '{}'",
                             model_.elementIds[static_cast<std::size_t>(e)], label));
    step_.pressures[{e, *side}] += value;
  }

  void addGravity(const InpLine& line, const std::vector<int>& elements, double value) {
    InpStep::VolumeLoad load{line.place, elements, {}, true};
    double length = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      load.force[d] = inpNumber(line.at(3 + d), line.place, "direction");
      length = std::hypot(length, load.force[d]);
    }
    if (!(length > 0) || !std::isfinite(length)) line.place.fail("the direction of gravity has no length");
    for (double& f : load.force) f *= value / length;
    step_.volumeLoads.push_back(std::move(load));
  }

  void readSurfaceLoads(const InpCard& card) {
    refuseWords(card, {"AMPLITUDE", "TIMEDELAY", "FOLLOWER"});
    InpLines lines(card);
    for (InpLine line; lines.next(line);) {
      const std::string name = inpName(line.at(0)), label = inCapitals(line.at(1));
      const auto* const faces = model_.surfaces.find(name);
      if (faces == nullptr)
        line.place.fail(fmt::format("there is no surface '{}' of elements", deck::shortened(name)));
      if (label != "P") {
        model_.remark(line.place, fmt::format("*DSLOAD, {}: left out; known is P", deck::shortened(label)));
        continue;
      }
      const double value = inpNumber(line.at(2), line.place, "pressure");
      count(faces->size(), line.place);
      const bool onEdges = std::any_of(faces->begin(), faces->end(), [&](const InpFace& face) {
        return face.side > 1 &&
               fem::isShell(model_.elements[static_cast<std::size_t>(face.element)].type->topology);
      });
      if (onEdges) {
        model_.remark(line.place, "*DSLOAD, P: left out on edges of shells; decks have loads of type edge");
        continue;
      }
      for (const InpFace& face : *faces) step_.pressures[{face.element, face.side}] += value;
    }
  }

  void count(std::size_t entries, const InpPlace& place) {
    entries_ += entries;
    if (entries_ > mostLoadEntries)
      place.fail(fmt::format("supports and loads have more than {} entries together, which is the most",
                             mostLoadEntries));
  }

  InpModel& model_;
  InpStep step_;
  std::set<int> leading_;  ///< nodes that lead rigid bodies
  std::size_t entries_ = 0;
};

}  // namespace

InpStep readInpStep(InpModel& model) { return StepReader(model)(); }

}  // namespace atrapos::importer
