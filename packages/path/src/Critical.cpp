#include "Critical.hpp"

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

class Search {
 public:
  Search(Calls& calls, const CriticalSearch& search)
      : calls_(calls),
        search_(search),
        left_(search.signChanges > 0 ? search.signChanges : 2),
        factoredAt_(search.length) {}

  /// A state off the path that the problem or the solver refuses ends the search; what is found stays.
  CriticalFound run() {
    try {
      search();
    } catch (const PathError&) {
    }
    std::sort(found_.points.begin(), found_.points.end(),
              [](const CriticalPoint& x, const CriticalPoint& y) { return x.a < y.a; });
    return std::move(found_);
  }

 private:
  void search() {
    // A few per cent beyond the step: its ends are where eigenvalues were counted.
    const double L = search_.length, beyond = 0.03 * L;
    lookAtLimitPoints();
    if (left_ > 0) followZeros();
    // Beyond what they show the count of negative eigenvalues decides.
    int found = 0;
    for (const auto& p : found_.points) found += p.nullity;
    if (search_.certain > 0 || found > 0) left_ = search_.certain - found;
    if (left_ > 0 && found_.factorizations == 0)  // the tangent at the end is still the solver's
      look(guessesOf(responsePoles(calls_, search_, search_.end, search_.along, L + beyond, beyond), L));
    if (left_ > 0 && search_.signChanges > 0 && budget() > 0) {
      // The series at the step's end does not see the whole step; that in its middle reaches both ends.
      State middle{calls_.newVector(), 0};
      middle.lambda = search_.series.evaluate(0.5 * L, *middle.u);
      auto F = calls_.newVector();
      ++found_.factorizations;
      calls_.factor(middle, *F);
      factoredAt_ = 0.5 * L;
      const double reach = 0.5 * L + beyond;
      look(guessesOf(responsePoles(calls_, search_, middle, search_.series.tangent(0.5 * L), reach, reach),
                     0.5 * L));
    }
    if (left_ > 0 && search_.signChanges > 0) lookAgain();
  }

  /// Points where the eigenvalues followed vanish: each factorization on the way adds a sample of them, which
  /// makes the cubic between samples more exact by an order or two.
  void followZeros() {
    const double L = search_.length;
    auto samples = search_.samples;
    std::vector<double> failed;
    const auto isNear = [](double a, double b, double distance) { return std::abs(a - b) < distance; };
    while (left_ > 0) {
      const auto all = bifurcationZeros(search_.series, L, samples, search_.limits).zeros;
      const ModeZero* next = nullptr;
      int together = 0;
      constexpr double same = 1e-3, near = 0.02, useful = 0.15;
      for (const ModeZero& z : all) {
        const auto done = [&](double a) { return isNear(a, z.a, same * L); };
        if (std::any_of(failed.begin(), failed.end(), done)) continue;
        // Two zeros at one place are two points unless the one found there is that of both.
        const auto here = std::count_if(all.begin(), all.end(), [&](const ModeZero& o) { return done(o.a); });
        long known = 0;
        for (const auto& p : found_.points) known += done(p.a) ? p.nullity : 0;
        if (known >= here) continue;
        if (!next || std::abs(z.a - factoredAt_) < std::abs(next->a - factoredAt_)) next = &z;
      }
      if (!next) return;
      const double a = next->a;
      together = static_cast<int>(
          std::count_if(all.begin(), all.end(), [&](const ModeZero& z) { return isNear(z.a, a, near * L); }));
      const int before = left_;
      if (together > 1) {
        if (budget() > 0) cluster(a, next->x);
        if (left_ == before) failed.push_back(a);
        if (left_ != before || budget() == 0) continue;
      } else if (isNear(a, factoredAt_, useful * L)) {
        simple(a, next->x, Held::eigenvector, 0);
        if (left_ != before) continue;
      }
      if (budget() == 0) {
        simple(a, next->x, Held::near, 0);
        failed.push_back(a);
        continue;
      }
      if (isNear(a, factoredAt_, same * L)) {  // nothing new to learn there
        failed.push_back(a);
        continue;
      }
      sample(a, samples);
    }
  }

