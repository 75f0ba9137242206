#include "EventTerms.hpp"

#include <stdexcept>
#include <string>

namespace atrapos::fem {

EventTerms::EventTerms(const std::vector<std::unique_ptr<Term>>& terms) {
  for (const auto& term : terms)
    if (auto* t = dynamic_cast<EventTerm*>(term.get())) terms_.push_back(t);
}

int EventTerms::count() const {
  int sum = 0;
  for (const auto* t : terms_) sum += t->eventCount();
  return sum;
}

void EventTerms::order(int k, const ConstField& Uk, double lambdaK, std::vector<double>& g) const {
  double* own = g.data();
  for (const auto* t : terms_) {
    t->eventOrder(k, Uk, lambdaK, own);
    own += t->eventCount();
  }
}

std::vector<int> EventTerms::at(const ConstField& u, double lambda) const {
  std::vector<int> all;
  int first = 0;
  for (const auto* t : terms_) {
    for (const int p : t->eventsAt(u, lambda)) all.push_back(first + p);
    first += t->eventCount();
  }
  return all;
}

void EventTerms::apply(const std::vector<int>& indices) {
  int first = 0;
  for (auto* t : terms_) {
    std::vector<int> own;
    for (const int i : indices)
      if (i >= first && i < first + t->eventCount()) own.push_back(i - first);
    if (!own.empty()) t->applyEvent(own);
    first += t->eventCount();
  }
}

std::vector<int> EventTerms::conditions() const {
  std::vector<int> all;
  for (const auto* t : terms_) {
    const auto own = t->conditions();
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

void EventTerms::setConditions(const std::vector<int>& conditions) {
  if (conditions.size() != static_cast<std::size_t>(count()))
    throw std::invalid_argument("conditions of " + std::to_string(conditions.size()) +
                                " contact points, but there are " + std::to_string(count()));
  auto own = conditions.begin();
  for (auto* t : terms_) {
    t->setConditions({own, own + t->eventCount()});
    own += t->eventCount();
  }
}

int EventTerms::constraintPivots() const {
  int sum = 0;
  for (const auto* t : terms_) sum += t->constraintPivots();
  return sum;
}

void EventTerms::setStiffness(const std::vector<double>& ofNodes) {
  for (auto* t : terms_) t->setStiffness(ofNodes);
}

}  // namespace atrapos::fem
