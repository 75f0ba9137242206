#include "SceneCase.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "ContactEvents.hpp"
#include "Ranks.hpp"
#include "Sharpen.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "atrapos/exodus/ResultWriter.hpp"

namespace atrapos {
namespace {

const std::vector<std::string> kGlobals = {"load_factor",   "path_parameter",  "series_radius",
                                           "series_order",  "negative_pivots", "active_contacts",
                                           "residual_norm", "branch"};

std::vector<double> flat(const std::vector<std::vector<double>>& variables) {
  std::vector<double> all;
  for (const auto& v : variables) all.insert(all.end(), v.begin(), v.end());
  return all;
}

class SceneFields final : public FieldFile {
 public:
  SceneFields(const SceneCase& owner, const Scene& scene, const std::string& file)
      : owner_(owner), scene_(scene), names_(names(scene)) {
    if (ranks::isFirst()) writer_.emplace(file, scene.resultMesh(), names_);
  }

  void write(const path::Vector& u, double lambda, const StateNumbers& n) override {
    const auto nodal = flat(scene_.nodalValues(u, lambda)), element = flat(scene_.elementValues(u, lambda));
    const double active = owner_.activeContacts(u, lambda);
    if (!writer_) return;
    writer_->writeStep(n.pathLength, nodal, element,
                       std::vector<double>{lambda, n.pathLength, n.radius, double(n.order),
                                           double(n.negative), active, n.residual, double(n.branch)});
  }

  void copyFrom(const std::string& file, int count) override {
    if (!writer_) return;
    const exodus::ResultReader reader(file);
    if (reader.nodalNames() != names_.nodal || reader.elementNames() != names_.element ||
        reader.globalNames() != names_.global)
      throw std::invalid_argument(fmt::format("{}: holds other fields than output/fields asks for", file));
    if (reader.numSteps() < count)
      throw std::invalid_argument(
          fmt::format("{}: holds {} states, {} are needed", file, reader.numSteps(), count));
    const auto times = reader.times();
    for (int step = 0; step < count; ++step) {
      std::vector<std::vector<double>> nodal, element;
      for (const auto& name : names_.nodal) nodal.push_back(reader.nodal(step, name));
      for (const auto& name : names_.element) element.push_back(reader.element(step, name));
      writer_->writeStep(times[step], flat(nodal), flat(element), reader.globals(step));
    }
  }

 private:
  static exodus::ResultNames names(const Scene& scene) {
    exodus::ResultNames names;
    names.nodal = scene.nodalNames();
    names.element = scene.elementNames();
    names.global = kGlobals;
    std::istringstream deck(scene.deck().text);
    for (std::string line; std::getline(deck, line);) names.info.push_back(line);
    return names;
  }

  const SceneCase& owner_;
  const Scene& scene_;
  exodus::ResultNames names_;
  std::optional<exodus::ResultWriter> writer_;  ///< of the first rank
};

}  // namespace

path::State SceneCase::start() const { return {scene_.problem().initialState(0.0), 0.0}; }

int SceneCase::activeContacts(const path::Vector& u, double lambda) const {
  int active = 0;
  for (const ContactPoints& contact : scene_.contacts())
    active += scene_.contactState(contact, u, lambda).active;
  return active;
}

std::unique_ptr<FieldFile> SceneCase::makeFieldFile(const std::string& file) const {
  return std::make_unique<SceneFields>(*this, scene_, file);
}

std::unique_ptr<StepWatch> SceneCase::makeWatch(const std::string& file) const {
  if (scene_.contacts().empty()) return nullptr;
  return std::make_unique<ContactEvents>(scene_, file);
}

std::vector<std::string> SceneCase::remarks() const {
  std::vector<std::string> lines;
  for (const ContactPoints& contact : scene_.contacts())
    lines.push_back(fmt::format("contact {}: {}", contact.name, contact.pressure.text));
  return lines;
}

bool SceneCase::changedOn(double length, const path::Series& series) {
  if (!scene_.contactsGrow()) return false;
  constexpr int places = 8;
  path::Vector u(scene_.problem().map());
  bool changed = false;
  for (int j = 1; j <= places; ++j) {
    const double lambda = series.evaluate(length * j / places, u);
    if (!scene_.othersAreNear(u, lambda)) continue;
    changed = true;
    scene_.grow(u, lambda);
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

std::vector<std::pair<std::string, long long>> SceneCase::sizes() const {
  return {{"nodes", scene_.mesh().numNodes()},
          {"elements", scene_.mesh().numElements()},
          {"unknowns", scene_.numUnknowns()},
          {"free_unknowns", scene_.problem().numFreeDofs()},
          {"contact_points", scene_.numContactPoints()},
          {"series_bytes", static_cast<long long>(scene_.problem().historyBytes(scene_.deck().path.order))}};
}

}  // namespace atrapos
