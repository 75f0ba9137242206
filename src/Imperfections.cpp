#include "Imperfections.hpp"

#include <Tpetra_Vector.hpp>
#include <cmath>
#include <stdexcept>

#include "Interrupt.hpp"
#include "atrapos/linear/OnAllRanks.hpp"
#include "atrapos/path/Imperfect.hpp"
#include "atrapos/path/PathFollower.hpp"

namespace atrapos {
namespace {

/// The null vector with 1 as its largest entry: its own sign means nothing.
path::RCP<path::Vector> shapeOf(const path::Vector& nullVector) {
  auto shape = Teuchos::rcp(new path::Vector(nullVector, Teuchos::Copy));
  double largest = 0;
  for (const double x : linear::onAllRanks(nullVector))
    if (std::abs(x) > std::abs(largest)) largest = x;
  shape->scale(1 / largest);
  return shape;
}

class Forward final : public path::Observer {
 public:
  Forward(Recorder& recorder, int branch) : recorder_(recorder), branch_(branch) {}
  bool onStep(const path::StepReport& report, const path::Series& series) override {
    return recorder_.onStep(branch_, report, series);
  }

 private:
  Recorder& recorder_;
  int branch_;
};

}  // namespace

void followImperfect(PathCase& pathCase, linear::TangentSolver& solver, const path::Options& settings,
                     const std::vector<int>& conditions, Recorder& recorder, path::BranchDiagram& diagram,
                     std::vector<double>& sizes) {
  sizes.assign(diagram.branches.size(), 0.0);
  const auto& asked = pathCase.deck().path.imperfections;
  if (asked.empty() || Interrupt::came()) return;
  if (diagram.points.empty() || diagram.points[0].point.nullVectors.empty())
    throw std::runtime_error(
        "path/imperfections: no bifurcation point was found, whose null vector is their shape");
  const auto shape = shapeOf(*diagram.points[0].point.nullVectors[0]);
  for (const double size : asked) {
    const path::State start = pathCase.start();
    if (!conditions.empty()) pathCase.problem().setConditions(conditions);
    auto deflection = Teuchos::rcp(new path::Vector(*shape, Teuchos::Copy));
    deflection->scale(size);
    path::ImperfectProblem imperfect(pathCase.problem(),
                                     path::forceOfShape(pathCase.problem(), start, *deflection));
    path::Branch branch;
    branch.start = start;
    diagram.branches.push_back(branch);
    sizes.push_back(size);
    const int index = static_cast<int>(diagram.branches.size()) - 1;
    recorder.beginImperfect(imperfect, index, size);
    Forward forward(recorder, index);
    path::PathFollower follower(imperfect, solver, settings, pathCase.stops());
    follower.watch(pathCase.functionals());
    diagram.branches[index].outcome = follower.run(start, forward);
    recorder.finish(start);
    if (Interrupt::came()) return;
  }
}

}  // namespace atrapos
