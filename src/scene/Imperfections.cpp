#include "scene/Imperfections.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "atrapos/linear/OnAllRanks.hpp"
#include "atrapos/path/Forced.hpp"
#include "commands/OnePath.hpp"
#include "commands/RunSettings.hpp"
#include "machine/Interrupt.hpp"

namespace atrapos {
namespace {

/// The null vector with `size` as its largest entry: its own sign means nothing.
path::RCP<path::Vector> scaled(const path::Vector& nullVector, double size) {
  auto shape = Teuchos::rcp(new path::Vector(nullVector, Teuchos::Copy));
  double largest = 0;
  for (const double x : linear::onAllRanks(nullVector))
    if (std::abs(x) > std::abs(largest)) largest = x;
  shape->scale(size / largest);
  return shape;
}

}  // namespace

ImperfectCase::ImperfectCase(PathCase& perfect, const path::CriticalPoint& point, double size)
    : perfect_(perfect) {
  if (point.nullVectors.empty())
    throw std::runtime_error(
        "path/imperfections: the null vector of the first bifurcation point, their shape, is not known");
  const path::Vector& mode = *point.nullVectors[0];
  if (perfect.deck().path.imperfectionsAs == deck::Path::Imperfection::Geometry) {
    moved_ = perfect.moved(mode, size);
    if (!moved_)
      throw std::runtime_error("path/imperfections_as: geometry needs a mesh, a model problem has none");
    return;
  }
  problem_ = std::make_unique<path::ForcedProblem>(
      perfect.problem(),
      path::DeadForce{path::forceOfShape(perfect.problem(), perfect.start(), *scaled(mode, size)), {}});
}

ImperfectCase::~ImperfectCase() = default;

path::Problem& ImperfectCase::problem() { return problem_ ? *problem_ : moved_->problem(); }

std::unique_ptr<ImperfectCase> imperfectUnderWay(PathCase& pathCase, const path::BranchProgress& progress) {
  const double size = progress.diagram.branches[progress.current].imperfection;
  if (size == 0) return nullptr;
  return std::make_unique<ImperfectCase>(pathCase, progress.diagram.points.at(0).point, size);
}

void followImperfect(PathCase& pathCase, linear::TangentSolver& solver,
                     std::unique_ptr<ImperfectCase> underWay, Recorder& recorder,
                     path::BranchProgress& progress) {
  auto& branches = progress.diagram.branches;
  const auto& asked = pathCase.deck().path.imperfections;
  std::vector<double> sizes(asked.begin(), asked.end());
  sizes.erase(sizes.begin(),
              sizes.begin() + std::count_if(branches.begin(), branches.end(),
                                            [](const path::Branch& b) { return b.imperfection != 0; }));
  const auto follow = [&](ImperfectCase& imperfect) {
    // Another body has another graph of its tangent, or the same one in another place.
    std::unique_ptr<linear::TangentSolver> own;
    if (&imperfect.pathCase() != &pathCase) own = tangentSolver(imperfect.pathCase());
    followOne(imperfect.pathCase(), imperfect.problem(), own ? *own : solver, recorder, progress, false);
    recorder.finish(branches[progress.current].start);
    if (Interrupt::came()) return;
    progress.path.reset();
    recorder.onProgress(progress);
  };
  if (underWay && progress.path) follow(*underWay);
  underWay.reset();
  for (const double size : sizes) {
    if (Interrupt::came()) return;
    if (progress.diagram.points.empty())
      throw std::runtime_error(
          "path/imperfections: no bifurcation point was found, whose null vector is their shape");
    ImperfectCase imperfect(pathCase, progress.diagram.points[0].point, size);
    path::Branch branch;
    branch.start = imperfect.pathCase().start();
    branch.imperfection = size;
    progress.current = static_cast<int>(branches.size());
    branches.push_back(branch);
    progress.path.emplace();
    progress.path->state = branch.start;
    recorder.beginOther(imperfect.pathCase(), imperfect.problem(), progress.current,
                        fmt::format("branch {}: the path with imperfection {:g}", progress.current, size));
    follow(imperfect);
  }
}

}  // namespace atrapos
