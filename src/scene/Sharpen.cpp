#include "scene/Sharpen.hpp"

#include <fmt/format.h>

#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "atrapos/fem/FeProblem.hpp"
#include "output/PathTable.hpp"

namespace atrapos {
namespace {

/// A term of another problem at a load factor that stays.
class TermAtLoadFactor final : public fem::Term {
 public:
  TermAtLoadFactor(std::unique_ptr<fem::Term> term, double loadFactor)
      : owned_(std::move(term)), term_(*owned_), loadFactor_(loadFactor) {}

  int numEntities() const override { return term_.numEntities(); }
  int nodesPerEntity() const override { return term_.nodesPerEntity(); }
  const std::vector<int>& nodes() const override { return term_.nodes(); }
  bool symmetric() const override { return term_.symmetric(); }
  bool seesLoadFactor() const override { return false; }
  void keep(const fem::TermPart& part) override { term_.keep(part); }
  void connect(const fem::DofMap& dofs, const std::vector<int>& positions) override {
    term_.connect(dofs, positions);
  }
  std::vector<double> startVariables() const override { return term_.startVariables(); }
  void remember(const double* variables, const fem::ConstDofView& u, double) override {
    term_.remember(variables, u, loadFactor_);
  }
  std::vector<double> variablesAt(const fem::ConstDofView& u, double) const override {
    return term_.variablesAt(u, loadFactor_);
  }
  std::vector<std::vector<double>> variableOrders(const fem::ConstDofView& last, double) override {
    return term_.variableOrders(last, 0);
  }
  fem::OwnForces addResidual(const fem::ConstDofView& u, double, const fem::DofView& f) const override {
    return term_.addResidual(u, loadFactor_, f);
  }
  void addTangent(const fem::ConstDofView& u, double, const fem::TangentSink& sink) const override {
    fem::TangentSink own = sink;
    own.loadDirection = fem::DofView("unused", sink.loadDirection.size());
    term_.addTangent(u, loadFactor_, own);
  }
  void beginSeries(const fem::ConstDofView& u, double, int maxOrder) override {
    term_.beginSeries(u, loadFactor_, maxOrder);
  }
  void addOrder(int k, const fem::ConstDofView& last, double, const fem::DofView& f) override {
    term_.addOrder(k, last, 0, f);
  }
  fem::PointValues observe(const fem::ConstDofView& u, double) const override {
    return term_.observe(u, loadFactor_);
  }
  std::size_t historyBytes(int maxOrder) const override { return term_.historyBytes(maxOrder); }

 private:
  std::unique_ptr<fem::Term> owned_;
  fem::Term& term_;
  double loadFactor_;
};

/// A vector of the numbers of all dofs, which every rank has.
linear::RCP<path::Vector> onMap(const std::vector<double>& values, const linear::RCP<const path::Map>& map) {
  const auto u = Teuchos::rcp(new path::Vector(map));
  const auto own = u->getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t i = 0; i < own.extent(0); ++i)
    own(i, 0) = values[map->getGlobalElement(static_cast<linear::LocalIndex>(i))];
  return u;
}

class Writer final : public path::Observer {
 public:
  Writer(const Scene& scene, const std::string& file) : scene_(scene), table_(file, header(scene)) {}

  bool onStep(const path::StepReport& report, const path::Series&) override {
    write(report.end, report.residual);
    return true;
  }

  void write(const path::State& state, double residual) {
    monitors_ = scene_.monitors(scene_.at(state));
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
  fem::FeModel from = makeModel();
  fem::FeModel model;
  model.comm = from.comm;
  model.dofs = from.dofs;
  for (fem::Coupling coupling : from.couplings.all()) {
    coupling.value += loadFactor * coupling.perLoadFactor;
    coupling.perLoadFactor = 0;
    model.couplings.add(std::move(coupling));
  }
  const std::size_t numDofs = from.dofs.numDofs();
  from.load.resize(numDofs, 0.0);
  from.constantLoad.resize(numDofs, 0.0);
  model.dofName = from.dofName;
  model.constantLoad = from.constantLoad;
  for (std::size_t d = 0; d < numDofs; ++d) {
    model.constantLoad[d] += loadFactor * from.load[d];
    const int dof = static_cast<int>(d);
    if (from.supports.fixed(dof))
      model.supports.prescribe(dof, from.supports.value(dof) + loadFactor * from.supports.perLoadFactor(dof),
                               0);
  }
  for (auto& term : from.terms)
    model.terms.push_back(std::make_unique<TermAtLoadFactor>(std::move(term), loadFactor));
  for (ContactPoints& contact : contacts_) {
    for (std::size_t t = 0; t < contact.terms.size(); ++t) {
      if (!contact.pressure.regularised)
        throw std::logic_error("Scene::sharpen: the law of contact '" + contact.name + "' has no eta");
      model.terms[contact.terms[t]] = contact.tool->sharpened(
          *contact.pressure.regularised, contact.points[t], contact.references[t], loadFactor);
    }
    contact.near.clear();  // all points carry the law
  }
  loaded_ = std::move(problem_);
  problem_ = std::make_unique<fem::FeProblem>(std::move(model));
  addMonitors();
}

Sharpened sharpen(Scene& scene, const path::State& state, double factor, path::Options options,
                  linear::TangentSolver& solver, const std::string& file) {
  const std::vector<double> u = fem::FeProblem::values(*state.u);
  scene.sharpen(state.lambda);
  path::Stops stops;
  stops.loadFactors = {-std::log(factor)};
  options.direction = 1;
  Writer writer(scene, file);
  const path::State start{onMap(u, scene.problem().map()), 0.0};
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
