#include "EventTerms.hpp"

#include <numeric>
#include <stdexcept>
#include <string>

namespace atrapos::fem {

EventTerms::EventTerms(const std::vector<std::unique_ptr<Term>>& terms) {
  for (std::size_t t = 0; t < terms.size(); ++t)
    if (auto* term = dynamic_cast<EventTerm*>(terms[t].get())) {
      std::vector<int> points(term->eventCount());
      std::iota(points.begin(), points.end(), 0);
      entries_.push_back({term, static_cast<int>(t), count_, std::move(points)});
      count_ += term->eventCount();
    }
}

void EventTerms::share(const detail::Distribution& ranks) {
  if (ranks.alone()) return;
  ranks_ = &ranks;
  for (Entry& entry : entries_) {
    entry.points = ranks.entities()[entry.number];
    if (entry.term->eventCount() != static_cast<int>(entry.points.size()))
      throw std::logic_error("EventTerms: a term that is shared out has one event function an entity");
  }
}

template <class T, class Of>
std::vector<T> EventTerms::together(const Of& ofTerm) const {
  std::vector<double> all(count_, 0.0);
  const auto fill = [&] {
    for (const Entry& entry : entries_) {
      const auto own = ofTerm(*entry.term);
      for (std::size_t p = 0; p < entry.points.size(); ++p) all[entry.first + entry.points[p]] = own[p];
    }
  };
  if (ranks_ == nullptr) {
    fill();
  } else {
    ranks_->together(fill);
    ranks_->sum(all);
  }
  return {all.begin(), all.end()};
}

void EventTerms::order(int k, const ConstField& Uk, double lambdaK, std::vector<double>& g) const {
  g = together<double>([&](const EventTerm& term) {
    std::vector<double> own(term.eventCount());
    term.eventOrder(k, Uk, lambdaK, own.data());
    return own;
  });
}

std::vector<int> EventTerms::at(const ConstField& u, double lambda) const {
  const auto zero = together<int>([&](const EventTerm& term) {
    std::vector<int> flags(term.eventCount(), 0);
    for (const int p : term.eventsAt(u, lambda)) flags[p] = 1;
    return flags;
  });
  std::vector<int> indices;
  for (int i = 0; i < count_; ++i)
    if (zero[i] != 0) indices.push_back(i);
  return indices;
}

void EventTerms::apply(const std::vector<int>& indices) {
  std::vector<char> named(count_, 0);
  for (const int i : indices)
    if (i < count_) named[i] = 1;
  for (const Entry& entry : entries_) {
    std::vector<int> own;
    for (std::size_t p = 0; p < entry.points.size(); ++p)
      if (named[entry.first + entry.points[p]]) own.push_back(static_cast<int>(p));
    if (!own.empty()) entry.term->applyEvent(own);
  }
}

std::vector<int> EventTerms::conditions() const {
  return together<int>([](const EventTerm& term) { return term.conditions(); });
}

void EventTerms::setConditions(const std::vector<int>& conditions) {
  if (conditions.size() != static_cast<std::size_t>(count_))
    throw std::invalid_argument("conditions of " + std::to_string(conditions.size()) +
                                " contact points, but there are " + std::to_string(count_));
  for (const Entry& entry : entries_) {
    std::vector<int> own;
    for (const int p : entry.points) own.push_back(conditions[entry.first + p]);
    entry.term->setConditions(own);
  }
}

int EventTerms::constraintPivots() const {
  int sum = 0;
  for (const Entry& entry : entries_) sum += entry.term->constraintPivots();
  return ranks_ == nullptr ? sum : static_cast<int>(ranks_->sum(sum));
}

void EventTerms::setStiffness(const std::vector<double>& ofNodes) {
  for (const Entry& entry : entries_) entry.term->setStiffness(ofNodes);
}

}  // namespace atrapos::fem
