#include "import/InpDeck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "deck/Characters.hpp"
#include "deck/Fields.hpp"
#include "import/DeckText.hpp"
#include "import/Import.hpp"
#include "import/InpMaterials.hpp"
#include "import/InpTransforms.hpp"
#include "import/ShellSupports.hpp"

namespace atrapos::importer {
namespace {

constexpr std::size_t mostMonitors = 12;
constexpr std::size_t mostDirections = 1000;  // each is an entry of the deck

class DeckMaker {
 public:
  DeckMaker(InpModel& model, const InpStep& step, const InpRigidMotions& rigid, InpMesh& mesh)
      : model_(model), step_(step), rigid_(rigid), transforms_(model), mesh_(mesh) {}

  std::string operator()() {
    addMaterials();
    if (mesh_.mesh.dimension == 2) addPlane();
    addThin(Family::membrane, "thickness", membranes_);
    addThin(Family::bar, "area", bars_);
    addCouplings();  // whose sets have names of their own
    addSupports();
    addForces();
    addPressures();
    addVolumeLoads();
    if (!loaded_)
      throw Error(fmt::format(
          "{}: the step has no load that a deck can have; expected *CLOAD, *DLOAD, *DSLOAD or a *BOUNDARY "
          "that is not 0",
          step_.place.text()));
    addPath();
    return text();
  }

 private:
  int dimension() const { return mesh_.mesh.dimension; }
  const InpSection* sectionOf(int e) const {
    const int s = model_.elements[static_cast<std::size_t>(e)].section;
    return s < 0 ? nullptr : &model_.sections[static_cast<std::size_t>(s)];
  }

  void addMaterials() {
    std::map<std::size_t, std::set<int>> blocksOf;  // by the material's place
    std::map<std::size_t, bool> finite;             // whether metals may have large strains
    for (std::size_t e = 0; e < model_.elements.size(); ++e) {
      const InpSection* const section = sectionOf(static_cast<int>(e));
      const int material = section == nullptr ? -1 : model_.materials.position(section->material);
      if (material < 0)
        throw Error(fmt::format("{}: element {} has no section with a material, which a deck needs",
                                section == nullptr ? *model_.file : section->place.text(),
                                model_.elementIds[e]));
      blocksOf[static_cast<std::size_t>(material)].insert(mesh_.blockAt[e]);
      const Family family = model_.elements[e].type->family;
      const bool massive =
          family == Family::solid || family == Family::planeStrain || family == Family::axisymmetric;
      const auto at = finite.emplace(static_cast<std::size_t>(material), step_.nonlinearGeometry).first;
      at->second = at->second && massive;
    }
    for (const auto& [place, blocks] : blocksOf) {
      const std::string& name = model_.materials.all()[place].first;
      std::vector<std::string> names;
      for (const int b : blocks) names.push_back(mesh_.mesh.blocks[static_cast<std::size_t>(b)].name);
      materials_.add(name, fmt::format("{}, blocks: {}", inpLaw(model_, name, finite[place]), listOf(names)));
    }
  }

  /// The blocks of membranes or bars, an entry for each thickness or area.
  void addThin(Family family, const char* key, DeckEntries& entries) {
    std::map<double, std::set<int>> blocksOf;
    for (std::size_t e = 0; e < model_.elements.size(); ++e) {
      if (model_.elements[e].type->family != family) continue;
      const InpSection& section = *sectionOf(static_cast<int>(e));  // addMaterials has seen it
      if (!(section.thickness > 0)) section.place.fail(fmt::format("has no {}, which a deck needs", key));
      blocksOf[section.thickness].insert(mesh_.blockAt[e]);
    }
    for (const auto& [size, blocks] : blocksOf) {
      std::vector<std::string> names;
      for (const int b : blocks) names.push_back(mesh_.mesh.blocks[static_cast<std::size_t>(b)].name);
      entries.add(names.front(), fmt::format("blocks: {}, {}: {}", listOf(names), key, size));
    }
  }