  /// A branch comes to the pitchfork that it left, or to another one, at a limit point of lambda, where its
  /// own direction is the null vector; the load has no part along it there, as it has at an ordinary limit
  /// point. The eigenvalue only touches zero, and a search by poles may take it for nothing.
  void lookAtLimitPoints() {
    if (search_.certain == 0 || !calls_.problem().symmetric()) return;
    for (const LimitPoint& limit : search_.limits) {
      if (left_ <= 0 || !limit.smooth) return;
      State state{calls_.newVector(), 0};
      state.lambda = search_.series.evaluate(limit.a, *state.u);
      auto F = calls_.newVector();
      calls_.tangent(state, *F);
      const auto t = search_.series.tangent(limit.a);
      constexpr double none = 1e-3;
      if (std::abs(linear::dot(*t.x.u, *F)) > none * t.x.u->norm2() * F->norm2()) continue;
      simple(limit.a - aside() * search_.length, copyOf(*t.x.u), Held::nothing);
    }
  }

  static RCP<Vector> copyOf(const Vector& x) { return Teuchos::rcp(new Vector(x, Teuchos::Copy)); }

  /// The eigenvalues followed at a, which the solver holds the factorization of afterwards.
  void sample(double a, std::vector<ModeSample>& samples) {
    a -= aside() * search_.length;
    State state{calls_.newVector(), 0};
    state.lambda = search_.series.evaluate(a, *state.u);
    auto F = calls_.newVector();
    ++found_.factorizations;
    calls_.factor(state, *F);
    factoredAt_ = a;
    const double w = search_.series.weight();
    const auto t = search_.series.tangent(a);
    const double speed = std::sqrt(w * calls_.problem().inner(t.x, t.x) + t.lambda * t.lambda);
    const auto place =
        std::find_if(samples.begin(), samples.end(), [&](const ModeSample& s) { return s.a > a; });
    const auto& before = place == samples.begin() ? samples.front().modes : (place - 1)->modes;
    ModeSample here{a, speed, nearestModes(calls_, state, t, w, before, search_.watchedModes, Rates::all)};
    samples.insert(place, std::move(here));
  }

  /// At the very point a tangent cannot be factored: this part of the step before it.
  static constexpr double aside() { return 5e-5; }

  /// Where a point may be, and its null vector, roughly.
  struct Guess {
    double a;
    RCP<Vector> direction;
  };

  /// What a response seen from a = origin shows.
  std::vector<Guess> guessesOf(const ResponsePoles& poles, double origin) const {
    std::vector<Guess> guesses;
    for (const double pole : poles.a)
      guesses.push_back({std::clamp(origin + pole, 0.0, search_.length), poles.direction});
    return guesses;
  }

  void look(const std::vector<Guess>& guesses) {
    const double L = search_.length;
    for (const Guess& g : guesses) {
      if (left_ <= 0) return;  // every eigenvalue that changed sign is explained
      constexpr double near = 0.05;
      const bool alone =
          nearBy(guesses, g.a, near * L) == 1 && static_cast<int>(guesses.size()) >= search_.signChanges;
      // Where more eigenvalues vanish than zeros are seen some vanish near each other.
      if (search_.signChanges > 1 && !alone && budget() > 0 && cluster(g.a, g.direction)) continue;
      // What the solver holds is good enough where it is near, or has to be where nothing else is left.
      constexpr double nearHeld = 0.15;
      const bool held = std::abs(g.a - factoredAt_) < nearHeld * L || budget() == 0;
      simple(g.a, g.direction, held ? Held::near : Held::nothing);
    }
  }

  static long nearBy(const std::vector<Guess>& guesses, double a, double distance) {
    return std::count_if(guesses.begin(), guesses.end(),
                         [&](const Guess& other) { return std::abs(other.a - a) < distance; });
  }

  /// Points found one by one may be those of several eigenvalues.
  void lookAgain() {
    const auto points = found_.points;
    for (const auto& p : points) {
      if (left_ <= 0 || budget() == 0) return;
      cluster(p.a - 1e-3 * search_.length, p.nullVectors.front());
    }
  }

  /// Factorizations left: two for every eigenvalue that changed sign for certain, or for every point found
  /// and the next.
  int budget() const {
    const int next = static_cast<int>(found_.points.size()) + 1;
    return std::max(0, 2 * std::max(search_.certain, next) - found_.factorizations);
  }

