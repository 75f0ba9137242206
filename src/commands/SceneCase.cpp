#include "commands/SceneCase.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "atrapos/linear/OnAllRanks.hpp"
#include "machine/Memory.hpp"
#include "output/FieldFiles.hpp"
#include "restart/RunProblem.hpp"
#include "scene/ContactEvents.hpp"
#include "scene/Locking.hpp"
#include "scene/Sharpen.hpp"

namespace atrapos {

namespace {

/// Whether there is plastic strain in one of the material's blocks: at a smoothed yield surface, of which
/// something flows at any stress, by what counts beside elastic strains.
bool hasYielded(const Scene& scene, const deck::Material& material, const SceneState& state) {
  const auto& law = std::get<deck::VonMises>(material.law);
  const double counts = law.yieldWidth > 0 ? 1e-3 * law.yieldStress / law.youngsModulus : 0;
  for (const std::string& name : material.blocks) {
    const fem::PointValues& values = state.observed(scene.bodies()[fem::findBlock(scene.mesh(), name)].term);
    const auto at = std::find(values.names.begin(), values.names.end(), "equivalent_plastic_strain");
    if (at == values.names.end()) continue;
    const std::size_t width = values.names.size();
    for (std::size_t i = at - values.names.begin(); i < values.values.size(); i += width)
      if (values.values[i] > counts) return true;
  }
  return false;
}

}  // namespace

int SceneCaseState::activeContacts() const {
  int active = 0;
  for (const ContactPoints& contact : scene_.contacts())
    active += scene_.contactState(contact, state_).active;
  return active;
}

void SceneCaseState::strikeUsed(Costs& costs) const {
  if (costs.empty()) return;
  for (const ContactPoints& contact : scene_.contacts())
    if (const auto at = costs.find("contact/" + contact.name);
        at != costs.end() && scene_.contactState(contact, state_).active > 0)
      costs.erase(at);
  for (const deck::Material& material : scene_.deck().materials)
    if (const auto at = costs.find("materials/" + material.name);
        at != costs.end() && hasYielded(scene_, material, state_))
      costs.erase(at);
}

Costs SceneCase::costs() const {
  Costs costs;
  for (const ContactPoints& contact : scene_.contacts())
    costs["contact/" + contact.name] = "none of its points has closed";
  for (const deck::Material& material : scene_.deck().materials)
    if (std::holds_alternative<deck::VonMises>(material.law))
      costs["materials/" + material.name] =
          "has not yielded; without yielding the same path takes less time and memory";
  return costs;
}

path::State SceneCase::start() const { return {scene_.problem().initialState(0.0), 0.0}; }

MeshDigest SceneCase::meshDigest() const { return digestOf(scene_.mesh()); }

std::unique_ptr<FieldFile> SceneCase::makeFieldFile(const std::string& file) const {
  return makeSceneFields(scene_, file);
}

std::unique_ptr<StepWatch> SceneCase::makeWatch(const std::string& file, bool append) const {
  if (scene_.contacts().empty()) return nullptr;
  return std::make_unique<ContactEvents>(scene_, file, append);
}

std::unique_ptr<PathCase> SceneCase::moved(const path::Vector& shape, double size) const {
  const auto values = linear::onAllRanks(shape);
  fem::Mesh mesh = scene_.mesh();
  // Three unknowns a node of the mesh come first, then those of directors and rigid bodies.
  std::vector<double>& x = mesh.coordinates;
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::abs(values[i]) > std::abs(largest)) largest = values[i];
  if (largest == 0) throw std::runtime_error("path/imperfections: the mode moves no node");
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += size / largest * values[i];
  return std::make_unique<SceneCase>(
      std::make_unique<Scene>(scene_.deck(), DeckMesh(std::move(mesh), scene_.givenRanks())));
}

std::unique_ptr<PathCase> SceneCase::under(const deck::Deck& deck, const path::State& start) const {
  // What is free in this stage only must not choose another law: states go on.
  deck::Deck same = deck;
  same.contacts = scene_.deck().contacts;
  auto scene = std::make_unique<Scene>(same, DeckMesh(fem::Mesh(scene_.mesh()), scene_.givenRanks()));
  scene->grow(start);
  scene->problem().beginAt(start);
  return std::make_unique<SceneCase>(std::move(scene));
}

std::vector<std::string> SceneCase::remarks() const {
  std::vector<std::string> lines = scene_.remarks();
  for (const ContactPoints& contact : scene_.contacts())
    lines.push_back(fmt::format("contact {}: {}", contact.name, contact.pressure.text));
  for (const std::string& line : lockingCells(scene_.deck(), scene_.mesh()))
    lines.push_back("warning: " + line);
  return lines;
}

bool SceneCase::changedOn(double length, const path::Series& series) {
  if (!scene_.contactsGrow()) return false;
  constexpr int places = 8;
  bool changed = false;
  for (int j = 1; j <= places; ++j) {
    const path::State state = series.state(length * j / places);
    if (!scene_.othersAreNear(state)) continue;
    changed = true;
    scene_.grow(state);
  }
  takenBack_ += changed ? 1 : 0;
  return changed;
}

void SceneCase::summarize(nlohmann::ordered_json& summary) const {
  auto contacts = nlohmann::ordered_json::object();
  for (const ContactPoints& contact : scene_.contacts()) {
    auto& entry = contacts[contact.name];
    entry["law"] = contact.pressure.text;
    for (const auto& [name, value] : contact.pressure.numbers) entry[name] = value;
    entry["points"] = contact.count;
    entry["points_carried"] = contact.numCarried();
  }
  summary["contacts"] = contacts;
  summary["steps_taken_back"] = takenBack_;
}

std::string SceneCase::finish(const path::State& end, const path::Options& options,
                              linear::TangentSolver& solver, const std::string& directory,
                              nlohmann::ordered_json& summary) {
  if (!scene_.deck().path.sharpen) return {};
  const auto names = scene_.monitorNames();
  const Sharpened sharpened =
      sharpen(scene_, end, *scene_.deck().path.sharpen, options, solver, directory + "/sharpen.csv");
  auto& entry = summary["sharpened"];
  entry["reached"] = sharpened.reached;
  if (!sharpened.reached) entry["why"] = sharpened.text;
  entry["factor"] = sharpened.factor;
  entry["steps"] = sharpened.steps;
  for (std::size_t m = 0; m < names.size(); ++m) entry["monitors"][names[m]] = sharpened.monitors[m];
  return fmt::format("eta times {:.3g} in {} steps{}{}", sharpened.factor, sharpened.steps,
                     sharpened.reached ? "" : ": ", sharpened.text);
}

double SceneCase::historyBytes() {
  return static_cast<double>(scene_.problem().historyBytes(historyOrder(scene_.deck().path)));
}

std::vector<std::pair<std::string, long long>> SceneCase::sizes() const {
  return {{"nodes", scene_.mesh().numNodes()},
          {"elements", scene_.mesh().numElements()},
          {"unknowns", scene_.numUnknowns()},
          {"free_unknowns", scene_.problem().numFreeDofs()},
          {"contact_points", scene_.numContactPoints()},
          {"series_bytes", static_cast<long long>(scene_.problem().historyBytes(scene_.deck().path.order))}};
}

}  // namespace atrapos
