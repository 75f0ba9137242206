#include "PieceTerms.hpp"

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "atrapos/fem/EventTerm.hpp"
#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/fem/PointPieces.hpp"
#include "atrapos/path/Series.hpp"

namespace atrapos::fem {

PieceTerms::PieceTerms(const std::vector<std::unique_ptr<Term>>& terms, int firstIndex,
                       std::function<path::ResidualNorm(const path::Vector&, double, path::Vector&)> residual)
    : firstIndex_(firstIndex), residual_(std::move(residual)) {
  int firstEvent = 0;
  for (const auto& term : terms) {
    auto* events = dynamic_cast<EventTerm*>(term.get());
    if (PointPieces* pieces = term->pieces()) {
      entries_.push_back({term.get(), pieces, events, firstEvent, firstIndex});
      firstIndex += pieces->numPoints() * (pieces->count() + 1);
    }
    if (events) firstEvent += events->eventCount();
  }
}

path::ResidualNorm PieceTerms::residualOfSeries(const path::Vector& u, double lambda, path::Vector& r) {
  struct Held {
    const std::vector<Entry>& entries;
    explicit Held(const std::vector<Entry>& e) : entries(e) { set(true); }
    ~Held() { set(false); }
    void set(bool held) {
      for (const Entry& entry : entries) entry.pieces->hold(held);
    }
  } held(entries_);
  return residual_(u, lambda, r);
}

bool PieceTerms::eventsAstray(const path::Vector& u, double lambda, const std::vector<int>& events) const {
  for (const Entry& entry : entries_) {
    if (!entry.events) continue;
    std::vector<int> own;
    for (const int i : events)
      if (i >= entry.firstEvent && i < entry.firstEvent + entry.events->eventCount())
        own.push_back(i - entry.firstEvent);
    if (entry.events->eventsAstray(field(u), lambda, own)) return true;
  }
  return false;
}

/// Where a point's piece is another one at two neighbouring places of some on the series, the border in
/// between is found by halving, down to rounding.
std::vector<path::Break> PieceTerms::breaks(const path::Series& series, double end) const {
  constexpr int intervals = 16, mostBetween = 4;
  path::Vector u(series.coefficient(0).u->getMap());
  std::vector<path::Break> found;
  for (const Entry& entry : entries_) {
    const int numPoints = entry.pieces->numPoints(), stride = entry.pieces->numInputs();
    const auto pieceAt = [&](double a, int point) {
      const double lambda = series.evaluate(a, u);
      const auto places = entry.term->places(field(u), lambda);
      return entry.pieces->pieceAt(point, &places[static_cast<std::size_t>(point) * stride]);
    };
    std::vector<int> before(numPoints);
    for (int p = 0; p < numPoints; ++p) before[p] = entry.pieces->pieceOfSeries(p);
    for (int j = 1; j <= intervals; ++j) {
      const double to = end * j / intervals;
      const double lambda = series.evaluate(to, u);
      const auto places = entry.term->places(field(u), lambda);
      for (int p = 0; p < numPoints; ++p) {
        if (before[p] == PointPieces::any) continue;  // has no part in the series
        const int last = entry.pieces->pieceAt(p, &places[static_cast<std::size_t>(p) * stride]);
        double from = end * (j - 1) / intervals;
        for (int n = 0; before[p] != last && n < mostBetween; ++n) {
          double low = from, high = to;
          int beyond = last;
          while (high - low > 4e-16 * to) {
            const double middle = 0.5 * (low + high);
            if (middle <= low || middle >= high) break;
            const int piece = pieceAt(middle, p);
            if (piece == before[p]) {
              low = middle;
            } else {
              high = middle;
              beyond = piece;
            }
          }
          // Before it, where nothing has jumped yet; only at the series' start there is no before.
          found.push_back(
              {low > 0 ? low : high, entry.firstIndex + p * (entry.pieces->count() + 1) + beyond + 1});
          before[p] = beyond;
          from = high;
        }
        before[p] = last;
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const path::Break& a, const path::Break& b) { return a.a < b.a; });
  return found;
}

PieceTerms::Place PieceTerms::placeOf(int index) const {
  const Entry* at = nullptr;
  for (const Entry& entry : entries_)
    if (index >= entry.firstIndex) at = &entry;
  if (at == nullptr) throw std::logic_error("PieceTerms: not a break");
  const int n = at->pieces->count() + 1, local = index - at->firstIndex;
  return {at, local / n, local % n - 1};
}

bool PieceTerms::continues(const path::Vector& u, double lambda, int index) const {
  const Place at = placeOf(index);
  const auto places = at.entry->term->places(field(u), lambda);
  const double* place = &places[static_cast<std::size_t>(at.point) * at.entry->pieces->numInputs()];
  return at.entry->pieces->pieceAt(at.point, place) == at.entry->pieces->pieceOfSeries(at.point);
}

std::string PieceTerms::text(int index) const {
  const Place at = placeOf(index);
  const std::string point = "contact point " + std::to_string(at.point + 1) + " (of " +
                            std::to_string(at.entry->pieces->numPoints()) + ")";
  if (at.piece < 0) return point + " slides over an edge of its tool while it is pressed";
  if (at.entry->pieces->pieceOfSeries(at.point) == -1)
    return point + " comes over an edge of its tool into its surface";
  return point + " comes to patch " + std::to_string(at.piece + 1) +
         " of its tool, where its force would jump: the surface has a crease or a gap there";
}

void PieceTerms::apply(const std::vector<int>& indices, const path::Vector& u, double lambda) {
  for (const int i : indices) {
    if (i < firstIndex_) continue;
    const Place at = placeOf(i);
    at.entry->pieces->toggle(at.point, at.piece);
    if (at.entry->events && at.entry->pieces->preferred()[at.point] != PointPieces::any &&
        at.entry->events->eventsAstray(field(u), lambda, {}))
      throw std::runtime_error(text(i));
  }
}

int PieceTerms::numPoints() const {
  int sum = 0;
  for (const Entry& entry : entries_) sum += entry.pieces->numPoints();
  return sum;
}

std::vector<int> PieceTerms::conditions() const {
  std::vector<int> all;
  for (const Entry& entry : entries_) {
    const auto& own = entry.pieces->preferred();
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

void PieceTerms::setConditions(const std::vector<int>& conditions) {
  auto own = conditions.begin();
  for (const Entry& entry : entries_) {
    entry.pieces->setPreferred({own, own + entry.pieces->numPoints()});
    own += entry.pieces->numPoints();
  }
}

}  // namespace atrapos::fem
