#pragma once

#include <memory>
#include <vector>

#include "Distribution.hpp"
#include "atrapos/fem/EventTerm.hpp"

namespace atrapos::fem {

/// The terms of a model that change at events, as one list of event functions: those of the first such term,
/// then those of the next.
///
/// On several ranks the list is that of the whole model, on every rank: values are put together from the
/// ranks' parts, changes are given to those that have the point. All but the queries is collective then.
class EventTerms {
 public:
  /// The terms while they are whole.
  explicit EventTerms(const std::vector<std::unique_ptr<Term>>& terms);
  /// From here on the terms are those of a rank's parts.
  void share(const detail::Distribution& ranks);

  bool empty() const { return entries_.empty(); }
  int count() const { return count_; }
  void order(int k, const ConstField& Uk, double lambdaK, std::vector<double>& g) const;
  std::vector<int> at(const ConstField& u, double lambda) const;
  void apply(const std::vector<int>& indices);  ///< the same ones on every rank
  std::vector<int> conditions() const;
  void setConditions(const std::vector<int>& conditions);  ///< the same ones on every rank
  int constraintPivots() const;
  void setStiffness(const std::vector<double>& ofNodes);

 private:
  struct Entry {
    EventTerm* term;
    int number;               ///< of the term in the model
    int first;                ///< number of its first event function
    std::vector<int> points;  ///< [point of the part] in the whole term
  };
  /// The numbers of every term's points in the list of the whole model, 0 at others' points; then their sum.
  template <class T, class Of>
  std::vector<T> together(const Of& ofTerm) const;

  std::vector<Entry> entries_;
  int count_ = 0;
  const detail::Distribution* ranks_ = nullptr;  ///< null: the terms are whole
};

}  // namespace atrapos::fem
