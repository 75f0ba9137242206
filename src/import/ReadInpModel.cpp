// The cards before the steps: nodes and elements first, then sets, which may name them before they are there,
// then all that names sets.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "atrapos/fem/ReferenceCell.hpp"
#include "deck/Characters.hpp"
#include "import/Import.hpp"
#include "import/InpEquations.hpp"
#include "import/InpModel.hpp"
#include "import/InpTies.hpp"

namespace atrapos::importer {
namespace {

constexpr long long mostId = std::numeric_limits<int>::max();
constexpr std::size_t mostEntries = 200'000'000;  // of all sets and elements together

class ModelReader {
 public:
  explicit ModelReader(const InpSource& source) : source_(source) {
    model_.file = source.cards().front().place.file;
  }

  InpModel operator()() {
    cutSteps();
    refuseAssemblies();
    for (const InpCard* card : cards_)
      if (card->keyword == "NODE") readNodes(*card);
    for (const InpCard* card : cards_)
      if (card->keyword == "ELEMENT") readElements(*card);
    for (auto* sets : {&model_.nodeSets, &model_.elementSets})
      for (auto& named : sets->all()) inpMakeSet(named.second);
    for (const InpCard* card : cards_) readSet(*card);
    for (const InpCard* card : cards_) readRest(*card);
    for (const InpCard* card : cards_)
      if (card->keyword == "TIE") tieInpSurfaces(model_, *card);
    for (const InpCard* card : cards_)
      if (card->keyword == "EQUATION") readInpEquations(model_, *card);
    assignSections();
    return std::move(model_);
  }

 private:
  /// Sets and surfaces are the model's wherever they stand.
  void cutSteps() {
    bool inStep = false, inPart = false;
    for (const InpCard& card : source_.cards()) {
      inPart = card.keyword == "PART" || (inPart && card.keyword != "ENDPART");
      if (card.keyword == "NSET" || card.keyword == "ELSET") requireOneScope(card, inPart);
      inStep = inStep || card.keyword == "STEP";
      const bool isSet = card.keyword == "NSET" || card.keyword == "ELSET" || card.keyword == "SURFACE";
      (inStep && !isSet ? model_.steps : cards_).push_back(&card);
    }
  }

