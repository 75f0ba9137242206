#include <algorithm>
#include <cmath>

#include <Tpetra_Vector.hpp>

#include "Search.hpp"

namespace atrapos::path {

/// Points where the eigenvalues followed vanish: each factorization on the way adds a sample of them, which
/// makes the cubic between samples more exact by an order or two.
void Search::followZeros() {
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

/// The eigenvalues followed at a, which the solver holds the factorization of afterwards.
void Search::sample(double a, std::vector<ModeSample>& samples) {
  a -= aside() * search_.length;
  State state = search_.series.state(a);
  auto F = calls_.newVector();
  ++found_.factorizations;
  calls_.factor(state, *F);
  factoredAt_ = a;
  const double w = search_.series.weight();
  const auto t = search_.series.tangent(a);
  const double speed = speedOf(t, w);
  const auto place =
      std::find_if(samples.begin(), samples.end(), [&](const ModeSample& s) { return s.a > a; });
  const auto& before = place == samples.begin() ? samples.front().modes : (place - 1)->modes;
  ModeSample here{a, speed, nearestModes(calls_, state, t, w, before, search_.watchedModes, Rates::all)};
  if (const auto inertia = calls_.inertia(); inertia && inertia->null == 0 && !places_.empty()) {
    const auto behind =
        std::find_if(places_.begin(), places_.end(), [&](const Place& p) { return p.count.a > a; });
    places_.insert(behind, Place{{a, inertia->negative, t.lambda > 0}, speed, here.modes});
  }
  samples.insert(place, std::move(here));
}

/// Eigenvalues that vanish near the guess, one by one or together. False where there is at most one.
bool Search::cluster(double guess, const RCP<Vector>& direction) {
  if (!calls_.problem().symmetric()) return false;  // its projections are those of symmetric tangents
  guess -= aside() * search_.length;
  ++found_.factorizations;
  NearNull zeros = nearNull(calls_, search_, guess, direction, search_.signChanges + 1);
  factoredAt_ = guess;
  const double first = zeros.a.empty() ? guess : zeros.a.front();
  constexpr double far = 0.005;
  if (std::abs(first - guess) > far * search_.length && first > 0 && first < search_.length && budget() > 0) {
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
    for (std::size_t j = 0; j < group.a.size(); ++j) simple(group.a[j], group.vectors[j], Held::eigenvector);
  }
  return true;
}

}  // namespace atrapos::path