  void addPlane() {
    const Family family = model_.elements.front().type->family;
    std::set<double> thicknesses;
    for (std::size_t e = 0; e < model_.elements.size(); ++e)
      if (const InpSection* s = sectionOf(static_cast<int>(e)))
        thicknesses.insert(s->thickness > 0 ? s->thickness : 1);
    if (family == Family::axisymmetric) {
      plane_ = "plane: {kind: axisymmetric}\n";
      return;
    }
    if (thicknesses.size() > 1)
      throw Error(fmt::format("{}: sections of plane elements have thicknesses {} and {}; a deck has one",
                              *model_.file, *thicknesses.begin(), *thicknesses.rbegin()));
    plane_ = fmt::format("plane: {{kind: {}, thickness: {}}}\n",
                         family == Family::planeStress ? "stress" : "strain", *thicknesses.begin());
  }

  void addSupports() {
    const ShellSupports shells(model_);
    std::map<std::string, std::pair<std::vector<int>, std::set<int>>>
        groups;  // keys: nodes, components that move
    for (auto [node, support] : step_.supports) {
      if (mesh_.nodeAt[static_cast<std::size_t>(node)] < 0) {
        tellOnce(support.place, "*BOUNDARY: left out for nodes that no element of the mesh has");
        continue;
      }
      addAlongOwnAxes(node, support);
      std::set<int> moving;
      const std::string keys = keysOf(node, support, shells, moving);
      if (keys.empty()) continue;
      auto& group = groups[keys];
      group.first.push_back(node);
      group.second = moving;
    }
    addInclined();
    for (const auto& [keys, group] : groups) {
      const std::string set = mesh_.nodeSet(group.first, fmt::format("support_{}", supports_.size() + 1));
      const std::string name = supports_.add(set, fmt::format("set: {}, {}", deck::yaml(set), keys));
      for (const int component : group.second) {
        loaded_ = true;
        monitor(name + "_force_" + "xyz"[component],
                fmt::format("type: reaction, support: {}, component: {}", name, "xyz"[component]));
      }
    }
    if (supports_.size() == 0)
      throw Error(
          fmt::format("{}: has no *BOUNDARY for nodes of the mesh, which a deck needs", *model_.file));
  }

  /// Takes what is held along a node's own axes (*TRANSFORM) from its support.
  void addAlongOwnAxes(int node, InpSupport& support) {
    const InpTransforms::Axes* const axes = transforms_.find(node);
    if (axes == nullptr) return;
    InpSupport own;
    std::copy(support.value.begin() + 3, support.value.end(), own.value.begin() + 3);
    for (std::size_t d = 0; d < 3; ++d) {
      const InpTransforms::Vector& along = (*axes)[d];
      if (!support.value[d]) continue;
      const auto axis =
          std::find_if(along.begin(), along.end(), [](double x) { return std::abs(x) > 1 - 1e-12; });
      if (axis != along.end()) {  // one of the model
        own.value[static_cast<std::size_t>(axis - along.begin())] = std::round(*axis) * *support.value[d];
        continue;
      }
      inclined_[{along, *support.value[d]}].push_back(node);
      if (inclined_.size() > mostDirections)
        support.place.fail(fmt::format(
            "*TRANSFORM: supports along more than {} directions, which is the most", mostDirections));
    }
    support.value = own.value;
    const auto held = std::count_if(support.value.begin() + 3, support.value.end(),
                                    [](const auto& v) { return v.has_value(); });
    if (held == 1 || held == 2) {
      tellOnce(support.place,
               "*BOUNDARY: rotations about axes of *TRANSFORM are left out, but for all three");
      std::fill(support.value.begin() + 3, support.value.end(), std::nullopt);
    }
  }

