#include "PieceTerms.hpp"

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "atrapos/fem/PointPieces.hpp"
#include "atrapos/path/Series.hpp"

namespace atrapos::fem {

PieceTerms::PieceTerms(const std::vector<std::unique_ptr<Term>>& terms, const EventTerms& events,
                       const detail::Distribution& ranks, Local local, Residual residual)
    : events_(events),
      ranks_(ranks),
      local_(std::move(local)),
      residual_(std::move(residual)),
      firstIndex_(events.count()) {
  int firstIndex = firstIndex_;
  for (std::size_t t = 0; t < terms.size(); ++t)
    if (PointPieces* pieces = terms[t]->pieces()) {
      entries_.push_back({terms[t].get(), pieces, firstIndex});
      firstIndex += pieces->numWhole() * (pieces->count() + 1);
    }
}

template <class Of>
std::vector<int> PieceTerms::ofAllPoints(const Entry& entry, const Of& of) const {
  std::vector<double> all(entry.pieces->numWhole(), 0.0);
  ranks_.together([&] {
    for (int p = 0; p < entry.pieces->numPoints(); ++p) all[entry.pieces->numbers()[p]] = of(p);
  });
  ranks_.sum(all);
  return {all.begin(), all.end()};
}

template <class Of>
int PieceTerms::ofPoint(const Entry& entry, int point, const Of& of) const {
  const auto& numbers = entry.pieces->numbers();
  const auto at = std::lower_bound(numbers.begin(), numbers.end(), point);
  double told = 0;
  ranks_.together([&] {
    if (at != numbers.end() && *at == point) told = of(static_cast<int>(at - numbers.begin()));
  });
  return static_cast<int>(ranks_.sum(told));
}

std::vector<int> PieceTerms::piecesAt(const Entry& entry, const path::State& state) const {
  const auto places = entry.term->places(local_(state), state.lambda);
  const std::size_t stride = entry.pieces->numInputs();
  return ofAllPoints(entry, [&](int p) { return entry.pieces->pieceAt(p, &places[p * stride]); });
}

int PieceTerms::pieceAt(const Entry& entry, int point, const std::vector<double>& places) const {
  const std::size_t stride = entry.pieces->numInputs();
  return ofPoint(entry, point, [&](int p) { return entry.pieces->pieceAt(p, &places[p * stride]); });
}

int PieceTerms::pieceOfSeries(const Entry& entry, int point) const {
  return ofPoint(entry, point, [&](int p) { return entry.pieces->pieceOfSeries(p); });
}

path::ResidualNorm PieceTerms::residualOfSeries(const path::State& state, path::Vector& r) {
  struct Held {
    const std::vector<Entry>& entries;
    explicit Held(const std::vector<Entry>& e) : entries(e) { set(true); }
    ~Held() { set(false); }
    void set(bool held) {
      for (const Entry& entry : entries) entry.pieces->hold(held);
    }
  } held(entries_);
  return residual_(state, r);
}

bool PieceTerms::eventsAstray(const path::State& state, const std::vector<int>& events) const {
  return !events_.empty() && events_.astray(local_(state), state.lambda, events);
}

/// Where a point's piece is another one at two neighbouring places of some on the series, the border in
/// between is found by halving, down to rounding.
std::vector<path::Break> PieceTerms::breaks(const path::Series& series, double end) const {
  constexpr int intervals = 16, mostBetween = 4;
  path::State state = series.state(0);
  std::vector<path::Break> found;
  for (const Entry& entry : entries_) {
    // Points that symmetry lets pass together are looked for at the same places.
    std::map<double, std::vector<double>> placesOn;
    const auto pieceOn = [&](double a, int point) {
      auto at = placesOn.find(a);
      if (at == placesOn.end()) {
        state.lambda = series.evaluate(a, *state.u);
        at = placesOn.emplace(a, entry.term->places(local_(state), state.lambda)).first;
      }
      return pieceAt(entry, point, at->second);
    };
    auto before = ofAllPoints(entry, [&](int p) { return entry.pieces->pieceOfSeries(p); });
    for (int j = 1; j <= intervals; ++j) {
      const double to = end * j / intervals;
      state.lambda = series.evaluate(to, *state.u);
      const auto lasts = piecesAt(entry, state);
      for (std::size_t p = 0; p < before.size(); ++p) {
        const int last = lasts[p];
        if (before[p] == PointPieces::any || last == PointPieces::any) continue;  // has no part in the series
        double from = end * (j - 1) / intervals;
        for (int n = 0; before[p] != last && n < mostBetween; ++n) {
          double low = from, high = to;
          int beyond = last;
          while (high - low > 4e-16 * to) {
            const double middle = 0.5 * (low + high);
            if (middle <= low || middle >= high) break;
            const int piece = pieceOn(middle, static_cast<int>(p));
            if (piece == before[p]) {
              low = middle;
            } else {
              high = middle;
              beyond = piece;
            }
          }
          if (beyond == PointPieces::any) break;
          // Before it, where nothing has jumped yet; only at the series' start there is no before.
          const int index = static_cast<int>(p) * (entry.pieces->count() + 1) + beyond + 1;
          found.push_back({low > 0 ? low : high, entry.firstIndex + index});
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

bool PieceTerms::continues(const path::State& state, int index) const {
  const Place at = placeOf(index);
  const int own = pieceOfSeries(*at.entry, at.point);
  // High above a crease a point may prefer a piece that it is not over: its place alone decides.
  const auto prefers = [&](int p) { return at.entry->pieces->preferred()[p]; };
  if (own != at.piece && ofPoint(*at.entry, at.point, prefers) == at.piece) return true;
  return pieceAt(*at.entry, at.point, at.entry->term->places(local_(state), state.lambda)) == own;
}

std::string PieceTerms::text(int index) const {
  const Place at = placeOf(index);
  const std::string point = at.entry->pieces->called() + " " + std::to_string(at.point + 1) + " (of " +
                            std::to_string(at.entry->pieces->numWhole()) + ")";
  if (at.piece < 0) return point + " slides over an edge of its tool while it is pressed";
  if (pieceOfSeries(*at.entry, at.point) == -1)
    return point + " comes over an edge of its tool into its surface";
  return point + " comes to patch " + std::to_string(at.piece + 1) +
         " of its tool, where its force would jump: the surface has a crease or a gap there";
}

void PieceTerms::apply(const std::vector<int>& indices, const ConstDofView& u, double lambda) {
  for (const int i : indices) {
    if (i < firstIndex_) continue;
    const Place at = placeOf(i);
    PointPieces& pieces = *at.entry->pieces;
    const int prefers = ofPoint(*at.entry, at.point, [&](int p) {
      pieces.toggle(p, at.piece);
      return pieces.preferred()[p];
    });
    if (prefers != PointPieces::any && !events_.empty() && events_.astray(u, lambda, {}))
      throw std::runtime_error(text(i));
  }
}

int PieceTerms::numPoints() const {
  int sum = 0;
  for (const Entry& entry : entries_) sum += entry.pieces->numWhole();
  return sum;
}

std::vector<int> PieceTerms::conditions() const {
  std::vector<int> all;
  for (const Entry& entry : entries_) {
    const auto own = ofAllPoints(entry, [&](int p) { return entry.pieces->preferred()[p]; });
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

void PieceTerms::setConditions(const std::vector<int>& conditions) {
  auto first = conditions.begin();
  ranks_.together([&] {
    for (const Entry& entry : entries_) {
      std::vector<int> own;
      for (const int p : entry.pieces->numbers()) own.push_back(first[p]);
      entry.pieces->setPreferred(own);
      first += entry.pieces->numWhole();
    }
  });
}

}  // namespace atrapos::fem
