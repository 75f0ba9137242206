#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "atrapos/path/Monitor.hpp"
#include "atrapos/path/Stops.hpp"
#include "deck/Deck.hpp"

namespace atrapos {

/// Numbers of a state that go into the result file beside the fields.
struct StateNumbers {
  double pathLength = 0, radius = 0, residual = 0;
  int order = 0;
  long long negative = -1;  ///< negative eigenvalues of the tangent; -1: not known
  int branch = 0;
};

/// A result file with whole states, for viewers.
class FieldFile {
 public:
  virtual ~FieldFile() = default;
  virtual void write(const path::Vector& u, double lambda, const StateNumbers& numbers) = 0;
  /// Takes over the first `count` states of an earlier file. Throws std::invalid_argument, one line, where it
  /// holds others than this one.
  virtual void copyFrom(const std::string& file, int count) = 0;
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

  virtual std::vector<std::string> monitorNames() const = 0;
  /// Values of the monitors, in the order of their names.
  virtual std::vector<double> monitors(const path::Vector& u, double lambda) const = 0;

  /// The monitors that are linear functionals of the unknowns: their limit points are reported.
  virtual std::vector<path::Monitor> functionals() const = 0;

  /// Closed contact points.
  virtual int activeContacts(const path::Vector& /*u*/, double /*lambda*/) const { return 0; }
  /// Null where there are no fields to write.
  virtual std::unique_ptr<FieldFile> makeFieldFile(const std::string& /*file*/) const { return nullptr; }
  /// Sizes for summary.json: name -> number.
  virtual std::vector<std::pair<std::string, long long>> sizes() const = 0;
};

}  // namespace atrapos
