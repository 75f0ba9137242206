#include "output/Recorder.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <ostream>

#include "machine/Interrupt.hpp"
#include "machine/OutputFile.hpp"
#include "machine/Ranks.hpp"
#include "output/FieldFiles.hpp"
#include "output/Files.hpp"
#include "output/ToolShapes.hpp"

namespace atrapos {
namespace {

constexpr const char* kBeside = ".new";

constexpr double kNotEvaluated = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Recorder::Recorder(PathCase& pathCase, path::Problem& problem, const RunProblem& runProblem,
                   std::string directory, std::ostream* progress, const std::optional<Continued>& continued)
    : case_(&pathCase),
      problem_(&problem),
      functionals_(pathCase.functionals()),
      directory_(std::move(directory)),
      log_(progress, pathCase.deck().path, pathCase.monitorNames()),
      beside_(directory_),
      path_(beside_.name("path.csv"), pathHeader(case_->monitorNames())),
      points_(beside_.name("points.csv"), pointHeader(case_->monitorNames())),
      steps_(beside_.name("steps.csv"), stepHeader()),
      residual_(Teuchos::rcp(new path::Vector(case_->problem().map()))),
      start_(std::chrono::steady_clock::now()) {
  const deck::Path& settings = case_->deck().path;
  if (settings.restart)
    restart_.emplace(beside_.name("restart.bin"), runProblem, settings.branches != path::Follow::none);
  if (continued) branch_ = continued->progress.current;
  if (!continued || continued->progress.path)
    fields_ = case_->makeFieldFile(beside_.name(fieldsName(branch_)));
  // Between the ends of Newton steps nothing is known for sure.
  if (settings.series()) watch_ = case_->makeWatch(beside_.name("events.csv"), false);
  if (continued)
    goOn(*continued);
  else
    unused_ = case_->costs();
  if (log_.tells())
    for (const std::string& line : case_->remarks()) log_.line(line);
  log_.head();
}

Recorder::~Recorder() = default;

void Recorder::Beside::remove() const {
  std::error_code ignored;  // on the way out with another error, or of an earlier run that was killed
  std::vector<std::filesystem::path> left;
  for (const auto& entry : std::filesystem::directory_iterator(directory_, ignored)) {
    const std::string file = entry.path().filename().string();
    const auto suffix = file.find(kBeside);
    if (suffix != std::string::npos && isResultName(file.substr(0, suffix))) left.push_back(entry.path());
  }
  for (const auto& file : left) std::filesystem::remove(file, ignored);
}

std::string Recorder::Beside::name(const std::string& file) const {
  return directory_ + "/" + file + kBeside;
}

void Recorder::goOn(const Continued& continued) {
  const auto& path = continued.progress.path;
  const RestartPlace last{branch_, path ? path->steps : std::numeric_limits<int>::max()};
  const auto old = [&](const std::string& name) { return continued.directory + "/" + name; };
  path_.copyFrom(old("path.csv"), last, continued.marks.path);
  points_.copyFrom(old("points.csv"), last, continued.marks.points);
  steps_.copyFrom(old("steps.csv"), last, continued.marks.steps);
  if (ranks::isFirst()) {
    limitPoints_ = limitPointsOf(beside_.name("points.csv"));
    hopfPoints_ = hopfPointsOf(beside_.name("points.csv"));
  }
  if (fields_)
    fields_->copyFrom(old(fieldsName(branch_)), 1 + numFieldStates(path->steps, !path->stop.empty()),
                      path->pathLength, continued.marks.fields);
  if (watch_) watch_->copyFrom(old("events.csv"), last, continued.marks.events);
  if (restart_) restart_->goOn(old("restart.bin"), continued);
  started_ = true;
  ranks::wait();  // all have taken over what is replaced now
  if (ranks::isFirst() && !std::filesystem::equivalent(directory_, continued.directory))
    copyFields(continued.directory, directory_, fields_ ? branch_ - 1 : branch_);
  settle(branch_);
}

void Recorder::settle(int kept) {
  if (settled_) return;
  settled_ = true;
  sync();
  ranks::wait();
  if (ranks::isFirst()) {
    // A run that is killed must not leave an earlier run's files beside its own.
    for (const char* const old :
         {"summary.json", "branches.csv", "path.png", "path.svg", "report.html", "sharpen.csv"})
      removeFile(file(old));
    removeToolShapes(directory_);
    removeOtherFields(directory_, kept, case_->deck());
  }
  // The restart file first: whatever ends this in the middle, the others hold at least what it names.
  if (restart_)
    restart_->rename(file("restart.bin"));
  else if (ranks::isFirst())
    removeFile(file("restart.bin"));
  ranks::wait();
  if (fields_) fields_->rename(file(fieldsName(branch_)));
  if (watch_)
    watch_->rename(file("events.csv"));
  else if (ranks::isFirst())
    removeFile(file("events.csv"));
  path_.rename(file("path.csv"));
  points_.rename(file("points.csv"));
  steps_.rename(file("steps.csv"));
  beside_.keep();
  ranks::wait();
  if (!ranks::isFirst()) return;
  beside_.remove();
  syncFile(directory_);
}

RunMarks Recorder::marks() const {
  return {path_.mark(), points_.mark(), steps_.mark(), watch_ ? watch_->mark() : Mark{},
          fields_ ? fields_->mark() : Mark{}};
}

void Recorder::sync() {
  path_.sync();
  points_.sync();
  steps_.sync();
  if (watch_) watch_->sync();
  if (fields_) fields_->sync();
  if (restart_) restart_->sync();
  synced_ = seconds();
}

bool Recorder::hasFields(int step, bool atStop) const {
  return step % case_->deck().output.fieldsEvery == 0 || atStop;
}

int Recorder::numFieldStates(int steps, bool atStop) const {
  const int every = case_->deck().output.fieldsEvery;
  return steps / every + (atStop && steps % every != 0 ? 1 : 0);
}

double Recorder::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Recorder::onBranch(const path::BranchDiagram& diagram, int branch) {
  if (branch == 0) return;
  const path::Branch& b = diagram.branches[branch];
  const path::CriticalPoint& point = diagram.points[b.point].point;
  log_.line(fmt::format("branch {}: from the {} on branch {} at load factor {:.10g}{}", branch,
                        path::toString(point.kind), b.parent, point.state.lambda,
                        b.end == path::BranchEnd::path ? "" : ": " + b.outcome.text));
  if (b.end == path::BranchEnd::path) begin(branch);
}

void Recorder::beginOther(PathCase& pathCase, path::Problem& problem, int branch, const std::string& line) {
  if (&pathCase != case_) {
    case_ = &pathCase;
    functionals_ = pathCase.functionals();
    log_.follow(pathCase.deck().path);
    if (watch_) {
      watched_ += watch_->count();
      watch_.reset();
      watch_ = pathCase.makeWatch(file("events.csv"), true);
    }
  }
  problem_ = &problem;
  log_.line(line);
  begin(branch);
}

void Recorder::begin(int branch) {
  settle(fields_ ? branch_ : -1);
  branch_ = branch;
  started_ = false;
  fields_.reset();  // the file of the branch before is complete
  fields_ = case_->makeFieldFile(file(fieldsName(branch)));
  log_.head();
}

bool Recorder::onStep(int branch, const path::StepReport& report, const path::Series& series) {
  const double before = seconds();
  branch_ = branch;
  const auto negativeAt = [&](double a) { return report.negativeAt(a).value_or(-1); };
  if (!started_) writeStart(series.state(0), negativeAt(0));
  const int points = case_->deck().output.pointsPerStep;
  for (int j = 1; j < points; ++j) {
    const double a = report.length * j / points;
    const path::State state = series.state(a);
    const bool wanted = case_->deck().output.residuals == deck::Output::Residuals::Points;
    writeRow(report.step, report.pathLengthStart + a, state.lambda, *case_->at(state), negativeAt(a),
             wanted ? residualAt(state) : kNotEvaluated);
  }
  const long long negative = negativeAt(report.length);
  const auto end = case_->at(report.end);
  writeRow(report.step, report.pathLengthEnd, report.end.lambda, *end, negative, report.residual);
  const std::vector<PointRow> found = writePoints(report, series);
  const int changesBefore = watch_ ? watch_->count() : 0;
  if (watch_)
    watch_->onStep(branch, report.step, report.pathLengthStart, report.length, series, *end, report.events);
  if (fields_ && hasFields(report.step, !report.next.stop.empty()))
    fields_->write(*end, {report.end.lambda, report.pathLengthEnd, report.radius, report.residual,
                          report.order, negative, branch_});
  RunLog::Step step{end->activeContacts(), (watch_ ? watch_->count() : 0) - changesBefore, seconds(),
                    end->monitors()};
  end->strikeUsed(unused_);
  writeStep(report, series, step, negative);
  log_.step(report, step, found);
  outputSeconds_ += seconds() - before;
  if (afterStep_) afterStep_({branch, report, step.monitors});
  return !Interrupt::agree();
}

void Recorder::onSearch(int /*branch*/, int found, int wanted) { log_.search(found, wanted, seconds()); }

void Recorder::onProgress(const path::BranchProgress& progress) {
  constexpr double often = 1;  // s; the disk takes some hundredths of it
  if (restart_) restart_->append(progress, marks());
  settle(fields_ ? branch_ : -1);
  if (seconds() - synced_ > often) sync();
}

void Recorder::finish(const path::State& start) {
  if (!started_) writeStart(start, -1);
  settle(fields_ ? branch_ : -1);
  sync();
}

void Recorder::writeStart(const path::State& start, long long negative) {
  started_ = true;
  const auto state = case_->at(start);
  const double residual = residualAt(start);
  writeRow(0, 0.0, start.lambda, *state, negative, residual);
  if (fields_) fields_->write(*state, {start.lambda, 0, 0, residual, 0, negative, branch_});
}

double Recorder::residualAt(const path::State& state) {
  return problem_->residual(state, *residual_).relative();
}

void Recorder::writeRow(int step, double pathLength, double lambda, const CaseState& state,
                        long long negative, double residual) {
  if (step > 0 && residual > worstResidual_) worstResidual_ = residual;
  path_.append(text(PathRow{step, pathLength, lambda, state.monitors(), negative, branch_, residual}));
}

std::vector<PointRow> Recorder::writePoints(const path::StepReport& report, const path::Series& series) {
  std::vector<PointRow> rows;
  for (const path::LimitPoint& p : report.limitPoints) {
    PointRow row{report.step, branch_, report.pathLengthStart + p.a, p.lambda,
                 p.maximum ? "maximum" : "minimum"};
    row.monitors = case_->at(series.state(p.a))->monitors();
    limitPoints_.push_back(row);
    rows.push_back(row);
  }
  for (const path::Extremum& e : report.extrema) {
    const path::State state = series.state(e.a);
    // A monitor that is zero by symmetry turns at random: what it changes by must be more than the residual
    // bound leaves open.
    const path::Vector& weights = *functionals_[e.monitor].weights;
    const auto value = series.functional(weights);
    const double change = std::max(std::abs(e.value - value(0)), std::abs(e.value - value(report.length)));
    if (!(change > case_->deck().path.residual * weights.norm2() * state.u->norm2())) continue;
    PointRow row{report.step, branch_, report.pathLengthStart + e.a, e.lambda,
                 (e.maximum ? "maximum:" : "minimum:") + functionals_[e.monitor].name};
    row.monitors = case_->at(state)->monitors();
    rows.push_back(row);
  }
  for (const path::CriticalPoint& p : report.criticalPoints) {
    PointRow row{report.step, branch_, report.pathLengthStart + p.a, p.state.lambda, path::toString(p.kind)};
    row.negativeChange = p.negativeChange;
    row.nullity = p.nullity;
    row.uncertainty = p.uncertainty;
    row.monitors = case_->at(p.state)->monitors();
    rows.push_back(row);
  }
  for (const path::HopfPoint& p : report.hopfPoints) {
    PointRow row{report.step, branch_, report.pathLengthStart + p.a, p.state.lambda, hopfKind};
    row.negativeChange = p.negativeChange;
    row.uncertainty = p.uncertainty;
    row.frequency = p.frequency;
    row.monitors = case_->at(p.state)->monitors();
    hopfPoints_.push_back(row);
    rows.push_back(row);
  }
  std::sort(rows.begin(), rows.end(),
            [](const PointRow& a, const PointRow& b) { return a.pathLength < b.pathLength; });
  for (const PointRow& row : rows) points_.append(text(row));
  return rows;
}

void Recorder::writeStep(const path::StepReport& report, const path::Series& series, const RunLog::Step& step,
                         long long negative) {
  StepRow row;
  row.step = report.step;
  row.branch = branch_;
  row.order = report.order;
  row.radius = report.radius;
  row.length = report.length;
  row.pathLength = report.pathLengthEnd;
  row.loadFactor = report.lambdaEnd;
  row.residual = report.residual;
  row.cutBacks = report.cutBacks;
  row.corrections = report.corrections;
  row.contacts = step.contacts;
  row.changes = step.changes;
  row.rational = report.pade;
  row.negative = negative;
  double power = 1;
  for (int k = 1; k <= series.order(); ++k) row.terms.push_back(series.norm(k) * (power *= report.length));
  steps_.append(text(row));
}

}  // namespace atrapos
