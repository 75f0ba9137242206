#include "EventTerms.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

namespace atrapos::fem {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

EventTerms::EventTerms(const std::vector<std::unique_ptr<Term>>& terms, const detail::Distribution& ranks)
    : ranks_(ranks) {
  int count = 0;
  for (std::size_t t = 0; t < terms.size(); ++t)
    if (auto* term = dynamic_cast<EventTerm*>(terms[t].get())) {
      entries_.push_back({term, static_cast<int>(t), count});
      inPieces_ = inPieces_ || term->pieces() != nullptr;
      count += term->eventCount();
    }
  conditions_.assign(count, 0);
}

int EventTerms::first(int term) const {
  for (const Entry& entry : entries_)
    if (entry.number >= term) return entry.first;
  return count();
}

template <class Of>
std::vector<double> EventTerms::list(double none, const Of& ofTerm) const {
  std::vector<double> all(count(), none);
  ranks_.together([&] {
    for (const Entry& entry : entries_) put(entry, ofTerm(*entry.term), all);
  });
  return all;
}

template <class Of>
std::vector<double> EventTerms::sum(const Entry& entry, const Of& ofTerm) const {
  std::vector<double> all(count(), 0.0);
  ranks_.together([&] { put(entry, ofTerm(*entry.term), all); });
  ranks_.sum(all);
  return all;
}

void EventTerms::put(const Entry& entry, const std::vector<double>& told, std::vector<double>& all) {
  const auto& numbers = entry.term->eventNumbers();
  for (std::size_t c = 0; c < numbers.size(); ++c) all[entry.first + numbers[c]] = told[c];
}

template <class T>
std::vector<T> EventTerms::own(const Entry& entry, const std::vector<T>& all) const {
  std::vector<T> result;
  for (const int number : entry.term->eventNumbers()) result.push_back(all[entry.first + number]);
  return result;
}

std::vector<double> EventTerms::order(int k, const ConstDofView& Uk, double lambdaK) {
  auto g = list(0, [&](const EventTerm& term) { return term.eventOrder(k, Uk, lambdaK); });
  ranks_.sum(g);
  if (!inPieces_) return g;
  if (k == 0) {
    covered_ = list(0, [](const EventTerm& term) { return term.covered(); });
    ranks_.sum(covered_);
  }
  // What has nothing to touch has the function 1, which has no root.
  for (std::size_t c = 0; c < g.size(); ++c) g[c] = covered_[c] > 0 ? g[c] / covered_[c] : k == 0 ? 1 : 0;
  return g;
}

std::vector<double> EventTerms::gapsAt(const ConstDofView& u, double lambda) const {
  std::vector<double> gaps(count(), 0.0), covered(count(), 0.0);
  ranks_.together([&] {
    for (const Entry& entry : entries_) {
      const EventTerm::MeanGaps told = entry.term->gapsAt(u, lambda);
      put(entry, told.sum, gaps);
      put(entry, told.covered, covered);
    }
  });
  ranks_.sum(gaps);
  ranks_.sum(covered);
  for (std::size_t c = 0; c < gaps.size(); ++c) gaps[c] = covered[c] > 0 ? gaps[c] / covered[c] : infinity;
  return gaps;
}

bool EventTerms::astray(const ConstDofView& u, double lambda, const std::vector<int>& indices) const {
  auto moved = list(0, [&](const EventTerm& term) { return term.moved(u, lambda); });
  ranks_.sum(moved);
  if (std::all_of(moved.begin(), moved.end(), [](double m) { return m == 0; })) return false;
  const auto gaps = gapsAt(u, lambda);
  for (const Entry& entry : entries_) {
    // Roots and states are good to some digits less than coordinates; another piece is further off.
    const double small = 100 * ranks_.max(entry.term->touching(u));
    for (int c = entry.first; c < entry.first + entry.term->eventCount(); ++c) {
      if (moved[c] == 0 || conditions_[c] == 1) continue;  // an active one tells its multiplier
      const bool falls = std::find(indices.begin(), indices.end(), c) != indices.end();
      if (gaps[c] < -small || (falls && gaps[c] > small)) return true;
    }
  }
  return false;
}

std::vector<int> EventTerms::at(const ConstDofView& u, double lambda) const {
  const auto gaps = gapsAt(u, lambda);
  std::vector<int> found;
  for (const Entry& entry : entries_) {
    const double touching = ranks_.max(entry.term->touching(u));
    for (int c = 0; c < entry.term->eventCount(); ++c) {
      const double gap = gaps[entry.first + c];
      if (gap < -touching) {
        std::ostringstream text;
        text << entry.term->eventText(c) << ' ' << -gap << ' ' << entry.term->violation();
        throw std::invalid_argument(text.str());
      }
      if (gap <= touching) found.push_back(entry.first + c);
    }
  }
  return found;
}

double EventTerms::touching(const ConstDofView& u) const {
  double largest = 0;
  for (const Entry& entry : entries_) largest = std::max(largest, entry.term->touching(u));
  return ranks_.max(largest);
}

void EventTerms::apply(const std::vector<int>& indices) {
  auto changed = conditions_;
  for (const int i : indices)
    if (i < count()) changed[i] = 1 - conditions_[i];
  setConditions(changed);
}

void EventTerms::setConditions(const std::vector<int>& conditions) {
  if (conditions.size() != conditions_.size())
    throw std::invalid_argument("conditions of " + std::to_string(conditions.size()) +
                                " contact points, but there are " + std::to_string(count()));
  if (conditions == conditions_) return;
  conditions_ = conditions;
  for (const Entry& entry : entries_) entry.term->setConditions(own(entry, conditions_));
}

int EventTerms::constraintPivots() const {
  int count = 0;
  for (const Entry& entry : entries_)
    if (entry.term->owesPivots()) {
      const auto first = conditions_.begin() + entry.first;
      count += static_cast<int>(std::count(first, first + entry.term->eventCount(), 1));
    }
  return count;
}

std::optional<EventTerm::Gradient> EventTerms::gradient(int index, const ConstDofView& u, double lambda,
                                                        const DofView& byU) const {
  EventTerm::Gradient own;
  ranks_.together([&] {
    for (const Entry& entry : entries_)
      if (index >= entry.first && index < entry.first + entry.term->eventCount())
        own = entry.term->eventGradient(index - entry.first, u, lambda, byU);
  });
  std::vector<double> sums{own.has, own.value, own.byLambda};
  ranks_.sum(sums);
  if (sums[0] == 0) return std::nullopt;
  return EventTerm::Gradient{sums[0], sums[1], sums[2]};
}

bool EventTerms::changeTogether() const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [](const Entry& entry) { return entry.term->renews() || entry.term->grows(false); });
}

