#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>

#include <Tpetra_Vector.hpp>

#include "Augmented.hpp"
#include "Search.hpp"
#include "atrapos/linear/Determinant.hpp"
#include "atrapos/linear/Dot.hpp"

namespace atrapos::path {

bool oddBetween(const CountedPlace& first, const CountedPlace& second) {
  return ((second.negative - first.negative) % 2 != 0) != (first.rising != second.rising);
}

int provenBetween(const CountedPlace& first, const CountedPlace& second,
                  const std::vector<LimitPoint>& limits) {
  const auto passed = std::count_if(limits.begin(), limits.end(), [&](const LimitPoint& limit) {
    return limit.a > first.a && limit.a < second.a;
  });
  const long long change = std::llabs(second.negative - first.negative);
  return static_cast<int>(std::max<long long>(change - passed, oddBetween(first, second)));
}

/// How many eigenvalues change sign for certain between places i and i + 1 and belong to no point found.
int Search::owed(std::size_t i) const {
  const CountedPlace &first = places_[i].count, &second = places_[i + 1].count;
  int number = provenBetween(first, second, search_.limits);
  for (const auto& p : found_.points)
    if (p.a > first.a && p.a <= second.a) number -= p.nullity;
  return number;
}

/// Slices the step until every eigenvalue that has changed sign lies in a slice of its own or is refined:
/// what inertia proves between two places cannot be lost.
void Search::followCounts() {
  const double L = search_.length;
  constexpr double narrow = 3e-4;
  constexpr int each = 8;  // factorizations; halving alone gets from the step to a narrow slice in twelve
  int left = each * search_.certain + each;
  std::set<double> closed;  // slices, by their starts
  double before = std::numeric_limits<double>::infinity();
  while (left_ > 0) {
    std::size_t i = 0;
    while (i + 1 < places_.size() && (owed(i) <= 0 || closed.count(places_[i].count.a))) ++i;
    if (i + 1 >= places_.size()) return;
    const double from = places_[i].count.a, to = places_[i + 1].count.a, width = to - from;
    if (width < narrow * L || left == 0) {
      closed.insert(from);
      closeIn(i);
      continue;
    }
    constexpr int atOnce = 8;
    const bool halve = owed(i) > atOnce || width > 0.5 * before;
    before = width;
    --left;
    Place place;
    if (!count(placeBetween(places_[i], places_[i + 1], halve), std::min(owed(i), atOnce) + 1, place)) {
      closed.insert(from);
      continue;
    }
    places_.insert(places_.begin() + static_cast<long>(i) + 1, place);
    refineFrom(place, from, to);
    if (search_.observer) search_.observer->onSearch(numberFound(), search_.certain);
  }
}

/// Whether an odd number of eigenvalues changes sign between two places and belongs to no point found.
bool Search::oddLeft(const CountedPlace& first, const CountedPlace& second) const {
  bool odd = oddBetween(first, second);
  for (const auto& p : found_.points)
    if (p.a > first.a && p.a <= second.a && p.nullity % 2 != 0) odd = !odd;
  return odd;
}

/// A tangent that is not symmetric has no inertia, but the sign of its determinant: halves the step where
/// that changes, until the eigenvalue that vanishes there is the one nearest to zero.
void Search::followSign() {
  if (places_.size() < 2) return;
  CountedPlace from = places_.front().count, to = places_.back().count;
  if (!oddLeft(from, to)) return;
  auto direction = calls_.newVector(), F = calls_.newVector();
  fillUnsymmetric(*direction, 1);
  constexpr int most = 16;        // slices of 1.5e-5 of the step
  constexpr double narrow = 0.1;  // of the step; before, another eigenvalue is as likely found
  for (int i = 0; i < most; ++i) {
    const double middle = 0.5 * (from.a + to.a);
    ++found_.factorizations;
    calls_.factor(search_.series.state(middle), *F);
    factoredAt_ = middle;
    const auto sign = linear::determinantSign(calls_.solver());
    if (!sign) return;
    const CountedPlace here{middle, *sign < 0 ? 1 : 0, search_.series.tangent(middle).lambda > 0};
    (oddLeft(from, here) ? to : from) = here;
    if (to.a - from.a > narrow * search_.length) continue;
    simple(0.5 * (from.a + to.a), direction, Held::near, 0);
    if (!oddLeft(from, to)) return;
  }
}

/// Where to count next between two places: next to a zero that one of them sees, on the other side of it
/// where that place is next to it already; else in the middle.
double Search::placeBetween(const Place& p, const Place& q, bool halve) const {
  const double L = search_.length, from = p.count.a, to = q.count.a, middle = 0.5 * (from + to);
  double best = middle, nearest = std::numeric_limits<double>::infinity();
  if (!halve)
    for (const Place* seenFrom : {&p, &q}) {
      const auto zeros = zerosSeenFrom(*seenFrom, from, to);
      const auto zero = std::find_if(zeros.begin(), zeros.end(), [](const Zero& z) { return !z.alongPath; });
      if (zero == zeros.end()) continue;
      const double distance = std::abs(zero->a - seenFrom->count.a);
      if (distance >= nearest) continue;
      nearest = distance;
      best = zero->a - aside() * L;
      if (distance < 3 * aside() * L) {
        const double beyond = std::max(2 * distance, aside() * L);
        best = seenFrom == &p ? from + beyond : to - beyond;
      }
    }
  if (!(best > from && best < to)) best = middle;
  // At a limit point the count and the load's sense change together, at places that rounding tells apart.
  constexpr double clear = 1e-3;
  for (const LimitPoint& limit : search_.limits)
    if (std::abs(limit.a - best) < clear * std::min(L, to - from))
      best = limit.a + (limit.a < middle ? 1 : -1) * clear * (to - from);
  return best;
}

/// Whether a point found near a is that of this eigenvalue.
bool Search::isFound(double a, const Mode& mode, double accuracy) const {
  constexpr double within = 0.5;
  return std::any_of(found_.points.begin(), found_.points.end(), [&](const CriticalPoint& p) {
    double part = 0;
    for (const auto& x : p.nullVectors) part += std::pow(linear::dot(*x, *mode.x), 2);
    return std::abs(p.a - a) < accuracy && part > within;
  });
}

/// Of eigenvalues whose points are not found; nearest first.
std::vector<Search::Zero> Search::zerosSeenFrom(const Place& place, double from, double to) const {
  std::vector<Zero> zeros;
  const auto t = search_.series.tangent(place.count.a);
  const double L = search_.length;
  constexpr double alongPath = 0.7;
  for (const Mode& mode : place.modes) {
    const double z =
        place.count.a - mode.mu / (mode.rate * place.speed);  // nowhere where the rate is not known
    const double e = z - place.count.a;
    if (!(z > from && z < to) || isFound(z, mode, 1e-5 * L + 10 * e * e / L)) continue;
    zeros.push_back({z, &mode, std::abs(linear::dot(*mode.x, *t.x.u)) > alongPath * t.x.u->norm2()});
  }
  std::sort(zeros.begin(), zeros.end(), [&](const Zero& x, const Zero& y) {
    return std::abs(x.a - place.count.a) < std::abs(y.a - place.count.a);
  });
  return zeros;
}

/// Factors the tangent at a, counts its negative eigenvalues and computes those next to zero. False where it
/// is singular, there and a little aside.
bool Search::count(double a, int modes, Place& place) {
  for (const double at : {a, a + 0.37 * aside() * search_.length}) {
    State state = search_.series.state(at);
    auto F = calls_.newVector();
    ++found_.factorizations;
    try {
      calls_.factor(state, *F);
    } catch (const PathError& error) {
      if (error.reason() != EndReason::singularTangent) throw;
      continue;
    }
    factoredAt_ = at;
    const auto inertia = calls_.inertia();
    if (!inertia || inertia->null > 0) continue;
    const double w = search_.series.weight();
    const auto t = search_.series.tangent(at);
    place.speed = speedOf(t, w);
    place.modes = nearestModes(calls_, state, t, w, {}, std::max(modes, search_.watchedModes), Rates::all);
    place.count = {at, inertia->negative, t.lambda > 0};
    return true;
  }
  return false;
}

/// Points between `from` and `to` next to the place, whose factorization the solver holds.
void Search::refineFrom(const Place& place, double from, double to) {
  const double L = search_.length, at = place.count.a;
  constexpr double near = 0.02;  // further away straight lines say nothing
  const auto zeros = zerosSeenFrom(place, from, to);
  std::vector<bool> done(zeros.size(), false);
  for (std::size_t i = 0; i < zeros.size() && left_ > 0; ++i) {
    const double a = zeros[i].a, e = a - at;
    if (std::abs(e) > near * L) return;
    if (done[i] || zeros[i].alongPath) continue;
    NearNull group, ofLimitPoint;
    for (std::size_t j = 0; j < zeros.size(); ++j) {
      if (done[j] || std::abs(zeros[j].a - a) > 1e-9 * L + 10 * e * e / L) continue;
      NearNull& mine = zeros[j].alongPath ? ofLimitPoint : group;
      mine.a.push_back(zeros[j].a);
      mine.vectors.push_back(zeros[j].mode->x);
      done[j] = !zeros[j].alongPath;
    }
    if (group.a.size() > 1) {
      constexpr double exact = 1e-4;  // straight lines as short as that are exact enough
      if (std::abs(e) > exact * L) continue;
      // A limit point at the very place adds its null vector.
      NearNull together = group;
      together.a.insert(together.a.end(), ofLimitPoint.a.begin(), ofLimitPoint.a.end());
      together.vectors.insert(together.vectors.end(), ofLimitPoint.vectors.begin(),
                              ofLimitPoint.vectors.end());
      CriticalPoint point;
      if (confirmMultiple(calls_, search_, together, at, point)) {
        keep(std::move(point));
        continue;
      }
    }
    for (std::size_t j = 0; j < group.a.size(); ++j)
      simple(group.a[j], group.vectors[j], Held::eigenvector, 0);
  }
}

/// A slice so narrow that what is left in it is one place: a point whose refinement wants a factorization of
/// its own, or several so near to each other that none can be refined alone. These are one point of so many
/// null vectors, known to the slice's width.
void Search::closeIn(std::size_t i) {
  const double from = places_[i].count.a, to = places_[i + 1].count.a;
  const Place ends[] = {places_[i], places_[i + 1]};
  // Next to the nearest zero several that vanish together show as such.
  for (const Place& place : ends) {
    const auto zeros = zerosSeenFrom(place, from, to);
    Place near;
    if (owed(i) <= 0 || left_ <= 0) return;
    if (!zeros.empty() && count(zeros.front().a - aside() * search_.length, owed(i) + 1, near))
      refineFrom(near, from, to);
  }
  for (const Place& place : ends)
    for (const Zero& zero : zerosSeenFrom(place, from, to)) {
      if (owed(i) <= 0 || left_ <= 0) return;
      if (!zero.alongPath) simple(zero.a, zero.mode->x, Held::nothing, 1);
    }
  for (const Place& place : ends) {
    const int number = owed(i);
    if (number < 2 || left_ <= 0) return;
    std::vector<RCP<Vector>> vectors;
    double sum = 0;
    for (const Zero& zero : zerosSeenFrom(place, from, to)) {
      if (zero.alongPath || static_cast<int>(vectors.size()) == number) continue;
      vectors.push_back(zero.mode->x);
      sum += zero.a;
    }
    Place near;
    if (static_cast<int>(vectors.size()) < number || !count(0.5 * (from + to), 0, near)) continue;
    CriticalPoint point;
    if (multipleAt(calls_, search_, sum / number, vectors, 0.5 * (to - from), point)) keep(std::move(point));
  }
}

}  // namespace atrapos::path
