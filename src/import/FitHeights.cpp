// Heights over a plane as a bicubic B-spline by weighted least squares on the corners of facets, which lie on
// the surface that the facets stand for; their middles are off it by the square of their size.
#include "import/FitHeights.hpp"

#include <fmt/format.h>

#include <Teuchos_LAPACK.hpp>
#include <algorithm>
#include <cmath>
#include <limits>

#include "import/Import.hpp"

namespace atrapos::importer {
namespace {

constexpr int kDegree = 3;
constexpr int kMostCells = 100;  // the tool has a patch for each
/// Weight of bending against a coefficient's data: it decides only where there are none (corners of the
/// rectangle), and moves others by as small a part of what the surface bends between two control points.
constexpr double kBending = 1e-9;

/// Facets in buckets, and pairs of those in one bucket: of facets of like size there are some ten times their
/// number. These many take some seconds and 0.3 GB.
constexpr double kMostInBuckets = 5e7, kMostPairs = 5e8;

/// A place in the frame of the fit: two coordinates across the axis and the height along it.
using Place = std::array<double, 3>;

struct Frame {
  int axis[3];  ///< which coordinates
  double sign;  ///< of the height

  explicit Frame(const std::array<double, 3>& along) {
    const int height = along[0] != 0 ? 0 : along[1] != 0 ? 1 : 2;
    sign = along[height];
    axis[0] = (height + 1) % 3;
    axis[1] = (height + 2) % 3;
    axis[2] = height;
    if (sign < 0) std::swap(axis[0], axis[1]);  // stays right-handed
  }
  Place in(const std::array<double, 3>& x) const { return {x[axis[0]], x[axis[1]], sign * x[axis[2]]}; }
  std::array<double, 3> out(const Place& p) const {
    std::array<double, 3> x{};
    x[axis[0]] = p[0];
    x[axis[1]] = p[1];
    x[axis[2]] = sign * p[2];
    return x;
  }
};

using Triangle = std::array<Place, 3>;

/// Twice the area across the axis; > 0 where the facet faces it.
double across(const Triangle& t) {
  return (t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[2][0] - t[0][0]) * (t[1][1] - t[0][1]);
}

Place middle(const Triangle& t) {
  Place m{};
  for (int i = 0; i < 3; ++i) m[i] = (t[0][i] + t[1][i] + t[2][i]) / 3;
  return m;
}

/// The height of the facet's plane over a place within its corners; NaN outside.
double heightAt(const Triangle& t, const Place& p) {
  const double area = across(t);
  double height = 0;
  for (int i = 0; i < 3; ++i) {
    const Place &a = t[(i + 1) % 3], &b = t[(i + 2) % 3];
    const double share = across({p, a, b}) / area;
    if (!(share > 1e-6)) return std::numeric_limits<double>::quiet_NaN();  // also on an edge
    height += share * t[i][2];
  }
  return height;
}

/// One direction: cubic B-splines over equal cells, with knots repeated at the ends.
struct Direction {
  double low = 0, high = 1;
  int cells = 1;
  std::vector<double> knots;

  Direction(double from, double to, int n) : low(from), high(to), cells(n) {
    for (int i = -kDegree; i <= cells + kDegree; ++i)
      knots.push_back(i >= cells ? high : low + (high - low) * std::max(i, 0) / cells);
  }
  int count() const { return cells + kDegree; }
  int cellOf(double x) const {
    return std::clamp(static_cast<int>((x - low) / (high - low) * cells), 0, cells - 1);
  }
  /// The four functions that are not zero on the cell of x, the first of which has its number, and slopes.
  void functions(double x, double (&value)[kDegree + 1], double (&slope)[kDegree + 1]) const {
    const int span = cellOf(x) + kDegree;
    double lower[kDegree + 1] = {};
    value[0] = 1;
    for (int p = 1; p <= kDegree; ++p) {  // Cox and de Boor
      std::copy(value, value + p, lower);
      double saved = 0;
      for (int r = 0; r < p; ++r) {
        const double right = knots[span + r + 1], left = knots[span + 1 - p + r];
        const double part = lower[r] / (right - left);
        value[r] = saved + (right - x) * part;
        saved = (x - left) * part;
      }
      value[p] = saved;
    }
    for (int r = 0; r <= kDegree; ++r) {
      const int i = span - kDegree + r;
      slope[r] = 0;
      if (r > 0) slope[r] += kDegree * lower[r - 1] / (knots[i + kDegree] - knots[i]);
      if (r < kDegree) slope[r] -= kDegree * lower[r] / (knots[i + kDegree + 1] - knots[i + 1]);
    }
  }
  /// Where the control point of the function i lies, so that the spline of these places is x itself.
  double greville(int i) const { return (knots[i + 1] + knots[i + 2] + knots[i + 3]) / 3; }
};

/// A symmetric band of the normal equations, both halves, as LAPACK has it with room for its factor.
class Band {
 public:
  Band(int n, int width) : n_(n), width_(width), entries_(std::size_t(n) * (3 * std::size_t(width) + 1)) {}
  double& at(int i, int j) { return entries_[std::size_t(j) * rows() + std::size_t(2 * width_ + i - j)]; }
  double diagonal() const {
    double sum = 0;
    for (int i = 0; i < n_; ++i) sum += entries_[std::size_t(i) * rows() + std::size_t(2 * width_)];
    return sum / n_;
  }
  /// Throws Error where it is singular.
  void solve(std::vector<double>& x, const std::string& file) {
    std::vector<int> pivots(static_cast<std::size_t>(n_));
    int info = 0;
    Teuchos::LAPACK<int, double> lapack;
    const int lead = static_cast<int>(rows());
    lapack.GBTRF(n_, n_, width_, width_, entries_.data(), lead, pivots.data(), &info);
    if (info == 0)
      lapack.GBTRS('N', n_, width_, width_, 1, entries_.data(), lead, pivots.data(), x.data(), n_, &info);
    const bool finite = std::all_of(x.begin(), x.end(), [](double c) { return std::isfinite(c); });
    if (info != 0 || !finite)
      throw Error(file + ": its corners do not determine a surface; expected fewer cells");
  }

