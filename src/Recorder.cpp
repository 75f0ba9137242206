#include "Recorder.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ostream>

#include "Interrupt.hpp"
#include "Ranks.hpp"

namespace atrapos {
namespace {

/// While an earlier run is taken over, new files stand beside the old ones.
constexpr const char* kBeside = ".new";

std::string fieldsName(int branch) {
  return branch == 0 ? "results.exo" : fmt::format("results_branch{}.exo", branch);
}

}  // namespace

Recorder::Recorder(PathCase& pathCase, std::string directory, std::ostream* progress,
                   const std::optional<Continued>& continued)
    : case_(pathCase),
      problem_(&pathCase.problem()),
      functionals_(pathCase.functionals()),
      directory_(std::move(directory)),
      progress_(progress),
      path_(file("path.csv") + (continued ? kBeside : ""), pathHeader(case_.monitorNames())),
      points_(file("points.csv") + (continued ? kBeside : ""), pointHeader(case_.monitorNames())),
      work_(Teuchos::rcp(new path::Vector(case_.problem().map()))),
      residual_(Teuchos::rcp(new path::Vector(case_.problem().map()))),
      start_(std::chrono::steady_clock::now()) {
  const std::string beside = continued ? kBeside : "";
  const deck::Path& settings = case_.deck().path;
  if (settings.restart && settings.branches == path::Follow::none)
    restart_.emplace(file("restart.bin") + beside);
  fields_ = case_.makeFieldFile(file(fieldsName(0)) + beside);
  // Between the ends of Newton steps nothing is known for sure.
  if (settings.series()) watch_ = case_.makeWatch(file("events.csv") + beside);
  if (continued) try {
      goOn(*continued);
    } catch (...) {
      for (const char* name : {"path.csv", "points.csv", "events.csv", "restart.bin", "results.exo"})
        std::filesystem::remove(file(name) + kBeside);
      throw;
    }
  if (progress_)
    for (const std::string& line : case_.remarks()) *progress_ << line << '\n';
  printHead();
}

Recorder::~Recorder() = default;

void Recorder::goOn(const Continued& continued) {
  const int last = continued.from.steps;
  const auto old = [&](const std::string& name) { return continued.directory + "/" + name; };
  path_.copyFrom(old("path.csv"), 0, last);
  points_.copyFrom(old("points.csv"), 0, last);
  if (fields_) fields_->copyFrom(old(fieldsName(0)), last + 1);
  if (watch_) watch_->copyFrom(old("events.csv"), last);
  if (restart_) restart_->copyFrom(old("restart.bin"), last);
  started_ = true;
  if (!ranks::isFirst()) return;
  // The restart file first: whatever ends this in the middle, the others hold at least what it names.
  const auto replace = [&](const std::string& name) {
    std::filesystem::rename(file(name) + kBeside, file(name));
  };
  if (restart_) replace("restart.bin");
  if (fields_) replace(fieldsName(0));
  if (watch_) replace("events.csv");
  replace("path.csv");
  replace("points.csv");
}

double Recorder::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Recorder::onBranch(const path::BranchDiagram& diagram, int branch) {
  if (branch == 0) return;
  const path::Branch& b = diagram.branches[branch];
  const path::CriticalPoint& point = diagram.points[b.point].point;
  if (progress_)
    *progress_ << fmt::format("branch {}: from the {} on branch {} at load factor {:.10g}{}\n", branch,
                              path::toString(point.kind), b.parent, point.state.lambda,
                              b.end == path::BranchEnd::path ? "" : ": " + b.outcome.text);
  if (b.end == path::BranchEnd::path) begin(branch);
}

void Recorder::beginImperfect(path::Problem& problem, int branch, double size) {
  problem_ = &problem;
  if (progress_) *progress_ << fmt::format("branch {}: the path with imperfection {:g}\n", branch, size);
  begin(branch);
}

void Recorder::begin(int branch) {
  branch_ = branch;
  started_ = false;
  fields_.reset();  // the file of the branch before is complete
  fields_ = case_.makeFieldFile(file(fieldsName(branch)));
  printHead();
}

bool Recorder::onStep(int branch, const path::StepReport& report, const path::Series& series) {
  const double before = seconds();
  branch_ = branch;
  const auto negativeAt = [&](double a) { return report.negativeAt(a).value_or(-1); };
  // The step is one of the problem before the events at its end.
  const auto changeBack = [&] {
    if (!report.events.empty()) case_.problem().applyEvent(report.events, *report.end.u, report.end.lambda);
  };
  changeBack();
  if (!started_) writeStart(*series.coefficient(0).u, series.lambdaCoefficient(0), negativeAt(0));
  const int points = case_.deck().output.pointsPerStep;
  worstResidual_ = std::max(worstResidual_, report.residual);
  for (int j = 1; j < points; ++j) {
    const double a = report.length * j / points;
    const double lambda = series.evaluate(a, *work_);
    writeRow(report.step, report.pathLengthStart + a, *work_, lambda, negativeAt(a));
  }
  const long long negative = negativeAt(report.length);
  writeRow(report.step, report.pathLengthEnd, *report.end.u, report.end.lambda, negative);
  writePoints(report, series);
  if (watch_) watch_->onStep(branch, report.step, report.pathLengthStart, report.length, series);
  if (fields_)
    fields_->write(*report.end.u, report.end.lambda,
                   {report.pathLengthEnd, report.radius, report.residual, report.order, negative, branch_});
  if (restart_ && branch == 0) restart_->append(report.next);
  printStep(report);
  changeBack();
  outputSeconds_ += seconds() - before;
  return !Interrupt::agree();
}

void Recorder::finish(const path::State& start) {
  if (!started_) writeStart(*start.u, start.lambda, -1);
}

void Recorder::writeStart(const path::Vector& u, double lambda, long long negative) {
  started_ = true;
  writeRow(0, 0.0, u, lambda, negative);
  if (fields_)
    fields_->write(u, lambda,
                   {0, 0, problem_->residual(u, lambda, *residual_).relative(), 0, negative, branch_});
}

void Recorder::writeRow(int step, double pathLength, const path::Vector& u, double lambda,
                        long long negative) {
  const double r = problem_->residual(u, lambda, *residual_).relative();
  if (step > 0) worstResidual_ = std::max(worstResidual_, r);
  path_.append(text(PathRow{step, pathLength, lambda, case_.monitors(u, lambda), negative, branch_, r}));
}

void Recorder::writePoints(const path::StepReport& report, const path::Series& series) {
  std::vector<PointRow> rows;
  for (const path::LimitPoint& p : report.limitPoints) {
    series.evaluate(p.a, *work_);
    PointRow row{report.step, branch_, report.pathLengthStart + p.a, p.lambda,
                 p.maximum ? "maximum" : "minimum"};
    row.monitors = case_.monitors(*work_, p.lambda);
    rows.push_back(row);
  }
  for (const path::Extremum& e : report.extrema) {
    series.evaluate(e.a, *work_);
    // A monitor that is zero by symmetry turns at random: what it changes by must be more than the residual
    // bound leaves open.
    const path::Vector& weights = *functionals_[e.monitor].weights;
    const auto value = series.functional(weights);
    const double change = std::max(std::abs(e.value - value(0)), std::abs(e.value - value(report.length)));
    if (!(change > case_.deck().path.residual * weights.norm2() * work_->norm2())) continue;
    PointRow row{report.step, branch_, report.pathLengthStart + e.a, e.lambda,
                 (e.maximum ? "maximum:" : "minimum:") + functionals_[e.monitor].name};
    row.monitors = case_.monitors(*work_, e.lambda);
    rows.push_back(row);
  }
  limitPoints_ += static_cast<int>(report.limitPoints.size());
  for (const path::CriticalPoint& p : report.criticalPoints) {
    PointRow row{report.step, branch_, report.pathLengthStart + p.a, p.state.lambda, path::toString(p.kind)};
    row.negativeChange = p.negativeChange;
    row.nullity = p.nullity;
    row.uncertainty = p.uncertainty;
    row.monitors = case_.monitors(*p.state.u, p.state.lambda);
    rows.push_back(row);
  }
  unexplained_ += report.unexplained;
  std::sort(rows.begin(), rows.end(),
            [](const PointRow& a, const PointRow& b) { return a.pathLength < b.pathLength; });
  for (const PointRow& row : rows) points_.append(text(row));
}

void Recorder::printHead() const {
  if (progress_)
    *progress_ << fmt::format("{:>5} {:>5} {:>10} {:>13} {:>10} {:>10} {:>4} {:>4} {:>8} {:>8}  {}\n", "step",
                              case_.deck().path.series() ? "order" : "",
                              case_.deck().path.series() ? "radius" : "tried", "load factor", "length",
                              "residual", "cut", "corr", "contacts", "time s", "events");
}

void Recorder::printStep(const path::StepReport& r) const {
  const int active =
      progress_ || ranks::count() > 1 ? case_.activeContacts(*r.end.u, r.end.lambda) : 0;  // collective
  if (!progress_) return;
  std::string events;
  for (const path::LimitPoint& p : r.limitPoints)
    events +=
        fmt::format("limit point ({}) at load factor {:.8g}; ", p.maximum ? "maximum" : "minimum", p.lambda);
  const bool follows = case_.deck().path.branches != path::Follow::none;
  for (const path::CriticalPoint& p : r.criticalPoints) {
    events +=
        fmt::format("bifurcation point ({}) at load factor {:.10g}", path::toString(p.kind), p.state.lambda);
    if (p.nullity > 1) events += fmt::format(", {} null vectors", p.nullity);
    if (follows && p.tangents.empty())
      events += ": the directions of its branches are not known, none is followed";
    events += "; ";
  }
  if (r.unexplained > 0)
    events += fmt::format("{} eigenvalue(s) changed sign at a place not found; ", r.unexplained);
  if (!events.empty()) events.resize(events.size() - 2);
  *progress_ << fmt::format(
                    "{:>5} {:>5} {:>10.3e} {:>13.6g} {:>10.3e} {:>10.2e} {:>4} {:>4} {:>8} {:>8.2f}  {}",
                    r.step, case_.deck().path.series() ? fmt::format("{}", r.order) : "", r.radius,
                    r.lambdaEnd, r.length, r.residual, r.cutBacks, r.corrections,
                    active, seconds(), events)
             << std::endl;
}

}  // namespace atrapos
