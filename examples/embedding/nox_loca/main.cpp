// The problem of ../own_loop, given to LOCA: any path::Problem is a Thyra model evaluator. LOCA follows the
// branch by Newton arc-length steps; the same branch by series is beside it. Both turn at the same fold.
#include <LOCA.H>
#include <LOCA_Thyra.H>
#include <NOX.H>
#include <NOX_Thyra.H>

#include <Tpetra_Core.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "../own_loop/PathGlue.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/PathFollower.hpp"
#include "atrapos/thyra/PathModel.hpp"

using namespace atrapos;
using Teuchos::RCP;
using Teuchos::rcp;

/// Load factors of the points that LOCA accepts.
struct LoadFactors : LOCA::Thyra::SaveDataStrategy {
  std::vector<double> values;
  void saveSolution(const NOX::Abstract::Vector&, double lambda) override { values.push_back(lambda); }
};

struct Folds : path::Observer {
  std::vector<double> lambda;
  bool onStep(const path::StepReport& report, const path::Series&) override {
    for (const auto& p : report.limitPoints) lambda.push_back(p.lambda);
    return true;
  }
};

static int compare() {
  host::Application app(16, Tpetra::getDefaultComm());
  PathGlue problem(app);
  const auto solver = linear::makeTangentSolver({});
  const host::Vector start(app.map());

  const auto model = rcp(new thyra::PathModel(problem, solver.get(), start, 0.0));
  const auto list = Teuchos::parameterList();
  auto& stepper = list->sublist("LOCA").sublist("Stepper");
  stepper.set("Continuation Method", "Arc Length");
  stepper.set("Continuation Parameter", "load factor");
  stepper.set("Initial Value", 0.0);
  stepper.set("Min Value", -1.0);
  stepper.set("Max Value", 10.0);
  stepper.set("Max Steps", 60);
  stepper.set("Max Nonlinear Iterations", 10);
  stepper.set("Compute Eigenvalues", false);
  auto& length = list->sublist("LOCA").sublist("Step Size");
  length.set("Initial Step Size", 0.5);
  length.set("Max Step Size", 0.5);
  list->sublist("LOCA").sublist("Predictor").set("Method", "Tangent");
  auto& nox = list->sublist("NOX");
  nox.set("Nonlinear Solver", "Line Search Based");
  nox.sublist("Line Search").set("Method", "Full Step");
  nox.sublist("Printing").set("Output Information", 0);
  auto globals = LOCA::createGlobalData(list);
  LOCA::ParameterVector parameters;
  parameters.addParameter("load factor", 0.0);
  const NOX::Thyra::Vector guess(*model->getNominalValues().get_x());
  const auto group =
      rcp(new LOCA::Thyra::Group(globals, guess, model, parameters, 0, /*implement_dfdp*/ true));
  const auto loads = rcp(new LoadFactors);
  group->setSaveDataStrategy(loads);
  const auto test = rcp(new NOX::StatusTest::Combo(NOX::StatusTest::Combo::OR));
  test->addStatusTest(rcp(new NOX::StatusTest::NormF(1e-10)));
  test->addStatusTest(rcp(new NOX::StatusTest::MaxIters(10)));
  LOCA::Stepper loca(globals, group, test, list);
  loca.run();
  LOCA::destroyGlobalData(globals);
  const double highest = *std::max_element(loads->values.begin(), loads->values.end());
  const long long factorizations = solver->counters().factorizations;

  Folds folds;
  path::Stops stops;
  stops.pathLength = 20;
  const auto own = linear::makeTangentSolver({});
  const auto outcome = path::PathFollower(problem, *own, {}, stops)
                           .run({rcp(new host::Vector(start, Teuchos::Copy)), 0.0}, folds);
  std::printf("LOCA: %d points, %lld factorizations, highest load factor %.6f\n",
              static_cast<int>(loads->values.size()), factorizations, highest);
  std::printf("series: %d steps, %d factorizations, fold %.6f\n", outcome.steps, outcome.factorizations,
              folds.lambda.empty() ? 0.0 : folds.lambda[0]);
  // The highest point lies below the fold by its curvature times half a step squared: points are half a unit
  // apart at most.
  return folds.lambda.size() == 1 && highest < folds.lambda[0] + 1e-6 && highest > folds.lambda[0] - 0.05 ? 0
                                                                                                          : 1;
}

int main(int argc, char** argv) {
  const Tpetra::ScopeGuard guard(&argc, &argv);
  return compare();
}
