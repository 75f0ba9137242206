#include "Sharpen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "PathTable.hpp"
#include "atrapos/fem/FeProblem.hpp"

namespace atrapos {
namespace {

/// A term of another problem at a load factor that stays.
class TermAtLoadFactor final : public fem::Term {
 public:
  TermAtLoadFactor(fem::Term& term, double loadFactor) : term_(term), loadFactor_(loadFactor) {}

  int numEntities() const override { return term_.numEntities(); }
  int nodesPerEntity() const override { return term_.nodesPerEntity(); }
  const std::vector<int>& nodes() const override { return term_.nodes(); }
  bool symmetric() const override { return term_.symmetric(); }
  bool seesLoadFactor() const override { return false; }
  void setPositions(const std::vector<int>& positions) override { term_.setPositions(positions); }
  double addResidual(const fem::ConstField& u, double, const fem::Field& f) const override {
    return term_.addResidual(u, loadFactor_, f);
  }
  void addTangent(const fem::ConstField& u, double, const fem::TangentSink& sink) const override {
    fem::TangentSink own = sink;
    own.loadDirection = fem::Field("unused", sink.loadDirection.size());
    term_.addTangent(u, loadFactor_, own);
  }
  void beginSeries(const fem::ConstField& u, double, int maxOrder) override {
    term_.beginSeries(u, loadFactor_, maxOrder);
  }
  void addOrder(int k, const fem::ConstField& last, double, const fem::Field& f) override {
    term_.addOrder(k, last, 0, f);
  }
  fem::PointValues observe(const fem::ConstField& u, double) const override {
    return term_.observe(u, loadFactor_);
  }
  std::size_t historyBytes(int maxOrder) const override { return term_.historyBytes(maxOrder); }

 private:
  fem::Term& term_;
  double loadFactor_;
};

class Writer final : public path::Observer {
 public:
  Writer(const Scene& scene, const std::string& file) : scene_(scene), table_(file, header(scene)) {}

  bool onStep(const path::StepReport& report, const path::Series&) override {
    write(report.end, report.residual);
    return true;
  }

  void write(const path::State& state, double residual) {
    monitors_ = scene_.monitors(*state.u, state.lambda);
    std::string row = fmt::format("{:.17g}", std::exp(-state.lambda));
    for (const double m : monitors_) row += fmt::format(",{:.17g}", m);
    table_.append(row + fmt::format(",{:.3e}", residual));
  }

  const std::vector<double>& monitors() const { return monitors_; }

 private:
  static std::string header(const Scene& scene) {
    std::string names = "factor";
    for (const auto& name : scene.monitorNames()) names += ',' + name;
    return names + ",residual";
  }

  const Scene& scene_;
  Table table_;
  std::vector<double> monitors_;
};

}  // namespace

void Scene::sharpen(double loadFactor) {
  const fem::FeModel& from = problem_->model();
  fem::FeModel model;
  model.numNodes = from.numNodes;
  model.supports = fem::Supports(from.numNodes);
  for (fem::Coupling coupling : from.couplings.all()) {
    coupling.value += loadFactor * coupling.perLoadFactor;
    coupling.perLoadFactor = 0;
    model.couplings.add(std::move(coupling));
  }
  model.numMultipliers = from.numMultipliers;
  model.constantLoad = from.constantLoad;
  for (std::size_t d = 0; d < from.load.size(); ++d) {
    model.constantLoad[d] += loadFactor * from.load[d];
    const int dof = static_cast<int>(d);
    if (from.supports.fixed(dof))
      model.supports.prescribe(dof / 3, dof % 3,
                               from.supports.value(dof) + loadFactor * from.supports.perLoadFactor(dof), 0);
  }
  for (const auto& term : from.terms)
    model.terms.push_back(std::make_unique<TermAtLoadFactor>(*term, loadFactor));
  for (const ContactPoints& contact : contacts_)
    for (std::size_t t = 0; t < contact.terms.size(); ++t) {
      if (!contact.pressure.regularised)
        throw std::logic_error("Scene::sharpen: the law of contact '" + contact.name + "' has no eta");
      model.terms[contact.terms[t]] = contact.tool->sharpened(
          *contact.pressure.regularised, contact.points[t], contact.references[t], loadFactor);
    }
  loaded_ = std::move(problem_);
  problem_ = std::make_unique<fem::FeProblem>(std::move(model));
}

Sharpened sharpen(Scene& scene, const path::State& state, double factor, path::Options options,
                  linear::TangentSolver& solver, const std::string& file) {
  scene.sharpen(state.lambda);
  path::Stops stops;
  stops.loadFactors = {-std::log(factor)};
  options.direction = 1;
  Writer writer(scene, file);
  const path::State start{state.u, 0.0};
  writer.write(start, 0);
  path::PathFollower follower(scene.problem(), solver, options, stops);
  const path::Outcome outcome = follower.run(start, writer);
  Sharpened result;
  result.reached = outcome.reason == path::EndReason::stopReached;
  result.text = result.reached ? "" : outcome.text;
  result.factor = std::exp(-outcome.final.lambda);
  result.steps = outcome.steps;
  result.monitors = writer.monitors();
  return result;
}

}  // namespace atrapos