 private:
  std::size_t rows() const { return 3 * std::size_t(width_) + 1; }
  int n_, width_;
  std::vector<double> entries_;
};

class Fit {
 public:
  Fit(std::vector<Triangle> facets, const FitWishes& wishes, const std::string& file)
      : facets_(std::move(facets)), file_(file), directions_(cut(wishes.cells)) {}

  void refuseOverhangs() const;
  void solve();
  /// Distance of a place from the surface along its normal there, to first order.
  double distance(const Place& p) const;
  double emptyPart() const;
  const std::array<Direction, 2>& directions() const { return directions_; }
  double coefficient(int i, int j) const {
    return heights_[std::size_t(i) * std::size_t(directions_[1].count()) + std::size_t(j)];
  }
  const std::vector<Triangle>& facets() const { return facets_; }

 private:
  std::array<Direction, 2> cut(std::array<int, 2> cells) const;
  void addBending(Band& matrix) const;

  std::vector<Triangle> facets_;
  std::string file_;
  std::array<Direction, 2> directions_;
  std::vector<double> heights_;
};

std::array<Direction, 2> Fit::cut(std::array<int, 2> cells) const {
  double low[2], high[2];
  for (int d = 0; d < 2; ++d) {
    low[d] = std::numeric_limits<double>::infinity();
    high[d] = -low[d];
    for (const Triangle& t : facets_)
      for (const Place& p : t) {
        low[d] = std::min(low[d], p[d]);
        high[d] = std::max(high[d], p[d]);
      }
  }
  // Of a closed net a corner has six facets. Cells as nearly square as the rectangle allows.
  const double corners = static_cast<double>(facets_.size()) / 2;
  const double ratio = (high[0] - low[0]) / (high[1] - low[1]);
  for (int d = 0; d < 2; ++d)
    if (cells[d] == 0)
      cells[d] =
          std::clamp(static_cast<int>(std::sqrt(corners / 4 * (d == 0 ? ratio : 1 / ratio))), 1, kMostCells);
  return {Direction(low[0], high[0], cells[0]), Direction(low[1], high[1], cells[1])};
}

void Fit::refuseOverhangs() const {
  // Buckets of about a facet each; a facet is in all that its box touches.
  const int n = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(facets_.size()))), 1, 1000);
  const Direction x(directions_[0].low, directions_[0].high, n),
      y(directions_[1].low, directions_[1].high, n);
  const auto refuseWork = [&](double work, double most) {
    if (work > most)
      throw Error(file_ + ": facets of too unequal sizes; expected those of one surface, remeshed perhaps");
  };
  std::vector<std::vector<int>> buckets(std::size_t(n) * std::size_t(n));
  double entries = 0, pairs = 0;
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    const Triangle& t = facets_[f];
    const auto [x0, x1] = std::minmax({t[0][0], t[1][0], t[2][0]});
    const auto [y0, y1] = std::minmax({t[0][1], t[1][1], t[2][1]});
    const int i0 = x.cellOf(x0), i1 = x.cellOf(x1), j0 = y.cellOf(y0), j1 = y.cellOf(y1);
    refuseWork(entries += double(i1 - i0 + 1) * (j1 - j0 + 1), kMostInBuckets);
    for (int i = i0; i <= i1; ++i)
      for (int j = j0; j <= j1; ++j)
        buckets[std::size_t(i) * std::size_t(n) + std::size_t(j)].push_back(static_cast<int>(f));
  }
  for (const auto& bucket : buckets)
    pairs += static_cast<double>(bucket.size()) * static_cast<double>(bucket.size());
  refuseWork(pairs, kMostPairs);
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    const Place m = middle(facets_[f]);
    for (const int other :
         buckets[std::size_t(x.cellOf(m[0])) * std::size_t(n) + std::size_t(y.cellOf(m[1]))]) {
      if (static_cast<std::size_t>(other) == f) continue;
      const double height = heightAt(facets_[std::size_t(other)], m);
      if (std::isfinite(height))
        throw Error(fmt::format(
            "{}: overhangs: facets at the heights {:.6g} and {:.6g} over the place ({:.6g}, {:.6g}) "
            "across the axis; expected one height over each place, perhaps with another --along",
            file_, m[2], height, m[0], m[1]));
    }
  }
}