  bool known(double a) const {
    constexpr double identical = 1e-8;
    return std::any_of(found_.points.begin(), found_.points.end(), [&](const CriticalPoint& p) {
      return std::abs(p.a - a) < identical * search_.length;
    });
  }

  void keep(CriticalPoint point) {
    if (point.kind == CriticalKind::multiple) {
      // Stands in for the simple point that its place was taken for.
      constexpr double same = 1e-5;
      const auto close = [&](const CriticalPoint& p) {
        return std::abs(p.a - point.a) < same * search_.length;
      };
      for (const auto& p : found_.points) left_ += close(p) ? p.nullity : 0;
      found_.points.erase(std::remove_if(found_.points.begin(), found_.points.end(), close),
                          found_.points.end());
    }
    if (known(point.a)) return;
    left_ -= point.nullity;
    found_.points.push_back(std::move(point));
  }

  void simple(double guess, const RCP<Vector>& direction, Held held) {
    // One is enough where the guess is good; a point may not take what the others need.
    simple(guess, direction, held, std::min(budget(), search_.signChanges > 1 ? 1 : 2));
  }

  void simple(double guess, const RCP<Vector>& direction, Held held, int most) {
    const int before = found_.factorizations;
    CriticalPoint point;
    if (refineSimple(calls_, search_, guess, direction, held, most, point, found_.factorizations))
      keep(std::move(point));
    if (found_.factorizations > before) factoredAt_ = guess;
  }

  /// Eigenvalues that vanish near the guess, one by one or together. False where there is at most one.
  bool cluster(double guess, const RCP<Vector>& direction) {
    if (!calls_.problem().symmetric()) return false;  // its projections are those of symmetric tangents
    guess -= aside() * search_.length;
    ++found_.factorizations;
    NearNull zeros = nearNull(calls_, search_, guess, direction, search_.signChanges + 1);
    factoredAt_ = guess;
    const double first = zeros.a.empty() ? guess : zeros.a.front();
    constexpr double far = 0.005;
    if (std::abs(first - guess) > far * search_.length && first > 0 && first < search_.length &&
        budget() > 0) {
      guess = first - aside() * search_.length;
      ++found_.factorizations;
      zeros = nearNull(calls_, search_, guess, zeros.vectors.front(), search_.signChanges + 1);
      factoredAt_ = guess;
    }
    // Further away straight lines say nothing.
    constexpr double near = 0.02;
    while (!zeros.a.empty() && std::abs(zeros.a.back() - guess) > near * search_.length) {
      zeros.a.pop_back();
      zeros.vectors.pop_back();
    }
    if (zeros.a.size() < 2) return false;
    std::vector<bool> done(zeros.a.size(), false);
    for (std::size_t i = 0; i < zeros.a.size() && left_ > 0; ++i) {
      if (done[i]) continue;
      NearNull group;
      for (std::size_t j = i; j < zeros.a.size(); ++j) {
        const double e = std::max(std::abs(zeros.a[i] - guess), std::abs(zeros.a[j] - guess));
        if (std::abs(zeros.a[j] - zeros.a[i]) > 1e-9 * search_.length + 10 * e * e / search_.length) continue;
        group.a.push_back(zeros.a[j]);
        group.vectors.push_back(zeros.vectors[j]);
        done[j] = true;
      }
      CriticalPoint point;
      if (group.a.size() > 1) {
        // Straight lines as short as that are exact enough.
        constexpr double exact = 1e-4;
        bool multiple = false;
        if (std::abs(group.a.front() - guess) <= exact * search_.length) {
          multiple = confirmMultiple(calls_, search_, group, guess, point);
        } else if (budget() > 0) {
          factoredAt_ = group.a.front();
          multiple = refineMultiple(calls_, search_, group, point, found_.factorizations);
        }
        if (multiple) {
          keep(std::move(point));
          continue;
        }
      }
      for (std::size_t j = 0; j < group.a.size(); ++j)
        simple(group.a[j], group.vectors[j], Held::eigenvector);
    }
    return true;
  }

  Calls& calls_;
  const CriticalSearch& search_;
  int left_;
  double factoredAt_;  ///< where on the series the solver's factorization belongs
  CriticalFound found_;
};

}  // namespace

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
