#pragma once

#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "atrapos/linear/TangentSolver.hpp"
#include "atrapos/path/Monitor.hpp"
#include "atrapos/path/Options.hpp"
#include "atrapos/path/Series.hpp"
#include "atrapos/path/Stops.hpp"
#include "deck/Deck.hpp"
#include "restart/RestartRecord.hpp"

namespace atrapos {

/// Entries of the deck that cost work even where the path makes no use of them, and a line on each for the
/// user in that case: "contact/lower" -> "none of its points has closed".
using Costs = std::map<std::string, std::string>;

/// A state of a case, to which it refers. What it shows is evaluated when it is first asked for, and once;
/// the case's problem must stay as it is meanwhile. Collective.
class CaseState {
 public:
  virtual ~CaseState() = default;
  /// Values of the monitors, in the order of their names.
  virtual std::vector<double> monitors() const = 0;
  /// Closed contact points.
  virtual int activeContacts() const { return 0; }
  /// Takes away what the state makes use of from the entries of the deck that cost without being used
  /// (PathCase::costs).
  virtual void strikeUsed(Costs& /*costs*/) const {}
};

/// Numbers of a state that go into the result file beside the fields.
struct StateNumbers {
  double lambda = 0, pathLength = 0, radius = 0, residual = 0;
  int order = 0;
  long long negative = -1;  ///< negative eigenvalues of the tangent; -1: not known
  int branch = 0;
};

/// A result file with whole states, for viewers.
class FieldFile {
 public:
  virtual ~FieldFile() = default;
  /// A state of the case that made the file.
  virtual void write(const CaseState& state, const StateNumbers& numbers) = 0;
  /// Takes over the first `count` states of an earlier file: those up to this length of the path. Throws
  /// std::invalid_argument, one line, where it holds others than this one, or than those that `mark` was
  /// taken of.
  virtual void copyFrom(const std::string& file, int count, double pathLength, const Mark& mark) = 0;
  /// The states so far: the same whoever has written them, and in whatever parts.
  virtual Mark mark() const = 0;
  /// Gives the file another name, under which it goes on.
  virtual void rename(const std::string& file) = 0;
  /// Until what was written would outlast a loss of power.
  virtual void sync() const = 0;
};

/// Looks at every step for what belongs to one kind of case, and writes it to a table of its own.
class StepWatch {
 public:
  virtual ~StepWatch() = default;
  /// `end`: the state at the end of the step, before the `events` there change the problem
  /// (path::StepReport), of the case that made the watch.
  virtual void onStep(int branch, int step, double pathLengthStart, double length, const path::Series& series,
                      const CaseState& end, const std::vector<int>& events) = 0;
  /// Takes over what an earlier run wrote up to the step `last`. Throws std::invalid_argument, one line,
  /// where that was another table, or its rows are not those that `mark` was taken of.
  virtual void copyFrom(const std::string& file, const RestartPlace& last, const Mark& mark) = 0;
  virtual Mark mark() const = 0;  ///< the rows so far
  virtual void sync() const = 0;  ///< until they would outlast a loss of power
  /// Puts the table in the place of another.
  virtual void rename(const std::string& file) = 0;
  virtual int count() const = 0;  ///< of what was found
};

/// What a run follows the path of, and what it watches on the way: a finite-element scene or a model problem.
class PathCase {
 public:
  virtual ~PathCase() = default;

  virtual const deck::Deck& deck() const = 0;
  virtual path::Problem& problem() = 0;
  virtual path::State start() const = 0;
  virtual path::Stops stops() const = 0;
  /// In which sense the path starts, of which path/direction: -1 is the other.
  virtual double direction() const { return 1; }

  /// What a restart compares of the body; empty where there is none.
  virtual MeshDigest meshDigest() const { return {}; }

  virtual std::vector<std::string> monitorNames() const = 0;
  virtual std::unique_ptr<CaseState> at(const path::State& state) const = 0;

  /// The monitors that are linear functionals of the unknowns: their limit points are reported.
  virtual std::vector<path::Monitor> functionals() const = 0;

  /// Null where there are no fields to write.
  virtual std::unique_ptr<FieldFile> makeFieldFile(const std::string& /*file*/) const { return nullptr; }
  /// Null where there is nothing to watch. `append`: goes on with the file.
  virtual std::unique_ptr<StepWatch> makeWatch(const std::string& /*file*/, bool /*append*/) const {
    return nullptr;
  }
  /// The same with another undeformed body: its nodes moved by the displacements of `shape`, a vector on the
  /// problem's map, times such a number that the largest one is `size`. Directors of shells are normal to the
  /// moved middle surface. Null where there is no body.
  virtual std::unique_ptr<PathCase> moved(const path::Vector& /*shape*/, double /*size*/) const {
    return nullptr;
  }
  /// The same body under another deck of the same mesh, for a path that begins at `start` of this case's
  /// problem or one made so. Null where there is no body.
  virtual std::unique_ptr<PathCase> under(const deck::Deck& /*deck*/, const path::State& /*start*/) const {
    return nullptr;
  }
  virtual Costs costs() const { return {}; }
  /// Lines for the user before the first step: what was chosen for him.
  virtual std::vector<std::string> remarks() const { return {}; }
  /// Whether the step leads where the problem has to be another one, as it is from now on: the step has to be
  /// made again from its start.
  virtual bool changedOn(double /*length*/, const path::Series& /*series*/) { return false; }
  /// What belongs into summary.json besides.
  virtual void summarize(nlohmann::ordered_json& /*summary*/) const {}
  /// What the deck asks for where the path has reached its stop; a line for the user, or none.
  virtual std::string finish(const path::State& /*end*/, const path::Options& /*options*/,
                             linear::TangentSolver& /*solver*/, const std::string& /*directory*/,
                             nlohmann::ordered_json& /*summary*/) {
    return {};
  }
  /// Bytes of the histories that a run of this deck will keep; 0: few.
  virtual double historyBytes() { return 0; }
  /// Sizes for summary.json: name -> number.
  virtual std::vector<std::pair<std::string, long long>> sizes() const = 0;
};

}  // namespace atrapos