  void addInclined() {
    for (const auto& [along, nodes] : inclined_) {
      const auto& [direction, value] = along;
      const std::string set = mesh_.nodeSet(nodes, fmt::format("support_{}", supports_.size() + 1));
      if (set.empty()) continue;
      std::string keys = fmt::format("set: {}, normal: [{:.12g}, {:.12g}, {:.12g}]", deck::yaml(set),
                                     direction[0], direction[1], direction[2]);
      if (value != 0) keys += fmt::format(", value: {{per_load_factor: {}}}", value);
      const std::string name = supports_.add(set, keys);
      if (value == 0) continue;
      loaded_ = true;
      monitor(name + "_force", fmt::format("type: reaction, support: {}", name));
    }
  }

  /// What a deck says of this node's support.
  std::string keysOf(int node, const InpSupport& support, const ShellSupports& shells,
                     std::set<int>& moving) {
    std::string keys;
    const auto add = [&](const std::string& key) { keys += (keys.empty() ? "" : ", ") + key; };
    for (int d = 0; d < dimension(); ++d)
      if (const auto value = support.value[static_cast<std::size_t>(d)]) {
        if (*value != 0) moving.insert(d);
        add(*value == 0 ? fmt::format("{}: 0", "xyz"[d])
                        : fmt::format("{}: {{per_load_factor: {}}}", "xyz"[d], *value));
      }
    if (!shells.has(node)) return keys;  // no other node has rotations
    for (std::size_t d = 3; d < 6; ++d)
      if (support.value[d] && *support.value[d] != 0)
        tellOnce(support.place, "*BOUNDARY: a rotation that is not 0 is taken for 0");
    const auto directors = shells.heldDirectors(node, support);
    if (!directors)
      tellOnce(support.place, "*BOUNDARY: a rotation is left out that is about none of the shell's axes");
    for (const int d : directors.value_or(std::set<int>())) add(fmt::format("director_{}: 0", "xyz"[d]));
    return keys;
  }

  void addCouplings() {
    for (const InpRigidMotions::Coupling& c : rigid_.couplings()) {
      const std::string number = std::to_string(couplings_.size() + 1),
                        set = mesh_.nodeSet(c.nodes, "rigid_" + number);
      if (set.empty()) continue;  // of elements that were left out
      std::string keys = fmt::format("kind: {}, set: {}", c.turns ? "rigid" : "equal", deck::yaml(set));
      if (c.reference >= 0)
        keys += ", reference: " + deck::yaml(mesh_.nodeSet({c.reference}, "reference_" + number));
      if (c.axis >= 0) {
        std::array<int, 3> axis{};
        axis[static_cast<std::size_t>(c.axis)] = 1;
        keys += fmt::format(", axis: [{}, {}, {}]", axis[0], axis[1], axis[2]);
      }
      if (c.angle != 0) keys += fmt::format(", angle: {{per_load_factor: {}}}", c.angle);
      const std::string name = couplings_.add(set, keys);
      if (c.moment != 0)
        loads_.add(name, fmt::format("type: moment, coupling: {}, moment: {}", name, c.moment));
      if (c.axis >= 0) monitor(name + "_angle", fmt::format("type: rotation, coupling: {}", name));
      if (c.angle != 0) monitor(name + "_moment", fmt::format("type: moment, coupling: {}", name));
      loaded_ = loaded_ || c.moment != 0 || c.angle != 0;
    }
    for (const InpEquation& equation : model_.equations) {
      const std::string name = fmt::format("equation_{}", couplings_.size() + 1);
      std::string terms;
      for (const InpEquation::Term& term : equation.terms) {
        const std::string set = mesh_.nodeSet(term.nodes, fmt::format("{}_term", name));
        if (!set.empty())
          terms += fmt::format("{}[{}, {}, {}]", terms.empty() ? "" : ", ", deck::yaml(set),
                               "xyz"[term.component], term.factor);
      }
      couplings_.add(name, fmt::format("kind: equation, terms: [{}]", terms));
    }
    for (const InpTied& tie : model_.tied) {
      const std::string follows = mesh_.sideSet(*model_.surfaces.find(tie.follows), tie.follows),
                        leads = mesh_.sideSet(*model_.surfaces.find(tie.leads), tie.leads);
      if (follows.empty() || leads.empty()) continue;  // of elements that were left out
      couplings_.add(follows,
                     fmt::format("kind: tie, set: {}, to: {}", deck::yaml(follows), deck::yaml(leads)));
    }
  }

