#include "Landmarks.hpp"

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace atrapos::path {
namespace {

/// Parts of what the path has covered so far: two states within the first are one, where states of a path are
/// good to about 1e-6 by the residual's bound; beyond the second the path has been away, so that short steps
/// that follow one another are not taken for a return.
constexpr double kSame = 1e-4, kAway = 0.05;
constexpr double kSameDirection = 0.999;  // cosine

template <class Place>
double largest(const Place& difference, const Place& scale) {
  double most = 0;
  for (std::size_t i = 0; i < difference.size(); ++i)
    if (scale[i] > 0) most = std::max(most, std::abs(difference[i]) / scale[i]);
  return most;
}

template <class Place>
Place minus(const Place& a, const Place& b) {
  Place difference;
  for (std::size_t i = 0; i < a.size(); ++i) difference[i] = a[i] - b[i];
  return difference;
}

/// Of directions in units of the scales.
template <class Place>
double cosine(const Place& a, const Place& b, const Place& scale) {
  double ab = 0, aa = 0, bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!(scale[i] > 0)) continue;
    ab += a[i] * b[i] / (scale[i] * scale[i]);
    aa += a[i] * a[i] / (scale[i] * scale[i]);
    bb += b[i] * b[i] / (scale[i] * scale[i]);
  }
  return ab / std::sqrt(aa * bb);
}

}  // namespace

Landmarks::Landmarks(const Map& map) {
  for (std::size_t w = 0; w < weights_.size(); ++w) {
    weights_[w] = Teuchos::rcp(new Vector(Teuchos::rcpFromRef(map)));
    const auto values = weights_[w]->getDataNonConst();
    for (std::size_t i = 0; i < static_cast<std::size_t>(values.size()); ++i) {
      const auto dof = static_cast<double>(map.getGlobalElement(static_cast<int>(i)));
      values[i] = std::sin((dof + 1) * (w == 0 ? 12.9898 : 78.233));  // no multiple of a period
    }
  }
}

std::vector<double> Landmarks::numbers() const {
  std::vector<double> all;
  if (marks_.empty()) return all;
  const auto add = [&all](const Place& place) { all.insert(all.end(), place.begin(), place.end()); };
  add(low_);
  add(high_);
  for (const Mark& mark : marks_) {
    all.push_back(mark.step);
    all.push_back(mark.left ? 1 : 0);
    add(mark.place);
    add(mark.direction);
  }
  return all;
}

void Landmarks::goOn(const std::vector<double>& numbers) {
  constexpr std::size_t before = 2 * count, each = 2 + 2 * count;
  if (numbers.empty()) return;
  if (numbers.size() < before || (numbers.size() - before) % each != 0)
    throw std::invalid_argument("landmarks of a path: there are " + std::to_string(numbers.size()) +
                                " numbers, not 6 and 8 for each step");
  auto next = numbers.begin();
  const auto take = [&next](Place& place) {
    for (double& x : place) x = *next++;
  };
  take(low_);
  take(high_);
  while (next != numbers.end()) {
    Mark mark{static_cast<int>(*next++), {}, {}, false};
    mark.left = *next++ != 0;
    take(mark.place);
    take(mark.direction);
    marks_.push_back(mark);
  }
}

std::optional<int> Landmarks::pass(int step, const Series& series, double length) {
  const std::array<Rational, count> path{series.lambdaFunction(), series.functional(*weights_[0]),
                                         series.functional(*weights_[1])};
  Mark here{step, {}, {}, false};
  Place to{};
  for (std::size_t i = 0; i < count; ++i) {
    here.place[i] = path[i](0);
    here.direction[i] = path[i].derivative()(0);
    to[i] = path[i](length);
    if (marks_.empty()) low_[i] = high_[i] = here.place[i];
    low_[i] = std::min({low_[i], here.place[i], to[i]});
    high_[i] = std::max({high_[i], here.place[i], to[i]});
  }
  const auto back = meets(path, here.place, to, length);
  const Place scale = minus(high_, low_);
  for (Mark& mark : marks_) mark.left = mark.left || largest(minus(to, mark.place), scale) > kAway;
  marks_.push_back(here);
  return back;
}

std::optional<int> Landmarks::meets(const std::array<Rational, count>& path, const Place& from,
                                    const Place& to, double length) const {
  const Place scale = minus(high_, low_);
  // A step bends: it may go beyond its ends, by less than it is long.
  const double reach = 2 * largest(minus(to, from), scale) + kSame;
  for (const Mark& mark : marks_) {
    if (!mark.left || largest(minus(mark.place, from), scale) > reach) continue;
    Place fast{};
    for (std::size_t i = 0; i < count; ++i)
      fast[i] = scale[i] > 0 ? std::abs(mark.direction[i]) / scale[i] : 0;
    const auto i = static_cast<std::size_t>(std::max_element(fast.begin(), fast.end()) - fast.begin());
    for (const double a : path[i].minus(mark.place[i]).roots(length))
      if (isAt(mark, path, a)) return mark.step;
  }
  return std::nullopt;
}

bool Landmarks::isAt(const Mark& mark, const std::array<Rational, count>& path, double a) const {
  const Place scale = minus(high_, low_);
  Place place{}, direction{};
  for (std::size_t i = 0; i < count; ++i) {
    place[i] = path[i](a);
    direction[i] = path[i].derivative()(a);
  }
  return largest(minus(place, mark.place), scale) < kSame &&
         cosine(direction, mark.direction, scale) > kSameDirection;
}

}  // namespace atrapos::path
