#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "import/InpElements.hpp"
#include "import/InpSource.hpp"

namespace atrapos::importer {

/// Named lists in the order of the file; names compare without regard to case.
template <class Item>
class InpNamed {
 public:
  /// The item of this name, made where there is none.
  Item& operator[](const std::string& name) {
    const auto [at, isNew] = place_.emplace(inCapitals(name), items_.size());
    if (isNew) items_.push_back({name, {}});
    return items_[at->second].second;
  }
  /// Null where there is none. Names may have that of an instance before a point.
  const Item* find(const std::string& name) const {
    const int at = position(name);
    return at < 0 ? nullptr : &items_[static_cast<std::size_t>(at)].second;
  }
  int position(const std::string& name) const {
    auto at = place_.find(inCapitals(name));
    if (const std::size_t point = name.rfind('.'); at == place_.end() && point != std::string::npos)
      at = place_.find(inCapitals(std::string_view(name).substr(point + 1)));
    return at == place_.end() ? -1 : static_cast<int>(at->second);
  }
  /// [position]: name as first written, and item.
  const std::vector<std::pair<std::string, Item>>& all() const { return items_; }
  std::vector<std::pair<std::string, Item>>& all() { return items_; }

 private:
  std::vector<std::pair<std::string, Item>> items_;
  std::unordered_map<std::string, std::size_t> place_;
};

struct InpElement {
  const InpElementType* type;
  std::size_t firstNode;  ///< position in InpModel::connectivity, in the file's order
  int section = -1;       ///< position in InpModel::sections
  int set = -1;           ///< that it was defined in, position among the element sets; -1: none
};

/// A face of an element, or an edge of a plane one.
struct InpFace {
  int element;  ///< position
  int side;     ///< 0-based, Exodus' order
};

struct InpSection {
  InpPlace place;
  std::string keyword;  ///< "SOLIDSECTION", "SHELLSECTION"
  std::string set, material;
  double thickness = 0;  ///< of bars the area; 0: none given
};

struct InpMaterial {
  InpPlace place;
  std::vector<const InpCard*> cards;  ///< *ELASTIC and so on
};

/// *RIGID BODY: nodes that keep their places to each other.
struct InpRigidBody {
  InpPlace place;
  std::vector<int> nodes;  ///< positions
  int reference = -1;      ///< node that leads; -1: none
  int rotation = -1;  ///< node whose components 1 to 3 are the body's turns; -1: 4 to 6 of the reference are
};

/// *TIE of surfaces whose meshes do not fit, by names.
struct InpTied {
  std::string follows, leads;  ///< surfaces
};

/// *EQUATION: the sum of factors times displacements is 0.
struct InpEquation {
  struct Term {
    std::vector<int> nodes;  ///< positions; as many as those of the first term, or one
    int component = 0;       ///< 0 to 2
    double factor = 1;
  };
  InpPlace place;
  std::vector<Term> terms;
};

/// The part of an input file before its steps, elements and nodes by their position.
struct InpModel {
  const std::string* file = nullptr;  ///< of the first card
  std::string title;
  std::vector<long long> nodeIds, elementIds;
  std::unordered_map<long long, int> nodeAt, elementAt;  ///< positions by id
  std::vector<double> coordinates;                       ///< [node][x y z]
  std::vector<int> connectivity;                         ///< nodes' positions
  std::vector<InpElement> elements;
  bool hasOthers = false;                            ///< elements that were left out: no cell is equal
  InpNamed<std::vector<int>> nodeSets, elementSets;  ///< positions, ascending
  std::vector<InpPlace> elementSetPlaces;            ///< where each of elementSets begins
  InpNamed<std::vector<InpFace>> surfaces;
  std::vector<InpSection> sections;
  InpNamed<InpMaterial> materials;
  std::vector<InpRigidBody> rigidBodies;
  int ties = 0;               ///< pairs of surfaces in *TIE
  std::vector<InpTied> tied;  ///< of them
  std::vector<InpEquation> equations;
  std::size_t equationNodes = 0;           ///< in the terms of *EQUATION
  std::vector<const InpCard*> boundaries;  ///< *BOUNDARY before the first step
  std::vector<const InpCard*> transforms;  ///< *TRANSFORM
  std::vector<const InpCard*> steps;       ///< from the first *STEP on
  std::vector<std::string> remarks;
  std::size_t moreRemarks = 0;

  /// The first 10 000 are kept, of the others their number.
  void remark(const InpPlace& place, const std::string& what) { remark(place.text() + ": " + what); }
  void remark(const std::string& line) {
    constexpr std::size_t most = 10000;
    if (remarks.size() < most)
      remarks.push_back(line);
    else
      ++moreRemarks;
  }
};

/// What the cards before the steps say. Throws Error.
InpModel readInpModel(const InpSource& source);

/// Positions of what a field of data names: an element or node by its id, or a set. Throws Error where there
/// is neither; nothing for an element that may be one of those left out.
std::vector<int> inpNodes(const InpModel& model, std::string_view field, const InpPlace& place);
std::vector<int> inpElements(const InpModel& model, std::string_view field, const InpPlace& place);

/// The nodes of a face, positions.
std::vector<int> inpFaceNodes(const InpModel& model, const InpFace& face);

/// The face that a label names (S1, P2, SPOS, ...) of an element, its side in Exodus' order; nothing where it
/// has none of this name.
std::optional<int> inpFace(fem::Topology topology, std::string_view label);

/// In ascending order, each once.
void inpMakeSet(std::vector<int>& items);

/// The name without quotes.
std::string inpName(std::string_view field);

}  // namespace atrapos::importer
