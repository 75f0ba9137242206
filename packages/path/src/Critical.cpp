#include "Search.hpp"

#include <algorithm>
#include <cmath>

#include <Tpetra_Vector.hpp>

#include "atrapos/linear/Dot.hpp"

namespace atrapos::path {

namespace {

/// Each limit point of lambda takes the zero next to it whose vector is most nearly the path's direction:
/// there the two are one. The vectors are those of the step's ends, so that this is a matter of degree.
void leaveLimitPointsOut(std::vector<ModeZero>& zeros, const Series& series,
                         const std::vector<LimitPoint>& limits, double length) {
  constexpr double near = 0.1;
  for (const LimitPoint& limit : limits) {
    const auto t = series.tangent(limit.a);
    const double size = t.x.u->norm2();
    std::size_t best = zeros.size();
    double most = 0.5;
    for (std::size_t i = 0; i < zeros.size(); ++i) {
      if (std::abs(zeros[i].a - limit.a) > near * length) continue;
      const double along = std::abs(linear::dot(*zeros[i].x, *t.x.u)) / size;
      if (along < most) continue;
      most = along;
      best = i;
    }
    if (best < zeros.size()) zeros.erase(zeros.begin() + static_cast<long>(best));
  }
}

RCP<Vector> copyOf(const Vector& x) { return Teuchos::rcp(new Vector(x, Teuchos::Copy)); }

}  // namespace

Search::Search(Calls& calls, const CriticalSearch& search)
    : calls_(calls),
      search_(search),
      left_(search.signChanges > 0 ? search.signChanges : 2),
      factoredAt_(search.length) {
  for (std::size_t i = 0; i < search.counts.size(); ++i) {
    Place place;
    place.count = search.counts[i];
    for (const ModeSample& sample : search.samples)
      if (sample.a == place.count.a) {
        place.speed = sample.speed;
        place.modes = sample.modes;
      }
    places_.push_back(std::move(place));
  }
}

CriticalFound Search::run() {
  try {
    search();
  } catch (const PathError&) {
  }
  std::sort(found_.points.begin(), found_.points.end(),
            [](const CriticalPoint& x, const CriticalPoint& y) { return x.a < y.a; });
  return std::move(found_);
}

void Search::search() {
  const bool counted = calls_.problem().symmetric() && !places_.empty() && search_.certain > 0;
  // More than are followed are not told apart by those.
  const bool many = counted && search_.certain > std::max(search_.watchedModes, 3);
  try {
    guess(many);
  } catch (const PathError& error) {
    // A tangent that is singular where it is to be factored ends the guesses, not the search.
    if (error.reason() != EndReason::singularTangent || !counted) throw;
  }
  if (counted) {
    countLeft();
    if (left_ > 0) followCounts();
    return;
  }
  if (left_ > 0 && search_.signChanges > 0 && budget() > 0) {
    // The series at the step's end does not see the whole step; that in its middle reaches both ends.
    const double L = search_.length;
    State middle = search_.series.state(0.5 * L);
    auto F = calls_.newVector();
    ++found_.factorizations;
    calls_.factor(middle, *F);
    factoredAt_ = 0.5 * L;
    const double reach = 0.5 * L + beyond() * L;
    look(guessesOf(responsePoles(calls_, search_, middle, search_.series.tangent(0.5 * L), reach, reach),
                   0.5 * L));
  }
  if (left_ > 0 && search_.signChanges > 0) lookAgain();
  if (!calls_.problem().symmetric()) followSign();
}

/// What limit points, the eigenvalues followed and the response at the step's end show.
void Search::guess(bool many) {
  lookAtLimitPoints();
  if (many) return;
  if (left_ > 0) followZeros();
  countLeft();
  const double L = search_.length;
  if (left_ > 0 && found_.factorizations == 0)  // the tangent at the end is still the solver's
    look(guessesOf(
        responsePoles(calls_, search_, search_.end, search_.along, (1 + beyond()) * L, beyond() * L), L));
}

/// Beyond what has been found the count of negative eigenvalues decides what is left.
void Search::countLeft() {
  const int found = numberFound();
  if (search_.certain > 0 || found > 0) left_ = search_.certain - found;
}

/// A branch comes to the pitchfork that it left, or to another one, at a limit point of lambda, where its
/// own direction is the null vector; the load has no part along it there, as it has at an ordinary limit
/// point. The eigenvalue only touches zero, and a search by poles may take it for nothing.
void Search::lookAtLimitPoints() {
  if (search_.certain == 0 || !calls_.problem().symmetric()) return;
  for (const LimitPoint& limit : search_.limits) {
    if (left_ <= 0 || !limit.smooth) return;
    State state = search_.series.state(limit.a);
    auto F = calls_.newVector();
    calls_.tangent(state, *F);
    const auto t = search_.series.tangent(limit.a);
    constexpr double none = 1e-3;
    if (std::abs(linear::dot(*t.x.u, *F)) > none * t.x.u->norm2() * F->norm2()) continue;
    simple(limit.a - aside() * search_.length, copyOf(*t.x.u), Held::nothing);
  }
}

/// What a response seen from a = origin shows.
std::vector<Search::Guess> Search::guessesOf(const ResponsePoles& poles, double origin) const {
  std::vector<Guess> guesses;
  for (const double pole : poles.a)
    guesses.push_back({std::clamp(origin + pole, 0.0, search_.length), poles.direction});
  return guesses;
}

void Search::look(const std::vector<Guess>& guesses) {
  const double L = search_.length;
  const auto nearBy = [&](double a, double distance) {
    return std::count_if(guesses.begin(), guesses.end(),
                         [&](const Guess& other) { return std::abs(other.a - a) < distance; });
  };
  for (const Guess& g : guesses) {
    if (left_ <= 0) return;  // every eigenvalue that changed sign is explained
    constexpr double near = 0.05;
    const bool alone = nearBy(g.a, near * L) == 1 && static_cast<int>(guesses.size()) >= search_.signChanges;
    // Where more eigenvalues vanish than zeros are seen some vanish near each other.
    if (search_.signChanges > 1 && !alone && budget() > 0 && cluster(g.a, g.direction)) continue;
    // What the solver holds is good enough where it is near, or has to be where nothing else is left.
    constexpr double nearHeld = 0.15;
    const bool held = std::abs(g.a - factoredAt_) < nearHeld * L || budget() == 0;
    simple(g.a, g.direction, held ? Held::near : Held::nothing);
  }
}

/// Points found one by one may be those of several eigenvalues.
void Search::lookAgain() {
  const auto points = found_.points;
  for (const auto& p : points) {
    if (left_ <= 0 || budget() == 0) return;
    cluster(p.a - 1e-3 * search_.length, p.nullVectors.front());
  }
}

/// Eigenvalues that vanish at the points found.
int Search::numberFound() const {
  int found = 0;
  for (const auto& p : found_.points) found += p.nullity;
  return found;
}

/// Factorizations left: two for every eigenvalue that changed sign for certain, or for every point found
/// and the next.
int Search::budget() const {
  const int next = static_cast<int>(found_.points.size()) + 1;
  return std::max(0, 2 * std::max(search_.certain, next) - found_.factorizations);
}

/// Two of the same place are one, to the accuracy with which they are known.
bool Search::known(const CriticalPoint& point) const {
  constexpr double identical = 1e-8;
  return std::any_of(found_.points.begin(), found_.points.end(), [&](const CriticalPoint& p) {
    // That of a multiple point may be the width of a slice, in which others lie.
    const bool simple = p.kind != CriticalKind::multiple && point.kind != CriticalKind::multiple;
    const double rounding = simple ? 10 * (p.uncertainty + point.uncertainty) : 0;
    return std::abs(p.a - point.a) < std::max(identical, rounding) * search_.length;
  });
}

void Search::keep(CriticalPoint point) {
  if (point.kind == CriticalKind::multiple) {
    // Stands in for the simple point that its place was taken for.
    constexpr double same = 1e-5, within = 0.5;
    const auto close = [&](const CriticalPoint& p) {
      double part = 0;  // of its null vector that is in the span of the multiple point's
      for (const auto& x : point.nullVectors) part += std::pow(linear::dot(*x, *p.nullVectors.front()), 2);
      return std::abs(p.a - point.a) < same * search_.length && part > within;
    };
    for (const auto& p : found_.points) left_ += close(p) ? p.nullity : 0;
    found_.points.erase(std::remove_if(found_.points.begin(), found_.points.end(), close),
                        found_.points.end());
  }
  if (known(point)) return;
  left_ -= point.nullity;
  found_.points.push_back(std::move(point));
}

void Search::simple(double guess, const RCP<Vector>& direction, Held held) {
  // One is enough where the guess is good; a point may not take what the others need.
  simple(guess, direction, held, std::min(budget(), search_.signChanges > 1 ? 1 : 2));
}

void Search::simple(double guess, const RCP<Vector>& direction, Held held, int most) {
  const int before = found_.factorizations;
  CriticalPoint point;
  if (refineSimple(calls_, search_, guess, direction, held, most, point, found_.factorizations))
    keep(std::move(point));
  if (found_.factorizations > before) factoredAt_ = guess;
}

ModeEvidence bifurcationZeros(const Series& series, double length, const std::vector<ModeSample>& samples,
                              const std::vector<LimitPoint>& limits) {
  auto evidence = zerosOf(samples);
  leaveLimitPointsOut(evidence.zeros, series, limits, length);
  return evidence;
}

CriticalFound findCriticalPoints(Calls& calls, const CriticalSearch& search) {
  return Search(calls, search).run();
}

}  // namespace atrapos::path