  void tellOnce(const InpPlace& place, const std::string& what) {
    if (told_.insert(place.text() + what).second) model_.remark(place, what);
  }

  void addForces() {
    std::map<std::array<double, 3>, std::vector<int>> groups;
    std::size_t lost = 0;
    for (auto [node, force] : step_.forces) {
      if (mesh_.nodeAt[static_cast<std::size_t>(node)] < 0) {
        ++lost;
        continue;
      }
      force = transforms_.inModel(node, force);
      if (dimension() == 2 && force[2] != 0) {
        tellOnce(step_.place, "*CLOAD: forces along z on a plane body are left out");
        force[2] = 0;
      }
      if (force != std::array<double, 3>{}) groups[force].push_back(node);
    }
    if (lost > 0)
      model_.remark(step_.place, fmt::format("*CLOAD: left out for {} node{} that no element of the mesh has",
                                             lost, lost > 1 ? "s" : ""));
    for (const auto& [force, nodes] : groups) {
      const std::string set = mesh_.nodeSet(nodes, fmt::format("force_{}", loads_.size() + 1));
      const std::string vector = fmt::format("[{}, {}, {}]", force[0], force[1], force[2]);
      const std::string name =
          loads_.add(set, fmt::format("type: nodal, set: {}, per_node: {}", deck::yaml(set), vector));
      const auto largest = std::max_element(force.begin(), force.begin() + dimension(),
                                            [](double a, double b) { return std::abs(a) < std::abs(b); });
      monitorDisplacement(name, set, static_cast<int>(largest - force.begin()));
      loaded_ = true;
    }
  }

  void addPressures() {
    std::map<double, std::vector<InpFace>> groups;
    for (const auto& [face, pressure] : step_.pressures)
      if (pressure != 0) groups[pressure].push_back({face.first, face.second});
    const bool follows = step_.nonlinearGeometry && dimension() == 3;
    for (const auto& [pressure, faces] : groups) {
      const std::string set = mesh_.sideSet(faces, fmt::format("pressure_{}", loads_.size() + 1));
      const std::string name =
          loads_.add(set, fmt::format("type: surface, set: {}, pressure: {}{}", deck::yaml(set), pressure,
                                      follows ? ", follower: true" : ""));
      monitorDisplacement(name, set, dimension() - 1);
      loaded_ = true;
    }
    if (!groups.empty() && step_.nonlinearGeometry && !follows)
      model_.remark(step_.place, "NLGEOM: pressures on plane bodies keep their direction here");
  }

  void addVolumeLoads() {
    for (const InpStep::VolumeLoad& load : step_.volumeLoads) {
      // Of one material each: gravity is its density's.
      std::map<int, std::vector<int>> elements;
      for (const int e : load.elements)
        elements[load.byMass ? model_.elements[static_cast<std::size_t>(e)].section : 0].push_back(e);
      for (const auto& [section, members] : elements) {
        auto force = load.force;
        if (load.byMass && section < 0) load.place.fail("gravity acts on elements without a section");
        if (load.byMass)
          for (double& f : force)
            f *= inpDensity(model_, model_.sections[static_cast<std::size_t>(section)].material, load.place);
        if (dimension() == 2 && force[2] != 0) {
          tellOnce(load.place, "*DLOAD: what acts along z on a plane body is left out");
          force[2] = 0;
        }
        if (force == std::array<double, 3>{}) continue;
        loads_.add("volume", fmt::format("type: volume, blocks: {}, force: [{}, {}, {}]",
                                         listOf(mesh_.blocks(members)), force[0], force[1], force[2]));
        loaded_ = true;
      }
    }
  }

  void monitor(const std::string& name, const std::string& keys) {
    if (monitors_.size() < mostMonitors) monitors_.add(name, keys);
  }

