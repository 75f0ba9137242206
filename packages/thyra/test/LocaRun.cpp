#include "LocaRun.hpp"

#include <LOCA.H>
#include <LOCA_Parameter_SublistParser.H>
#include <LOCA_StatusTest_Abstract.H>
#include <LOCA_Thyra.H>
#include <LOCA_TurningPoint_MooreSpence_ExtendedGroup.H>
#include <LOCA_TurningPoint_MooreSpence_ExtendedVector.H>
#include <NOX.H>
#include <NOX_Thyra.H>

#include <Thyra_TpetraThyraWrappers.hpp>
#include <Tpetra_Vector.hpp>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "atrapos/thyra/PathModel.hpp"

namespace atrapos::thyra::test {

namespace {

using Teuchos::RCP;
using Teuchos::rcp;
using Extraction = ::Thyra::TpetraOperatorVectorExtraction<double, linear::LocalIndex, linear::GlobalIndex>;

/// Converged where the Problem's own relative residual keeps the bound.
class RelativeResidual final : public NOX::StatusTest::Generic {
 public:
  RelativeResidual(const PathModel& model, double bound) : model_(model), bound_(bound) {}
  NOX::StatusTest::StatusType checkStatus(const NOX::Solver::Generic&, NOX::StatusTest::CheckType) override {
    const double r = model_.lastResidual().relative();
    status_ = r <= bound_        ? NOX::StatusTest::Converged
              : std::isfinite(r) ? NOX::StatusTest::Unconverged
                                 : NOX::StatusTest::Failed;
    return status_;
  }
  NOX::StatusTest::StatusType getStatus() const override { return status_; }
  std::ostream& print(std::ostream& out, int) const override { return out << "relative residual"; }

 private:
  const PathModel& model_;
  double bound_;
  NOX::StatusTest::StatusType status_ = NOX::StatusTest::Unevaluated;
};

/// Keeps every accepted point.
class Keep final : public LOCA::Thyra::SaveDataStrategy {
 public:
  explicit Keep(LocaRun& run) : run_(run) {}
  void saveSolution(const NOX::Abstract::Vector& x, double lambda) override {
    const auto& thyra = dynamic_cast<const NOX::Thyra::Vector&>(x);
    const auto u = Extraction::getConstTpetraVector(thyra.getThyraRCPVector());
    run_.points.push_back({rcp(new path::Vector(*u, Teuchos::Copy)), lambda});
  }

 private:
  LocaRun& run_;
};

class StopAt final : public LOCA::StatusTest::Abstract {
 public:
  StopAt(LocaRun& run, const LocaOptions& options) : run_(run), options_(options) {}
  LOCA::StatusTest::StatusType checkStatus(const LOCA::Abstract::Iterator& stepper,
                                           LOCA::StatusTest::CheckType) override {
    run_.stopped = run_.points.size() > 1 && options_.stop(run_.points.back());
    status_ = run_.stopped ? LOCA::StatusTest::Finished : LOCA::StatusTest::NotFinished;
    if (stepper.getNumTotalSteps() > options_.maxSteps) status_ = LOCA::StatusTest::Failed;
    return status_;
  }
  LOCA::StatusTest::StatusType getStatus() const override { return status_; }
  std::ostream& print(std::ostream& out, int) const override { return out; }

