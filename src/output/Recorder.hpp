#pragma once

#include <chrono>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "atrapos/path/Branches.hpp"
#include "commands/PathCase.hpp"
#include "output/PathTable.hpp"
#include "output/RunLog.hpp"
#include "restart/RestartFile.hpp"

namespace atrapos {

/// A step as a program that embeds the run sees it.
struct StepTaken {
  int branch = 0;
  const path::StepReport& report;
  const std::vector<double>& monitors;  ///< at its end, in the deck's order
};

/// Writes what a run finds, step by step: path.csv, points.csv, steps.csv, events.csv, restart.bin,
/// results.exo and results_branch<n>.exo; one line a step for the user. Every finished step is with the
/// system before the next one begins, its restart record last; about every second all files are made to
/// outlast a loss of power. On several ranks all call it and the first one writes, but for result files in
/// parts (output/parts).
///
/// Files are written beside those of an earlier run, and take their places with the first step, or when what
/// the run goes on with is taken over whole: what ends a run before leaves the earlier results as they were.
class Recorder final : public path::BranchObserver {
 public:
  /// `progress` may be null; `problem`: whose path is under way at the beginning, that of the case or an
  /// imperfect one; `runProblem`: of the perfect one. Throws std::invalid_argument where the continued run
  /// does not fit the deck.
  Recorder(PathCase& pathCase, path::Problem& problem, const RunProblem& runProblem, std::string directory,
           std::ostream* progress, const std::optional<Continued>& continued);
  ~Recorder() override;

  void onBranch(const path::BranchDiagram& diagram, int branch) override;
  /// A path of another case or problem as another branch, with a line for the user; the case and the problem,
  /// whose residual counts, must outlive its steps.
  void beginOther(PathCase& pathCase, path::Problem& problem, int branch, const std::string& line);
  /// Gets every step when it is written.
  void setAfterStep(std::function<void(const StepTaken&)> f) { afterStep_ = std::move(f); }
  /// False where the run is to end (Interrupt).
  bool onStep(int branch, const path::StepReport& report, const path::Series& series) override;
  /// A line for the user where the last one is long ago.
  void onSearch(int branch, int found, int wanted) override;
  void onProgress(const path::BranchProgress& progress) override;

  /// Writes the start of the path under way where no step was made.
  void finish(const path::State& start);

  /// Of the load factor, on all branches, those of the run that this one goes on with included.
  const std::vector<PointRow>& limitPoints() const { return limitPoints_; }
  const std::vector<PointRow>& hopfPoints() const { return hopfPoints_; }
  int contactEvents() const { return watched_ + (watch_ ? watch_->count() : 0); }
  /// What the states at the ends of steps have made no use of so far; of a run that goes on with another one
  /// nothing, as that one's steps are not known.
  const Costs& unused() const { return unused_; }
  double worstResidual() const { return worstResidual_; }  ///< over all output points
  double outputSeconds() const { return outputSeconds_; }
  double seconds() const;

 private:
  /// The new files beside the others, removed where they do not take their places.
  class Beside {
   public:
    explicit Beside(std::string directory) : directory_(std::move(directory)) {}
    Beside(const Beside&) = delete;
    Beside& operator=(const Beside&) = delete;
    ~Beside() {
      if (!kept_) remove();
    }
    void remove() const;
    std::string name(const std::string& file) const;
    void keep() { kept_ = true; }

   private:
    std::string directory_;
    bool kept_ = false;
  };

  std::string file(const std::string& name) const { return directory_ + "/" + name; }
  void begin(int branch);
  void goOn(const Continued& continued);
  /// Puts the new files in their places and removes what an earlier run has besides, the result files of
  /// branches up to `kept` excepted. Collective.
  void settle(int kept);
  RunMarks marks() const;
  void sync();
  void writeStart(const path::State& state, long long negative);
  void writeRow(int step, double pathLength, double lambda, const CaseState& state, long long negative,
                double residual);
  /// Whether the state at the end of a step goes into the result file.
  bool hasFields(int step, bool atStop) const;
  /// How many of them do, up to this step.
  int numFieldStates(int steps, bool atStop) const;
  double residualAt(const path::State& state);
  std::vector<PointRow> writePoints(const path::StepReport& report, const path::Series& series);
  void writeStep(const path::StepReport& report, const path::Series& series, const RunLog::Step& step,
                 long long negative);

  PathCase* case_;          ///< under way
  path::Problem* problem_;  ///< its own, or an imperfect one
  std::vector<path::Monitor> functionals_;
  std::string directory_;
  RunLog log_;
  Beside beside_;
  Table path_, points_, steps_;
  std::optional<RestartFile> restart_;
  std::unique_ptr<FieldFile> fields_;  ///< of the branch under way
  std::unique_ptr<StepWatch> watch_;
  path::RCP<path::Vector> residual_;
  std::chrono::steady_clock::time_point start_;
  std::function<void(const StepTaken&)> afterStep_;
  int branch_ = 0;
  bool started_ = false;  ///< the start of the branch under way is written
  bool settled_ = false;
  std::vector<PointRow> limitPoints_, hopfPoints_;
  int watched_ = 0;  ///< by watches of other cases
  Costs unused_;
  double worstResidual_ = 0, outputSeconds_ = 0;
  double synced_ = 0;  ///< seconds() where files were made to last
};

}  // namespace atrapos
