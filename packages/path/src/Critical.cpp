#include "Critical.hpp"

#include <algorithm>
#include <cmath>

#include <Tpetra_Vector.hpp>

namespace atrapos::path {

namespace {

class Search {
 public:
  Search(Calls& calls, const CriticalSearch& search)
      : calls_(calls), search_(search), left_(search.signChanges > 0 ? search.signChanges : 2) {}

  CriticalFound run() {
    // A few per cent beyond the step: its ends are where eigenvalues were counted.
    const double L = search_.length, beyond = 0.03 * L;
    look(responsePoles(calls_, search_, search_.end, search_.along, L + beyond, beyond), L);
    if (left_ > 0 && search_.signChanges > 0) {
      // The series at the step's end does not see the whole step; that in its middle reaches both ends.
      State middle{calls_.newVector(), 0};
      middle.lambda = search_.series.evaluate(0.5 * L, *middle.u);
      auto F = calls_.newVector();
      ++found_.factorizations;
      calls_.factor(middle, *F);
      const double reach = 0.5 * L + beyond;
      look(responsePoles(calls_, search_, middle, search_.series.tangent(0.5 * L), reach, reach), 0.5 * L);
    }
    if (left_ > 0 && search_.signChanges > 0) lookAgain();
    std::sort(found_.points.begin(), found_.points.end(),
              [](const CriticalPoint& x, const CriticalPoint& y) { return x.a < y.a; });
    return std::move(found_);
  }

 private:
  /// Refines what a response seen from a = origin shows.
  void look(const ResponsePoles& poles, double origin) {
    const double L = search_.length;
    for (const double pole : poles.a) {
      if (left_ <= 0 || spent()) return;  // every eigenvalue that changed sign is explained
      const double guess = std::clamp(origin + pole, 0.0, L);
      constexpr double near = 0.05;
      const auto neighbours = std::count_if(poles.a.begin(), poles.a.end(),
                                            [&](double other) { return std::abs(other - pole) < near * L; });
      const bool alone = neighbours == 1 && static_cast<int>(poles.a.size()) >= search_.signChanges;
      // Where more eigenvalues vanish than poles are seen some vanish near each other.
      if (search_.signChanges > 1 && !alone && cluster(guess, poles.direction)) continue;
      simple(guess, poles.direction);
    }
  }

  /// Points found one by one may be those of several eigenvalues.
  void lookAgain() {
    const auto points = found_.points;
    for (const auto& p : points) {
      if (left_ <= 0 || spent()) return;
      cluster(p.a - 1e-3 * search_.length, p.nullVectors.front());
    }
  }

  /// The search is for what the path would otherwise lose, not for everything at any price.
  bool spent() const { return found_.factorizations >= 3 * search_.signChanges + 2; }

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

  void simple(double guess, const RCP<Vector>& direction) {
    constexpr int most = 2;
    CriticalPoint point;
    if (refineSimple(calls_, search_, guess, direction, most, point, found_.factorizations))
      keep(std::move(point));
  }

  /// Eigenvalues that vanish near the guess, one by one or together. False where there is at most one.
  bool cluster(double guess, const RCP<Vector>& direction) {
    NearNull zeros;
    try {
      ++found_.factorizations;
      zeros = nearNull(calls_, search_, guess, direction, search_.signChanges + 1);
    } catch (const PathError& error) {
      if (error.reason() != EndReason::singularTangent) throw;
      guess -= 1e-3 * search_.length;  // hit exactly
      ++found_.factorizations;
      zeros = nearNull(calls_, search_, guess, direction, search_.signChanges + 1);
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
      if (group.a.size() > 1 && refineMultiple(calls_, search_, group, point, found_.factorizations)) {
        keep(std::move(point));
        continue;
      }
      for (std::size_t j = 0; j < group.a.size(); ++j) simple(group.a[j], group.vectors[j]);
    }
    return true;
  }

  Calls& calls_;
  const CriticalSearch& search_;
  int left_;
  CriticalFound found_;
};

}  // namespace

CriticalFound findCriticalPoints(Calls& calls, const CriticalSearch& search) {
  return Search(calls, search).run();
}

}  // namespace atrapos::path