std::vector<int> EventTerms::beside(const std::vector<int>& indices, const ConstDofView& u,
                                    double lambda) const {
  std::vector<int> all;
  for (const Entry& entry : entries_) {
    const int end = entry.first + entry.term->eventCount();
    if (entry.term->grows(false)) {
      const auto free = sum(entry, [&](const EventTerm& term) { return term.indifferent(u, lambda); });
      for (int c = entry.first; c < end; ++c)
        if (free[c] > 0) all.push_back(c);
    }
    const auto own = [&](int i) { return i >= entry.first && i < end; };
    if (!entry.term->renews() || std::none_of(indices.begin(), indices.end(), own)) continue;
    std::vector<double> known(count(), 0.0), distance(count(), 0.0);
    ranks_.together([&] {
      const EventTerm::Nearness near = entry.term->nearChange(u, lambda);
      put(entry, near.known, known);
      put(entry, near.distance, distance);
    });
    ranks_.sum(known);
    ranks_.sum(distance);
    // What begins with what is due, and what ends with it: as far from its change as that one, which the
    // series took for zero.
    for (int c = entry.first; c < end; ++c)
      if (known[c] > 0 && std::any_of(indices.begin(), indices.end(), [&](int i) {
            return own(i) && known[i] > 0 && std::abs(distance[c] - distance[i]) < 1 &&
                   conditions_[i] == conditions_[c];
          }))
        all.push_back(c);
  }
  return all;
}

std::vector<int> EventTerms::growing(const std::vector<int>& conditions) const {
  std::vector<int> all;
  for (const Entry& entry : entries_) {
    const bool grows[] = {entry.term->grows(false), entry.term->grows(true)};
    for (int c = entry.first; c < entry.first + entry.term->eventCount(); ++c)
      if (grows[conditions[c]]) all.push_back(c);
  }
  return all;
}

const EventTerms::Entry& EventTerms::entryOf(int condition) const {
  const auto behind = [condition](const Entry& entry) { return entry.first > condition; };
  return *std::prev(std::find_if(entries_.begin(), entries_.end(), behind));
}

double EventTerms::negligibleFall(int condition) const { return entryOf(condition).term->negligibleFall(); }

bool EventTerms::mayBeNone(int condition) const {
  const Entry& entry = entryOf(condition);
  return entry.term->mayBeNone(condition - entry.first);
}

bool EventTerms::renews() const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [](const Entry& entry) { return entry.term->renews(); });
}

void EventTerms::renew(const ConstDofView& u, double lambda) {
  std::vector<int> now = conditions_;
  for (const Entry& entry : entries_) {
    if (!entry.term->renews()) continue;
    const auto on = sum(entry, [&](const EventTerm& term) { return term.renewed(u, lambda); });
    for (int c = entry.first; c < entry.first + entry.term->eventCount(); ++c) now[c] = on[c] > 0;
  }
  setConditions(now);
}

void EventTerms::setStiffness(const std::vector<double>& ofNodes) {
  auto least = list(infinity, [&](const EventTerm& term) { return term.leastStiffness(ofNodes); });
  ranks_.min(least);
  for (const Entry& entry : entries_) {
    double largest = 0;
    for (int c = 0; c < entry.term->eventCount(); ++c)
      if (const double k = least[entry.first + c]; k < infinity) largest = std::max(largest, k);
    entry.term->setStiffness(own(entry, least), largest);
  }
}

}  // namespace atrapos::fem
