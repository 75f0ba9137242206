#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "Distribution.hpp"
#include "atrapos/fem/EventTerm.hpp"

namespace atrapos::fem {

/// The terms of a model that change at events, as one list of conditions: those of the first such term, then
/// those of the next.
///
/// On several ranks the list is that of the whole model, on every rank: values are put together from the
/// ranks' parts, changes are given to those that have entities of the condition. All but the queries is
/// collective then.
class EventTerms {
 public:
  /// All conditions are free.
  EventTerms(const std::vector<std::unique_ptr<Term>>& terms, const detail::Distribution& ranks);

  bool empty() const { return entries_.empty(); }
  int count() const { return static_cast<int>(conditions_.size()); }
  /// Number of the first condition of this term, or of the next one that has some.
  int first(int term) const;
  std::vector<double> order(int k, const ConstDofView& Uk, double lambdaK);
  /// Free conditions that touch at a state. Throws std::invalid_argument where one is below zero.
  std::vector<int> at(const ConstDofView& u, double lambda) const;
  /// path::Pieces::eventsAstray.
  bool astray(const ConstDofView& u, double lambda, const std::vector<int>& indices) const;
  /// The largest gap that is the rounding of coordinates. Collective.
  double touching(const ConstDofView& u) const;
  void apply(const std::vector<int>& indices);  ///< the same ones on every rank
  const std::vector<int>& conditions() const { return conditions_; }
  void setConditions(const std::vector<int>& conditions);  ///< the same ones on every rank
  /// path::Problem::growingAt with these conditions.
  std::vector<int> growing(const std::vector<int>& conditions) const;
  double negligibleFall(int condition) const;  ///< path::Problem::negligibleFall
  bool mayBeNone(int condition) const;         ///< path::Problem::eventMayBeNone
  int constraintPivots() const;
  /// Whether some conditions may change beside others.
  bool changeTogether() const;
  /// path::Problem::eventsBeside.
  std::vector<int> beside(const std::vector<int>& indices, const ConstDofView& u, double lambda) const;
  /// path::Problem::eventGradient, this rank's part of byU; nothing where there is none.
  std::optional<EventTerm::Gradient> gradient(int index, const ConstDofView& u, double lambda,
                                              const DofView& byU) const;
  /// Whether some conditions follow from the state.
  bool renews() const;
  /// Brings conditions up to date that follow from the state, on every rank.
  void renew(const ConstDofView& u, double lambda);
  void setStiffness(const std::vector<double>& ofNodes);

 private:
  struct Entry {
    EventTerm* term;
    int number;  ///< of the term in the model
    int first;   ///< number of its first condition
  };
  const Entry& entryOf(int condition) const;
  /// The list of what every term tells of its own conditions, `none` for others; on this rank.
  template <class Of>
  std::vector<double> list(double none, const Of& ofTerm) const;
  /// What a term tells of its own conditions, of all ranks together, 0 for others.
  template <class Of>
  std::vector<double> sum(const Entry& entry, const Of& ofTerm) const;
  static void put(const Entry& entry, const std::vector<double>& told, std::vector<double>& all);
  /// The mean gaps at a state; infinity of conditions that are not free or have nothing to touch.
  std::vector<double> gapsAt(const ConstDofView& u, double lambda) const;
  /// The numbers that a term's own conditions have in a list of all.
  template <class T>
  std::vector<T> own(const Entry& entry, const std::vector<T>& all) const;

  const detail::Distribution& ranks_;
  std::vector<Entry> entries_;
  std::vector<int> conditions_;  ///< 1 where active
  std::vector<double> covered_;  ///< EventTerm::covered, on the series under way; empty without pieces
  bool inPieces_ = false;        ///< some term is
};

}  // namespace atrapos::fem