void Fit::solve() {
  const auto& [first, second] = directions_;
  const int rows = second.count(), n = first.count() * rows;
  Band matrix(n, kDegree * rows + kDegree);
  heights_.assign(std::size_t(n), 0.0);
  for (const Triangle& t : facets_) {
    const double weight = across(t) / 6;  // a third of its area for each corner
    for (const Place& p : t) {
      double u[kDegree + 1], v[kDegree + 1], slope[kDegree + 1];
      first.functions(p[0], u, slope);
      second.functions(p[1], v, slope);
      const int i0 = first.cellOf(p[0]), j0 = second.cellOf(p[1]);
      for (int a = 0; a < 16; ++a) {
        const int row = (i0 + a / 4) * rows + j0 + a % 4;
        const double here = weight * u[a / 4] * v[a % 4];
        heights_[std::size_t(row)] += here * p[2];
        for (int b = 0; b < 16; ++b)
          matrix.at(row, (i0 + b / 4) * rows + j0 + b % 4) += here * u[b / 4] * v[b % 4];
      }
    }
  }
  addBending(matrix);
  matrix.solve(heights_, file_);
}

/// Squares of the second differences of neighbouring coefficients.
void Fit::addBending(Band& matrix) const {
  const int rows = directions_[1].count(), columns = directions_[0].count();
  const double weight = kBending * matrix.diagonal();
  constexpr double kDifference[3] = {1, -2, 1};
  const auto add = [&](int start, int step) {
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        matrix.at(start + a * step, start + b * step) += weight * kDifference[a] * kDifference[b];
  };
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      if (i + 2 < columns) add(i * rows + j, rows);
      if (j + 2 < rows) add(i * rows + j, 1);
    }
}

double Fit::distance(const Place& p) const {
  double u[kDegree + 1], v[kDegree + 1], du[kDegree + 1], dv[kDegree + 1], height = 0, slopes[2] = {0, 0};
  directions_[0].functions(p[0], u, du);
  directions_[1].functions(p[1], v, dv);
  const int i0 = directions_[0].cellOf(p[0]), j0 = directions_[1].cellOf(p[1]);
  for (int a = 0; a < 16; ++a) {
    const double c = coefficient(i0 + a / 4, j0 + a % 4);
    height += c * u[a / 4] * v[a % 4];
    slopes[0] += c * du[a / 4] * v[a % 4];
    slopes[1] += c * u[a / 4] * dv[a % 4];
  }
  return std::abs(p[2] - height) / std::sqrt(1 + slopes[0] * slopes[0] + slopes[1] * slopes[1]);
}

double Fit::emptyPart() const {
  const auto& [first, second] = directions_;
  std::vector<char> has(std::size_t(first.cells) * std::size_t(second.cells), 0);
  for (const Triangle& t : facets_)
    for (const Place& p : {t[0], t[1], t[2], middle(t)})
      has[std::size_t(first.cellOf(p[0])) * std::size_t(second.cells) + std::size_t(second.cellOf(p[1]))] = 1;
  return static_cast<double>(std::count(has.begin(), has.end(), 0)) / static_cast<double>(has.size());
}

}  // namespace

FittedSurface fitHeights(const std::vector<Facet>& facets, const FitWishes& wishes, const std::string& file) {
  for (const int n : wishes.cells)
    if (n < 0 || n > kMostCells)
      throw Error(fmt::format("{}: --cells {}: expected 1 to {}", file, n, kMostCells));
  const Frame frame(wishes.along);
  FittedSurface fitted;
  std::vector<Triangle> facing;
  for (const Facet& facet : facets) {
    const Triangle t{frame.in(facet[0]), frame.in(facet[1]), frame.in(facet[2])};
    if (across(t) > 0)
      facing.push_back(t);
    else
      ++fitted.turnedAway;
  }
  if (facing.size() < 8)
    throw Error(
        fmt::format("{}: {} of {} facets face the axis; expected 8 at least, perhaps with another --along",
                    file, facing.size(), facets.size()));
  fitted.facets = facing.size();
  Fit fit(std::move(facing), wishes, file);
  fit.refuseOverhangs();
  fit.solve();
  for (const Triangle& t : fit.facets()) {
    for (const Place& p : t) fitted.fromCorners = std::max(fitted.fromCorners, fit.distance(p));
    fitted.fromFacets = std::max(fitted.fromFacets, fit.distance(middle(t)));
  }
  fitted.empty = fit.emptyPart();
  const auto& [first, second] = fit.directions();
  fitted.knots = {first.knots, second.knots};
  for (int i = 0; i < first.count(); ++i)
    for (int j = 0; j < second.count(); ++j)
      fitted.points.push_back(frame.out({first.greville(i), second.greville(j), fit.coefficient(i, j)}));
  return fitted;
}

}  // namespace atrapos::importer
