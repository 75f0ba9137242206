#include "Landmarks.hpp"

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

namespace atrapos::path {
namespace {

using Place = Landmark::Place;
constexpr std::size_t count = std::tuple_size_v<Place>;

/// Parts of what the path has covered so far: two states within the first are one, where states of a path are
/// good to about 1e-6 by the residual's bound; beyond the second the path has been away, so that short steps
/// that follow one another are not taken for a return.
constexpr double kSame = 1e-4, kAway = 0.05;
constexpr double kSameDirection = 0.999;  // cosine

Place minus(const Place& a, const Place& b) {
  Place difference;
  for (std::size_t i = 0; i < count; ++i) difference[i] = a[i] - b[i];
  return difference;
}

double largest(const Place& difference, const Place& scale) {
  double most = 0;
  for (std::size_t i = 0; i < count; ++i)
    if (scale[i] > 0) most = std::max(most, std::abs(difference[i]) / scale[i]);
  return most;
}

/// Of directions in units of the scales.
double cosine(const Place& a, const Place& b, const Place& scale) {
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(scale[i] > 0)) continue;
    ab += a[i] * b[i] / (scale[i] * scale[i]);
    aa += a[i] * a[i] / (scale[i] * scale[i]);
    bb += b[i] * b[i] / (scale[i] * scale[i]);
  }
  return ab / std::sqrt(aa * bb);
}

}  // namespace

Landmarks::Landmarks(const Map& map, const Trail& known) {
  for (std::size_t w = 0; w < weights_.size(); ++w) {
    weights_[w] = Teuchos::rcp(new Vector(Teuchos::rcpFromRef(map)));
    const auto values = weights_[w]->getDataNonConst();
    for (std::size_t i = 0; i < static_cast<std::size_t>(values.size()); ++i) {
      const auto dof = static_cast<double>(map.getGlobalElement(static_cast<int>(i)));
      values[i] = std::sin((dof + 1) * (w == 0 ? 12.9898 : 78.233));  // no multiple of a period
    }
  }
  for (const Landmark& mark : known.all()) {
    widen(mark);
    add(mark);
  }
}

std::optional<int> Landmarks::pass(int step, const Series& series, double length) {
  const Curve path{series.lambdaFunction(), series.functional(*weights_[0]), series.functional(*weights_[1])};
  Landmark here;
  here.step = step;
  for (std::size_t i = 0; i < count; ++i) {
    here.place[i] = path[i](0);
    here.direction[i] = path[i].derivative()(0);
    here.end[i] = path[i](length);
  }
  widen(here);
  const auto back = meets(path, here, length);
  add(here);
  return back;
}

void Landmarks::widen(const Landmark& mark) {
  if (marks_.empty()) low_ = high_ = mark.place;
  for (std::size_t i = 0; i < count; ++i) {
    low_[i] = std::min({low_[i], mark.place[i], mark.end[i]});
    high_[i] = std::max({high_[i], mark.place[i], mark.end[i]});
  }
}

void Landmarks::add(const Landmark& mark) {
  for (std::size_t m = 0; m < marks_.size(); ++m)
    if (largest(minus(mark.end, marks_[m].place), scale()) > kAway) left_[m] = 1;
  marks_.push_back(mark);
  trail_.add(mark);
  left_.push_back(0);
}

Landmarks::Place Landmarks::scale() const { return minus(high_, low_); }

std::optional<int> Landmarks::meets(const Curve& path, const Landmark& here, double length) const {
  // A step bends: it may go beyond its ends, by less than it is long.
  const double reach = 2 * largest(minus(here.end, here.place), scale()) + kSame;
  for (std::size_t m = 0; m < marks_.size(); ++m) {
    const Landmark& mark = marks_[m];
    if (left_[m] == 0 || largest(minus(mark.place, here.place), scale()) > reach) continue;
    Place fast{};
    for (std::size_t i = 0; i < count; ++i)
      fast[i] = scale()[i] > 0 ? std::abs(mark.direction[i]) / scale()[i] : 0;
    const auto i = static_cast<std::size_t>(std::max_element(fast.begin(), fast.end()) - fast.begin());
    for (const double a : path[i].minus(mark.place[i]).roots(length))
      if (isAt(mark, path, a)) return mark.step;
  }
  return std::nullopt;
}

bool Landmarks::isAt(const Landmark& mark, const Curve& path, double a) const {
  Place place{}, direction{};
  for (std::size_t i = 0; i < count; ++i) {
    place[i] = path[i](a);
    direction[i] = path[i].derivative()(a);
  }
  return largest(minus(place, mark.place), scale()) < kSame &&
         cosine(direction, mark.direction, scale()) > kSameDirection;
}

}  // namespace atrapos::path