 private:
  LocaRun& run_;
  const LocaOptions& options_;
  LOCA::StatusTest::StatusType status_ = LOCA::StatusTest::Unevaluated;
};

RCP<Teuchos::ParameterList> parameters(const LocaOptions& options, double lambda) {
  auto list = Teuchos::parameterList();
  auto& stepper = list->sublist("LOCA").sublist("Stepper");
  stepper.set("Continuation Method", "Arc Length");
  stepper.set("Continuation Parameter", "load factor");
  stepper.set("Initial Value", lambda);
  stepper.set("Min Value", options.lambdaMin);
  stepper.set("Max Value", options.lambdaMax);
  stepper.set("Max Steps", options.maxSteps);
  stepper.set("Max Nonlinear Iterations", options.maxIterations);
  stepper.set("Compute Eigenvalues", false);
  stepper.set("Hit Continuation Bound", false);
  list->sublist("LOCA").sublist("Predictor").set("Method", options.predictor);
  auto& length = list->sublist("LOCA").sublist("Step Size");
  length.set("Method", "Adaptive");
  length.set("Initial Step Size", options.firstStep);
  length.set("Min Step Size", options.minStep);
  length.set("Max Step Size", options.maxStep);
  length.set("Aggressiveness", options.aggressiveness);
  auto& nox = list->sublist("NOX");
  nox.set("Nonlinear Solver", "Line Search Based");
  nox.sublist("Direction").set("Method", "Newton");
  nox.sublist("Direction").sublist("Newton").sublist("Linear Solver").set("Tolerance", 1e-10);
  nox.sublist("Line Search").set("Method", "Full Step");
  nox.sublist("Printing").set("Output Information", 0);
  return list;
}

}  // namespace

std::function<bool(const path::State&)> pastFirst(const path::Stops& stops) {
  if (!stops.loadFactors.empty())
    return [factor = stops.loadFactors[0]](const path::State& s) { return s.lambda > factor; };
  if (stops.functionals.empty())
    throw std::invalid_argument("LOCA stops at a load factor or at a functional; there is neither");
  return [f = stops.functionals[0]](const path::State& s) {
    return (f.value > 0 ? 1 : -1) * (f.weights->dot(*s.u) - f.value) > 0;
  };
}

LocaRun followWithLoca(path::Problem& problem, linear::TangentSolver& solver, const path::State& start,
                       const LocaOptions& options) {
  LocaRun run;
  const auto before = solver.counters();
  const auto begin = std::chrono::steady_clock::now();
  const auto model = rcp(new PathModel(problem, &solver, *start.u, start.lambda));
  const auto list = parameters(options, start.lambda);
  auto globals = LOCA::createGlobalData(list);
  LOCA::ParameterVector p;
  p.addParameter("load factor", start.lambda);
  const auto nominal = model->getNominalValues();
  const NOX::Thyra::Vector guess(*nominal.get_x());
  const auto group = rcp(new LOCA::Thyra::Group(globals, guess, model, p, 0, /*implement_dfdp*/ true));
  group->setSaveDataStrategy(rcp(new Keep(run)));
  const auto combo = rcp(new NOX::StatusTest::Combo(NOX::StatusTest::Combo::OR));
  combo->addStatusTest(rcp(new RelativeResidual(*model, options.residualBound)));
  combo->addStatusTest(rcp(new NOX::StatusTest::MaxIters(options.maxIterations)));
  LOCA::Stepper stepper(globals, group, rcp(new StopAt(run, options)), combo, list);
  stepper.run();
  run.steps = stepper.getStepNumber();
  run.failedSteps = stepper.getNumFailedSteps();
  LOCA::destroyGlobalData(globals);
  run.factorizations = solver.counters().factorizations - before.factorizations;
  run.solves = solver.counters().solves - before.solves;
  run.residuals = model->counters().residuals;
  run.tangents = model->counters().tangents;
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return run;
}

LocaFold foldByLoca(path::Problem& problem, linear::TangentSolver& solver,
                    const std::vector<path::State>& points, double sign, double tolerance) {
  std::size_t best = 1;
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    if (sign * points[i].lambda > sign * points[best].lambda) best = i;
  const auto& start = points.at(best);
  const auto model = rcp(new PathModel(problem, &solver, *start.u, start.lambda));
  const auto list = Teuchos::parameterList();
  list->sublist("NOX").sublist("Printing").set("Output Information", 0);
  auto globals = LOCA::createGlobalData(list);
  const auto parser = rcp(new LOCA::Parameter::SublistParser(globals));
  parser->parseSublists(list);
  LOCA::ParameterVector p;
  p.addParameter("load factor", start.lambda);
  const auto nominal = model->getNominalValues();
  const NOX::Thyra::Vector guess(*nominal.get_x());
  const auto group = rcp(new LOCA::Thyra::Group(globals, guess, model, p, 0, /*implement_dfdp*/ true));

  path::Vector phi(*points.at(best + 1).u, Teuchos::Copy);
  phi.update(-1, *points.at(best - 1).u, 1);
  phi.scale(std::sqrt(phi.getGlobalLength()) / phi.norm2());
  const auto phiThyra = ::Thyra::createMember(*model->get_x_space());
  Tpetra::deep_copy(*Extraction::getTpetraVector(phiThyra), phi);
  const RCP<NOX::Abstract::Vector> null = rcp(new NOX::Thyra::Vector(*phiThyra));
  const auto fold = Teuchos::parameterList();
  fold->set("Bifurcation Parameter", "load factor");
  fold->set("Length Normalization Vector", null);
  fold->set("Initial Null Vector", null->clone());
  fold->set("Solver Method", "Salinger Bordering");
  const auto extended = rcp(new LOCA::TurningPoint::MooreSpence::ExtendedGroup(globals, parser, fold, group));
  const auto combo = rcp(new NOX::StatusTest::Combo(NOX::StatusTest::Combo::OR));
  combo->addStatusTest(rcp(new NOX::StatusTest::NormF(*extended, tolerance)));
  combo->addStatusTest(rcp(new NOX::StatusTest::MaxIters(30)));
  auto nox = Teuchos::parameterList();
  nox->set("Nonlinear Solver", "Line Search Based");
  nox->sublist("Line Search").set("Method", "Full Step");
  nox->sublist("Printing").set("Output Information", 0);
  const auto newton = NOX::Solver::buildSolver(extended, combo, nox);
  LocaFold result;
  result.converged = newton->solve() == NOX::StatusTest::Converged;
  const auto& x =
      dynamic_cast<const LOCA::TurningPoint::MooreSpence::ExtendedVector&>(newton->getSolutionGroup().getX());
  const auto u = dynamic_cast<const NOX::Thyra::Vector&>(*x.getXVec()).getThyraRCPVector();
  result.lambda = x.getBifParam();
  result.state = {rcp(new path::Vector(*Extraction::getConstTpetraVector(u), Teuchos::Copy)), result.lambda};
  LOCA::destroyGlobalData(globals);
  return result;
}

}  // namespace atrapos::thyra::test