  std::string monitorDisplacement(const std::string& of, const std::string& set, int component) {
    return monitors_.size() < mostMonitors
               ? monitors_.add(of + "_u" + "xyz"[component],
                               fmt::format("type: displacement, set: {}, component: {}", deck::yaml(set),
                                           "xyz"[component]))
               : std::string();
  }

  void addPath() {
    std::string stops;
    const auto add = [&](const std::string& stop) { stops += (stops.empty() ? "" : ", ") + stop; };
    switch (step_.procedure) {
      case InpStep::Procedure::statics:
        add("load_factor: 1");
        if (!step_.nonlinearGeometry)
          model_.remark(step_.place,
                        "*STATIC: is linear; the deck's path is of large displacements, its first slope the "
                        "linear answer");
        break;
      case InpStep::Procedure::riks:
        if (step_.loadFactor && *step_.loadFactor != 0)
          add(fmt::format("load_factor: {}", *step_.loadFactor));
        if (const auto& target = step_.displacement;
            target && mesh_.nodeAt[static_cast<std::size_t>(target->node)] >= 0) {
          const std::string set = mesh_.nodeSet({target->node}, "end");
          const std::string name =
              monitors_.add("end", fmt::format("type: displacement, set: {}, component: {}", deck::yaml(set),
                                               "xyz"[target->component]));
          add(fmt::format("displacement: {{{}: {}}}", deck::yaml(name), target->value));
        }
        add(fmt::format("steps: {}", step_.increments));
        break;
      case InpStep::Procedure::buckle:
        add("steps: 30");
        model_.remark(
            step_.place,
            "*BUCKLE: the deck follows the path itself; its bifurcation points are in points.csv, after 30 "
            "steps it ends (path/stop)");
        break;
    }
    path_ = fmt::format("path:\n  stop: {{{}}}\n", stops);
  }

  std::string text() const {
    const std::string title =
        model_.title.empty() ? std::filesystem::path(*model_.file).stem().string() : model_.title;
    std::string result = fmt::format("title: {}\n", deck::yaml(deck::plainLine(deck::beginOf(title, 200))));
    result += "materials:\n" + materials_.text(2) + plane_;
    if (membranes_.size() > 0) result += "membranes:\n" + membranes_.text(2);
    if (bars_.size() > 0) result += "bars:\n" + bars_.text(2);
    result += "supports:\n" + supports_.text(2);
    if (couplings_.size() > 0) result += "couplings:\n" + couplings_.text(2);
    result += "loads:\n" + loads_.text(2);
    if (loads_.size() == 0) result.erase(result.size() - 7);  // driven by supports
    result += path_;
    if (monitors_.size() > 0) result += "output:\n  monitors:\n" + monitors_.text(4);
    return result;
  }

  InpModel& model_;
  const InpStep& step_;
  const InpRigidMotions& rigid_;
  const InpTransforms transforms_;
  InpMesh& mesh_;
  /// By direction and value: nodes that are held along no axis of the model.
  std::map<std::pair<InpTransforms::Vector, double>, std::vector<int>> inclined_;
  std::set<std::string> told_;
  bool loaded_ = false;  ///< something depends on the load factor
  DeckEntries materials_, membranes_, bars_, supports_, couplings_, loads_, monitors_;
  std::string plane_, path_;
};

}  // namespace

std::vector<std::vector<int>> inpCuts(const InpStep& step) {
  std::set<std::vector<int>> cuts;
  for (const InpStep::VolumeLoad& load : step.volumeLoads) cuts.insert(load.elements);
  constexpr std::size_t most = 64;
  if (cuts.size() > most)
    step.place.fail(fmt::format("has loads by volume on {} different element sets; expected at most {}",
                                cuts.size(), most));
  return {cuts.begin(), cuts.end()};
}

std::string inpDeck(InpModel& model, const InpStep& step, const InpRigidMotions& rigid, InpMesh& mesh) {
  return DeckMaker(model, step, rigid, mesh)();
}

}  // namespace atrapos::importer
