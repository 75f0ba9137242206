#include "Hopf.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

#include "Stability.hpp"

namespace atrapos::path {
namespace {

using Value = std::complex<double>;

/// What eigenvalues are computed to, of themselves: a real part below it is zero.
constexpr double accuracy = 1e-8;

bool isUnstable(const Value& mu) { return mu.real() < 0; }
int unstable(const Spectrum& s) {
  return static_cast<int>(std::count_if(s.values.begin(), s.values.end(), isUnstable));
}
int unstablePairs(const Spectrum& s) {
  return static_cast<int>(std::count_if(s.values.begin(), s.values.end(),
                                        [](const Value& mu) { return isUnstable(mu) && mu.imag() > 0; }));
}
bool onAxis(const Value& mu) { return mu.imag() != 0 && std::abs(mu.real()) <= accuracy * std::abs(mu); }

/// Whether a pair may have crossed: real eigenvalues change the number one by one, and a pair that becomes
/// two real ones does not change it.
bool pairCrosses(const Spectrum& from, const Spectrum& to) {
  const int change = std::abs(unstable(to) - unstable(from));
  return change != 0 && (change > 1 || unstablePairs(from) != unstablePairs(to));
}

/// One eigenvalue at two places, stable at one of them only.
struct Crossing {
  Value from, to;
};

/// The two that are nearest to each other.
std::optional<Crossing> crossing(const Spectrum& from, const Spectrum& to) {
  const bool loses = unstable(to) > unstable(from);
  std::optional<Crossing> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Value& x : from.values)
    for (const Value& y : to.values) {
      if (x.imag() < 0 || y.imag() < 0 || isUnstable(x) == loses || isUnstable(y) != loses) continue;
      const double apart = std::abs(x - y) / (std::abs(x) + std::abs(y));
      if (apart < least) {
        least = apart;
        best = Crossing{x, y};
      }
    }
  return best;
}

class Search {
 public:
  Search(Calls& calls, const Series& series, double length, int count, int mostFactorizations)
      : calls_(calls),
        series_(series),
        length_(length),
        count_(count),
        mostFactorizations_(mostFactorizations) {}

  void between(Spectrum from, Spectrum to);
  HopfFound take() { return std::move(found_); }

 private:
  std::optional<Spectrum> at(double a);
  void keep(const Spectrum& place, const Crossing& last, double width);

  Calls& calls_;
  const Series& series_;
  double length_;
  int count_, mostFactorizations_;
  HopfFound found_;
};

/// Empty where the number of unstable ones is not known.
std::optional<Spectrum> Search::at(double a) {
  const State state = series_.state(a);
  auto F = calls_.newVector();
  ++found_.factorizations;
  calls_.factor(state, *F);
  auto counted = countUnstable(calls_, state, count_, EigenProblem::ofRates);
  if (!counted) return std::nullopt;
  return Spectrum{a, std::move(counted->nearest)};
}

/// Those on the axis as they are at another place.
Spectrum besides(Spectrum place, bool stable) {
  for (Value& mu : place.values)
    if (onAxis(mu)) mu = {(stable ? accuracy : -accuracy) * std::abs(mu), mu.imag()};
  return place;
}

void Search::keep(const Spectrum& place, const Crossing& last, double width) {
  HopfPoint point;
  point.a = place.a;
  int pairs = 0;
  for (const Value& mu : place.values)
    if (onAxis(mu) && mu.imag() > 0) {
      ++pairs;
      point.frequency = mu.imag();
    }
  const int sense = isUnstable(last.to) ? 1 : -1;
  point.negativeChange = 2 * pairs * sense;
  point.state = series_.state(place.a);
  auto r = calls_.newVector();
  point.residual = calls_.residual(point.state, *r).relative();
  const double slope = std::abs(last.from.real() - last.to.real()) / width;
  point.uncertainty = accuracy * point.frequency / slope / length_;
  found_.points.push_back(std::move(point));
}

/// The secant through the real parts of one pair at both ends, its older end's halved where it stays twice
/// (the Illinois rule), and the middle where the stretch shrinks too slowly: as the pair is looked for anew
/// at every place, nothing depends on its having been the right one.
void Search::between(Spectrum from, Spectrum to) {
  constexpr double narrowest = 1e-10;  // of the step
  enum class End { none, from, to } moved = End::none;
  double weightFrom = 1, weightTo = 1;
  int slow = 0;
  while (pairCrosses(from, to) && found_.factorizations < mostFactorizations_) {
    const double width = to.a - from.a;
    const auto pair = crossing(from, to);
    if (!pair || width < narrowest * length_) return;
    const bool real = pair->from.imag() == 0 && pair->to.imag() == 0;
    if (real && std::abs(unstable(to) - unstable(from)) == 1) return;
    const double x = weightFrom * std::abs(pair->from.real()), y = weightTo * std::abs(pair->to.real());
    double part = slow > 4 || real ? 0.5 : x / (x + y);
    // An end at which it nearly vanishes is looked at from the other side, too.
    part = std::clamp(part, narrowest, 1 - narrowest);
    const auto place = at(from.a + part * width);
    if (!place) return;
    if (std::any_of(place->values.begin(), place->values.end(), onAxis)) {
      keep(*place, *pair, width);
      const bool stable = !isUnstable(pair->from);
      between(std::move(from), besides(*place, stable));
      between(besides(*place, !stable), std::move(to));
      return;
    }
    const bool first = pairCrosses(from, *place), second = pairCrosses(*place, to);
    if (first && second) between(from, *place);
    slow = std::max(place->a - from.a, to.a - place->a) > 0.5 * width ? slow + 1 : 0;
    // The end that stays counts half where it has stayed before.
    const End moves = second ? End::from : End::to;
    double& weight = second ? weightTo : weightFrom;
    weight = moves == moved ? 0.5 * weight : 1;
    (second ? weightFrom : weightTo) = 1;
    moved = moves;
    (second ? from : to) = *place;
  }
}

}  // namespace

HopfFound findHopfPoints(Calls& calls, const Series& series, const Spectrum& start, const Spectrum& end,
                         int count) {
  // The secant takes some nine for each pair.
  constexpr int each = 20;
  const int pairs = (std::abs(unstable(end) - unstable(start)) + 1) / 2;
  Search search(calls, series, end.a - start.a, count, each * (pairs + 1));
  try {
    search.between(start, end);
  } catch (const PathError&) {
    // A tangent that cannot be factored there: what has been found stays.
  }
  HopfFound found = search.take();
  std::sort(found.points.begin(), found.points.end(),
            [](const HopfPoint& x, const HopfPoint& y) { return x.a < y.a; });
  return found;
}

}  // namespace atrapos::path
