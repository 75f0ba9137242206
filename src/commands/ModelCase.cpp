#include "commands/ModelCase.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <limits>
#include <stdexcept>

#include "atrapos/linear/Dot.hpp"
#include "deck/DeckValue.hpp"

namespace atrapos {
namespace {

class ModelState final : public CaseState {
 public:
  ModelState(const models::Setup& setup, const path::Vector& u) : setup_(setup), u_(u) {}

  std::vector<double> monitors() const override {
    std::vector<double> values;
    for (const models::Monitor& m : setup_.monitors) values.push_back(linear::dot(*m.weights, u_));
    return values;
  }

 private:
  const models::Setup& setup_;
  const path::Vector& u_;
};

}  // namespace

ModelCase::ModelCase(const deck::Deck& deck) : deck_(deck) {
  const deck::ModelProblem& model = deck.problem.value();
  try {
    problem_ = models::make(model.name, model.parameters);
    setup_ = models::setup(model.name, model.parameters, *problem_);
  } catch (const std::invalid_argument& e) {
    deck::failAt(deck, "problem/parameters", e.what());
  }
  takeStops();
}

void ModelCase::takeStops() {
  const deck::Stop& stop = deck_.path.stop;
  if (stop.loadFactors.empty() && stop.monitors.empty() && !stop.pathLength && !stop.limitPoint &&
      !stop.bifurcation)
    return;
  path::Stops stops;
  stops.loadFactors = stop.loadFactors;
  stops.pathLength = stop.pathLength.value_or(std::numeric_limits<double>::infinity());
  stops.limitPoints = stop.limitPoint.value_or(0);
  stops.bifurcations = stop.bifurcation.value_or(0);
  for (const auto& [name, values] : stop.monitors) {
    const auto monitor = std::find_if(setup_.monitors.begin(), setup_.monitors.end(),
                                      [&n = name](const models::Monitor& m) { return m.name == n; });
    if (monitor == setup_.monitors.end())
      deck::failAt(deck_, "path/stop/monitor/" + name,
                   fmt::format("the problem {} has no such monitor; it has {}", deck_.problem->name,
                               deck::joined(monitorNames())));
    for (const double value : values) stops.functionals.push_back({name, monitor->weights, value});
  }
  setup_.stops = stops;
}

std::vector<std::string> ModelCase::monitorNames() const {
  std::vector<std::string> names;
  for (const models::Monitor& m : setup_.monitors) names.push_back(m.name);
  return names;
}

std::unique_ptr<CaseState> ModelCase::at(const path::State& state) const {
  return std::make_unique<ModelState>(setup_, *state.u);
}

std::vector<std::pair<std::string, long long>> ModelCase::sizes() const {
  return {{"unknowns", static_cast<long long>(problem_->map()->getGlobalNumElements())}};
}

}  // namespace atrapos