  /// Of parts and instances there is one, where its place is that of the part: then names and numbers are
  /// flat.
  void refuseAssemblies() const {
    std::set<std::string> seen;
    for (const InpCard* card : cards_) {
      const std::string& k = card->keyword;
      if ((k == "PART" || k == "INSTANCE") && !seen.insert(k).second)
        card->place.fail(
            fmt::format("*{}: is the second one; expected one part and one instance, or a flat file (in "
                        "Abaqus/CAE: Model, Edit "
                        "Attributes, 'Do not use parts and assemblies in input files')",
                        k));
      InpLine line;
      if (k == "INSTANCE" && InpLines(*card).next(line))
        line.place.fail(
            "*INSTANCE: is moved or turned; expected an instance where its part is, or a flat file");
      for (const char* generates :
           {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM", "PARAMETER"})
        if (k == generates)
          card->place.fail(fmt::format(
              "*{}: is not known; expected nodes and elements written out, as preprocessors do", k));
    }
  }

  /// Sets of a part and of the assembly may have the same name and be different ones.
  void requireOneScope(const InpCard& card, bool inPart) {
    const std::string name = card.keyword + inCapitals(nameOf(card, card.keyword.c_str()));
    if (scopes_.emplace(name, inPart).first->second != inPart)
      card.place.fail(
          fmt::format("*{}: a set of this name is in the part too; expected different names", card.keyword));
  }

  void readNodes(const InpCard& card) {
    if (const std::string system = card.word("SYSTEM", "R"); system != "R")
      card.place.fail("*NODE, SYSTEM=" + deck::shortened(system) + ": expected Cartesian coordinates");
    std::vector<int>* const set = card.has("NSET") ? &model_.nodeSets[inpName(*card.find("NSET"))] : nullptr;
    InpLines lines(card);
    for (InpLine line; lines.next(line);) {
      const long long id = inpInteger(line.at(0), line.place, "number of a node", 1, mostId);
      const auto [at, isNew] = model_.nodeAt.emplace(id, static_cast<int>(model_.nodeIds.size()));
      if (isNew) {
        model_.nodeIds.push_back(id);
        model_.coordinates.resize(model_.coordinates.size() + 3);
      }
      for (std::size_t d = 0; d < 3; ++d)
        model_.coordinates[3 * static_cast<std::size_t>(at->second) + d] =
            inpNumber(line.at(1 + d), line.place, "coordinate");
      if (set != nullptr) add(*set, at->second, line.place);
    }
  }

  void readElements(const InpCard& card) {
    const std::string type = card.word("TYPE");
    std::vector<int>* const set = card.has("ELSET") ? &elementSet(card) : nullptr;
    const int setPlace = set != nullptr ? model_.elementSets.position(nameOf(card, "ELSET")) : -1;
    const InpElementType* const known = findInpElement(type);
    if (known == nullptr) {
      model_.hasOthers = true;
      model_.remark(card.place,
                    fmt::format("*ELEMENT, TYPE={}: left out, no cell here is equal", deck::shortened(type)));
      return;
    }
    if (known->remark[0] != '\0' && told_.insert(known->name).second)
      model_.remark(card.place, fmt::format("*ELEMENT, TYPE={}: {}", type, known->remark));
    InpLines lines(card);
    for (InpLine line; lines.next(line);) {
      const long long id = inpInteger(line.at(0), line.place, "number of an element", 1, mostId);
      const InpPlace place = line.place;
      const int position = static_cast<int>(model_.elements.size());
      if (!model_.elementAt.emplace(id, position).second)
        place.fail(fmt::format("element {} is there already", id));
      model_.elementIds.push_back(id);
      model_.elements.push_back({known, model_.connectivity.size(), -1, setPlace});
      count(static_cast<std::size_t>(known->nodes), place);
      for (int n = 0, field = 1; n < known->nodes; ++field) {
        const bool atEnd = field >= static_cast<int>(line.fields.size()) ||
                           (field + 1 == static_cast<int>(line.fields.size()) && line.fields.back().empty());
        if (atEnd) {  // goes on in the next line
          if (!lines.next(line))
            place.fail(fmt::format("element {} has {} nodes; {} has {}", id, n, type, known->nodes));
          field = -1;
          continue;
        }
        const long long node =
            inpInteger(line.at(static_cast<std::size_t>(field)), line.place, "number of a node", 1, mostId);
        const auto found = model_.nodeAt.find(node);
        if (found == model_.nodeAt.end())
          line.place.fail(fmt::format("element {} has node {}, which is not there", id, node));
        model_.connectivity.push_back(found->second);
        ++n;
      }
      if (set != nullptr) add(*set, position, place);
    }
  }

  std::vector<int>& elementSet(const InpCard& card) {
    std::vector<int>& set = model_.elementSets[nameOf(card, "ELSET")];
    if (model_.elementSetPlaces.size() < model_.elementSets.all().size())
      model_.elementSetPlaces.push_back(card.place);
    return set;
  }

  void readSet(const InpCard& card) {
    if (card.keyword == "NSET") {
      std::vector<int>& set = model_.nodeSets[nameOf(card, "NSET")];
      if (const std::string* of = card.find("ELSET")) return readNodesOf(card, inpName(*of), set);
      readList(card, model_.nodeAt, model_.nodeIds.size(), model_.nodeSets, "node", set);
    } else if (card.keyword == "ELSET") {
      readList(card, model_.elementAt, model_.elementIds.size(), model_.elementSets, "element",
               elementSet(card));
    }
  }

  std::string nameOf(const InpCard& card, const char* parameter) const {
    const std::string* name = card.find(parameter);
    if (name == nullptr || inpName(*name).empty())
      card.place.fail(fmt::format("*{}: has no name; expected {}=name", card.keyword, parameter));
    return inpName(*name);
  }

  void readNodesOf(const InpCard& card, const std::string& elementSet, std::vector<int>& nodes) {
    const std::vector<int>* const elements = model_.elementSets.find(elementSet);
    if (elements == nullptr)
      card.place.fail(fmt::format("*NSET: there is no element set '{}'", deck::shortened(elementSet)));
    for (const int e : *elements) {
      const InpElement& element = model_.elements[static_cast<std::size_t>(e)];
      for (int n = 0; n < element.type->nodes; ++n)
        add(nodes, model_.connectivity[element.firstNode + static_cast<std::size_t>(n)], card.place);
    }
    inpMakeSet(nodes);
  }

  template <class Sets>
  void readList(const InpCard& card, const std::unordered_map<long long, int>& at, std::size_t numItems,
                const Sets& sets, const char* what, std::vector<int>& result) {
    const bool generate = card.has("GENERATE");
    std::size_t missing = 0;
    long long firstMissing = 0;
    std::vector<int> found;  // `result` may be among the sets
    InpLines lines(card);
    for (InpLine line; lines.next(line);) {
      if (generate) {
        const long long first = inpInteger(line.at(0), line.place, what, 1, mostId),
                        last =
                            line.at(1).empty() ? first : inpInteger(line.at(1), line.place, what, 1, mostId),
                        step = line.at(2).empty() ? 1 : inpInteger(line.at(2), line.place, "step", 1, mostId);
        count(std::min<std::size_t>(numItems, static_cast<std::size_t>(std::max(0LL, last - first) / step)),
              line.place);
        if ((last - first) / step > static_cast<long long>(numItems)) {  // most of them are not there
          for (const auto& [id, position] : at)
            if (id >= first && id <= last && (id - first) % step == 0) add(found, position, line.place);
          continue;
        }
        for (long long id = first; id <= last; id += step)
          if (const auto item = at.find(id); item != at.end()) add(found, item->second, line.place);
        continue;
      }
      for (const std::string_view field : line.fields) {
        if (field.empty()) continue;
        if (!isInteger(field)) {
          const auto* const set = sets.find(inpName(field));
          if (set == nullptr)
            line.place.fail(
                fmt::format("there is no {} set '{}'", what, deck::shortened(std::string(field))));
          count(set->size(), line.place);
          found.insert(found.end(), set->begin(), set->end());
          continue;
        }
        const long long id = inpInteger(field, line.place, what, 1, mostId);
        if (const auto item = at.find(id); item != at.end()) {
          add(found, item->second, line.place);
        } else if (missing++ == 0) {
          firstMissing = id;
        }
      }
    }
    if (missing > 0)
      model_.remark(card.place,
                    fmt::format("*{}: {} {}{} left out that the mesh does not have, first {}", card.keyword,
                                missing, what, missing > 1 ? "s" : "", firstMissing));
    result.insert(result.end(), found.begin(), found.end());
    count(result.size(), card.place);  // sorting it takes time
    inpMakeSet(result);
  }

  void add(std::vector<int>& set, int item, const InpPlace& place) {
    count(1, place);
    set.push_back(item);
  }

  void count(std::size_t entries, const InpPlace& place) {
    entries_ += entries;
    if (entries_ > mostEntries)
      place.fail(fmt::format("sets and elements have more than {} entries together, which is the most",
                             mostEntries));
  }

  void readRest(const InpCard& card) {
    const std::string& k = card.keyword;
    static const std::set<std::string> read{"NODE",    "ELEMENT",  "NSET",        "ELSET",    "PART",
                                            "ENDPART", "INSTANCE", "ENDINSTANCE", "ASSEMBLY", "ENDASSEMBLY"};
    if (read.count(k) > 0) return;
    if (k == "HEADING") return readTitle(card);
    if (k == "SURFACE") return readSurface(card);
    if (k == "SOLIDSECTION" || k == "SHELLSECTION" || k == "MEMBRANESECTION") return readSection(card);
    if (k == "RIGIDBODY") return readRigidBody(card);
    if (k == "TIE" || k == "EQUATION") return;  // when all surfaces are there, and nodes that ties make one
    if (k == "BOUNDARY") return model_.boundaries.push_back(&card);
    if (k == "MATERIAL") {
      material_ = &model_.materials[nameOf(card, "NAME")];
      material_->place = card.place;
      return;
    }
    if (k == "ELASTIC" || k == "HYPERELASTIC" || k == "PLASTIC" || k == "DENSITY") {
      if (material_ == nullptr) card.place.fail(fmt::format("*{}: is before the first *MATERIAL", k));
      return material_->cards.push_back(&card);
    }
    if (k == "TRANSFORM") return model_.transforms.push_back(&card);
    model_.remark(card.place, fmt::format("*{}: left out", deck::shortened(k)));
  }

  void readRigidBody(const InpCard& card) {
    InpRigidBody body;
    body.place = card.place;
    for (const char* set : {"NSET", "TIENSET", "PINNSET"})
      if (const std::string* name = card.find(set)) {
        const auto nodes = inpNodes(model_, *name, card.place);
        body.nodes.insert(body.nodes.end(), nodes.begin(), nodes.end());
      }
    if (const std::string* name = card.find("ELSET"))
      for (const int e : inpElements(model_, *name, card.place)) {
        const InpElement& element = model_.elements[static_cast<std::size_t>(e)];
        const int* nodes = &model_.connectivity[element.firstNode];
        body.nodes.insert(body.nodes.end(), nodes, nodes + element.type->nodes);
      }
    count(body.nodes.size(), card.place);
    inpMakeSet(body.nodes);
    if (body.nodes.empty())
      return model_.remark(card.place, "*RIGID BODY: left out, no NSET or ELSET names nodes that it has");
    if (card.has("PINNSET"))
      model_.remark(card.place, "*RIGID BODY, PIN NSET: directors of shells there turn with the body");
    const auto single = [&](const char* parameter) {
      const std::string* name = card.find(parameter);
      if (name == nullptr) return -1;
      const auto nodes = inpNodes(model_, *name, card.place);
      if (nodes.size() != 1)
        card.place.fail(
            fmt::format("*RIGID BODY, {}: names {} nodes; expected one", parameter, nodes.size()));
      return nodes.front();
    };
    body.reference = single("REFNODE");
    body.rotation = single("ROTNODE");
    model_.rigidBodies.push_back(std::move(body));
  }

  void readTitle(const InpCard& card) {
    InpLine line;
    if (!InpLines(card).next(line)) return;
    for (const std::string_view field : line.fields)
      model_.title += (model_.title.empty() ? "" : ", ") + std::string(field);
  }

  void readSurface(const InpCard& card) {
    const std::string name = nameOf(card, "NAME"), type = card.word("TYPE", "ELEMENT");
    InpLines lines(card);
    if (type == "NODE") {
      std::vector<int>& nodes = model_.nodeSets[name];
      for (InpLine line; lines.next(line);)
        for (const int node : inpNodes(model_, line.at(0), line.place)) add(nodes, node, line.place);
      return inpMakeSet(nodes);
    }
    if (type != "ELEMENT")
      return model_.remark(card.place, fmt::format("*SURFACE, TYPE={}: left out; known are ELEMENT and NODE",
                                                   deck::shortened(type)));
    auto& faces = model_.surfaces[name];
    std::set<std::pair<int, int>> seen;
    for (InpLine line; lines.next(line);) {
      const bool isFree = line.at(1).empty();  // faces of one element alone
      if (isFree) countFaces();
      for (const int e : inpElements(model_, line.at(0), line.place)) {
        const fem::Topology topology = model_.elements[static_cast<std::size_t>(e)].type->topology;
        if (isFree) {
          if (fem::isShell(topology))
            line.place.fail("a surface of shells has no face; expected SPOS, SNEG, E1, ...");
          for (int side = 0; side < fem::numSides(topology); ++side)
            if (faces_.at(corners(e, side)) == 1 && seen.insert({e, side}).second) faces.push_back({e, side});
          continue;
        }
        const auto side = inpFace(topology, line.at(1));
        if (!side)
          line.place.fail(fmt::format("element {} has no face '{}'",
                                      model_.elementIds[static_cast<std::size_t>(e)],
                                      deck::shortened(std::string(line.at(1)))));
        count(1, line.place);
        if (seen.insert({e, *side}).second) faces.push_back({e, *side});
      }
    }
  }

  std::array<int, 4> corners(int element, int side) const {
    const std::vector<int> all = inpFaceNodes(model_, {element, side});
    const std::size_t count = fem::isPlane(model_.elements[static_cast<std::size_t>(element)].type->topology)
                                  ? 2
                              : all.size() == 3 || all.size() == 6 ? 3
                                                                   : 4;
    std::array<int, 4> nodes{-1, -1, -1, -1};
    for (std::size_t i = 0; i < count; ++i) nodes[i] = all[i];
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }

  void countFaces() {
    if (!faces_.empty()) return;
    for (int e = 0; e < static_cast<int>(model_.elements.size()); ++e) {
      const fem::Topology topology = model_.elements[static_cast<std::size_t>(e)].type->topology;
      if (fem::isShell(topology)) continue;
      for (int side = 0; side < fem::numSides(topology); ++side) ++faces_[corners(e, side)];
    }
  }

  void readSection(const InpCard& card) {
    InpSection section{card.place, card.keyword, nameOf(card, "ELSET"), {}, 0};
    const std::string* material = card.find("MATERIAL");
    if (material != nullptr) section.material = inpName(*material);
    for (const char* more : {"COMPOSITE", "ORIENTATION", "OFFSET", "NODALTHICKNESS", "STIFFNESSMATRIX"})
      if (const std::string* value = card.find(more); value != nullptr && !isZero(*value))
        model_.remark(card.place, fmt::format("*{}: {} is left out", card.keyword, more));
    InpLine line;
    if (!card.has("COMPOSITE") && InpLines(card).next(line)) {
      section.thickness = inpNumber(line.at(0), line.place, "thickness or area");
      if (section.thickness < 0) line.place.fail("the thickness or area is negative");
    }
    model_.sections.push_back(std::move(section));
  }

  static bool isZero(const std::string& value) {
    return !value.empty() && value.find_first_not_of("0.+-") == std::string::npos;
  }

  void assignSections() {
    for (std::size_t s = 0; s < model_.sections.size(); ++s) {
      const InpSection& section = model_.sections[s];
      const std::vector<int>* const elements = model_.elementSets.find(section.set);
      if (elements == nullptr) {
        model_.remark(section.place, fmt::format("*{}: left out, nothing is in its element set '{}'",
                                                 section.keyword, deck::shortened(section.set)));
        continue;
      }
      for (const int e : *elements)
        model_.elements[static_cast<std::size_t>(e)].section = static_cast<int>(s);
    }
  }

  const InpSource& source_;
  std::vector<const InpCard*> cards_;             ///< before the steps
  std::set<std::string> told_;                    ///< element types that were remarked
  std::unordered_map<std::string, bool> scopes_;  ///< of sets: whether they are in a part
  std::map<std::array<int, 4>, int> faces_;       ///< corners of faces, ascending: elements that have it
  std::size_t entries_ = 0;
  InpMaterial* material_ = nullptr;
  InpModel model_;
};

std::vector<int> itemsOf(const std::unordered_map<long long, int>& at, const InpNamed<std::vector<int>>& sets,
                         std::string_view field, const InpPlace& place, const char* what) {
  if (isInteger(field)) {
    const long long id = inpInteger(field, place, what, 1, mostId);
    const auto item = at.find(id);
    if (item == at.end()) place.fail(fmt::format("there is no {} {}", what, id));
    return {item->second};
  }
  const std::vector<int>* const set = sets.find(inpName(field));
  if (set == nullptr)
    place.fail(fmt::format("there is no {} set '{}'", what, deck::shortened(std::string(field))));
  return *set;
}

}  // namespace

InpModel readInpModel(const InpSource& source) { return ModelReader(source)(); }

std::vector<int> inpNodes(const InpModel& model, std::string_view field, const InpPlace& place) {
  return itemsOf(model.nodeAt, model.nodeSets, field, place, "node");
}

std::vector<int> inpElements(const InpModel& model, std::string_view field, const InpPlace& place) {
  if (model.hasOthers && isInteger(field) &&
      model.elementAt.count(inpInteger(field, place, "element", 1, mostId)) == 0)
    return {};
  return itemsOf(model.elementAt, model.elementSets, field, place, "element");
}

std::vector<int> inpFaceNodes(const InpModel& model, const InpFace& face) {
  const InpElement& e = model.elements[static_cast<std::size_t>(face.element)];
  const auto& order = inpNodeOrder(e.type->topology);
  std::vector<int> nodes;
  for (const int local : fem::sideNodes(e.type->topology, face.side))
    nodes.push_back(
        model.connectivity[e.firstNode + static_cast<std::size_t>(order[static_cast<std::size_t>(local)])]);
  return nodes;
}

std::optional<int> inpFace(fem::Topology topology, std::string_view label) {
  const std::string word = inCapitals(label);
  int face = -1;
  if (word == "SPOS" || word == "SNEG") {
    if (fem::isShell(topology)) face = word == "SNEG" ? 0 : 1;
  } else if (word.size() == 2 && word[1] >= '1' && word[1] <= '6') {
    if (word[0] == 'S' || word[0] == 'P') face = word[1] - '1';
    if (word[0] == 'E' && fem::isShell(topology)) face = word[1] - '1' + 2;
  }
  const int side = inpSide(topology, face);
  return side >= 0 ? std::optional<int>(side) : std::nullopt;
}

void inpMakeSet(std::vector<int>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

std::string inpName(std::string_view field) {
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
    field = field.substr(1, field.size() - 2);
  return std::string(field);
}

}  // namespace atrapos::importer
